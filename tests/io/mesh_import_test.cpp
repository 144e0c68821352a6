#include "io/mesh_import.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/error.h"
#include "geometry/mesh_facts.h"
#include "geometry/teapot.h"

namespace meltpoint {
namespace {

/// Files in a temporary folder of the test's own.
class MeshImport : public testing::Test {
protected:
    void SetUp() override
    {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        folder_ = std::filesystem::temp_directory_path() /
                  ("meltpoint_mesh_import_" + std::to_string(getpid()) + "_" + test->name());
        std::filesystem::create_directories(folder_);
    }

    void TearDown() override { std::filesystem::remove_all(folder_); }

    std::filesystem::path write(const std::string& name, const std::string& content) const
    {
        std::ofstream(folder_ / name, std::ios::binary) << content;
        return folder_ / name;
    }

    /// The message with which a file is refused; empty if it is accepted.
    std::string complaint(const std::filesystem::path& path) const
    {
        try {
            (void)import_mesh(path);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::Input);
            std::string message = error.what();
            EXPECT_NE(message.find(path.string()), std::string::npos) << "does not name the file: " << message;
            EXPECT_EQ(message.find('\n'), std::string::npos) << message;
            return message;
        }
        return "";
    }

    std::string refused(const std::string& content) const { return complaint(write("bad.obj", content)); }

    std::filesystem::path folder_;
};

std::string obj_of(const TriangleMesh& mesh)
{
    std::string text;
    for (const glm::vec3& p : mesh.positions) {
        text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    }
    for (const glm::uvec3& t : mesh.triangles) {
        text += fmt::format("f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1);
    }
    return text;
}

TEST_F(MeshImport, ReadsWhatWasWritten)
{
    const TriangleMesh written = teapot(6);
    const TriangleMesh read = import_mesh(write("teapot.OBJ", obj_of(written)));
    EXPECT_EQ(read.positions.size(), written.positions.size());
    EXPECT_EQ(read.triangles.size(), written.triangles.size());
    EXPECT_NEAR(surface_area(read), surface_area(written), 1e-4);
    EXPECT_NEAR(signed_volume(read), signed_volume(written), 1e-4);
    EXPECT_EQ(mesh_facts(read).boundary_edges, mesh_facts(written).boundary_edges);
    EXPECT_TRUE(read.normals.empty());
}

TEST_F(MeshImport, TriangulatesPolygonsAndCountsFromTheEnd)
{
    // A unit square as one quad with relative indices, and a concave pentagon of area 3 beside it.
    const TriangleMesh mesh = import_mesh(write("polygons.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf -4 -3 -2 -1\n"
                                                                "v 2 0 0\nv 4 0 0\nv 4 2 0\nv 3 1 0\nv 2 2 0\n"
                                                                "f 5 6 7 8 9\n"));
    EXPECT_EQ(mesh.triangles.size(), 5u);
    EXPECT_NEAR(surface_area(mesh), 4.0, 1e-6);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        EXPECT_GT(area_vector(mesh, i).z, 0.0);
    }
}

TEST_F(MeshImport, KeepsNormalsAndMergesGroupsAndMaterials)
{
    const TriangleMesh mesh =
        import_mesh(write("normals.obj", "mtllib missing.mtl\no one\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 2\n"
                                         "usemtl red\nf 1//1 2//1 3//1\no two\nusemtl blue\nf 1//1 3//1 4//1\n"));
    ASSERT_EQ(mesh.positions.size(), 4u);
    ASSERT_EQ(mesh.normals.size(), 4u);
    for (const glm::vec3& normal : mesh.normals) {
        EXPECT_NEAR(glm::distance(normal, glm::vec3(0.0f, 0.0f, 1.0f)), 0.0f, 1e-6f);
    }
}

TEST_F(MeshImport, IgnoresLinesAndPoints)
{
    const TriangleMesh mesh =
        import_mesh(write("mixed.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\nl 1 4\np 4\nf 1 2 3\n"));
    EXPECT_EQ(mesh.triangles.size(), 1u);
    EXPECT_EQ(mesh.positions.size(), 3u);
}

TEST_F(MeshImport, RefusesWhatIsNotAFile)
{
    EXPECT_NE(complaint(folder_ / "nowhere.obj").find("no such file"), std::string::npos);
    EXPECT_NE(complaint(folder_).find("directory"), std::string::npos);
    std::filesystem::create_directory(folder_ / "folder.obj");
    EXPECT_NE(complaint(folder_ / "folder.obj").find("directory"), std::string::npos);
    EXPECT_NE(complaint(write("empty.obj", "")).find("empty"), std::string::npos);
    const std::filesystem::path pipe = folder_ / "pipe.obj";
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    EXPECT_NE(complaint(pipe).find("not a regular file"), std::string::npos);
}

TEST_F(MeshImport, RefusesOtherFormatsAndNamesItsOwn)
{
    const std::string triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    for (const char* name : {"mesh.3ds", "mesh.fbx", "mesh", "mesh.obj.txt"}) {
        const std::string message = complaint(write(name, triangle));
        EXPECT_NE(message.find(".obj"), std::string::npos) << message;
    }
    // Other formats under OBJ's name, which other importers would have recognized by their content.
    EXPECT_NE(refused("solid cube\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                      "endloop\nendfacet\nendsolid\n"),
              "");
    EXPECT_NE(refused("ply\nformat ascii 1.0\nelement vertex 0\nend_header\n"), "");
}

TEST_F(MeshImport, RefusesBrokenContent)
{
    const std::string vertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
    const std::string one_face = vertices + "f 1 2 3\n";
    EXPECT_NE(refused("\n"), "");
    EXPECT_NE(refused("# only a comment\n"), "");
    EXPECT_NE(refused(vertices), "");
    EXPECT_NE(refused(vertices + "l 1 2 3\n"), "");
    EXPECT_NE(refused(vertices + "f 1 2\n"), "");
    EXPECT_NE(refused(vertices + "f 1 2 4\n"), "");
    EXPECT_NE(refused(vertices + "f 1 2 -9\n"), "");
    EXPECT_NE(refused(vertices + "f 0 1 2\n"), "");
    EXPECT_NE(refused(vertices + "f 1 2 99999999999999999999\n"), "");
    EXPECT_NE(refused(vertices + "f 1 1 1\n"), "");
    EXPECT_NE(refused("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"), "");
    EXPECT_NE(refused("f 1 2 3\n"), "");
    EXPECT_NE(refused("v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "");
    EXPECT_NE(refused("v inf 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "");
    EXPECT_NE(refused("v 1e999 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "");
    EXPECT_NE(refused("v 1e30 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"), "");
    EXPECT_EQ(refused(one_face), "");
}

TEST_F(MeshImport, RefusesAPolygonThatWouldTakeForeverToTriangulate)
{
    std::string text;
    std::string face = "f";
    for (int i = 0; i < 5000; ++i) {
        text += fmt::format("v {} {} 0\n", i, i % 2);
        face += fmt::format(" {}", i + 1);
    }
    EXPECT_NE(refused(text + face + "\n").find("corners"), std::string::npos);
}

} // namespace
} // namespace meltpoint
