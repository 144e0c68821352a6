// Surfaces from functions, and the rabbit made of one.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "geometry/builtin_meshes.h"
#include "geometry/implicit_surface.h"
#include "geometry/mesh_facts.h"
#include "geometry/winding_number.h"

namespace meltpoint {
namespace {

constexpr Aabb box{{-1.5f, -1.5f, -1.5f}, {1.5f, 1.5f, 1.5f}};

double ball(const glm::dvec3& x)
{
    return glm::length(x) - 1.0;
}

TEST(ImplicitSurface, ABallHasItsAreaItsVolumeAndItsNormals)
{
    const TriangleMesh mesh = polygonize(ball, box, 0.05);
    const double pi = std::numbers::pi;
    EXPECT_NEAR(surface_area(mesh), 4.0 * pi, 0.003 * 4.0 * pi);
    EXPECT_NEAR(signed_volume(mesh), 4.0 / 3.0 * pi, 0.003 * 4.0 / 3.0 * pi); // and so it looks outward
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        EXPECT_NEAR(glm::length(mesh.positions[i]), 1.0f, 1e-5f);
        EXPECT_NEAR(glm::dot(mesh.normals[i], glm::normalize(mesh.positions[i])), 1.0f, 1e-5f);
    }
}

TEST(ImplicitSurface, IsClosed)
{
    // A torus whose faces meet cells at every angle.
    const auto torus = [](const glm::dvec3& x) {
        return std::hypot(std::hypot(x.x, 0.8 * x.y + 0.6 * x.z) - 0.9, 0.8 * x.z - 0.6 * x.y) - 0.3;
    };
    EXPECT_EQ(mesh_facts(polygonize(torus, box, 0.07)).boundary_edges, 0u);
    const MeshFacts convex = mesh_facts(polygonize(ball, box, 0.07));
    EXPECT_EQ(convex.boundary_edges, 0u);
    EXPECT_EQ(convex.nonmanifold_edges, 0u);
}

TEST(ImplicitSurface, WhatReachesTheBorderIsOpenThere)
{
    const MeshFacts facts = mesh_facts(polygonize([](const glm::dvec3& x) { return x.y - 0.11; }, box, 0.1));
    EXPECT_GT(facts.boundary_edges, 100u);
}

TEST(BuiltinMeshes, TheRabbitIsClosedStandsAndIsItsOwnMirrorImage)
{
    const TriangleMesh rabbit = builtin_mesh("rabbit");
    const MeshFacts facts = mesh_facts(rabbit);
    EXPECT_EQ(facts.boundary_edges, 0u);
    EXPECT_EQ(facts.nonmanifold_edges, 0u);
    const Aabb extent = bounds(rabbit);
    EXPECT_EQ(extent.min.y, 0.0f);
    EXPECT_NEAR(extent.min.z, -extent.max.z, 1e-4f);
    EXPECT_NEAR(extent.size().x, 2.15f, 0.01f);
    EXPECT_NEAR(extent.size().y, 2.25f, 0.01f);
    EXPECT_NEAR(extent.size().z, 1.16f, 0.01f);
    EXPECT_GT(signed_volume(rabbit), 1.0);
    EXPECT_NEAR(winding_number_exact(rabbit, {-0.12, 0.66, 0.0}), 1.0, 1e-6); // its body
    EXPECT_NEAR(winding_number_exact(rabbit, {0.45, 1.9, 0.0}), 0.0, 1e-6);   // between its ears
}

} // namespace
} // namespace meltpoint
