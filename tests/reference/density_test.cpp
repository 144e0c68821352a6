#include "reference/density.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "reference/fluid_fixture.h"

namespace meltpoint::reference {
namespace {

constexpr double D = 0.02;

class ReferenceDensity : public testing::TestWithParam<std::uint32_t> {
protected:
    const double ratio = GetParam() == shared::KERNEL_PAPER ? 2.0 : 3.0;
    Settings settings = make_settings(GetParam(), D, ratio);
    State state;

    void update() { update_density(settings, state, find_neighbors(settings.params, state.position)); }
    [[nodiscard]] std::size_t nearest(const glm::dvec3& position) const
    {
        std::size_t best = 0;
        for (std::size_t i = 0; i < state.size(); ++i) {
            if (glm::distance(state.position[i], position) < glm::distance(state.position[best], position)) {
                best = i;
            }
        }
        return best;
    }
};

INSTANTIATE_TEST_SUITE_P(Kernels, ReferenceDensity, testing::Values(shared::KERNEL_PAPER, shared::KERNEL_WENDLAND),
                         [](const auto& test) { return test.param == shared::KERNEL_PAPER ? "Paper" : "Wendland"; });

TEST_P(ReferenceDensity, TwoParticlesOfDifferentMassMatchTheFormula)
{
    add_particle(state, {0.5, 0.5, 0.5}, D);
    add_particle(state, {0.5, 0.5 + D, 0.5}, D);
    state.mass[1] *= 3.0;
    update();
    const double h = ratio * D;
    const double q = 1.0 / ratio;
    const double self = GetParam() == shared::KERNEL_PAPER ? 315.0 / 64.0 : 21.0 / 2.0;
    const double shape =
        GetParam() == shared::KERNEL_PAPER ? std::pow(1.0 - q * q, 3) : std::pow(1.0 - q, 4) * (1.0 + 4.0 * q);
    const double moment = lattice_moments(GetParam(), h, D).density;
    const double number = self / (std::numbers::pi * h * h * h) * (1.0 + shape) / moment;
    EXPECT_NEAR(state.density[0], state.mass[0] * number, 1e-5 * state.density[0]);
    EXPECT_NEAR(state.density[1], state.mass[1] * number, 1e-5 * state.density[1]);
}

TEST_P(ReferenceDensity, InteriorOfALatticeHasRestDensity)
{
    add_lattice(state, glm::dvec3(0.4), glm::ivec3(9), D);
    update();
    EXPECT_NEAR(state.density[nearest(glm::dvec3(0.4 + 4 * D))], 1000.0, 1e-3);
    EXPECT_LT(state.density[0], 600.0); // a corner in free space
}

TEST_P(ReferenceDensity, LatticeFillingABoxHasRestDensityAtEveryWallEdgeAndCorner)
{
    const int n = 10;
    settings.params.domain_max = glm::vec3(static_cast<float>(n * D));
    settings.params.wall_mask = 63;
    add_lattice(state, glm::dvec3(0.5 * D), glm::ivec3(n), D);
    update();
    for (std::size_t i = 0; i < state.size(); ++i) {
        EXPECT_NEAR(state.density[i], 1000.0, 1e-2)
            << "at " << state.position[i].x / D << " " << state.position[i].y / D << " " << state.position[i].z / D
            << " spacings";
    }
}

TEST_P(ReferenceDensity, WallsOfTheMaskOnly)
{
    add_particle(state, {0.3 * D, 0.5, 0.5}, D);
    add_particle(state, {1.0 - 0.3 * D, 0.5, 0.5}, D);
    add_particle(state, {0.5, 0.3 * D, 0.5}, D);
    add_particle(state, {0.5, 0.5, 1.0 - 0.3 * D}, D);
    settings.params.wall_mask = (1u << 1) | (1u << 2); // maximum of x, minimum of y
    update();
    EXPECT_NEAR(state.density[0], state.density[3], 1e-9);
    EXPECT_NEAR(state.density[1], state.density[2], 1e-3);
    EXPECT_GT(state.density[1], state.density[0] + 50.0);
}

TEST(StateEquation, Linear)
{
    shared::SphParams params{};
    params.state_equation = shared::STATE_EQUATION_LINEAR;
    params.speed_of_sound = 20.0f;
    EXPECT_DOUBLE_EQ(pressure(params, 1010.0, 1000.0), 4000.0);
    EXPECT_DOUBLE_EQ(pressure(params, 990.0, 1000.0), -4000.0);
    params.background_pressure = 100.0f;
    EXPECT_DOUBLE_EQ(pressure(params, 1010.0, 1000.0), 4100.0);
    params.clamp_pressure = 1;
    EXPECT_DOUBLE_EQ(pressure(params, 1010.0, 1000.0), 4100.0);
    EXPECT_EQ(pressure(params, 990.0, 1000.0), 0.0);
}

TEST(StateEquation, TaitHasTheSpeedOfSoundAtRest)
{
    shared::SphParams params{};
    params.state_equation = shared::STATE_EQUATION_TAIT;
    params.speed_of_sound = 20.0f;
    params.gamma = 7.0f;
    EXPECT_EQ(pressure(params, 1000.0, 1000.0), 0.0);
    const double slope = (pressure(params, 1000.001, 1000.0) - pressure(params, 999.999, 1000.0)) / 0.002;
    EXPECT_NEAR(slope, 400.0, 1e-3);
    EXPECT_NEAR(pressure(params, 1100.0, 1000.0), 400000.0 / 7.0 * (std::pow(1.1, 7.0) - 1.0), 1e-6);
}

} // namespace
} // namespace meltpoint::reference
