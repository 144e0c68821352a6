#include "geometry/winding_number.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"
#include "geometry/builtin_meshes.h"
#include "geometry/teapot.h"

namespace meltpoint {
namespace {

/// Points in the mesh's box, enlarged by a tenth of its size on every side.
std::vector<glm::dvec3> points_around(const TriangleMesh& mesh, int count)
{
    const Aabb box = bounds(mesh);
    std::vector<glm::dvec3> points;
    Random random(11);
    for (int i = 0; i < count; ++i) {
        glm::dvec3 share;
        for (int axis = 0; axis < 3; ++axis) {
            share[axis] = 1.2 * random.uniform() - 0.1;
        }
        points.push_back(glm::dvec3(box.min) + share * glm::dvec3(box.size()));
    }
    return points;
}

TEST(WindingNumber, IsOneInsideAndZeroOutsideOfClosedMeshes)
{
    for (const glm::dvec3& point : points_around(builtin_mesh("cube"), 1000)) {
        const glm::dvec3 q = glm::abs(point);
        const double inside = std::max({q.x, q.y, q.z}) < 0.5 ? 1.0 : 0.0;
        EXPECT_NEAR(winding_number_exact(builtin_mesh("cube"), point), inside, 1e-12);
    }
    const TriangleMesh torus = builtin_mesh("torus");
    const WindingNumber winding(torus);
    for (const glm::dvec3& point : points_around(torus, 2000)) {
        const double tube = std::hypot(std::hypot(point.x, point.z) - 1.0, point.y);
        if (std::abs(tube - 0.4) > 0.01) {
            EXPECT_NEAR(winding.at(point), tube < 0.4 ? 1.0 : 0.0, 0.01);
        }
    }
}

TEST(WindingNumber, HierarchicalAgreesWithBruteForce)
{
    for (const TriangleMesh& mesh : {teapot(10), builtin_mesh("sphere"), builtin_mesh("torus")}) {
        const WindingNumber winding(mesh);
        for (const glm::dvec3& point : points_around(mesh, 100)) {
            const double exact = winding_number_exact(mesh, point);
            EXPECT_NEAR(winding.at(point), exact, 0.01);
            EXPECT_NEAR(winding.at(point, 1.25), exact, 0.1);
            EXPECT_NEAR(winding.at(point, 6.0), exact, 0.001);
        }
    }
}

TEST(WindingNumber, CountsTheLayersOfAnOverlap)
{
    TriangleMesh two = builtin_mesh("cube");
    TriangleMesh other = builtin_mesh("cube");
    for (const glm::vec3& position : other.positions) {
        two.positions.push_back(position + glm::vec3(0.5f, 0.0f, 0.0f));
    }
    for (const glm::uvec3& triangle : other.triangles) {
        two.triangles.push_back(triangle + 8u);
    }
    const WindingNumber winding(two);
    EXPECT_NEAR(winding.at({-0.25, 0.1, 0.0}), 1.0, 1e-9);
    EXPECT_NEAR(winding.at({0.25, 0.1, 0.0}), 2.0, 1e-9);
    EXPECT_NEAR(winding.at({0.75, 0.1, 0.0}), 1.0, 1e-9);
    EXPECT_NEAR(winding.at({1.25, 0.1, 0.0}), 0.0, 1e-9);
}

TEST(WindingNumber, TheOpenTeapotIsFilledWithoutASpike)
{
    const TriangleMesh mesh = builtin_mesh("teapot");
    const WindingNumber winding(mesh);
    const auto inside = [&](double x, double y, double z) {
        return winding.at({x, y, z}) >= 0.5;
    };
    EXPECT_TRUE(inside(0.0, 1.0, 0.0));   // the body's middle
    EXPECT_TRUE(inside(1.9, 0.9, 0.0));   // where spout and body overlap
    EXPECT_TRUE(inside(2.5, 1.7, 0.0));   // in the spout
    EXPECT_TRUE(inside(0.0, 2.95, 0.0));  // in the knob
    EXPECT_TRUE(inside(-2.6, 2.05, 0.0)); // in the handle
    EXPECT_FALSE(inside(-2.3, 1.6, 0.0)); // between handle and body
    // Out of the spout's mouth, up from the gap around the lid, and through the handle's ends.
    for (double way = 0.0; way < 3.0; way += 0.01) {
        EXPECT_FALSE(inside(3.0 + way, 2.45 + 0.3 + way, 0.0));
        EXPECT_FALSE(inside(3.0, 2.45 + 0.1 + way, 0.0)) << way;
        EXPECT_FALSE(inside(1.35, 2.56 + way, 0.0)) << way;
        EXPECT_FALSE(inside(0.0, 3.16 + way, 0.0)) << way;
        EXPECT_FALSE(inside(0.0, -0.01 - way, 0.0)) << way;
    }
}

TEST(WindingNumber, MayTouchBoxNeverMissesATriangle)
{
    const TriangleMesh torus = builtin_mesh("torus");
    const WindingNumber winding(torus);
    int free = 0;
    for (const glm::dvec3& point : points_around(torus, 2000)) {
        const double distance = std::abs(std::hypot(std::hypot(point.x, point.z) - 1.0, point.y) - 0.4);
        const glm::dvec3 reach(distance + 0.001); // facets lie up to 0.0005 inside
        EXPECT_TRUE(winding.may_touch_box(point - reach, point + reach));
        const glm::dvec3 less(std::max(distance - 0.06, 0.0) / std::sqrt(3.0));
        free += winding.may_touch_box(point - less, point + less) ? 0 : 1;
    }
    EXPECT_GT(free, 1000);
}

} // namespace
} // namespace meltpoint
