#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "shared/particle_state.h"

namespace meltpoint {

/// The particles on the host, one array an attribute: the one form that the CPU reference, exports and checkpoints
/// share. SI units. All arrays but the last have the same length. In a set that comes from the device or from sampling,
/// particle i has id i.
struct ParticleSet {
    std::vector<std::uint32_t> id;
    std::vector<std::uint32_t> attributes; ///< shared::pack_attributes(state, material) and flags
    std::vector<glm::vec3> position;       ///< m
    std::vector<glm::vec3> velocity;       ///< m/s
    std::vector<glm::vec3> acceleration;   ///< m/s^2, of the last force evaluation
    std::vector<float> mass;               ///< kg; 0 for colliders
    std::vector<float> weight;   ///< in its neighbors' number density: 1 for fluids, for solids V over their fluid's,
                                 ///< V/d^3 for colliders
    std::vector<float> density;  ///< kg/m^3, boundary contributions included
    std::vector<float> pressure; ///< Pa

    /// s since the start, when a front reaches a solid particle and it turns into fluid; infinite where none does.
    /// Empty where no particle comes or changes, by whatever cause: the one array that may be. It is not read back from
    /// the device, which notes in it when particles were freed or born.
    std::vector<float> release_time;

    [[nodiscard]] std::size_t size() const { return position.size(); } ///< particles

    /// New particles are zero; ids continue with the index.
    void resize(std::size_t count)
    {
        const std::size_t old_count = id.size();
        id.resize(count);
        for (std::size_t i = old_count; i < count; ++i) {
            id[i] = static_cast<std::uint32_t>(i);
        }
        attributes.resize(count, shared::pack_attributes(shared::STATE_FLUID, 0));
        position.resize(count, glm::vec3(0.0f));
        velocity.resize(count, glm::vec3(0.0f));
        acceleration.resize(count, glm::vec3(0.0f));
        mass.resize(count, 0.0f);
        weight.resize(count, 1.0f);
        density.resize(count, 0.0f);
        pressure.resize(count, 0.0f);
    }
};

} // namespace meltpoint
