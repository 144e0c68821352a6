// Fluid in a box with mirror walls, on the CPU reference: what the GPU must do as well.
#include <cmath>

#include <gtest/gtest.h>

#include "reference/fluid_fixture.h"
#include "reference/measure.h"
#include "reference/step.h"

namespace meltpoint::reference {
namespace {

constexpr double D = 0.02;
constexpr double G = static_cast<double>(9.81f);

// A box of `box` spacings with `fluid` layers of fluid in its corner; c0 is ten times the expected speed.
struct Box {
    Settings settings;
    State state;
    double height;

    Box(std::uint32_t kernel, double support_ratio, glm::ivec3 box, glm::ivec3 fluid, double expected_speed,
        float viscosity)
        : settings(make_settings(kernel, D, support_ratio)), height(fluid.y * D)
    {
        shared::SphParams& p = settings.params;
        p.domain_max = glm::vec3(glm::dvec3(box) * D);
        p.wall_mask = 63;
        p.gravity = {0.0f, -9.81f, 0.0f};
        p.state_equation = shared::STATE_EQUATION_TAIT;
        set_viscosity(p, viscosity);
        p.speed_of_sound = static_cast<float>(10.0 * expected_speed);
        p.dt = 0.2f * p.support_radius / (1.1f * p.speed_of_sound);
        p.speed_limit = p.speed_of_sound;
        set_kernel_scales(p, kernel, D);
        add_lattice(state, glm::dvec3(0.5 * D), fluid, D);
        evaluate(settings, state);
    }

    [[nodiscard]] double energy() const { return kinetic_energy(state) + potential_energy(settings, state); }

    // Takes away speed at `rate` (1/s) meanwhile.
    void run(double seconds, double rate = 0.0)
    {
        const double dt = static_cast<double>(settings.params.dt);
        for (double t = 0.0; t < seconds; t += dt) {
            step(settings, state);
            for (glm::dvec3& velocity : state.velocity) {
                velocity *= std::exp(-rate * dt);
            }
        }
    }
};

void expect_sound(const Box& box)
{
    EXPECT_EQ(box.state.status.fault, shared::FAULT_NONE);
    for (std::size_t i = 0; i < box.state.size(); ++i) {
        EXPECT_EQ(box.state.attributes[i] & shared::FLAG_LEFT_DOMAIN, 0u);
        EXPECT_LT(box.state.density[i], 1300.0);
    }
}

TEST(BoxOfFluid, HydrostaticColumnHasTheRightPressureAndDepth)
{
    const int layers = 20;
    Box box(shared::KERNEL_WENDLAND, 3.0, {6, layers + 6, 6}, {6, layers, 6}, std::sqrt(G * layers * D), 0.5f);
    box.run(0.3, static_cast<double>(box.settings.params.speed_of_sound) / box.height);
    box.run(0.1);

    // Compressed by its own weight: drho/rho = p/(rho c0^2), so the depth is short by g h / (2 c0^2) of itself.
    const double c0 = static_cast<double>(box.settings.params.speed_of_sound);
    const double depth = box.height * (1.0 - 0.5 * G * box.height / (c0 * c0));
    EXPECT_NEAR(2.0 * center_of_mass(box.state).y, depth, 0.01 * depth);

    double error = 0.0;
    double exact_squared = 0.0;
    for (std::size_t i = 0; i < box.state.size(); ++i) {
        const double exact = 1000.0 * G * std::max(0.0, depth - box.state.position[i].y);
        error += std::pow(box.state.pressure[i] - exact, 2);
        exact_squared += exact * exact;
    }
    // The error is a ripple of half a layer's weight from layer to layer, whatever the depth: 40 layers are held to 3
    // %.
    EXPECT_LT(std::sqrt(error / exact_squared), 0.06);
    const double weight_energy = total_mass(box.state) * G * box.height;
    EXPECT_LT(kinetic_energy(box.state), 1e-4 * weight_energy);
    expect_sound(box);
}

TEST(BoxOfFluid, DamBreakNeverGainsEnergy)
{
    // Almost inviscid: what feeds energy into the fluid, at walls or within, has nothing to hide behind.
    for (const double support_ratio : {2.0, 3.0}) {
        Box box(shared::KERNEL_WENDLAND, support_ratio, {12, 14, 6}, {6, 8, 6}, std::sqrt(2.0 * G * 8 * D), 0.001f);
        const double start = box.energy();
        double last = start;
        const double energy_of_compression = 0.01 * start; // goes to and fro
        for (int i = 0; i < 10; ++i) {
            box.run(0.03);
            EXPECT_LT(box.energy(), last + energy_of_compression)
                << "H/d = " << support_ratio << ", t = " << 0.03 * (i + 1);
            last = std::min(last, box.energy());
        }
        EXPECT_GT(center_of_mass(box.state).x, 0.5 * 6 * D + D); // it did break
        expect_sound(box);
    }
}

TEST(BoxOfFluid, PaperKernelsSettleWithEnoughViscosity)
{
    Box box(shared::KERNEL_PAPER, 2.0, {10, 12, 5}, {5, 8, 5}, std::sqrt(2.0 * G * 8 * D), 4.0f);
    const double start = box.energy();
    box.run(0.6);
    EXPECT_LT(box.energy(), 0.75 * start);
    EXPECT_NEAR(center_of_mass(box.state).x, 5.0 * D, 0.7 * D);
    expect_sound(box);
}

TEST(BoxOfFluid, ParticlesThrownAtWallsEdgesAndCornersStayInside)
{
    for (const std::uint32_t kernel : {shared::KERNEL_PAPER, shared::KERNEL_WENDLAND}) {
        for (const double support_ratio : {2.0, 3.0}) {
            Settings settings = make_settings(kernel, D, support_ratio);
            settings.params.wall_mask = 63;
            const double speed = 0.1 * static_cast<double>(settings.params.speed_of_sound);
            State state;
            Random random(4);
            for (int i = 0; i < 27; ++i) {
                const glm::dvec3 aim(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1); // every face, edge and corner
                const glm::dvec3 start = glm::dvec3(0.5) + aim * (0.5 - 1.5 * D * (1.0 + random.uniform()));
                add_particle(state, start, D, speed * (aim + 0.2 * random_vector(random)) / std::sqrt(3.5));
            }
            evaluate(settings, state);
            for (int i = 0; i < 300; ++i) {
                step(settings, state);
            }
            EXPECT_EQ(state.status.fault, shared::FAULT_NONE);
            for (std::size_t i = 0; i < state.size(); ++i) {
                for (int axis = 0; axis < 3; ++axis) {
                    const double x = state.position[i][axis];
                    EXPECT_GT(std::min(x, 1.0 - x), 0.1 * D);
                }
            }
        }
    }
}

} // namespace
} // namespace meltpoint::reference
