#pragma once

#include <vector>

#include <glm/glm.hpp>

#include "core/aabb.h"
#include "geometry/triangle_mesh.h"

namespace meltpoint {

/// A shape filled with particles on a cubic lattice. With masses rest density * particle_volume it starts at its rest
/// density and at its true mass.
struct VolumeSamples {
    std::vector<glm::vec3> positions; ///< m; ordered by z, then y, then x
    double volume = 0.0;              ///< V of the shape, m^3
    double particle_volume = 0.0;     ///< V / N, m^3
    double spacing = 0.0;             ///< d of the lattice, m; of a block, the cube root of the particle volume
};

/// Fills the region of winding number >= 1/2. A lattice at exactly the asked spacing would miss the shape's volume by
/// percents, and particles that carry the missing mass would explode: so the spacing is chosen within 2.5 % and the
/// lattice is shifted until |N d^3 / V - 1| <= 0.2 %, or, where so few particles do not allow it, as near as the search
/// got. The volume is measured (measure_volume). Throws an Input error if the mesh is invalid or encloses nothing, the
/// spacing is not positive, the lattice would have more than 2^28 points, or the shape is too thin or small to be
/// filled to 10 % (naming size and spacing).
[[nodiscard]] VolumeSamples sample_volume(const TriangleMesh& mesh, double spacing);

/// Fills a box exactly: each axis gets the whole number of particles nearest to its length / spacing, the first half a
/// step inside. Errors as above; a side of less than half a spacing is too thin.
[[nodiscard]] VolumeSamples sample_block(const Aabb& block, double spacing);

/// Fills a ball, by the same search and with the same errors as a mesh; its volume is exact.
[[nodiscard]] VolumeSamples sample_sphere(const glm::vec3& center, float radius, double spacing);

/// Volume of the region of winding number >= 1/2 (m^3), by stratified sampling: two random points in each cell of a
/// grid over the mesh's box. Where they disagree the surface passes, and the number of such cells gives the standard
/// error; the grid is refined from 2^18 cells until it is at most 0.03 % (or 2^24 are reached, which only very thin
/// shapes need). For a closed mesh without self-intersections it agrees with signed_volume.
[[nodiscard]] double measure_volume(const TriangleMesh& mesh);

} // namespace meltpoint
