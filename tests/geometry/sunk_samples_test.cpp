#include "geometry/sunk_samples.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

namespace meltpoint {
namespace {

constexpr float pitch = 0.05f;
constexpr double depth = 0.06;

/// Points all over a block of that size around the origin, with their normals.
PointCloud block_surface(const glm::vec3& size)
{
    PointCloud cloud;
    for (int axis = 0; axis < 3; ++axis) {
        const int u = (axis + 1) % 3;
        const int v = (axis + 2) % 3;
        for (float a = 0.5f * pitch - 0.5f * size[u]; a < 0.5f * size[u]; a += pitch) {
            for (float b = 0.5f * pitch - 0.5f * size[v]; b < 0.5f * size[v]; b += pitch) {
                for (const float side : {-1.0f, 1.0f}) {
                    glm::vec3 x(0.0f);
                    glm::vec3 normal(0.0f);
                    x[axis] = 0.5f * side * size[axis];
                    x[u] = a;
                    x[v] = b;
                    normal[axis] = side;
                    cloud.positions.push_back(x);
                    cloud.normals.push_back(normal);
                }
            }
        }
    }
    return cloud;
}

Aabb box_of(const glm::vec3& size)
{
    return {-0.5f * size, 0.5f * size};
}

const Aabb everywhere{glm::vec3(-10.0f), glm::vec3(10.0f)};

TEST(SunkSamples, LieOneDepthBelowFacesAndCloseAlongEdges)
{
    const glm::vec3 size(1.0f, 0.8f, 0.6f);
    const PointCloud cloud = block_surface(size);
    const std::vector<glm::vec3> sunk = sink_samples(cloud, BoxSolid(box_of(size)), depth, everywhere);
    EXPECT_LT(sunk.size(), cloud.size());
    EXPECT_GT(sunk.size(), cloud.size() * 7 / 10);
    for (const glm::vec3& x : sunk) {
        const glm::vec3 below = 0.5f * size - glm::abs(x); // each face
        ASSERT_GE(std::min({below.x, below.y, below.z}), 0.4f * static_cast<float>(depth));
    }
    // Fluid finds no way in: every place on the surface one depth down has one near.
    for (const glm::vec3& x : cloud.positions) {
        const glm::vec3 inner =
            glm::clamp(x, -0.5f * size + static_cast<float>(depth), 0.5f * size - static_cast<float>(depth));
        float nearest = std::numeric_limits<float>::infinity();
        for (const glm::vec3& y : sunk) {
            nearest = std::min(nearest, glm::distance(inner, y));
        }
        ASSERT_LE(nearest, pitch);
    }
}

TEST(SunkSamples, GoHalfwayThroughWhatIsThinAndStayWhereNothingIsInside)
{
    const glm::vec3 thin(1.0f, 0.06f, 1.0f);
    for (const glm::vec3& x : sink_samples(block_surface(thin), BoxSolid(box_of(thin)), depth, everywhere)) {
        ASSERT_LE(std::abs(x.y), 0.5f * thin.y);
        if (std::max(std::abs(x.x), std::abs(x.z)) < 0.4f) {
            ASSERT_LE(std::abs(x.y), 0.25f * static_cast<float>(depth) + 1e-6f); // probed at quarters
        }
    }
    const glm::vec3 flat(1.0f, 0.0f, 1.0f);
    PointCloud plate = block_surface(flat);
    EXPECT_EQ(sink_samples(plate, BoxSolid(box_of(glm::vec3(0.0f))), depth, everywhere), plate.positions);
    plate.normals.assign(plate.size(), glm::vec3(0.0f)); // unknown
    EXPECT_EQ(sink_samples(plate, BoxSolid(box_of(glm::vec3(2.0f))), depth, everywhere), plate.positions);
}

TEST(SunkSamples, ReachDownToAWallThatTheyStandOn)
{
    const glm::vec3 size(0.6f);
    const auto lowest = [&](const Aabb& open) {
        float y = 1.0f;
        for (const glm::vec3& x : sink_samples(block_surface(size), BoxSolid(box_of(size)), depth, open)) {
            y = std::min(y, x.y);
        }
        return y;
    };
    EXPECT_LT(lowest({glm::vec3(-1.0f, -0.3f + 0.01f, -1.0f), glm::vec3(1.0f)}), -0.3f + 0.5f * pitch + 1e-6f);
    EXPECT_GT(lowest(everywhere), -0.3f + 0.4f * static_cast<float>(depth));
}

} // namespace
} // namespace meltpoint
