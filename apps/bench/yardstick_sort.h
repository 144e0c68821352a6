#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "bench/yardstick_kernels.h"
#include "particles/particle_set.h"
#include "shared/sph_params.h"

namespace meltpoint::bench {

/// The yardstick's particles, sorted by cell, with their images behind walls among them as ghosts. A sort is four
/// calls, each made by every thread for its own part, with a barrier after each: count_cells, scan_cells (one thread
/// alone), scatter, use_new_order (one thread alone).
class SortedParticles {
public:
    SortedParticles(const ParticleSet& particles, const shared::SphParams& params, std::uint32_t threads);

    struct Range {
        std::uint32_t begin;
        std::uint32_t end;
    };
    /// The slots of a thread; other ones after a sort.
    [[nodiscard]] Range part(std::uint32_t thread) const
    {
        return {static_cast<std::uint32_t>(std::uint64_t{slots_} * thread / threads_),
                static_cast<std::uint32_t>(std::uint64_t{slots_} * (thread + 1) / threads_)};
    }

    void count_cells(std::uint32_t thread);
    void scan_cells();
    /// Accelerations only where asked for: a step computes them anew.
    void scatter(std::uint32_t thread, bool with_accelerations);
    void use_new_order();

    /// Gives the ghosts the pressure and volume of what they mirror.
    void copy_to_ghosts(std::uint32_t thread);

    [[nodiscard]] std::uint32_t particles() const { return particles_; }
    [[nodiscard]] std::uint32_t slots() const { return slots_; }
    [[nodiscard]] kernels::Arrays arrays() { return now_.arrays(); }
    [[nodiscard]] const std::uint8_t* is_ghost() { return now_.is_ghost.data(); }
    [[nodiscard]] const std::uint32_t* ids() { return now_.ids.data(); }
    [[nodiscard]] const std::uint32_t* attributes() { return now_.attributes.data(); }
    [[nodiscard]] kernels::Grid grid() const
    {
        return {cell_start_.data(), now_.cells.data(), size_.x, size_.x * size_.y};
    }

private:
    /// One order of the particles.
    struct Storage {
        void resize(std::size_t count);
        [[nodiscard]] kernels::Arrays arrays();

        std::size_t capacity = 0;
        std::vector<float> floats; ///< all of Arrays, one after the other
        std::vector<std::uint32_t> ids;
        std::vector<std::uint32_t> attributes;
        std::vector<std::uint8_t> is_ghost;
        std::vector<std::uint32_t> cells;
    };
    /// An image of a particle behind one, two or three walls.
    struct Ghost {
        std::uint32_t source; ///< slot of the particle: in the old, after the scatter in the new order
        std::uint32_t slot;   ///< of the ghost, in the new order
        std::uint32_t cell;
        glm::vec3 position;
        glm::vec3 velocity;
    };

    [[nodiscard]] std::uint32_t cell_of(const glm::vec3& x) const;
    void add_ghosts(std::uint32_t thread, std::uint32_t source);

    shared::SphParams params_;
    std::uint32_t threads_;
    std::uint32_t particles_; ///< without ghosts
    std::uint32_t slots_;     ///< with ghosts
    glm::uvec3 size_;         ///< cells with their border
    Storage now_;
    Storage next_;
    std::vector<std::uint32_t> cell_start_;
    std::vector<std::vector<std::uint32_t>> cell_counts_; ///< of each thread; after the scan where it puts the next one
    std::vector<std::vector<Ghost>> ghosts_;              ///< of each thread
    std::vector<std::uint32_t> new_slot_;
};

} // namespace meltpoint::bench
