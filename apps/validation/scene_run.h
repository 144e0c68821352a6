#pragma once

#include <cstddef>
#include <cstdint>

#include "core/progress.h"
#include "run/fluid_settings.h"
#include "run/frame_statistics.h"
#include "run/scene_particles.h"
#include "scene/scene.h"
#include "validation/case.h"

namespace meltpoint::validation {

/// "wcsph", "dfsph".
[[nodiscard]] std::string_view solver_name(Solver solver);

/// A scene on its way, looked at from time to time, and what most cases want to know of it.
class SceneRun {
public:
    /// samples: how many times advance_by will be called, for the progress that is shown.
    SceneRun(const Host& host, const Scene& scene, std::size_t samples);
    /// The same with other particles than those of the scene.
    SceneRun(const Host& host, const Scene& scene, ParticleSet particles, std::size_t samples);

    /// Runs on for so many seconds, and looks. Throws Interrupted, and as sim::Simulation does.
    void advance_by(double seconds);

    [[nodiscard]] sim::Simulation& simulation() { return simulation_; }
    [[nodiscard]] const FluidSettings& settings() const { return settings_; }
    [[nodiscard]] double time() const { return simulation_.time(); } ///< s
    /// At the last look, or the start.
    [[nodiscard]] const ParticleSet& particles() const { return particles_; }
    [[nodiscard]] const FrameStatistics& statistics() const { return statistics_; }

    /// Kinetic and potential energy in parts of the first potential energy; for scenes that have one.
    [[nodiscard]] double energy() const;
    /// How far energy has risen above its lowest value before, at most, in the same parts.
    [[nodiscard]] double energy_rise() const { return energy_rise_; }
    /// max(0, rho/rho0 - 1), mean over fluid particles and looks.
    [[nodiscard]] double density_error() const { return density_errors_ / static_cast<double>(looks_); }
    /// Particles that ever left the domain.
    [[nodiscard]] std::uint64_t outside() const { return statistics_.outside; }
    /// s, mean over all steps.
    [[nodiscard]] double mean_dt() const { return time() / static_cast<double>(simulation_.step()); }

private:
    Host host_;
    ParticleSet particles_;
    FluidSettings settings_;
    sim::Simulation simulation_;
    FrameStatistics statistics_;
    double first_potential_energy_;
    double lowest_energy_;
    double energy_rise_ = 0.0;
    double density_errors_ = 0.0;
    std::size_t looks_ = 0;
    Progress progress_;
};

} // namespace meltpoint::validation
