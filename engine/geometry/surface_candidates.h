#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

#include "geometry/alias_table.h"
#include "geometry/point_cloud.h"
#include "geometry/triangle_mesh.h"

namespace meltpoint {

/// An endless sequence of independent points, uniformly distributed over a surface: triangles by area from an alias
/// table, then uniform on the triangle by folding the unit square (Osada, Funkhouser, Chazelle & Dobkin 2002). Point i
/// depends on the seed and i alone. The methods of sample_surface choose from it by number.
class SurfaceCandidates {
public:
    struct Candidate {
        glm::vec3 position;
        std::uint32_t triangle;
        glm::vec2 barycentric; ///< as in PointCloud
    };

    /// The mesh must be valid and outlive this.
    SurfaceCandidates(const TriangleMesh& mesh, std::uint64_t seed);

    [[nodiscard]] Candidate operator[](std::size_t i) const;

    /// The first `count` positions.
    [[nodiscard]] std::vector<glm::vec3> positions(std::size_t count) const;

    /// The candidates of the given numbers, with normals.
    [[nodiscard]] PointCloud cloud(std::span<const std::uint32_t> chosen) const;

    /// The first `count` candidates, with normals.
    [[nodiscard]] PointCloud cloud(std::size_t count) const;

private:
    void put(PointCloud& cloud, std::size_t place, std::size_t number) const;

    const TriangleMesh& mesh_;
    AliasTable triangles_by_area_;
    std::uint64_t seed_;
};

} // namespace meltpoint
