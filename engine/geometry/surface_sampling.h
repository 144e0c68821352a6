#pragma once

#include <cstddef>
#include <cstdint>

#include "geometry/cloud_surface.h"
#include "geometry/point_cloud.h"
#include "geometry/sample_amount.h"
#include "geometry/triangle_mesh.h"

namespace meltpoint {

enum class SurfaceMethod {
    Random,     ///< each point uniformly distributed, independent of the others
    Stratified, ///< one point in each of N patches of equal area: fewer clumps and gaps
    BlueNoise,  ///< no two points close together, no gaps: the fewest points for the same coverage
};

/// Which points to take from a surface.
struct SurfaceRequest {
    SurfaceMethod method = SurfaceMethod::Random;
    SampleAmount amount = PointCount{};
    std::uint64_t seed = 1;
};

/// Points taken from a surface.
struct SurfaceSamples {
    PointCloud cloud;
    double area = 0.0;    ///< A of the surface, m^2
    double spacing = 0.0; ///< sqrt(A / N), m
};

/// Takes points from the surface of a mesh, which must be valid (validate()): exactly as many as asked, or
/// round(A / spacing^2), at least one. Each carries its triangle, its barycentric coordinates, and its normal:
/// interpolated from the vertices where all three have one, else the triangle's; and the color between those of the
/// vertices, where the mesh has them. The same seed gives the same points on
/// any number of threads. A spacing that is not positive, and more than 2^28
/// random or 2^24 other points, are Input errors.
[[nodiscard]] SurfaceSamples sample_surface(const TriangleMesh& mesh, const SurfaceRequest& request);

/// The same of a cloud of points: new points, as many as asked, on the tangent planes of those of the cloud, whose
/// normals and colors they carry.
[[nodiscard]] SurfaceSamples sample_surface(const CloudSurface& surface, const SurfaceRequest& request);

} // namespace meltpoint
