#include "geometry/builtin_meshes.h"

#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "core/error.h"
#include "geometry/mesh_facts.h"
#include "geometry/teapot.h"

namespace meltpoint {
namespace {

constexpr double pi = std::numbers::pi;

TEST(BuiltinMeshes, AllAreValidWeldedAndConsistentlyOriented)
{
    for (const std::string_view name : builtin_mesh_names()) {
        const TriangleMesh mesh = builtin_mesh(name);
        EXPECT_NO_THROW(validate(mesh, name));
        EXPECT_EQ(weld(mesh).positions.size(), mesh.positions.size()) << name;
        EXPECT_GT(signed_volume(mesh), 0.0) << name;
        EXPECT_EQ(mesh_facts(mesh).boundary_edges == 0, name != "teapot") << name;
        // Two triangles that share an edge run along it in opposite directions.
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> directed_edges;
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
            const glm::uvec3& t = mesh.triangles[i];
            for (int corner = 0; corner < 3; ++corner) {
                EXPECT_EQ(++directed_edges[std::make_pair(t[corner], t[(corner + 1) % 3])], 1) << name;
            }
            for (int corner = 0; corner < 3 && !mesh.normals.empty(); ++corner) {
                const glm::dvec3 normal(mesh.normals[t[corner]]);
                EXPECT_TRUE(normal == glm::dvec3(0.0) || glm::dot(area_vector(mesh, i), normal) > 0.0) << name;
            }
        }
    }
}

TEST(BuiltinMeshes, SphereAndTorusHaveTheirAreaAndVolume)
{
    const TriangleMesh sphere = builtin_mesh("sphere");
    EXPECT_NEAR(surface_area(sphere) / (4.0 * pi), 1.0, 5e-4);
    EXPECT_NEAR(signed_volume(sphere) / (4.0 / 3.0 * pi), 1.0, 5e-4);
    const TriangleMesh torus = builtin_mesh("torus");
    EXPECT_NEAR(surface_area(torus) / (4.0 * pi * pi * 0.4), 1.0, 3e-3);
    EXPECT_NEAR(signed_volume(torus) / (2.0 * pi * pi * 0.16), 1.0, 3e-3);
}

TEST(BuiltinMeshes, TeapotIsNewells)
{
    // 32 patches of 10 x 10 quads, without the 80 triangles that vanish at the poles of lid and bottom.
    const TriangleMesh mesh = teapot(10);
    EXPECT_EQ(mesh.triangles.size(), 6320u);
    EXPECT_NEAR(surface_area(mesh), 52.661, 1e-3); // of the widespread tessellation of the data set
    const Aabb box = bounds(mesh);
    EXPECT_NEAR(box.size().x, 6.434f, 1e-3f);
    EXPECT_FLOAT_EQ(box.size().y, 3.15f);
    EXPECT_FLOAT_EQ(box.size().z, 4.0f);
    EXPECT_FLOAT_EQ(box.min.y, 0.0f);
    EXPECT_FLOAT_EQ(box.min.x, -3.0f);
}

TEST(BuiltinMeshes, AnUnknownNameOffersTheNearest)
{
    try {
        (void)builtin_mesh("teepot");
        FAIL() << "accepted";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Input);
        const std::string message = error.what();
        EXPECT_NE(message.find("did you mean \"teapot\""), std::string::npos) << message;
        EXPECT_NE(message.find("teapot, rabbit, sphere, cube, torus"), std::string::npos) << message;
    }
    EXPECT_THROW((void)builtin_mesh(""), Error);
    EXPECT_THROW((void)builtin_mesh(std::string(1'000'000, 'x')), Error);
}

} // namespace
} // namespace meltpoint
