#include "geometry/mesh_solid.h"

#include <cmath>

#include <gtest/gtest.h>

#include "geometry/builtin_meshes.h"
#include "geometry/teapot.h"

namespace meltpoint {
namespace {

/// The cube, some of its triangles taken away.
TriangleMesh open_cube(std::size_t kept)
{
    TriangleMesh mesh = builtin_mesh("cube");
    mesh.triangles.resize(kept);
    return mesh;
}

/// Three times the same triangle, each with vertices of its own: everything is boundary.
TriangleMesh soup()
{
    TriangleMesh mesh;
    for (std::uint32_t i = 0; i < 3; ++i) {
        mesh.positions.insert(mesh.positions.end(), {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
        mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    return mesh;
}

TEST(MeshSolid, ConesCloseAnyMesh)
{
    EXPECT_TRUE(boundary_cones(builtin_mesh("torus")).triangles.empty());
    for (const TriangleMesh& mesh :
         {open_cube(11), open_cube(10), open_cube(5), open_cube(1), soup(), weld(soup()), teapot(4)}) {
        const TriangleMesh cones = boundary_cones(mesh);
        for (const glm::dvec3 point :
             {glm::dvec3(0.11, 0.23, -0.31), glm::dvec3(0.4, -0.2, 2.9), glm::dvec3(0.1, 1.7, 0.2)}) {
            const double closed = winding_number_exact(mesh, point) + winding_number_exact(cones, point);
            EXPECT_NEAR(closed, std::round(closed), 1e-9);
        }
    }
}

TEST(MeshSolid, TheMaskAgreesWithEveryPointsWindingNumber)
{
    for (const TriangleMesh& mesh : {teapot(5), open_cube(10), open_cube(7), builtin_mesh("cube")}) {
        const Aabb box = bounds(mesh);
        CellGrid grid;
        grid.count = {30, 15, 21};
        grid.origin = glm::dvec3(box.min) - 0.3;
        grid.cell_size = (glm::dvec3(box.size()) + 0.6) / glm::dvec3(grid.count);
        const MeshSolid solid(mesh);
        for (const bool jitter : {false, true}) {
            if (jitter) {
                grid.jitter_seed = 3;
            }
            const CellMask mask = solid.mask(grid);
            std::size_t undecided = 0;
            glm::uvec3 cell(0);
            for (cell.z = 0; cell.z < grid.count.z; ++cell.z) {
                for (cell.y = 0; cell.y < grid.count.y; ++cell.y) {
                    for (cell.x = 0; cell.x < grid.count.x; ++cell.x) {
                        const double w = winding_number_exact(mesh, grid.point(cell));
                        if (std::abs(w - 0.5) < 0.01) {
                            ++undecided; // within the error of the hierarchical sum: next to a hole
                        } else {
                            ASSERT_EQ(mask[grid.index(cell)] != 0, w > 0.5) << w;
                        }
                    }
                }
            }
            EXPECT_LT(undecided, mask.size() / 20);
        }
    }
}

} // namespace
} // namespace meltpoint
