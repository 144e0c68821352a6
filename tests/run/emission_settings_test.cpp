// What emitters of a scene become on the device: how much they bring, and where.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "run/emission_settings.h"
#include "run/fluid_settings.h"
#include "run/plane_scene.h"
#include "run/scene_particles.h"

namespace meltpoint {
namespace {

Scene scene_with(EmitterShape shape, const glm::vec3& velocity)
{
    Scene scene;
    scene.particles.spacing = 0.02f;
    scene.time.frame_rate = 30.0f;
    scene.time.frames = 61; // 2 s
    EmitterBody emitter{.shape = std::move(shape), .velocity = velocity};
    emitter.fluid.rest_density = 800.0f;
    scene.emitters.push_back(emitter);
    return scene;
}

/// kg/s that comes out.
double flow(const Scene& scene, const shared::Emitter& emitter)
{
    return emitter.points * emitted_mass(scene, scene.emitters[0]) / static_cast<double>(emitter.period);
}

TEST(EmissionSettings, AJetBringsDensityTimesAreaTimesSpeed)
{
    for (const glm::vec3 velocity : {glm::vec3(2.0f, 0.0f, 0.0f), glm::vec3(0.3f, -1.1f, 0.7f)}) {
        const Scene scene = scene_with(JetShape{.center = {0.1f, 1.0f, 0.2f}, .radius = 0.07f}, velocity);
        const sim::EmissionSettings settings = emission_settings(scene, 5);
        ASSERT_EQ(settings.emitters.size(), 1u);
        const shared::Emitter& jet = settings.emitters[0];
        const double speed = static_cast<double>(glm::length(velocity));
        const double expected = 800.0 * std::numbers::pi * 0.07 * 0.07 * speed;
        EXPECT_NEAR(flow(scene, jet) / expected, 1.0, 1e-5);
        EXPECT_NEAR(static_cast<double>(jet.period) * speed, 0.02, 0.06 * 0.02); // layers a spacing apart, or nearly so
        EXPECT_EQ(jet.points, settings.points.size());
        EXPECT_EQ(jet.first_id, 5u);
        for (const glm::vec3& point : settings.points) {
            const glm::vec3 offset = point - glm::vec3(0.1f, 1.0f, 0.2f);
            EXPECT_LT(glm::length(offset), 0.07f);
            EXPECT_NEAR(glm::dot(offset, velocity), 0.0f, 1e-6f);
        }
        // As many slots as come in the time of the run.
        const double births = 2.0 / static_cast<double>(jet.period) * jet.points;
        EXPECT_NEAR(jet.slots, births, 2.0 * jet.points);
        EXPECT_EQ(jet.births, 4294967295u);
    }
}

TEST(EmissionSettings, AnInflowBringsWhatPassesItsRectangle)
{
    Scene scene = scene_with(InflowShape{.min = {0.0f, 0.1f, -0.2f}, .max = {0.0f, 0.4f, 0.3f}}, {-1.5f, 0.4f, 0.0f});
    scene.emitters[0].start = 0.5f;
    scene.emitters[0].stop = 0.75f;
    const sim::EmissionSettings settings = emission_settings(scene, 0);
    const shared::Emitter& inflow = settings.emitters[0];
    EXPECT_NEAR(flow(scene, inflow) / (800.0 * 0.3 * 0.5 * 1.5), 1.0, 1e-5);
    EXPECT_NEAR(inflow.births, 0.25 / static_cast<double>(inflow.period) * inflow.points, inflow.points);
    EXPECT_EQ(inflow.slots, inflow.births);
    for (const glm::vec3& point : settings.points) {
        EXPECT_EQ(point.x, 0.0f);
        EXPECT_TRUE(point.y > 0.1f && point.y < 0.4f && point.z > -0.2f && point.z < 0.3f);
    }
}

TEST(EmissionSettings, RainFallsAtItsRateEverywhere)
{
    const Scene scene = scene_with(RainShape{.min = {-0.5f, 1.9f, -0.5f}, .max = {0.5f, 1.9f, 0.5f}, .rate = 2.0f},
                                   {0.0f, -3.0f, 0.0f});
    const sim::EmissionSettings settings = emission_settings(scene, 0);
    const shared::Emitter& rain = settings.emitters[0];
    EXPECT_NEAR(flow(scene, rain), 2.0, 1e-5);
    constexpr std::uint32_t drops = 4000;
    glm::dvec3 mean(0.0);
    glm::dvec3 mean_square(0.0);
    double last = 0.0;
    double sum_of_gaps2 = 0.0;
    for (std::uint32_t k = 0; k < drops; ++k) {
        glm::dvec3 u;
        for (int axis = 0; axis < 3; ++axis) {
            u[axis] = static_cast<double>(shared::birth_random(rain, k, static_cast<std::uint32_t>(axis)));
        }
        mean += u / static_cast<double>(drops);
        mean_square += u * u / static_cast<double>(drops);
        const double time = static_cast<double>(shared::birth_time(rain, k));
        EXPECT_GE(time, last);
        sum_of_gaps2 += std::pow((time - last) / static_cast<double>(rain.period), 2);
        last = time;
    }
    for (int axis = 0; axis < 3; ++axis) {
        EXPECT_NEAR(mean[axis], 0.5, 0.02);
        EXPECT_NEAR(mean_square[axis], 1.0 / 3.0, 0.02);
    }
    EXPECT_NEAR(sum_of_gaps2 / drops, 1.0 + 1.0 / 6.0, 0.03); // 1 + 2 Var(u): at random, not in step
}

TEST(EmissionSettings, InThePlaneEmittersAreLines)
{
    Scene scene = scene_with(JetShape{.center = {0.1f, 1.0f, 9.0f}, .radius = 0.1f}, {1.0f, 1.0f, 0.0f});
    scene.domain.dimensions = 2;
    const Scene flat = in_its_dimensions(scene);
    const sim::EmissionSettings settings = emission_settings(flat, 0);
    EXPECT_EQ(settings.emitters[0].points, 10u);
    EXPECT_NEAR(flow(flat, settings.emitters[0]) / (800.0 * 0.2 * std::sqrt(2.0)), 1.0, 1e-5);
    for (const glm::vec3& point : settings.points) {
        EXPECT_EQ(point.z, 0.0f);
        EXPECT_NEAR(point.x - 0.1f, 1.0f - point.y, 1e-6f);
    }
}

TEST(EmissionSettings, SlotsAreDeadParticlesBeforeTheColliders)
{
    Scene scene = scene_with(JetShape{.center = {0.0f, 1.0f, 0.0f}, .radius = 0.05f}, {2.0f, 0.0f, 0.0f});
    scene.fluids.push_back({.shape = BlockShape{{-0.2f, 0.0f, -0.2f}, {0.2f, 0.2f, 0.2f}}});
    scene.colliders.push_back({.shape = SphereShape{{0.5f, 0.5f, 0.5f}, 0.1f}});
    scene.emitters[0].particles = 333;
    const ParticleSet set = make_particles(scene, 100'000);
    const auto dead = std::ranges::count_if(set.attributes, shared::is_gone);
    EXPECT_EQ(dead, 333);
    const sim::EmissionSettings settings = emission_settings(scene, set);
    const shared::Emitter& jet = settings.emitters[0];
    for (std::uint32_t id = jet.first_id; id < jet.first_id + jet.slots; ++id) {
        EXPECT_TRUE(shared::is_gone(set.attributes[id]));
        EXPECT_NEAR(set.mass[id], 800.0f * 8e-6f, 1e-9f);
        EXPECT_EQ(set.weight[id], 0.0f);
    }
    EXPECT_EQ(set.release_time.size(), set.size());
    const FluidSettings all = fluid_settings(scene, set);
    EXPECT_EQ(all.simulation.emission.emitters[0].first_id, jet.first_id);
    EXPECT_TRUE(all.simulation.options.still);
    EXPECT_GE(expected_speed(scene, set), 2.0);
}

TEST(EmissionSettings, MoreThanThereIsRoomForIsRefused)
{
    Scene scene = scene_with(JetShape{.center = {0.0f, 1.0f, 0.0f}, .radius = 0.05f}, {2.0f, 0.0f, 0.0f});
    const auto complaint = [](const Scene& of) -> std::string {
        try {
            (void)make_particles(of, 1000);
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    };
    EXPECT_NE(complaint(scene).find("give it fewer with emitter.0.particles"), std::string::npos);
    scene.emitters[0].particles = 1000;
    EXPECT_EQ(complaint(scene), "");
    scene.emitters[0].particles = 1001;
    EXPECT_NE(complaint(scene).find("emitter.0 has 1001 particles"), std::string::npos);
    scene.emitters[0].velocity *= 1e5f;
    scene.time.frames = 1'000'000;
    scene.emitters[0].particles.reset();
    EXPECT_NE(complaint(scene).find("would bring about"), std::string::npos);
}

} // namespace
} // namespace meltpoint
