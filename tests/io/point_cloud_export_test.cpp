#include "io/point_cloud_export.h"

#include <cstring>
#include <string>

#include <gtest/gtest.h>

#include "core/error.h"
#include "geometry/builtin_meshes.h"
#include "geometry/surface_sampling.h"
#include "io/point_cloud_import.h"
#include "support/scratch_folder.h"

namespace meltpoint {
namespace {

/// More than a chunk of rows, with every attribute.
PointCloud full_cloud(std::size_t count = 70'001)
{
    PointCloud cloud = sample_surface(builtin_mesh("torus"), {.amount = PointCount{count}}).cloud;
    for (std::size_t i = 0; i < count; ++i) {
        cloud.colors.emplace_back(i % 256, i / 256 % 256, 7);
    }
    return cloud;
}

PointCloud bare_cloud()
{
    PointCloud cloud;
    cloud.positions = {{0.1f, -1e-20f, 3e8f}, {1, 2, 3}};
    return cloud;
}

class PointCloudExport : public testing::Test {
protected:
    [[nodiscard]] std::string written(const PointCloud& cloud, const std::string& name) const
    {
        EXPECT_TRUE(export_point_cloud(folder / name, cloud));
        EXPECT_EQ(folder.file_count(), 1u);
        return test::read_bytes(folder / name);
    }

    test::ScratchFolder folder;
};

template <class T>
T value_at(const std::string& bytes, std::size_t offset)
{
    T value{};
    EXPECT_LE(offset + sizeof(T), bytes.size());
    std::memcpy(&value, bytes.data() + offset, sizeof(T));
    return value;
}

/// Where the text ends that a file holds once.
std::size_t behind(const std::string& bytes, const std::string& text, std::size_t from = 0)
{
    const std::size_t at = bytes.find(text, from);
    EXPECT_NE(at, std::string::npos) << text;
    return at + text.size();
}

TEST_F(PointCloudExport, PlyComesBackToTheBit)
{
    const PointCloud cloud = full_cloud();
    const std::string bytes = written(cloud, "p.ply");
    const std::size_t body = behind(bytes, "end_header\n");
    constexpr std::size_t row = 12 + 12 + 3 + 4 + 8;
    ASSERT_EQ(bytes.size() - body, cloud.size() * row);
    EXPECT_NE(bytes.find("property uint triangle\nproperty float u\nproperty float v\nend_header\n"),
              std::string::npos);
    const PointCloud read = import_point_cloud(folder / "p.ply");
    EXPECT_EQ(read.positions, cloud.positions);
    EXPECT_EQ(read.colors, cloud.colors);
    ASSERT_EQ(read.normals.size(), cloud.size());
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        ASSERT_LT(glm::distance(read.normals[i], cloud.normals[i]), 1e-6f);
        ASSERT_EQ(value_at<std::uint32_t>(bytes, body + i * row + 27), cloud.triangle[i]);
        ASSERT_EQ(value_at<glm::vec2>(bytes, body + i * row + 31), cloud.barycentric[i]);
    }
}

TEST_F(PointCloudExport, XyzComesBackToTheBit)
{
    const PointCloud cloud = full_cloud();
    (void)written(cloud, "p.xyz");
    const PointCloud read = import_point_cloud(folder / "p.xyz");
    EXPECT_EQ(read.positions, cloud.positions);
    EXPECT_EQ(read.colors, cloud.colors);
    EXPECT_EQ(read.normals.size(), cloud.size());
}

TEST_F(PointCloudExport, PositionsAloneInEveryFormat)
{
    EXPECT_EQ(written(bare_cloud(), "p.xyz"), "0.1 -1e-20 300000000\n1 2 3\n");
    for (const char* name : {"p.ply", "p.msh", "p.vtp"}) {
        const test::ScratchFolder own;
        EXPECT_TRUE(export_point_cloud(own / name, bare_cloud()));
        const std::string bytes = test::read_bytes(own / name);
        for (const char* attribute : {"nx", "ormals", "triangle", "red", "Colors", "property float u", "barycentric"}) {
            EXPECT_EQ(bytes.find(attribute), std::string::npos) << name << " " << attribute;
        }
    }
}

TEST_F(PointCloudExport, MshHasNodesPointElementsAndAViewOfTheNormals)
{
    const PointCloud cloud = full_cloud();
    const std::string bytes = written(cloud, "p.msh");
    ASSERT_TRUE(bytes.starts_with("$MeshFormat\n2.2 1 8\n"));
    EXPECT_EQ(value_at<int>(bytes, 20), 1);
    const std::size_t nodes = behind(bytes, "\n$EndMeshFormat\n$Nodes\n70001\n");
    const std::size_t after_nodes = nodes + cloud.size() * 28;
    ASSERT_EQ(bytes.compare(after_nodes, 11, "\n$EndNodes\n"), 0);
    const std::size_t elements = behind(bytes, "$Elements\n70001\n", after_nodes);
    EXPECT_EQ(value_at<int>(bytes, elements), 15);
    EXPECT_EQ(value_at<int>(bytes, elements + 4), 70001);
    EXPECT_EQ(value_at<int>(bytes, elements + 8), 2);
    const std::size_t after_elements = elements + 12 + cloud.size() * 16;
    const std::string head = "\n$EndElements\n$NodeData\n1\n\"normals\"\n1\n0\n3\n0\n3\n70001\n";
    ASSERT_EQ(bytes.compare(after_elements, head.size(), head), 0);
    const std::size_t data = after_elements + head.size();
    EXPECT_EQ(bytes.substr(data + cloud.size() * 28), "\n$EndNodeData\n");
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        const int number = static_cast<int>(i) + 1;
        ASSERT_EQ(value_at<int>(bytes, nodes + i * 28), number);
        ASSERT_EQ(value_at<glm::dvec3>(bytes, nodes + i * 28 + 4), glm::dvec3(cloud.positions[i]));
        ASSERT_EQ(value_at<int>(bytes, elements + 12 + i * 16), number);
        ASSERT_EQ(value_at<int>(bytes, elements + 12 + i * 16 + 12), number);
        ASSERT_EQ(value_at<int>(bytes, data + i * 28), number);
        ASSERT_EQ(value_at<glm::dvec3>(bytes, data + i * 28 + 4), glm::dvec3(cloud.normals[i]));
    }
}

TEST_F(PointCloudExport, VtpArraysLieWhereTheXmlSays)
{
    const PointCloud cloud = full_cloud();
    const std::string bytes = written(cloud, "p.vtp");
    const std::size_t appended = behind(bytes, "<AppendedData encoding=\"raw\">\n_");
    EXPECT_EQ(bytes.substr(bytes.size() - 28), "\n</AppendedData>\n</VTKFile>\n");
    EXPECT_NE(bytes.find("NumberOfPoints=\"70001\" NumberOfVerts=\"70001\""), std::string::npos);
    EXPECT_NE(bytes.find("<PointData Normals=\"Normals\">"), std::string::npos);
    std::size_t end = appended;
    const auto begin_of = [&](const std::string& name, std::size_t value_bytes) {
        const std::size_t array = behind(bytes, "Name=\"" + name + "\"");
        const std::size_t offset = std::stoul(bytes.substr(behind(bytes, "offset=\"", array), 12));
        EXPECT_EQ(value_at<std::uint64_t>(bytes, appended + offset), cloud.size() * value_bytes) << name;
        EXPECT_EQ(appended + offset, end) << "one array behind the other";
        end = appended + offset + 8 + cloud.size() * value_bytes;
        return appended + offset + 8;
    };
    const std::size_t points = begin_of("Points", 12);
    const std::size_t connectivity = begin_of("connectivity", 4);
    const std::size_t offsets = begin_of("offsets", 4);
    const std::size_t normals = begin_of("Normals", 12);
    const std::size_t colors = begin_of("Colors", 3);
    const std::size_t triangle = begin_of("triangle", 4);
    const std::size_t barycentric = begin_of("barycentric", 8);
    EXPECT_EQ(end, bytes.size() - 28);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        ASSERT_EQ(value_at<glm::vec3>(bytes, points + i * 12), cloud.positions[i]);
        ASSERT_EQ(value_at<int>(bytes, connectivity + i * 4), static_cast<int>(i));
        ASSERT_EQ(value_at<int>(bytes, offsets + i * 4), static_cast<int>(i) + 1);
        ASSERT_EQ(value_at<glm::vec3>(bytes, normals + i * 12), cloud.normals[i]);
        ASSERT_EQ(value_at<glm::u8vec3>(bytes, colors + i * 3), cloud.colors[i]);
        ASSERT_EQ(value_at<std::uint32_t>(bytes, triangle + i * 4), cloud.triangle[i]);
        ASSERT_EQ(value_at<glm::vec2>(bytes, barycentric + i * 8), cloud.barycentric[i]);
    }
}

TEST_F(PointCloudExport, StoppedInTheMiddleThePathIsAsItWas)
{
    const std::atomic<bool> stop = true;
    for (const char* name : {"p.ply", "p.msh", "p.vtp", "p.xyz"}) {
        EXPECT_FALSE(export_point_cloud(folder / name, full_cloud(10), &stop));
    }
    EXPECT_EQ(folder.file_count(), 0u);
    test::write_bytes(folder / "p.ply", "mine");
    EXPECT_FALSE(export_point_cloud(folder / "p.ply", full_cloud(10), &stop));
    EXPECT_EQ(test::read_bytes(folder / "p.ply"), "mine");
    EXPECT_EQ(folder.file_count(), 1u);
}

TEST_F(PointCloudExport, OtherFormatsAndTornCloudsAreErrors)
{
    for (const char* name : {"p.obj", "p", "p.ply.gz", ".ply"}) {
        try {
            (void)export_point_cloud(folder / name, bare_cloud());
            ADD_FAILURE() << name;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::Input);
            EXPECT_NE(std::string(error.what()).find(".ply, .msh, .vtp or .xyz"), std::string::npos);
        }
    }
    PointCloud torn = bare_cloud();
    torn.normals.resize(1);
    EXPECT_THROW((void)export_point_cloud(folder / "p.ply", torn), Error);
    EXPECT_THROW((void)export_point_cloud(folder / "missing/p.ply", bare_cloud()), Error);
    EXPECT_EQ(folder.file_count(), 0u);
}

} // namespace
} // namespace meltpoint
