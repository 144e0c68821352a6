#pragma once

#include "geometry/alias_table.h"
#include "geometry/cloud_surface.h"
#include "geometry/surface_candidates.h"

namespace meltpoint {

/// Points on the cells of a cloud, in the tangent planes of its points: the point by the area of its cell, then uniform
/// in the cell. They carry normal and color of the point.
class CloudCandidates final : public SurfaceCandidates {
public:
    /// The surface must outlive this.
    CloudCandidates(const CloudSurface& surface, std::uint64_t seed);

    [[nodiscard]] Placed operator[](std::size_t i) const override;

private:
    struct Candidate {
        glm::vec3 position;
        std::uint32_t point; ///< of the cloud
    };

    [[nodiscard]] Candidate candidate(std::size_t i) const;
    [[nodiscard]] PointCloud empty_cloud(std::size_t count) const override;
    void put(PointCloud& cloud, std::size_t place, std::size_t number) const override;

    const CloudSurface& surface_;
    AliasTable points_by_area_;
    std::uint64_t seed_;
};

} // namespace meltpoint
