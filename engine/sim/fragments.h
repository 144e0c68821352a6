#pragma once

#include <cstdint>
#include <vector>

#include "gpu/commands.h"
#include "particle_buffers/particle_buffers.h"
#include "shared/rigid.h"
#include "sim/boundary_forces.h"
#include "sim/neighbor_grid.h"
#include "sim/solver.h"

namespace meltpoint::sim {

/// What fragments need of a scene.
struct FragmentSettings {
    shared::RigidParams params{};
};

/// Pieces of solids that nothing holds, and how they move as rigid bodies (shared/rigid.h). At a look of a simulation
/// after which others are solid: find_pieces, then, where it says that the pool has changed, a partition of the pool;
/// then make_bodies. At the end of every step: record_step.
class Fragments {
public:
    /// Throws Device when its buffers do not fit.
    Fragments(const gpu::Context& context, const FluidOptions& options, const shared::SphParams& params,
              const FragmentSettings& settings);

    /// Finds the pieces, and loosens those that nothing holds; those too small for it are free, at `time` (s), which is
    /// noted in release_time, by id. The particles must lie sorted by cell (record_partition), and so they still do
    /// afterwards, although some of the still ones then ought to move. Several submissions of `commands`, and waits.
    shared::PieceChanges find_pieces(gpu::Commands& commands, const gpu::Buffer& params,
                                     const ParticleBuffers& particles, const NeighborGrid& grid,
                                     const gpu::Buffer& release_time, float time);

    /// Makes a body of every loose piece that find_pieces has found last, with the momentum and angular momentum of its
    /// particles. Waits. Loose particles must lie among the moving ones.
    void make_bodies(const ParticleBuffers& particles);

    /// The end of a step: bodies move, and their particles with them. `step` is its number.
    void record_step(gpu::Commands& commands, const Fluid& fluid, std::uint32_t step);

    /// How many there are.
    [[nodiscard]] std::uint32_t bodies() const { return body_count_; }
    /// As they are now. Waits.
    [[nodiscard]] std::vector<shared::Body> download_bodies() const;
    /// By id: the smallest id of the piece that a particle was of when pieces were last found, or NO_PIECE. Waits.
    [[nodiscard]] std::vector<std::uint32_t> download_labels() const;

    /// By id: the body that a particle is of, or NO_BODY. Those who have become solid since make_bodies are of none
    /// yet.
    [[nodiscard]] const gpu::Buffer& body_of() const { return body_of_; }
    /// What fluid does to loose particles, to be summed up in every step (sim/solver).
    [[nodiscard]] BoundaryForces* forces() { return body_count_ > 0 ? &forces_ : nullptr; }

    /// Timestamps of a step.
    [[nodiscard]] static std::uint32_t scopes() { return 1; }
    [[nodiscard]] std::uint64_t device_bytes() const;

private:
    void record_round(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                      const NeighborGrid& grid) const;

    const gpu::Context* context_;
    shared::SphParams params_;
    std::uint32_t dimensions_;
    std::uint32_t pool_;
    gpu::Kernel start_;
    gpu::Kernel hook_;
    gpu::Kernel jump_;
    gpu::Kernel census_;
    gpu::Kernel loosen_;
    gpu::Kernel touch_;
    gpu::Kernel step_;
    BoundaryForces forces_;
    gpu::Buffer rigid_;    ///< shared::RigidParams
    gpu::Buffer label_;    ///< uint by id
    gpu::Buffer pieces_;   ///< shared::Piece by name
    gpu::Buffer body_of_;  ///< uint by id
    gpu::Buffer place_;    ///< uint by id: where a loose particle lies
    gpu::Buffer touches_;  ///< shared::Touch by id
    gpu::Buffer changes_;  ///< shared::PieceChanges
    gpu::Buffer readback_; ///< the same
    std::uint32_t body_count_ = 0;
    gpu::Buffer bodies_;   ///< shared::Body
    gpu::Buffer members_;  ///< shared::BodyMember, body after body, in order of id
    gpu::Buffer contacts_; ///< shared::Contact, CONTACTS_A_MEMBER a member
    gpu::Buffer touching_; ///< uint: which of these there are, body after body
};

} // namespace meltpoint::sim
