#include "reference/viscosity.h"

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "reference/boundary.h"
#include "reference/density.h"
#include "reference/fluid_fixture.h"

namespace meltpoint::reference {
namespace {

constexpr double D = 0.02;
constexpr double MU = 10.0;
constexpr double RHO = 1000.0;

using Field = std::function<glm::dvec3(const glm::dvec3&)>;

class ReferenceViscosity : public testing::Test {
protected:
    ReferenceViscosity() { use(shared::KERNEL_WENDLAND, 2.5); }

    void use(std::uint32_t kernel, double support_ratio)
    {
        settings = make_settings(kernel, D, support_ratio);
        settings.implicit_viscosity = true;
        set_viscosity(settings.params, static_cast<float>(MU));
        settings.params.friction[1] = 4.0f;
        settings.params.dt = 5e-3f; // nu dt / d^2 = 0.125
        settings.params.viscosity_error = 1e-6f;
        settings.params.viscosity_iterations = 1000;
    }

    void find()
    {
        neighbors = find_neighbors(settings.params, state.position);
        update_boundary_weights(settings, state, neighbors);
        update_density(settings, state, neighbors);
    }

    /// Jittered fluid of two masses that moves at random, on a plate of boundary particles and near a wall.
    void add_everything()
    {
        settings.params.wall_mask = 1;
        settings.params.wall_viscosity = 3.0f;
        add_mixture_on_plate(state, {0.5 * D, 0.4, 0.4}, D, 1.0, 0.3);
        find();
    }

    [[nodiscard]] std::vector<glm::dvec3> random_velocities(std::uint64_t seed) const
    {
        Random random(seed);
        std::vector<glm::dvec3> velocity(state.size(), glm::dvec3(0.0));
        for (std::size_t i = 0; i < state.size(); ++i) {
            const glm::dvec3 v = random_vector(random);
            velocity[i] = is_boundary(state, i) ? glm::dvec3(0.0) : v;
        }
        return velocity;
    }

    /// sum m a . K b dt / m
    [[nodiscard]] double work(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) const
    {
        double sum = 0.0;
        for (std::size_t i = 0; i < state.size(); ++i) {
            if (!is_boundary(state, i)) {
                sum -= state.mass[i] * glm::dot(a[i], viscous_change(settings, state, neighbors, b, i).value);
            }
        }
        return sum;
    }

    Settings settings;
    State state;
    Neighbors neighbors;
};

// Both kinds of viscosity, of flows without divergence on a lattice, along its axes and its diagonals: mu lap v / rho.
TEST_F(ReferenceViscosity, IsThatOfTheNavierStokesEquations)
{
    const std::vector<std::pair<Field, glm::dvec3>> flows{
        {[](const glm::dvec3& x) { return glm::dvec3(x.y * x.y, 0.0, 0.0); }, {2.0, 0.0, 0.0}},
        {[](const glm::dvec3& x) { return glm::dvec3(0.0, 0.0, x.y * x.y); }, {0.0, 0.0, 2.0}},
        {[](const glm::dvec3& x) { return std::pow(x.x - x.y, 2) * glm::dvec3(1.0, 1.0, 0.0); }, {4.0, 4.0, 0.0}},
        {[](const glm::dvec3& x) { return std::pow(x.z + x.y, 2) * glm::dvec3(1.0, 0.0, 0.0); }, {4.0, 0.0, 0.0}}};
    for (const auto& [kernel, ratio] : {std::pair{shared::KERNEL_PAPER, 2.0},
                                        {shared::KERNEL_WENDLAND, 2.0},
                                        {shared::KERNEL_PAPER, 3.0},
                                        {shared::KERNEL_WENDLAND, 3.0}}) {
        SCOPED_TRACE(testing::Message() << "kernel " << kernel << ", H/d " << ratio);
        use(kernel, ratio);
        state = State{};
        add_lattice(state, glm::dvec3(0.4), glm::ivec3(9), D);
        find();
        const std::size_t center = (9 * 9 * 9) / 2;
        for (const auto& [field, laplacian] : flows) {
            for (std::size_t i = 0; i < state.size(); ++i) {
                state.velocity[i] = field(state.position[i] - state.position[center]);
            }
            const glm::dvec3 exact = MU / RHO * laplacian;
            const glm::dvec3 implicit = viscous_change(settings, state, neighbors, state.velocity, center).value /
                                        static_cast<double>(settings.params.dt);
            const glm::dvec3 explicit_one = viscosity_acceleration(settings, state, neighbors, center).value;
            // Density is right to 0.1 % at best: float scales.
            EXPECT_LT(glm::length(implicit - exact), 0.002 * glm::length(exact));
            EXPECT_LT(glm::length(explicit_one - exact), 0.002 * glm::length(exact));
        }
    }
}

TEST_F(ReferenceViscosity, LatticesOfAnySpacingResistOnTheWhole)
{
    // Where no taper makes the lattice the same along all directions, their mean is right.
    for (const double ratio : {1.8, 2.3, 2.6, 3.5}) {
        const PairViscosity pairs = pair_viscosity(ratio * D, D);
        double sum = 0.0;
        for (int x = -4; x <= 4; ++x) {
            for (int y = -4; y <= 4; ++y) {
                for (int z = -4; z <= 4; ++z) {
                    const double r = D * std::sqrt(x * x + y * y + z * z);
                    const double q = r / (ratio * D);
                    sum += q > 0.0 && q < 1.0 ? r * r * pairs.scale * pair_viscosity_shape(pairs.taper, q) : 0.0;
                }
            }
        }
        EXPECT_NEAR(D * D * D * sum / 6.0, 5.0, 1e-9) << ratio;
        EXPECT_GE(pair_viscosity_shape(pairs.taper, 0.99), 0.0);
        EXPECT_GE(pair_viscosity_shape(pairs.taper, 0.0), pair_viscosity_shape(pairs.taper, 0.5));
    }
}

TEST_F(ReferenceViscosity, RigidMotionCostsNothing)
{
    add_lattice(state, glm::dvec3(0.4), glm::ivec3(6), D);
    Random random(2);
    for (glm::dvec3& x : state.position) {
        x += 0.3 * D * random_vector(random);
    }
    find();
    double biggest = 0.0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        state.velocity[i] =
            glm::dvec3(1.0, 2.0, 3.0) + glm::cross(glm::dvec3(5.0, -2.0, 1.0), state.position[i] - glm::dvec3(0.3));
    }
    for (std::size_t i = 0; i < state.size(); ++i) {
        biggest = std::max(biggest, glm::length(viscous_change(settings, state, neighbors, state.velocity, i).value));
        // The explicit one drags on rotation at a free surface.
    }
    EXPECT_LT(biggest, 1e-12);
    EXPECT_GT(glm::length(viscosity_acceleration(settings, state, neighbors, 0).value), 0.1);
}

TEST_F(ReferenceViscosity, OperatorIsSymmetricAndPositive)
{
    add_everything();
    const std::vector<glm::dvec3> a = random_velocities(1);
    const std::vector<glm::dvec3> b = random_velocities(2);
    EXPECT_NEAR(work(a, b), work(b, a), 1e-12 * work(a, a));
    EXPECT_GT(work(a, a), 0.0);
}

TEST_F(ReferenceViscosity, BlockIsTheOwnResponse)
{
    add_everything();
    for (std::size_t i = 0; i < state.size(); i += 7) {
        // Near the wall a particle also meets its own image, which the block leaves out.
        if (is_boundary(state, i) || 2.0 * state.position[i].x < static_cast<double>(settings.params.support_radius)) {
            continue;
        }
        const glm::dmat3 block = viscosity_block(settings, state, neighbors, i);
        for (int axis = 0; axis < 3; ++axis) {
            std::vector<glm::dvec3> unit(state.size(), glm::dvec3(0.0));
            unit[i][axis] = 1.0;
            const glm::dvec3 response = unit[i] - viscous_change(settings, state, neighbors, unit, i).value;
            EXPECT_LT(glm::length(response - block[axis]), 1e-12);
        }
    }
}

TEST_F(ReferenceViscosity, SolveIsASolution)
{
    add_everything();
    const std::vector<glm::dvec3> before = state.velocity;
    const SolveResult result = solve_viscosity(settings, state, neighbors);
    EXPECT_GT(result.iterations, 5u);
    EXPECT_LE(result.error, 1e-6);
    double residual = 0.0;
    double change = 0.0;
    double energy = 0.0;
    double energy_before = 0.0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        const glm::dvec3 v = state.velocity[i];
        if (is_boundary(state, i)) {
            EXPECT_EQ(v, before[i]);
            continue;
        }
        const glm::dvec3 left = v - viscous_change(settings, state, neighbors, state.velocity, i).value - before[i];
        residual += state.mass[i] * glm::dot(left, left);
        change += state.mass[i] * glm::dot(v - before[i], v - before[i]);
        energy += state.mass[i] * glm::dot(v, v);
        energy_before += state.mass[i] * glm::dot(before[i], before[i]);
        EXPECT_LT(
            glm::length(static_cast<double>(settings.params.dt) * state.viscous_acceleration[i] - (v - before[i])),
            1e-12);
    }
    EXPECT_LT(std::sqrt(residual), 1.1e-6 * std::sqrt(change));
    EXPECT_LT(energy, 0.8 * energy_before);
}

TEST_F(ReferenceViscosity, PairsKeepMomentumAndAngularMomentum)
{
    add_lattice(state, glm::dvec3(0.4), glm::ivec3(6), D);
    Random random(3);
    for (std::size_t i = 0; i < state.size(); ++i) {
        state.position[i] += 0.3 * D * random_vector(random);
        state.velocity[i] = random_vector(random);
    }
    find();
    const auto sums = [&] {
        std::pair<glm::dvec3, glm::dvec3> sum{glm::dvec3(0.0), glm::dvec3(0.0)};
        for (std::size_t i = 0; i < state.size(); ++i) {
            sum.first += state.mass[i] * state.velocity[i];
            sum.second += state.mass[i] * glm::cross(state.position[i] - glm::dvec3(0.45), state.velocity[i]);
        }
        return sum;
    };
    const auto before = sums();
    settings.params.viscosity_error = 1e-12f;
    ASSERT_GT(solve_viscosity(settings, state, neighbors).iterations, 5u);
    const auto after = sums();
    EXPECT_LT(glm::length(after.first - before.first), 1e-10);
    EXPECT_LT(glm::length(after.second - before.second), 1e-10 * 0.1);
}

TEST_F(ReferenceViscosity, NothingToDoTakesNoIteration)
{
    add_lattice(state, glm::dvec3(0.4), glm::ivec3(5), D);
    find();
    for (glm::dvec3& v : state.velocity) {
        v = {1.0, -2.0, 0.5};
    }
    EXPECT_EQ(solve_viscosity(settings, state, neighbors).iterations, 0u);
    set_viscosity(settings.params, 0.0f);
    state.velocity = random_velocities(8);
    const std::vector<glm::dvec3> before = state.velocity;
    state.viscous_acceleration.clear();
    EXPECT_EQ(solve_viscosity(settings, state, neighbors).iterations, 0u);
    EXPECT_EQ(state.velocity, before);
}

TEST_F(ReferenceViscosity, TheLastStepsChangeIsAGoodStart)
{
    // Fluid that creeps under a steady force: in every step viscosity does the same.
    add_everything();
    set_viscosity(settings.params, 500.0f);
    settings.params.friction[1] = 500.0f;
    settings.params.viscosity_error = 1e-3f;
    const auto pull = [&] {
        for (std::size_t i = 0; i < state.size(); ++i) {
            const double dt = static_cast<double>(settings.params.dt);
            state.velocity[i] += is_boundary(state, i) ? glm::dvec3(0.0) : dt * glm::dvec3(0.0, 0.0, 9.81);
        }
    };
    for (int step = 0; step < 40; ++step) {
        pull();
        (void)solve_viscosity(settings, state, neighbors);
    }
    pull();
    State cold = state;
    cold.viscous_acceleration.clear();
    const std::uint32_t from_nothing = solve_viscosity(settings, cold, neighbors).iterations;
    EXPECT_GT(from_nothing, 10u);
    EXPECT_LE(solve_viscosity(settings, state, neighbors).iterations, from_nothing / 2);
}

TEST_F(ReferenceViscosity, MirrorsAnswerLikeAFluidBehindThem)
{
    settings.params.domain_min = glm::vec3(0.5f, 0.0f, 0.0f);
    settings.params.wall_mask = 1;
    add_lattice(state, {0.5 + 0.5 * D, 0.45, 0.45}, {4, 5, 5}, D);
    state.velocity = random_velocities(5);
    State both = state;
    for (std::size_t i = 0; i < state.size(); ++i) {
        const glm::dvec3 x = state.position[i];
        const glm::dvec3 v = state.velocity[i];
        add_particle(both, {1.0 - x.x, x.y, x.z}, D, {-v.x, v.y, v.z});
    }
    Settings open = settings;
    open.params.domain_min = glm::vec3(0.0f);
    open.params.wall_mask = 0;
    find();
    const Neighbors all = find_neighbors(open.params, both.position);
    update_density(open, both, all);
    (void)solve_viscosity(settings, state, neighbors);
    (void)solve_viscosity(open, both, all);
    for (std::size_t i = 0; i < state.size(); ++i) {
        EXPECT_LT(glm::length(state.velocity[i] - both.velocity[i]), 1e-5);
    }
}

} // namespace
} // namespace meltpoint::reference
