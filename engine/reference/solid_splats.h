#pragma once

#include <span>
#include <vector>

#include "reference/state.h"
#include "shared/solid_splats.h"

namespace meltpoint::reference {

/// A flat disc in space. Without a radius it is not there, and nothing else of it is known.
struct Disc {
    glm::dvec3 center{0.0}; ///< m
    double radius = 0.0;    ///< m
    glm::dvec3 normal{0.0}; ///< of length 1
    glm::dvec3 color{0.0};  ///< linear RGB
    glm::dvec3 bend{0.0};   ///< 1/m, of a particle's disc: how its normal turns along it; else the way to its edge
    double edge = 0.0;      ///< m from the center to the edge
    double wet = 0.0;       ///< 0 to 1
};

/// What the splats of a frame are made from besides the particles, all by id; empty where the scene does not have it.
struct SplatSources {
    std::span<const float> freed_at;  ///< s
    std::span<const double> enthalpy; ///< J/kg
    std::span<const double> damage;   ///< 0 to 1
    std::span<const shared::HostedSplat> hosted;
    std::span<const std::uint32_t> cover; ///< the hosted splat above each particle, or shared::NO_COVER
    double time = 0.0;                    ///< s, of the frame
    double seconds = 0.0;                 ///< since the frame before
};

/// What a hosted splat carries from frame to frame.
struct KeptOfHosted {
    double start = 0.0; ///< c where it lay in the first frame; 0 before
    double wet = 0.0;   ///< 0 to 1
    double cover = 0.0; ///< how much it keeps particle splats below itself, 0 to 1
    bool gone = false;  ///< a host of its was freed, or they have parted
};

/// By the index of particles in their state, which is their id, but for the hosted ones.
struct SolidSplats {
    std::vector<double> left;       ///< 1 - progress of solids, -1 of fluid, else 0
    std::vector<double> size;       ///< of balls, in radii of a particle
    std::vector<double> wet;        ///< 0 to 1
    std::vector<double> start;      ///< c of solids in the first frame that has them
    std::vector<bool> changed;      ///< of solids: c is another, or there is fluid
    std::vector<KeptOfHosted> kept; ///< of hosted ones
    std::vector<Disc> particle;     ///< of each
    std::vector<Disc> hosted;
};

/// Twin of render/solid_progress.comp, surface_splat.comp, particle_splat.comp and bend_splat.comp. before:
/// of the frame before; empty vectors where there is none.
[[nodiscard]] SolidSplats solid_splats(const Settings& settings, const shared::SolidSplatParams& splats,
                                       const State& state, const SplatSources& sources, const SolidSplats& before);

} // namespace meltpoint::reference
