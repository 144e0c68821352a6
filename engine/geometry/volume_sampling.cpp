#include "geometry/volume_sampling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/error.h"
#include "core/parallel_for.h"
#include "geometry/inside_mask.h"
#include "geometry/solid_region.h"

namespace meltpoint {

namespace {

constexpr double most_lattice_points = 268435456.0; // 2^28
constexpr double spacing_range = 0.025;             // the lattice may be this much finer or coarser than asked
constexpr double good_error = 1e-3;                 // of N d^3 / V: the search ends; half of what is promised
constexpr double worst_error = 0.1;                 // beyond it the shape is not filled at all
constexpr double search_budget = 3e7;               // lattice points that a search looks at, in all

struct Shape {
    glm::dvec3 center; ///< of the bounding box
    glm::dvec3 size;   ///< of the bounding box
    double volume;
};

void check_lattice(const glm::dvec3& size, double spacing)
{
    if (!std::isfinite(spacing) || spacing <= 0.0) {
        throw input_error("the particle spacing is {} m, but must be positive", spacing);
    }
    const glm::dvec3 steps = size / (spacing * (1.0 - spacing_range)) + 2.0;
    if (!(steps.x * steps.y * steps.z <= most_lattice_points)) {
        throw input_error("a shape of {:g} x {:g} x {:g} m at a particle spacing of {:g} m needs about {:.2g} lattice "
                          "points, at most {:.3g} are supported",
                          size.x, size.y, size.z, spacing, steps.x * steps.y * steps.z, most_lattice_points);
    }
}

Error too_thin(const glm::dvec3& size, double spacing)
{
    return input_error("a shape of {:g} x {:g} x {:g} m is too thin or too small to be filled at a particle spacing of "
                       "{:g} m",
                       size.x, size.y, size.z, spacing);
}

/// The lattice points that can lie in the shape: those at shape center + (whole number + shift) * spacing.
CellGrid lattice(const Shape& shape, double spacing, const glm::dvec3& shift)
{
    const glm::dvec3 half = 0.5 * shape.size / spacing;
    const glm::dvec3 first = glm::ceil(-half - shift);
    const glm::dvec3 last = glm::floor(half - shift);
    CellGrid grid;
    grid.origin = shape.center + (first + shift - 0.5) * spacing;
    grid.cell_size = glm::dvec3(spacing);
    grid.count = glm::uvec3(glm::max(last - first + 1.0, 0.0));
    return grid;
}

/// Spacings and shifts that cover their ranges evenly however many are tried (Kronecker sequences of the golden ratio
/// and its relatives), beginning with the asked spacing. The first third is centered, points or cells on the shape's
/// center, so that a symmetric shape starts symmetric if it can.
struct Candidate {
    double spacing_factor;
    glm::dvec3 shift;
};

Candidate candidate(std::size_t number, std::size_t count)
{
    const auto sequence = [number](double step) {
        return glm::fract(0.5 + static_cast<double>(number) * step);
    };
    const double factor = 1.0 + spacing_range * (2.0 * sequence(0.6180339887498949) - 1.0);
    if (number < count / 3) {
        return {factor, glm::dvec3(number % 2 == 0 ? 0.5 : 0.0)};
    }
    return {factor, {sequence(0.8191725133961645), sequence(0.6710436067037893), sequence(0.5497004779019703)}};
}

/// Searches spacing and shift; inside(grid) gives a byte a cell.
template <class Inside>
VolumeSamples fill(const Shape& shape, double asked_spacing, const Inside& inside)
{
    const glm::dvec3 steps = shape.size / asked_spacing + 1.0;
    const auto candidates =
        static_cast<std::size_t>(std::clamp(search_budget / (steps.x * steps.y * steps.z), 12.0, 1200.0));
    double best_error = worst_error;
    CellGrid best_grid;
    std::vector<std::uint8_t> best_mask;
    for (std::size_t i = 0; i < candidates && best_error > good_error; ++i) {
        const Candidate tried = candidate(i, candidates);
        const double spacing = asked_spacing * tried.spacing_factor;
        const CellGrid grid = lattice(shape, spacing, tried.shift);
        std::vector<std::uint8_t> mask = inside(grid);
        const double count = std::accumulate(mask.begin(), mask.end(), 0.0);
        const double error = std::abs(count * spacing * spacing * spacing / shape.volume - 1.0);
        if (error < best_error) {
            best_error = error;
            best_grid = grid;
            best_mask = std::move(mask);
        }
    }
    if (best_mask.empty()) {
        throw too_thin(shape.size, asked_spacing);
    }

    VolumeSamples samples;
    samples.positions.reserve(static_cast<std::size_t>(std::count(best_mask.begin(), best_mask.end(), 1)));
    glm::uvec3 cell(0);
    for (cell.z = 0; cell.z < best_grid.count.z; ++cell.z) {
        for (cell.y = 0; cell.y < best_grid.count.y; ++cell.y) {
            for (cell.x = 0; cell.x < best_grid.count.x; ++cell.x) {
                if (best_mask[best_grid.index(cell)] != 0) {
                    samples.positions.emplace_back(best_grid.point(cell));
                }
            }
        }
    }
    samples.volume = shape.volume;
    samples.particle_volume = shape.volume / static_cast<double>(samples.positions.size());
    samples.spacing = best_grid.cell_size.x;
    return samples;
}

/// About so many equal cells, as near to cubes as long thin boxes allow.
CellGrid cells_of_box(const Aabb& box, double cells)
{
    const glm::dvec3 size(box.size());
    const double edge = std::cbrt(size.x * size.y * size.z / cells);
    const double most = std::ceil(4.0 * std::cbrt(cells));
    CellGrid grid;
    grid.origin = glm::dvec3(box.min);
    grid.count = glm::uvec3(glm::clamp(glm::ceil(size / edge), 1.0, most));
    grid.cell_size = size / glm::dvec3(grid.count);
    return grid;
}

double measure_volume(const SolidRegion& region, const Aabb& box)
{
    constexpr std::array<double, 4> cell_counts = {0x1p18, 0x1p20, 0x1p22, 0x1p24};
    constexpr double wanted_error = 3e-4;
    const glm::dvec3 size(box.size());
    const double box_volume = size.x * size.y * size.z;
    if (!(box_volume > 0.0)) {
        return 0.0;
    }
    double inside = 0.0; // share of the box
    std::uint64_t seed = 0;
    for (const double cells : cell_counts) {
        CellGrid grid = cells_of_box(box, cells);
        grid.jitter_seed = ++seed;
        const std::vector<std::uint8_t> one = inside_mask(region, grid);
        grid.jitter_seed = ++seed;
        const std::vector<std::uint8_t> other = inside_mask(region, grid);
        double points = 0.0;
        double differences = 0.0;
        for (std::size_t i = 0; i < grid.size(); ++i) {
            points += one[i] + other[i];
            differences += one[i] != other[i] ? 1.0 : 0.0;
        }
        // Two samples x, y of a cell have a mean whose variance (x - y)^2 / 4 estimates; cells are independent.
        inside = points / (2.0 * static_cast<double>(grid.size()));
        if (std::sqrt(differences) <= wanted_error * points) { // also where nothing is inside
            break;
        }
    }
    return inside * box_volume;
}

} // namespace

double measure_volume(const TriangleMesh& mesh)
{
    return measure_volume(SolidRegion(weld(mesh)), bounds(mesh));
}

VolumeSamples sample_volume(const TriangleMesh& mesh, double spacing)
{
    validate(mesh, "mesh to fill");
    const Aabb box = bounds(mesh);
    check_lattice(box.size(), spacing);
    const SolidRegion region(weld(mesh));
    const double volume = measure_volume(region, box);
    if (!(volume > 0.0)) {
        throw input_error("the mesh to fill encloses no volume: it is flat, or its triangles face inward");
    }
    return fill({box.center(), box.size(), volume}, spacing,
                [&](const CellGrid& grid) { return inside_mask(region, grid); });
}

VolumeSamples sample_block(const Aabb& block, double spacing)
{
    const glm::dvec3 size = glm::dvec3(block.max) - glm::dvec3(block.min);
    if (!(size.x > 0.0 && size.y > 0.0 && size.z > 0.0)) {
        throw input_error("the block from ({}, {}, {}) to ({}, {}, {}) is empty", block.min.x, block.min.y, block.min.z,
                          block.max.x, block.max.y, block.max.z);
    }
    check_lattice(size, spacing);
    CellGrid grid;
    grid.origin = glm::dvec3(block.min);
    grid.count = glm::uvec3(glm::round(size / spacing));
    if (grid.size() == 0) {
        throw too_thin(size, spacing);
    }
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
    const double r = radius;
    const Shape shape{glm::dvec3(center), glm::dvec3(2.0 * r), 4.0 / 3.0 * std::numbers::pi * r * r * r};
    check_lattice(shape.size, spacing);
    return fill(shape, spacing, [&](const CellGrid& grid) {
        std::vector<std::uint8_t> mask(grid.size());
        parallel_for(grid.count.z, [&](std::size_t z) {
            glm::uvec3 cell(0, 0, z);
            for (cell.y = 0; cell.y < grid.count.y; ++cell.y) {
                for (cell.x = 0; cell.x < grid.count.x; ++cell.x) {
                    const glm::dvec3 from_center = grid.point(cell) - shape.center;
                    mask[grid.index(cell)] = glm::dot(from_center, from_center) <= r * r ? 1 : 0;
                }
            }
        });
        return mask;
    });
}

} // namespace meltpoint
