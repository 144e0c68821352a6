#include "run/dust_params.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/random.h"
#include "reference/dust.h"

namespace meltpoint {
namespace {

TEST(DustParams, EddiesHaveTheVelocityAskedForAndNoDivergence)
{
    Scene scene;
    scene.dust.wind = {1.0f, 2.0f, 3.0f};
    scene.dust.turbulence = 0.7f;
    scene.dust.eddy_size = 0.5f;
    for (const std::uint32_t dimensions : {3u, 2u}) {
        SCOPED_TRACE(dimensions);
        scene.domain.dimensions = dimensions;
        const shared::DustParams dust = dust_params(scene);
        const glm::dvec3 wind(1.0, 2.0, dimensions == 2 ? 0.0 : 3.0);
        EXPECT_EQ(glm::dvec3(dust.wind), wind);
        Random random(2);
        double squares = 0.0;
        double divergence = 0.0;
        double gradient = 0.0;
        constexpr int samples = 4000;
        for (int i = 0; i < samples; ++i) {
            const glm::dvec3 x = 10.0 * glm::dvec3(random.uniform(), random.uniform(), random.uniform());
            const double time = 5.0 * random.uniform();
            const glm::dvec3 eddy = reference::air_velocity(dust, x, time) - wind;
            squares += glm::dot(eddy, eddy);
            EXPECT_TRUE(dimensions == 3 || std::abs(eddy.z) < 1e-6);
            constexpr double h = 1e-4;
            double sum = 0.0;
            for (int axis = 0; axis < 3; ++axis) {
                glm::dvec3 step(0.0);
                step[axis] = h;
                const glm::dvec3 change =
                    (reference::air_velocity(dust, x + step, time) - reference::air_velocity(dust, x - step, time)) /
                    (2.0 * h);
                sum += change[axis];
                gradient += glm::dot(change, change);
            }
            divergence += sum * sum;
        }
        EXPECT_NEAR(std::sqrt(squares / samples), 0.7, 0.05);
        EXPECT_LT(std::sqrt(divergence / gradient), 1e-4);
    }
}

TEST(DustParams, TheWindCarriesTheEddies)
{
    Scene scene;
    scene.dust.wind = {3.0f, 0.0f, 0.0f};
    shared::DustParams dust = dust_params(scene);
    for (shared::AirWave& wave : dust.waves) {
        wave.frequency = 0.0f;
    }
    const glm::dvec3 x(0.3, 0.2, 0.7);
    EXPECT_LT(glm::distance(reference::air_velocity(dust, x, 0.0),
                            reference::air_velocity(dust, x + glm::dvec3(6.0, 0.0, 0.0), 2.0)),
              1e-9);
}

TEST(DustParams, SeedsDiffer)
{
    Scene scene;
    const shared::DustParams one = dust_params(scene);
    EXPECT_EQ(one.waves[3].number, dust_params(scene).waves[3].number);
    scene.seed = 2;
    EXPECT_NE(one.waves[3].number, dust_params(scene).waves[3].number);
}

} // namespace
} // namespace meltpoint
