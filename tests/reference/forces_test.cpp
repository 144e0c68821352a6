#include "reference/forces.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "reference/density.h"
#include "reference/fluid_fixture.h"
#include "reference/walls.h"

namespace meltpoint::reference {
namespace {

constexpr double D = 0.02;
constexpr double PI = std::numbers::pi;

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance)
{
    EXPECT_LE(glm::length(a - b), tolerance)
        << a.x << " " << a.y << " " << a.z << " against " << b.x << " " << b.y << " " << b.z;
}

class ReferenceForces : public testing::TestWithParam<std::uint32_t> {
protected:
    const bool paper = GetParam() == shared::KERNEL_PAPER;
    const double ratio = paper ? 2.0 : 3.0;
    const double h = ratio * D;
    Settings settings = make_settings(GetParam(), D, ratio);
    State state;

    [[nodiscard]] Neighbors neighbors() const { return find_neighbors(settings.params, state.position); }

    // Lattice of (2 n + 1)^3 particles around the middle of the domain; returns the index of the central one.
    std::size_t add_cube(int n)
    {
        add_lattice(state, glm::dvec3(0.5 - n * D), glm::ivec3(2 * n + 1), D);
        return state.size() / 2;
    }
};

INSTANTIATE_TEST_SUITE_P(Kernels, ReferenceForces, testing::Values(shared::KERNEL_PAPER, shared::KERNEL_WENDLAND),
                         [](const auto& test) { return test.param == shared::KERNEL_PAPER ? "Paper" : "Wendland"; });

// --- pressure ------------------------------------------------------------------------------------

TEST_P(ReferenceForces, PressureOfTwoParticlesMatchesTheFormula)
{
    add_particle(state, {0.5, 0.5, 0.5}, D);
    add_particle(state, {0.5 + D, 0.5, 0.5}, D);
    state.pressure = {100.0, 300.0};
    state.density = {900.0, 1100.0};
    state.mass[1] *= 2.0;
    const double q = 1.0 / ratio;
    const double steepness = paper ? 45.0 / (PI * std::pow(h, 4)) * std::pow(1.0 - q, 2)
                                   : 210.0 / (PI * std::pow(h, 4)) * q * std::pow(1.0 - q, 3);
    const double moment = lattice_moments(GetParam(), h, D).gradient;
    const double v0 = state.mass[0] / 900.0;
    const double v1 = state.mass[1] / 1100.0;
    const double force = (100.0 * v0 * v0 + 300.0 * v1 * v1) * steepness / moment;
    const VectorSum first = pressure_acceleration(settings, state, neighbors(), 0);
    const VectorSum second = pressure_acceleration(settings, state, neighbors(), 1);
    expect_near(first.value, {-force / state.mass[0], 0.0, 0.0}, 1e-5 * force / state.mass[0]); // pushed apart
    expect_near(second.value, {force / state.mass[1], 0.0, 0.0}, 1e-5 * force / state.mass[1]);
    EXPECT_NEAR(first.magnitude, force / state.mass[0], 1e-5 * force / state.mass[0]);
}

TEST_P(ReferenceForces, LinearPressureIsDifferentiatedExactly)
{
    const std::size_t middle = add_cube(4);
    const glm::dvec3 slope(300.0, -200.0, 500.0); // Pa/m
    for (std::size_t i = 0; i < state.size(); ++i) {
        state.pressure[i] = 1000.0 + glm::dot(slope, state.position[i]);
    }
    const VectorSum a = pressure_acceleration(settings, state, neighbors(), middle);
    expect_near(a.value, -slope / 1000.0, 1e-5 * glm::length(slope) / 1000.0);
    EXPECT_GT(a.magnitude, 10.0 * glm::length(a.value));
}

TEST_P(ReferenceForces, SymmetricLatticeAtRestFeelsNothing)
{
    const std::size_t middle = add_cube(4);
    std::fill(state.pressure.begin(), state.pressure.end(), 5000.0);
    set_viscosity(settings.params, 1.0f);
    settings.params.surface_tension = 1.0f;
    const Accelerations a = accelerations(settings, state, neighbors());
    EXPECT_GT(a.total[middle].magnitude, 1.0);
    EXPECT_LT(glm::length(a.total[middle].value), 1e-12 * a.total[middle].magnitude);
}

TEST_P(ReferenceForces, CoincidentParticlesHaveNoGradientAndAreCounted)
{
    add_particle(state, glm::dvec3(0.5), D);
    add_particle(state, glm::dvec3(0.5), D);
    add_particle(state, glm::dvec3(0.5, 0.5, 0.5 + 0.9e-6 * h), D);
    add_particle(state, glm::dvec3(0.5, 0.5 + 1e-3 * h, 0.5), D);
    std::fill(state.pressure.begin(), state.pressure.end(), 100.0);
    const Accelerations a = accelerations(settings, state, neighbors());
    EXPECT_EQ(a.coincident_pairs, 6u);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_TRUE(std::isfinite(a.total[i].value.x));
        EXPECT_LT(a.total[i].value.y, 0.0);
        expect_near(a.total[i].value, a.total[0].value, 1e-3 * a.total[0].magnitude);
    }
}

// --- viscosity -----------------------------------------------------------------------------------

TEST_P(ReferenceForces, ViscosityOfTwoParticlesMatchesTheFormula)
{
    set_viscosity(settings.params, 0.7f);
    add_particle(state, {0.5, 0.5, 0.5}, D, {0.0, 0.3, 0.0});
    add_particle(state, {0.5 + D, 0.5, 0.5}, D, {0.0, -0.2, 0.1});
    state.density = {900.0, 1100.0};
    const double q = 1.0 / ratio;
    const double laplacian =
        paper ? 45.0 / (PI * std::pow(h, 5)) * (1.0 - q) : 420.0 / (PI * std::pow(h, 5)) * std::pow(1.0 - q, 3);
    const double moment = lattice_moments(GetParam(), h, D).viscosity;
    const double factor = 0.7 / 900.0 * state.mass[1] / 1100.0 * laplacian / moment;
    const VectorSum a = viscosity_acceleration(settings, state, neighbors(), 0);
    expect_near(a.value, factor * glm::dvec3(0.0, -0.5, 0.1), 1e-5 * a.magnitude);
    const VectorSum b = viscosity_acceleration(settings, state, neighbors(), 1);
    expect_near(a.value * state.mass[0], -b.value * state.mass[1], 1e-12 * b.magnitude * state.mass[1]);
}

// Two fluids that slide over each other: with the harmonic mean the interface moves as fast as makes both stresses
// equal, mu_1 slope_1 = mu_2 slope_2; and what one gives the other takes.
TEST_P(ReferenceForces, BetweenTwoFluidsViscosityIsTheHarmonicMean)
{
    settings.params.viscosity[0] = 0.5f;
    settings.params.viscosity[2] = 2.0f;
    settings.params.friction[1] = 0.3f;
    add_particle(state, {0.5, 0.5, 0.5}, D, {0.0, 1.0, 0.0});
    add_particle(state, {0.5 + D, 0.5, 0.5}, D);
    const auto force = [&](std::size_t i) {
        return viscosity_acceleration(settings, state, neighbors(), i).value.y * state.mass[i];
    };
    const double thin = force(0);
    EXPECT_LT(thin, 0.0);
    state.attributes[1] = shared::pack_attributes(shared::STATE_FLUID, 2);
    EXPECT_NEAR(force(0) / thin, 2.0 * 0.5 * 2.0 / (0.5 + 2.0) / 0.5, 1e-12);
    EXPECT_NEAR(force(1) / force(0), -1.0, 1e-12);
    settings.params.viscosity[2] = 0.0f;
    EXPECT_EQ(force(0), 0.0);
    state.attributes[1] = shared::pack_attributes(shared::STATE_COLLIDER, 1);
    state.weight[1] = state.mass[1] / 1000.0 / std::pow(D, 3);
    EXPECT_NEAR(force(0) / thin, 0.3 / 0.5, 1e-6); // friction is the collider's alone
}

TEST_P(ReferenceForces, ViscosityOfAParabolaIsItsSecondDerivative)
{
    set_viscosity(settings.params, 2.0f);
    const std::size_t middle = add_cube(4);
    for (std::size_t i = 0; i < state.size(); ++i) {
        const glm::dvec3 r = state.position[i] - state.position[middle];
        state.velocity[i] = {3.0 * r.y + 5.0 * r.z, 7.0 * r.x * r.x, 0.1};
    }
    const VectorSum a = viscosity_acceleration(settings, state, neighbors(), middle);
    expect_near(a.value, {0.0, 2.0 / 1000.0 * 14.0, 0.0}, 1e-5 * a.magnitude);
}

// --- surface tension -----------------------------------------------------------------------------

TEST_P(ReferenceForces, TensionOfTwoParticlesMatchesTheFormula)
{
    settings.params.surface_tension = 0.5f;
    settings.params.tension_threshold = 1e-3f;
    add_particle(state, {0.5, 0.5, 0.5}, D);
    add_particle(state, {0.5 + D, 0.5, 0.5}, D);
    const double q = 1.0 / ratio;
    const double laplacian = paper ? -945.0 / (32.0 * PI * std::pow(h, 5)) * (3.0 + (1.0 - q * q) * (3.0 - 7.0 * q * q))
                                   : -630.0 / (PI * std::pow(h, 5)) * (1.0 + (1.0 - q) * (1.0 - q) * (1.0 - 2.0 * q));
    const double volume = D * D * D;
    const double moment = lattice_moments(GetParam(), h, D).color_laplacian;
    const double expected = -0.5 / 1000.0 * volume * laplacian / moment; // toward the other particle, where c grows
    const VectorSum a = tension_acceleration(settings, state, neighbors(), 0);
    expect_near(a.value, {expected, 0.0, 0.0}, 1e-5 * a.magnitude);
    expect_near(tension_acceleration(settings, state, neighbors(), 1).value, {-expected, 0.0, 0.0}, 1e-5 * a.magnitude);
}

TEST_P(ReferenceForces, TensionActsAtTheSurfaceAndNotInside)
{
    settings.params.surface_tension = 0.5f;
    const std::size_t middle = add_cube(4);
    EXPECT_EQ(tension_acceleration(settings, state, neighbors(), middle).value, glm::dvec3(0.0));
    const std::size_t corner = 0;
    EXPECT_GT(glm::length(tension_acceleration(settings, state, neighbors(), corner).value), 0.0);
    EXPECT_GT(color_field(settings, state, neighbors(), corner).gradient.value.x, 0.0); // into the fluid
    settings.params.tension_threshold = 1e6f;
    EXPECT_EQ(tension_acceleration(settings, state, neighbors(), corner).value, glm::dvec3(0.0));
}

TEST_P(ReferenceForces, ColorGradientOfAHalfSpaceIsOneSidedDelta)
{
    // Through a flat surface c rises from 0 to 1: the sum of its slope over the layers, times the spacing, is 1.
    add_lattice(state, glm::dvec3(0.5), glm::ivec3(11, 11, 7), D);
    const Neighbors all = neighbors();
    double rise = 0.0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        const glm::dvec3 offset = (state.position[i] - glm::dvec3(0.5)) / D;
        if (std::abs(offset.x - 5.0) < 0.1 && std::abs(offset.y - 5.0) < 0.1 && offset.z < 3.1) {
            rise += D * color_field(settings, state, all, i).gradient.value.z;
        }
    }
    EXPECT_NEAR(rise, 0.5, 0.12); // the particles sample the inner half of the rise
}

// --- walls ---------------------------------------------------------------------------------------

TEST_P(ReferenceForces, LatticeFillingABoxDoesNotNoticeTheWalls)
{
    const int n = 9;
    settings.params.domain_max = glm::vec3(static_cast<float>(n * D));
    settings.params.wall_mask = 63;
    settings.params.surface_tension = 1.0f;
    add_lattice(state, glm::dvec3(0.5 * D), glm::ivec3(n), D);
    std::fill(state.pressure.begin(), state.pressure.end(), 1000.0);
    const Accelerations a = accelerations(settings, state, neighbors());
    for (std::size_t i = 0; i < state.size(); ++i) {
        EXPECT_EQ(a.tension[i].value, glm::dvec3(0.0));
        EXPECT_GT(a.total[i].magnitude, 100.0);
        expect_near(a.total[i].value, glm::dvec3(0.0), 1e-5 * a.total[i].magnitude);
    }
}

TEST_P(ReferenceForces, WallPushesAParticleAsItsImageWould)
{
    settings.params.wall_mask = 1u << 3; // maximum of y
    add_particle(state, {0.5, 1.0 - 0.4 * D, 0.5}, D);
    state.pressure[0] = 700.0;
    const Accelerations wall = accelerations(settings, state, neighbors());
    add_particle(state, {0.5, 1.0 + 0.4 * D, 0.5}, D);
    state.pressure[1] = 700.0;
    settings.params.wall_mask = 0;
    const Accelerations pair = accelerations(settings, state, neighbors());
    EXPECT_LT(wall.pressure[0].value.y, 0.0);
    expect_near(wall.pressure[0].value, pair.pressure[0].value, 1e-12 * pair.pressure[0].magnitude);
}

TEST_P(ReferenceForces, FluidSlipsAlongAWallAndResistsComingNearer)
{
    set_viscosity(settings.params, 0.7f);
    settings.params.wall_mask = 1u << 2;
    add_particle(state, {0.5, 0.3 * D, 0.5}, D, {0.4, -0.1, 0.2});
    const VectorSum a = viscosity_acceleration(settings, state, neighbors(), 0);
    EXPECT_EQ(a.value.x, 0.0);
    EXPECT_GT(a.value.y, 0.0);
    EXPECT_EQ(a.value.z, 0.0);
}

TEST_P(ReferenceForces, EnergyOfAWallIsConserved)
{
    // Pressure forces are the derivative of the energy sum m u(rho), walls included: moving a particle changes the sum
    // of p/rho^2 m drho by its force. True of one kernel for density and pressure, so of Wendland.
    if (paper) {
        return;
    }
    settings.params.wall_mask = 63;
    settings.params.clamp_pressure = 0;
    Random random(8);
    add_lattice(state, glm::dvec3(0.3 * D), glm::ivec3(5), 0.9 * D);
    for (glm::dvec3& position : state.position) {
        position += 0.1 * D * random_vector(random);
    }
    // The lattice moments of density and gradient differ a little: undo them, as only the kernels of the continuum are
    // a pair.
    const KernelScales scale = continuum_scales(GetParam(), h);
    settings.params.density_scale = static_cast<float>(scale.density);
    settings.params.gradient_scale = static_cast<float>(scale.gradient);
    update_density(settings, state, neighbors());
    const State at_rest = state;
    for (const std::size_t i : {std::size_t{0}, std::size_t{7}, std::size_t{62}}) {
        const VectorSum a = pressure_acceleration(settings, at_rest, neighbors(), i);
        for (int axis = 0; axis < 3; ++axis) {
            const double e = 1e-6 * D;
            double work = 0.0;
            for (const double sign : {1.0, -1.0}) {
                state.position[i][axis] = at_rest.position[i][axis] + sign * e;
                update_density(settings, state, neighbors());
                for (std::size_t j = 0; j < state.size(); ++j) {
                    const double rho = at_rest.density[j];
                    work += sign * at_rest.mass[j] * at_rest.pressure[j] / (rho * rho) * state.density[j] / (2.0 * e);
                }
            }
            state.position[i] = at_rest.position[i];
            EXPECT_NEAR(at_rest.mass[i] * a.value[axis], -work, 1e-4 * at_rest.mass[i] * a.magnitude);
        }
    }
}

TEST_P(ReferenceForces, WallViscosityOpposesMotionAndVanishesForFreeSlip)
{
    settings.params.wall_mask = 1u << 2;
    add_particle(state, {0.5, 0.3 * D, 0.5}, D, {0.4, 0.1, 0.0});
    EXPECT_EQ(wall_viscosity_acceleration(settings, state, 0).value, glm::dvec3(0.0));
    settings.params.wall_viscosity = 0.9f;
    const double moment = lattice_moments(GetParam(), h, D).viscosity;
    const double factor = 0.9 / 1000.0 * wall_viscosity_integral(GetParam(), 0.3 * D, h) / moment;
    const VectorSum a = wall_viscosity_acceleration(settings, state, 0);
    expect_near(a.value, -factor * state.velocity[0], 1e-5 * a.magnitude);
}

TEST_P(ReferenceForces, ContactSpringPushesAndNeverPulls)
{
    settings.params.wall_mask = 63;
    const double reach = 0.25 * D;
    const double rate = 10.0 / D;
    add_particle(state, {0.5, 0.5 * reach, 0.5}, D);
    add_particle(state, {0.5, 0.5 * reach, 0.5}, D, {0.0, -1.0, 0.0});
    add_particle(state, {0.5, 0.5 * reach, 0.5}, D, {0.0, 1e6, 0.0});
    add_particle(state, {0.5, 1.001 * reach, 0.5}, D, {0.0, -1.0, 0.0});
    add_particle(state, {1.0, 0.0, 0.5}, D);
    const auto contact = [&](std::size_t i) {
        return contact_acceleration(settings, state, i).value;
    };
    expect_near(contact(0), {0.0, rate * rate * 0.5 * reach, 0.0}, 1e-4 * rate * rate * reach);
    expect_near(contact(1), {0.0, rate * rate * 0.5 * reach + rate, 0.0}, 1e-4 * rate * rate * reach);
    EXPECT_EQ(contact(2), glm::dvec3(0.0));
    EXPECT_EQ(contact(3), glm::dvec3(0.0));
    expect_near(contact(4), rate * rate * reach * glm::dvec3(-1.0, 1.0, 0.0), 1e-4 * rate * rate * reach);
}

// --- all together --------------------------------------------------------------------------------

TEST_P(ReferenceForces, InnerForcesOfADisorderedFluidConserveMomentum)
{
    set_viscosity(settings.params, 1.0f);
    Random random(5);
    add_lattice(state, glm::dvec3(0.4), glm::ivec3(8), D);
    for (std::size_t i = 0; i < state.size(); ++i) {
        state.position[i] += 0.3 * D * random_vector(random);
        state.velocity[i] = random_vector(random);
        state.mass[i] *= 1.0 + random.uniform();
    }
    update_density(settings, state, neighbors());
    const Accelerations a = accelerations(settings, state, neighbors());
    glm::dvec3 force(0.0);
    double magnitude = 0.0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        force += state.mass[i] * a.total[i].value;
        magnitude += state.mass[i] * glm::length(a.total[i].value);
    }
    EXPECT_GT(magnitude, 0.0);
    EXPECT_LT(glm::length(force), 1e-12 * magnitude);
}

TEST_P(ReferenceForces, TotalIsTheSumOfTheTermsAndGravity)
{
    set_viscosity(settings.params, 1.0f);
    settings.params.surface_tension = 0.3f;
    settings.params.wall_viscosity = 0.5f;
    settings.params.wall_mask = 63;
    settings.params.gravity = {0.1f, -9.81f, 0.2f};
    Random random(6);
    add_lattice(state, glm::dvec3(0.1 * D), glm::ivec3(5), 0.8 * D);
    for (glm::dvec3& velocity : state.velocity) {
        velocity = random_vector(random);
    }
    update_density(settings, state, neighbors());
    const Accelerations a = accelerations(settings, state, neighbors());
    const auto largest = [](const std::vector<VectorSum>& term) {
        double length = 0.0;
        for (const VectorSum& sum : term) {
            length = std::max(length, glm::length(sum.value));
        }
        return length;
    };
    for (const auto* term : {&a.pressure, &a.viscosity, &a.tension, &a.wall_viscosity, &a.contact}) {
        EXPECT_GT(largest(*term), 0.0);
    }
    for (std::size_t i = 0; i < state.size(); ++i) {
        const glm::dvec3 sum = a.pressure[i].value + a.viscosity[i].value + a.tension[i].value +
                               a.wall_viscosity[i].value + a.contact[i].value + glm::dvec3(settings.params.gravity);
        expect_near(a.total[i].value, sum, 1e-12 * a.total[i].magnitude);
        EXPECT_GE(a.total[i].magnitude * (1.0 + 1e-12), glm::length(a.total[i].value));
    }
}

} // namespace
} // namespace meltpoint::reference
