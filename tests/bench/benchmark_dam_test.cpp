// The scenes benchmark_dam*: the work that other engines have been measured on.
#include <string>

#include <gtest/gtest.h>

#include "run/fluid_settings.h"
#include "run/scene_particles.h"
#include "scene/scene_file.h"

namespace meltpoint {
namespace {

TEST(BenchmarkDam, ScenesAreAsSpecified)
{
    for (const std::uint32_t n : {20u, 25u, 32u, 40u, 50u}) {
        SCOPED_TRACE(n);
        const Scene scene = builtin_scene(n == 32 ? "benchmark_dam" : "benchmark_dam_" + std::to_string(n));
        const double d = 1.0 / n;
        const ParticleSet set = make_particles(scene, 1'000'000);
        ASSERT_EQ(set.size(), n * n * n);
        glm::vec3 low(1e9f);
        glm::vec3 high(-1e9f);
        for (const glm::vec3& x : set.position) {
            low = glm::min(low, x);
            high = glm::max(high, x);
        }
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(static_cast<double>(low[axis]), d, 1e-5 * d);
            EXPECT_NEAR(static_cast<double>(high[axis]), n * d, 1e-5 * d);
        }
        EXPECT_NEAR(static_cast<double>(set.mass[0]), 1000.0 * d * d * d, 1e-3 * d * d * d);

        const shared::SphParams params = fluid_settings(scene, set).simulation.params;
        EXPECT_NEAR(static_cast<double>(params.support_radius), 2.0 * d, 1e-6 * d);
        EXPECT_NEAR(static_cast<double>(params.dt), d / 50.0, 1e-6 * d);
        EXPECT_NEAR(static_cast<double>(params.domain_max.x), 2.0 + d, 1e-6);
        EXPECT_NEAR(static_cast<double>(params.domain_max.y), 1.5, 1e-6);
        EXPECT_NEAR(static_cast<double>(params.domain_max.z), 1.0 + d, 1e-6);
        EXPECT_EQ(params.gravity, glm::vec3(0.0f, -9.81f, 0.0f));
        EXPECT_EQ(params.state_equation, shared::STATE_EQUATION_TAIT);
        const double c0 = static_cast<double>(params.speed_of_sound);
        EXPECT_NEAR(1000.0 * c0 * c0 / static_cast<double>(params.gamma), 50'000.0, 1.0);
        EXPECT_FLOAT_EQ(params.viscosity[0] / params.rest_density[0], 0.01f);
        EXPECT_EQ(params.wall_viscosity, 0.0f);
        EXPECT_EQ(params.surface_tension, 0.0f);
    }
}

} // namespace
} // namespace meltpoint
