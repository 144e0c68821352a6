// Fluids of different density in one box, in both solvers.
#include <limits>

#include "support/fluid_box.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class Multiphase : public GpuTest {};

constexpr float water = 1000.0f;
constexpr float oil = 800.0f;
constexpr std::uint32_t oil_material = 2;

sim::SimulationSettings two_fluids(std::uint32_t solver, const glm::uvec3& box, double depth)
{
    const double speed = std::sqrt(test_gravity * depth);
    sim::SimulationSettings settings = solver == shared::SOLVER_DFSPH
                                           ? solved_box_settings(2.0, box, speed, 0.05)
                                           : box_settings(shared::KERNEL_WENDLAND, 2.0, box, speed, 0.5);
    settings.params.rest_density[oil_material] = oil;
    settings.params.viscosity[oil_material] *= 4.0f;
    settings.options.mixed_viscosity = true;
    return settings;
}

void make_oil(ParticleSet& set, std::size_t i)
{
    set.attributes[i] = shared::pack_attributes(shared::STATE_FLUID, oil_material);
    set.mass[i] *= oil / water;
}

bool is_oil(const ParticleSet& set, std::size_t i)
{
    return shared::particle_material(set.attributes[i]) == oil_material;
}

// Oil on water stays there: no gap opens between them, none of them mixes, and pressure passes through.
TEST_F(Multiphase, OilRestsOnWater)
{
    constexpr std::uint32_t layers = 7; // of each
    const double d = static_cast<double>(test_spacing);
    for (const std::uint32_t solver : {shared::SOLVER_WCSPH, shared::SOLVER_DFSPH}) {
        SCOPED_TRACE(solver);
        const sim::SimulationSettings settings = two_fluids(solver, {6, 2 * layers + 4, 6}, 2 * layers * d);
        ParticleSet start = fluid_in_corner({6, 2 * layers, 6});
        for (std::size_t i = 0; i < start.size(); ++i) {
            if (start.position[i].y > static_cast<float>(layers) * test_spacing) {
                make_oil(start, i);
            }
        }
        sim::Simulation simulation(context(), start, settings);
        std::vector<double> pressure(start.size(), 0.0);
        ParticleSet set;
        constexpr int samples = 40;
        for (int i = 0; i < 2 * samples; ++i) { // of which the first half settles
            simulation.advance_by(0.01);
            set = simulation.download();
            for (std::size_t k = 0; k < set.size() && i >= samples; ++k) {
                pressure[k] += static_cast<double>(set.pressure[k]) / samples;
            }
        }
        const double weight_energy = 900.0 * 2.0 * layers * 36.0 * d * d * d * test_gravity * 2.0 * layers * d;
        EXPECT_LE(kinetic_energy(set), 1e-3 * weight_energy);
        double highest_water = 0.0;
        double lowest_oil = std::numeric_limits<double>::infinity();
        double error = 0.0;
        double exact_sum = 0.0;
        for (std::size_t i = 0; i < set.size(); ++i) {
            const double y = static_cast<double>(set.position[i].y);
            (is_oil(set, i) ? lowest_oil : highest_water) =
                is_oil(set, i) ? std::min(lowest_oil, y) : std::max(highest_water, y);
            const double top = 2.0 * layers * d;
            const double middle = layers * d;
            const double exact = test_gravity * (static_cast<double>(oil) * (top - std::max(y, middle)) +
                                                 static_cast<double>(water) * std::max(middle - y, 0.0));
            error += std::abs(pressure[i] - exact);
            exact_sum += exact;
        }
        EXPECT_GT(lowest_oil, highest_water);
        EXPECT_NEAR(lowest_oil - highest_water, d, 0.2 * d);
        EXPECT_LE(error, 0.12 * exact_sum);
    }
}

// A block of oil at the bottom of a tank of water rises to its surface, in one piece or many.
TEST_F(Multiphase, OilBelowWaterRises)
{
    for (const std::uint32_t solver : {shared::SOLVER_WCSPH, shared::SOLVER_DFSPH}) {
        SCOPED_TRACE(solver);
        sim::SimulationSettings settings = two_fluids(solver, {10, 14, 10}, 10 * static_cast<double>(test_spacing));
        settings.params.rest_density[oil_material] = 0.5f * water;
        ParticleSet start = fluid_in_corner({10, 10, 10});
        const auto mean_height = [](const ParticleSet& set) {
            double sum = 0.0;
            double count = 0.0;
            for (std::size_t i = 0; i < set.size(); ++i) {
                sum += is_oil(set, i) ? static_cast<double>(set.position[i].y) : 0.0;
                count += is_oil(set, i) ? 1.0 : 0.0;
            }
            return sum / count / static_cast<double>(test_spacing);
        };
        for (std::size_t i = 0; i < start.size(); ++i) {
            const glm::vec3 x = start.position[i] / test_spacing;
            if (x.y > 1.0f && x.y < 5.0f && std::abs(x.x - 5.0f) < 2.0f && std::abs(x.z - 5.0f) < 2.0f) {
                make_oil(start, i);
                start.mass[i] *= 0.5f * water / oil;
            }
        }
        EXPECT_NEAR(mean_height(start), 3.0, 1e-4);
        sim::Simulation simulation(context(), start, settings);
        simulation.advance_by(2.0);
        EXPECT_GE(mean_height(simulation.download()), 7.0);
    }
}

} // namespace
} // namespace meltpoint
