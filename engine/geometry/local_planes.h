#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "geometry/lists.h"

namespace meltpoint {

/// The plane of least squares through each point of a cloud and its nearest neighbors (Hoppe, DeRose, Duchamp, McDonald
/// & Stuetzle 1992, section 3.1).
///
/// There are 20 neighbors, or all others where the cloud has fewer; 40 or 80 where 20 lie nearly on a line or all to
/// one side, as along the rows of a laser scanner, and more are on other sides. At the rim of a surface they are not.
class LocalPlanes {
public:
    /// Points must be finite, no two the same.
    explicit LocalPlanes(std::span<const glm::vec3> points);

    /// Nearest first.
    [[nodiscard]] std::span<const std::uint32_t> neighbors(std::size_t point) const { return neighbors_[point]; }

    /// Unit, of no particular sign; zero where even the most neighbors lie on a line.
    [[nodiscard]] const glm::vec3& normal(std::size_t point) const { return normals_[point]; }

    /// m: as far apart as the points would be here if they were even, s^2 being the area of one. The median over the
    /// point and its neighbors, so that a stray point has theirs.
    [[nodiscard]] double spacing(std::size_t point) const;

private:
    std::vector<glm::vec3> normals_;
    std::vector<float> own_spacings_; ///< by the distance of the last neighbor
    Lists<std::uint32_t> neighbors_;
};

} // namespace meltpoint
