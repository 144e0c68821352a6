#include "geometry/lattice_filling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "geometry/cell_grid.h"

namespace meltpoint {

namespace {

constexpr double most_lattice_points = 268435456.0; // 2^28
constexpr double good_error = 1e-3;                 // of N d^3 / V: the search ends; half of what is promised
constexpr double worst_error = 0.1;                 // beyond it the shape is not filled at all
constexpr double search_budget = 1e8;               // lattice points that a search looks at, in all
constexpr std::size_t centered_placements = 6;      // that a search tries first
constexpr std::size_t straight_placements = 16;     // and after them, those not turned

/// The points in a cubic cell of the lattice, moved off the cell's faces.
std::vector<glm::dvec3> cell_points(Lattice lattice)
{
    switch (lattice) {
    case Lattice::Bcc:
        return {{0.25, 0.25, 0.25}, {0.75, 0.75, 0.75}};
    case Lattice::Fcc:
        return {{0.25, 0.25, 0.25}, {0.75, 0.75, 0.25}, {0.75, 0.25, 0.75}, {0.25, 0.75, 0.75}};
    default:
        return {{0.5, 0.5, 0.5}};
    }
}

/// Where a lattice of the given spacing lies: cell corners at the shape's center + axes * (whole number + shift).
struct Placement {
    double spacing = 1.0; ///< m
    glm::dvec3 shift{0.0};
    glm::dmat3 axes{1.0};
};

/// Rotation by a unit quaternion, uniformly distributed for uniform u (Shoemake 1992).
glm::dmat3 rotation(const glm::dvec3& u)
{
    const double t1 = 2.0 * std::numbers::pi * u.y;
    const double t2 = 2.0 * std::numbers::pi * u.z;
    const double x = std::sqrt(1.0 - u.x) * std::sin(t1);
    const double y = std::sqrt(1.0 - u.x) * std::cos(t1);
    const double z = std::sqrt(u.x) * std::sin(t2);
    const double w = std::sqrt(u.x) * std::cos(t2);
    return {{1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)},
            {2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)},
            {2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)}};
}

/// Spacings, shifts and turns that cover their ranges evenly however many are tried (Kronecker sequences of the golden
/// ratio and its relatives), beginning with the asked spacing. The first are centered, a corner of a cell or a point on
/// the shape's center, so that a symmetric shape starts symmetric if it can; of the later ones every other is turned,
/// for shapes with faces that swallow whole layers at once.
Placement placement(std::size_t number, double asked_spacing, double range, const glm::dvec3& point)
{
    const auto sequence = [number](double step) {
        return glm::fract(0.5 + static_cast<double>(number) * step);
    };
    Placement place;
    place.spacing = asked_spacing * (1.0 + range * (2.0 * sequence(0.6180339887498949) - 1.0));
    if (number < centered_placements) {
        place.shift = number % 2 == 0 ? glm::dvec3(0.0) : -point;
        return place;
    }
    place.shift = {sequence(0.8191725133961645), sequence(0.6710436067037893), sequence(0.5497004779019703)};
    if (number >= straight_placements && number % 2 == 0) {
        place.axes =
            rotation({sequence(0.8566748838545029), sequence(0.733891856627126), sequence(0.6287067210378087)});
    }
    return place;
}

/// The cells that can have points in the shape.
CellGrid cells_of(const Solid& solid, const Placement& place, const std::vector<glm::dvec3>& points)
{
    const Aabb box = solid.bounds();
    const double cell_size = place.spacing * std::cbrt(static_cast<double>(points.size()));
    glm::dvec3 half(0.0); // of the box, along the axes of the lattice, in cells
    for (int axis = 0; axis < 3; ++axis) {
        half[axis] = glm::dot(glm::abs(place.axes[axis]), 0.5 * glm::dvec3(box.size())) / cell_size;
    }
    glm::dvec3 lowest = points.front();
    glm::dvec3 highest = points.front();
    for (const glm::dvec3& point : points) {
        lowest = glm::min(lowest, point);
        highest = glm::max(highest, point);
    }
    const glm::dvec3 first = glm::ceil(-half - place.shift - highest);
    const glm::dvec3 last = glm::floor(half - place.shift - lowest);
    CellGrid grid;
    grid.cell_size = glm::dvec3(cell_size);
    grid.axes = place.axes;
    grid.origin = glm::dvec3(box.center()) + place.axes * (cell_size * (first + place.shift));
    grid.count = glm::uvec3(glm::max(last - first + 1.0, 0.0));
    grid.points = points;
    return grid;
}

std::vector<glm::vec3> points_inside(const CellGrid& grid, const CellMask& mask)
{
    std::vector<glm::vec3> positions;
    positions.reserve(count_points(mask));
    glm::uvec3 cell(0);
    for (cell.z = 0; cell.z < grid.count.z; ++cell.z) {
        for (cell.y = 0; cell.y < grid.count.y; ++cell.y) {
            for (cell.x = 0; cell.x < grid.count.x; ++cell.x) {
                for (std::size_t i = 0; i < grid.points.size(); ++i) {
                    if ((mask[grid.index(cell)] >> i & 1) != 0) {
                        positions.emplace_back(grid.point(cell, i));
                    }
                }
            }
        }
    }
    return positions;
}

} // namespace

void check_lattice(const glm::dvec3& size, double spacing, double range)
{
    if (!std::isfinite(spacing) || spacing <= 0.0) {
        throw input_error("the particle spacing is {} m, but must be positive", spacing);
    }
    const glm::dvec3 steps = size / (spacing * (1.0 - range)) + 2.0;
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

VolumeSamples fill_with_lattice(const Solid& solid, Lattice lattice, double spacing, double range)
{
    const glm::dvec3 size(solid.bounds().size());
    const double volume = solid.volume();
    const std::vector<glm::dvec3> points = cell_points(lattice);
    const glm::dvec3 steps = size / spacing + 1.0;
    const auto trials =
        static_cast<std::size_t>(std::clamp(search_budget / (steps.x * steps.y * steps.z), 48.0, 800.0));
    double best_error = worst_error;
    double best_spacing = 0.0;
    CellGrid best_grid;
    CellMask best_mask;
    double fitting_spacing = 0.0; // that the last trial's count would have needed
    for (std::size_t i = 0; i < trials && best_error > good_error; ++i) {
        // Every placement gets a second trial with that spacing: where whole layers come and go the count stays.
        Placement place = placement(i / 2, spacing, range, points.front());
        if (i % 2 == 1) {
            if (!(std::abs(fitting_spacing / spacing - 1.0) <= range)) {
                continue;
            }
            place.spacing = fitting_spacing;
        }
        // A turned lattice can hit a plate thinner than its spacing often enough by chance, which would not be filled.
        if (place.axes != glm::dmat3(1.0) && std::min({size.x, size.y, size.z}) < spacing) {
            continue;
        }
        const CellGrid grid = cells_of(solid, place, points);
        CellMask mask = solid.mask(grid);
        const auto count = static_cast<double>(count_points(mask));
        const double error = std::abs(count * std::pow(place.spacing, 3) / volume - 1.0);
        fitting_spacing = std::cbrt(volume / count);
        if (error < best_error) {
            best_error = error;
            best_spacing = place.spacing;
            best_grid = grid;
            best_mask = std::move(mask);
        }
    }
    if (best_mask.empty()) {
        throw too_thin(size, spacing);
    }

    VolumeSamples samples;
    samples.positions = points_inside(best_grid, best_mask);
    samples.volume = volume;
    samples.particle_volume = volume / static_cast<double>(samples.positions.size());
    samples.spacing = best_spacing;
    return samples;
}

} // namespace meltpoint
