// XSPH and vorticity confinement, options of every solver, on a vortex in a box that wears away.
#include "support/fluid_box.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

constexpr std::uint32_t width = 12;

class Vortex : public GpuTest {
protected:
    static sim::SimulationSettings settings(std::uint32_t solver)
    {
        sim::SimulationSettings settings = box_settings(shared::KERNEL_WENDLAND, 2.0, {width, width, 5}, 1.0, 0.5);
        settings.params.gravity = glm::vec3(0.0f);
        settings.options.solver = solver;
        settings.params.longest_move = test_spacing;
        if (solver != shared::SOLVER_WCSPH) {
            settings.params.dt = 5e-3f;
        }
        settings.params.speed_limit = 2.0f * settings.params.speed_cap / settings.params.dt;
        return settings;
    }

    /// With a little room, or particles that solvers keep at rest density could not pass one another.
    static ParticleSet turning_fluid()
    {
        ParticleSet set = fluid_in_corner({width, width, 5});
        std::ranges::fill(set.mass, 0.95f * set.mass[0]);
        const float half = 0.5f * width * test_spacing;
        for (std::size_t i = 0; i < set.size(); ++i) {
            const glm::vec2 r = glm::vec2(set.position[i]) - half;
            const float u = 1.0f - glm::dot(r, r) / (half * half);
            set.velocity[i] = u > 0.0f ? 8.0f * u * glm::vec3(-r.y, r.x, 0.0f) : glm::vec3(0.0f);
        }
        return set;
    }

    /// After 0.3 s.
    ParticleSet later(const sim::SimulationSettings& settings)
    {
        sim::Simulation simulation(context(), turning_fluid(), settings);
        simulation.advance(steps_for(0.3, settings));
        return simulation.download();
    }
};

constexpr std::uint32_t all_solvers[] = {shared::SOLVER_WCSPH, shared::SOLVER_DFSPH, shared::SOLVER_PBF};

TEST_F(Vortex, ConfinementStrengthensItAndXsphWearsItAway)
{
    for (const std::uint32_t solver : all_solvers) {
        SCOPED_TRACE(solver);
        const double free = kinetic_energy(later(settings(solver)));
        EXPECT_LT(free, 0.95 * kinetic_energy(turning_fluid()));
        sim::SimulationSettings confined = settings(solver);
        confined.options.confinement = true;
        confined.params.vorticity_confinement = 0.1f;
        EXPECT_GT(kinetic_energy(later(confined)), 1.1 * free);
        sim::SimulationSettings smoothed = settings(solver);
        smoothed.options.xsph = true;
        smoothed.params.xsph = 0.05f;
        EXPECT_LT(kinetic_energy(later(smoothed)), 0.9 * free);
    }
}

TEST_F(Vortex, NoStrengthChangesNoBit)
{
    for (const std::uint32_t solver : all_solvers) {
        SCOPED_TRACE(solver);
        const ParticleSet without = later(settings(solver));
        sim::SimulationSettings nothing = settings(solver);
        nothing.options.xsph = nothing.options.confinement = true; // the passes run
        const ParticleSet with = later(nothing);
        EXPECT_EQ(without.position, with.position);
        EXPECT_EQ(without.velocity, with.velocity);
    }
}

} // namespace
} // namespace meltpoint
