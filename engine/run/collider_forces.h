#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

#include "run/scene_particles.h"
#include "sim/simulation.h"

namespace meltpoint {

/// What fluid does to one collider, mean over a time. In sums over its boundary particles in order of id, so that a
/// rerun gives the same bits.
struct ColliderForce {
    glm::dvec3 pressure{0.0}; ///< N
    glm::dvec3 friction{0.0}; ///< N
    glm::dvec3 torque{0.0};   ///< N m, of both about the collider's center

    [[nodiscard]] glm::dvec3 total() const { return pressure + friction; } ///< N
};

/// The forces on each collider, from what Simulation::take_boundary_forces says of their particles.
[[nodiscard]] std::vector<ColliderForce> collider_forces(const sim::Simulation::BoundaryForceMeans& means,
                                                         std::span<const ColliderParticles> colliders);

/// The names of the columns of the forces file, and the rows of a frame, one a collider, each ending in a newline. Of
/// frame 0, which no time leads up to, forces are empty. Later versions only append columns.
[[nodiscard]] std::string_view forces_header();
[[nodiscard]] std::string forces_rows(std::uint32_t frame, double time, std::span<const ColliderForce> forces);

} // namespace meltpoint
