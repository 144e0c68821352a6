#include "geometry/polygon_triangulation.h"

#include <cmath>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "geometry/triangle_mesh.h"

namespace meltpoint {
namespace {

TriangleMesh triangulated(const std::vector<glm::vec3>& outline)
{
    TriangleMesh mesh;
    mesh.positions = outline;
    std::vector<std::uint32_t> corners(outline.size());
    std::iota(corners.begin(), corners.end(), 0u);
    triangulate_polygon(corners, mesh.positions, mesh.triangles);
    return mesh;
}

/// Every triangle is oriented like the polygon, and together they have its area: so they neither overlap nor stick out.
void expect_covered(const std::vector<glm::vec3>& outline, double area)
{
    const TriangleMesh mesh = triangulated(outline);
    EXPECT_EQ(mesh.triangles.size(), outline.size() - 2);
    EXPECT_NEAR(surface_area(mesh), area, 1e-5 * area);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        EXPECT_GE(area_vector(mesh, i).z, 0.0);
    }
}

TEST(PolygonTriangulation, CoversConvexAndConcavePolygons)
{
    expect_covered({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, 1.0);
    expect_covered({{2, 0, 0}, {4, 0, 0}, {4, 2, 0}, {3, 1, 0}, {2, 2, 0}}, 3.0);
    expect_covered({{1, 1, 0}, {0, 4, 0}, {0, 0, 0}, {4, 0, 0}}, 4.0); // reflex first corner
    // A comb of 50 teeth, each a unit high on a base of half a unit.
    std::vector<glm::vec3> comb = {{0.0f, -0.5f, 0.0f}, {100.0f, -0.5f, 0.0f}};
    for (int tooth = 50; tooth-- > 0;) {
        comb.emplace_back(2.0f * float(tooth) + 2.0f, 0.0f, 0.0f);
        comb.emplace_back(2.0f * float(tooth) + 1.0f, 1.0f, 0.0f);
    }
    comb.emplace_back(0.0f, 0.0f, 0.0f);
    expect_covered(comb, 50.0 + 50.0);
}

TEST(PolygonTriangulation, CoversASpiral)
{
    // Two parallel spirals joined at their ends: nearly every corner on one side is reflex.
    std::vector<glm::vec3> outline;
    const auto point = [](double turn, double gap) {
        const double radius = 1.0 + turn + gap;
        const double angle = 2.0 * std::numbers::pi * turn;
        return glm::vec3(radius * std::cos(angle), radius * std::sin(angle), 0.0);
    };
    for (int i = 0; i <= 300; ++i) {
        outline.push_back(point(i / 100.0, 0.4));
    }
    for (int i = 300; i >= 0; --i) {
        outline.push_back(point(i / 100.0, 0.0));
    }
    double area = 0.0; // by the shoelace formula
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec3 a(outline[i]);
        const glm::dvec3 b(outline[(i + 1) % outline.size()]);
        area += 0.5 * (a.x * b.y - a.y * b.x);
    }
    expect_covered(outline, area);
}

TEST(PolygonTriangulation, KeepsTheOrientationInAnyPlane)
{
    const std::vector<glm::vec3> outline = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 1, 0}, {0, 4, 0}};
    for (int turn = 0; turn < 3; ++turn) {
        for (const bool reversed : {false, true}) {
            std::vector<glm::vec3> turned;
            for (const glm::vec3& p : outline) {
                turned.emplace_back(p[turn], p[(turn + 1) % 3], p[(turn + 2) % 3]);
            }
            if (reversed) {
                std::reverse(turned.begin(), turned.end());
            }
            const TriangleMesh mesh = triangulated(turned);
            glm::dvec3 sum(0.0);
            for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
                sum += area_vector(mesh, i);
            }
            EXPECT_NEAR(glm::length(sum), 10.0, 1e-9);
            EXPECT_NEAR(surface_area(mesh), 10.0, 1e-9);
            EXPECT_NEAR(sum[(5 - turn) % 3], reversed ? -10.0 : 10.0, 1e-9);
        }
    }
}

TEST(PolygonTriangulation, EndsOnDegenerateAndCrossingPolygons)
{
    EXPECT_TRUE(triangulated({}).triangles.empty());
    EXPECT_TRUE(triangulated({{0, 0, 0}, {1, 0, 0}}).triangles.empty());
    EXPECT_EQ(triangulated({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}).triangles.size(), 1u);
    EXPECT_EQ(triangulated({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}}).triangles.size(), 3u);
    EXPECT_EQ(triangulated(std::vector<glm::vec3>(7, glm::vec3(1.0f))).triangles.size(), 5u);
    EXPECT_EQ(triangulated({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).triangles.size(), 2u); // a bow tie
}

} // namespace
} // namespace meltpoint
