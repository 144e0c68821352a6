#include "reference/step.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "reference/fluid_fixture.h"
#include "reference/integrate.h"
#include "reference/measure.h"

namespace meltpoint::reference {
namespace {

constexpr double D = 0.02;

TEST(ReferenceState, RoundTripsThroughAParticleSet)
{
    ParticleSet particles;
    particles.resize(3);
    particles.attributes[1] = shared::pack_attributes(shared::STATE_DUST, 7);
    particles.position[2] = {1.0f, 2.0f, 3.0f};
    particles.velocity[0] = {0.1f, 0.2f, 0.3f};
    particles.acceleration[1] = {4.0f, 5.0f, 6.0f};
    particles.mass = {1.0f, 0.1f, 0.01f};
    particles.density = {7.0f, 8.0f, 9.0f};
    particles.pressure = {-1.0f, 0.3f, 1e6f};
    const ParticleSet back = to_particle_set(from_particle_set(particles));
    EXPECT_EQ(back.id, particles.id);
    EXPECT_EQ(back.attributes, particles.attributes);
    EXPECT_EQ(back.position, particles.position);
    EXPECT_EQ(back.velocity, particles.velocity);
    EXPECT_EQ(back.acceleration, particles.acceleration);
    EXPECT_EQ(back.mass, particles.mass);
    EXPECT_EQ(back.density, particles.density);
    EXPECT_EQ(back.pressure, particles.pressure);
}

TEST(ReferenceStep, FreeFallIsExact)
{
    Settings settings = make_settings(shared::KERNEL_WENDLAND, D, 3.0);
    settings.params.domain_min = glm::vec3(-10.0f);
    settings.params.gravity = {0.0f, -9.81f, 0.0f};
    State state;
    add_particle(state, {0.5, 0.9, 0.5}, D, {0.3, 1.0, 0.0});
    evaluate(settings, state);
    for (int i = 0; i < 500; ++i) {
        step(settings, state);
    }
    const double t = 500.0 * static_cast<double>(settings.params.dt);
    const double g = static_cast<double>(9.81f);
    EXPECT_NEAR(state.position[0].x, 0.5 + 0.3 * t, 1e-12);
    EXPECT_NEAR(state.position[0].y, 0.9 + t - 0.5 * g * t * t, 1e-12);
    EXPECT_NEAR(state.velocity[0].y, 1.0 - g * t, 1e-12);
    EXPECT_EQ(state.step, 500u);
    EXPECT_EQ(state.status.fault, shared::FAULT_NONE);
}

TEST(ReferenceStep, ClosedSystemKeepsItsMomentumAndLosesEnergy)
{
    for (const std::uint32_t kernel : {shared::KERNEL_PAPER, shared::KERNEL_WENDLAND}) {
        Settings settings = make_settings(kernel, D, 2.3);
        set_viscosity(settings.params, 0.5f);
        State state;
        add_lattice(state, glm::dvec3(0.4), glm::ivec3(6), D);
        Random random(3);
        for (std::size_t i = 0; i < state.size(); ++i) {
            state.velocity[i] = glm::dvec3(0.2, 0.1, -0.3) + 0.5 * random_vector(random);
            state.position[i] += 0.1 * D * random_vector(random);
        }
        const glm::dvec3 before = momentum(state);
        const double energy_before = kinetic_energy(state);
        evaluate(settings, state);
        for (int i = 0; i < 50; ++i) {
            step(settings, state);
        }
        EXPECT_LT(glm::length(momentum(state) - before), 1e-12 * momentum_magnitude(state));
        EXPECT_LT(kinetic_energy(state), energy_before);
        EXPECT_EQ(state.status.fault, shared::FAULT_NONE);
    }
}

TEST(ReferenceStep, HalvingTheStepQuartersTheError)
{
    // Two particles repel each other: Verlet is of second order.
    const auto distance_after = [](int steps) {
        Settings settings = make_settings(shared::KERNEL_WENDLAND, D, 3.0);
        settings.params.background_pressure = 1e5f;
        settings.params.dt = 1e-3f / static_cast<float>(steps);
        State state;
        add_particle(state, {0.5, 0.5, 0.5}, D);
        add_particle(state, {0.5 + 0.9 * D, 0.5, 0.5}, D);
        evaluate(settings, state);
        for (int i = 0; i < steps; ++i) {
            step(settings, state);
        }
        return glm::distance(state.position[0], state.position[1]);
    };
    const double truth = distance_after(4096);
    const double coarse = std::abs(distance_after(16) - truth);
    const double fine = std::abs(distance_after(32) - truth);
    EXPECT_NEAR(coarse / fine, 4.0, 0.2);
}

// --- faults --------------------------------------------------------------------------------------

struct Faults : testing::Test {
    Settings settings = make_settings(shared::KERNEL_PAPER, D, 2.0);
    State state;

    Faults()
    {
        for (int i = 0; i < 5; ++i) {
            add_particle(state, {0.1 + 0.2 * i, 0.5, 0.5}, D);
        }
        state.step = 12;
    }
};

TEST_F(Faults, NoneInsideTheDomain)
{
    state.position[0] = glm::dvec3(settings.params.domain_min);
    state.position[1] = glm::dvec3(settings.params.domain_max);
    drift(settings, state);
    EXPECT_EQ(state.status.fault, shared::FAULT_NONE);
    EXPECT_EQ(state.attributes[0] & shared::FLAG_LEFT_DOMAIN, 0u);
}

TEST_F(Faults, EscapeIsFlaggedAndStaysFlagged)
{
    state.position[2].y = 1.0;
    state.velocity[2].y = 0.1;
    drift(settings, state);
    EXPECT_EQ(state.status.fault, shared::FAULT_ESCAPED);
    EXPECT_EQ(state.status.particle, 2u);
    EXPECT_EQ(state.status.step, 12u);
    state.velocity[2].y = -10.0;
    drift(settings, state);
    EXPECT_LT(state.position[2].y, 1.0);
    EXPECT_NE(state.attributes[2] & shared::FLAG_LEFT_DOMAIN, 0u);
    EXPECT_EQ(shared::particle_state(state.attributes[2]), shared::STATE_FLUID);
}

TEST_F(Faults, TooFastAndNotFinite)
{
    state.velocity[4].z = 10.01;
    drift(settings, state);
    EXPECT_EQ(state.status.fault, shared::FAULT_TOO_FAST);
    EXPECT_EQ(state.status.particle, 4u);

    state.status = {};
    state.velocity[1].x = std::numeric_limits<double>::quiet_NaN();
    drift(settings, state);
    EXPECT_EQ(state.status.fault, shared::FAULT_NOT_FINITE);
    EXPECT_EQ(state.status.particle, 1u);

    state.status = {};
    state.velocity[0].x = std::numeric_limits<double>::infinity();
    drift(settings, state);
    EXPECT_EQ(state.status.fault, shared::FAULT_NOT_FINITE);
    EXPECT_EQ(state.status.particle, 0u);
}

TEST_F(Faults, FirstStepAndSmallestIdAreKept)
{
    state.id = {4, 3, 2, 1, 0};
    state.velocity[1].z = 11.0;
    state.velocity[3].z = 11.0;
    drift(settings, state);
    EXPECT_EQ(state.status.particle, 1u);
    ++state.step;
    state.velocity[4].z = 11.0;
    drift(settings, state);
    EXPECT_EQ(state.status.particle, 1u);
    EXPECT_EQ(state.status.step, 12u);
}

// --- measures ------------------------------------------------------------------------------------

TEST(Measure, SumsOfTwoParticles)
{
    Settings settings = make_settings(shared::KERNEL_PAPER, D, 2.0);
    settings.params.gravity = {0.0f, -10.0f, 0.0f};
    State state;
    add_particle(state, {1.0, 2.0, 0.0}, D, {3.0, 0.0, 4.0});
    add_particle(state, {4.0, 0.0, 1.0}, D, {-3.0, 0.0, 0.0});
    state.mass = {1.0, 2.0};
    EXPECT_DOUBLE_EQ(total_mass(state), 3.0);
    EXPECT_DOUBLE_EQ(kinetic_energy(state), 12.5 + 9.0);
    EXPECT_EQ(momentum(state), glm::dvec3(-3.0, 0.0, 4.0));
    EXPECT_DOUBLE_EQ(momentum_magnitude(state), 5.0 + 6.0);
    EXPECT_DOUBLE_EQ(center_of_mass(state).x, 3.0);
    EXPECT_DOUBLE_EQ(max_speed(state), 5.0);
    EXPECT_DOUBLE_EQ(potential_energy(settings, state), 20.0);
}

} // namespace
} // namespace meltpoint::reference
