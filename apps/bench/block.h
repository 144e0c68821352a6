#pragma once

#include <cstdint>

#include "particles/particle_set.h"
#include "scene/scene.h"

namespace meltpoint::bench {

/// Of fewer the spacing would be so wide that the box is narrower than two support radii.
constexpr std::uint32_t fewest_particles = 65;

/// The benchmark's own scene: a cubic block of fluid, 1 m wide, in a box three times as long, one and a half times as
/// high and just as deep. H = 2.05 d.
[[nodiscard]] Scene block_scene(std::uint32_t particles);

/// Its particles, exactly `particles` of them: a cubic lattice, filled from the floor up, each particle moved by up to
/// 5 % of the spacing along each axis (seeded).
[[nodiscard]] ParticleSet block_particles(std::uint32_t particles, std::uint64_t seed);

} // namespace meltpoint::bench
