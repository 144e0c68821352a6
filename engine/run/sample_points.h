#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geometry/cloud_surface.h"
#include "geometry/mesh_facts.h"
#include "geometry/point_cloud.h"
#include "geometry/surface_sampling.h"
#include "geometry/volume_sampling.h"

namespace meltpoint {

/// What to sample, and how.
struct SampleRequest {
    std::string source;  ///< "builtin:NAME", or the path of a mesh or of points
    bool volume = false; ///< points inside instead of on the surface
    /// Where neither method nor amount is given, the surface of a cloud keeps its own points; else Random is meant
    std::optional<SurfaceMethod> method;
    Lattice lattice = Lattice::Cubic;
    std::optional<SampleAmount> amount; ///< 100,000 points; as many as a cloud has on its surface
    std::uint64_t seed = 1;
    double rest_density = 1000.0; ///< kg/m^3
    bool measure = false;         ///< the volume too where only the surface is sampled, which can take longer than that
    std::function<void(std::string_view)> on_stage; ///< called when a stage is done, with its name; may be empty
};

/// Points and what was measured on the way.
struct SampledPoints {
    PointCloud cloud;
    MeshFacts facts;                                     ///< no triangles and no edges where the source is a cloud
    std::optional<CloudFacts> cloud_facts;               ///< where the source is one
    std::optional<double> volume;                        ///< m^3, by winding number
    double spacing = 0.0;                                ///< m: sqrt(area / N) on a surface, the lattice's in a volume
    std::optional<double> particle_mass;                 ///< kg: rest density * volume / N
    std::vector<std::pair<std::string, double>> seconds; ///< by stage
};

/// Samples a mesh or a cloud: loads it, takes points on its surface or inside, and measures. Of a cloud, missing
/// normals are estimated. The same request gives the same points on any number of threads. Errors as load_surface,
/// make_cloud_surface, sample_surface and sample_volume.
[[nodiscard]] SampledPoints sample_points(const SampleRequest& request);

} // namespace meltpoint
