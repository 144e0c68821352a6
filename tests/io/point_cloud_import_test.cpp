#include "io/point_cloud_import.h"

#include <string>

#include <gtest/gtest.h>

#include "core/error.h"
#include "geometry/builtin_meshes.h"
#include "io/input_file.h"
#include "support/mesh_files.h"
#include "support/scratch_folder.h"

namespace meltpoint {
namespace {

using test::ByteOrder;

PointCloud parse(const std::string& bytes, const std::string& file)
{
    return parse_point_cloud({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, file);
}

/// The sentence with which it is refused; empty if it is accepted.
std::string refusal(const std::string& bytes, const std::string& file)
{
    try {
        (void)parse(bytes, file);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Input);
        EXPECT_TRUE(std::string(error.what()).starts_with(file)) << error.what();
        return error.what();
    }
    return "";
}

std::string ply_header(const std::string& format, int points)
{
    return fmt::format("ply\nformat {} 1.0\nelement vertex {}\nproperty double x\nproperty float y\nproperty short z\n"
                       "property float nx\nproperty float ny\nproperty float nz\nproperty uchar red\nproperty uchar "
                       "green\nproperty uchar blue\nproperty float quality\nend_header\n",
                       format, points);
}

/// Two points, of every type a property may have, in every encoding.
void expect_the_two_points(const PointCloud& cloud)
{
    ASSERT_EQ(cloud.size(), 2u);
    EXPECT_EQ(cloud.positions[0], glm::vec3(1.5f, -2.25f, 3.0f));
    EXPECT_EQ(cloud.positions[1], glm::vec3(0.0f, 1e-3f, -300.0f));
    ASSERT_EQ(cloud.normals.size(), 2u);
    EXPECT_EQ(cloud.normals[0], glm::vec3(0.0f, 0.0f, 1.0f)) << "of unit length";
    EXPECT_LT(glm::distance(cloud.normals[1], glm::vec3(0.6f, 0.0f, -0.8f)), 1e-6f);
    ASSERT_EQ(cloud.colors.size(), 2u);
    EXPECT_EQ(cloud.colors[0], glm::u8vec3(255, 128, 0));
    EXPECT_EQ(cloud.colors[1], glm::u8vec3(1, 2, 3));
    EXPECT_TRUE(cloud.triangle.empty());
    EXPECT_TRUE(cloud.barycentric.empty());
}

TEST(PointCloudImport, PlyInEveryEncoding)
{
    expect_the_two_points(
        parse(ply_header("ascii", 2) + "1.5 -2.25 3 0 0 2 255 128 0 1\n0 1e-3 -300 3 0 -4 1 2 3 0.5\n", "p.ply"));
    for (const ByteOrder order : {ByteOrder::Little, ByteOrder::Big}) {
        std::string file = ply_header(order == ByteOrder::Little ? "binary_little_endian" : "binary_big_endian", 2);
        const auto add = [&](double x, float y, std::int16_t z, const glm::vec3& normal, const glm::u8vec3& color) {
            test::append_bytes(file, x, order);
            test::append_bytes(file, y, order);
            test::append_bytes(file, z, order);
            test::append_vector(file, normal, order);
            for (int channel = 0; channel < 3; ++channel) {
                test::append_bytes(file, color[channel]);
            }
            test::append_bytes(file, 1.0f, order);
        };
        add(1.5, -2.25f, 3, {0, 0, 2}, {255, 128, 0});
        add(0.0, 1e-3f, -300, {3, 0, -4}, {1, 2, 3});
        expect_the_two_points(parse(file, "p.PLY"));
        for (std::size_t length = 0; length < file.size(); ++length) {
            EXPECT_NE(refusal(file.substr(0, length), "p.ply"), "") << length;
        }
    }
}

TEST(PointCloudImport, ColorsOfOtherTypesAreScaled)
{
    const auto color = [](const std::string& type, const std::string& values) {
        return parse(fmt::format(
                         "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty "
                         "float z\nproperty {0} red\nproperty {0} green\nproperty {0} blue\nend_header\n0 0 0 {1}\n",
                         type, values),
                     "p.ply")
            .colors.at(0);
    };
    EXPECT_EQ(color("float", "1 0.5 0"), glm::u8vec3(255, 128, 0));
    EXPECT_EQ(color("double", "7 -1 nan"), glm::u8vec3(255, 0, 0));
    EXPECT_EQ(color("ushort", "65535 32896 0"), glm::u8vec3(255, 128, 0));
    EXPECT_EQ(color("int", "300 128 -5"), glm::u8vec3(255, 128, 0));
}

TEST(PointCloudImport, XyzOfThreeSixAndNineColumns)
{
    const PointCloud bare = parse("# a scan\n1 2 3\n\n  -4,5;6e1 # the last\r\n", "p.xyz");
    ASSERT_EQ(bare.size(), 2u);
    EXPECT_EQ(bare.positions[1], glm::vec3(-4.0f, 5.0f, 60.0f));
    EXPECT_TRUE(bare.normals.empty());
    EXPECT_TRUE(bare.colors.empty());

    const PointCloud oriented = parse("0 0 0 0 0 2.5\n1 0 0 0 3 4\n", "p.xyz");
    ASSERT_EQ(oriented.normals.size(), 2u);
    EXPECT_LT(glm::distance(oriented.normals[1], glm::vec3(0.0f, 0.6f, 0.8f)), 1e-6f);
    EXPECT_TRUE(parse("0 0 0 0 0 1\n1 0 0 1 0 0\n", "p.xyz").colors.empty()) << "whole, but of unit length";

    const PointCloud colored = parse("0 0 0 255 128 0\n1 0 0 0 0 1\n", "p.xyz");
    EXPECT_TRUE(colored.normals.empty());
    ASSERT_EQ(colored.colors.size(), 2u);
    EXPECT_EQ(colored.colors[0], glm::u8vec3(255, 128, 0));

    const PointCloud both = parse("0 0 0  0 0 1  9 8 7\n1 0 0  0 1 0  6 5 4", "p.xyz");
    ASSERT_EQ(both.normals.size(), 2u);
    ASSERT_EQ(both.colors.size(), 2u);
    EXPECT_EQ(both.colors[1], glm::u8vec3(6, 5, 4));
}

TEST(PointCloudImport, XyzWithAHeader)
{
    for (const char* header :
         {"//X Y Z Nx Ny Nz\n", "// X,Y,Z\n", "# x y z\n", "x y z\n", "X;Y;Z\n", "\"x\",\"y\",\"z\",\"r\"\n", "2\n",
          "# a scan\n\n2 # points\n", "//X Y Z\n2\r\n", "x y z\n 2\n", "X Y Z Intensity\n// made by hand\n"}) {
        const PointCloud cloud = parse(std::string(header) + "1 2 3 // the first\n//4 4 4\n4,5,6\n", "p.xyz");
        ASSERT_EQ(cloud.size(), 2u) << header;
        EXPECT_EQ(cloud.positions[0], glm::vec3(1.0f, 2.0f, 3.0f)) << header;
        EXPECT_EQ(cloud.positions[1], glm::vec3(4.0f, 5.0f, 6.0f)) << header;
        EXPECT_FALSE(cloud.intensity_ignored);
    }
}

TEST(PointCloudImport, XyzWithAnIntensity)
{
    const PointCloud cloud = parse("//X Y Z I\n1 2 3 0.5\n4 5 6 -2047\n7 8 9 nan\n", "p.xyz");
    ASSERT_EQ(cloud.size(), 3u);
    EXPECT_EQ(cloud.positions[1], glm::vec3(4.0f, 5.0f, 6.0f));
    EXPECT_TRUE(cloud.normals.empty());
    EXPECT_TRUE(cloud.colors.empty());
    EXPECT_TRUE(cloud.intensity_ignored);
}

TEST(PointCloudImport, ErrorsTellWhatAFileOfPointsMayHold)
{
    const std::string layout = "a line holds x y z, then nothing, an intensity, a normal, a color, or normal and "
                               "color: 3, 4, 6 or 9 numbers, as many in each; before them may stand comments (# or "
                               "//), the names of the columns, x y z first, and the number of points";
    EXPECT_EQ(refusal("1 2 3\n4 5\n", "p.xyz"), "p.xyz:2: 2 numbers in a line: " + layout);
    EXPECT_EQ(refusal("1 2 3 4 5 6 7 8 9 10 11\n", "p.xyz"), "p.xyz:1: more than 9 numbers in a line: " + layout);
    EXPECT_EQ(refusal("# a scan\na scan\n1 2 3\n", "p.xyz"), "p.xyz:2: neither a point nor a header: " + layout);
    EXPECT_EQ(refusal("3\n1 2 3\n4 5 6\n", "p.xyz"), "p.xyz: the file says that it holds 3 points, but holds 2");
    EXPECT_EQ(refusal("1\n1 2 3\n4 5 6\n", "p.xyz"), "p.xyz: the file says that it holds 1 points, but holds 2");
}

TEST(PointCloudImport, BrokenFilesAreRefused)
{
    for (const char* text : {"\n",
                             "# nothing\n",
                             "1 2\n",
                             "1 2 3 4 5\n",
                             "1 2 3\n1 2 3 4\n",
                             "1 2 3 4 5 6 7\n",
                             "//x y z\n",
                             "x y z\n",
                             "x y z\nx y z\n1 2 3\n",
                             "1 2 3\nx y z\n",
                             "y x z\n1 2 3\n",
                             "x y\n1 2 3\n",
                             "/ x y z\n1 2 3\n",
                             "2\n",
                             "-1\n",
                             "0\n",
                             "1.5\n1 2 3\n",
                             "nan\n1 2 3\n",
                             "1e99\n1 2 3\n",
                             "1\n1\n1 2 3\n",
                             "1 2 3\n1\n",
                             "3\nwater\nO 0 0 0\nH 1 0 0\nH 0 1 0\n",
                             "1 2 3\n1 2 3 4 5 6\n",
                             "1 2 3\n1 2 x\n",
                             "1 2 3x\n",
                             "nan 0 0\n",
                             "0 inf 0\n",
                             "1e300 0 0\n",
                             "1e10 0 0\n",
                             "1 2 3 4 5 6 7 8 9 10\n",
                             "1,,2\n",
                             "ply\n"}) {
        EXPECT_NE(refusal(text, "p.xyz"), "") << text;
    }
    EXPECT_NE(refusal("1 2 3\n4 5 x6\n", "p.xyz").find("p.xyz:2: a column is \"x6\", not a number"), std::string::npos);
    EXPECT_NE(refusal("1 2 3\n", "p.txt").find(".ply or .xyz"), std::string::npos);
    EXPECT_NE(refusal(ply_header("ascii", 0), "p.ply").find("no points"), std::string::npos);
    EXPECT_NE(refusal(ply_header("ascii", 1'000'000'000), "p.ply").find("1000000000 elements"), std::string::npos);
}

TEST(PointCloudImport, NormalsThatAreAllZeroAreNone)
{
    EXPECT_TRUE(parse("0 0 0 0 0 0\n1 0 0 0 0 0.0\n", "p.xyz").normals.empty());
    const PointCloud some = parse("0 0 0 0 0 0\n1 0 0 0 0 0.5\n", "p.xyz");
    ASSERT_EQ(some.normals.size(), 2u);
    EXPECT_EQ(some.normals[0], glm::vec3(0.0f));
}

TEST(PointCloudImport, NormalsThatAreNotFiniteAreMissing)
{
    const PointCloud some = parse("0 0 0 0 0 nan\n1 0 0 0 3 4\n2 0 0 inf 0 0\n", "p.xyz");
    ASSERT_EQ(some.normals.size(), 3u);
    EXPECT_EQ(some.normals[0], glm::vec3(0.0f));
    EXPECT_LT(glm::distance(some.normals[1], glm::vec3(0.0f, 0.6f, 0.8f)), 1e-6f);
    EXPECT_EQ(some.normals[2], glm::vec3(0.0f));
    EXPECT_TRUE(parse("0 0 0 0 0 nan\n", "p.xyz").normals.empty());
}

TEST(PointCloudImport, KnowsPointsFromMeshes)
{
    const test::ScratchFolder folder;
    test::write_bytes(folder / "a.xyz", "1 2 3\n");
    test::write_bytes(folder / "b.ply", ply_header("ascii", 1) + "0 0 0 0 0 1 0 0 0 0\n");
    test::write_bytes(folder / "c.ply", test::ascii_ply_of(builtin_mesh("cube")));
    test::write_bytes(folder / "d.ply", test::ascii_ply_of({builtin_mesh("cube").positions, {}, {}}));
    test::write_bytes(folder / "e.obj", test::obj_of(builtin_mesh("cube")));
    const auto points = [&](const char* name) {
        return holds_points(read_input_file(folder / name), folder / name);
    };
    EXPECT_TRUE(points("a.xyz"));
    EXPECT_TRUE(points("b.ply"));
    EXPECT_FALSE(points("c.ply"));
    EXPECT_TRUE(points("d.ply")) << "a mesh without faces, as some programs write clouds";
    EXPECT_FALSE(points("e.obj"));
    EXPECT_EQ(import_point_cloud(folder / "a.xyz").size(), 1u);
    EXPECT_THROW((void)import_point_cloud(folder / "missing.ply"), Error);
}

} // namespace
} // namespace meltpoint
