#pragma once

#include <cstdint>

#include <glm/glm.hpp>

#include "gpu/commands.h"
#include "particle_buffers/particle_buffers.h"
#include "shared/wind.h"
#include "sim/exposure.h"
#include "sim/solver.h"
#include "sim/visibility.h"

namespace meltpoint::sim {

/// Sand, of a material.
struct Sand {
    bool erodes = false;
    double grain_size = 250e-6;    ///< m
    double grain_density = 2650.0; ///< kg/m^3, of the mineral
    double cohesion = 3e-4;        ///< gamma, N/m, between grains
    double repose_angle = 34.0;    ///< degrees
};

/// What wind needs of a scene. There may be none, and sand slides all the same.
struct WindSettings {
    glm::vec3 direction{1.0f, 0.0f, 0.0f}; ///< of any length but 0; what of it goes along gravity is left out
    double friction_velocity = 0.0;        ///< u*, m/s
    double roughness_length = 1e-3;        ///< z0, m, of its logarithmic profile
    double air_density = 1.2;              ///< kg/m^3
    double flux = 1.8;                     ///< Bagnold's C: 1.5 of uniform sand, 1.8 of a dune's, 2.8 of mixed sizes
    double hop_length = 0.3;               ///< l, m
    double time_scale = 1.0;               ///< seconds of erosion in one of motion
    Sand sand[shared::MAX_MATERIALS];
};

/// u*_t, m/s, from which on wind moves sand: sqrt(0.0123 (rho_p g d + gamma / d) / rho_a) (Shao & Lu, "A simple
/// expression for wind erosion threshold friction velocity", J. Geophys. Res. 105, 2000). gravity in m/s^2.
[[nodiscard]] double threshold_friction_velocity(const Sand& sand, double air_density, double gravity);

/// Q, kg/(m s), of sand over a flat bed: C sqrt(d / 250 um) (rho_a / g) u*^3 (Bagnold 1941, The Physics of Blown Sand
/// and Desert Dunes); 0 below the threshold.
[[nodiscard]] double bagnold_flux(const WindSettings& settings, const Sand& sand, double gravity);

/// s, in which a grain of that size takes on most of the air's velocity: its terminal speed over gravity (drag of
/// Schiller & Naumann 1933).
[[nodiscard]] double response_time(const Sand& sand, double air_density, double gravity);

/// For the passes. `params` with gravity and domain filled in. Throws Input where there is no gravity or
/// no direction, or where a hop is shorter than four spacings, or longer than one that is launched at 1000 m/s.
[[nodiscard]] shared::WindParams wind_params(const WindSettings& settings, const shared::SphParams& params);

/// The map that the ground is seen on from above, and the one that shows what the wind sees.
[[nodiscard]] VisibilitySettings ground_view(const shared::WindParams& wind);
[[nodiscard]] VisibilitySettings wind_view(const shared::WindParams& wind);

/// Sand in the wind (shared/wind.h): what it takes and what lands is found out at the looks of a simulation; sand moves
/// in every step.
class Wind {
public:
    /// Throws as wind_params and Visibility.
    Wind(const gpu::Context& context, const shared::SphParams& params, const WindSettings& settings);

    /// Nobody is damaged or has come down.
    void record_start(gpu::Commands& commands) const;
    /// The wind has been at work before the start: of those at the surface, of which `exposure` is, some have almost
    /// been taken, by their ids. Waits.
    void spread_start(const gpu::Context& context, const Exposure& exposure) const;

    /// What of solids the wind sees, and the ground: to be found out again whenever others are solid. `exposure` must
    /// be that of the present solids.
    void record_surface(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                        const Exposure& exposure) const;

    /// What the wind has taken in the `seconds` of motion since the last look, or will have before the middle of the
    /// `next_seconds` until the next one, what slides by a spacing or falls off a
    /// slope, and what has landed, counted in `changes`, shared::PoolChanges: they lie where they were yet.
    void record_changes(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                        const NeighborGrid& grid, const Exposure& exposure, const gpu::Buffer& changes, double seconds,
                        double next_seconds);

    /// Sand in the air moves by the step that has just been taken. ledger: shared::Ledger.
    void record_step(gpu::Commands& commands, const Fluid& fluid, const gpu::Buffer& ledger) const;
    /// Of the commands of a step.
    [[nodiscard]] static std::uint32_t scopes() { return 1; }

    /// s of motion, the longest from one look to the next: in it the wind takes at most a tenth of a particle, and sand
    /// does not slide by more than a spacing.
    [[nodiscard]] double longest_look() const { return longest_look_; }

    /// s of motion, from one slide by a spacing to the next.
    [[nodiscard]] double slide_time() const { return slide_time_; }

    [[nodiscard]] const shared::WindParams& params() const { return params_; }
    /// The map from above, and of each of its texels the ground, vec4: height and slope of its plane, and its top (m
    /// above the floor); and the id of the solid particle on top, uint, 0xffffffff where there is none.
    [[nodiscard]] const Visibility& from_above() const { return from_above_; }
    [[nodiscard]] const gpu::Buffer& ground() const { return ground_; }
    [[nodiscard]] const gpu::Buffer& top_id() const { return top_id_; }
    /// By id: two-floats, 1 where a particle is about to hop.
    [[nodiscard]] const gpu::Buffer& damage() const { return damage_; }
    /// By id: uint, 1 where it has come down and waits to be solid.
    [[nodiscard]] const gpu::Buffer& rests() const { return rests_; }

    [[nodiscard]] std::uint64_t device_bytes() const;

private:
    shared::WindParams params_;
    double time_scale_;
    float spacing_;
    double slide_time_; ///< s, in which sand slides by a spacing
    double longest_look_;
    double slid_for_ = 0.0; ///< s, since it did
    Visibility visibility_; ///< by the wind
    Visibility from_above_;
    gpu::Kernel ground_kernel_;
    gpu::Kernel column_top_;
    gpu::Kernel erode_;
    gpu::Kernel slide_;
    gpu::Kernel alight_;
    gpu::Kernel slide_apply_;
    gpu::Kernel land_;
    gpu::Kernel hop_;
    gpu::Buffer params_buffer_; ///< shared::WindParams
    gpu::Buffer ground_;        ///< vec4 a texel
    gpu::Buffer top_id_;        ///< uint a texel: of the uppermost particle
    gpu::Buffer way_;           ///< uint a texel: shared::WAY_*, of this look
    gpu::Buffer claim_;         ///< uint a texel: who comes to lie there, of this look
    gpu::Buffer damage_;
    gpu::Buffer rests_;
};

} // namespace meltpoint::sim
