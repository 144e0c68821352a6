#pragma once

#include <memory>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "core/aabb.h"
#include "geometry/solid.h"
#include "run/scene_colliders.h"

namespace meltpoint {

/// How the particles of a fluid lie, m.
struct Pitch {
    float nearest = 0.0f; ///< the least distance of neighbors
    float spacing = 0.0f; ///< the edge of the cube that one stands for
};

/// What bodies have taken of the space at the start of a run, so that those to come find room: particles that start
/// inside each other would explode.
class TakenSpace {
public:
    /// period: the domain's lengths (m) along the axes where it is periodic, 0 along the others.
    explicit TakenSpace(const glm::vec3& period);

    /// A collider, and the clearance (m) that fluid at rest keeps from its boundary particles.
    void add(const std::string& name, const ColliderSamples& collider, float clearance);

    /// The particles of a fluid.
    void add(const std::string& name, const std::vector<glm::vec3>& fluid, const Pitch& pitch);

    /// Takes out of a fluid the particles for which there is no room, and says so in `notes`, one sentence a body.
    void clear(const std::string& name, std::vector<glm::vec3>& fluid, const Pitch& pitch,
               std::vector<std::string>& notes) const;

private:
    struct Body {
        std::string name;
        Aabb box; // of its points and its solid
        std::vector<glm::vec3> points;
        float clearance = 0.0f; // m: of a collider
        Pitch pitch;            // of a fluid
        bool is_fluid = false;
        std::shared_ptr<const Solid> solid; // null: nothing but the points
    };

    /// For each point 1 where it lies in the body's solid or nearer to its points than clearance (m), else 0.
    [[nodiscard]] std::vector<std::uint8_t> find_taken(const Body& body, const std::vector<glm::vec3>& points,
                                                       float clearance) const;
    static void mark_taken(const Body& body, const std::vector<glm::vec3>& points, const glm::vec3& shift,
                           float clearance, std::vector<std::uint8_t>& taken);

    /// Likewise of a fluid: 1 where two fluids of one lattice would share a place, or, where they meet in no particular
    /// way, where they would be too near to each other to start without pressure.
    [[nodiscard]] std::vector<std::uint8_t> find_taken_by_fluid(const Body& body, const std::vector<glm::vec3>& points,
                                                                const Pitch& pitch) const;

    void add(Body body);

    std::vector<glm::vec3> shifts_; // of images in a periodic domain, the first none
    std::vector<Body> bodies_;
};

} // namespace meltpoint
