// Whole steps: against the twin, against what is exact, and against themselves.
#include <algorithm>
#include <cstdlib>

#include "conformance/pass_comparison.h"
#include "core/error.h"
#include "support/fluid_states.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class Steps : public GpuTest {};

constexpr std::uint32_t both_kernels[] = {shared::KERNEL_PAPER, shared::KERNEL_WENDLAND};

void expect_all(const std::vector<conformance::PassError>& errors)
{
    for (const conformance::PassError& error : errors) {
        EXPECT_TRUE(error.conforms()) << error.pass << ": " << error.error << " > " << error.bound;
    }
}

TEST_F(Steps, OneStepIsTheTwins)
{
    for (const std::uint32_t kernel : both_kernels) {
        ParticleSet on_a_plate = lattice_state({10, 4, 10}, glm::vec3(0.2f, 0.33f, 0.2f));
        add_plate(on_a_plate, 1.0f, 0.3f, 0.8f * test_spacing, 0.3f, 3);
        expect_all(conformance::compare_steps(context(), on_a_plate, test_settings(kernel), 1));
        expect_all(conformance::compare_steps(context(), splash_state(4), test_settings(kernel), 1));
        expect_all(conformance::compare_steps(context(), lattice_state({20, 6, 10}, glm::vec3(0.5f * test_spacing)),
                                              test_settings(kernel), 1));
    }
}

TEST_F(Steps, FiftyStepsKeepTheTwinsEnergyAndCenter)
{
    for (const std::uint32_t kernel : both_kernels) {
        expect_all(conformance::compare_steps(context(), lattice_state({10, 12, 10}, glm::vec3(0.5f * test_spacing)),
                                              test_settings(kernel), 50));
        ParticleSet on_a_plate = lattice_state({10, 4, 10}, glm::vec3(0.2f, 0.36f, 0.2f));
        add_plate(on_a_plate, 1.0f, 0.3f, 0.75f * test_spacing, 0.3f, 3);
        expect_all(conformance::compare_steps(context(), on_a_plate, test_settings(kernel), 50));
    }
}

sim::SimulationSettings dfsph_settings(std::uint32_t kernel)
{
    sim::SimulationSettings settings = test_settings(kernel);
    settings.options.solver = shared::SOLVER_DFSPH;
    settings.params.dt = 2e-3f;
    return settings;
}

ParticleSet falling_block()
{
    ParticleSet block = lattice_state({8, 9, 8}, glm::vec3(0.3f, 0.5f * test_spacing, 0.3f));
    std::ranges::fill(block.velocity, glm::vec3(0.3f, -1.0f, 0.1f));
    return block;
}

TEST_F(Steps, StepsWithSolvedPressureAreTheTwins)
{
    for (const std::uint32_t kernel : both_kernels) {
        SCOPED_TRACE(kernel);
        // A set number of iterations, or rounding alone would decide how many there are.
        sim::SimulationSettings settings = dfsph_settings(kernel);
        settings.params.density_error = settings.params.divergence_error = 0.0f;
        settings.params.max_iterations = 5;
        ParticleSet on_a_plate = lattice_state({10, 4, 10}, glm::vec3(0.2f, 0.36f, 0.2f));
        add_plate(on_a_plate, 1.0f, 0.3f, 0.75f * test_spacing, 0.3f, 3);
        for (const ParticleSet& set : {on_a_plate, falling_block()}) {
            expect_all(conformance::compare_steps(context(), set, settings, 1));
            expect_all(conformance::compare_steps(context(), set, settings, 3));
            expect_all(conformance::compare_steps(context(), set, dfsph_settings(kernel), 50));
        }
    }
}

TEST_F(Steps, StepsWithSolvedViscosityAreTheTwins)
{
    for (const std::uint32_t solver : {shared::SOLVER_WCSPH, shared::SOLVER_DFSPH}) {
        SCOPED_TRACE(solver);
        sim::SimulationSettings settings = solver == shared::SOLVER_DFSPH ? dfsph_settings(shared::KERNEL_WENDLAND)
                                                                          : test_settings(shared::KERNEL_WENDLAND);
        settings.options.implicit_viscosity = true;
        set_viscosity(settings.params, 500.0f);
        settings.params.friction[1] = 100.0f;
        settings.params.wall_viscosity = 50.0f;
        // A set number of iterations, or rounding alone would decide how many there are.
        sim::SimulationSettings counted = settings;
        counted.params.density_error = counted.params.divergence_error = counted.params.viscosity_error = 0.0f;
        counted.params.max_iterations = counted.params.viscosity_iterations = 5;
        ParticleSet on_a_plate = lattice_state({10, 4, 10}, glm::vec3(0.2f, 0.36f, 0.2f));
        add_plate(on_a_plate, 1.0f, 0.3f, 0.75f * test_spacing, 0.3f, 3);
        for (const ParticleSet& set : {on_a_plate, falling_block()}) {
            expect_all(conformance::compare_steps(context(), set, counted, 1));
            expect_all(conformance::compare_steps(context(), set, counted, 3));
            expect_all(conformance::compare_steps(context(), set, settings, 50));
        }
    }
}

sim::SimulationSettings pbf_settings(std::uint32_t kernel)
{
    sim::SimulationSettings settings = test_settings(kernel);
    settings.options.solver = shared::SOLVER_PBF;
    settings.params.dt = 4e-3f;
    return settings;
}

TEST_F(Steps, StepsWithSolvedPositionsAreTheTwins)
{
    for (const std::uint32_t kernel : both_kernels) {
        SCOPED_TRACE(kernel);
        // A set number of iterations, or rounding alone would decide how many there are.
        sim::SimulationSettings settings = pbf_settings(kernel);
        settings.params.least_iterations = settings.params.max_iterations = 4;
        ParticleSet on_a_plate = lattice_state({10, 4, 10}, glm::vec3(0.2f, 0.36f, 0.2f));
        add_plate(on_a_plate, 1.0f, 0.3f, 0.75f * test_spacing, 0.3f, 3);
        for (const ParticleSet& set : {on_a_plate, falling_block()}) {
            expect_all(conformance::compare_steps(context(), set, settings, 1));
            expect_all(conformance::compare_steps(context(), set, settings, 3));
            expect_all(conformance::compare_steps(context(), set, pbf_settings(kernel), 50));
        }
    }
}

// Boundary particles in a grid of their own, with every buffer that a step swaps.
TEST_F(Steps, StepsBesideStillParticlesAreTheTwins)
{
    ParticleSet on_a_plate = lattice_state({10, 4, 10}, glm::vec3(0.2f, 0.36f, 0.2f));
    add_plate(on_a_plate, 1.0f, 0.3f, 0.75f * test_spacing, 0.3f, 3);
    for (sim::SimulationSettings settings :
         {test_settings(shared::KERNEL_WENDLAND), dfsph_settings(shared::KERNEL_WENDLAND),
          pbf_settings(shared::KERNEL_WENDLAND)}) {
        SCOPED_TRACE(settings.options.solver);
        settings.options.still = true;
        settings.params.friction[1] = 3.0f;
        expect_all(conformance::compare_steps(context(), on_a_plate, settings, 50));
        settings.options.xsph = settings.options.confinement = settings.options.shifting = true;
        settings.params.xsph = 0.2f;
        settings.params.vorticity_confinement = 1.0f;
        settings.params.shifting = 1e-3f;
        settings.options.implicit_viscosity = settings.options.solver != shared::SOLVER_PBF;
        set_viscosity(settings.params, settings.options.implicit_viscosity ? 500.0f : 1.0f);
        // A set number of iterations, or rounding alone would decide how many there are.
        settings.params.density_error = settings.params.divergence_error = settings.params.viscosity_error = 0.0f;
        settings.params.max_iterations = settings.params.viscosity_iterations = 5;
        expect_all(conformance::compare_steps(context(), on_a_plate, settings, 3));
    }
}

TEST_F(Steps, StepsWithXsphAndConfinementAreTheTwins)
{
    for (sim::SimulationSettings settings :
         {test_settings(shared::KERNEL_WENDLAND), dfsph_settings(shared::KERNEL_WENDLAND),
          pbf_settings(shared::KERNEL_WENDLAND)}) {
        settings.options.xsph = settings.options.confinement = true;
        settings.params.xsph = 0.2f;
        settings.params.vorticity_confinement = 1.0f;
        expect_all(conformance::compare_steps(context(), falling_block(), settings, 3));
    }
}

TEST_F(Steps, StepsWithSurfaceTensionAreTheTwins)
{
    for (const sim::SimulationSettings& settings :
         {test_settings(shared::KERNEL_WENDLAND), dfsph_settings(shared::KERNEL_WENDLAND),
          pbf_settings(shared::KERNEL_WENDLAND)}) {
        expect_all(conformance::compare_steps(context(), falling_block(), with_tension(settings), 3));
    }
}

// Alone it never reaches rest density, so nothing but the contact holds it.
TEST_F(Steps, WallsHoldALoneParticle)
{
    for (sim::SimulationSettings settings :
         {dfsph_settings(shared::KERNEL_WENDLAND), pbf_settings(shared::KERNEL_WENDLAND)}) {
        settings.params.artificial_pressure = 0.0f; // which keeps it off its own image
        ParticleSet set;
        add_particle(set, glm::vec3(0.5f, 0.05f, 0.98f), glm::vec3(0.0f, -1.0f, 3.0f));
        sim::Simulation simulation(context(), set, settings);
        simulation.advance(100);
        const ParticleSet after = simulation.download();
        EXPECT_NEAR(after.position[0].y, settings.params.contact_distance, 1e-6f);
        EXPECT_NEAR(after.position[0].z, 1.0f - settings.params.contact_distance, 1e-6f);
        EXPECT_NEAR(glm::length(after.velocity[0]), 0.0f, 1e-3f);
    }
}

// No energy to be relative to: a lattice at rest without gravity, and a particle all alone, whose energy is 0 / 0.
TEST_F(Steps, RestWithoutGravityConforms)
{
    sim::SimulationSettings settings = test_settings(shared::KERNEL_WENDLAND);
    settings.params.gravity = glm::vec3(0.0f);
    ParticleSet lattice = lattice_state({6, 6, 6}, glm::vec3(0.5f * test_spacing));
    std::ranges::fill(lattice.velocity, glm::vec3(0.0f));
    expect_all(conformance::compare_steps(context(), lattice, settings, 12));
    ParticleSet alone;
    add_particle(alone, glm::vec3(0.5f), glm::vec3(0.0f));
    expect_all(conformance::compare_steps(context(), alone, settings, 12));
}

TEST_F(Steps, FreeFallIsExact)
{
    sim::SimulationSettings settings = test_settings(shared::KERNEL_WENDLAND);
    settings.params.domain_max = glm::vec3(1.0f, 4.0f, 1.0f);
    settings.params.dt = 1e-3f;
    ParticleSet set;
    add_particle(set, glm::vec3(0.5f, 3.5f, 0.5f), glm::vec3(0.1f, 1.0f, 0.0f));
    sim::Simulation simulation(context(), set, settings);
    simulation.advance(700);
    const double t = 0.7;
    const glm::dvec3 exact = glm::dvec3(0.5 + 0.1 * t, 3.5 + 1.0 * t - 0.5 * 9.81 * t * t, 0.5);
    EXPECT_LE(glm::length(glm::dvec3(simulation.download().position[0]) - exact), 1e-5 * glm::length(exact));
}

// Closed, no gravity, no walls: a jittered block flies apart, and the sum of its momenta must not care.
TEST_F(Steps, MomentumIsConserved)
{
    std::vector<sim::SimulationSettings> all;
    for (const std::uint32_t kernel : both_kernels) {
        all.push_back(test_settings(kernel));
        all.push_back(dfsph_settings(kernel));
        all.push_back(pbf_settings(kernel));
        all.back().params.speed_cap = 1.0f; // a particle that is slowed down loses momentum
    }
    all.push_back(test_settings(shared::KERNEL_WENDLAND));
    all.back().options.xsph = true;
    all.back().params.xsph = 0.3f;
    for (sim::SimulationSettings& settings : all) {
        SCOPED_TRACE(settings.options.solver);
        settings.params.gravity = glm::vec3(0.0f);
        settings.params.wall_mask = 0;
        Random random(5);
        ParticleSet set = lattice_state({9, 9, 9}, glm::vec3(0.3f));
        for (std::size_t i = 0; i < set.size(); ++i) {
            set.position[i] += 0.1f * test_spacing * (random_vector(random) - 0.5f);
            set.velocity[i] = random_vector(random) - 0.5f;
            set.mass[i] *= i % 3 == 0 ? 0.6f : 1.0f;
        }
        sim::Simulation simulation(context(), set, settings);
        simulation.advance(settings.options.solver == shared::SOLVER_PBF ? 40 : 100);
        const ParticleSet after = simulation.download();
        glm::dvec3 change(0.0);
        double scale = 0.0;
        for (std::size_t i = 0; i < set.size(); ++i) {
            change += static_cast<double>(set.mass[i]) * (glm::dvec3(after.velocity[i]) - glm::dvec3(set.velocity[i]));
            scale += static_cast<double>(set.mass[i]) * glm::length(glm::dvec3(after.velocity[i]));
        }
        EXPECT_LE(glm::length(change), 1e-6 * scale);
    }
}

TEST_F(Steps, RerunsAndTileSizesGiveTheSameBits)
{
    sim::SimulationSettings fixed_iterations = pbf_settings(shared::KERNEL_PAPER);
    fixed_iterations.params.least_iterations = fixed_iterations.params.max_iterations = 4;
    for (sim::SimulationSettings settings : {test_settings(shared::KERNEL_PAPER), fixed_iterations}) {
        SCOPED_TRACE(settings.options.solver);
        const auto run = [&](std::uint32_t tile) {
            settings.options.tile = tile;
            sim::Simulation simulation(context(), splash_state(6), settings);
            simulation.advance(settings.options.solver == shared::SOLVER_PBF ? 25 : 100);
            return simulation.download();
        };
        const ParticleSet first = run(8);
        for (const std::uint32_t tile : {8u, 4u, 1u, 3u}) {
            const ParticleSet again = run(tile);
            EXPECT_EQ(first.position, again.position);
            EXPECT_EQ(first.velocity, again.velocity);
            EXPECT_EQ(first.density, again.density);
        }
    }
}

TEST_F(Steps, RerunsWithSolvedViscosityGiveTheSameBits)
{
    ParticleSet first;
    for (int run = 0; run < 3; ++run) {
        sim::SimulationSettings settings = dfsph_settings(shared::KERNEL_WENDLAND);
        settings.options.implicit_viscosity = true;
        set_viscosity(settings.params, 500.0f);
        sim::Simulation simulation(context(), falling_block(), settings);
        simulation.advance(40);
        const ParticleSet set = simulation.download();
        if (run == 0) {
            first = set;
            EXPECT_GE(simulation.take_viscosity_statistics().value().mean_iterations, 1.0);
        }
        EXPECT_EQ(set.position, first.position);
        EXPECT_EQ(set.velocity, first.velocity);
        EXPECT_EQ(set.pressure, first.pressure);
    }
}

std::string fault_message(const gpu::Context& context, const ParticleSet& set, const sim::SimulationSettings& settings,
                          std::uint32_t steps)
{
    sim::Simulation simulation(context, set, settings);
    try {
        simulation.advance(steps);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Runtime);
        return error.what();
    }
    return "no fault";
}

TEST_F(Steps, AnEscapeIsReportedWithStepAndParticle)
{
    sim::SimulationSettings settings = test_settings(shared::KERNEL_PAPER);
    settings.params.gravity = glm::vec3(0.0f);
    settings.params.wall_mask = 0;
    settings.params.dt = 0.01f;
    ParticleSet set;
    add_particle(set, glm::vec3(0.2f));
    add_particle(set, glm::vec3(0.5f), glm::vec3(4.0f, 0.0f, 0.0f)); // passes x = 1 in the 13th step
    add_particle(set, glm::vec3(0.8f));
    const std::string message = fault_message(context(), set, settings, 40);
    EXPECT_NE(message.find("step 12"), std::string::npos) << message;
    EXPECT_NE(message.find("particle 1"), std::string::npos) << message;
    EXPECT_NE(message.find("left the domain"), std::string::npos) << message;
}

TEST_F(Steps, ANotANumberIsReportedWithTheSmallestId)
{
    ParticleSet set =
        lattice_state({4, 4, 4}, glm::vec3(0.4f)); // ids 0 to 63; the faulty ones have no neighbors to infect
    add_particle(set, glm::vec3(0.9f, 0.9f, 0.9f), glm::vec3(0.0f, std::numeric_limits<float>::quiet_NaN(), 0.0f));
    add_particle(set, glm::vec3(0.1f, 0.9f, 0.9f), glm::vec3(std::numeric_limits<float>::infinity(), 0.0f, 0.0f));
    const std::string message = fault_message(context(), set, test_settings(shared::KERNEL_WENDLAND), 3);
    EXPECT_NE(message.find("step 0"), std::string::npos) << message;
    EXPECT_NE(message.find("particle 64"), std::string::npos) << message;
    EXPECT_NE(message.find("not a finite number"), std::string::npos) << message;
}

TEST_F(Steps, ASpeedBeyondTheLimitIsReported)
{
    sim::SimulationSettings settings = test_settings(shared::KERNEL_PAPER);
    settings.params.speed_limit = 3.0f;
    ParticleSet set;
    add_particle(set, glm::vec3(0.5f, 0.9f, 0.5f), glm::vec3(0.0f, -2.9f, 0.0f));
    const std::string message = fault_message(context(), set, settings, 400);
    EXPECT_NE(message.find("faster than"), std::string::npos) << message;
}

TEST_F(Steps, TooManyAndTooFewParticlesAreOneSentence)
{
    EXPECT_THROW(sim::Simulation(context(), ParticleSet{}, test_settings(shared::KERNEL_PAPER)), Error);
    EXPECT_GE(sim::Simulation::particle_limit(context()), 1'000'000u);
}

TEST_F(Steps, NeighborStatisticsOfALattice)
{
    // Interior particles of a cubic lattice have 32 neighbors within 2 d (not counting those at 2 d exactly): 26 + 6 at
    // 2 d are decided by rounding, so take a radius between shells.
    sim::SimulationSettings settings = test_settings(shared::KERNEL_PAPER);
    settings.params.support_radius = 1.9f * test_spacing; // 6 + 12 + 8 neighbors
    set_kernel_scales(settings.params, shared::KERNEL_PAPER, static_cast<double>(test_spacing));
    ParticleSet set = lattice_state({3, 3, 3}, glm::vec3(0.4f));
    add_particle(set, set.position[0]);
    sim::Simulation simulation(context(), set, settings);
    const sim::NeighborStatistics statistics = simulation.neighbor_statistics();
    // In a 3x3x3 block: 1 center with 26, 6 faces with 17, 12 edges with 11, 8 corners with 7; then the twin of a
    // corner: it has that corner and its 7 neighbors, each of which has one more.
    EXPECT_DOUBLE_EQ(statistics.mean, (26 + 6 * 17 + 12 * 11 + 8 * 7 + 8 + 8) / 28.0);
    EXPECT_EQ(statistics.coincident, 2u);
}

TEST_F(Steps, NeighborStatisticsAreThoseOfTheFluid)
{
    ParticleSet set;
    add_particle(set, glm::vec3(0.5f));
    add_boundary_particle(set, glm::vec3(0.5f, 0.45f, 0.5f));
    add_boundary_particle(set, glm::vec3(0.5f, 0.45f, 0.5f));
    sim::Simulation simulation(context(), set, test_settings(shared::KERNEL_PAPER));
    EXPECT_EQ(simulation.neighbor_statistics().mean, 2.0);
    EXPECT_EQ(simulation.neighbor_statistics().coincident, 0u);
}

TEST_F(Steps, BoundaryParticlesAreNeverAtFault)
{
    ParticleSet set;
    add_particle(set, glm::vec3(0.5f));
    add_boundary_particle(set, glm::vec3(0.2f));
    add_boundary_particle(set, glm::vec3(0.5f, 1.0f, 1.5f));
    set.velocity.back() = glm::vec3(1e6f);
    EXPECT_EQ(fault_message(context(), set, test_settings(shared::KERNEL_WENDLAND), 3), "no fault");
}

} // namespace
} // namespace meltpoint
