// Every mesh format: what is written comes back, and what is broken is refused in one sentence.

#include <cmath>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "core/error.h"
#include "geometry/builtin_meshes.h"
#include "geometry/mesh_facts.h"
#include "io/mesh_import.h"
#include "support/mesh_files.h"
#include "support/scratch_folder.h"

namespace meltpoint {
namespace {

namespace fs = std::filesystem;

struct Format {
    std::string name; ///< of the test
    std::string file;
    std::function<std::string(const TriangleMesh&)> write;
    bool has_normals = true;
    bool is_text = false; ///< of which a prefix may be whole
    bool has_colors = true;
};

const std::vector<Format>& formats()
{
    using namespace test; // NOLINT(google-build-using-namespace)
    static const std::vector<Format> all{{"Obj", "m.obj", obj_of, true, true},
                                         {"PlyAscii", "m.ply", ascii_ply_of, true, true},
                                         {"PlyLittle", "m.PLY",
                                          [](const auto& mesh) {
                                              return binary_ply_of(mesh, ByteOrder::Little);
                                          }},
                                         {"PlyBig", "m.ply",
                                          [](const auto& mesh) {
                                              return binary_ply_of(mesh, ByteOrder::Big);
                                          }},
                                         {"StlAscii", "m.stl", ascii_stl_of, false, true, false},
                                         {"StlBinary", "m.STL", binary_stl_of, false, false, false},
                                         {"Gltf", "m.gltf",
                                          [](const auto& mesh) {
                                              return gltf_of(mesh);
                                          }},
                                         {"Glb", "m.glb",
                                          [](const auto& mesh) {
                                              return glb_of(mesh);
                                          }},
                                         {"Off", "m.off", off_of, true, true, false}};
    return all;
}

TriangleMesh parse(const std::string& bytes, const std::string& file)
{
    return parse_mesh({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, file);
}

/// The sentence with which it is refused; empty if it is accepted.
std::string refusal(const std::string& bytes, const std::string& file)
{
    try {
        (void)parse(bytes, file);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Input);
        std::string message = error.what();
        EXPECT_TRUE(message.starts_with(file)) << message;
        EXPECT_LT(message.size(), 500u) << message;
        EXPECT_TRUE(std::all_of(message.begin(), message.end(), [](unsigned char c) { return c >= ' '; })) << message;
        return message;
    }
    return "";
}

class MeshFormat : public testing::TestWithParam<std::size_t> {
protected:
    [[nodiscard]] static const Format& format() { return formats()[GetParam()]; }
    [[nodiscard]] static std::string refused(const std::string& bytes) { return refusal(bytes, format().file); }
};

TEST_P(MeshFormat, BringsBackWhatWasWritten)
{
    const TriangleMesh written = builtin_mesh("torus");
    const TriangleMesh read = parse(format().write(written), format().file);
    // STL has no common vertices: welding finds them again, in another order.
    ASSERT_EQ(read.positions.size(), written.positions.size());
    ASSERT_EQ(read.triangles.size(), written.triangles.size());
    EXPECT_EQ(mesh_facts(read).boundary_edges, 0u);
    for (std::size_t t = 0; t < written.triangles.size(); ++t) {
        for (int corner = 0; corner < 3; ++corner) {
            const std::uint32_t i = read.triangles[t][corner];
            const std::uint32_t k = written.triangles[t][corner];
            // assimp, which OBJ goes through, rounds the last digit of a number in its own way.
            ASSERT_LE(glm::distance(read.positions[i], written.positions[k]), format().name == "Obj" ? 1e-6f : 0.0f);
            if (format().has_normals) {
                ASSERT_LT(glm::distance(read.normals.at(i), written.normals[k]), 1e-6f);
            }
        }
    }
    EXPECT_EQ(read.normals.empty(), !format().has_normals);
}

TEST_P(MeshFormat, WithoutNormalsThereAreNone)
{
    const TriangleMesh read = parse(format().write(builtin_mesh("cube")), format().file);
    EXPECT_TRUE(read.normals.empty());
    EXPECT_NEAR(signed_volume(read), 1.0, 1e-6);
}

/// The builtin mesh with every value from 0 to 255 in each channel, if it has as many vertices.
TriangleMesh colored(const std::string& name)
{
    TriangleMesh mesh = builtin_mesh(name);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        mesh.colors.emplace_back(i % 256, 255 - i % 256, i * 7 % 256);
    }
    return mesh;
}

TEST_P(MeshFormat, BringsBackTheSameColors)
{
    const TriangleMesh written = colored("torus");
    ASSERT_GE(written.positions.size(), 256u);
    const TriangleMesh read = parse(format().write(written), format().file);
    ASSERT_EQ(read.colors.size(), format().has_colors ? read.positions.size() : 0u);
    for (std::size_t t = 0; format().has_colors && t < written.triangles.size(); ++t) {
        for (int corner = 0; corner < 3; ++corner) {
            ASSERT_EQ(read.colors[read.triangles[t][corner]], written.colors[written.triangles[t][corner]]);
        }
    }
    EXPECT_TRUE(parse(format().write(builtin_mesh("torus")), format().file).colors.empty());
}

TEST_P(MeshFormat, TruncationAtEveryByteIsRefused)
{
    const std::string whole = format().write(colored("cube"));
    for (std::size_t length = 0; length < whole.size(); ++length) {
        const std::string message = refused(whole.substr(0, length));
        // A text that ends within its last number or line may make sense; OBJ and its lines always do.
        if (!format().is_text || (format().name != "Obj" && length + 30 < whole.size())) {
            EXPECT_NE(message, "") << length << " of " << whole.size();
        }
    }
}

TEST_P(MeshFormat, JunkIsRefused)
{
    std::uint64_t state = 7;
    const auto byte = [&state] {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<char>(state >> 56);
    };
    for (int file = 0; file < 50; ++file) {
        std::string junk;
        for (int i = 0; i < 500; ++i) {
            junk += byte();
        }
        EXPECT_NE(refused(junk), "");
    }
    // A good file with some bytes overwritten, cut out or repeated: accepted or refused, never a crash.
    const std::string good = format().write(colored("cube"));
    for (int file = 0; file < 500; ++file) {
        std::string bad = good;
        const std::size_t place = static_cast<unsigned char>(byte()) * std::size_t{7919} % bad.size();
        switch (file % 3) {
        case 0:
            bad[place] = byte();
            break;
        case 1:
            bad.erase(place, static_cast<unsigned char>(byte()));
            break;
        default:
            bad.insert(place, bad.substr(place / 2, static_cast<unsigned char>(byte())));
        }
        (void)refused(bad);
    }
}

TEST_P(MeshFormat, UnusableMeshesAreRefused)
{
    const float infinity = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const TriangleMesh cube = builtin_mesh("cube");
    for (const float value : {nan, infinity, -infinity, 1e20f}) {
        TriangleMesh mesh = cube;
        mesh.positions[3].y = value;
        EXPECT_NE(refused(format().write(mesh)), "") << value;
    }
    TriangleMesh flat = cube;
    for (glm::vec3& p : flat.positions) {
        p = glm::vec3(p.x, 0.0f, 0.0f);
    }
    EXPECT_NE(refused(format().write(flat)).find("zero area"), std::string::npos);
    TriangleMesh empty = cube;
    empty.triangles.clear();
    EXPECT_NE(refused(format().write(empty)), "");
    if (format().file != "m.stl" && format().file != "m.STL") {
        TriangleMesh outside = cube;
        outside.triangles[5].y = 8;
        EXPECT_NE(refused(format().write(outside)), "");
        outside.triangles[5].y = 0x7fffffff;
        EXPECT_NE(refused(format().write(outside)), "");
    }
}

TEST_P(MeshFormat, AnotherFormatsContentIsRefused)
{
    for (const Format& other : formats()) {
        const bool same = fs::path(other.file).extension().string().substr(1, 2) ==
                              fs::path(format().file).extension().string().substr(1, 2) ||
                          (other.name.substr(0, 2) == format().name.substr(0, 2)) ||
                          (other.name[0] == 'G' && format().name[0] == 'G');
        if (!same) {
            EXPECT_NE(refused(other.write(builtin_mesh("cube"))), "") << other.name << " as " << format().file;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, MeshFormat, testing::Range(std::size_t{0}, formats().size()),
                         [](const auto& param) { return formats()[param.param].name; });

// --- counts that a file announces but cannot hold ------------------------------------------------

TEST(MeshFile, HugeCountsAreRefusedBeforeAnythingIsAllocated)
{
    const std::string cube_ply = test::ascii_ply_of(builtin_mesh("cube"));
    for (const std::string huge : {"40", "4000000000", "9000000000000000", "99999999999999999999999"}) {
        for (const std::string place : {"vertex 8", "face 12"}) {
            std::string ply = cube_ply;
            ply.replace(ply.find(place) + place.find(' ') + 1, place.size() - place.find(' ') - 1, huge);
            EXPECT_NE(refusal(ply, "m.ply"), "") << place << " " << huge;
        }
        EXPECT_NE(refusal("OFF\n" + huge + " 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "m.off"), "");
        EXPECT_NE(refusal("OFF\n3 " + huge + " 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "m.off"), "");
        EXPECT_NE(refusal("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n" + huge + " 0 1 2\n", "m.off"), "");
        std::string gltf = test::gltf_of(builtin_mesh("cube"));
        gltf.replace(gltf.find("\"count\": 36") + 9, 2, huge);
        EXPECT_NE(refusal(gltf, "m.gltf"), "");
    }
    const std::string list_of = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
                                "float z\nelement face 1\nproperty list uint int vertex_indices\nend_header\n"
                                "0 0 0\n1 0 0\n0 1 0\n";
    EXPECT_EQ(refusal(list_of + "3 0 1 2\n", "m.ply"), "");
    for (const char* list : {"4 0 1 2\n", "4000000000 0 1 2\n", "-3 0 1 2\n", "2 0 1\n", "3 0 1 -1\n", "3 0 1 nan\n"}) {
        EXPECT_NE(refusal(list_of + list, "m.ply"), "") << list;
    }
    std::string stl = test::binary_stl_of(builtin_mesh("cube"));
    stl.replace(80, 4, "\xff\xff\xff\x7f");
    EXPECT_NE(refusal(stl, "m.stl").find("2147483647 triangles"), std::string::npos);
}

TEST(MeshFile, PolygonsAreTriangulatedOrRefused)
{
    // A quad and a concave pentagon, of areas 1 and 3.
    const std::string vertices = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 0\n4 0 0\n4 2 0\n3 1 0\n2 2 0\n";
    const std::string faces = "4 0 1 2 3\n5 4 5 6 7 8\n";
    const std::string ply_header =
        "ply\r\nformat ascii 1.0\r\nelement vertex 9\r\nproperty double x\r\nproperty double "
        "y\r\nproperty double z\r\nelement face 2\r\nproperty list uint8 uint vertex_index\r\n"
        "end_header\r\n";
    for (const TriangleMesh& mesh : {parse(fmt::format("OFF 9 2 0\n{}{}", vertices, faces), "m.off"),
                                     parse(fmt::format("{}{}{}", ply_header, vertices, faces), "m.ply")}) {
        EXPECT_EQ(mesh.triangles.size(), 5u);
        EXPECT_NEAR(surface_area(mesh), 4.0, 1e-6);
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            EXPECT_GT(area_vector(mesh, i).z, 0.0);
        }
    }
    std::string many = "OFF\n5000 1 0\n";
    std::string face = "5000";
    for (int i = 0; i < 5000; ++i) {
        many += fmt::format("{} {} 0\n", i, i % 2);
        face += fmt::format(" {}", i);
    }
    EXPECT_NE(refusal(many + face, "m.off").find("corners"), std::string::npos);

    // A disc of a thousand corners may be there once, but not a thousand times.
    std::string vertices_of_disc;
    std::string disc = "1000";
    for (int i = 0; i < 1000; ++i) {
        vertices_of_disc += fmt::format("{} {} 0\n", std::cos(0.00628 * i), std::sin(0.00628 * i));
        disc += fmt::format(" {}", i);
    }
    EXPECT_EQ(refusal("OFF\n1000 1 0\n" + vertices_of_disc + disc, "m.off"), "");
    std::string discs = "OFF\n1000 1001 0\n" + vertices_of_disc;
    for (int i = 0; i < 1001; ++i) {
        discs += disc + "\n";
    }
    EXPECT_NE(refusal(discs, "m.off").find("too many polygons"), std::string::npos);
}

// --- PLY -----------------------------------------------------------------------------------------

TEST(PlyFile, OtherElementsAndPropertiesAreSkipped)
{
    const TriangleMesh mesh =
        parse("ply\nformat ascii 1.0\nobj_info made by hand\nelement camera 1\nproperty list uchar "
              "float view\nproperty float f\nelement vertex 4\nproperty uchar red\nproperty float "
              "x\nproperty list int int rings\nproperty float y\nproperty float z\nelement face 2\n"
              "property uchar flags\nproperty list uchar int vertex_indices\nproperty list uchar "
              "float texcoord\nelement edge 1\nproperty int v\nend_header\n"
              "2 7 7 1.5\n255 0 2 8 9 0 0\n0 1 0 0 0\n0 1 1 5 1 0\n0 0 0 1 0\n"
              "9 3 0 1 2 6 0 0 1 0 1 1\n9 3 0 2 3 0\n3\n",
              "m.ply");
    ASSERT_EQ(mesh.triangles.size(), 2u);
    EXPECT_NEAR(surface_area(mesh), 1.0, 1e-6);
}

TEST(PlyFile, TriangleStrips)
{
    const TriangleMesh mesh = parse("ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\n"
                                    "property float z\nelement tristrips 1\nproperty list int int vertex_indices\n"
                                    "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 0 0\n2 1 0\n8 0 1 2 3 -1 1 4 3\n",
                                    "m.ply");
    ASSERT_EQ(mesh.triangles.size(), 3u);
    EXPECT_NEAR(surface_area(mesh), 1.5, 1e-6);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_GT(area_vector(mesh, i).z, 0.0);
    }
}

TEST(PlyFile, BrokenHeadersAreRefused)
{
    const std::string good = test::ascii_ply_of(builtin_mesh("cube"));
    const auto with = [&good](const std::string& from, const std::string& to) {
        std::string text = good;
        text.replace(text.find(from), from.size(), to);
        return refusal(text, "m.ply");
    };
    EXPECT_EQ(with("a test", "another"), "");
    for (const auto& [from, to] :
         std::vector<std::pair<std::string, std::string>>{{"ply\n", "plx\n"},
                                                          {"format ascii 1.0\n", ""},
                                                          {"format ascii", "format binary"},
                                                          {"element vertex 8", "element vertex"},
                                                          {"element vertex 8", "element vertex -8"},
                                                          {"element vertex 8", "element vertex 8.5"},
                                                          {"element vertex", "element point"},
                                                          {"element face", "element vertex"},
                                                          {"property float x", "property float u"},
                                                          {"property float x", "property real x"},
                                                          {"property float x", "property float"},
                                                          {"property float x", "unknown"},
                                                          {"list uchar", "list float"},
                                                          {"vertex_indices", "something"},
                                                          {"end_header", "end"}}) {
        EXPECT_NE(with(from, to), "") << from << " -> " << to;
    }
    EXPECT_NE(
        refusal("ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 3\n"
                "property float x\nproperty float y\nproperty float z\nend_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n",
                "m.ply")
            .find("before its vertices"),
        std::string::npos);
}

// --- STL, OFF, OBJ -------------------------------------------------------------------------------

TEST(StlFile, BinaryFilesMayBeginWithSolidAndEndLate)
{
    std::string file = test::binary_stl_of(builtin_mesh("cube"));
    EXPECT_EQ(refusal(file + "left over", "m.stl"), "");
    file.replace(0, 10, "solid cube");
    EXPECT_EQ(refusal(file, "m.stl"), "");
    EXPECT_NE(refusal(file + "left over", "m.stl"), "");
}

TEST(StlFile, SeveralSolidsAndCapitals)
{
    const std::string facet =
        "FACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX +1.0E+00 0 0\nVERTEX 0 1 0\nENDLOOP\n"
        "ENDFACET\n";
    EXPECT_EQ(parse("SOLID\n" + facet + "ENDSOLID\nsolid two words\n" + facet + "endsolid two words\n", "m.stl")
                  .triangles.size(),
              2u);
    EXPECT_NE(refusal("solid\n" + facet, "m.stl").find(":9: expected \"facet\" or \"endsolid\""), std::string::npos)
        << refusal("solid\n" + facet, "m.stl");
    EXPECT_NE(refusal("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 x 0\n", "m.stl")
                  .find("m.stl:6: a coordinate is \"x\", not a number"),
              std::string::npos);
}

TEST(OffFile, PrefixesAndComments)
{
    const TriangleMesh mesh =
        parse("# first\n\nST4OFF # keyword\n# counts\n3 1\n0 0 0 2 9 9\n2 0 0 2 9 9\n\n0 4 0 2 9 9\n"
              "3 0 1 2 255 0 0 # red\n",
              "m.off");
    EXPECT_NEAR(surface_area(mesh), 1.0, 1e-6);
    EXPECT_EQ(refusal("nOFF 3\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2", "m.off"), "");
    EXPECT_NE(refusal("nOFF 2\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2", "m.off"), "");
    EXPECT_NE(refusal("OFF BINARY\n3 1 0\n", "m.off").find("binary OFF"), std::string::npos);
    EXPECT_NE(
        refusal("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "m.off").find("m.off:6: a face names vertex 3 of 3"),
        std::string::npos);
    EXPECT_NE(refusal("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "m.off").find("1 of 2 faces"), std::string::npos);
}

TEST(ObjFile, LinesThatWouldBeMisreadAreRefused)
{
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\n";
    EXPECT_EQ(refusal(vertices + "f 1 2 3\n", "m.obj"), "");
    for (const char* line : {"f 1 2", "f 1 2 03", "f 1 2 3.5", "f 1 2 x", "f 1 2 +3", "v 1 2\nf 1 2 3",
                             "v 1 2 x\nf 1 2 3", "v 1 2 3abc\nf 1 2 3", "vn 0 1\nf 1 2 3", "f", "f 1 2 \\\n"}) {
        EXPECT_NE(refusal(vertices + line + "\n", "m.obj"), "") << line;
    }
    EXPECT_NE(refusal(vertices + "\nf 1 2 0\n", "m.obj").find("m.obj:6: "), std::string::npos);
}

TEST(ObjFile, ColorsContinuationsAndWeights)
{
    const TriangleMesh mesh =
        parse("v 0 0 0 1 0 0\nv 1 0 0 0.5 0.5 0.5 1\nv 0 2 0 2\r\n  v 1 1 \\\r\n 0\nvt 0.5\nvt 0 1 0\n"
              "g a b\ns off\nusemtl x\nmtllib ../../secret.mtl\n"
              "f 1/1 2/2 3/1 # a face\nf 2/1 \\\n4/2 3/1\n",
              "m.obj");
    EXPECT_EQ(mesh.positions.size(), 4u);
    EXPECT_NEAR(surface_area(mesh), 1.0, 1e-6);
}

/// The colors of the corners (0, 0, 0), (1, 0, 0) and (0, 1, 0) of a triangle.
using Colors = std::vector<glm::u8vec3>;

/// What stands behind the coordinates of its corners in an OBJ file.
Colors obj_colors(const std::string& a, const std::string& b, const std::string& c)
{
    return parse(fmt::format("v 0 0 0 {}\nv 1 0 0 {}\nv 0 1 0 {}\nf 1 2 3\n", a, b, c), "m.obj").colors;
}

TEST(ObjFile, ColorsAreFromZeroToOneOrTo255)
{
    const Colors expected{{255, 0, 128}, {0, 255, 0}, {51, 51, 51}};
    EXPECT_EQ(obj_colors("1 0 0.502", "0 1.0 0", "0.2 +2e-1 .2"), expected);
    EXPECT_EQ(obj_colors("255 0 128", "0 255 0", "51 51 51"), expected);
    EXPECT_EQ(obj_colors("255.0 -9 127.6", "0 300 0", "51.2 51 51"), expected) << "rounded, and kept in range";
    EXPECT_EQ(obj_colors("1 0 0.502 0.5", "0 1 0 1", "0.2 0.2 0.2 9"), expected) << "an alpha says nothing";
    EXPECT_EQ(obj_colors("1.1 -0.5 0.502", "0 1.999 0", "0.2 0.2 0.2"), expected) << "too bright, but no bytes";
    EXPECT_EQ(obj_colors("2 0 1", "0 1 0", "0 0 0"), (Colors{{2, 0, 1}, {0, 1, 0}, {0, 0, 0}}));
    EXPECT_EQ(obj_colors("1 0 1", "0 1 0", "0 0 0"), (Colors{{255, 0, 255}, {0, 255, 0}, {0, 0, 0}}));
}

TEST(ObjFile, VerticesWithoutAColorAreWhiteBesideOthers)
{
    EXPECT_EQ(obj_colors("", "10 20 30", ""), (Colors{{255, 255, 255}, {10, 20, 30}, {255, 255, 255}}));
    EXPECT_EQ(obj_colors("", "", "0 0.2 1"), (Colors{{255, 255, 255}, {255, 255, 255}, {0, 51, 255}}));
    EXPECT_EQ(obj_colors("1", "2", "0 0 0"), (Colors{{255, 255, 255}, {255, 255, 255}, {0, 0, 0}})) << "weights";
    EXPECT_TRUE(obj_colors("", "2", "").empty());
    EXPECT_TRUE(parse("mtllib red.mtl\nusemtl red\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "m.obj").colors.empty());
}

TEST(ObjFile, WeightsDivideTheCoordinates)
{
    const TriangleMesh mesh = parse("v 0 0 0 1 0 0\nv 4 0 0 2\nv 0 6 0 0.5\nf 1 2 3\n", "m.obj");
    EXPECT_NEAR(surface_area(mesh), 0.5 * 2.0 * 12.0, 1e-5);
    EXPECT_NE(refusal("v 0 0 0\nv 4 0 0 0\nv 0 6 0\nf 1 2 3\n", "m.obj").find("vertex 1 is not finite"),
              std::string::npos);
}

TEST(ObjFile, BrokenColorsAreRefused)
{
    const auto with = [](const std::string& numbers) {
        return refusal("v 0 0 0 1 0 0\nv 1 0 0 " + numbers + "\nv 0 1 0\nf 1 2 3\n", "m.obj");
    };
    EXPECT_EQ(with("1 1 1"), "");
    for (const char* color : {"nan 0 0", "0 inf 0", "0 0 -inf", "0 0 1e999", "red 0 0", "0 0 1f", "0,1 0 0"}) {
        EXPECT_EQ(with(color), "m.obj:2: a color is not a finite number") << color;
    }
    EXPECT_EQ(with("1 1"), "m.obj:2: a vertex has two numbers behind its coordinates, where a color has three");
}

// --- glTF ----------------------------------------------------------------------------------------

TEST(GltfFile, TransformsOfNodesAreAppliedAndInstancesCounted)
{
    const TriangleMesh cube = builtin_mesh("cube");
    const std::string nodes = R"({"children": [1, 2], "scale": [2, 1, 1]}, {"mesh": 0, "translation": [5, 0, 0]},
        {"mesh": 0, "matrix": [0,1,0,0, -1,0,0,0, 0,0,-3,0, 0,0,0,1], "name": "turned and mirrored"},
        {"mesh": 0, "name": "in no scene"})";
    const TriangleMesh mesh = parse(test::glb_of(cube, nodes), "m.glb");
    EXPECT_EQ(mesh.triangles.size(), 24u);
    EXPECT_NEAR(signed_volume(mesh), 2.0 + 6.0, 1e-5) << "outside stays outside";
    EXPECT_NEAR(bounds(mesh).max.x, 11.0f, 1e-5f);
}

TEST(GltfFile, DeepTreesCyclesAndManyInstancesAreRefused)
{
    const TriangleMesh cube = builtin_mesh("cube");
    const auto chain = [](int depth) {
        std::string nodes;
        for (int i = 0; i < depth; ++i) {
            nodes += fmt::format(R"({{"children": [{}]}}, )", i + 1);
        }
        return nodes + R"({"mesh": 0})";
    };
    EXPECT_EQ(refusal(test::glb_of(cube, chain(1000)), "m.glb"), "");
    EXPECT_NE(refusal(test::glb_of(cube, chain(1001)), "m.glb").find("nested more than 1000 deep"), std::string::npos);
    EXPECT_NE(refusal(test::glb_of(cube, chain(20'000)), "m.glb").find("nested more than 1000 deep"),
              std::string::npos);
    EXPECT_NE(refusal(test::glb_of(cube, R"({"children": [0], "mesh": 0})"), "m.glb"), "");
    EXPECT_NE(refusal(test::glb_of(cube, R"({"children": [1]}, {"children": [0], "mesh": 0})"), "m.glb"), "");
    EXPECT_NE(refusal(test::glb_of(cube, R"({"children": [1, 1]}, {"mesh": 0})"), "m.glb"), "");
    EXPECT_NE(refusal(test::glb_of(cube, R"({"children": [7], "mesh": 0})"), "m.glb"), "");
    // A binary tree of nodes cannot share its branches, so what grows is the list of them.
    const TriangleMesh torus = builtin_mesh("torus");
    const std::size_t instances = 10'000'000 / torus.triangles.size() + 1;
    std::string children;
    std::string nodes;
    for (std::size_t i = 1; i <= instances; ++i) {
        children += fmt::format("{}{}", i == 1 ? "" : ",", i);
        nodes += R"(,{"mesh":0})";
    }
    EXPECT_NE(refusal(test::glb_of(torus, "{\"children\": [" + children + "]}" + nodes), "m.glb").find("instances"),
              std::string::npos);
}

TEST(GltfFile, JsonNestedDeepIsRefused)
{
    for (const int depth : {1000, 3'000'000}) {
        const std::string nested =
            "{\"asset\": {\"version\": \"2.0\"}, \"extras\": " + std::string(static_cast<std::size_t>(depth), '[') +
            std::string(static_cast<std::size_t>(depth), ']') + "}";
        EXPECT_NE(refusal(nested, "m.gltf").find("nested too deep"), std::string::npos);
    }
}

TEST(GltfFile, OtherVersionsCompressionAndSparseDataAreRefused)
{
    const std::string good = test::gltf_of(builtin_mesh("cube"));
    const auto with = [&good](const std::string& from, const std::string& to) {
        std::string text = good;
        text.replace(text.find(from), from.size(), to);
        return refusal(text, "m.gltf");
    };
    EXPECT_NE(with("\"2.0\"", "\"1.0\"").find("glTF 2.0"), std::string::npos);
    EXPECT_NE(
        with("\"scene\"", "\"extensionsRequired\": [\"KHR_draco_mesh_compression\"], \"scene\"").find("compression"),
        std::string::npos);
    EXPECT_EQ(with("\"scene\"", "\"extensionsRequired\": [\"KHR_materials_unlit\"], \"scene\""), "");
    EXPECT_NE(with("\"count\"", "\"sparse\": {}, \"count\"").find("sparse"), std::string::npos);
    EXPECT_NE(with("\"POSITION\": 1", "\"POSITION\": 0"), "");
    EXPECT_NE(with("\"POSITION\": 1", "\"POSITION\": 9"), "");
    EXPECT_NE(with("\"POSITION\": 1", "\"POSITION\": -1"), "");
    EXPECT_NE(with("\"POSITION\": 1", "\"COLOR_0\": 1").find("no mesh"), std::string::npos);
    EXPECT_NE(with("\"indices\": 0", "\"indices\": 1"), "");
    EXPECT_NE(with("\"indices\": 0", "\"indices\": 0, \"mode\": 1").find("no mesh"), std::string::npos);
    EXPECT_NE(with("\"bufferView\": 1", "\"bufferView\": 2"), "");
    EXPECT_NE(with("\"byteOffset\": 144", "\"byteOffset\": 148"), "");
    EXPECT_NE(with("\"byteLength\": 240", "\"byteLength\": 244"), "");
    EXPECT_NE(with("base64,", "base64,*"), "");
    EXPECT_NE(with("{\"mesh\": 0}", "{\"mesh\": 0, \"scale\": [1, 1]}"), "");
    EXPECT_NE(with("{\"mesh\": 0}", "{\"mesh\": 0, \"translation\": [1, 1, 1e300]}"), "");
    EXPECT_NE(with("{\"nodes\": [0]}", "{\"nodes\": []}"), "");
    EXPECT_NE(with("{\"nodes\": [0]}", "{\"nodes\": [0, 0]}"), "");
    EXPECT_NE(with("\"scene\": 0", "\"scene\": 3"), "");
}

/// A triangle in a GLB file. colors: the bytes that "COLOR_0" stands for; color_accessor and color_view: the members of
/// its accessor and of its view, without what every one has.
std::string glb_with_colors(const std::string& colors, const std::string& color_accessor,
                            const std::string& color_view = "")
{
    std::string buffer;
    for (const glm::vec3& corner : {glm::vec3(0, 0, 0), glm::vec3(1, 0, 0), glm::vec3(0, 1, 0)}) {
        test::append_vector(buffer, corner);
    }
    return test::glb(fmt::format(R"({{"asset": {{"version": "2.0"}}, "nodes": [{{"mesh": 0}}],
"meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0, "COLOR_0": 1}}, "material": 0}}]}}],
"materials": [{{"pbrMetallicRoughness": {{"baseColorFactor": [1, 0, 0, 1]}}}}],
"buffers": [{{"byteLength": {}}}],
"bufferViews": [{{"buffer": 0, "byteLength": 36}}, {{"buffer": 0, "byteOffset": 36, "byteLength": {}{}}}],
"accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}}, {{"bufferView": 1, {}}}]}})",
                                 36 + colors.size(), colors.size(), color_view, color_accessor),
                     buffer + colors);
}

std::string accessor_of(int component_type, const std::string& type, int count = 3)
{
    return fmt::format(R"("componentType": {}, "type": "{}", "count": {}, "normalized": true)", component_type, type,
                       count);
}

template <class T>
std::string bytes_of(std::initializer_list<T> values)
{
    std::string bytes;
    for (const T value : values) {
        test::append_bytes(bytes, value);
    }
    return bytes;
}

TEST(GltfFile, ColorsOfEveryTypeAreLinear)
{
    // sRGB 188 has half of white's light, 13 a 255th; 0.2159 is that of 128 (IEC 61966-2-1).
    const Colors expected{{255, 0, 188}, {128, 255, 0}, {13, 0, 255}};
    const float nothing = -7.0f; // an alpha
    EXPECT_EQ(parse(glb_with_colors(bytes_of({1.0f, 0.0f, 0.5f, 0.2159f, 1.0f, 0.0f, 1.0f / 255.0f, 0.0f, 1.0f}),
                                    accessor_of(5126, "VEC3")),
                    "m.glb")
                  .colors,
              expected);
    EXPECT_EQ(parse(glb_with_colors(bytes_of({1.0f, 0.0f, 0.5f, nothing, 0.2159f, 9.0f, -1.0f, nothing, 1.0f / 255.0f,
                                              0.0f, 1.1f, nothing}),
                                    accessor_of(5126, "VEC4")),
                    "m.glb")
                  .colors,
              expected)
        << "kept in range";
    EXPECT_EQ(
        parse(glb_with_colors(bytes_of<std::uint8_t>({255, 0, 128, 55, 255, 0, 1, 0, 255}), accessor_of(5121, "VEC3")),
              "m.glb")
            .colors,
        expected);
    EXPECT_EQ(parse(glb_with_colors(bytes_of<std::uint8_t>({255, 0, 128, 0, 55, 255, 0, 1, 1, 0, 255, 2}),
                                    accessor_of(5121, "VEC4")),
                    "m.glb")
                  .colors,
              expected);
    EXPECT_EQ(parse(glb_with_colors(bytes_of<std::uint16_t>({65535, 0, 32768, 14149, 65535, 0, 257, 0, 65535}),
                                    accessor_of(5123, "VEC3")),
                    "m.glb")
                  .colors,
              expected);
    EXPECT_EQ(parse(glb_with_colors(bytes_of<std::uint16_t>({65535, 0, 32768, 0, 14149, 65535, 0, 1, 257, 0, 65535, 2}),
                                    accessor_of(5123, "VEC4")),
                    "m.glb")
                  .colors,
              expected);
}

TEST(GltfFile, ColorsLieWhereTheirViewSays)
{
    const std::string colors =
        bytes_of<std::uint8_t>({99, 99, 255, 0, 0, 99, 99, 99, 0, 255, 0, 99, 99, 99, 0, 0, 255});
    const Colors expected{{255, 0, 0}, {0, 255, 0}, {0, 0, 255}};
    const std::string accessor = accessor_of(5121, "VEC3") + R"(, "byteOffset": 2)";
    EXPECT_EQ(parse(glb_with_colors(colors, accessor, R"(, "byteStride": 6)"), "m.glb").colors, expected);
    for (const std::string& bad : {glb_with_colors(colors.substr(1), accessor, R"(, "byteStride": 6)"),
                                   glb_with_colors(colors, accessor, R"(, "byteStride": 7)"),
                                   glb_with_colors(colors, accessor, R"(, "byteStride": 2)")}) {
        EXPECT_EQ(refusal(bad, "m.glb"), "m.glb: accessor 1 of the glTF file reaches beyond its buffer");
    }
}

TEST(GltfFile, BrokenColorsAreRefused)
{
    const std::string floats(48, '\0');
    EXPECT_EQ(refusal(glb_with_colors(floats, accessor_of(5126, "VEC4")), "m.glb"), "");
    for (const auto& [type, component] : std::vector<std::pair<std::string, int>>{
             {"VEC2", 5126}, {"SCALAR", 5126}, {"MAT2", 5126}, {"VEC3", 5120}, {"VEC4", 5125}, {"VEC4", 0}}) {
        EXPECT_EQ(refusal(glb_with_colors(floats, accessor_of(component, type)), "m.glb"),
                  "m.glb: \"COLOR_0\" of the glTF file has a type that is not supported");
    }
    for (const int count : {2, 4}) {
        EXPECT_EQ(refusal(glb_with_colors(floats, accessor_of(5126, "VEC3", count)), "m.glb"),
                  "m.glb: a mesh of the glTF file has not as many colors as vertices");
    }
    EXPECT_NE(refusal(glb_with_colors(floats, accessor_of(5126, "VEC3") + R"(, "sparse": {})"), "m.glb").find("sparse"),
              std::string::npos);
    const auto with_reference = [&floats](const std::string& number) {
        std::string text = glb_with_colors(floats, accessor_of(5126, "VEC3"));
        text.replace(text.find("\"COLOR_0\": 1") + 11, 1, number);
        return refusal(text, "m.glb");
    };
    EXPECT_EQ(with_reference("9"), "m.glb: \"COLOR_0\" of the glTF file is 9, but there are only 2");
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity()}) {
        EXPECT_EQ(refusal(glb_with_colors(bytes_of({0.0f, 0.0f, 0.0f, 1.0f, bad, 0.0f, 0.0f, 0.0f, 0.0f}),
                                          accessor_of(5126, "VEC3")),
                          "m.glb"),
                  "m.glb: color 1 of accessor 1 of the glTF file is not finite");
    }
    const float nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(refusal(glb_with_colors(bytes_of({0.0f, 0.0f, 0.0f, nan, 1.0f, 1.0f, 1.0f, nan, 0.0f, 0.0f, 0.0f, nan}),
                                      accessor_of(5126, "VEC4")),
                      "m.glb"),
              "")
        << "an alpha says nothing";
}

TEST(GltfFile, ColorsDoNotOutgrowTheFile)
{
    // Meshes of no node, each with an accessor of its own to the same colors.
    const TriangleMesh mesh = colored("torus");
    const auto with_meshes = [&mesh](std::size_t count) {
        std::string text = test::glb_of(mesh);
        std::string json = text.substr(20, text.find("BIN") - 24);
        const std::string accessor =
            json.substr(json.rfind("{\"bufferView\""), json.rfind("]") - json.rfind("{\"bufferView\""));
        std::string accessors;
        std::string meshes;
        for (std::size_t i = 0; i < count; ++i) {
            accessors += ", " + accessor;
            meshes += fmt::format(
                R"(, {{"primitives": [{{"attributes": {{"POSITION": 1, "COLOR_0": {}}}, "indices": 0}}]}})", i + 4);
        }
        json.insert(json.rfind("]"), accessors);
        json.insert(json.find("],\n\"buffers\""), meshes);
        return refusal(test::glb(json, test::gltf_buffer_of(mesh)), "m.glb");
    };
    EXPECT_EQ(with_meshes(3), "");
    EXPECT_EQ(with_meshes(10'000), "m.glb: the accessors of colors in the glTF file overlap");
}

TEST(GltfFile, PartsWithoutColorsAreWhiteBesideOthers)
{
    // The torus twice, side by side: the second has no colors. Then both share one accessor of them.
    const TriangleMesh mesh = colored("torus");
    std::string text = test::gltf_of(mesh, R"({"mesh": 0}, {"mesh": 1, "translation": [9, 0, 0]})");
    text.replace(text.find("\"nodes\": [0]"), 12, "\"nodes\": [0, 1]");
    const std::size_t end = text.find("],\n\"buffers\"");
    const auto with_second = [&](const std::string& attributes) {
        std::string both = text;
        both.insert(end, R"(, {"primitives": [{"attributes": {"POSITION": 1)" + attributes + R"(}, "indices": 0}]})");
        return parse(both, "m.gltf");
    };
    const std::size_t half = mesh.positions.size();
    const TriangleMesh white = with_second("");
    ASSERT_EQ(white.colors.size(), 2 * half);
    EXPECT_EQ(white.colors.at(half - 1), mesh.colors.at(half - 1));
    for (std::size_t i = half; i < 2 * half; ++i) {
        ASSERT_EQ(white.colors[i], glm::u8vec3(255));
    }
    const TriangleMesh same = with_second(R"(, "COLOR_0": 3)");
    ASSERT_EQ(same.colors.size(), 2 * half);
    EXPECT_TRUE(std::equal(same.colors.begin(), same.colors.begin() + static_cast<std::ptrdiff_t>(half),
                           same.colors.begin() + static_cast<std::ptrdiff_t>(half)));
}

TEST(GltfFile, StripsAndFans)
{
    TriangleMesh square;
    square.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    square.triangles = {{0, 1, 2}, {3, 3, 3}}; // written as six indices
    for (const int mode : {5, 6}) {
        std::string text = test::gltf_of(square);
        text.replace(text.find("\"indices\": 0"), 12, fmt::format("\"indices\": 0, \"mode\": {}", mode));
        const TriangleMesh mesh = parse(text, "m.gltf");
        EXPECT_EQ(mesh.triangles.size(), 2u);
        EXPECT_NEAR(surface_area(mesh), 1.0, 1e-6);
    }
}

TEST(GltfFile, BuffersBesideTheFileAreReadAndNoOthers)
{
    const test::ScratchFolder folder;
    fs::create_directories(folder / "scene" / "sub dir");
    const TriangleMesh cube = builtin_mesh("cube");
    const std::string buffer = test::gltf_buffer_of(cube);
    test::write_bytes(folder / "scene/cube.bin", buffer);
    test::write_bytes(folder / "scene/sub dir/cube.bin", buffer);
    test::write_bytes(folder / "outside.bin", buffer);
    fs::create_symlink(folder / "outside.bin", folder / "scene/link.bin");
    fs::create_symlink("cube.bin", folder / "scene/inner.bin");
    const auto read = [&](const std::string& uri) -> std::string {
        const fs::path path = folder / "scene/cube.gltf";
        test::write_bytes(path, test::gltf_json_of(cube, "\"uri\": \"" + uri + "\", "));
        try {
            return import_mesh(path).triangles.size() == 12 ? "" : "wrong";
        } catch (const Error& error) {
            EXPECT_TRUE(std::string(error.what()).starts_with(path.string())) << error.what();
            return error.what();
        }
    };
    for (const char* uri : {"cube.bin", "./cube.bin", "sub%20dir/cube.bin", "sub dir/../cube.bin", "inner.bin"}) {
        EXPECT_EQ(read(uri), "") << uri;
    }
    for (const std::string& uri :
         {std::string("../outside.bin"), (folder / "outside.bin").string(), std::string("link.bin"),
          std::string("%2e%2e/outside.bin"), std::string("/etc/passwd"), std::string("/dev/zero"),
          std::string("missing.bin"), std::string(""), std::string("."), std::string("sub dir"),
          std::string("file:///etc/passwd"), std::string("cube.bin%00")}) {
        EXPECT_NE(read(uri), "") << uri;
    }
}

} // namespace
} // namespace meltpoint
