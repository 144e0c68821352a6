#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "validation/case.h"
#include "validation/scene_run.h"

namespace meltpoint::validation {

/// Water 1 m deep, at rest.
struct ColumnSettings {
    std::uint32_t layers = 40; ///< of particles
    std::uint32_t width = 8;   ///< of the box, in particles, and its depth in three dimensions
    std::uint32_t dimensions = 3;
    Solver solver = Solver::Wcsph; ///< of solved pressure, the run is in steps of any length: nothing to settle
    float support_ratio = 3.0f;
    float viscosity = 0.5f;      ///< Pa s
    double gravity_factor = 1.0; ///< the fluid's over the exact solution's: for what shall go wrong
};

/// What a column is like over some time.
struct ColumnProfile {
    double pressure_error = 0.0; ///< L2 of the difference / L2 of rho g (surface - y), of averages over time
    double depth = 0.0;          ///< twice the height of the center of mass, average over time, over the exact one
    std::vector<double> energy;  ///< kinetic energy / rho g h V, of each sample
    std::vector<std::pair<double, double>> pressure; ///< average of a layer: y/h, and p/(rho g h)

    [[nodiscard]] double largest_energy() const;
    /// Mean energy of the last quarter over that of the quarter before it: in the first half energy finds its balance
    /// between motion and compression. Less than 1e-6 counts as 1e-6.
    [[nodiscard]] double trend() const;
};

/// Compressed by its own weight, drho/rho = p/(rho c0^2) = e (1 - s) at the mass fraction s below, e = g h/c0^2, fluid
/// of depth h lies at y(s) = h (s - e (s - s^2/2)): its surface at h (1 - e/2), its center of mass at (1 - 2 e/3) h/2.
class StillColumn {
public:
    StillColumn(const Host& host, const ColumnSettings& settings);

    /// The damped start. Let go, the lattice swings about its compressed state in standing waves of sound whose
    /// wavelengths are odd fractions of 4 h: after h/c0 all of them pass through rest position at once. Velocities
    /// taken away there leave next to nothing, and some rounds of it nothing but rounding.
    void settle();
    /// Lets it be for so long.
    void run(double seconds);
    /// Averages over so many seconds, of so many samples, with so many looks at depth and pressure a sample. What is
    /// solved for goes up and down by some percent from step to step, in a cycle of a few steps: only all steps
    /// together bear the weight. Looks that are a longest step apart or less see all of them.
    [[nodiscard]] ColumnProfile profile(double seconds, std::uint32_t samples, std::uint32_t looks = 1);

private:
    Host host_;
    ColumnSettings settings_;
    Scene scene_;
    ParticleSet set_;
};

/// Ten seconds of a column, a hundred samples. A lattice under its own weight is not stable: within two seconds it
/// melts and sets free 2e-4 of rho g h V, which without viscosity nothing would ever take away. So the damped start
/// lets it melt and settles it again.
[[nodiscard]] ColumnProfile measure_still_water(const Host& host, const ColumnSettings& settings);

} // namespace meltpoint::validation
