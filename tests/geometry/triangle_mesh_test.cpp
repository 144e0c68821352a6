#include "geometry/mesh_facts.h"
#include "geometry/triangle_mesh.h"

#include <cmath>
#include <limits>
#include <string>

#include <glm/gtc/matrix_transform.hpp>
#include <gtest/gtest.h>

#include "core/error.h"
#include "geometry/builtin_meshes.h"

namespace meltpoint {
namespace {

TriangleMesh right_triangle()
{
    TriangleMesh mesh;
    mesh.positions = {{0.0f, 0.0f, 0.0f}, {3.0f, 0.0f, 0.0f}, {0.0f, 4.0f, 0.0f}};
    mesh.triangles = {{0, 1, 2}};
    return mesh;
}

std::string complaint(const TriangleMesh& mesh)
{
    try {
        validate(mesh, "the mesh");
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Input);
        return error.what();
    }
    return "";
}

TEST(TriangleMesh, ValidateAcceptsATriangle)
{
    EXPECT_EQ(complaint(right_triangle()), "");
}

TEST(TriangleMesh, ValidateNamesWhatIsWrong)
{
    const float infinity = std::numeric_limits<float>::infinity();
    const auto changed = [](auto change) {
        TriangleMesh mesh = right_triangle();
        change(mesh);
        return complaint(mesh);
    };
    EXPECT_NE(complaint({}).find("no triangles"), std::string::npos);
    EXPECT_NE(changed([](auto& m) { m.triangles[0].z = 3; }).find("only 3 vertices"), std::string::npos);
    EXPECT_NE(changed([](auto& m) { m.positions[1].y = std::nanf(""); }).find("vertex 1 is not finite"),
              std::string::npos);
    EXPECT_NE(changed([&](auto& m) { m.positions[2].z = -infinity; }).find("vertex 2 is not finite"),
              std::string::npos);
    EXPECT_NE(changed([](auto& m) { m.positions[2] = {6.0f, 0.0f, 0.0f}; }).find("zero area"), std::string::npos);
    EXPECT_NE(changed([](auto& m) { m.positions[2].y = 1e20f; }).find("at most"), std::string::npos);
    EXPECT_NE(changed([](auto& m) {
                  m.positions = {{}, {1e-12f, 0, 0}, {0, 1e-12f, 0}};
              }).find("at least"),
              std::string::npos);
    EXPECT_NE(changed([](auto& m) { m.normals.resize(2); }).find("2 normals for 3 vertices"), std::string::npos);
    EXPECT_NE(changed([&](auto& m) {
                  m.normals = {{}, {}, {infinity, 0, 0}};
              }).find("normal of vertex 2"),
              std::string::npos);
}

TEST(TriangleMesh, MeasuresAreaVolumeAndBounds)
{
    EXPECT_DOUBLE_EQ(triangle_area(right_triangle(), 0), 6.0);
    EXPECT_DOUBLE_EQ(area_vector(right_triangle(), 0).z, 6.0);
    const TriangleMesh cube = builtin_mesh("cube");
    EXPECT_DOUBLE_EQ(surface_area(cube), 6.0);
    EXPECT_DOUBLE_EQ(signed_volume(cube), 1.0);
    EXPECT_EQ(bounds(cube).min, glm::vec3(-0.5f));
    EXPECT_EQ(bounds(cube).max, glm::vec3(0.5f));
}

/// The cube as a file with hard edges holds it: four corners a face, each with its face's normal.
TriangleMesh cube_of_faces()
{
    const TriangleMesh cube = builtin_mesh("cube");
    TriangleMesh mesh;
    for (std::size_t i = 0; i < cube.triangles.size(); ++i) {
        for (int corner = 0; corner < 3; ++corner) {
            mesh.positions.push_back(cube.positions[cube.triangles[i][corner]] * (1.0f + 1e-7f * float(i % 3)));
            mesh.normals.emplace_back(glm::normalize(area_vector(cube, i)));
        }
        mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    return mesh;
}

TEST(TriangleMesh, WeldMergesCoincidentVerticesAndMarksCreases)
{
    EXPECT_EQ(mesh_facts(cube_of_faces()).boundary_edges, 36u);
    const TriangleMesh welded = weld(cube_of_faces());
    EXPECT_EQ(welded.positions.size(), 8u);
    EXPECT_EQ(welded.triangles.size(), 12u);
    EXPECT_EQ(mesh_facts(welded).boundary_edges, 0u);
    for (const glm::vec3& normal : welded.normals) {
        EXPECT_EQ(normal, glm::vec3(0.0f));
    }
}

TEST(TriangleMesh, WeldAveragesNormalsOfASmoothSurface)
{
    TriangleMesh mesh = right_triangle();
    mesh.positions.push_back(mesh.positions[0]);
    mesh.positions.emplace_back(-3.0f, 0.0f, 0.0f);
    mesh.triangles.emplace_back(3, 2, 4);
    mesh.normals.assign(5, {0.0f, 0.0f, 1.0f});
    mesh.normals[0] = glm::normalize(glm::vec3(0.1f, 0.0f, 1.0f));
    mesh.normals[3] = glm::normalize(glm::vec3(-0.1f, 0.0f, 1.0f));
    const TriangleMesh welded = weld(mesh);
    ASSERT_EQ(welded.positions.size(), 4u);
    EXPECT_NEAR(glm::distance(welded.normals[0], glm::vec3(0.0f, 0.0f, 1.0f)), 0.0f, 1e-6f);
}

TEST(TriangleMesh, WeldingKeepsColors)
{
    TriangleMesh mesh;
    mesh.positions = {{9, 9, 9}, {0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 1, 0}}; // the first is used by nobody
    mesh.colors = {{9, 9, 9}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}};
    mesh.triangles = {{3, 2, 4}};
    const TriangleMesh welded = weld(mesh);
    EXPECT_EQ(welded.colors, (std::vector<glm::u8vec3>{{1, 0, 0}, {2, 0, 0}, {4, 0, 0}}));
    mesh.colors.pop_back();
    EXPECT_THROW(validate(mesh, "test"), Error);
}

TEST(TriangleMesh, WeldDropsDegenerateTrianglesAndUnusedVertices)
{
    TriangleMesh mesh = right_triangle();
    mesh.positions.insert(mesh.positions.begin(), {{100.0f, 100.0f, 100.0f}, {0.0f, 0.0f, 0.0f}});
    mesh.triangles = {{2, 3, 4}, {1, 2, 3}, {3, 3, 4}};
    const TriangleMesh welded = weld(mesh);
    ASSERT_EQ(welded.triangles.size(), 1u);
    EXPECT_EQ(welded.positions.size(), 3u);
    EXPECT_EQ(bounds(welded).max, glm::vec3(3.0f, 4.0f, 0.0f));
    EXPECT_DOUBLE_EQ(surface_area(welded), 6.0);
}

TEST(TriangleMesh, WeldKeepsVerticesFurtherApartThanItsTolerance)
{
    TriangleMesh mesh = right_triangle();
    mesh.positions.emplace_back(0.0f, 4.0f + 1e-5f, 0.0f);
    mesh.triangles.emplace_back(0, 1, 3);
    EXPECT_EQ(weld(mesh).positions.size(), 4u);
    mesh.positions.back().y = 4.0f + 1e-6f;
    EXPECT_EQ(weld(mesh).positions.size(), 3u);
}

TEST(TriangleMesh, TransformMovesPointsAndKeepsNormalsPerpendicular)
{
    TriangleMesh mesh = right_triangle();
    mesh.normals.assign(3, {0.0f, 0.0f, 1.0f});
    glm::mat4 matrix = glm::translate(glm::mat4(1.0f), {1.0f, 2.0f, 3.0f});
    matrix = glm::rotate(matrix, 0.7f, glm::normalize(glm::vec3(1.0f, 2.0f, -1.0f)));
    matrix = glm::scale(matrix, {2.0f, 0.5f, 3.0f});
    transform(mesh, matrix);
    EXPECT_NEAR(glm::distance(mesh.positions[0], glm::vec3(1.0f, 2.0f, 3.0f)), 0.0f, 1e-6f);
    EXPECT_NEAR(triangle_area(mesh, 0), 6.0, 1e-5);
    const glm::dvec3 normal = glm::normalize(area_vector(mesh, 0));
    EXPECT_NEAR(glm::dot(normal, glm::dvec3(mesh.normals[0])), 1.0, 1e-6);
}

TEST(TriangleMesh, AReflectionKeepsOutsideOutside)
{
    TriangleMesh sphere = builtin_mesh("sphere");
    const double volume = signed_volume(sphere);
    transform(sphere, glm::scale(glm::mat4(1.0f), {-1.0f, 1.0f, 1.0f}));
    EXPECT_NEAR(signed_volume(sphere), volume, 1e-9);
    for (std::size_t i = 0; i < sphere.triangles.size(); ++i) {
        const glm::dvec3 vertex_normal(sphere.normals[sphere.triangles[i].x]);
        ASSERT_GT(glm::dot(area_vector(sphere, i), vertex_normal), 0.0);
    }
}

} // namespace
} // namespace meltpoint
