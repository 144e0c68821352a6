#include "geometry/volume_sampling.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/parallel_for.h"
#include "geometry/blue_noise_filling.h"
#include "geometry/cell_grid.h"
#include "geometry/lattice_filling.h"
#include "geometry/mesh_solid.h"

namespace meltpoint {

namespace {

constexpr double range_for_spacing = 0.025; // the lattice may be this much finer or coarser than asked
constexpr double range_for_count = 0.005;   // so that the count is met within 1.6 %

} // namespace

VolumeSamples sample_volume(const Solid& solid, const VolumeRequest& request)
{
    const glm::dvec3 size(solid.bounds().size());
    const PointSpacing* asked = std::get_if<PointSpacing>(&request.amount);
    const double range = asked != nullptr ? range_for_spacing : range_for_count;
    if (asked != nullptr) {
        check_lattice(size, asked->meters, range); // before the volume, which may take time
    }
    const double volume = solid.volume();
    if (!(volume > 0.0)) {
        throw input_error("the shape to fill encloses no volume: it is flat, or its triangles or normals face inward");
    }
    const std::size_t count =
        asked != nullptr ? static_cast<std::size_t>(std::max(std::round(volume / std::pow(asked->meters, 3)), 1.0))
                         : std::get<PointCount>(request.amount).points;
    if (count == 0) {
        throw input_error("the number of points to fill a shape with is 0, but must be positive");
    }
    const double spacing = asked != nullptr ? asked->meters : std::cbrt(volume / static_cast<double>(count));
    check_lattice(size, spacing, range);
    return request.lattice == Lattice::BlueNoise ? fill_with_blue_noise(solid, count, request.seed, request.relaxation)
                                                 : fill_with_lattice(solid, request.lattice, spacing, range);
}

VolumeSamples sample_volume(const TriangleMesh& mesh, double spacing)
{
    validate(mesh, "mesh to fill");
    return sample_volume(MeshSolid(weld(mesh)), {.amount = PointSpacing{spacing}});
}

VolumeSamples sample_block(const Aabb& block, double spacing)
{
    const glm::dvec3 size = glm::dvec3(block.max) - glm::dvec3(block.min);
    if (!(size.x > 0.0 && size.y > 0.0 && size.z > 0.0)) {
        throw input_error("the block from ({}, {}, {}) to ({}, {}, {}) is empty", block.min.x, block.min.y, block.min.z,
                          block.max.x, block.max.y, block.max.z);
    }
    check_lattice(size, spacing, range_for_spacing);
    const glm::uvec3 count(glm::round(size / spacing));
    if (count.x == 0 || count.y == 0 || count.z == 0) {
        throw too_thin(size, spacing);
    }
    return sample_block(block, count);
}

VolumeSamples sample_block(const Aabb& block, const glm::uvec3& count)
{
    const glm::dvec3 size = glm::dvec3(block.max) - glm::dvec3(block.min);
    CellGrid grid;
    grid.origin = glm::dvec3(block.min);
    grid.count = count;
    grid.cell_size = size / glm::dvec3(grid.count);

    VolumeSamples samples;
    samples.positions.resize(grid.size());
    parallel_for(grid.count.z, [&](std::size_t z) {
        glm::uvec3 cell(0, 0, z);
        for (cell.y = 0; cell.y < grid.count.y; ++cell.y) {
            for (cell.x = 0; cell.x < grid.count.x; ++cell.x) {
                samples.positions[grid.index(cell)] = glm::vec3(grid.point(cell));
            }
        }
    });
    samples.volume = size.x * size.y * size.z;
    samples.particle_volume = samples.volume / static_cast<double>(grid.size());
    samples.spacing = std::cbrt(samples.particle_volume);
    return samples;
}

VolumeSamples sample_sphere(const glm::vec3& center, float radius, double spacing)
{
    if (!std::isfinite(radius) || radius <= 0.0f) {
        throw input_error("the radius of the sphere is {} m, but must be positive", radius);
    }
    if (!glm::all(glm::lessThan(glm::abs(center), glm::vec3(std::numeric_limits<float>::max())))) {
        throw input_error("the center of the sphere ({}, {}, {}) is not finite", center.x, center.y, center.z);
    }
    return sample_volume(BallSolid(center, radius), {.amount = PointSpacing{spacing}});
}

} // namespace meltpoint
