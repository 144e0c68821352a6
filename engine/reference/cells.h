#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace meltpoint::reference {

/// The neighbors of every particle: all others nearer than the support radius, in ascending order of index.
struct Neighbors {
    std::vector<std::size_t>
        start; ///< one more than particles: those of i are index[start[i]] .. index[start[i + 1] - 1]
    std::vector<std::uint32_t> index; ///< of the particles in the state

    [[nodiscard]] std::span<const std::uint32_t> of(std::size_t i) const
    {
        return {index.data() + start[i], start[i + 1] - start[i]};
    }
};

/// Positions and support_radius in meters. Particles that are not finite have no neighbors.
[[nodiscard]] Neighbors find_neighbors(std::span<const glm::dvec3> position, double support_radius);

/// The same by trying every pair: the truth that both grids are held to.
[[nodiscard]] Neighbors find_neighbors_by_brute_force(std::span<const glm::dvec3> position, double support_radius);

} // namespace meltpoint::reference
