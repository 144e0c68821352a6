#pragma once

#include "core/error.h"
#include "geometry/volume_sampling.h"

namespace meltpoint {

/// The part of sample_volume that searches a lattice (not BlueNoise): its spacing within (1 +- range) * spacing, its
/// place and its direction. The solid's volume must be above zero.
[[nodiscard]] VolumeSamples fill_with_lattice(const Solid& solid, Lattice lattice, double spacing, double range);

/// Throws an Input error unless the spacing is positive and at most 2^28 points of it, made finer by the range, lie in
/// a box of the given size (m).
void check_lattice(const glm::dvec3& size, double spacing, double range);

/// The Input error for a shape of the given size (m) that a spacing cannot fill.
[[nodiscard]] Error too_thin(const glm::dvec3& size, double spacing);

} // namespace meltpoint
