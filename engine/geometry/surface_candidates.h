#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "geometry/point_cloud.h"

namespace meltpoint {

/// An endless sequence of independent points, uniformly distributed over a surface. Point i depends on the seed and i
/// alone. The methods of sample_surface choose from it by number. Safe to use from several threads.
class SurfaceCandidates {
public:
    struct Placed {
        glm::vec3 position;
        glm::vec3 side; ///< unit: the normal of the piece of surface that it lies on
    };

    SurfaceCandidates() = default;
    SurfaceCandidates(const SurfaceCandidates&) = delete;
    SurfaceCandidates& operator=(const SurfaceCandidates&) = delete;
    virtual ~SurfaceCandidates() = default;

    [[nodiscard]] virtual Placed operator[](std::size_t i) const = 0;

    /// The first `count` positions.
    [[nodiscard]] std::vector<glm::vec3> positions(std::size_t count) const;

    /// The candidates of the given numbers, with all their attributes.
    [[nodiscard]] PointCloud cloud(std::span<const std::uint32_t> chosen) const;

    /// The first `count` candidates, with all their attributes.
    [[nodiscard]] PointCloud cloud(std::size_t count) const;

private:
    /// Room for so many, in all attributes that candidates have.
    [[nodiscard]] virtual PointCloud empty_cloud(std::size_t count) const = 0;

    /// Writes candidate `number` to a place of such a cloud.
    virtual void put(PointCloud& cloud, std::size_t place, std::size_t number) const = 0;
};

} // namespace meltpoint
