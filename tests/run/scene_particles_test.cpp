#include "run/scene_particles.h"

#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

#include "core/error.h"
#include "geometry/relaxation.h"
#include "reference/cells.h"
#include "reference/density.h"
#include "run/fluid_settings.h"
#include "run/placed_mesh.h"
#include "support/clouds.h"
#include "support/scratch_folder.h"

namespace meltpoint {
namespace {

constexpr std::uint64_t no_limit = 10'000'000;

FluidBody block(const glm::vec3& min, const glm::vec3& max)
{
    FluidBody body;
    body.shape = BlockShape{min, max};
    return body;
}

/// A domain of 2 m x 2 m x 2 m around (0, 1, 0), spacing 0.1 m.
Scene scene_of(const FluidBody& body)
{
    Scene scene;
    scene.name = "test";
    scene.particles.spacing = 0.1f;
    scene.fluids.push_back(body);
    return scene;
}

Scene block_scene()
{
    return scene_of(block({-0.5f, 0.0f, -0.5f}, {0.5f, 0.8f, 0.3f}));
}

double total_mass(const ParticleSet& particles)
{
    return std::accumulate(particles.mass.begin(), particles.mass.end(), 0.0);
}

std::string refusal(const Scene& scene, std::uint64_t limit = no_limit)
{
    try {
        static_cast<void>(make_particles(scene, limit));
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Input);
        return error.what();
    }
    return "";
}

TEST(SceneParticles, ABlockHasItsMassAndItsLattice)
{
    Scene scene = block_scene();
    scene.fluids[0].rest_density = 700.0f;
    const ParticleSet particles = make_particles(scene, no_limit);
    EXPECT_EQ(particles.size(), 10u * 8u * 8u);
    EXPECT_NEAR(total_mass(particles), 700.0 * 1.0 * 0.8 * 0.8, 1e-2);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        ASSERT_EQ(particles.id[i], i);
        ASSERT_EQ(shared::particle_state(particles.attributes[i]), shared::STATE_FLUID);
        ASSERT_EQ(particles.velocity[i], glm::vec3(0.0f));
    }
}

TEST(SceneParticles, OfASolidThatMeltsToAnotherVolumeHaveTheMassOfItsFluids)
{
    for (const BodyShape& shape : {BodyShape{BlockShape{{-0.5f, 0.0f, -0.5f}, {0.5f, 0.9f, 0.4f}}},
                                   BodyShape{SphereShape{{0.1f, 0.9f, 0.0f}, 0.55f}}}) {
        for (const float density : {917.0f, 1100.0f}) {
            Scene scene = block_scene();
            scene.fluids.clear();
            SolidBody ice;
            ice.shape = shape;
            ice.solid_density = density;
            scene.solids.push_back(ice);
            const ParticleSet particles = make_particles(scene, no_limit);
            const bool is_block = std::holds_alternative<BlockShape>(shape);
            const double volume = is_block ? 0.81 : 4.0 / 3.0 * std::numbers::pi * 0.166375;
            EXPECT_NEAR(total_mass(particles) / (static_cast<double>(density) * volume), 1.0, 1e-3);
            for (std::size_t i = 0; i < particles.size(); ++i) {
                ASSERT_NEAR(particles.mass[i], 1.0f, is_block ? 0.03f : 0.08f); // d^3 of water, as far as it fits
                ASSERT_FLOAT_EQ(particles.weight[i], 1000.0f / density);
            }
        }
    }
}

TEST(SceneParticles, BlueNoiseStartsEven)
{
    for (const BodyShape& shape :
         {BodyShape{BlockShape{{-0.5f, 0.0f, -0.5f}, {0.5f, 0.8f, 0.3f}}},
          BodyShape{SphereShape{{0.1f, 0.9f, 0.0f}, 0.55f}},
          BodyShape{MeshShape{.mesh = "builtin:torus", .size = 1.8f, .position = {0, 1, 0}}}}) {
        FluidBody body;
        body.shape = shape;
        body.lattice = BodyLattice::BlueNoise;
        body.rest_density = 700.0f;
        const ParticleSet particles = make_particles(scene_of(body), no_limit);
        const std::unique_ptr<Solid> solid = placed_solid(shape);
        const RelaxationSettings relaxation{.support_ratio = 2.0, .mirrors = Aabb{{-1, 0, -1}, {1, 2, 1}}};
        EXPECT_EQ(particles.size(), static_cast<std::size_t>(std::lround(solid->volume() / 1e-3)));
        EXPECT_NEAR(total_mass(particles), 700.0 * solid->volume(), 0.01);
        EXPECT_LE(evenness_of(particles.position, *solid, relaxation).density_spread, 0.01);
        for (const glm::vec3& x : particles.position) {
            ASSERT_TRUE(solid->contains(glm::dvec3(x)));
        }
    }
}

// As the engine itself sees it, at walls and at edges too: the kernel's sum over all particles and their images.
TEST(SceneParticles, BlueNoiseBetweenWallsStartsAtRest)
{
    for (const SphKernel kernel : {SphKernel::Wendland, SphKernel::Paper}) {
        for (const float support_ratio : {2.0f, 2.6f}) {
            Scene scene = scene_of(block(glm::vec3(0.0f), glm::vec3(1.2f)));
            scene.domain.min = glm::vec3(0.0f);
            scene.domain.max = glm::vec3(1.2f);
            scene.fluids[0].lattice = BodyLattice::BlueNoise;
            scene.kernel = kernel;
            scene.particles.support_ratio = support_ratio;
            const ParticleSet particles = make_particles(scene, no_limit);
            const sim::SimulationSettings settings = fluid_settings(scene, particles).simulation;
            reference::State state = reference::from_particle_set(particles);
            reference::update_density({settings.options.kernel, settings.params}, state,
                                      reference::find_neighbors(settings.params, state.position));
            double sum = 0.0;
            double squares = 0.0;
            for (const double density : state.density) {
                sum += density;
                squares += density * density;
            }
            const double mean = sum / static_cast<double>(state.size());
            EXPECT_LE(std::sqrt(squares / static_cast<double>(state.size()) - mean * mean), 0.01 * mean)
                << settings.options.kernel << " " << support_ratio;
            EXPECT_NEAR(mean, 1000.0, 30.0) << settings.options.kernel << " " << support_ratio;
        }
    }
}

TEST(SceneParticles, BlueNoiseFollowsTheSeed)
{
    Scene scene = block_scene();
    scene.fluids[0].lattice = BodyLattice::BlueNoise;
    const std::vector<glm::vec3> first = make_particles(scene, no_limit).position;
    EXPECT_EQ(make_particles(scene, no_limit).position, first);
    scene.seed = 2;
    EXPECT_NE(make_particles(scene, no_limit).position, first);
}

TEST(SceneParticles, ASphereHasTheMassOfABall)
{
    FluidBody body;
    body.shape = SphereShape{{0.1f, 0.9f, 0.0f}, 0.55f};
    const ParticleSet particles = make_particles(scene_of(body), no_limit);
    EXPECT_NEAR(total_mass(particles), 1000.0 * 4.0 / 3.0 * std::numbers::pi * 0.55 * 0.55 * 0.55, 0.01);
}

TEST(SceneParticles, AMeshIsScaledTurnedAndPlacedByItsCenter)
{
    FluidBody body;
    MeshShape mesh{.mesh = "builtin:cube"};
    mesh.size = 0.8f;
    mesh.position = {0.1f, 0.7f, -0.2f};
    mesh.rotation = {0.0f, 45.0f, 0.0f};
    body.shape = mesh;
    const ParticleSet particles = make_particles(scene_of(body), no_limit);
    EXPECT_NEAR(total_mass(particles), 1000.0 * 0.512, 0.002 * 512.0); // the volume is measured to 0.03 %
    glm::dvec3 center(0.0);
    float widest = 0.0f;
    for (const glm::vec3& x : particles.position) {
        center += glm::dvec3(x) / static_cast<double>(particles.size());
        widest = std::max(widest, std::abs(x.x - 0.1f));
        ASSERT_LE(std::abs(x.y - 0.7f), 0.4f);
        ASSERT_LE(std::abs(x.x - 0.1f) + std::abs(x.z + 0.2f), 0.4f * std::numbers::sqrt2_v<float> + 1e-4f);
    }
    EXPECT_LT(glm::length(center - glm::dvec3(0.1, 0.7, -0.2)), 0.05);
    EXPECT_GT(widest, 0.45f); // an unturned cube would end at 0.4
}

/// A fluid from a file of points.
FluidBody scan(const std::filesystem::path& path, const PointCloud& cloud)
{
    test::write_bytes(path, test::xyz_of(cloud));
    FluidBody body;
    body.shape = MeshShape{.mesh = path.string(), .size = 1.6f, .position = {0.1f, 0.9f, -0.1f}};
    return body;
}

TEST(SceneParticles, AScanIsFilledToItsVolume)
{
    const test::ScratchFolder folder;
    PointCloud cloud = test::fibonacci_sphere(3000);
    for (glm::vec3& x : cloud.positions) { // not where it will be, and not as large
        x = 30.0f * x + glm::vec3(500.0f, -200.0f, 3.0f);
    }
    FluidBody body = scan(folder / "ball.xyz", cloud);
    const double volume = 4.0 / 3.0 * std::numbers::pi * 0.8 * 0.8 * 0.8;
    for (const BodyLattice lattice : {BodyLattice::Cubic, BodyLattice::BlueNoise}) {
        body.lattice = lattice;
        Scene scene = scene_of(body);
        scene.particles.spacing = 0.08f;
        const ParticleSet particles = make_particles(scene, no_limit);
        const double expected = volume / std::pow(0.08, 3);
        // The lattice's spacing may be 2.5 % finer or coarser than asked, the mass may not.
        EXPECT_NEAR(static_cast<double>(particles.size()), expected,
                    (lattice == BodyLattice::Cubic ? 0.095 : 0.02) * expected);
        EXPECT_NEAR(total_mass(particles), 1000.0 * volume, 0.01 * 1000.0 * volume);
        for (const glm::vec3& x : particles.position) {
            ASSERT_LT(glm::distance(x, glm::vec3(0.1f, 0.9f, -0.1f)), 0.8f + 0.01f);
        }
    }
}

TEST(SceneParticles, ASolidMayLieWithoutRows)
{
    Scene scene;
    scene.particles.spacing = 0.05f;
    SolidBody solid;
    solid.shape = BlockShape{.min = glm::vec3(-0.3f, 0.1f, -0.3f), .max = glm::vec3(0.3f, 0.7f, 0.3f)};
    solid.lattice = BodyLattice::BlueNoise;
    solid.solid_density = 0.9f * solid.rest_density;
    scene.solids.push_back(solid);
    const ParticleSet particles = make_particles(scene, no_limit);
    EXPECT_NEAR(total_mass(particles), 900.0 * 0.216, 0.01 * 900.0 * 0.216);
    std::set<float> heights;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        ASSERT_EQ(shared::particle_state(particles.attributes[i]), shared::STATE_SOLID);
        heights.insert(particles.position[i].y);
    }
    EXPECT_GT(heights.size(), particles.size() / 2); // of a lattice: a dozen
}

TEST(SceneParticles, AScanIsScaledTurnedAndPlacedAsTheMeshIs)
{
    const test::ScratchFolder folder;
    const auto filled = [](const std::string& mesh) {
        FluidBody body;
        body.lattice = BodyLattice::BlueNoise; // whose count is the volume's
        body.shape = MeshShape{.mesh = mesh, .size = 0.8f, .position = {0.1f, 0.7f, -0.2f}, .rotation = {20, 45, 10}};
        return make_particles(scene_of(body), no_limit);
    };
    test::write_bytes(folder / "cube.xyz", test::xyz_of(test::points_on("cube", 6000, SurfaceMethod::BlueNoise)));
    const ParticleSet scanned = filled((folder / "cube.xyz").string());
    const auto count = static_cast<double>(filled("builtin:cube").size());
    EXPECT_NEAR(static_cast<double>(scanned.size()), count, 0.02 * count);
    const std::unique_ptr<Solid> cube = placed_solid(MeshShape{
        .mesh = "builtin:cube", .size = 0.8f + 0.02f, .position = {0.1f, 0.7f, -0.2f}, .rotation = {20, 45, 10}});
    glm::dvec3 center(0.0);
    for (const glm::vec3& x : scanned.position) {
        ASSERT_TRUE(cube->contains(glm::dvec3(x)));
        center += glm::dvec3(x) / static_cast<double>(scanned.size());
    }
    EXPECT_LT(glm::length(center - glm::dvec3(0.1, 0.7, -0.2)), 0.02);
}

TEST(SceneParticles, WhatAScanWasGivenIsTold)
{
    const test::ScratchFolder folder;
    PointCloud cloud = test::fibonacci_sphere(1000);
    const Scene scene = scene_of(scan(folder / "ball.xyz", cloud));
    const auto told = [&] {
        testing::internal::CaptureStderr();
        static_cast<void>(make_particles(scene, no_limit));
        return testing::internal::GetCapturedStderr();
    };
    EXPECT_EQ(told(), (folder / "ball.xyz").string() + ": 1000 of 1000 normals were missing: they are estimated from "
                                                       "nearest neighbors and oriented outward\n");
    cloud.normals = cloud.positions;
    static_cast<void>(scan(folder / "ball.xyz", cloud));
    EXPECT_EQ(told(), "");
}

TEST(SceneParticles, ScansThatCannotBeFilledAreRefused)
{
    const test::ScratchFolder folder;
    PointCloud flat;
    for (int z = 0; z < 20; ++z) {
        for (int x = 0; x < 20; ++x) {
            flat.positions.emplace_back(0.1f * static_cast<float>(x), 0.0f, 0.1f * static_cast<float>(z));
        }
    }
    PointCloud two = flat;
    two.positions.resize(2);
    PointCloud line = flat;
    line.positions.resize(20);
    PointCloud broken = test::fibonacci_sphere(100);
    broken.positions[40].y = NAN;
    const std::string path = (folder / "scan.xyz").string();
    for (const auto& [cloud, reason] :
         {std::pair{flat, "test: fluid.0 (" + path + "): the shape to fill encloses no volume"},
          {test::inward_sphere(1000), "test: fluid.0 (" + path + "): the shape to fill encloses no volume"},
          {two, path + ": a surface takes at least three points"},
          {line, path + ": the points of the cloud lie on a line"},
          {broken, path + ": point 40 is not finite"},
          {PointCloud{}, path + ": the file is empty"}}) {
        const std::string message = refusal(scene_of(scan(path, cloud)));
        EXPECT_TRUE(message.starts_with(reason)) << message;
    }
}

TEST(SceneParticles, VelocityIsUniformPlusLinearPlusSpin)
{
    Scene scene = block_scene();
    FluidBody& body = scene.fluids[0];
    body.velocity = {1.0f, 2.0f, 3.0f};
    body.velocity_gradient[1][0] = 4.0f; // column y, row x: vx grows with y
    body.spin = {0.0f, 0.0f, 5.0f};
    body.spin_center = glm::vec3(0.1f, 0.2f, 0.3f);
    const ParticleSet particles = make_particles(scene, no_limit);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const glm::vec3& x = particles.position[i];
        const glm::vec3 expected{1.0f + 4.0f * x.y - 5.0f * (x.y - 0.2f), 2.0f + 5.0f * (x.x - 0.1f), 3.0f};
        ASSERT_LT(glm::length(particles.velocity[i] - expected), 1e-5f) << i;
    }
}

TEST(SceneParticles, SpinIsAboutTheBodysCenterUnlessTold)
{
    Scene scene = block_scene();
    scene.fluids[0].spin = {0.0f, 2.0f, 0.0f};
    const ParticleSet particles = make_particles(scene, no_limit);
    glm::dvec3 momentum(0.0);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        momentum += glm::dvec3(particles.velocity[i]) * static_cast<double>(particles.mass[i]);
        const glm::vec3 arm = particles.position[i] - glm::vec3(0.0f, 0.4f, -0.1f);
        ASSERT_LT(glm::length(particles.velocity[i] - glm::cross(glm::vec3(0.0f, 2.0f, 0.0f), arm)), 1e-5f);
    }
    EXPECT_LT(glm::length(momentum), 1e-3);
}

TEST(SceneParticles, SolidsAreFilledAndKnowWhenTheirFrontComes)
{
    Scene scene = scene_of(block(glm::vec3(-0.5f, 0.0f, -0.5f), glm::vec3(0.0f, 0.5f, 0.5f)));
    EXPECT_TRUE(make_particles(scene, no_limit).release_time.empty());
    SolidBody solid;
    solid.shape = BlockShape{glm::vec3(-0.2f, 0.0f, -0.5f), glm::vec3(0.5f, 0.5f, 0.5f)}; // some of it is taken
    solid.rest_density = 800.0f;
    scene.solids.push_back(solid);
    EXPECT_FALSE(make_particles(scene, no_limit).release_time.empty()); // it may turn out that nothing holds it
    solid.anchor = scene.solids[0].anchor = SolidAnchor::All;
    EXPECT_TRUE(make_particles(scene, no_limit).release_time.empty()); // nothing frees it
    solid.shape = BlockShape{glm::vec3(-0.5f, 1.0f, -0.5f), glm::vec3(0.5f, 1.5f, 0.5f)};
    solid.friction = 3.0f;
    solid.dissolve = {.speed = 0.5f, .start = 1.0f};
    scene.solids.push_back(solid);
    ColliderBody ball;
    ball.shape = SphereShape{glm::vec3(0.0f, 0.75f, 0.0f), 0.1f};
    scene.colliders.push_back(ball);

    const ParticleSet set = make_particles(scene, no_limit);
    ASSERT_EQ(set.release_time.size(), set.size());
    const std::size_t fluids = 5 * 5 * 10;
    const std::size_t both = fluids + 5 * 5 * 10;
    ASSERT_GT(set.size(), both + 500);
    for (std::size_t i = 0; i < set.size(); ++i) {
        const std::uint32_t state = shared::particle_state(set.attributes[i]);
        const float volume = 1e-3f;
        if (i < fluids) {
            EXPECT_EQ(state, shared::STATE_FLUID);
            EXPECT_NEAR(set.mass[i], 1000.0f * volume, 1e-4f);
        } else if (i < both + 500) {
            EXPECT_EQ(state, shared::STATE_SOLID);
            EXPECT_NEAR(set.mass[i], 800.0f * volume, 1e-4f);
            EXPECT_EQ(set.weight[i], 1.0f);
            EXPECT_EQ(set.velocity[i], glm::vec3(0.0f));
        } else {
            EXPECT_EQ(state, shared::STATE_COLLIDER);
        }
        if (i >= both && i < both + 500) {
            EXPECT_NEAR(set.release_time[i], 1.0f + (1.45f - set.position[i].y) / 0.5f, 1e-4f);
        } else {
            EXPECT_TRUE(std::isinf(set.release_time[i]));
        }
    }
    const FluidSettings settings = fluid_settings(scene, set);
    EXPECT_TRUE(settings.simulation.options.still);
    const std::uint32_t material = shared::particle_material(set.attributes[both]);
    EXPECT_EQ(settings.simulation.params.rest_density[material], 800.0f);
    EXPECT_EQ(settings.simulation.params.friction[material], 3.0f);
    // What is solid yet may fall, too.
    EXPECT_GT(settings.simulation.params.speed_of_sound, 10.0f * std::sqrt(2.0f * 9.81f * 1.4f));
}

TEST(SceneParticles, BodiesFollowEachOtherWithTheirMaterials)
{
    Scene scene = scene_of(block({-1.0f, 0.0f, -1.0f}, {1.0f, 0.2f, 1.0f}));
    FluidBody oil = block({-0.3f, 1.0f, -0.3f}, {0.3f, 1.3f, 0.3f});
    oil.rest_density = 800.0f;
    scene.fluids.push_back(oil);
    FluidBody water = block({-0.3f, 1.5f, -0.3f}, {0.3f, 1.6f, 0.3f});
    scene.fluids.push_back(water);
    const ParticleSet particles = make_particles(scene, no_limit);
    ASSERT_EQ(particles.size(), 800u + 108u + 36u);
    EXPECT_EQ(shared::particle_material(particles.attributes[799]), 0u);
    EXPECT_EQ(shared::particle_material(particles.attributes[800]), 1u);
    EXPECT_EQ(shared::particle_material(particles.attributes[907]), 1u);
    EXPECT_EQ(shared::particle_material(particles.attributes[908]), 0u) << "the same fluid as the first";
    EXPECT_NEAR(static_cast<double>(particles.mass[850]), 0.8, 1e-6);
    EXPECT_EQ(particles.id.back(), 943u);
}

TEST(SceneParticles, FluidOutsideTheDomainIsRefused)
{
    FluidBody body;
    MeshShape mesh{.mesh = "builtin:cube"};
    mesh.size = 0.8f;
    mesh.position = {0.0f, 0.1f, 0.0f}; // a third of it below the floor
    body.shape = mesh;
    const std::string message = refusal(scene_of(body));
    EXPECT_TRUE(message.starts_with("test: fluid.0 reaches outside the domain: its particles lie in [-0.3")) << message;
}

TEST(SceneParticles, TooManyParticlesAreOneSentenceWithTheLimit)
{
    EXPECT_EQ(refusal(block_scene(), 600), "test: about 640 particles are more than the device can hold, 600: choose a "
                                           "larger particles.spacing than 0.1 m");
    EXPECT_EQ(refusal(block_scene(), 640), "");
}

TEST(SceneParticles, TooManyParticlesAreRefusedWhereTheEstimateIsLow)
{
    // 614.4 by volume, 640 on the lattice, whose spacing shrinks to fit.
    const Scene scene = scene_of(block({-0.48f, 0.0f, -0.5f}, {0.48f, 0.8f, 0.3f}));
    EXPECT_NE(refusal(scene, 639).find("about 640 particles"), std::string::npos) << refusal(scene, 639);
    EXPECT_EQ(refusal(scene, 640), "");
}

TEST(SceneParticles, TooManyParticlesOfAllBodiesTogether)
{
    Scene scene = block_scene();
    scene.fluids.push_back(block({-0.5f, 1.0f, -0.5f}, {0.5f, 1.5f, 0.5f})); // 500 more
    EXPECT_NE(refusal(scene, 1139).find("about 1140 particles"), std::string::npos);
    EXPECT_EQ(refusal(scene, 1140), "");
}

TEST(SceneParticles, TooManyParticlesOfAMeshAreRefusedBeforeItIsFilled)
{
    FluidBody body;
    MeshShape mesh{.mesh = "builtin:sphere"};
    mesh.size = 1.0f;
    mesh.position = {0.0f, 1.0f, 0.0f};
    body.shape = mesh;
    Scene scene = scene_of(body);
    scene.particles.spacing = 0.0001f; // 5e11 particles
    EXPECT_NE(refusal(scene).find("more than the device can hold, 10000000"), std::string::npos) << refusal(scene);
}

TEST(SceneParticles, MeshesThatCannotBeFilledAreRefused)
{
    const test::ScratchFolder folder;
    test::write_bytes(folder / "flat.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 2 3\n");
    FluidBody body;
    body.shape = MeshShape{.mesh = (folder / "flat.obj").string()};
    EXPECT_NE(refusal(scene_of(body)).find("encloses no volume"), std::string::npos) << refusal(scene_of(body));
    body.shape = MeshShape{.mesh = "builtin:bunny"};
    EXPECT_NE(refusal(scene_of(body)).find("bunny"), std::string::npos);
}

} // namespace
} // namespace meltpoint
