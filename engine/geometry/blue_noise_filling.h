#pragma once

#include <cstddef>
#include <cstdint>

#include "geometry/volume_sampling.h"

namespace meltpoint {

/// The part of sample_volume for blue noise: exactly `count` particles by sample elimination, relaxed
/// (relax_particles). The solid's volume must be above zero, the count too.
[[nodiscard]] VolumeSamples fill_with_blue_noise(const Solid& solid, std::size_t count, std::uint64_t seed,
                                                 const RelaxationSettings& relaxation);

} // namespace meltpoint
