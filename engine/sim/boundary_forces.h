#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/commands.h"
#include "shared/reaction.h"
#include "sim/fluid_kernels.h"

namespace meltpoint::sim {

struct Fluid;

/// What fluid does to boundary particles, summed up step by step on the device: the reactions to the forces that they
/// exert on it, so that fluid and boundary together keep their momentum.
class BoundaryForces {
public:
    /// Whose forces are summed up: of all boundary particles, or of those among the moving particles alone.
    enum class Reach { All, Moving };

    /// attributes: of the particles by id. Throws Device when its buffer does not fit.
    BoundaryForces(const gpu::Context& context, const FluidOptions& options, std::span<const std::uint32_t> attributes,
                   Reach reach = Reach::All);

    /// After the forces of a step, with the velocities that these saw: friction, and pressure where it is not solved
    /// for.
    void record_forces(gpu::Commands& commands, const Fluid& fluid);
    /// After both solves of a step: what they have done. warm_start: Dfsph::warm_start().
    void record_impulses(gpu::Commands& commands, const Fluid& fluid, const gpu::Buffer& warm_start);
    /// Starts to sum anew.
    void record_reset(gpu::Commands& commands) const;

    /// The smallest id of a boundary particle, and how many ids there are from there to the largest; 0 without any.
    [[nodiscard]] std::uint32_t first_id() const { return first_id_; }
    [[nodiscard]] std::uint32_t count() const { return count_; }
    /// shared::Reaction[count()], by id from first_id() on.
    [[nodiscard]] const gpu::Buffer& reactions() const { return reactions_; }

private:
    [[nodiscard]] shared::ReactionPush push(const Fluid& fluid) const;

    Reach reach_;
    std::uint32_t first_id_ = 0;
    std::uint32_t count_ = 0;
    gpu::Kernel force_;
    gpu::Kernel impulse_;
    gpu::Buffer reactions_;
};

} // namespace meltpoint::sim
