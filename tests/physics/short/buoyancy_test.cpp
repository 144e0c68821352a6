// Forces of fluid on colliders.
#include <algorithm>
#include <cmath>

#include "run/collider_forces.h"
#include "support/fluid_box.h"
#include "support/gpu_test.h"
#include "validation/buoyancy.h"

namespace meltpoint {
namespace {

class ColliderForces : public GpuTest {};

// Archimedes, in both solvers.
TEST_F(ColliderForces, ABallUnderWaterIsLifted)
{
    for (const Solver solver : {Solver::Wcsph, Solver::Dfsph}) {
        const validation::Buoyancy ball = validation::measure_buoyancy(context(), solver, 2.0, 4.0f);
        SCOPED_TRACE(ball.measured / ball.exact);
        EXPECT_NEAR(ball.measured / ball.exact, 1.0, 0.05);
        EXPECT_LE(ball.sideways, 0.03 * ball.exact);
        EXPECT_LE(ball.torque, 0.02 * ball.exact * 0.2);
    }
}

constexpr std::uint32_t drop_particles = 5 * 5 * 5;

/// A drop above a plate one particle thick in a box without walls or gravity, thrown at it aslant.
ParticleSet thrown_drop()
{
    ParticleSet set = lattice_state({5, 5, 5}, test_spacing * glm::vec3(4.5f, 8.5f, 5.5f));
    std::ranges::fill(set.velocity, glm::vec3(1.0f, -2.0f, 0.5f));
    add_plate(set, 16.0f * test_spacing, 5.0f * test_spacing, 0.75f * test_spacing, 0.3f, 1);
    return set;
}

sim::SimulationSettings drop_settings(std::uint32_t solver, float friction)
{
    sim::SimulationSettings settings =
        box_settings(shared::KERNEL_WENDLAND, 2.0, {16, 26, 16}, 3.0, friction > 0.0f ? 0.5 : 0.0);
    settings.options.solver = solver;
    settings.params.gravity = glm::vec3(0.0f);
    settings.params.wall_mask = 0;
    settings.params.friction[1] = friction;
    if (solver == shared::SOLVER_DFSPH) {
        settings.params.dt = 2e-3f;
        settings.params.speed_limit = 100.0f;
    }
    return settings;
}

struct Motion {
    glm::dvec3 momentum{0.0};
    glm::dvec3 angular{0.0}; ///< momentum about the origin
};

Motion motion_of(const ParticleSet& set)
{
    Motion motion;
    for (std::size_t i = 0; i < drop_particles; ++i) {
        const glm::dvec3 momentum = static_cast<double>(set.mass[i]) * glm::dvec3(set.velocity[i]);
        motion.momentum += momentum;
        motion.angular += glm::cross(glm::dvec3(set.position[i]), momentum);
    }
    return motion;
}

// What the fluid loses the plate gets: momentum with friction, and angular momentum without (viscous forces are not
// central). Half a time step of the last force is still to come in velocity Verlet.
TEST_F(ColliderForces, GiveThePlateWhatTheyTakeFromTheFluid)
{
    for (const std::uint32_t solver : {shared::SOLVER_WCSPH, shared::SOLVER_DFSPH}) {
        for (const float friction : {0.0f, 5.0f}) {
            SCOPED_TRACE(testing::Message() << "solver " << solver << ", friction " << friction);
            const ParticleSet start = thrown_drop();
            const ColliderParticles plate{.first_id = drop_particles,
                                          .points = {start.position.begin() + drop_particles, start.position.end()}};
            sim::Simulation simulation(context(), start, drop_settings(solver, friction));
            simulation.measure_boundary_forces();
            simulation.advance_by(0.1);
            const Motion before = motion_of(start);
            const Motion after = motion_of(simulation.download());
            const ColliderForce force = collider_forces(simulation.take_boundary_forces(), {&plate, 1}).at(0);
            const double lost = glm::length(after.momentum - before.momentum);
            EXPECT_GE(lost, 0.4 * glm::length(before.momentum)); // it has hit the plate
            const double tolerance = solver == shared::SOLVER_DFSPH ? 1e-5 : 2e-3;
            const double seconds = simulation.time();
            EXPECT_LE(glm::length(after.momentum - before.momentum + seconds * force.total()), tolerance * lost);
            if (friction > 0.0f) {
                EXPECT_GE(force.friction.x * seconds, 0.03 * before.momentum.x);
                EXPECT_GE(force.friction.z * seconds, 0.03 * before.momentum.z);
            } else {
                EXPECT_EQ(glm::length(force.friction), 0.0);
                EXPECT_LE(glm::length(after.angular - before.angular + seconds * force.torque), tolerance * lost);
            }
        }
    }
}

TEST_F(ColliderForces, AreMeansSinceTheyWereLastTaken)
{
    sim::Simulation simulation(context(), thrown_drop(), drop_settings(shared::SOLVER_DFSPH, 0.0f));
    EXPECT_THROW((void)simulation.take_boundary_forces(), std::logic_error);
    simulation.measure_boundary_forces();
    simulation.advance_by(0.1);
    EXPECT_EQ(simulation.take_boundary_forces().first_id, drop_particles);
    for (const glm::dvec3& force : simulation.take_boundary_forces().pressure) { // no time has passed
        ASSERT_EQ(force, glm::dvec3(0.0));
    }
}

} // namespace
} // namespace meltpoint
