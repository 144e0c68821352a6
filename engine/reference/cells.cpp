// Neighbor search by sorting particles into cubic cells, one support radius wide; a row of three cells is one
// contiguous range of the sorted particles. Unlike the GPU's grid it is unbounded: positions anywhere find their
// neighbors.
#include "reference/cells.h"

#include <algorithm>
#include <cmath>

#include "core/parallel_for.h"

namespace meltpoint::reference {
namespace {

using Cell = glm::i64vec3;

struct SortedParticle {
    Cell cell;
    std::uint32_t index;
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

Neighbors concatenate(const std::vector<std::vector<std::uint32_t>>& lists)
{
    Neighbors neighbors;
    neighbors.start.reserve(lists.size() + 1);
    neighbors.start.push_back(0);
    for (const auto& list : lists) {
        neighbors.start.push_back(neighbors.start.back() + list.size());
    }
    neighbors.index.resize(neighbors.start.back());
    parallel_for(lists.size(), [&](std::size_t i) {
        std::copy(lists[i].begin(), lists[i].end(),
                  neighbors.index.begin() + static_cast<std::ptrdiff_t>(neighbors.start[i]));
    });
    return neighbors;
}

} // namespace

Neighbors find_neighbors(std::span<const glm::dvec3> position, double support_radius)
{
    // A hair wider, so that rounding never puts neighbors two cells apart.
    const double cell_size = support_radius * (1.0 + 1e-9);

    std::vector<SortedParticle> sorted;
    sorted.reserve(position.size());
    for (std::size_t i = 0; i < position.size(); ++i) {
        if (is_finite(position[i])) {
            sorted.push_back({cell_of(position[i], cell_size), static_cast<std::uint32_t>(i)});
        }
    }
    std::sort(sorted.begin(), sorted.end(), [](const SortedParticle& a, const SortedParticle& b) {
        return a.cell == b.cell ? a.index < b.index : cell_less(a.cell, b.cell);
    });

    std::vector<std::vector<std::uint32_t>> lists(position.size());
    parallel_for(sorted.size(), [&](std::size_t k) {
        const auto [cell, i] = sorted[k];
        std::vector<std::uint32_t>& list = lists[i];
        for (std::int64_t dz = -1; dz <= 1; ++dz) {
            for (std::int64_t dy = -1; dy <= 1; ++dy) {
                const Cell first = cell + Cell(-1, dy, dz);
                const Cell last = cell + Cell(1, dy, dz);
                auto particle =
                    std::lower_bound(sorted.begin(), sorted.end(), first,
                                     [](const SortedParticle& p, const Cell& c) { return cell_less(p.cell, c); });
                for (; particle != sorted.end() && !cell_less(last, particle->cell); ++particle) {
                    const std::uint32_t j = particle->index;
                    if (j != i && are_neighbors(position[i], position[j], support_radius)) {
                        list.push_back(j);
                    }
                }
            }
        }
        std::sort(list.begin(), list.end());
    });
    return concatenate(lists);
}

Neighbors find_neighbors_by_brute_force(std::span<const glm::dvec3> position, double support_radius)
{
    std::vector<std::vector<std::uint32_t>> lists(position.size());
    parallel_for(position.size(), [&](std::size_t i) {
        for (std::size_t j = 0; j < position.size(); ++j) {
            if (j != i && are_neighbors(position[i], position[j], support_radius)) {
                lists[i].push_back(static_cast<std::uint32_t>(j));
            }
        }
    });
    return concatenate(lists);
}

} // namespace meltpoint::reference
