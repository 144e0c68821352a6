#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "reference/state.h"
#include "shared/visibility.h"
#include "shared/wind.h"

namespace meltpoint::reference {

/// The ground at a texel of a map from above (include/ground.glsl): meters above the floor, and the slope's gradient.
struct Ground {
    double height;
    glm::dvec3 slope;
    double top;
};

/// Twin of sim/ground.comp. view, map: reference/visibility.h, along gravity.
[[nodiscard]] std::vector<Ground> ground(const Settings& settings, const shared::VisibilityParams& view,
                                         std::span<const std::uint32_t> map);

/// What of sand is kept by id.
struct SandState {
    std::vector<double> damage;       ///< 1: about to hop
    std::vector<std::uint32_t> rests; ///< 1: loose and at rest
};

/// What the passes of wind read besides the particles.
struct SandScene {
    const shared::WindParams& wind;
    const shared::VisibilityParams& view; ///< of the ground
    std::span<const Ground> ground;
};

/// Twin of sim/wind_erode.comp: what the wind takes in `seconds` of erosion, and what begins to slide. exposure
/// (reference/exposure.h) and visibility (reference/visibility.h, for the wind) are of each particle. How many are
/// freed.
std::size_t erode_by_wind(const Settings& settings, const SandScene& scene, State& state, SandState& sand,
                          std::span<const glm::dvec4> exposure, std::span<const double> visibility, double seconds);

/// Twin of sim/hop.comp: sand that hops or slides takes a step of params.dt.
void move_sand(const Settings& settings, const SandScene& scene, State& state, SandState& sand);

/// Twin of sim/land.comp and sim/land_apply.comp: loose sand at rest is solid where there is room. How many that are.
std::size_t land_sand(const Settings& settings, const shared::WindParams& wind, State& state, SandState& sand);

/// The part of space that still particles and their images fill at a place, and in y what of it pushes up
/// (include/solid_around.glsl).
[[nodiscard]] glm::dvec2 solid_around(const Settings& settings, const shared::WindParams& wind, const State& state,
                                      const glm::dvec3& x);

} // namespace meltpoint::reference
