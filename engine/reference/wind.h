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
    std::vector<std::uint32_t> rests; ///< 1: has come down, and waits to be solid
};

/// What the passes of wind read besides the particles.
struct SandScene {
    const shared::WindParams& wind;
    const shared::VisibilityParams& view; ///< of the ground
    std::span<const Ground> ground;
};

/// How many particles a look at sand has changed.
struct SandChanges {
    std::size_t picked_up = 0; ///< by the wind
    std::size_t fell = 0;      ///< off a slope
    std::size_t slid = 0;      ///< by a spacing
    std::size_t rolled = 0;    ///< on, where it came down
    std::size_t landed = 0;
};

/// Twin of a look: sim/column_top.comp, wind_erode.comp, alight.comp, slide.comp, slide_apply.comp (these two where it
/// `slides`) and land.comp. The wind has blown for `seconds` of erosion, and sand hops that
/// will be taken before it has blown `ahead` times as long; exposure (reference/exposure.h) and visibility
/// (reference/visibility.h, for the wind) are of each particle.
SandChanges look_at_sand(const Settings& settings, const SandScene& scene, State& state, SandState& sand,
                         std::span<const glm::dvec4> exposure, std::span<const double> visibility, double seconds,
                         double ahead, bool slides);

/// Twin of sim/hop.comp: sand in the air takes a step of params.dt.
void move_sand(const Settings& settings, const SandScene& scene, State& state, SandState& sand);

} // namespace meltpoint::reference
