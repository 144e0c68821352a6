#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "core/aabb.h"
#include "geometry/measure_volume.h"
#include "geometry/relaxation.h"
#include "geometry/sample_amount.h"
#include "geometry/solid.h"
#include "geometry/triangle_mesh.h"

namespace meltpoint {

enum class Lattice {
    Cubic,
    Bcc,       ///< body-centered cubic
    Fcc,       ///< face-centered cubic: the densest packing
    BlueNoise, ///< no lattice: no two points close together, no gaps, no direction preferred
};

/// Which points to fill a solid with.
struct VolumeRequest {
    Lattice lattice = Lattice::Cubic;
    SampleAmount amount = PointCount{};
    std::uint64_t seed = 1;        ///< of blue noise: lattices do not depend on it
    RelaxationSettings relaxation; ///< of blue noise
};

/// A shape filled with particles. With masses rest density * particle_volume it starts at its rest density and at its
/// true mass.
struct VolumeSamples {
    std::vector<glm::vec3> positions; ///< m
    double volume = 0.0;              ///< V of the shape, m^3
    double particle_volume = 0.0;     ///< V / N, m^3
    /// d, m: d^3 is the volume of the lattice that belongs to one particle; V / N for a block and for blue noise
    double spacing = 0.0;
};

/// Fills a solid. A lattice at exactly the asked spacing would miss the volume by percents, and particles that carry
/// the missing mass would explode: so its spacing is chosen within 2.5 % (0.5 % where a count is asked, so that the
/// count is met within 2 %), and the lattice is shifted and, where all else fails, turned, until
/// |N d^3 / V - 1| <= 0.2 %, or, where so few particles do not allow it, as near as the search got. The order is by
/// the lattice's cells, x fastest, then y, then z.
///
/// Blue noise has exactly the count, or round(V / spacing^3), at least one: sample elimination (Yuksel 2015), then
/// relaxed until the density varies by at most 1 % and no two points are nearer than 0.71 times the distance in the
/// densest packing (relax_particles); a shape too thin for that gets what 400 rounds give.
///
/// Throws an Input error if the solid encloses nothing, count or spacing is not positive, the lattice would have more
/// than 2^28 points, or the shape is too thin or small to be filled to 10 % (naming size and spacing).
[[nodiscard]] VolumeSamples sample_volume(const Solid& solid, const VolumeRequest& request);

/// Fills the region of winding number >= 1/2 with a cubic lattice. An invalid mesh is an Input error as well.
[[nodiscard]] VolumeSamples sample_volume(const TriangleMesh& mesh, double spacing);

/// Fills a box exactly: each axis gets the whole number of particles nearest to its length / spacing, the first half a
/// step inside. Errors as above; a side of less than half a spacing is too thin.
[[nodiscard]] VolumeSamples sample_block(const Aabb& block, double spacing);

/// The same of a number along each axis.
[[nodiscard]] VolumeSamples sample_block(const Aabb& block, const glm::uvec3& count);

/// Fills a ball with a cubic lattice.
[[nodiscard]] VolumeSamples sample_sphere(const glm::vec3& center, float radius, double spacing);

} // namespace meltpoint
