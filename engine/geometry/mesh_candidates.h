#pragma once

#include "geometry/alias_table.h"
#include "geometry/surface_candidates.h"
#include "geometry/triangle_mesh.h"

namespace meltpoint {

/// Points on a mesh: triangles by area from an alias table, then uniform on the triangle by folding the unit square
/// (Osada, Funkhouser, Chazelle & Dobkin 2002).
class MeshCandidates final : public SurfaceCandidates {
public:
    /// The mesh must be valid and outlive this.
    MeshCandidates(const TriangleMesh& mesh, std::uint64_t seed);

    [[nodiscard]] Placed operator[](std::size_t i) const override;

private:
    struct Candidate {
        glm::vec3 position;
        std::uint32_t triangle;
        glm::vec2 barycentric; ///< as in PointCloud
    };

    [[nodiscard]] Candidate candidate(std::size_t i) const;
    [[nodiscard]] PointCloud empty_cloud(std::size_t count) const override;
    void put(PointCloud& cloud, std::size_t place, std::size_t number) const override;

    const TriangleMesh& mesh_;
    AliasTable triangles_by_area_;
    std::uint64_t seed_;
};

} // namespace meltpoint
