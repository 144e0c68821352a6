#pragma once

#include <cmath>
#include <cstddef>

#include <glm/glm.hpp>

#include "particles/particle_set.h"
#include "reference/state.h"

namespace meltpoint::conformance {

/// L2(difference) / L2(scale) over all particles.
class RelativeError {
public:
    void add(double difference, double scale)
    {
        difference2_ += difference * difference;
        scale2_ += scale * scale;
    }
    void add(const glm::vec3& gpu, const glm::dvec3& reference, double scale)
    {
        add(glm::length(glm::dvec3(gpu) - reference), scale);
    }
    [[nodiscard]] double value() const
    {
        return difference2_ == 0.0 ? 0.0 : std::sqrt(difference2_) / std::sqrt(scale2_);
    }

private:
    double difference2_ = 0.0;
    double scale2_ = 0.0;
};

/// Of positions, relative to where they are, and of velocities.
struct MotionError {
    RelativeError position;
    RelativeError velocity;
};

inline MotionError motion_error(const ParticleSet& gpu, const reference::State& twin)
{
    MotionError error;
    for (std::size_t i = 0; i < gpu.size(); ++i) {
        error.position.add(gpu.position[i], twin.position[i], glm::length(twin.position[i]));
        error.velocity.add(gpu.velocity[i], twin.velocity[i], glm::length(twin.velocity[i]));
    }
    return error;
}

} // namespace meltpoint::conformance
