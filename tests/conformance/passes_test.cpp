// Every pass of the fluid step on the device against its twin in double precision, over the states in which a pass
// could go wrong, for both kernels and several tile sizes.
#include <array>
#include <tuple>

#include "conformance/pass_comparison.h"
#include "support/fluid_states.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

constexpr float d = test_spacing;

const std::vector<NamedState>& states()
{
    static const std::vector<NamedState> all{
        {"Lattice",
         [] {
             return lattice_state({9, 8, 7}, glm::vec3(0.3f));
         }},
        {"LatticeOnTheFloor",
         [] {
             return lattice_state({20, 5, 20}, glm::vec3(0.5f * d));
         }},
        {"Random",
         [] {
             return random_state(1501, glm::vec3(0.2f), glm::vec3(0.7f), 1);
         }},
        {"Splash",
         [] {
             return splash_state(2);
         }},
        {"SprayAboveAFloor", // tiles so wide that their particles walk one by one
         [] {
             return spray_above_a_floor();
         }},
        {"WideHalfway", // likewise, though only some rows would need it
         [] {
             return wide_halfway();
         }},
        {"One",
         [] {
             ParticleSet set;
             add_particle(set, glm::vec3(0.5f), glm::vec3(1.0f, 2.0f, 3.0f));
             return set;
         }},
        {"Two",
         [] {
             ParticleSet set;
             add_particle(set, glm::vec3(0.5f), glm::vec3(1.0f, 0.0f, 0.0f));
             add_particle(set, glm::vec3(0.5f, 0.5f + 0.4f * d, 0.5f), glm::vec3(-1.0f, 0.0f, 0.5f));
             return set;
         }},
        {"OnCellBorders", // cells are multiples of d in both kernels' grids
         [] {
             return lattice_state({10, 10, 10}, glm::vec3(0.25f));
         }},
        {"AllInOneCell",
         [] {
             return random_state(600, glm::vec3(0.51f), glm::vec3(0.51f + 0.4f * d), 3);
         }},
        {"Coincident", // at rest, or the drift would part them
         [] {
             ParticleSet set = lattice_state({5, 5, 5}, glm::vec3(0.4f));
             const std::size_t count = set.size();
             for (std::size_t i = 0; i < count; ++i) {
                 add_particle(set, set.position[i]);
             }
             return set;
         }},
        {"NearlyCoincident", // likewise; less, and a little more, than COINCIDENT_RATIO apart
         [] {
             ParticleSet set;
             for (const float apart : {6e-8f, 1e-6f}) {
                 const glm::vec3 x(0.51f + 1e3f * apart, 0.52f, 0.53f);
                 add_particle(set, x);
                 add_particle(set, x + glm::vec3(0.0f, apart, 0.0f));
             }
             return set;
         }},
        {"OnACollider", // a block that has sunk a little into an uneven plate, walls around and below
         [] {
             ParticleSet set = lattice_state({12, 5, 11}, glm::vec3(0.02f, 0.16f, 0.31f));
             Random random(7);
             for (glm::vec3& velocity : set.velocity) {
                 velocity = random_vector(random) - 0.5f;
             }
             add_plate(set, 1.0f, 0.14f, 0.8f * d, 0.3f, 8);
             return set;
         }},
        {"CollidersOnly", // of which two lie on top of each other
         [] {
             ParticleSet set;
             add_plate(set, 1.0f, 0.01f, d, 0.0f, 9);
             add_boundary_particle(set, set.position[0]);
             return set;
         }},
        {"InTheCorners",
         [] {
             ParticleSet set;
             for (int corner = 0; corner < 8; ++corner) {
                 const glm::vec3 side(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
                 for (int i = 1; i <= 5; ++i) {
                     const float inset = 0.17f * static_cast<float>(i) * d;
                     add_particle(set, glm::mix(glm::vec3(inset), glm::vec3(1.0f - inset), side),
                                  glm::vec3(0.3f) - 0.7f * side);
                 }
             }
             return set;
         }},
    };
    return all;
}

class PassConformance : public GpuTest, public testing::WithParamInterface<std::tuple<std::size_t, std::uint32_t>> {
protected:
    void expect_conformance(const sim::SimulationSettings& settings, const ParticleSet& state)
    {
        for (const conformance::PassError& pass : conformance::compare_passes(context(), state, settings)) {
            EXPECT_TRUE(pass.conforms()) << pass.pass << ": " << pass.error << " > " << pass.bound << " ("
                                         << pass.excluded << " excluded)";
            // A lattice has up to 30 neighbors at exactly 3 d.
            EXPECT_LE(pass.excluded, state.size() * 36) << pass.pass << ": too much left out to mean anything";
        }
    }
};

TEST_P(PassConformance, AllPasses)
{
    const auto [state, kernel] = GetParam();
    expect_conformance(test_settings(kernel), states()[state].make());
}

TEST_P(PassConformance, EachForceAlone)
{
    const auto [state, kernel] = GetParam();
    const ParticleSet particles = states()[state].make();

    sim::SimulationSettings nothing = test_settings(kernel);
    nothing.params.gravity = glm::vec3(0.0f);
    set_viscosity(nothing.params, 0.0f);
    nothing.params.wall_mask = 0;
    nothing.params.speed_of_sound = 0.0f;
    sim::SimulationSettings pressure = nothing;
    pressure.params.speed_of_sound = 40.0f;
    sim::SimulationSettings linear = pressure;
    linear.params.state_equation = shared::STATE_EQUATION_LINEAR;
    linear.params.clamp_pressure = 0;
    linear.params.background_pressure = 500.0f;
    sim::SimulationSettings viscosity = nothing;
    set_viscosity(viscosity.params, 3.0f);
    sim::SimulationSettings tension = nothing;
    tension.options.tension = true;
    tension.params.surface_tension = 0.5f;
    tension.params.tension_threshold = 0.5f;
    sim::SimulationSettings walls = nothing;
    walls.params.wall_mask = 0x3f;
    walls.params.wall_viscosity = 2.0f;
    sim::SimulationSettings friction = nothing;
    friction.params.friction[1] = 3.0f;
    sim::SimulationSettings some_walls = pressure;
    some_walls.params.wall_mask = 0x26; // x max, y min, z max
    for (const auto& [name, settings] : {std::pair{"pressure", pressure},
                                         {"linear, unclamped", linear},
                                         {"viscosity", viscosity},
                                         {"tension", tension},
                                         {"walls", walls},
                                         {"some walls", some_walls},
                                         {"friction", friction}}) {
        SCOPED_TRACE(name);
        expect_conformance(settings, particles);
    }
}

TEST_P(PassConformance, SolvedPressure)
{
    const auto [state, kernel] = GetParam();
    sim::SimulationSettings settings = test_settings(kernel);
    settings.options.solver = shared::SOLVER_DFSPH;
    settings.params.dt = 2e-3f;
    for (const std::uint32_t tile : {1u, 4u}) {
        SCOPED_TRACE(tile);
        settings.options.tile = tile;
        settings.params.correction_time = tile == 4 ? 3.0f * settings.params.dt : 0.0f;
        expect_conformance(settings, states()[state].make());
    }
}

TEST_P(PassConformance, SolvedViscosity)
{
    const auto [state, kernel] = GetParam();
    sim::SimulationSettings settings = test_settings(kernel);
    settings.options.implicit_viscosity = true;
    set_viscosity(settings.params, 300.0f);
    settings.params.friction[1] = 100.0f;
    settings.params.wall_viscosity = 200.0f;
    settings.params.dt = 2e-3f;
    for (const std::uint32_t tile : {1u, 4u}) {
        SCOPED_TRACE(tile);
        settings.options.tile = tile;
        expect_conformance(settings, states()[state].make());
    }
}

TEST_P(PassConformance, SolvedPositions)
{
    const auto [state, kernel] = GetParam();
    sim::SimulationSettings settings = test_settings(kernel);
    settings.options.solver = shared::SOLVER_PBF;
    settings.params.dt = 4e-3f;
    settings.params.artificial_pressure = 0.1f;
    for (const std::uint32_t tile : {1u, 4u}) {
        SCOPED_TRACE(tile);
        settings.options.tile = tile;
        settings.params.clamp_pressure = tile == 4 ? 1 : 0;
        expect_conformance(settings, states()[state].make());
    }
}

TEST_P(PassConformance, XsphAndConfinement)
{
    const auto [state, kernel] = GetParam();
    sim::SimulationSettings settings = test_settings(kernel);
    settings.options.xsph = settings.options.confinement = true;
    settings.params.xsph = 0.5f;
    settings.params.vorticity_confinement = 3.0f;
    for (const std::uint32_t tile : {1u, 4u}) {
        SCOPED_TRACE(tile);
        settings.options.tile = tile;
        expect_conformance(settings, states()[state].make());
    }
}

TEST_P(PassConformance, SurfaceTension)
{
    const auto [state, kernel] = GetParam();
    sim::SimulationSettings settings = with_tension(test_settings(kernel));
    for (const std::uint32_t tile : {1u, 4u}) {
        SCOPED_TRACE(tile);
        settings.options.tile = tile;
        expect_conformance(settings, states()[state].make());
    }
}

// Three fluids side by side that differ in density and viscosity, one of which has none.
TEST_P(PassConformance, SeveralFluids)
{
    const auto [state, kernel] = GetParam();
    ParticleSet particles = states()[state].make();
    constexpr std::uint32_t materials = 3;
    constexpr std::array<std::uint32_t, materials> material{0, 2, 3}; // 1 is the colliders'
    sim::SimulationSettings settings = test_settings(kernel);
    settings.options.mixed_viscosity = true;
    settings.params.rest_density[2] = 700.0f;
    settings.params.rest_density[3] = 1300.0f;
    settings.params.viscosity[2] = 20.0f;
    settings.params.viscosity[3] = 0.0f;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        if (!shared::is_boundary(particles.attributes[i])) {
            const std::uint32_t m = material[i % 5 < materials ? i % 5 : 0];
            particles.attributes[i] = shared::pack_attributes(shared::STATE_FLUID, m);
            particles.mass[i] *= settings.params.rest_density[m] / test_rest_density;
        }
    }
    expect_conformance(settings, particles);
    settings.options.solver = shared::SOLVER_DFSPH;
    settings.options.implicit_viscosity = true;
    settings.params.dt = 2e-3f;
    expect_conformance(settings, particles);
}

// Boundary particles in a grid of their own, colliders and solids.
TEST_P(PassConformance, StillParticles)
{
    const auto [state, kernel] = GetParam();
    ParticleSet particles = states()[state].make();
    for (std::size_t i = 0; i < particles.size(); i += 2) { // some of a solid that fills its space
        if (shared::is_boundary(particles.attributes[i])) {
            particles.attributes[i] = shared::with_state(particles.attributes[i], shared::STATE_SOLID);
            particles.mass[i] = test_rest_density * d * d * d;
            particles.weight[i] = 1.0f;
            if (i % 10 == 0) {
                particles.attributes[i] = shared::with_state(particles.attributes[i], shared::STATE_DEAD);
                particles.weight[i] = 0.0f;
            }
        }
    }
    sim::SimulationSettings plain = test_settings(kernel);
    plain.options.still = true;
    plain.params.friction[1] = 3.0f;
    sim::SimulationSettings everything = with_tension(plain);
    everything.options.xsph = everything.options.confinement = true;
    everything.params.xsph = 0.5f;
    everything.params.vorticity_confinement = 3.0f;
    sim::SimulationSettings solved = plain;
    solved.options.solver = shared::SOLVER_DFSPH;
    solved.options.implicit_viscosity = true;
    set_viscosity(solved.params, 300.0f);
    solved.params.dt = 2e-3f;
    sim::SimulationSettings positions = plain;
    positions.options.solver = shared::SOLVER_PBF;
    positions.params.dt = 4e-3f;
    for (const auto& [name, settings] : {std::pair{"wcsph", everything}, {"dfsph", solved}, {"pbf", positions}}) {
        for (const std::uint32_t tile : {1u, 4u}) {
            SCOPED_TRACE(testing::Message() << name << ", tile " << tile);
            sim::SimulationSettings its = settings;
            its.options.tile = tile;
            expect_conformance(its, particles);
        }
    }
}

TEST_P(PassConformance, EveryTileSize)
{
    const auto [state, kernel] = GetParam();
    const ParticleSet particles = states()[state].make();
    for (const std::uint32_t tile : {1u, 3u, 4u, 16u}) {
        SCOPED_TRACE(tile);
        sim::SimulationSettings settings = test_settings(kernel);
        settings.options.tile = tile;
        expect_conformance(settings, particles);
    }
}

INSTANTIATE_TEST_SUITE_P(States, PassConformance,
                         testing::Combine(testing::Range<std::size_t>(0, states().size()),
                                          testing::Values(shared::KERNEL_PAPER, shared::KERNEL_WENDLAND)),
                         [](const auto& instance) {
                             return states()[std::get<0>(instance.param)].name +
                                    (std::get<1>(instance.param) == shared::KERNEL_PAPER ? "Paper" : "Wendland");
                         });

class MaterialConformance : public PassConformance {};

// Fluids of different rest density in one run: each particle's own material decides.
TEST_F(MaterialConformance, TwoRestDensities)
{
    for (const std::uint32_t kernel : {shared::KERNEL_PAPER, shared::KERNEL_WENDLAND}) {
        sim::SimulationSettings settings = test_settings(kernel);
        settings.params.rest_density[1] = 700.0f;
        ParticleSet set = lattice_state({8, 8, 8}, glm::vec3(0.3f));
        for (std::size_t i = 0; i < set.size(); ++i) {
            if (set.position[i].y > 0.5f) {
                set.attributes[i] = shared::pack_attributes(shared::STATE_FLUID, 1);
                set.mass[i] *= 0.7f;
            }
        }
        expect_conformance(settings, set);
    }
}

} // namespace
} // namespace meltpoint
