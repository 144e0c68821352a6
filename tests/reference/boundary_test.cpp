#include "reference/boundary.h"

#include <cmath>

#include <gtest/gtest.h>

#include "reference/density.h"
#include "reference/fluid_fixture.h"
#include "reference/forces.h"
#include "reference/step.h"

namespace meltpoint::reference {
namespace {

constexpr double D = 0.02;

class ReferenceBoundary : public testing::TestWithParam<std::uint32_t> {
protected:
    const double ratio = GetParam() == shared::KERNEL_PAPER ? 2.0 : 3.0;
    const double h = ratio * D;
    Settings settings = make_settings(GetParam(), D, ratio);
    State state;

    [[nodiscard]] Neighbors neighbors() const { return find_neighbors(settings.params, state.position); }
    [[nodiscard]] double kernel(double r) const
    {
        return static_cast<double>(settings.params.density_scale) * density_shape(GetParam(), r / h);
    }

    // (2 n + 1)^2 boundary particles in the plane y = 0.5, the middle one at 0.5, 0.5; returns its index.
    std::size_t add_layer(int n, double spacing)
    {
        const std::size_t first = state.size();
        for (int z = -n; z <= n; ++z) {
            for (int x = -n; x <= n; ++x) {
                add_boundary_particle(state, {0.5 + x * spacing, 0.5, 0.5 + z * spacing});
            }
        }
        return first + (state.size() - first) / 2;
    }
};

INSTANTIATE_TEST_SUITE_P(Kernels, ReferenceBoundary, testing::Values(shared::KERNEL_PAPER, shared::KERNEL_WENDLAND),
                         [](const auto& test) { return test.param == shared::KERNEL_PAPER ? "Paper" : "Wendland"; });

class WendlandBoundary : public ReferenceBoundary {}; // spiky is not the gradient of poly6

INSTANTIATE_TEST_SUITE_P(Kernel, WendlandBoundary, testing::Values(shared::KERNEL_WENDLAND),
                         [](const auto&) { return "Wendland"; });

TEST_P(ReferenceBoundary, ALoneParticleTakesTheSpaceOfItsKernel)
{
    add_boundary_particle(state, glm::dvec3(0.5));
    add_particle(state, glm::dvec3(0.5, 0.5 + 0.5 * D, 0.5), D); // fluid does not count
    update_boundary_weights(settings, state, neighbors());
    EXPECT_NEAR(state.weight[0], 1.0 / (kernel(0.0) * D * D * D), 1e-5);
    EXPECT_EQ(state.weight[1], 1.0);
}

TEST_P(ReferenceBoundary, TwoAtADistanceShare)
{
    add_boundary_particle(state, glm::dvec3(0.5));
    add_boundary_particle(state, glm::dvec3(0.5, 0.5, 0.5 + 0.7 * D));
    update_boundary_weights(settings, state, neighbors());
    EXPECT_NEAR(state.weight[0], 1.0 / ((kernel(0.0) + kernel(0.7 * D)) * D * D * D), 1e-5);
    EXPECT_EQ(state.weight[0], state.weight[1]);
}

TEST_P(ReferenceBoundary, ImagesInWallsShareToo)
{
    settings.params.wall_mask = 63;
    add_boundary_particle(state, glm::dvec3(0.5, 0.3 * D, 0.5));
    update_boundary_weights(settings, state, neighbors());
    EXPECT_NEAR(state.weight[0], 1.0 / ((kernel(0.0) + kernel(0.6 * D)) * D * D * D), 1e-4);
}

// What fluid feels of a layer must not depend on how densely it is sampled.
TEST_P(ReferenceBoundary, SamplingDoesNotMatter)
{
    double coarse = 0.0;
    for (const double spacing : {0.9 * D, 0.6 * D, 0.3 * D}) {
        state = State{};
        add_layer(14, spacing);
        add_particle(state, {0.5, 0.5 + D, 0.5}, D);
        const Neighbors found = neighbors();
        update_boundary_weights(settings, state, found);
        const double rho = density(settings, state, found, state.size() - 1);
        coarse = coarse == 0.0 ? rho : coarse;
        EXPECT_NEAR(rho, coarse, 0.02 * coarse) << spacing / D;
    }
    EXPECT_GT(coarse, 1.2 * 1000.0 * kernel(0.0) * D * D * D);
}

// The pressure force is minus the derivative of the energy sum_i m_i e(rho_i), de/drho = p/rho^2, of kernels of which
// one is the other's gradient.
TEST_P(WendlandBoundary, ForcesAreTheDerivativeOfTheEnergy)
{
    settings.params.gradient_scale = // without the lattice moments, which differ
        settings.params.density_scale * static_cast<float>(20.0 / h);
    settings.params.clamp_pressure = 0;
    Random random(3);
    add_layer(5, 0.8 * D);
    add_lattice(state, {0.5 - 2.0 * D, 0.5 + 0.4 * D, 0.5 - 2.0 * D}, glm::ivec3(5, 4, 5), D);
    const std::size_t probe = state.size() - 88; // in the first layers
    for (std::size_t i = 0; i < state.size(); ++i) {
        state.position[i] += 0.2 * D * random_vector(random) * glm::dvec3(1.0, is_boundary(state, i) ? 0.0 : 1.0, 1.0);
    }
    ASSERT_FALSE(is_boundary(state, probe));
    update_boundary_weights(settings, state, neighbors());

    const auto energy = [&] { // p = c0^2 (rho - rho0): e = c0^2 (ln rho + rho0/rho)
        const double c2 = std::pow(static_cast<double>(settings.params.speed_of_sound), 2);
        double sum = 0.0;
        const Neighbors found = neighbors();
        for (std::size_t i = 0; i < state.size(); ++i) {
            if (!is_boundary(state, i)) {
                const double rho = density(settings, state, found, i);
                sum += state.mass[i] * c2 * (std::log(rho / 1000.0) + 1000.0 / rho);
            }
        }
        return sum;
    };
    update_density(settings, state, neighbors());
    const VectorSum a = pressure_acceleration(settings, state, neighbors(), probe);
    for (int axis = 0; axis < 3; ++axis) {
        const double step = 1e-5 * D;
        state.position[probe][axis] += step;
        const double after = energy();
        state.position[probe][axis] -= 2.0 * step;
        const double before = energy();
        state.position[probe][axis] += step;
        EXPECT_NEAR(state.mass[probe] * a.value[axis], -(after - before) / (2.0 * step),
                    1e-4 * state.mass[probe] * a.magnitude)
            << axis;
    }
}

TEST_P(ReferenceBoundary, FrictionMatchesTheFormula)
{
    set_viscosity(settings.params, 7.0f); // of fluid against fluid: not at work here
    settings.params.friction[1] = 0.3f;
    add_boundary_particle(state, glm::dvec3(0.5));
    add_particle(state, glm::dvec3(0.5 + 0.8 * D, 0.5, 0.5), D, {0.0, 2.0, -1.0});
    state.density[1] = 900.0;
    update_boundary_weights(settings, state, neighbors());
    const double laplacian =
        static_cast<double>(settings.params.viscosity_scale) * viscosity_shape(GetParam(), 0.8 / ratio);
    const double factor = static_cast<double>(0.3f) * state.weight[0] * D * D * D * laplacian / 900.0;
    const VectorSum a = viscosity_acceleration(settings, state, neighbors(), 1);
    EXPECT_NEAR(a.value.y, -2.0 * factor, 1e-5 * factor);
    EXPECT_NEAR(a.value.z, 1.0 * factor, 1e-5 * factor);
    const Accelerations all = accelerations(settings, state, neighbors());
    EXPECT_EQ(all.total[0].value, glm::dvec3(0.0));
}

// A layer inside the fluid is no surface of it.
TEST_P(ReferenceBoundary, TheColorFieldSeesTheBoundaryAsFull)
{
    add_layer(6, D);
    add_lattice(state, {0.5 - 4.0 * D, 0.5 + D, 0.5 - 4.0 * D}, glm::ivec3(9, 4, 9), D);
    const std::size_t first = 13 * 13 + 4 * 36 + 4; // in the middle of the lowest layer
    const Neighbors found = neighbors();
    update_boundary_weights(settings, state, found);
    const double covered = color_field(settings, state, found, first).gradient.value.y;
    state.weight.assign(state.size(), 0.0);
    const double bare = color_field(settings, state, found, first).gradient.value.y;
    EXPECT_GT(bare, 0.0);
    EXPECT_LT(covered, 0.5 * bare);
}

TEST_P(ReferenceBoundary, ParticlesStayWhereTheyAre)
{
    settings.params.gravity = {0.0f, -9.81f, 0.0f};
    const std::size_t middle = add_layer(3, D);
    add_particle(state, {0.5, 0.5 + 0.5 * D, 0.5}, D, {0.0, -1.0, 0.0});
    add_boundary_particle(state, {-1.0, 0.5, 0.5}); // outside of the domain: not its fault
    evaluate(settings, state);
    const State start = state;
    for (int i = 0; i < 20; ++i) {
        step(settings, state);
    }
    EXPECT_EQ(state.status.fault, shared::FAULT_NONE);
    EXPECT_EQ(state.position[middle], start.position[middle]);
    EXPECT_EQ(state.velocity[middle], glm::dvec3(0.0));
    EXPECT_EQ(state.density[middle], 0.0);
    EXPECT_NE(state.position[state.size() - 2], start.position[state.size() - 2]);
}

} // namespace
} // namespace meltpoint::reference
