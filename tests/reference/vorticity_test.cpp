#include "reference/vorticity.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "reference/density.h"
#include "reference/fluid_fixture.h"

namespace meltpoint::reference {
namespace {

constexpr double D = 0.02;

class ReferenceVorticity : public testing::Test {
protected:
    ReferenceVorticity()
    {
        settings.params.xsph = 0.3f;
        settings.params.vorticity_confinement = 2.0f;
    }

    /// A jittered cube of fluid of two masses, with a boundary particle in it that would be fast.
    void add_everything()
    {
        add_lattice(state, glm::dvec3(0.4), glm::ivec3(7), D);
        Random random(4);
        for (std::size_t i = 0; i < state.size(); ++i) {
            state.position[i] += 0.2 * D * random_vector(random);
            state.velocity[i] = random_vector(random);
            state.mass[i] *= i % 3 == 0 ? 0.6 : 1.0;
        }
        find();
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

TEST_F(ReferenceVorticity, XsphKeepsMomentumWhateverTheMassesAndTakesEnergy)
{
    add_everything();
    const State before = state;
    smooth_velocities(settings, state, neighbors);
    glm::dvec3 change(0.0);
    double scale = 0.0;
    double energy = 0.0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        change += state.mass[i] * (state.velocity[i] - before.velocity[i]);
        scale += state.mass[i] * glm::length(state.velocity[i] - before.velocity[i]);
        energy += state.mass[i] *
                  (glm::dot(state.velocity[i], state.velocity[i]) - glm::dot(before.velocity[i], before.velocity[i]));
    }
    EXPECT_GT(scale, 1e-3);
    EXPECT_LT(glm::length(change), 1e-13 * scale);
    EXPECT_LT(energy, 0.0);
}

TEST_F(ReferenceVorticity, XsphOfOneIsTheMeanOfTheVelocitiesAround)
{
    settings.params.xsph = 1.0f;
    add_lattice(state, glm::dvec3(0.4), glm::ivec3(7), D);
    find();
    std::ranges::fill(state.density, 1000.0); // of the middle of more
    state.velocity[middle] = {1.0, 0.0, 0.0};
    // The others' weights: all but its own share of the density.
    const double own = static_cast<double>(settings.params.density_scale) * D * D * D;
    const double expected = -(1.0 - own);
    EXPECT_NEAR(smoothing(settings, state, neighbors, middle).value.x, expected, 1e-6);
}

TEST_F(ReferenceVorticity, BoundaryParticlesDoNotDrag)
{
    add_lattice(state, glm::dvec3(0.4), glm::ivec3(7), D);
    for (glm::dvec3& v : state.velocity) {
        v = {1.0, 2.0, 3.0};
    }
    add_boundary_particle(state, {0.47, 0.47, 0.47});
    state.weight.back() = 1.0;
    find();
    for (std::size_t i = 0; i + 1 < state.size(); ++i) {
        EXPECT_EQ(glm::length(smoothing(settings, state, neighbors, i).value), 0.0);
        EXPECT_EQ(glm::length(vorticity(settings, state, neighbors, i).value), 0.0);
    }
}

TEST_F(ReferenceVorticity, ARigidSpinHasTwiceItsRate)
{
    add_lattice(state, glm::dvec3(0.4), glm::ivec3(7), D);
    find();
    std::ranges::fill(state.density, 1000.0);
    const glm::dvec3 spin(0.5, -1.0, 2.0);
    for (std::size_t i = 0; i < state.size(); ++i) {
        state.velocity[i] = glm::dvec3(3.0, 0.0, 0.0) + glm::cross(spin, state.position[i] - 0.46);
    }
    EXPECT_LT(glm::length(vorticity(settings, state, neighbors, middle).value - 2.0 * spin), 1e-5);
}

TEST_F(ReferenceVorticity, ConfinementSpinsAVortexUp)
{
    // About z, fast in the middle: omega falls off with the distance, N points inward, N x omega along the flow.
    add_lattice(state, glm::dvec3(0.4), glm::ivec3(7), D);
    find();
    std::vector<glm::dvec3> vorticities;
    for (std::size_t i = 0; i < state.size(); ++i) {
        const glm::dvec3 r = state.position[i] - glm::dvec3(0.46, 0.46, state.position[i].z);
        vorticities.emplace_back(0.0, 0.0, 10.0 * std::exp(-glm::dot(r, r) / (9.0 * D * D)));
    }
    for (const std::size_t i : {middle + 1, middle - 2, middle + 7, middle - 14}) {
        const glm::dvec3 r = state.position[i] - glm::dvec3(0.46, 0.46, state.position[i].z);
        const glm::dvec3 along = glm::normalize(glm::cross(glm::dvec3(0.0, 0.0, 1.0), r));
        const glm::dvec3 a = confinement(settings, state, neighbors, vorticities, i);
        EXPECT_LT(glm::length(a - 2.0 * glm::length(vorticities[i]) * along), 0.02 * glm::length(a)) << i;
    }
}

TEST_F(ReferenceVorticity, NoStrengthIsNothing)
{
    settings.params.xsph = settings.params.vorticity_confinement = 0.0f;
    add_everything();
    const State before = state;
    smooth_velocities(settings, state, neighbors);
    add_confinement(settings, state, neighbors);
    EXPECT_EQ(state.velocity, before.velocity);
    EXPECT_EQ(state.acceleration, before.acceleration);
}

} // namespace
} // namespace meltpoint::reference
