#include "reference/dfsph.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "reference/boundary.h"
#include "reference/density.h"
#include "reference/fluid_fixture.h"

namespace meltpoint::reference {
namespace {

constexpr double D = 0.02;

class ReferenceDfsph : public testing::Test {
protected:
    ReferenceDfsph()
    {
        settings.solver = shared::SOLVER_DFSPH;
        settings.params.dt = 2e-3f;
        settings.params.density_error = 1e-5f;
        settings.params.divergence_error = 1e-5f;
        settings.params.max_iterations = 1000;
    }

    void add_everything()
    {
        add_mixture_on_plate(state, glm::dvec3(0.4), D, 1.0, 0.3);
        find();
        update_boundary_weights(settings, state, neighbors);
        update_density(settings, state, neighbors);
    }
    void find() { neighbors = find_neighbors(settings.params, state.position); }

    [[nodiscard]] glm::dvec3 momentum() const
    {
        glm::dvec3 sum(0.0);
        for (std::size_t i = 0; i < state.size(); ++i) {
            sum += state.mass[i] * state.velocity[i];
        }
        return sum;
    }

    Settings settings = make_settings(shared::KERNEL_WENDLAND, D, 2.5);
    State state;
    Neighbors neighbors;
};

TEST_F(ReferenceDfsph, ExcessIsWhatTheDensityDoes)
{
    // Move everything by its velocity for a very short time, and look.
    add_everything();
    const double dt = static_cast<double>(settings.params.dt);
    State later = state;
    const double moment = 1e-7;
    for (std::size_t i = 0; i < later.size(); ++i) {
        later.position[i] += moment * later.velocity[i];
    }
    const Neighbors later_neighbors = find_neighbors(settings.params, later.position);
    // Density and gradient have lattice moments of their own.
    const LatticeMoments moments = lattice_moments(settings.kernel, 2.5 * D, D);
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (is_boundary(state, i)) {
            continue;
        }
        const double rho0 = rest_density(settings, state, i);
        const double rate = (density(settings, later, later_neighbors, i) - state.density[i]) / moment;
        const double expected = dt * rate / rho0 * moments.density / moments.gradient;
        const double compression = state.density[i] / rho0;
        const ScalarSum divergence = excess(settings, state, neighbors, state.velocity, shared::SOLVE_DIVERGENCE, i);
        settings.params.correction_time = 0.0f;
        const ScalarSum dense = excess(settings, state, neighbors, state.velocity, shared::SOLVE_DENSITY, i);
        EXPECT_NEAR(dense.value, compression - 1.0 + expected, 1e-5 * dense.magnitude);
        settings.params.correction_time = 4.0f * settings.params.dt; // of an excess, not of a lack
        const ScalarSum slow = excess(settings, state, neighbors, state.velocity, shared::SOLVE_DENSITY, i);
        const double share = compression > 1.0 ? 0.25 : 1.0;
        EXPECT_NEAR(slow.value, share * (compression - 1.0) + expected, 1e-5 * dense.magnitude);
        EXPECT_NEAR(divergence.value, compression > 0.9 ? expected : 0.0, 1e-5 * dense.magnitude);
    }
}

TEST_F(ReferenceDfsph, DiagonalIsTheOwnResponse)
{
    add_everything();
    const double dt = static_cast<double>(settings.params.dt);
    for (const std::size_t i : {0UL, 50UL, 107UL, 215UL}) {
        const double diagonal = jacobi_diagonal(settings, state, neighbors, i);
        std::vector<double> impulse(state.size(), 0.0);
        impulse[i] = diagonal;
        std::vector<glm::dvec3> velocity(state.size(), glm::dvec3(0.0));
        for (std::size_t j = 0; j < state.size(); ++j) {
            if (!is_boundary(state, j)) {
                velocity[j] = velocity_correction(settings, state, neighbors, impulse, j).value;
            }
        }
        State filled = state;
        filled.density[i] = rest_density(settings, state, i);
        const double rest_volume = state.mass[i] / rest_density(settings, state, i);
        const double rate =
            excess(settings, filled, neighbors, velocity, shared::SOLVE_DENSITY, i).value / (dt * rest_volume);
        EXPECT_NEAR(rate, -1.0, 1e-9);
    }
}

TEST_F(ReferenceDfsph, IterationsConvergeBelowTheEigenvalue)
{
    for (const auto& [kernel, ratio] : {std::pair{shared::KERNEL_WENDLAND, 2.0},
                                        {shared::KERNEL_WENDLAND, 3.0},
                                        {shared::KERNEL_PAPER, 2.0},
                                        {shared::KERNEL_PAPER, 2.6}}) {
        SCOPED_TRACE(testing::Message() << "kernel " << kernel << ", H/d " << ratio);
        settings = make_settings(kernel, D, ratio);
        settings.params.dt = 2e-3f;
        settings.params.density_error = 1e-6f;
        settings.params.max_iterations = 200;
        const double eigenvalue = largest_jacobi_eigenvalue(kernel, ratio * D, D);
        EXPECT_LE(static_cast<double>(settings.params.solve_relaxation), 1.3 / eigenvalue + 1e-6);
        const auto iterations_with = [&](double relaxation) {
            settings.params.solve_relaxation = static_cast<float>(relaxation);
            state = State{};
            add_lattice(state, glm::dvec3(0.35), glm::ivec3(14), D);
            for (std::size_t i = 0; i < state.size(); ++i) {
                state.velocity[i] = -2.0 * (state.position[i] - 0.48);
            }
            find();
            update_density(settings, state, neighbors);
            std::vector<double> warm(state.size(), 0.0);
            return solve(settings, state, neighbors, shared::SOLVE_DENSITY, warm).iterations;
        };
        const std::uint32_t best = iterations_with(1.3 / eigenvalue);
        EXPECT_LE(best, ratio > 2.5 ? 80u : 15u); // without momentum 58, and more than 200
        EXPECT_LT(best, iterations_with(0.9 / eigenvalue));
        EXPECT_LT(2 * best, iterations_with(2.4 / eigenvalue));
    }
}

TEST_F(ReferenceDfsph, MirrorsAnswerLikeAFluidBehindThem)
{
    // Two halves that move towards each other, and one half with a wall in the middle.
    settings.params.domain_min = glm::vec3(0.5f, 0.0f, 0.0f);
    settings.params.wall_mask = 1;
    add_lattice(state, {0.5 + 0.5 * D, 0.45, 0.45}, {4, 5, 5}, D);
    for (glm::dvec3& v : state.velocity) {
        v = {-1.0, 0.0, 0.0};
    }
    State both = state;
    for (std::size_t i = 0; i < state.size(); ++i) {
        const glm::dvec3 x = state.position[i];
        add_particle(both, {1.0 - x.x, x.y, x.z}, D, {1.0, 0.0, 0.0});
    }
    Settings open = settings;
    open.params.domain_min = glm::vec3(0.0f);
    open.params.wall_mask = 0;
    std::vector<double> warm(state.size(), 0.0);
    std::vector<double> warm_both(both.size(), 0.0);
    find();
    update_density(settings, state, neighbors);
    const Neighbors all = find_neighbors(open.params, both.position);
    update_density(open, both, all);
    const SolveResult wall = solve(settings, state, neighbors, shared::SOLVE_DENSITY, warm);
    const SolveResult fluid = solve(open, both, all, shared::SOLVE_DENSITY, warm_both);
    EXPECT_EQ(wall.iterations, fluid.iterations);
    EXPECT_GT(wall.iterations, 3u);
    for (std::size_t i = 0; i < state.size(); ++i) {
        EXPECT_LT(glm::length(state.velocity[i] - both.velocity[i]), 1e-9);
    }
}

TEST_F(ReferenceDfsph, SolvesMeetTheirErrorAndKeepMomentum)
{
    for (const std::uint32_t kind : {shared::SOLVE_DIVERGENCE, shared::SOLVE_DENSITY}) {
        state = State{};
        add_lattice(state, glm::dvec3(0.4), glm::ivec3(8), D);
        Random random(6);
        for (std::size_t i = 0; i < state.size(); ++i) {
            state.velocity[i] = 0.3 * random_vector(random) - 2.0 * (state.position[i] - 0.47);
        }
        find();
        update_density(settings, state, neighbors);
        const glm::dvec3 before = momentum();
        const std::vector<glm::dvec3> start = state.velocity;
        std::vector<double> warm(state.size(), 0.0);
        const SolveResult result = solve(settings, state, neighbors, kind, warm);
        EXPECT_GT(result.iterations, 5u);
        EXPECT_LT(result.iterations, settings.params.max_iterations);
        EXPECT_LE(result.error, 1e-5);
        double error = 0.0;
        for (std::size_t i = 0; i < state.size(); ++i) {
            error += std::max(excess(settings, state, neighbors, state.velocity, kind, i).value, 0.0);
        }
        EXPECT_NEAR(error / static_cast<double>(state.size()), result.error, 1e-12);
        EXPECT_LT(glm::length(momentum() - before), 1e-12);
        EXPECT_GE(*std::min_element(warm.begin(), warm.end()), 0.0);

        // From where it ended the next solve of the same velocities is shorter.
        std::vector<double> cold(state.size(), 0.0);
        State again = state;
        again.velocity = start;
        State cold_again = again;
        const SolveResult warm_result = solve(settings, again, neighbors, kind, warm);
        const SolveResult cold_result = solve(settings, cold_again, neighbors, kind, cold);
        EXPECT_LT(warm_result.iterations, cold_result.iterations);
    }
}

TEST_F(ReferenceDfsph, FluidThatIsTornIsLeftAlone)
{
    add_lattice(state, glm::dvec3(0.4), glm::ivec3(6), D);
    for (std::size_t i = 0; i < state.size(); ++i) {
        state.velocity[i] = 3.0 * (state.position[i] - 0.45);
    }
    const std::vector<glm::dvec3> before = state.velocity;
    find();
    update_density(settings, state, neighbors);
    std::vector<double> warm(state.size(), 1e-6);
    for (const std::uint32_t kind : {shared::SOLVE_DIVERGENCE, shared::SOLVE_DENSITY}) {
        EXPECT_EQ(solve(settings, state, neighbors, kind, warm).iterations, 1u);
        EXPECT_EQ(state.velocity, before);
    }
}

TEST_F(ReferenceDfsph, StepsOfALoneParticleAreFreeFallOntoAWall)
{
    settings.params.gravity = glm::vec3(0.0f, -9.81f, 0.0f);
    settings.params.wall_mask = 4; // the floor
    add_particle(state, {0.5, 0.1, 0.5}, D);
    WarmStarts warm;
    const double dt = static_cast<double>(settings.params.dt);
    for (int step = 1; step <= 50; ++step) {
        (void)dfsph_step(settings, state, warm);
        // Symplectic Euler.
        EXPECT_NEAR(state.position[0].y, 0.1 - 0.5 * static_cast<double>(9.81f) * dt * dt * step * (step + 1), 1e-9);
    }
    for (int step = 0; step < 100; ++step) {
        (void)dfsph_step(settings, state, warm);
    }
    EXPECT_NEAR(state.position[0].y, static_cast<double>(settings.params.contact_distance), 1e-9);
    EXPECT_NEAR(state.velocity[0].y, 0.0, 1e-9);
    EXPECT_EQ(state.status.fault, shared::FAULT_NONE);
}

} // namespace
} // namespace meltpoint::reference
