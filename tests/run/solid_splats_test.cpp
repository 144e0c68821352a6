// The surface of a scene's solids: splats, their hosts, and what looks how.
#include <cmath>

#include <gtest/gtest.h>

#include "run/scene_particles.h"
#include "run/solid_splats.h"
#include "scene/scene_file.h"

namespace meltpoint {
namespace {

constexpr std::uint64_t no_limit = 10'000'000;
constexpr double spacing = 0.05;

Scene block_scene()
{
    Scene scene;
    scene.particles.spacing = static_cast<float>(spacing);
    SolidBody block;
    block.shape = BlockShape{.min = {0.0f, 0.5f, 0.0f}, .max = {0.5f, 1.0f, 0.5f}};
    block.solid_color = {0.1f, 0.2f, 0.3f};
    scene.solids.push_back(block);
    return scene;
}

SolidSurface surface_of(const Scene& scene, std::uint64_t limit = no_limit)
{
    return make_solid_surface(scene, make_particles(scene, no_limit), limit);
}

/// Where a splat is and faces, as the device finds it out of where its hosts are.
struct Placed {
    glm::vec3 center;
    glm::vec3 normal;
    glm::vec3 edge; ///< the point of its edge that is nearest to its center
};

Placed place(const shared::HostedSplat& splat, const std::vector<glm::vec3>& positions)
{
    const glm::vec3 a = positions[splat.host.x];
    const glm::vec3 first = positions[splat.host.y] - a;
    const glm::vec3 second = positions[splat.host.z] - a;
    const glm::mat3 frame(first, second, glm::cross(first, second) / static_cast<float>(spacing));
    const glm::vec3 center = a + frame * splat.offset;
    return {center, frame * splat.normal, center + splat.edge_distance * (frame * splat.edge)};
}

TEST(SolidSurface, SplatsLieOnTheSolidAndTheirHostsBelow)
{
    const Scene scene = block_scene();
    const ParticleSet particles = make_particles(scene, no_limit);
    const SolidSurface surface = make_solid_surface(scene, particles, no_limit);
    const double apart = static_cast<double>(shared::SURFACE_SPLAT_SPACING) * spacing;
    EXPECT_NEAR(static_cast<double>(surface.splats.size()), 6.0 * 0.25 / (apart * apart), 10.0);
    for (const shared::HostedSplat& splat : surface.splats) {
        const Placed at = place(splat, particles.position);
        const glm::vec3 from_middle = glm::abs(at.center - glm::vec3(0.25f, 0.75f, 0.25f));
        EXPECT_NEAR(std::max({from_middle.x, from_middle.y, from_middle.z}), 0.25f, 1e-4f);
        EXPECT_NEAR(glm::length(at.normal), 1.0f, 1e-4f);
        EXPECT_NEAR(splat.weight.x + splat.weight.y + splat.weight.z, 1.0f, 1e-5f);
        EXPECT_EQ(splat.color, glm::vec3(0.1f, 0.2f, 0.3f));
        for (int k = 0; k < 3; ++k) {
            const glm::vec3 way = particles.position[splat.host[k]] - at.center;
            EXPECT_LT(glm::length(way), 2.5f * static_cast<float>(spacing));
            EXPECT_LT(glm::dot(way, at.normal), 0.0f);
        }
    }
}

TEST(SolidSurface, SplatsMoveAndTurnWithTheirHosts)
{
    const Scene scene = block_scene();
    const ParticleSet particles = make_particles(scene, no_limit);
    const SolidSurface surface = make_solid_surface(scene, particles, no_limit);
    const glm::mat3 turn(0, 0, -1, 0, 1, 0, 1, 0, 0); // a quarter about y
    std::vector<glm::vec3> moved;
    for (const glm::vec3& x : particles.position) {
        moved.push_back(turn * x + glm::vec3(1.0f, 2.0f, 3.0f));
    }
    for (const shared::HostedSplat& splat : surface.splats) {
        const Placed before = place(splat, particles.position);
        const Placed after = place(splat, moved);
        EXPECT_LT(glm::distance(after.center, turn * before.center + glm::vec3(1.0f, 2.0f, 3.0f)), 1e-4f);
        EXPECT_LT(glm::distance(after.normal, turn * before.normal), 1e-4f);
    }
}

TEST(SolidSurface, DiscsEndAtSharpEdges)
{
    const Scene scene = block_scene();
    const ParticleSet particles = make_particles(scene, no_limit);
    std::size_t at_edges = 0;
    for (const shared::HostedSplat& splat : make_solid_surface(scene, particles, no_limit).splats) {
        const Placed at = place(splat, particles.position);
        const glm::vec3 way = glm::abs(at.center - glm::vec3(0.25f, 0.75f, 0.25f));
        const float to_edge = 0.25f - (way.x + way.y + way.z - std::max({way.x, way.y, way.z}) -
                                       std::min({way.x, way.y, way.z})); // the middle one of three
        if (to_edge < splat.radius) {
            EXPECT_NEAR(splat.edge_distance, to_edge, 1e-4f);
            const glm::vec3 edge = glm::abs(at.edge - glm::vec3(0.25f, 0.75f, 0.25f));
            EXPECT_GE(int{edge.x > 0.2499f} + int{edge.y > 0.2499f} + int{edge.z > 0.2499f}, 2);
            ++at_edges;
        } else if (to_edge > splat.radius + static_cast<float>(spacing)) {
            EXPECT_GT(splat.edge_distance, 1.0f);
        }
    }
    EXPECT_GT(at_edges, 300u);
}

TEST(SolidSurface, ParticlesInTheUpperLayersAreCovered)
{
    const Scene scene = block_scene();
    const ParticleSet particles = make_particles(scene, no_limit);
    const SolidSurface surface = make_solid_surface(scene, particles, no_limit);
    ASSERT_EQ(surface.cover.size(), particles.size());
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const glm::vec3 way = glm::abs(particles.position[i] - glm::vec3(0.25f, 0.75f, 0.25f));
        const double depth = (0.25 - static_cast<double>(std::max({way.x, way.y, way.z}))) / spacing;
        wrong += (surface.cover[i] != shared::NO_COVER) != (depth < 2.0) ? 1 : 0;
        if (depth < 1.0 && surface.cover[i] != shared::NO_COVER) {
            const Placed above = place(surface.splats[surface.cover[i]], particles.position);
            EXPECT_LT(glm::distance(above.center, particles.position[i]), static_cast<float>(0.75 * spacing));
        }
    }
    EXPECT_LE(wrong, 5u); // between splats that lie farther apart than most
}

TEST(SolidSurface, WhereSolidsTouchThereIsNone)
{
    Scene scene = block_scene();
    SolidBody on_top = scene.solids.front();
    on_top.shape = BlockShape{.min = {0.0f, 1.0f, 0.0f}, .max = {0.5f, 1.5f, 0.5f}};
    const std::size_t faces = surface_of(scene).splats.size();
    scene.solids.push_back(on_top);
    const auto both = static_cast<double>(surface_of(scene).splats.size());
    EXPECT_NEAR(both, static_cast<double>(faces) * 10.0 / 6.0, 30.0);
}

TEST(SolidSurface, FewerSplatsFitWhereThereIsLittleRoom)
{
    const Scene scene = block_scene();
    const SolidSurface small = surface_of(scene, 500);
    EXPECT_LE(small.splats.size(), 500u);
    EXPECT_GT(small.splats.size(), 400u);
    EXPECT_GT(small.splats.front().radius, 1.5f * surface_of(scene).splats.front().radius);
}

TEST(SolidSplatParams, SayWhatFreesASolid)
{
    Scene scene = block_scene();
    EXPECT_EQ(solid_splat_params(scene).progress, 0u);
    scene.solids.front().dissolve.speed = 0.25f;
    const shared::SolidSplatParams front = solid_splat_params(scene);
    EXPECT_EQ(front.progress, shared::PROGRESS_FRONT);
    EXPECT_FLOAT_EQ(front.front_time[0], 0.2f); // a spacing
    EXPECT_EQ(front.wet_albedo[0], 0.6f);
    const shared::SolidSplatParams ice = solid_splat_params(builtin_scene("melt_cube"));
    EXPECT_EQ(ice.progress, shared::PROGRESS_MELTING);
    EXPECT_EQ(ice.latent_heat[0], 334e3f);
    EXPECT_GT(ice.wet_albedo[0], 0.9f);
    EXPECT_EQ(solid_splat_params(builtin_scene("river_bed")).progress, shared::PROGRESS_DAMAGE);
    EXPECT_TRUE(has_solid_splats(builtin_scene("river_bed")));
    EXPECT_FALSE(has_solid_splats(builtin_scene("drop")));
}

} // namespace
} // namespace meltpoint
