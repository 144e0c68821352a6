#include "geometry/mesh_facts.h"

#include <gtest/gtest.h>

#include "geometry/builtin_meshes.h"

namespace meltpoint {
namespace {

TEST(MeshFacts, EdgesAreCountedByTheirTriangles)
{
    TriangleMesh cube = builtin_mesh("cube");
    EXPECT_EQ(mesh_facts(cube).triangles, 12u);
    EXPECT_EQ(mesh_facts(cube).boundary_edges, 0u);
    EXPECT_EQ(mesh_facts(cube).nonmanifold_edges, 0u);
    EXPECT_DOUBLE_EQ(mesh_facts(cube).area, 6.0);

    TriangleMesh open = cube;
    open.triangles.resize(10); // without one face
    EXPECT_EQ(mesh_facts(open).boundary_edges, 4u);
    EXPECT_EQ(mesh_facts(open).nonmanifold_edges, 0u);

    TriangleMesh finned = cube; // a triangle stands on an edge that has two
    finned.positions.emplace_back(2.0f, 2.0f, 2.0f);
    finned.triangles.emplace_back(0, 4, 8);
    EXPECT_EQ(mesh_facts(finned).boundary_edges, 2u);
    EXPECT_EQ(mesh_facts(finned).nonmanifold_edges, 1u);
}

} // namespace
} // namespace meltpoint
