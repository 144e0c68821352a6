#include "reference/shifting.h"

#include <cmath>

#include <gtest/gtest.h>

#include "reference/density.h"
#include "reference/fluid_fixture.h"

namespace meltpoint::reference {
namespace {

constexpr double D = 0.02;

class ReferenceShifting : public testing::Test {
protected:
    ReferenceShifting()
    {
        settings.params.shifting = 0.05f; // m^2/s
        add_lattice(state, glm::dvec3(0.4), glm::ivec3(7), D);
    }
    void find()
    {
        neighbors = find_neighbors(settings.params, state.position);
        update_density(settings, state, neighbors);
    }

    Settings settings = make_settings(shared::KERNEL_WENDLAND, D, 2.5);
    State state;
    Neighbors neighbors;
    static constexpr std::size_t middle = 3 * 49 + 3 * 7 + 3; // of the cube
};

TEST_F(ReferenceShifting, LeavesALatticeAlone)
{
    find();
    EXPECT_LT(glm::length(shift(settings, state, neighbors, middle)), 1e-12 * D);
}

TEST_F(ReferenceShifting, TakesAParticleBackToItsPlace)
{
    state.position[middle].x += 0.2 * D;
    find();
    const glm::dvec3 moved = shift(settings, state, neighbors, middle);
    EXPECT_LT(moved.x, 0.0);
    EXPECT_LT(std::abs(moved.y) + std::abs(moved.z), 1e-9 * D);
    // By hand: D dt sum_j V_j (1 + 0.2 (W/W(d))^4) (-grad W).
    const double h = 2.5 * D;
    glm::dvec3 expected(0.0);
    for (std::size_t j = 0; j < state.size(); ++j) {
        const glm::dvec3 x = state.position[middle] - state.position[j];
        const double r = glm::length(x);
        if (j == middle || r >= h) {
            continue;
        }
        const double near = density_shape(settings.kernel, r / h) / density_shape(settings.kernel, D / h);
        const double slope =
            static_cast<double>(settings.params.gradient_scale) * gradient_shape(settings.kernel, r / h);
        expected += 0.05 * static_cast<double>(settings.params.dt) * state.mass[j] / state.density[j] *
                    (1.0 + 0.2 * std::pow(near, 4.0)) * slope * x / r;
    }
    EXPECT_LT(glm::distance(moved, expected), 1e-5 * glm::length(expected));
}

TEST_F(ReferenceShifting, GoesNoFartherThanItsCap)
{
    state.position[middle].x += 0.4 * D;
    settings.params.shifting = 1e6f;
    find();
    EXPECT_NEAR(glm::length(shift(settings, state, neighbors, middle)), 0.1 * D, 1e-6 * D);
}

TEST_F(ReferenceShifting, BoundaryParticlesStay)
{
    add_boundary_particle(state, glm::dvec3(0.4 + 3.5 * D));
    state.weight.back() = 0.5;
    find();
    const State before = state;
    shift_particles(settings, state, neighbors);
    EXPECT_EQ(state.position.back(), before.position.back());
    EXPECT_NE(state.position[0], before.position[0]); // a corner: there are none beyond
}

} // namespace
} // namespace meltpoint::reference
