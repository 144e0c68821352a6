#pragma once

#include "support/fluid_box.h"
#include "support/gpu_test.h"

namespace meltpoint {

/// A column of fluid of `layers` layers in a box `width` spacings wide (and deep, in three dimensions), Wendland kernel
/// at H = 3 d.
class StillColumn {
public:
    StillColumn(const gpu::Context& context, std::uint32_t width, std::uint32_t layers, double viscosity,
                std::uint32_t dimensions = 3)
        : context_(&context), height_(layers * static_cast<double>(test_spacing)),
          settings_(box_settings(shared::KERNEL_WENDLAND, 3.0, {width, layers + 6, width},
                                 std::sqrt(test_gravity * height_), viscosity)),
          set_(fluid_in_corner({width, layers, width}))
    {
        if (dimensions == 2) {
            settings_ = plane_box_settings(shared::KERNEL_WENDLAND, 3.0, {width, layers + 6},
                                           std::sqrt(test_gravity * height_), viscosity);
            set_ = square_state({width, layers}, glm::vec2(0.5f * test_spacing));
        }
    }

    [[nodiscard]] const sim::SimulationSettings& settings() const { return settings_; }
    [[nodiscard]] double height() const { return height_; }

    /// Twice the height of the center of mass, m: the depth, of fluid not compressed. Compressed by its own weight,
    /// drho/rho = p/(rho c0^2) = e (1 - s) at the mass fraction s below, e = g h/c0^2, it lies at y(s) = h (s - e (s -
    /// s^2/2)), whose mean is (1 - 2 e/3) h/2.
    [[nodiscard]] double exact_depth() const { return height_ * (1.0 - 2.0 / 3.0 * compression()); }

    /// There the fluid ends: y(1).
    [[nodiscard]] double exact_surface() const { return height_ * (1.0 - 0.5 * compression()); }

    [[nodiscard]] static double exact_pressure(double depth_below_surface)
    {
        return static_cast<double>(test_rest_density) * test_gravity * std::max(0.0, depth_below_surface);
    }

    /// rho g h V, J: what kinetic energy is small against.
    [[nodiscard]] double weight_energy() const
    {
        double mass = 0.0;
        for (const float m : set_.mass) {
            mass += static_cast<double>(m);
        }
        return mass * test_gravity * height_;
    }

    /// The damped start. Let go, the lattice swings about its compressed state in standing waves of sound whose
    /// wavelengths are odd fractions of 4 h: after h/c0 all of them pass through rest position at once. Velocities
    /// taken away there leave next to nothing, and some rounds of it nothing but rounding.
    void settle()
    {
        const double quarter_period = height_ / static_cast<double>(settings_.params.speed_of_sound);
        for (int round = 0; round < 10; ++round) {
            set_ = run(quarter_period);
            std::fill(set_.velocity.begin(), set_.velocity.end(), glm::vec3(0.0f));
        }
    }

    /// The fluid `seconds` later; samples, if any are wanted, are taken at equal intervals.
    template <class Sample>
    ParticleSet run(double seconds, std::uint32_t samples, const Sample& sample)
    {
        sim::Simulation simulation(*context_, set_, settings_);
        const std::uint32_t steps = std::max(1u, steps_for(seconds, settings_) / samples);
        for (std::uint32_t i = 0; i < samples; ++i) {
            simulation.advance(steps);
            set_ = simulation.download();
            sample(set_);
        }
        return set_;
    }
    ParticleSet run(double seconds)
    {
        return run(seconds, 1, [](const ParticleSet&) {});
    }

    struct Profile {
        [[nodiscard]] double largest_energy() const { return *std::max_element(energy.begin(), energy.end()); }

        double pressure_error = 0.0; ///< L2 of the difference / L2 of rho g (depth - y), of averages over time
        double depth = 0.0;          ///< twice the center of mass's height, m, average over time
        std::vector<double> energy;  ///< kinetic energy / rho g h V, of each sample
    };

    /// Averages over so many seconds.
    Profile profile(double seconds, std::uint32_t samples)
    {
        std::vector<double> height(set_.size());
        std::vector<double> pressure(set_.size());
        Profile result;
        run(seconds, samples, [&](const ParticleSet& set) {
            for (std::size_t i = 0; i < set.size(); ++i) {
                height[i] += static_cast<double>(set.position[i].y) / samples;
                pressure[i] += static_cast<double>(set.pressure[i]) / samples;
            }
            result.energy.push_back(kinetic_energy(set) / weight_energy());
        });
        double error = 0.0;
        double exact_squared = 0.0;
        for (std::size_t i = 0; i < set_.size(); ++i) {
            const double exact = exact_pressure(exact_surface() - height[i]);
            error += std::pow(pressure[i] - exact, 2);
            exact_squared += exact * exact;
            result.depth += 2.0 * height[i] / static_cast<double>(set_.size());
        }
        result.pressure_error = std::sqrt(error / exact_squared);
        return result;
    }

private:
    [[nodiscard]] double compression() const
    {
        const double c0 = static_cast<double>(settings_.params.speed_of_sound);
        return test_gravity * height_ / (c0 * c0);
    }

    const gpu::Context* context_;
    double height_;
    sim::SimulationSettings settings_;
    ParticleSet set_;
};

} // namespace meltpoint
