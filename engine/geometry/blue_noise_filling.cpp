// Sample elimination leaves too many points at the edge of their region, where they have fewer neighbors. So it works
// on a larger region, of whole cells, and goes on until the right number is left inside of the solid.

#include "geometry/blue_noise_filling.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "core/parallel_for.h"
#include "core/random.h"
#include "geometry/cell_grid.h"
#include "geometry/lattice_filling.h"
#include "geometry/outside_points.h"
#include "geometry/point_cells.h"
#include "geometry/relaxation.h"
#include "geometry/sample_elimination.h"

namespace meltpoint {

namespace {

constexpr double margin = 2.0;          // d: of the larger region around the solid
constexpr double most_candidates = 6e7; // what memory allows
constexpr double surplus = 1.2;         // of the samples, left when it is looked up which of them lie inside
constexpr std::size_t few = 10'000;     // particles: for fewer it is looked up for all candidates

/// Per particle. Few, because relaxation does the rest; but one particle should have some inside of a thin shape too.
double candidates_a_particle(std::size_t count)
{
    return 4.0 + 40.0 / static_cast<double>(count);
}

} // namespace

VolumeSamples fill_with_blue_noise(const Solid& solid, std::size_t count, std::uint64_t seed,
                                   const RelaxationSettings& relaxation)
{
    const glm::dvec3 size(solid.bounds().size());
    const auto check = [&](double candidates) {
        if (!(candidates <= most_candidates)) {
            throw input_error("a shape of {:g} x {:g} x {:g} m filled with {} points of blue noise needs about {:.2g} "
                              "candidates, at most {:.2g} are supported",
                              size.x, size.y, size.z, count, candidates, most_candidates);
        }
    };
    check(candidates_a_particle(count) * static_cast<double>(count));
    VolumeSamples samples;
    samples.volume = solid.volume();
    samples.particle_volume = samples.volume / static_cast<double>(count);
    samples.spacing = std::cbrt(samples.particle_volume);
    const CellsNear region = cells_near(solid, samples.spacing, margin * samples.spacing);
    const glm::dvec3& cell_size = region.grid.cell_size;
    const double region_volume = static_cast<double>(region.cells.size()) * cell_size.x * cell_size.y * cell_size.z;
    const double samples_in_region = region_volume / samples.particle_volume;
    const double candidates = std::ceil(samples_in_region * candidates_a_particle(count));
    if (region.cells.empty()) {
        throw too_thin(size, samples.spacing);
    }
    check(candidates);
    std::vector<glm::vec3> points(static_cast<std::size_t>(candidates));
    parallel_for(points.size(), [&](std::size_t i) {
        Random random(seed, i);
        const glm::uvec3 cell = region.cells[random.below(static_cast<std::uint32_t>(region.cells.size()))];
        const double x = random.uniform();
        const double y = random.uniform();
        const double z = random.uniform();
        points[i] = glm::vec3(region.grid.origin + cell_size * (glm::dvec3(cell) + glm::dvec3(x, y, z)));
    });

    const double densest = densest_packing * samples.spacing;
    const auto inside = [&](std::uint32_t i) {
        return solid.contains(glm::dvec3(points[i]));
    };
    const auto look_at = count < few ? points.size() : static_cast<std::size_t>(std::ceil(surplus * samples_in_region));
    const std::vector<std::uint32_t> kept =
        eliminate_samples({.points = points, .keep = count, .spacing = densest, .counts = inside, .look_at = look_at});
    if (kept.size() < count) {
        throw too_thin(size, samples.spacing);
    }
    std::vector<glm::vec3> unordered;
    unordered.reserve(count);
    for (const std::uint32_t i : kept) {
        unordered.push_back(points[i]);
    }
    const PointCells cells(unordered, samples.spacing);
    for (const std::uint32_t i : cells.order()) { // neighbors in space side by side
        samples.positions.push_back(unordered[i]);
    }
    relax_particles(samples.positions, solid, relaxation);
    return samples;
}

} // namespace meltpoint
