// Sand in the wind: against the twins, and against what the literature says.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numbers>
#include <utility>
#include <vector>

#include "gpu/transfer.h"
#include "particles/sph_kernel.h"
#include "reference/exposure.h"
#include "reference/visibility.h"
#include "reference/wind.h"
#include "sim/visibility.h"
#include "sim/wind.h"
#include "support/fluid_states.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

constexpr double gravity = 9.81;

TEST(WindTest, ThresholdAndFluxAreThoseOfTheLiterature)
{
    const sim::Sand sand{.erodes = true};
    EXPECT_NEAR(sim::threshold_friction_velocity(sand, 1.2, gravity), 0.28, 0.01);
    sim::Sand fine = sand; // the easiest to move is of about 75 um (Shao & Lu 2000, figure 2)
    fine.grain_size = 75e-6;
    sim::Sand finer = sand;
    finer.grain_size = 20e-6;
    EXPECT_LT(sim::threshold_friction_velocity(fine, 1.2, gravity),
              sim::threshold_friction_velocity(sand, 1.2, gravity));
    EXPECT_GT(sim::threshold_friction_velocity(finer, 1.2, gravity),
              sim::threshold_friction_velocity(fine, 1.2, gravity));

    sim::WindSettings wind{.friction_velocity = 0.5};
    EXPECT_NEAR(sim::bagnold_flux(wind, sand, gravity), 1.8 * 1.2 / gravity * 0.125, 1e-12);
    sim::Sand coarse = sand;
    coarse.grain_size = 4.0 * 250e-6;
    wind.friction_velocity = 0.7;
    EXPECT_NEAR(sim::bagnold_flux(wind, coarse, gravity), 2.0 * 1.8 * 1.2 / gravity * 0.343, 1e-12);
    wind.friction_velocity = 0.27;
    EXPECT_EQ(sim::bagnold_flux(wind, sand, gravity), 0.0);
    // 250 um of quartz fall at 1.6 to 2 m/s.
    EXPECT_NEAR(gravity * sim::response_time(sand, 1.2, gravity), 1.8, 0.25);
}

class SandTest : public GpuTest {
protected:
    /// Wendland, H = 2 d: the scenes' support.
    static sim::SimulationSettings settings(double friction_velocity, double time_scale)
    {
        sim::SimulationSettings its = test_settings(shared::KERNEL_WENDLAND);
        its.options.solver = shared::SOLVER_DFSPH;
        its.options.still = true;
        its.params.support_radius = 2.0f * test_spacing;
        set_kernel_scales(its.params, shared::KERNEL_WENDLAND, static_cast<double>(test_spacing));
        its.params.dt = 4e-3f;
        its.wind.emplace();
        its.wind->friction_velocity = friction_velocity;
        its.wind->hop_length = 0.3;
        its.wind->time_scale = time_scale;
        its.wind->sand[0].erodes = true;
        return its;
    }

    static void add_grain(ParticleSet& set, const glm::vec3& x)
    {
        add_particle(set, x);
        set.attributes.back() = shared::pack_attributes(shared::STATE_SOLID, 0);
        set.release_time.push_back(std::numeric_limits<float>::infinity());
    }

    static void add_block(ParticleSet& set, const glm::ivec3& count, const glm::vec3& corner, float jitter = 0.0f)
    {
        Random random(7);
        for (int i = 0; i < count.x * count.y * count.z; ++i) {
            const glm::vec3 cell(i % count.x, i / count.x % count.y, i / (count.x * count.y));
            add_grain(set, corner + test_spacing * (cell + 0.5f + jitter * (random_vector(random) - 0.5f)));
        }
    }

    static std::size_t count(const ParticleSet& set, std::uint32_t state)
    {
        return static_cast<std::size_t>(std::ranges::count_if(
            set.attributes, [&](std::uint32_t each) { return shared::particle_state(each) == state; }));
    }

    /// By id, as the device has it.
    reference::SandState sand_state(const sim::Simulation& simulation, std::size_t size)
    {
        reference::SandState sand{.damage = {},
                                  .rests = gpu::download<std::uint32_t>(context(), simulation.wind()->rests(), size)};
        for (const glm::vec2& each : gpu::download<glm::vec2>(context(), simulation.wind()->damage(), size)) {
            sand.damage.push_back(static_cast<double>(each.x) + static_cast<double>(each.y));
        }
        return sand;
    }

    /// All that flies is gone.
    static void sink_all(sim::SimulationSettings& its)
    {
        its.emission.sinks.push_back(
            {.low = {-10.0f, -10.0f, -10.0f}, .shape = shared::SINK_BLOCK, .high = {10.0f, 10.0f, 10.0f}});
    }
};

TEST_F(SandTest, StepsAndLooksAreTheTwins)
{
    sim::SimulationSettings its = settings(0.6, 3000.0);
    its.params.domain_max = {1.4f, 1.0f, 0.6f};
    its.params.wall_mask = 0x0f;
    its.params.periodic_mask = 0x30; // z
    ParticleSet start;
    add_block(start, {10, 7, 12}, glm::vec3(0.2f, 0.0f, 0.0f), 0.3f); // steep at its ends
    sim::Simulation simulation(context(), start, its);
    const reference::Settings twin_settings{.kernel = its.options.kernel, .params = simulation.params()};
    const shared::WindParams& wind = simulation.wind()->params();
    const shared::VisibilityParams above = sim::visibility_params(sim::ground_view(wind), simulation.params());
    const shared::VisibilityParams aside = sim::visibility_params(sim::wind_view(wind), simulation.params());
    std::vector<reference::Ground> ground;
    const auto look_around = [&](const reference::State& state) {
        ground = reference::ground(twin_settings, above, reference::depth_map(above, state));
    };
    look_around(reference::from_particle_set(start));
    reference::SandChanges sum;
    std::size_t flying = 0;
    std::size_t differ = 0;
    double looked_at = 0.0;
    double slid_for = 0.0;
    for (int step = 0; step < 140; ++step) {
        // From the device's own state each time: small errors do not add up.
        const ParticleSet before = simulation.download();
        reference::State twin = reference::from_particle_set(before);
        reference::SandState sand = sand_state(simulation, before.size());
        const bool looks = simulation.steps_until_erosion() == 0;
        const double now = simulation.time();
        simulation.advance(1);
        if (looks) {
            const double seconds = now - looked_at;
            looked_at = now;
            slid_for += seconds;
            const bool slides = slid_for >= simulation.wind()->slide_time();
            slid_for = slides ? 0.0 : slid_for;
            const auto exposure = reference::exposure(twin_settings, twin);
            const auto seen = reference::visibility_of_solids(aside, reference::depth_map(aside, twin), twin, exposure);
            const reference::SandChanges changes = reference::look_at_sand(
                twin_settings, {wind, above, ground}, twin, sand, exposure, seen, seconds * its.wind->time_scale,
                seconds > 0.0 ? 0.5 * seconds_between_looks(simulation) / seconds : 0.0, slides);
            sum.picked_up += changes.picked_up;
            sum.fell += changes.fell;
            sum.slid += changes.slid;
            sum.rolled += changes.rolled;
            sum.landed += changes.landed;
            look_around(twin);
        }
        reference::move_sand(twin_settings, {wind, above, ground}, twin, sand);
        const ParticleSet after = simulation.download();
        const reference::SandState found = sand_state(simulation, after.size());
        for (std::size_t i = 0; i < after.size(); ++i) {
            if (after.attributes[i] != twin.attributes[i] || found.rests[i] != sand.rests[i] ||
                glm::distance(glm::dvec3(after.position[i]), twin.position[i]) > 2e-5 ||
                glm::distance(glm::dvec3(after.velocity[i]), twin.velocity[i]) > 2e-3) {
                ++differ; // an edge of a texel, or of a threshold, lay between the two
            }
            ASSERT_NEAR(found.damage[i], sand.damage[i], 2e-3) << "particle " << i << ", " << step;
            flying += shared::is_flying_sand(after.attributes[i]) ? 1 : 0;
        }
        ASSERT_LT(differ, 4u) << step;
    }
    EXPECT_GT(sum.picked_up, 50u);
    EXPECT_GT(sum.fell, 10u);
    EXPECT_GT(sum.slid, 100u);
    EXPECT_GT(sum.rolled, 20u);
    EXPECT_GT(sum.landed, 50u);
    EXPECT_GT(flying, 100u);
}

TEST_F(SandTest, AFlatBedLosesItsFluxOverTheLengthOfAHop)
{
    sim::SimulationSettings its = settings(0.5, 4000.0);
    sink_all(its);
    ParticleSet start;
    add_block(start, {20, 14, 20}, glm::vec3(0.0f));
    sim::Simulation simulation(context(), start, its);
    const double speed = sim::bagnold_flux(*its.wind, its.wind->sand[0], gravity) / 0.3 * 4000.0 / 1000.0; // m/s
    double times[2] = {0.0, 0.0};
    const std::size_t layer = 400;
    while (simulation.time() < 5.0 && times[1] == 0.0) {
        simulation.advance(1);
        const std::size_t left = count(simulation.download(), shared::STATE_SOLID);
        times[0] = times[0] == 0.0 && left <= 12 * layer ? simulation.time() : times[0];
        times[1] = left <= 4 * layer ? simulation.time() : 0.0;
    }
    EXPECT_NEAR(8.0 * static_cast<double>(test_spacing) / (times[1] - times[0]) / speed, 1.0, 0.03);
    const double gone = 1000.0 * std::pow(static_cast<double>(test_spacing), 3) *
                        static_cast<double>(5600 - count(simulation.download(), shared::STATE_SOLID));
    EXPECT_NEAR(simulation.picked_up() / gone, 1.0, 1e-6);
}

TEST_F(SandTest, BelowTheThresholdNothingMoves)
{
    sim::SimulationSettings its = settings(0.27, 1e6);
    ParticleSet start;
    add_block(start, {20, 4, 20}, glm::vec3(0.0f));
    sim::Simulation simulation(context(), start, its);
    simulation.advance(200);
    EXPECT_EQ(count(simulation.download(), shared::STATE_SOLID), start.size());
    EXPECT_EQ(simulation.picked_up(), 0.0);
}

TEST_F(SandTest, TheWindHasBeenAtWorkBeforeTheStart)
{
    sim::SimulationSettings its = settings(0.5, 4000.0);
    sink_all(its);
    ParticleSet start;
    add_block(start, {20, 4, 20}, glm::vec3(0.0f));
    sim::Simulation simulation(context(), start, its);
    const double layer = // kg/m^2, over what the wind takes in a second
        1000.0 * static_cast<double>(test_spacing) / (sim::bagnold_flux(*its.wind, its.wind->sand[0], gravity) / 0.3);
    while (simulation.time() * 4000.0 < 0.2 * layer) {
        simulation.advance(1);
    }
    const double left = static_cast<double>(count(simulation.download(), shared::STATE_SOLID));
    EXPECT_NEAR((1600.0 - left) / 400.0, 0.78 * 0.2, 0.03); // of the uppermost layer, which has 78 % of the area
}

TEST_F(SandTest, NoSandLeavesShelteredPlaces)
{
    sim::SimulationSettings its = settings(0.5, 4000.0);
    sink_all(its);
    its.params.domain_max.x = 2.0f;
    ParticleSet start;
    add_block(start, {40, 3, 20}, glm::vec3(0.0f));
    const std::size_t sand = start.size();
    add_block(start, {2, 8, 20}, glm::vec3(0.7f, 0.15f, 0.0f)); // a wall across, of stone
    for (std::size_t i = sand; i < start.size(); ++i) {
        start.attributes[i] = shared::pack_attributes(shared::STATE_SOLID, 1);
    }
    sim::Simulation simulation(context(), start, its);
    simulation.advance(80);
    const ParticleSet now = simulation.download();
    std::size_t lost_before = 0;
    std::size_t lost_behind = 0;
    for (std::size_t i = 0; i < sand; ++i) {
        const bool lost = shared::particle_state(now.attributes[i]) != shared::STATE_SOLID;
        // Its shadow is 6 x 0.4 m long: all that lies behind.
        lost_before += lost && start.position[i].x < 0.5f ? 1 : 0;
        lost_behind += lost && start.position[i].x > 0.9f ? 1 : 0;
    }
    EXPECT_GT(lost_before, 200u);
    EXPECT_EQ(lost_behind, 0u);
}

TEST_F(SandTest, GrainsHopAsFarAsTheyAreMeantTo)
{
    sim::SimulationSettings its = settings(0.5, 1.0);
    its.wind->hop_length = 0.5;
    its.params.domain_max = {3.0f, 1.0f, 0.5f};
    ParticleSet start;
    add_block(start, {60, 2, 10}, glm::vec3(0.0f));
    std::vector<std::size_t> flying;
    for (int i = 0; i < 20; ++i) { // just launched from the bed, far from each other
        add_grain(start, glm::vec3(0.25f + 0.05f * static_cast<float>(i), 0.125f, 0.25f));
        flying.push_back(start.size() - 1);
        start.attributes.back() =
            shared::freed_as(shared::pack_attributes(shared::STATE_DUST, 0), shared::STATE_DUST, shared::CAUSE_WIND);
        start.weight.back() = 0.0f;
    }
    const shared::WindParams wind = sim::wind_params(*its.wind, its.params);
    double expected = 0.0;
    for (const std::size_t i : flying) {
        start.velocity[i].y = wind.of[0].launch_speed * shared::launch_share(static_cast<std::uint32_t>(i));
        expected += 0.5 / 20.0;
    }
    sim::Simulation simulation(context(), start, its);
    simulation.advance(200);
    const ParticleSet now = simulation.download();
    double mean = 0.0;
    for (const std::size_t i : flying) {
        EXPECT_EQ(shared::particle_state(now.attributes[i]), shared::STATE_SOLID) << i;
        mean += static_cast<double>(now.position[i].x - start.position[i].x) / 20.0;
    }
    EXPECT_NEAR(mean / expected, 1.0, 0.2); // twenty of random strength
    EXPECT_GE(simulation.deposited(), 20u); // and who of the bed was about to hop
}

// Where the domain has none, it is gone there.
TEST_F(SandTest, WallsStopSandInTheAir)
{
    for (const bool closed : {true, false}) {
        sim::SimulationSettings its = settings(0.6, 3000.0);
        its.params.domain_max = {0.8f, 0.4f, 0.4f};
        its.params.wall_mask = closed ? 0x3f : 0;
        ParticleSet start;
        add_block(start, {12, 2, 8}, glm::vec3(0.1f, 0.0f, 0.0f));
        sim::Simulation simulation(context(), start, its);
        simulation.advance(120);
        const ParticleSet now = simulation.download();
        EXPECT_GT(simulation.picked_up(), 0.0);
        EXPECT_EQ(count(now, shared::STATE_DEAD) == 0, closed);
        for (const glm::vec3& x : now.position) {
            EXPECT_TRUE(glm::all(glm::greaterThanEqual(x, its.params.domain_min)) &&
                        glm::all(glm::lessThanEqual(x, its.params.domain_max)));
        }
    }
}

TEST_F(SandTest, SandDoesNotLandWhereFluidIs)
{
    sim::SimulationSettings its = settings(0.6, 3000.0);
    its.params.dt = 2e-3f;
    its.params.rest_density[1] = test_rest_density;
    ParticleSet start;
    add_block(start, {10, 2, 20}, glm::vec3(0.0f));
    const std::size_t sand = start.size();
    add_block(start, {10, 2, 20}, glm::vec3(10.0f * test_spacing, 0.0f, 0.0f));
    for (std::size_t i = sand; i < start.size(); ++i) { // a pool on its lee
        start.attributes[i] = shared::pack_attributes(shared::STATE_FLUID, 1);
    }
    sim::Simulation simulation(context(), start, its);
    std::size_t landed = 0;
    double nearest = std::numeric_limits<double>::infinity(); // spacings, of fluid to where sand lands
    for (int step = 0; step < 300; ++step) {
        const ParticleSet before = simulation.download();
        simulation.advance(1);
        const ParticleSet after = simulation.download();
        for (std::size_t i = 0; i < sand; ++i) {
            if (shared::particle_state(before.attributes[i]) != shared::STATE_DUST ||
                shared::particle_state(after.attributes[i]) != shared::STATE_SOLID) {
                continue;
            }
            ++landed;
            for (std::size_t j = sand; j < start.size(); ++j) {
                const double distance = static_cast<double>(glm::distance(after.position[i], before.position[j]));
                nearest = std::min(nearest, distance / static_cast<double>(test_spacing));
            }
        }
    }
    EXPECT_GT(landed, 30u);
    EXPECT_GE(nearest, 0.85 * (1.0 - 1e-5));
    EXPECT_LT(nearest, 1.2); // they do meet
}

TEST_F(SandTest, TheCrestOfADuneMovesDownwind)
{
    sim::SimulationSettings its = settings(0.5, 3000.0);
    its.params.domain_max = {3.0f, 1.0f, 0.4f};
    its.params.wall_mask = 0x0f;
    its.params.periodic_mask = 0x30;
    ParticleSet start;
    for (int layer = 0; layer < 9; ++layer) { // half as steep as its angle of repose
        add_block(start, {56 - 6 * layer, 1, 8}, test_spacing * glm::vec3(4 + 3 * layer, layer, 0), 0.2f);
    }
    const auto crest = [](const ParticleSet& set) { // mean x of the top tenth
        std::vector<std::pair<float, float>> places;
        for (std::size_t i = 0; i < set.size(); ++i) {
            if (shared::particle_state(set.attributes[i]) == shared::STATE_SOLID) {
                places.emplace_back(-set.position[i].y, set.position[i].x);
            }
        }
        std::ranges::sort(places);
        double sum = 0.0;
        for (std::size_t k = 0; k < places.size() / 10; ++k) {
            sum += static_cast<double>(places[k].second);
        }
        return sum / static_cast<double>(places.size() / 10);
    };
    sim::Simulation simulation(context(), start, its);
    simulation.advance(600); // 2.4 s
    EXPECT_GT(crest(simulation.download()), crest(start) + 2.0 * static_cast<double>(test_spacing));
}

/// Of the flanks of a heap that is the same all along z: of columns a spacing wide the highest particles that lie
/// between a tenth and nine tenths of its height, on the line through them. Degrees.
double flank_angle(const ParticleSet& set, float spacing, float toward)
{
    std::map<int, float> tops;
    float highest = 0.0f;
    float middle = 0.0f;
    for (std::size_t i = 0; i < set.size(); ++i) {
        float& top = tops[static_cast<int>(std::floor(set.position[i].x / spacing))];
        top = std::max(top, set.position[i].y);
        if (top > highest) {
            highest = top;
            middle = set.position[i].x;
        }
    }
    double n = 0.0;
    glm::dvec2 sum(0.0);
    double xx = 0.0;
    double xy = 0.0;
    for (const auto& [column, top] : tops) {
        const double x = (column + 0.5) * static_cast<double>(spacing);
        const double y = static_cast<double>(top);
        if ((x - static_cast<double>(middle)) * static_cast<double>(toward) > 0.0 && top > 0.1f * highest &&
            top < 0.9f * highest) {
            n += 1.0;
            sum += glm::dvec2(x, y);
            xx += x * x;
            xy += x * y;
        }
    }
    const double slope = (n * xy - sum.x * sum.y) / (n * xx - sum.x * sum.x);
    return std::atan(-slope * static_cast<double>(toward)) * 180.0 / std::numbers::pi;
}

/// The largest sum of V W over the particles at one of them, in space that is periodic along z.
double most_filled(const ParticleSet& set, const shared::SphParams& params)
{
    const float length = params.domain_max.z - params.domain_min.z;
    double most = 0.0;
    for (const glm::vec3& x : set.position) {
        double sum = 0.0;
        for (const glm::vec3& other : set.position) {
            glm::vec3 offset = x - other;
            offset.z -= length * std::round(offset.z / length);
            sum += density_shape(shared::KERNEL_WENDLAND,
                                 static_cast<double>(glm::length(offset)) / static_cast<double>(params.support_radius));
        }
        most = std::max(most, sum);
    }
    return most * static_cast<double>(params.lattice_volume) * static_cast<double>(params.density_scale);
}

TEST_F(SandTest, HeapsStandAtTheirAngleOfRepose)
{
    for (const float jitter : {0.0f, 0.6f}) {
        sim::SimulationSettings its = settings(0.0, 1.0);
        its.params.domain_max = {5.0f, 2.4f, 0.4f};
        its.params.wall_mask = 0x0f;
        its.params.periodic_mask = 0x30;
        ParticleSet start;
        its.params.dt = 0.02f;
        add_block(start, {44, 22, 8}, glm::vec3(1.4f, 0.0f, 0.0f), jitter);
        sim::Simulation simulation(context(), start, its);
        simulation.advance(1000); // 20 s
        const ParticleSet rest = simulation.download();
        EXPECT_EQ(count(rest, shared::STATE_SOLID), start.size());
        float highest = 0.0f;
        for (const glm::vec3& x : rest.position) {
            highest = std::max(highest, x.y);
        }
        EXPECT_GT(highest, 15.0f * test_spacing);
        EXPECT_NEAR(flank_angle(rest, test_spacing, -1.0f), 34.0, 3.0) << jitter;
        EXPECT_NEAR(flank_angle(rest, test_spacing, 1.0f), 34.0, 3.0) << jitter;
        EXPECT_LT(most_filled(rest, its.params), most_filled(start, its.params) + 1e-3) << "nobody is where others are";
        simulation.advance(50);
        EXPECT_TRUE(simulation.download().position == rest.position) << "it stays";
    }
}

TEST_F(SandTest, RerunsAreBitIdenticalAndTheLedgerIsExact)
{
    sim::SimulationSettings its = settings(0.6, 2000.0);
    its.params.domain_max = {1.4f, 1.0f, 0.6f};
    its.params.wall_mask = 0x0d; // open downwind
    its.params.periodic_mask = 0x30;
    ParticleSet start;
    add_block(start, {12, 8, 12}, glm::vec3(0.2f, 0.0f, 0.0f), 0.3f);
    ParticleSet seen[2];
    for (ParticleSet& run : seen) {
        sim::Simulation simulation(context(), start, its);
        for (int portion = 0; portion < 10; ++portion) {
            simulation.advance(40);
            const ParticleSet now = simulation.download();
            ASSERT_EQ(start.size() - count(now, shared::STATE_DEAD) + simulation.ledger().sunk, start.size());
            ASSERT_TRUE(
                std::ranges::all_of(now.position, [](const glm::vec3& x) { return std::isfinite(x.x + x.y + x.z); }));
        }
        run = simulation.download();
        EXPECT_GT(simulation.ledger().sunk, 50u);
        EXPECT_GT(simulation.deposited(), 50u);
    }
    EXPECT_EQ(seen[0].attributes, seen[1].attributes);
    EXPECT_EQ(seen[0].position, seen[1].position);
    EXPECT_EQ(seen[0].velocity, seen[1].velocity);
}

} // namespace
} // namespace meltpoint
