#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>

#include "reference/state.h"
#include "shared/rigid.h"

namespace meltpoint::reference {

/// The piece of every particle, by its place: the smallest id of those that it is connected to, or NO_PIECE where it is
/// not solid. body_of: by id, the body that a loose particle was made part of, or NO_BODY. Twin of sim/piece_hook.comp.
[[nodiscard]] std::vector<std::uint32_t> find_pieces(const Settings& settings, const State& state,
                                                     std::span<const std::uint32_t> body_of);

/// Pieces that nothing holds are loose from now on, or, where they are too small, fluid or dust. piece: as find_pieces
/// has it. Twin of sim/piece_census.comp and sim/piece_loosen.comp.
shared::PieceChanges loosen_pieces(const Settings& settings, const shared::RigidParams& rigid, State& state,
                                   std::span<const std::uint32_t> piece);

/// Of a particle that is part of a body: what it touches, along its slots' normals (shared/rigid.h).
struct BodyContact {
    std::uint32_t member = 0; ///< number of the particle within its body
    std::uint32_t slot = 0;   ///< 0: particles, 1 to 3: a wall across x, y or z
    glm::dvec3 normal{0.0};
    glm::dvec3 velocity{0.0}; ///< m/s, of the other
    double target = 0.0;      ///< m/s
    glm::dvec3 impulse{0.0};  ///< N s
};

struct RigidBody {
    std::vector<std::size_t> members; ///< places in the state, in order of id
    std::vector<glm::dvec3> arms;     ///< m, from the center when the body was made
    glm::dvec3 center{0.0};           ///< m
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
    double mass = 0.0;                 ///< kg
    glm::dvec3 velocity{0.0};          ///< m/s
    glm::dvec3 angular_momentum{0.0};  ///< kg m^2/s
    glm::dmat3 inverse_inertia{0.0};   ///< 1/(kg m^2), when the body was made
    std::vector<BodyContact> contacts; ///< of the last step
};

/// A body of each loose piece, with the momentum and angular momentum of its particles. piece: as find_pieces has it.
/// Space without periodic axes.
[[nodiscard]] std::vector<RigidBody> make_bodies(const Settings& settings, const State& state,
                                                 std::span<const std::uint32_t> piece);

/// Twin of sim/rigid_touch.comp and sim/rigid_step.comp: bodies and their particles a time step on. owed: N s, by
/// fluid to each particle, of this step and those before; afterwards what is left of it.
void step_bodies(const Settings& settings, const shared::RigidParams& rigid, State& state,
                 std::vector<RigidBody>& bodies, std::span<glm::dvec3> owed);

} // namespace meltpoint::reference
