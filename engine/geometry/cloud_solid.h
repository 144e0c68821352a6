#pragma once

#include <tbb/collaborative_call_once.h>

#include "geometry/cloud_surface.h"
#include "geometry/solid.h"
#include "geometry/winding_number.h"

namespace meltpoint {

/// Where the winding number of a cloud of points is at least 1/2 (Barill, Dickson, Schmidt, Levin & Jacobson 2018,
/// section 3.2). Each point counts as an equilateral triangle with the area and the normal of its cell: from afar that
/// is the paper's dipole, and close by its solid angle stays finite, where a dipole's does not.
class CloudSolid final : public Solid {
public:
    explicit CloudSolid(const CloudSurface& surface);

    [[nodiscard]] Aabb bounds() const override { return bounds_; }

    /// Measured: see measure_volume(const Solid&). 0 for a cloud that lies flat or faces inward.
    [[nodiscard]] double volume() const override;

    [[nodiscard]] bool contains(const glm::dvec3& point) const override;
    [[nodiscard]] CellMask mask(const CellGrid& grid) const override;

    /// Whether it is a closed surface, to some 10 %, with its normals turned inward: its winding number inside is -1.
    [[nodiscard]] bool is_inside_out() const { return inside_out_; }

    [[nodiscard]] const WindingNumber& winding() const { return winding_; }

private:
    Aabb bounds_;
    double signed_volume_ = 0.0;
    bool inside_out_ = false;
    WindingNumber winding_;
    mutable tbb::collaborative_once_flag measured_;
    mutable double volume_ = 0.0;
};

} // namespace meltpoint
