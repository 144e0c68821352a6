#include "reference/pbf.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "reference/boundary.h"
#include "reference/density.h"
#include "reference/fluid_fixture.h"

namespace meltpoint::reference {
namespace {

constexpr double D = 0.02;

class ReferencePbf : public testing::Test {
protected:
    ReferencePbf()
    {
        settings.solver = shared::SOLVER_PBF;
        settings.params.dt = 2e-3f;
        settings.params.density_error = 1e-4f;
        settings.params.max_iterations = 1000;
        settings.params.least_iterations = 1;
        settings.params.speed_cap = 1.0f;
        settings.params.artificial_pressure = 0.0f;
    }

    void add_everything()
    {
        add_mixture_on_plate(state, glm::dvec3(0.4), D, 0.95, 0.2);
        find();
        update_boundary_weights(settings, state, neighbors);
        update_density(settings, state, neighbors);
    }
    void find() { neighbors = find_neighbors(settings.params, state.position); }

    [[nodiscard]] std::vector<Constraint> constraints_at(const std::vector<glm::dvec3>& moved) const
    {
        std::vector<Constraint> all(state.size());
        for (std::size_t i = 0; i < state.size(); ++i) {
            if (!is_boundary(state, i)) {
                all[i] = constraint(settings, state, neighbors, moved, i);
            }
        }
        return all;
    }
    [[nodiscard]] std::vector<glm::dvec3> corrections(const std::vector<Constraint>& constraints,
                                                      const std::vector<glm::dvec3>& moved) const
    {
        std::vector<glm::dvec3> all(state.size(), glm::dvec3(0.0));
        for (std::size_t i = 0; i < state.size(); ++i) {
            if (!is_boundary(state, i)) {
                all[i] = position_correction(settings, state, neighbors, moved, constraints, i).value;
            }
        }
        return all;
    }

    Settings settings = make_settings(shared::KERNEL_WENDLAND, D, 2.5);
    State state;
    Neighbors neighbors;
};

TEST_F(ReferencePbf, ConstraintsAreTheDensityWhereTheParticlesAreNow)
{
    add_everything();
    std::vector<glm::dvec3> moved = state.position;
    Random random(5);
    for (std::size_t i = 0; i < state.size(); ++i) {
        moved[i] += is_boundary(state, i) ? glm::dvec3(0.0) : 0.01 * D * random_vector(random);
    }
    State there = state;
    there.position = moved;
    const Neighbors fresh = find_neighbors(settings.params, moved);
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (is_boundary(state, i)) {
            continue;
        }
        const Constraint c = constraint(settings, state, neighbors, moved, i);
        // But for pairs that have come within the support radius since.
        EXPECT_NEAR(c.density, density(settings, there, fresh, i), 1e-4);
        EXPECT_NEAR(c.excess, c.density / 1000.0 - 1.0, 1e-12);
        EXPECT_EQ(c.impulse, c.impulse_per_excess * std::max(c.excess, 0.0));
    }
}

TEST_F(ReferencePbf, AConstraintAloneTakesItsOwnViolationAway)
{
    // To first order: without relaxation and softness, and a thousandth of it at a time.
    settings.params.solve_relaxation = 1.0f;
    settings.params.constraint_softness = 0.0f;
    add_everything();
    const LatticeMoments moments = lattice_moments(settings.kernel, 2.5 * D, D); // density and gradient have their own
    for (const std::size_t i : {0UL, 50UL, 107UL, 215UL}) {
        const double before = constraint(settings, state, neighbors, state.position, i).excess;
        std::vector<Constraint> constraints(state.size());
        constraints[i].impulse = 1e-3 * constraint(settings, state, neighbors, state.position, i).impulse_per_excess;
        std::vector<glm::dvec3> moved = state.position;
        const std::vector<glm::dvec3> moves = corrections(constraints, moved);
        for (std::size_t k = 0; k < state.size(); ++k) {
            moved[k] += moves[k];
        }
        const double after = constraint(settings, state, neighbors, moved, i).excess;
        EXPECT_NEAR(after - before, -1e-3 * moments.gradient / moments.density, 2e-5) << i;
    }
}

TEST_F(ReferencePbf, SoftnessDampsByItsShareOfAFullNeighborhoodsResponse)
{
    add_lattice(state, glm::dvec3(0.3), glm::ivec3(9), D);
    find();
    update_density(settings, state, neighbors);
    const std::size_t middle = 4 * 81 + 4 * 9 + 4;
    const double stiff = constraint(settings, state, neighbors, state.position, middle).impulse_per_excess;
    settings.params.constraint_softness = 3.0f * static_cast<float>(lattice_response(settings.kernel, 2.5 * D, D));
    EXPECT_NEAR(constraint(settings, state, neighbors, state.position, middle).impulse_per_excess / stiff, 0.25, 1e-6);
}

TEST_F(ReferencePbf, TornFluidIsPulledTogetherOnlyWhereTold)
{
    add_everything();
    for (glm::dvec3& x : state.position) {
        x *= 1.3;
    }
    find();
    update_density(settings, state, neighbors);
    for (const bool clamp : {true, false}) {
        settings.params.clamp_pressure = clamp ? 1 : 0;
        const std::vector<Constraint> constraints = constraints_at(state.position);
        EXPECT_LT(constraints[107].excess, -0.2);
        EXPECT_EQ(constraints[107].impulse < 0.0, !clamp);
    }
}

TEST_F(ReferencePbf, CorrectionsKeepTheCenterOfMassWhateverTheMasses)
{
    settings.params.artificial_pressure = 0.3f;
    add_everything();
    state.id.resize(216);
    state.attributes.resize(216);
    state.position.resize(216); // without the plate
    state.velocity.resize(216);
    state.mass.resize(216);
    state.weight.resize(216);
    state.density.resize(216);
    state.pressure.resize(216);
    find();
    const std::vector<glm::dvec3> moves = corrections(constraints_at(state.position), state.position);
    glm::dvec3 sum(0.0);
    double scale = 0.0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        sum += state.mass[i] * moves[i];
        scale += state.mass[i] * glm::length(moves[i]);
    }
    EXPECT_GT(scale, 1e-6);
    EXPECT_LT(glm::length(sum), 1e-13 * scale);
}

TEST_F(ReferencePbf, ArtificialPressureKeepsPairsApartWhereNothingIsDense)
{
    add_particle(state, glm::dvec3(0.5), D);
    add_particle(state, glm::dvec3(0.5 + 0.4 * D, 0.5, 0.5), D);
    find();
    update_density(settings, state, neighbors);
    for (const float k : {0.0f, 0.1f, 0.2f}) {
        settings.params.artificial_pressure = k;
        const std::vector<Constraint> constraints = constraints_at(state.position);
        EXPECT_LT(constraints[0].excess, 0.0);
        const glm::dvec3 move = corrections(constraints, state.position)[0];
        const double g = static_cast<double>(settings.params.gradient_scale) * gradient_shape(settings.kernel, 0.16);
        const double expected = -2.0 * static_cast<double>(k) * constraints[0].impulse_per_excess * g / state.mass[0];
        EXPECT_NEAR(move.x, expected, 1e-6 * std::abs(expected));
    }
}

TEST_F(ReferencePbf, SolvesEndWhereTheyShould)
{
    add_lattice(state, glm::dvec3(0.4), glm::ivec3(8), 0.97 * D);
    for (std::size_t i = 0; i < state.size(); ++i) {
        state.mass[i] = 1000.0 * D * D * D;
        state.acceleration[i] = -50.0 * (state.position[i] - 0.47);
    }
    find();
    update_density(settings, state, neighbors);
    const auto solve = [&](float error, std::uint32_t least, std::uint32_t most) {
        settings.params.density_error = error;
        settings.params.least_iterations = least;
        settings.params.max_iterations = most;
        State copy = state;
        std::vector<glm::dvec3> moves;
        const SolveResult result = solve_positions(settings, copy, neighbors, moves);
        double mean = 0.0;
        for (const double rho : copy.density) {
            mean += std::max(rho / 1000.0 - 1.0, 0.0);
        }
        EXPECT_NEAR(mean / static_cast<double>(state.size()), result.error, 1e-12);
        return result;
    };
    const SolveResult fine = solve(1e-3f, 1, 1000);
    EXPECT_LE(fine.error, 1e-3);
    EXPECT_GT(fine.iterations, 3u);
    EXPECT_LT(fine.iterations, 1000u);
    EXPECT_LT(solve(1e-2f, 1, 1000).iterations, fine.iterations);
    EXPECT_EQ(solve(1e-3f, 1, 2).iterations, 2u);
    EXPECT_GT(solve(1e-3f, 1, 2).error, 1e-3);
    EXPECT_EQ(solve(1e30f, 4, 4).iterations, 4u);
    EXPECT_EQ(solve(1e30f, 1, 4).iterations, 1u);
    EXPECT_LT(solve(1e30f, 4, 4).error, solve(1e30f, 1, 4).error);
}

TEST_F(ReferencePbf, TheSpeedCapSlowsDownAndCounts)
{
    settings.params.speed_cap = 0.5f * static_cast<float>(D);
    add_particle(state, {0.3, 0.5, 0.5}, D, {3.0, 0.0, 0.0});
    add_particle(state, {0.7, 0.5, 0.5}, D, {0.0, 30.0, 0.0});
    predict(settings, state);
    EXPECT_EQ(finish(settings, state, {glm::dvec3(0.0), glm::dvec3(0.0)}), 1u);
    const double dt = static_cast<double>(settings.params.dt);
    EXPECT_NEAR(state.velocity[0].x, 3.0, 1e-12);
    EXPECT_NEAR(state.position[0].x, 0.3 + 3.0 * dt, 1e-12);
    const double fastest = static_cast<double>(settings.params.speed_cap) / dt;
    EXPECT_NEAR(state.velocity[1].y, fastest, 1e-9);
    EXPECT_NEAR(state.position[1].y, 0.5 + fastest * dt, 1e-9); // where that speed leads to
}

TEST_F(ReferencePbf, StepsOfALoneParticleAreFreeFallOntoAWall)
{
    settings.params.gravity = glm::vec3(0.0f, -9.81f, 0.0f);
    settings.params.wall_mask = 4; // the floor
    add_particle(state, {0.5, 0.1, 0.5}, D);
    const double dt = static_cast<double>(settings.params.dt);
    for (int step = 1; step <= 50; ++step) {
        (void)pbf_step(settings, state);
        // Symplectic Euler.
        EXPECT_NEAR(state.position[0].y, 0.1 - 0.5 * static_cast<double>(9.81f) * dt * dt * step * (step + 1), 1e-9);
    }
    for (int step = 0; step < 100; ++step) {
        (void)pbf_step(settings, state);
    }
    EXPECT_NEAR(state.position[0].y, static_cast<double>(settings.params.contact_distance), 1e-9);
    EXPECT_NEAR(state.velocity[0].y, 0.0, 1e-9);
    EXPECT_EQ(state.status.fault, shared::FAULT_NONE);
}

} // namespace
} // namespace meltpoint::reference
