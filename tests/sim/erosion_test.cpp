// Solids that fronts turn into fluid: who is freed and when, that nothing is lost, and that it does no more than that.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include "conformance/pass_comparison.h"
#include "core/random.h"
#include "reference/erosion.h"
#include "support/fluid_states.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

constexpr float d = test_spacing;
constexpr float never = std::numeric_limits<float>::infinity();

class ErosionTest : public GpuTest {
protected:
    static sim::SimulationSettings settings(std::uint32_t solver)
    {
        sim::SimulationSettings settings = test_settings(shared::KERNEL_WENDLAND);
        settings.options.solver = solver;
        settings.options.still = true;
        settings.params.dt = solver == shared::SOLVER_WCSPH ? 2e-4f : 1e-3f;
        return settings;
    }

    /// Half a lattice is fluid, half solid; and a plate beside it.
    static ParticleSet half_solid()
    {
        ParticleSet set = lattice_state({10, 8, 10}, glm::vec3(0.2f, 0.4f, 0.2f));
        for (std::size_t i = 0; i < set.size(); ++i) {
            if (i % 2 == 0) {
                set.attributes[i] = shared::pack_attributes(shared::STATE_SOLID, 2);
            }
        }
        add_plate(set, 1.0f, 0.3f, 0.75f * d, 0.3f, 3);
        return set;
    }

    /// Some at once, most within `span` seconds, some never.
    static std::vector<float> times(const ParticleSet& set, double span)
    {
        Random random(5);
        std::vector<float> release(set.size());
        for (float& time : release) {
            const double draw = random.uniform();
            time = draw < 0.1 ? 0.0f : draw > 0.8 ? never : static_cast<float>((draw - 0.1) * span);
        }
        return release;
    }

    static std::vector<std::uint32_t> solids(const ParticleSet& set)
    {
        std::vector<std::uint32_t> ids;
        for (std::size_t i = 0; i < set.size(); ++i) {
            if (shared::particle_state(set.attributes[i]) == shared::STATE_SOLID) {
                ids.push_back(set.id[i]);
            }
        }
        return ids;
    }
};

TEST_F(ErosionTest, AFrontFreesWhatItHasReachedAndNothingIsLost)
{
    for (const std::uint32_t solver : {shared::SOLVER_WCSPH, shared::SOLVER_DFSPH, shared::SOLVER_PBF}) {
        SCOPED_TRACE(solver);
        sim::SimulationSettings its = settings(solver);
        ParticleSet start = half_solid();
        start.release_time = times(start, 50.0 * static_cast<double>(its.params.dt));
        sim::Simulation simulation(context(), start, its);
        reference::State twin = reference::from_particle_set(start);
        std::size_t freed = 0;
        for (int look = 0; look < 40; ++look) {
            freed += reference::release(twin, start.release_time, simulation.time());
            simulation.advance(1); // looks, then steps
            simulation.advance(simulation.steps_until_erosion());
            const ParticleSet now = simulation.download();
            ASSERT_EQ(now.size(), start.size());
            for (std::size_t i = 0; i < now.size(); ++i) {
                EXPECT_EQ(now.id[i], i);
                EXPECT_EQ(now.mass[i], start.mass[i]);
                EXPECT_EQ(now.attributes[i], twin.attributes[i]) << "particle " << i << ", t = " << simulation.time();
                if (shared::is_boundary(now.attributes[i])) {
                    EXPECT_EQ(now.position[i], start.position[i]);
                    EXPECT_EQ(now.velocity[i], glm::vec3(0.0f));
                }
            }
        }
        EXPECT_GT(freed, start.size() / 5);
        EXPECT_GT(solids(simulation.download()).size(), 50u); // whom no front reaches
    }
}

// However long steps are: of a front that crosses a solid between two looks, all would be freed at once.
TEST_F(ErosionTest, LooksAreSoNearThatAFrontFreesAFiftiethAtATime)
{
    std::vector<float> arrivals;
    for (int i = 100; i > 0; --i) { // 1 s to 100 s, the last first
        arrivals.push_back(static_cast<float>(i));
        arrivals.push_back(std::numeric_limits<float>::infinity());
    }
    const sim::Erosion erosion(context(), arrivals);
    EXPECT_EQ(erosion.longest_look(0.0), 3.0);
    EXPECT_EQ(erosion.longest_look(50.5), 2.5);
    EXPECT_EQ(erosion.longest_look(99.0), 1.0);
    EXPECT_EQ(erosion.longest_look(100.0), std::numeric_limits<double>::infinity());
}

TEST_F(ErosionTest, WhatIsFreedMovesAsFluidDoes)
{
    for (const std::uint32_t solver : {shared::SOLVER_WCSPH, shared::SOLVER_DFSPH, shared::SOLVER_PBF}) {
        SCOPED_TRACE(solver);
        sim::SimulationSettings its = settings(solver);
        its.options.implicit_viscosity = solver != shared::SOLVER_PBF;
        its.options.xsph = its.options.confinement = true;
        its.params.xsph = 0.2f;
        its.params.vorticity_confinement = 1.0f;
        // A set number of iterations, or rounding alone would decide how many there are.
        its.params.density_error = its.params.divergence_error = its.params.viscosity_error = 0.0f;
        its.params.max_iterations = its.params.viscosity_iterations = 5;
        ParticleSet start = half_solid();
        const std::uint32_t interval = 4; // of a pool that moves by half
        const float second_look = (static_cast<float>(interval) - 0.5f) * its.params.dt;
        start.release_time = times(start, 0.0);
        for (float& time : start.release_time) { // all that there is to free, half a step before the second look
            time = time == 0.0f ? second_look : time;
        }
        for (const conformance::PassError& error : conformance::compare_steps(context(), start, its, interval + 1)) {
            EXPECT_TRUE(error.conforms()) << error.pass << ": " << error.error << " > " << error.bound;
        }
    }
}

// What steps carry over follows the particles when the pool is parted anew.
TEST_F(ErosionTest, WhoIsFarFromTheFreedDoesNotNotice)
{
    for (const auto& [solver, viscous] : {std::pair{shared::SOLVER_WCSPH, false},
                                          {shared::SOLVER_DFSPH, false},
                                          {shared::SOLVER_PBF, false},
                                          {shared::SOLVER_WCSPH, true}}) {
        SCOPED_TRACE(testing::Message() << solver << (viscous ? ", implicit viscosity" : ""));
        sim::SimulationSettings its = settings(solver);
        its.options.implicit_viscosity = viscous;
        its.params.density_error = its.params.divergence_error = its.params.viscosity_error = 0.0f;
        set_viscosity(its.params, viscous ? 1e5f : 1.0f); // so much that a solve ends far from its end
        its.params.max_iterations = its.params.viscosity_iterations =
            3; // or the freed one would count in when they end
        ParticleSet start;
        add_particle(start, glm::vec3(0.1f, 0.1f, 0.1f)); // in the first cells: all others change places
        start.attributes[0] = shared::pack_attributes(shared::STATE_SOLID, 2);
        const ParticleSet block = lattice_state({8, 9, 8}, glm::vec3(0.4f, 0.5f * d, 0.4f));
        for (std::size_t i = 0; i < block.size(); ++i) {
            const glm::vec3& x = block.position[i]; // sheared, or viscosity would have nothing to do
            add_particle(start, x, glm::vec3(2.0f * x.y, -1.0f - x.x, 3.0f * x.x));
        }
        ParticleSet seen[2];
        for (const bool frees : {false, true}) {
            start.release_time.assign(start.size(), never);
            start.release_time[0] = frees ? 1.5f * its.params.dt : never;
            sim::Simulation simulation(context(), start, its);
            simulation.advance(6); // four steps, a look, two steps
            seen[frees ? 1 : 0] = simulation.download();
        }
        EXPECT_NE(seen[1].attributes[0], seen[0].attributes[0]);
        for (std::size_t i = 1; i < start.size(); ++i) {
            // The sums of the viscous solve run over other workgroups: rounding may differ.
            const float tolerance = viscous ? 1e-5f * glm::length(seen[0].velocity[i]) : 0.0f;
            EXPECT_LE(glm::distance(seen[1].velocity[i], seen[0].velocity[i]), tolerance) << "particle " << i;
            EXPECT_LE(std::abs(seen[1].density[i] - seen[0].density[i]), viscous ? 1e-2f : 0.0f);
        }
    }
}

TEST_F(ErosionTest, FreedParticlesAreNotKicked)
{
    for (const std::uint32_t solver : {shared::SOLVER_WCSPH, shared::SOLVER_DFSPH, shared::SOLVER_PBF}) {
        SCOPED_TRACE(solver);
        sim::SimulationSettings its = settings(solver);
        its.params.gravity = glm::vec3(0.0f);
        its.params.correction_time = 1e-2f;
        its.params.artificial_pressure = 0.0f; // which moves particles at any surface
        ParticleSet start = lattice_state({10, 10, 10}, glm::vec3(0.25f));
        std::ranges::fill(start.attributes, shared::pack_attributes(shared::STATE_SOLID, 2));
        start.release_time = times(start, 20.0 * static_cast<double>(its.params.dt));
        sim::Simulation simulation(context(), start, its);
        double fastest = 0.0;
        for (int look = 0; look < 10; ++look) {
            simulation.advance(10);
            for (const glm::vec3& v : simulation.download().velocity) {
                fastest = std::max(fastest, static_cast<double>(glm::length(v)));
            }
        }
        EXPECT_LT(solids(simulation.download()).size(), start.size() / 2);
        EXPECT_LT(fastest, 0.02 * static_cast<double>(its.params.speed_of_sound));
    }
}

TEST_F(ErosionTest, RerunsGiveTheSameBitsInAnyPortions)
{
    for (const std::uint32_t solver : {shared::SOLVER_WCSPH, shared::SOLVER_DFSPH}) {
        SCOPED_TRACE(solver);
        sim::SimulationSettings its = settings(solver);
        ParticleSet start = half_solid();
        start.release_time = times(start, 80.0 * static_cast<double>(its.params.dt));
        sim::Simulation whole(context(), start, its);
        whole.advance(100);
        sim::Simulation portions(context(), start, its);
        for (const std::uint32_t steps : {1u, 7u, 16u, 20u, 50u, 6u}) {
            portions.advance(steps);
        }
        const ParticleSet a = whole.download();
        const ParticleSet b = portions.download();
        EXPECT_EQ(a.position, b.position);
        EXPECT_EQ(a.velocity, b.velocity);
        EXPECT_EQ(a.attributes, b.attributes);
        EXPECT_EQ(a.density, b.density);
    }
}

TEST_F(ErosionTest, ASimulationMayBeginWithoutAnyFluid)
{
    for (const std::uint32_t solver : {shared::SOLVER_WCSPH, shared::SOLVER_DFSPH, shared::SOLVER_PBF}) {
        SCOPED_TRACE(solver);
        sim::SimulationSettings its = settings(solver);
        its.params.adaptive_dt = 1;
        its.params.cfl_length = 0.4f * d;
        its.params.cfl_speed = solver == shared::SOLVER_WCSPH ? its.params.speed_of_sound : 0.0f;
        its.params.longest_dt = 2e-3f;
        its.params.longest_move = 0.5f * its.params.support_radius;
        ParticleSet start = lattice_state({6, 6, 6}, glm::vec3(0.3f));
        std::ranges::fill(start.attributes, shared::pack_attributes(shared::STATE_SOLID, 2));
        start.release_time.assign(start.size(), 0.05f);
        sim::Simulation simulation(context(), start, its);
        simulation.advance_by(0.04);
        EXPECT_EQ(simulation.download().position, start.position);
        simulation.advance_by(0.06);
        EXPECT_TRUE(solids(simulation.download()).empty());
        EXPECT_LT(simulation.download().velocity[0].y, -0.05f); // it falls
    }
}

} // namespace
} // namespace meltpoint
