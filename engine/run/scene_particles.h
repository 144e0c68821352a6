#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "particles/particle_set.h"
#include "scene/scene.h"

namespace meltpoint {

/// The boundary particles of a collider.
struct ColliderParticles {
    std::uint32_t first_id = 0;    ///< they have consecutive ids
    std::vector<glm::vec3> points; ///< where they lie, by id, m
    glm::dvec3 center{0.0};        ///< of the box around the collider's shape, m
};

struct SceneParticles {
    ParticleSet particles;          ///< fluids in the order of the file, then solids, emitters' slots and colliders
    std::vector<std::string> notes; ///< sentences: fluid left out because its place was taken
    std::vector<ColliderParticles> colliders; ///< for each Scene::colliders
};

/// The particles of a scene at time 0: shapes filled, masses from rest density and measured volume, velocities set;
/// solids filled likewise, with the times when fronts reach them; the slots of emitters, dead, with their mass;
/// colliders as boundary particles, whose weights the simulation computes. Material of a particle: its fluid's, solid's
/// or collider's entry in scene_materials(scene). Where bodies overlap, fluid gives way to colliders, and to fluids
/// earlier in the file: such particles are left out, the others keep their masses. A mesh may be a file of points: a
/// scan, filled as CloudSolid says. Throws Input for files that cannot be read or filled, fluid outside the domain or
/// of which nothing is left, colliders outside the domain, and more than `limit` particles (what the device holds).
[[nodiscard]] SceneParticles make_scene_particles(const Scene& any_scene, std::uint64_t limit);

/// Without the notes.
[[nodiscard]] ParticleSet make_particles(const Scene& scene, std::uint64_t limit);

} // namespace meltpoint
