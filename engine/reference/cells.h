#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "reference/walls.h"

namespace meltpoint::reference {

/// A particle or its image behind walls, as seen by another one.
struct Neighbor {
    std::uint32_t index;   ///< of the particle in the state
    Reflection reflection; ///< 0: the particle itself

    auto operator<=>(const Neighbor&) const = default;
};

/// The neighbors of every particle: all others, and all images of others and of itself, nearer than the support radius;
/// in ascending order of index, then reflection.
struct Neighbors {
    std::vector<std::size_t>
        start; ///< one more than particles: those of i are list[start[i]] .. list[start[i + 1] - 1]
    std::vector<Neighbor> list;

    [[nodiscard]] std::span<const Neighbor> of(std::size_t i) const
    {
        return {list.data() + start[i], start[i + 1] - start[i]};
    }
};

/// Positions in meters; support radius, domain and walls are those of params. Particles that are not finite have no
/// neighbors.
[[nodiscard]] Neighbors find_neighbors(const shared::SphParams& params, std::span<const glm::dvec3> position);

/// The same by trying every pair and every reflection: the truth that both grids are held to.
[[nodiscard]] Neighbors find_neighbors_by_brute_force(const shared::SphParams& params,
                                                      std::span<const glm::dvec3> position);

} // namespace meltpoint::reference
