#include "run/fluid_settings.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/error.h"
#include "particles/sph_kernel.h"
#include "run/scene_particles.h"
#include "scene/liquids.h"

namespace meltpoint {
namespace {

/// A block that can fall 1 m in a box 2 m high.
Scene falling_block()
{
    Scene scene;
    scene.name = "falling";
    scene.particles.spacing = 0.1f;
    scene.physics.viscosity = 0.01f;
    FluidBody body;
    body.shape = BlockShape{glm::vec3(-0.2f, 0.8f, -0.2f), glm::vec3(0.2f, 1.2f, 0.2f)};
    scene.fluids.push_back(body);
    return scene;
}

FluidSettings settings_of(const Scene& scene)
{
    return fluid_settings(scene, make_particles(scene, 1'000'000));
}

double dt_of(const Scene& scene)
{
    return static_cast<double>(settings_of(scene).simulation.params.dt);
}

TEST(FluidSettings, ExpectedSpeedIsThatOfFreeFallOntoTheFloor)
{
    const Scene scene = falling_block();
    const ParticleSet particles = make_particles(scene, 1'000'000);
    // The topmost layer's centers lie half a spacing below the block's top.
    EXPECT_NEAR(expected_speed(scene, particles), std::sqrt(2.0 * 9.81 * 1.15), 1e-4);
    EXPECT_NEAR(static_cast<double>(settings_of(scene).simulation.params.speed_of_sound),
                10.0 * std::sqrt(2.0 * 9.81 * 1.15), 1e-3);
}

TEST(FluidSettings, ExpectedSpeedAddsVelocityToFall)
{
    Scene scene = falling_block();
    scene.fluids[0].velocity = {3.0f, 0.0f, 4.0f};
    EXPECT_NEAR(expected_speed(scene, make_particles(scene, 1'000'000)), 5.0 + std::sqrt(2.0 * 9.81 * 1.15), 1e-4);

    scene.physics.gravity = {};
    EXPECT_NEAR(expected_speed(scene, make_particles(scene, 1'000'000)), 5.0, 1e-6);
}

TEST(FluidSettings, ExpectedSpeedFollowsGravityInEveryDirection)
{
    Scene scene = falling_block();
    scene.physics.gravity = {4.0f, 0.0f, 0.0f}; // to the wall at x = 1, from the leftmost particles at -0.15
    EXPECT_NEAR(expected_speed(scene, make_particles(scene, 1'000'000)), std::sqrt(2.0 * 4.0 * 1.15), 1e-4);
}

TEST(FluidSettings, ExpectedSpeedIsOneWhereNothingMoves)
{
    Scene scene = falling_block();
    scene.physics.gravity = {};
    EXPECT_EQ(expected_speed(scene, make_particles(scene, 1'000'000)), 1.0);
}

TEST(FluidSettings, BoundsAreThoseOfTheTable)
{
    Scene scene = falling_block();
    scene.particles.support_ratio = 2.0f; // S = 0.2 m
    scene.physics.viscosity = 5.0f;
    scene.fluids[0].rest_density = 500.0f;
    const TimeStepBounds bounds = time_step_bounds(scene, 40.0, 4.0);
    EXPECT_NEAR(bounds.cfl, 0.4 * 0.1 / 44.0, 1e-10);
    EXPECT_NEAR(bounds.viscosity, 0.06 * 500.0 * 0.04 / 5.0, 1e-7);
    EXPECT_EQ(bounds.smallest(), bounds.cfl);

    scene.physics.viscosity = 0.0f;
    EXPECT_TRUE(std::isinf(time_step_bounds(scene, 40.0, 4.0).viscosity));
    scene.domain.wall_viscosity = 10.0f;
    EXPECT_NEAR(time_step_bounds(scene, 40.0, 4.0).viscosity, 0.06 * 500.0 * 0.04 / 10.0, 1e-7);
    scene.domain.walls = false;
    EXPECT_TRUE(std::isinf(time_step_bounds(scene, 40.0, 4.0).viscosity));
}

TEST(FluidSettings, TheLightestFluidBoundsTheViscousStep)
{
    Scene scene = falling_block();
    scene.physics.viscosity = 5.0f;
    FluidBody heavy = scene.fluids[0];
    heavy.rest_density = 3000.0f;
    scene.fluids.insert(scene.fluids.begin(), heavy);
    EXPECT_NEAR(time_step_bounds(scene, 40.0, 4.0).viscosity, 0.06 * 1000.0 * 0.04 / 5.0, 1e-7);
}

TEST(FluidSettings, NamedLiquidsHaveTheirTensionWhereParticlesAreFineEnough)
{
    Scene scene = falling_block();
    EXPECT_FALSE(settings_of(scene).simulation.options.capillarity);
    const double bound_without = time_step_bounds(scene, 40.0, 4.0).tension;
    EXPECT_TRUE(std::isinf(bound_without));

    set_liquid(scene.fluids[0], *find_liquid("water")); // capillary length 2.7 mm
    EXPECT_FALSE(settings_of(scene).simulation.options.capillarity);
    const auto scaled = [](float factor) {
        Scene small = falling_block();
        set_liquid(small.fluids[0], *find_liquid("water"));
        small.domain.min *= factor;
        small.domain.max *= factor;
        auto& block = std::get<BlockShape>(small.fluids[0].shape);
        block.min *= factor;
        block.max *= factor;
        small.particles.spacing *= factor;
        return small;
    };
    EXPECT_FALSE(settings_of(scaled(0.0028f / scene.particles.spacing)).simulation.options.capillarity);
    Scene fine = scaled(0.0026f / scene.particles.spacing);
    const FluidSettings settings = settings_of(fine);
    EXPECT_TRUE(settings.simulation.options.capillarity);
    EXPECT_FALSE(settings.simulation.options.tension); // that is the paper's
    EXPECT_FALSE(settings.simulation.options.colliders);
    EXPECT_EQ(settings.simulation.params.tension[0], find_liquid("water")->surface_tension);
    const double d = static_cast<double>(fine.particles.spacing);
    const double bound = 0.2 * std::sqrt(998.2 * d * d * d / 0.0728);
    EXPECT_NEAR(time_step_bounds(fine, 1.0, 1.0).tension, bound, 1e-4 * bound);
    EXPECT_LE(static_cast<double>(settings.simulation.params.longest_dt), bound * (1.0 + 1e-6));

    fine.fluids[0].surface_tension = 0.0f;
    EXPECT_FALSE(settings_of(fine).simulation.options.capillarity);
    scene.fluids[0].surface_tension = 0.5f; // whoever says so gets it at any size
    EXPECT_TRUE(settings_of(scene).simulation.options.capillarity);
}

TEST(FluidSettings, ThePapersTensionIsAnotherOne)
{
    Scene scene = falling_block();
    scene.physics.surface_tension = 0.5f;
    sim::SimulationSettings settings = settings_of(scene).simulation;
    EXPECT_TRUE(settings.options.capillarity);
    EXPECT_FALSE(settings.options.tension);
    EXPECT_EQ(settings.params.tension[0], 0.5f);
    scene.physics.tension_model = TensionModel::Paper;
    settings = settings_of(scene).simulation;
    EXPECT_FALSE(settings.options.capillarity);
    EXPECT_TRUE(settings.options.tension);
    EXPECT_EQ(settings.params.surface_tension, 0.5f);

    scene.physics.tension_model = TensionModel::Si;
    scene.fluids[0].surface_tension = 0.1f;
    const FluidSettings idle = settings_of(scene);
    EXPECT_TRUE(std::ranges::any_of(idle.warnings, [](const std::string& warning) {
        return warning.find("physics.surface_tension is used by no fluid") != std::string::npos;
    }));
}

TEST(FluidSettings, ContactAnglesAreCosinesOnTheDevice)
{
    Scene scene = falling_block();
    scene.fluids[0].surface_tension = 0.5f;
    scene.domain.contact_angle = 60.0f;
    const float wide = 0.5f * scene.particles.spacing;
    scene.colliders.push_back({.shape = SphereShape{{0.5f, 0.2f, 0.0f}, 4.0f * wide}, .contact_angle = 180.0f});
    const sim::SimulationSettings settings = settings_of(scene).simulation;
    EXPECT_TRUE(settings.options.colliders);
    EXPECT_FLOAT_EQ(settings.params.wall_contact_cosine, 0.5f);
    EXPECT_FLOAT_EQ(settings.params.contact_cosine[1], -1.0f);
}

TEST(FluidSettings, AutomaticStepsAreTheDevices)
{
    Scene scene = falling_block();
    const double spacing = static_cast<double>(scene.particles.spacing);
    const double support = spacing * static_cast<double>(scene.particles.support_ratio);
    const double speed = expected_speed(scene, make_particles(scene, 1'000'000));
    for (const float frame_rate : {24.0f, 60.0f, 333.0f, 5000.0f}) {
        SCOPED_TRACE(frame_rate);
        scene.time.frame_rate = frame_rate;
        scene.solver = Solver::Wcsph;
        const shared::SphParams wcsph = settings_of(scene).simulation.params;
        EXPECT_EQ(wcsph.adaptive_dt, 1u);
        EXPECT_NEAR(wcsph.cfl_length, 0.4 * 0.5 * support, 1e-6);
        EXPECT_NEAR(wcsph.cfl_speed, 10.0 * speed, 1e-4 * speed);
        EXPECT_FLOAT_EQ(wcsph.longest_dt, 1.0f / frame_rate);
        EXPECT_FLOAT_EQ(wcsph.shortest_dt, 1e-3f * wcsph.dt);
        EXPECT_FLOAT_EQ(wcsph.longest_move, wcsph.cfl_length);
        const double bound = time_step_bounds(scene, 10.0 * speed, speed).cfl;
        EXPECT_NEAR(dt_of(scene), std::min(bound, 1.0 / static_cast<double>(frame_rate)), 1e-5 * bound);
        EXPECT_TRUE(settings_of(scene).warnings.empty());

        scene.solver = Solver::Dfsph;
        const shared::SphParams dfsph = settings_of(scene).simulation.params;
        EXPECT_EQ(dfsph.adaptive_dt, 1u);
        EXPECT_NEAR(dfsph.cfl_length, 0.4 * spacing, 1e-6);
        EXPECT_EQ(dfsph.cfl_speed, 0.0f);
        EXPECT_FLOAT_EQ(dfsph.longest_dt, std::min(4.5e-3f, 1.0f / frame_rate));
        EXPECT_TRUE(settings_of(scene).warnings.empty());
    }
    scene.time.frame_rate = 60.0f;
    scene.time.dt = 1e-4f;
    EXPECT_EQ(settings_of(scene).simulation.params.adaptive_dt, 0u);
    EXPECT_EQ(settings_of(scene).simulation.params.dt, 1e-4f);
}

TEST(FluidSettings, SolvesAreTheScenes)
{
    Scene scene = falling_block();
    EXPECT_EQ(settings_of(scene).simulation.options.solver, shared::SOLVER_WCSPH);
    scene.solver = Solver::Dfsph;
    scene.solve = {.density_error = 0.01f, .divergence_error = 0.02f, .max_iterations = 7};
    const sim::SimulationSettings settings = settings_of(scene).simulation;
    EXPECT_EQ(settings.options.solver, shared::SOLVER_DFSPH);
    EXPECT_EQ(settings.params.density_error, 0.01f);
    EXPECT_EQ(settings.params.divergence_error, 0.02f);
    EXPECT_EQ(settings.params.max_iterations, 7u);
}

TEST(FluidSettings, ViscosityIsSolvedForWhereItsBoundWouldBeTheShortest)
{
    Scene scene = falling_block();
    const auto is_implicit = [&] {
        return settings_of(scene).simulation.options.implicit_viscosity;
    };
    EXPECT_FALSE(is_implicit());
    const double cfl = dt_of(scene);
    const double just_right = 0.06 * 1000.0 * 0.04 / cfl; // the viscosity whose bound it is
    scene.physics.viscosity = static_cast<float>(0.95 * just_right);
    EXPECT_FALSE(is_implicit());
    scene.physics.viscosity = static_cast<float>(1.05 * just_right);
    EXPECT_TRUE(is_implicit());
    EXPECT_NEAR(dt_of(scene), cfl, 1e-6 * cfl);
    EXPECT_FLOAT_EQ(settings_of(scene).simulation.params.longest_dt, 1.0f / scene.time.frame_rate);
    scene.time.dt = static_cast<float>(0.9 * cfl); // the scene's own steps are shorter
    EXPECT_FALSE(is_implicit());
    scene.time.dt.reset();
    scene.time.frame_rate = static_cast<float>(1.2 / cfl); // and so may a frame be
    EXPECT_FALSE(is_implicit());
    scene.physics.viscosity_model = ViscosityModel::Implicit;
    EXPECT_TRUE(is_implicit());
    scene.physics.viscosity = 1e4f;
    scene.physics.viscosity_model = ViscosityModel::Explicit;
    EXPECT_FALSE(is_implicit());
    scene.solve = {.viscosity_error = 0.02f, .viscosity_iterations = 7};
    EXPECT_EQ(settings_of(scene).simulation.params.viscosity_error, 0.02f);
    EXPECT_EQ(settings_of(scene).simulation.params.viscosity_iterations, 7u);
}

TEST(FluidSettings, PositionBasedFluidsHaveStepsAndEndsOfTheirOwn)
{
    Scene scene = falling_block();
    scene.solver = Solver::Pbf;
    const double spacing = static_cast<double>(scene.particles.spacing);
    const double support = spacing * static_cast<double>(scene.particles.support_ratio);
    sim::SimulationSettings settings = settings_of(scene).simulation;
    EXPECT_EQ(settings.options.solver, shared::SOLVER_PBF);
    EXPECT_TRUE(settings_of(scene).warnings.empty());
    EXPECT_FLOAT_EQ(settings.params.longest_dt, 0.5f / scene.time.frame_rate);
    EXPECT_NEAR(settings.params.cfl_length, 0.4 * spacing, 1e-6);
    EXPECT_EQ(settings.params.cfl_speed, 0.0f);
    EXPECT_FLOAT_EQ(settings.params.speed_cap, 0.5f * scene.particles.spacing);
    EXPECT_GT(settings.params.longest_move, settings.params.speed_cap);
    EXPECT_EQ(settings.params.least_iterations, 1u);
    EXPECT_EQ(settings.params.max_iterations, 60u);
    EXPECT_EQ(settings.params.density_error, 0.01f);
    EXPECT_FLOAT_EQ(settings.params.constraint_softness,
                    static_cast<float>(0.01f * lattice_response(shared::KERNEL_WENDLAND, support, spacing)));

    scene.pbf = {.substeps = 5, .iterations = 3, .relaxation = 0.5f, .artificial_pressure = 0.3f, .speed_cap = 0.25f};
    settings = settings_of(scene).simulation;
    EXPECT_FLOAT_EQ(settings.params.longest_dt, 0.2f / scene.time.frame_rate);
    EXPECT_NEAR(settings.params.cfl_length, 0.2 * spacing, 1e-6);
    EXPECT_FLOAT_EQ(settings.params.speed_cap, 0.25f * scene.particles.spacing);
    EXPECT_EQ(settings.params.least_iterations, 3u);
    EXPECT_EQ(settings.params.max_iterations, 3u);
    EXPECT_GT(settings.params.density_error, 1e30f);
    EXPECT_EQ(settings.params.artificial_pressure, 0.3f);
    scene.pbf.iterations = std::nullopt;
    scene.solve.density_error = 0.002f;
    EXPECT_EQ(settings_of(scene).simulation.params.density_error, 0.002f);
    scene.solver = Solver::Dfsph;
    scene.solve.density_error = std::nullopt;
    EXPECT_EQ(settings_of(scene).simulation.params.density_error, 5e-4f);
}

TEST(FluidSettings, XsphAndConfinementAreOffUnlessAskedForOrPositionBased)
{
    Scene scene = falling_block();
    for (const Solver solver : {Solver::Wcsph, Solver::Dfsph, Solver::Pbf}) {
        scene.solver = solver;
        scene.physics.xsph = std::nullopt;
        scene.physics.vorticity_confinement = 0.0f;
        sim::SimulationSettings settings = settings_of(scene).simulation;
        EXPECT_EQ(settings.params.xsph, solver == Solver::Pbf ? 0.01f : 0.0f);
        EXPECT_EQ(settings.options.xsph, solver == Solver::Pbf);
        EXPECT_FALSE(settings.options.confinement);
        scene.physics.xsph = 0.2f;
        scene.physics.vorticity_confinement = 0.7f;
        settings = settings_of(scene).simulation;
        EXPECT_EQ(settings.params.xsph, 0.2f);
        EXPECT_EQ(settings.params.vorticity_confinement, 0.7f);
        EXPECT_TRUE(settings.options.xsph && settings.options.confinement);
        scene.physics.xsph = 0.0f;
        EXPECT_FALSE(settings_of(scene).simulation.options.xsph);
    }
}

TEST(FluidSettings, AutomaticStepKeepsTheViscousBound)
{
    Scene scene = falling_block();
    scene.physics.viscosity = 10'000.0f;
    scene.physics.viscosity_model = ViscosityModel::Explicit;
    const double bound = 0.06 * 1000.0 * 0.04 / 10'000.0;
    EXPECT_LE(dt_of(scene), bound * (1.0 + 1e-6));
    EXPECT_GT(dt_of(scene), 0.9 * bound);
    EXPECT_TRUE(settings_of(scene).warnings.empty());
}

TEST(FluidSettings, ASoftFluidIsStillBoundByItsOwnSpeed)
{
    Scene scene = falling_block();
    scene.physics.speed_of_sound = 0.5f; // far below the 4.75 m/s of its fall
    EXPECT_EQ(settings_of(scene).simulation.params.speed_of_sound, 0.5f);
    EXPECT_LE(dt_of(scene), 0.4 * 0.1 / (0.5 + std::sqrt(2.0 * 9.81 * 1.15)));
}

TEST(FluidSettings, WarnsOfAStepAboveABoundAndNamesIt)
{
    Scene scene = falling_block();
    scene.time.dt = 0.005f;
    std::vector<std::string> warnings = settings_of(scene).warnings;
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("time.dt is 0.005 s, above the CFL bound of 0.0007655 s"), std::string::npos)
        << warnings[0];

    scene.physics.viscosity = 1000.0f;
    scene.physics.viscosity_model = ViscosityModel::Explicit;
    warnings = settings_of(scene).warnings;
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_NE(warnings[1].find("above the viscous bound of 0.0024 s (viscosity 1000 Pa s)"), std::string::npos)
        << warnings[1];

    scene.physics.viscosity = 0.0f;
    scene.solver = Solver::Dfsph; // no sound
    scene.time.dt = 0.01f;
    warnings = settings_of(scene).warnings;
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("above the CFL bound of 0.0045 s (expected speed 4.75 m/s"), std::string::npos)
        << warnings[0];

    scene.time.dt = 0.0005f;
    EXPECT_TRUE(settings_of(scene).warnings.empty());
    EXPECT_EQ(settings_of(scene).simulation.params.dt, 0.0005f);
}

TEST(FluidSettings, WarnsWhereThePapersKernelsNeedMoreViscosity)
{
    Scene scene = falling_block();
    EXPECT_TRUE(settings_of(scene).warnings.empty());
    scene.kernel = SphKernel::Paper;
    const std::vector<std::string> warnings = settings_of(scene).warnings;
    ASSERT_EQ(warnings.size(), 1u);
    // 0.005 rho c0 d
    EXPECT_NE(warnings[0].find("physics.viscosity is 0.01 Pa s; below about 24 Pa s"), std::string::npos)
        << warnings[0];
    scene.physics.viscosity = 24.0f;
    EXPECT_TRUE(settings_of(scene).warnings.empty());
}

TEST(FluidSettings, WarnsWherePositionsAreTooCoarse)
{
    Scene scene = falling_block();
    scene.domain.max.x = 800.0f; // 800 m x 2^-23 = 0.95 thousandths of a spacing
    EXPECT_TRUE(settings_of(scene).warnings.empty());
    scene.domain.min.z = -900.0f;
    const std::vector<std::string> warnings = settings_of(scene).warnings;
    ASSERT_EQ(warnings.size(), 1u);
    EXPECT_NE(warnings[0].find("the domain reaches to 900 m from the origin, where positions are good to 0.00011 m"),
              std::string::npos)
        << warnings[0];
}

std::string refusal(const Scene& scene)
{
    try {
        static_cast<void>(settings_of(scene));
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Input);
        return error.what();
    }
    return "";
}

TEST(FluidSettings, RefusesAStepLongerThanAFrame)
{
    Scene scene = falling_block();
    scene.time.dt = 0.05f;
    EXPECT_EQ(refusal(scene), "falling: time.dt is 0.05 s, longer than a frame of 0.0166667 s (time.frame_rate 60)");
}

TEST(FluidSettings, RefusesWallsCloserThanTwoSupportRadii)
{
    Scene scene = falling_block();
    scene.domain.min.z = -0.19f;
    scene.domain.max.z = 0.19f;
    scene.fluids[0].shape = BlockShape{glm::vec3(-0.1f, 0.1f, -0.1f), glm::vec3(0.1f, 0.3f, 0.1f)};
    EXPECT_NE(refusal(scene).find("0.38 m wide along z"), std::string::npos) << refusal(scene);
    scene.domain.walls = false;
    EXPECT_EQ(refusal(scene), "");
}

TEST(FluidSettings, RefusesMoreStepsThanCanBeCounted)
{
    Scene scene = falling_block();
    scene.time.dt = 1e-9f;
    scene.time.frames = 1000; // 16.65 s
    EXPECT_EQ(refusal(scene),
              "falling: 1000 frames at a dt of 1e-09 s are 1.67e+10 steps, more than 4294967294: choose "
              "fewer frames or a larger time.dt");
}

TEST(FluidSettings, CollidersDoNotFallButSlowTheStepByTheirFriction)
{
    Scene scene = falling_block();
    const double speed = expected_speed(scene, make_particles(scene, 1'000'000));
    const double bound = time_step_bounds(scene, 10.0, 1.0).viscosity;
    scene.colliders.push_back({.shape = SphereShape{scene.domain.max - 0.2f, 0.1f}}); // higher than all fluid
    EXPECT_EQ(expected_speed(scene, make_particles(scene, 1'000'000)), speed);
    EXPECT_EQ(time_step_bounds(scene, 10.0, 1.0).viscosity, bound);
    scene.colliders[0].friction = 2.0f * scene.physics.viscosity;
    EXPECT_NEAR(time_step_bounds(scene, 10.0, 1.0).viscosity, 0.5 * bound, 1e-6 * bound);
}

TEST(FluidSettings, FluidsHaveTheirOwnViscosityOrTheScenes)
{
    Scene scene = falling_block();
    FluidBody oil = scene.fluids[0];
    oil.shape = BlockShape{glm::vec3(-0.2f, 0.2f, -0.2f), glm::vec3(0.2f, 0.6f, 0.2f)};
    scene.fluids.push_back(oil);
    EXPECT_FALSE(settings_of(scene).simulation.options.mixed_viscosity);
    EXPECT_EQ(settings_of(scene).simulation.params.viscosity[0], 0.01f);
    scene.fluids[1].viscosity = 40.0f; // of the same density and color: still another material
    const FluidSettings settings = settings_of(scene);
    EXPECT_TRUE(settings.simulation.options.mixed_viscosity);
    EXPECT_EQ(settings.simulation.params.viscosity[0], 0.01f);
    EXPECT_EQ(settings.simulation.params.viscosity[1], 40.0f);
    EXPECT_EQ(settings.simulation.params.rest_density[1], 1000.0f);
    const double support = 0.2;
    EXPECT_NEAR(static_cast<double>(settings.simulation.params.longest_dt),
                std::min(0.06 * 1000.0 * support * support / 40.0, 1.0 / 60.0), 1e-5);

    // What nobody reads is told.
    EXPECT_TRUE(settings.warnings.empty());
    scene.fluids[0].viscosity = 20.0f;
    ASSERT_EQ(settings_of(scene).warnings.size(), 1u);
    EXPECT_NE(settings_of(scene).warnings[0].find("physics.viscosity is used by no fluid"), std::string::npos);
}

TEST(FluidSettings, MapsTheScene)
{
    Scene scene = falling_block();
    scene.kernel = SphKernel::Wendland;
    scene.particles.support_ratio = 3.0f;
    scene.physics.state_equation = StateEquation::Linear;
    scene.physics.clamp_pressure = false;
    scene.physics.surface_tension = 0.1f;
    scene.physics.tension_model = TensionModel::Paper;
    scene.domain.walls = false;
    scene.fluids[0].rest_density = 800.0f;
    FluidBody second = scene.fluids[0];
    second.rest_density = 1200.0f;
    auto& beside = std::get<BlockShape>(second.shape);
    beside.min.x = std::get<BlockShape>(scene.fluids[0].shape).max.x;
    beside.max.x = beside.min.x + 0.2f;
    scene.fluids.push_back(second);
    scene.colliders.push_back({.shape = SphereShape{{0.0f, 0.2f, 0.0f}, 0.1f}, .friction = 3.0f});
    const sim::SimulationSettings settings = settings_of(scene).simulation;
    EXPECT_EQ(settings.options.kernel, shared::KERNEL_WENDLAND);
    EXPECT_TRUE(settings.options.tension);
    EXPECT_EQ(settings.params.state_equation, shared::STATE_EQUATION_LINEAR);
    EXPECT_EQ(settings.params.clamp_pressure, 0u);
    EXPECT_EQ(settings.params.wall_mask, 0u);
    EXPECT_FLOAT_EQ(settings.params.support_radius, 0.3f);
    EXPECT_EQ(settings.params.gravity, scene.physics.gravity);
    EXPECT_EQ(settings.params.domain_max, scene.domain.max);
    EXPECT_EQ(settings.params.rest_density[0], 800.0f);
    EXPECT_EQ(settings.params.rest_density[1], 1200.0f);
    EXPECT_EQ(settings.params.friction[1], 0.0f);
    EXPECT_EQ(settings.params.friction[2], 3.0f);
    EXPECT_EQ(settings.params.spacing, scene.particles.spacing);
    // No particle may cross more than the CFL share of its support in a step.
    EXPECT_NEAR(settings.params.speed_limit * settings.params.dt, 0.4f * 0.15f, 1e-5f);
}

TEST(FluidSettings, StepsOfDeepWaterAreShorter)
{
    Scene scene;
    scene.solver = Solver::Dfsph;
    scene.particles.spacing = 0.02f;
    scene.domain.min = glm::vec3(0.0f);
    scene.domain.max = {0.2f, 2.0f, 0.4f};
    scene.fluids.push_back({.shape = BlockShape{glm::vec3(0.0f), {0.2f, 1.6f, 0.2f}}}); // 0.8 m, settled
    const auto longest = [&] {
        return fluid_settings(scene, make_particles(scene, 1'000'000)).simulation.params.longest_dt;
    };
    EXPECT_NEAR(longest(), 0.5 * 0.02 / std::sqrt(9.81 * 0.8), 1e-6);
    scene.domain.periodic = {true, false, false};
    EXPECT_NEAR(longest(), 0.5 * 0.02 / std::sqrt(9.81 * 0.8), 1e-6);
    scene.domain.periodic = {false, true, false}; // it falls without end
    EXPECT_FLOAT_EQ(longest(), 4.5e-3f);
    scene.domain.periodic = glm::bvec3(false);
    scene.fluids[0].shape = BlockShape{glm::vec3(0.0f), {0.2f, 0.4f, 0.2f}};
    EXPECT_FLOAT_EQ(longest(), 4.5e-3f);
    SolidBody slab; // on 0.2 m of water, with its own 0.1 m if it were some, it weighs as much as 0.8 m
    slab.shape = BlockShape{{0.0f, 0.4f, 0.0f}, {0.2f, 0.6f, 0.2f}};
    slab.rest_density = 4000.0f;
    slab.anchor = SolidAnchor::None;
    scene.solids.push_back(slab);
    EXPECT_NEAR(longest(), 0.5 * 0.02 / std::sqrt(9.81 * 1.1), 1e-6);
    scene.solids[0].anchor = SolidAnchor::Ground;
    EXPECT_FLOAT_EQ(longest(), 4.5e-3f);
}

} // namespace
} // namespace meltpoint
