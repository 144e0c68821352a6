// Neighbor search by sorting particles and their images into cubic cells, one support radius wide; a row of three cells
// is one contiguous range. Unlike the GPU's grid it is unbounded, and images are entries of their own: positions
// anywhere find their neighbors.
#include "reference/cells.h"

#include <algorithm>
#include <cmath>

#include "core/parallel_for.h"

namespace meltpoint::reference {
namespace {

using Cell = glm::i64vec3;

struct Entry {
    Cell cell;
    Neighbor neighbor;
    glm::dvec3 position; // of the image
};

// Row by row: z first, x last.
bool cell_less(const Cell& a, const Cell& b)
{
    if (a.z != b.z) {
        return a.z < b.z;
    }
    return a.y != b.y ? a.y < b.y : a.x < b.x;
}

bool is_finite(const glm::dvec3& p)
{
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

Cell cell_of(const glm::dvec3& position, double cell_size)
{
    const double far = 1e15; // doubles convert to 64-bit integers without overflow below this
    return Cell(glm::clamp(glm::floor(position / cell_size), glm::dvec3(-far), glm::dvec3(far)));
}

bool are_neighbors(const glm::dvec3& a, const glm::dvec3& b, double support_radius)
{
    const glm::dvec3 r = a - b;
    return glm::dot(r, r) < support_radius * support_radius;
}

// Every set of borders out of `available` with at most one an axis, the empty set first.
std::vector<Reflection> reflections(std::uint32_t available, std::uint32_t periodic_mask)
{
    std::vector<Reflection> all;
    for (Reflection walls = 0; walls < 64; ++walls) {
        const bool both_of_an_axis = (walls & (walls >> 1) & 0b010101u) != 0u;
        if ((walls & ~available) == 0u && !both_of_an_axis) {
            Reflection shifts = 0;
            for (int axis = 0; axis < 3; ++axis) {
                shifts |= (walls & periodic_mask & 3u << 2 * axis) != 0u ? 1u << (6 + axis) : 0u;
            }
            all.push_back(walls | shifts);
        }
    }
    return all;
}

std::uint32_t walls_within(const shared::SphParams& params, const glm::dvec3& position, double distance)
{
    std::uint32_t near = 0;
    for (int wall = 0; wall < 6; ++wall) {
        const int axis = wall / 2;
        const double plane = static_cast<double>(wall % 2 == 1 ? params.domain_max[axis] : params.domain_min[axis]);
        near |= std::abs(position[axis] - plane) < distance ? 1u << wall : 0u;
    }
    return near & (params.wall_mask | params.periodic_mask);
}

Neighbors concatenate(const std::vector<std::vector<Neighbor>>& lists)
{
    Neighbors neighbors;
    neighbors.start.reserve(lists.size() + 1);
    neighbors.start.push_back(0);
    for (const auto& list : lists) {
        neighbors.start.push_back(neighbors.start.back() + list.size());
    }
    neighbors.list.reserve(neighbors.start.back());
    for (const auto& list : lists) {
        neighbors.list.insert(neighbors.list.end(), list.begin(), list.end());
    }
    return neighbors;
}

} // namespace

Neighbors find_neighbors(const shared::SphParams& params, std::span<const glm::dvec3> position)
{
    const double support_radius = static_cast<double>(params.support_radius);
    // A hair wider, so that rounding never puts neighbors two cells apart.
    const double cell_size = support_radius * (1.0 + 1e-9);

    std::vector<Entry> entries;
    entries.reserve(position.size());
    for (std::uint32_t j = 0; j < position.size(); ++j) {
        if (!is_finite(position[j])) {
            continue;
        }
        for (const Reflection reflection :
             reflections(walls_within(params, position[j], support_radius), params.periodic_mask)) {
            const glm::dvec3 image = reflect_position(params, reflection, position[j]);
            entries.push_back({cell_of(image, cell_size), {j, reflection}, image});
        }
    }
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
        return a.cell == b.cell ? a.neighbor < b.neighbor : cell_less(a.cell, b.cell);
    });

    std::vector<std::vector<Neighbor>> lists(position.size());
    parallel_for(position.size(), [&](std::size_t i) {
        if (!is_finite(position[i])) {
            return;
        }
        const Neighbor itself{static_cast<std::uint32_t>(i), 0};
        const Cell cell = cell_of(position[i], cell_size);
        for (std::int64_t dz = -1; dz <= 1; ++dz) {
            for (std::int64_t dy = -1; dy <= 1; ++dy) {
                const Cell first = cell + Cell(-1, dy, dz);
                const Cell last = cell + Cell(1, dy, dz);
                auto entry = std::lower_bound(entries.begin(), entries.end(), first,
                                              [](const Entry& e, const Cell& c) { return cell_less(e.cell, c); });
                for (; entry != entries.end() && !cell_less(last, entry->cell); ++entry) {
                    if (entry->neighbor != itself && are_neighbors(position[i], entry->position, support_radius)) {
                        lists[i].push_back(entry->neighbor);
                    }
                }
            }
        }
        std::sort(lists[i].begin(), lists[i].end());
    });
    return concatenate(lists);
}

Neighbors find_neighbors_by_brute_force(const shared::SphParams& params, std::span<const glm::dvec3> position)
{
    const std::vector<Reflection> all_reflections =
        reflections(params.wall_mask | params.periodic_mask, params.periodic_mask);
    std::vector<std::vector<Neighbor>> lists(position.size());
    parallel_for(position.size(), [&](std::size_t i) {
        const Neighbor itself{static_cast<std::uint32_t>(i), 0};
        for (std::uint32_t j = 0; j < position.size(); ++j) {
            for (const Reflection reflection : all_reflections) {
                const Neighbor neighbor{j, reflection};
                const glm::dvec3 image = reflect_position(params, reflection, position[j]);
                if (neighbor != itself &&
                    are_neighbors(position[i], image, static_cast<double>(params.support_radius))) {
                    lists[i].push_back(neighbor);
                }
            }
        }
    });
    return concatenate(lists);
}

} // namespace meltpoint::reference
