#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include <glm/glm.hpp>

#include "particles/particle_set.h"
#include "shared/sph_params.h"

namespace meltpoint {

/// What one frame's row of the stats file says. SI units; sums run over the living particles in order of id, so that a
/// rerun gives the same bits. Undefined values (a mean over no fluid) are empty.
struct FrameStatistics {
    std::uint32_t frame = 0;
    double time = 0.0;       ///< s
    std::uint64_t steps = 0; ///< since the start of the run
    double dt = 0.0;         ///< s, mean of the steps since the frame before
    std::uint64_t solid = 0;
    std::uint64_t fluid = 0;
    std::uint64_t dust = 0;
    std::uint64_t collider = 0;
    std::uint64_t dead = 0;
    double mass = 0.0;             ///< kg
    double kinetic_energy = 0.0;   ///< J
    double potential_energy = 0.0; ///< J, zero in the domain's corner that lies farthest along gravity
    glm::dvec3 momentum{0.0};      ///< kg m/s
    /// What is measured of the fluid alone.
    struct Fluid {
        glm::dvec3 center_of_mass{0.0};  ///< m
        glm::dvec3 min{0.0};             ///< m
        glm::dvec3 max{0.0};             ///< m
        double density_error_mean = 0.0; ///< of max(0, rho/rho0 - 1)
        double density_error_max = 0.0;
        double speed_max = 0.0; ///< m/s
    };
    std::optional<Fluid> fluid_part; ///< empty without fluid
    std::uint64_t outside = 0;       ///< living particles that ever left the domain
    std::optional<double> neighbors_mean;
    double simulate_ms = 0.0; ///< wall time since the frame before
    double draw_ms = 0.0;
    std::optional<double> iterations_density;    ///< of a step's density solve, mean since the frame before
    std::optional<double> iterations_divergence; ///< likewise
    std::optional<double> iterations_viscosity;  ///< likewise
    double solid_volume = 0.0;                   ///< m^3
    std::array<double, 8> freed_mass{};          ///< kg, by CAUSE_*, of what is solid no more; not in the file
    std::uint64_t emitted = 0;                   ///< particles, since the start
    std::uint64_t sunk = 0;                      ///< likewise, dust at the end of its life among them
    std::optional<double> enthalpy;              ///< J, of all fluid and solid; empty where heat is not followed
    std::optional<double> exposed_area;          ///< m^2, of solids, likewise
    std::optional<double> rate_melt;        ///< kg/s that melted, net, mean since the frame before; empty in the first
    std::optional<double> rate_dissolve;    ///< likewise of what fronts have freed
    std::optional<double> rate_hydraulic;   ///< likewise of what flow has carried off, less what has settled
    std::optional<double> rate_wind;        ///< likewise of what the wind has taken
    std::optional<std::uint64_t> deposited; ///< particles of sediment and sand that became solid again, since the start
    std::optional<std::uint32_t> fragments; ///< loose pieces of solids; empty where none can break off
};

/// Everything but frame, time, steps, dt, neighbors and wall times.
[[nodiscard]] FrameStatistics measure(const ParticleSet& particles, const shared::SphParams& params);

/// The names of the columns, and one row, each ending in a newline. Later versions only append columns.
[[nodiscard]] std::string_view statistics_header();
[[nodiscard]] std::string statistics_row(const FrameStatistics& statistics);

} // namespace meltpoint
