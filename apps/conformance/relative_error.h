#pragma once

#include <cmath>

#include <glm/glm.hpp>

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

} // namespace meltpoint::conformance
