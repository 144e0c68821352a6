// Heat: enthalpy, temperature and conduction on the device, against the twin and against exact solutions.
#include "sim/heat.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "conformance/device.h"
#include "core/error.h"
#include "core/random.h"
#include "reference/cells.h"
#include "reference/heat.h"
#include "support/fluid_states.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

constexpr double d = static_cast<double>(test_spacing);

/// Water and ice, but for a density that is the same (as that of all test materials).
constexpr shared::HeatMaterial water{.solid_conductivity = 2.2f,
                                     .fluid_conductivity = 0.57f,
                                     .solid_specific_heat = 2100.0f,
                                     .fluid_specific_heat = 4190.0f,
                                     .latent_heat = 334e3f,
                                     .melting_point = 0.0f};
constexpr shared::HeatMaterial wax{.solid_conductivity = 0.25f,
                                   .fluid_conductivity = 0.15f,
                                   .solid_specific_heat = 2900.0f,
                                   .fluid_specific_heat = 2500.0f,
                                   .latent_heat = 210e3f,
                                   .melting_point = 55.0f};
constexpr shared::HeatMaterial iron{.solid_conductivity = 80.0f,
                                    .fluid_conductivity = 30.0f,
                                    .solid_specific_heat = 450.0f,
                                    .fluid_specific_heat = 820.0f,
                                    .latent_heat = 247e3f,
                                    .melting_point = 1538.0f};

/// Fluids of water and wax as both, a plate of iron, and material 3 without any heat.
shared::HeatParams test_heat()
{
    shared::HeatParams heat{};
    heat.of[0] = water;
    heat.of[1] = iron;
    heat.of[2] = wax;
    return heat;
}

/// A device with its particles sorted and with heat. Colliders get their weights, as those of surfaces, or keep them.
struct HeatedDevice {
    conformance::Device device;
    sim::Heat heat;

    HeatedDevice(const gpu::Context& context, const ParticleSet& set, const sim::SimulationSettings& settings,
                 const shared::HeatParams& params, const std::vector<double>& enthalpy, bool weigh = true)
        : device(context, set, settings),
          heat(context, settings.options, device.params, params, set.attributes, enthalpy)
    {
        device.run([&] {
            if (settings.options.still) {
                sim::record_partition(device.commands, device.kernels, device.params_buffer, device.particles,
                                      device.grid);
            } else {
                sim::record_sort(device.commands, device.kernels, device.params_buffer, device.particles, device.grid);
            }
            if (weigh) {
                sim::record_boundary_weight(device.commands, device.kernels, device.params_buffer, device.particles,
                                            device.grid);
            }
        });
    }

    void conduct(double seconds)
    {
        device.run([&] {
            heat.record_conduction(device.commands, device.kernels, device.params_buffer, device.particles, device.grid,
                                   seconds);
        });
    }
};

/// Of bars: layers along x, as many particles wide across, where the borders are periodic.
constexpr std::uint32_t width = 6;
constexpr std::uint32_t across_is_periodic = 0x3cu;
constexpr std::uint32_t fixed_layers = 3; // of a wall

class HeatTest : public GpuTest {
protected:
    /// A box of so many spacings of fluids and solids at rest, walls around it but for axes that are periodic.
    static sim::SimulationSettings settings(std::uint32_t kernel, const glm::uvec3& box, float support_ratio,
                                            std::uint32_t periodic_mask = 0)
    {
        sim::SimulationSettings its = test_settings(kernel);
        its.options.still = true;
        its.params.support_radius = support_ratio * test_spacing;
        its.params.domain_max = test_spacing * glm::vec3(box);
        its.params.wall_mask = 0x3fu & ~periodic_mask;
        its.params.periodic_mask = periodic_mask;
        set_kernel_scales(its.params, kernel, d);
        return its;
    }

    static sim::SimulationSettings bar_settings(std::uint32_t kernel, float support_ratio, std::uint32_t layers)
    {
        return settings(kernel, {fixed_layers + layers, width, width}, support_ratio, across_is_periodic);
    }

    /// Temperatures between -40 and 100 degrees C, a third of what is between solid and fluid.
    static std::vector<double> random_enthalpy(const ParticleSet& set, const shared::HeatParams& heat)
    {
        Random random(11);
        std::vector<double> enthalpy(set.size());
        for (std::size_t i = 0; i < set.size(); ++i) {
            const shared::HeatMaterial& its = heat.of[shared::particle_material(set.attributes[i])];
            const auto temperature = static_cast<float>(-40.0 + 140.0 * random.uniform());
            const double on_plateau = random.uniform() * static_cast<double>(its.latent_heat);
            enthalpy[i] = random.uniform() < 1.0 / 3.0
                              ? on_plateau
                              : static_cast<double>(shared::enthalpy_at(its, temperature)) + 1e-3 * random.uniform();
        }
        return enthalpy;
    }

    /// The largest difference of what one call has changed, over the largest change.
    static double conduction_error(const ParticleSet& set, const sim::SimulationSettings& settings,
                                   const shared::HeatParams& heat, const std::vector<double>& start)
    {
        HeatedDevice its(context(), set, settings, heat, start);
        const double dt = 0.9 * its.heat.longest_substep();
        its.conduct(2.0 * dt);

        const reference::Settings twin_settings = conformance::reference_settings(its.device.params, settings);
        const reference::State twin = reference::from_particle_set(download_unordered(context(), its.device.particles));
        const reference::Neighbors neighbors = reference::find_neighbors(its.device.params, twin.position);
        std::vector<double> enthalpy = start;
        for (int step = 0; step < 2; ++step) {
            reference::conduct(twin_settings, heat, twin, neighbors, enthalpy, dt);
        }
        const std::vector<double> found = its.heat.download_enthalpy();
        double change = 0.0;
        double error = 0.0;
        for (std::size_t i = 0; i < set.size(); ++i) {
            change = std::max(change, std::abs(enthalpy[i] - start[i]));
            error = std::max(error, std::abs(found[i] - enthalpy[i]));
        }
        EXPECT_EQ(its.heat.substeps(2.0 * dt), 2u);
        EXPECT_GT(change, 1e3);
        return error / change;
    }

    static double conduction_error(const ParticleSet& set, const sim::SimulationSettings& settings,
                                   const shared::HeatParams& heat)
    {
        return conduction_error(set, settings, heat, random_enthalpy(set, heat));
    }
};

// --- shared functions ---

TEST(HeatMaterial, TemperatureStaysWhileItMelts)
{
    for (const shared::HeatMaterial& its : {water, wax, iron}) {
        const double tm = static_cast<double>(its.melting_point);
        const double latent = static_cast<double>(its.latent_heat);
        EXPECT_EQ(reference::temperature(its, 0.0), tm);
        EXPECT_EQ(reference::temperature(its, 0.5 * latent), tm);
        EXPECT_EQ(reference::temperature(its, latent), tm);
        EXPECT_NEAR(reference::temperature(its, -static_cast<double>(its.solid_specific_heat)), tm - 1.0, 1e-12);
        EXPECT_NEAR(reference::temperature(its, latent + static_cast<double>(its.fluid_specific_heat)), tm + 1.0,
                    1e-12);
        EXPECT_EQ(reference::conductivity(its, -1.0), static_cast<double>(its.solid_conductivity));
        EXPECT_NEAR(reference::conductivity(its, 0.25 * latent),
                    0.75 * static_cast<double>(its.solid_conductivity) +
                        0.25 * static_cast<double>(its.fluid_conductivity),
                    1e-6);
        EXPECT_EQ(reference::conductivity(its, 2.0 * latent), static_cast<double>(its.fluid_conductivity));
        EXPECT_EQ(shared::enthalpy_at(its, its.melting_point), 0.0f);
        for (double enthalpy = -5e5; enthalpy <= 1e6; enthalpy += 12345.6) {
            const auto large = static_cast<float>(enthalpy);
            const glm::vec2 parts(large, static_cast<float>(enthalpy - static_cast<double>(large)));
            const float temperature = shared::temperature(its, parts);
            EXPECT_NEAR(static_cast<double>(temperature), reference::temperature(its, enthalpy), 2e-4);
            EXPECT_NEAR(static_cast<double>(shared::conductivity(its, large)), reference::conductivity(its, enthalpy),
                        1e-5);
            if (enthalpy < 0.0 || enthalpy > latent) {
                EXPECT_NEAR(static_cast<double>(shared::enthalpy_at(its, temperature)), enthalpy, 0.5);
            }
        }
    }
}

TEST(HeatMaterial, BothPartsOfAnEnthalpyCount)
{
    const double ulp = 0.03125; // of the latent heat
    EXPECT_NEAR(static_cast<double>(shared::temperature(water, {334e3f, 0.01f})), 0.01 / 4190.0, 1e-12);
    EXPECT_EQ(shared::temperature(water, {334e3f, -0.01f}), 0.0f);
    EXPECT_NEAR(static_cast<double>(shared::temperature(water, {334e3f + 0.03125f, -0.01f})), (ulp - 0.01) / 4190.0,
                1e-12);
}

TEST(HeatMaterial, MayMeltWithoutLatentHeat)
{
    shared::HeatMaterial its = water;
    its.latent_heat = 0.0f;
    EXPECT_EQ(shared::conductivity(its, 0.0f), its.solid_conductivity);
    EXPECT_EQ(shared::conductivity(its, 1.0f), its.fluid_conductivity);
    EXPECT_EQ(reference::conductivity(its, 0.0), static_cast<double>(its.solid_conductivity));
    EXPECT_EQ(reference::conductivity(its, 1.0), static_cast<double>(its.fluid_conductivity));
    EXPECT_NEAR(static_cast<double>(shared::temperature(its, {4190.0f, 0.0f})), 1.0, 1e-6);
}

TEST(HeatMaterial, PairsHaveTheHarmonicMean)
{
    EXPECT_EQ(shared::pair_conductivity(2.0f, 2.0f), 4.0f);
    EXPECT_EQ(shared::pair_conductivity(1.0f, 3.0f), 3.0f);
    EXPECT_EQ(shared::pair_conductivity(0.0f, 3.0f), 0.0f);
    EXPECT_EQ(shared::pair_conductivity(0.0f, 0.0f), 0.0f);
}

// --- against the twin ---

/// A solid beside fluid of another material beside fluid of the first, over a warm plate; with spray, dust, the dead,
/// and a solid without heat.
ParticleSet everything()
{
    Random random(3);
    ParticleSet set = lattice_state({20, 8, 20}, glm::vec3(0.5f * test_spacing));
    for (std::size_t i = 0; i < set.size(); ++i) {
        const glm::vec3& x = set.position[i];
        const bool solid = x.x < 0.3f;
        set.attributes[i] = solid        ? shared::pack_attributes(shared::STATE_SOLID, x.z < 0.2f ? 3 : 0)
                            : x.z < 0.5f ? shared::pack_attributes(shared::STATE_FLUID, 0)
                                         : shared::pack_attributes(shared::STATE_FLUID, 2);
        set.position[i] += solid ? glm::vec3(0.0f) : 0.3f * test_spacing * (random_vector(random) - 0.5f);
        set.mass[i] *= i % 3 == 0 ? 1.1f : 1.0f;
        set.weight[i] = solid ? 0.8f + 0.1f * static_cast<float>(i % 5) : 1.0f; // of any density
    }
    for (int i = 0; i < 100; ++i) {
        add_particle(set, glm::mix(glm::vec3(0.01f), glm::vec3(0.99f), random_vector(random)));
        set.attributes.back() = shared::pack_attributes(i % 3 == 0   ? shared::STATE_DUST
                                                        : i % 3 == 1 ? shared::STATE_DEAD
                                                                     : shared::STATE_FLUID,
                                                        2);
    }
    add_particle(set, set.position[17]); // as near as can be
    add_plate(set, 1.0f, 0.42f, 0.75f * test_spacing, 0.3f, 3);
    for (float& mass : set.mass) {
        mass = std::abs(mass);
    }
    return set;
}

TEST_F(HeatTest, ConductsAsItsTwin)
{
    for (const std::uint32_t kernel : {shared::KERNEL_PAPER, shared::KERNEL_WENDLAND}) {
        for (const std::uint32_t periodic : {0u, 0x3u, 0x33u}) {
            for (const bool still : {true, false}) {
                SCOPED_TRACE(testing::Message()
                             << "kernel " << kernel << ", periodic " << periodic << ", still " << still);
                sim::SimulationSettings its = settings(kernel, glm::uvec3(20), 2.6f, periodic);
                its.options.still = still;
                EXPECT_LT(conduction_error(everything(), its, test_heat()), 2e-6);
            }
        }
    }
}

TEST_F(HeatTest, ConductsInThePlaneAsItsTwin)
{
    for (const std::uint32_t kernel : {shared::KERNEL_PAPER, shared::KERNEL_WENDLAND}) {
        SCOPED_TRACE(kernel);
        sim::SimulationSettings its = plane_settings(kernel);
        its.options.still = true;
        ParticleSet set = plane_splash(4);
        for (std::size_t i = 0; i < set.size(); ++i) {
            if (!shared::is_boundary(set.attributes[i]) && set.position[i].x < 0.4f) {
                set.attributes[i] = shared::pack_attributes(shared::STATE_SOLID, 2);
            }
        }
        EXPECT_LT(conduction_error(set, its, test_heat()), 2e-6);
    }
}

TEST_F(HeatTest, AFewWarmOnesAmidMeltingIceConductAsTheirTwin)
{
    // More than 32 cells along x, of which few hold heat: wherever it flows somebody must look.
    const ParticleSet set = lattice_state({60, 7, 6}, glm::vec3(0.5f * test_spacing));
    for (const std::uint64_t seed : {1u, 2u, 3u, 4u}) {
        Random random(seed);
        std::vector<double> start(set.size(), 1e5);
        for (int i = 0; i < 9; ++i) {
            start[static_cast<std::size_t>(random.uniform() * static_cast<double>(set.size()))] = i < 4 ? 5e5 : -5e4;
        }
        for (const std::uint32_t tile : {1u, 4u, 8u}) {
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", tile " << tile);
            sim::SimulationSettings its = settings(shared::KERNEL_WENDLAND, {60, 7, 6}, 2.6f);
            its.options.tile = tile;
            EXPECT_LT(conduction_error(set, its, test_heat(), start), 2e-6);
        }
    }
}

TEST_F(HeatTest, TilesDoNotChangeAnything)
{
    const ParticleSet set = everything();
    const std::vector<double> start = random_enthalpy(set, test_heat());
    std::vector<double> first;
    for (const std::uint32_t tile : {1u, 4u, 8u}) {
        sim::SimulationSettings its = settings(shared::KERNEL_WENDLAND, glm::uvec3(20), 2.6f);
        its.options.tile = tile;
        HeatedDevice heated(context(), set, its, test_heat(), start);
        heated.conduct(3.0 * heated.heat.longest_substep());
        const std::vector<double> found = heated.heat.download_enthalpy();
        first = first.empty() ? found : first;
        for (std::size_t i = 0; i < set.size(); ++i) {
            EXPECT_NEAR(found[i], first[i], 0.1) << "tile " << tile << ", particle " << i;
        }
    }
}

// --- bars ---

/// A bar of solid of material 0 behind `fixed` layers of a collider of material 1; the layers' numbers are those of x.
ParticleSet bar(std::uint32_t fixed, std::uint32_t layers)
{
    ParticleSet set = lattice_state({fixed + layers, width, width}, glm::vec3(0.5f * test_spacing));
    for (std::size_t i = 0; i < set.size(); ++i) {
        const bool is_fixed = i % (fixed + layers) < fixed;
        set.attributes[i] = is_fixed ? shared::pack_attributes(shared::STATE_COLLIDER, 1)
                                     : shared::pack_attributes(shared::STATE_SOLID, 0);
        set.mass[i] = is_fixed ? 0.0f : set.mass[i];
    }
    return set;
}

/// Of the layers behind the fixed ones, the mean of a value by id.
std::vector<double> layer_means(const std::vector<double>& values, std::uint32_t fixed, std::uint32_t layers)
{
    std::vector<double> means(layers, 0.0);
    for (std::size_t i = 0; i < values.size(); ++i) {
        const std::size_t layer = i % (fixed + layers);
        if (layer >= fixed) {
            means[layer - fixed] += values[i] / (width * width);
        }
    }
    return means;
}

/// Diffusivity 1e-6 m^2/s in both phases, where test_rest_density is 1000 kg/m^3.
constexpr double diffusivity = 1e-6;
constexpr shared::HeatMaterial plain{.solid_conductivity = 2.0f,
                                     .fluid_conductivity = 2.0f,
                                     .solid_specific_heat = 2000.0f,
                                     .fluid_specific_heat = 2000.0f,
                                     .latent_heat = 200e3f,
                                     .melting_point = 0.0f};

/// Heats until `seconds`, in calls that no one of is too long.
void conduct_for(HeatedDevice& heated, double seconds)
{
    const double longest = 200.0 * heated.heat.longest_substep();
    for (double left = seconds; left > 0.0; left -= longest) {
        heated.conduct(std::min(left, longest));
    }
}

/// The bar's material is `plain`; the wall's likewise, but for its conductivity, so many times that of the bar.
shared::HeatParams wall_and_bar(float conductivity)
{
    shared::HeatParams heat{};
    heat.of[0] = heat.of[1] = plain;
    heat.of[1].solid_conductivity *= conductivity;
    heat.of[1].fluid_conductivity *= conductivity;
    return heat;
}

constexpr std::pair<std::uint32_t, float> kernels_and_ratios[] = {
    {shared::KERNEL_PAPER, 2.0f}, {shared::KERNEL_WENDLAND, 2.6f}, {shared::KERNEL_WENDLAND, 3.0f}};

// Two halves of one bar, of two temperatures: T = T_contact + (T_side - T_contact) erf(|x| / (2 sqrt(a t))), with
// T_contact = (b_1 T_1 + b_2 T_2) / (b_1 + b_2), b = sqrt(k rho c) (Carslaw & Jaeger, Conduction of Heat in
// Solids, 2.16).
TEST_F(HeatTest, TwoHalvesOfABarMixAsTheErrorFunction)
{
    for (const auto& [kernel, ratio] : kernels_and_ratios) {
        for (const auto& [contrast, volume] : {std::pair{1.0f, 1.0f}, {5.0f, 1.0f}, {1.0f, 1000.0f / 917.0f}}) {
            SCOPED_TRACE(testing::Message() << "kernel " << kernel << ", H/d " << ratio << ", contrast " << contrast
                                            << ", volume " << volume << " of that as a fluid");
            constexpr std::uint32_t layers = 80;
            shared::HeatParams heat{};
            heat.of[0] = heat.of[2] = plain;
            heat.of[2].solid_conductivity *= contrast;
            ParticleSet set = bar(0, layers);
            std::vector<double> enthalpy(set.size());
            const double cold = -50.0;
            const double warm = -10.0;
            for (std::size_t i = 0; i < set.size(); ++i) {
                const bool left = i % layers < layers / 2;
                set.attributes[i] = shared::pack_attributes(shared::STATE_SOLID, left ? 0 : 2);
                enthalpy[i] = static_cast<double>(plain.solid_specific_heat) * (left ? warm : cold);
                set.position[i] *= std::cbrt(volume);
                set.weight[i] = volume;
            }
            sim::SimulationSettings its = settings(kernel, {layers, width, width}, ratio, across_is_periodic);
            its.params.domain_max *= std::cbrt(volume);
            HeatedDevice heated(context(), set, its, heat, enthalpy);
            const double seconds = std::pow(6.0 * d, 2) / (4.0 * diffusivity);
            conduct_for(heated, seconds);
            const std::vector<double> found = layer_means(heated.heat.download_enthalpy(), 0, layers);
            const double b = std::sqrt(static_cast<double>(contrast));
            const double contact = (warm + b * cold) / (1.0 + b);
            double error = 0.0;
            for (std::uint32_t layer = 0; layer < layers; ++layer) {
                const double x = (layer + 0.5 - 0.5 * layers) * d * std::cbrt(static_cast<double>(volume));
                const double its_diffusivity = diffusivity * static_cast<double>(x < 0.0 ? volume : contrast * volume);
                const double far = x < 0.0 ? warm : cold;
                const double exact =
                    contact + (far - contact) * std::erf(std::abs(x) / (2.0 * std::sqrt(its_diffusivity * seconds)));
                const double temperature = found[layer] / static_cast<double>(plain.solid_specific_heat);
                error = std::max(error, std::abs(temperature - exact) / (warm - cold));
            }
            EXPECT_LT(error, 0.01);
        }
    }
}

// A wall that conducts far better than the bar holds its temperature where its cells end: T = T_w erfc(x / (2 sqrt(a
// t))).
TEST_F(HeatTest, AWarmWallWarmsABarAsTheErrorFunction)
{
    for (const auto& [kernel, ratio] : kernels_and_ratios) {
        SCOPED_TRACE(testing::Message() << "kernel " << kernel << ", H/d " << ratio);
        constexpr std::uint32_t layers = 30;
        const ParticleSet set = bar(fixed_layers, layers);
        std::vector<double> enthalpy(set.size());
        const double far = -50.0;
        const double wall = -10.0;
        for (std::size_t i = 0; i < set.size(); ++i) {
            const bool fixed = shared::is_still(set.attributes[i]) && set.mass[i] == 0.0f;
            enthalpy[i] = static_cast<double>(plain.solid_specific_heat) * (fixed ? wall : far);
        }
        HeatedDevice heated(context(), set, bar_settings(kernel, ratio, layers), wall_and_bar(1e4f), enthalpy, false);
        const double seconds = std::pow(10.0 * d, 2) / (4.0 * diffusivity);
        conduct_for(heated, seconds);
        const std::vector<double> found = layer_means(heated.heat.download_enthalpy(), fixed_layers, layers);
        double error = 0.0;
        for (std::uint32_t layer = 0; layer < layers; ++layer) {
            const double x = (layer + 0.5) * d;
            const double exact = wall + (far - wall) * std::erf(x / (2.0 * std::sqrt(diffusivity * seconds)));
            const double temperature = found[layer] / static_cast<double>(plain.solid_specific_heat);
            error = std::max(error, std::abs(temperature - exact) / (wall - far));
        }
        EXPECT_LT(error, 0.01);
    }
}

/// lambda of Stefan's problem, lambda exp(lambda^2) erf(lambda) = Ste / sqrt(pi) (Neumann; Carslaw & Jaeger 11.2).
double stefan_lambda(double stefan_number)
{
    double low = 0.0;
    double high = 2.0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        const double found = middle * std::exp(middle * middle) * std::erf(middle) * std::sqrt(std::numbers::pi);
        (found < stefan_number ? low : high) = middle;
    }
    return low;
}

// A solid at its melting point melts from a warm wall on: the front is 2 lambda sqrt(a t) off the plane where the
// wall's temperature is held. That of a wall that conducts much better than the bar is where its cells end; that of one
// that conducts as the bar does, the centers of its last layer, half a spacing farther off the bar.
TEST_F(HeatTest, ASolidMeltsAsStefanFound)
{
    EXPECT_NEAR(stefan_lambda(0.1), 0.22002, 1e-5);
    EXPECT_NEAR(stefan_lambda(0.5), 0.46479, 1e-5);
    EXPECT_NEAR(stefan_lambda(1.0), 0.62006, 1e-5);
    constexpr std::uint32_t layers = 16;
    for (const auto& [kernel, ratio] : kernels_and_ratios) {
        for (const float wall_conductivity : {1.0f, 1e4f}) {
            if (wall_conductivity == 1.0f && ratio != 3.0f) {
                continue; // once will do
            }
            for (const double stefan_number : {0.1, 0.5, 1.0}) {
                SCOPED_TRACE(testing::Message() << "kernel " << kernel << ", H/d " << ratio << ", wall "
                                                << wall_conductivity << ", Ste " << stefan_number);
                const ParticleSet set = bar(fixed_layers, layers);
                const shared::HeatParams heat = wall_and_bar(wall_conductivity);
                const double latent = static_cast<double>(plain.latent_heat);
                const auto wall_temperature =
                    static_cast<float>(stefan_number * latent / static_cast<double>(plain.fluid_specific_heat));
                std::vector<double> enthalpy(set.size(), 0.0);
                for (std::size_t i = 0; i < set.size(); ++i) {
                    const bool fixed = i % (fixed_layers + layers) < fixed_layers;
                    enthalpy[i] = fixed ? static_cast<double>(shared::enthalpy_at(heat.of[1], wall_temperature)) : 0.0;
                }
                HeatedDevice heated(context(), set, bar_settings(kernel, ratio, layers), heat, enthalpy, false);
                const double lambda = stefan_lambda(stefan_number);
                const double off_wall = wall_conductivity > 1.0f ? 0.0 : 0.5 * d;
                double seconds = 0.0;
                for (const double melted : {10.0, 12.5}) {
                    const double until = std::pow((melted * d + off_wall) / (2.0 * lambda), 2) / diffusivity;
                    conduct_for(heated, until - seconds);
                    seconds = until;
                    double front = off_wall;
                    for (const double each : layer_means(heated.heat.download_enthalpy(), fixed_layers, layers)) {
                        front += std::min(each / latent, 1.0) * d;
                    }
                    const double exact = 2.0 * lambda * std::sqrt(diffusivity * seconds);
                    EXPECT_NEAR(front / exact, 1.0, 0.02) << melted << " layers";
                }
            }
        }
    }
}

// --- what must not be lost ---

/// Random temperatures and phases of a jittered block that fills its box: no heat leaves it.
TEST_F(HeatTest, AnInsulatedBlockKeepsItsHeat)
{
    for (const bool melting : {false, true}) {
        SCOPED_TRACE(melting);
        sim::SimulationSettings its = settings(shared::KERNEL_WENDLAND, glm::uvec3(10), 2.6f);
        ParticleSet set = lattice_state(glm::uvec3(10), glm::vec3(0.5f * test_spacing));
        Random random(6);
        for (std::size_t i = 0; i < set.size(); ++i) {
            const bool solid = i % 10 < 5;
            set.attributes[i] = solid ? shared::pack_attributes(shared::STATE_SOLID, 0)
                                      : shared::pack_attributes(shared::STATE_FLUID, i % 2 == 0 ? 0 : 2);
            set.position[i] += 0.3f * test_spacing * (random_vector(random) - 0.5f);
        }
        std::vector<double> start = random_enthalpy(set, test_heat());
        if (!melting) { // all in one phase
            std::ranges::transform(start, start.begin(), [](double each) { return -std::abs(each) - 1e3; });
        }
        HeatedDevice heated(context(), set, its, test_heat(), start);
        const reference::State state = reference::from_particle_set(set);
        std::vector<double> sizes(start.size());
        std::ranges::transform(start, sizes.begin(), [](double each) { return std::abs(each); });
        const double before = reference::heat_content(state, start);
        for (int call = 0; call < 20; ++call) {
            heated.conduct(100.0 * heated.heat.longest_substep());
        }
        const std::vector<double> found = heated.heat.download_enthalpy();
        const double drift =
            std::abs(reference::heat_content(state, found) - before) / reference::heat_content(state, sizes);
        EXPECT_LT(drift, 1e-5);
        double change = 0.0;
        for (std::size_t i = 0; i < start.size(); ++i) {
            change += static_cast<double>(set.mass[i]) * std::abs(found[i] - start[i]);
        }
        EXPECT_GT(change / reference::heat_content(state, sizes), 0.1); // much has flowed
    }
}

TEST_F(HeatTest, EnthalpyComesBackAsItWasGiven)
{
    const ParticleSet set = lattice_state(glm::uvec3(4), glm::vec3(0.2f));
    std::vector<double> start(set.size());
    for (std::size_t i = 0; i < set.size(); ++i) {
        start[i] = 334e3 + 1.234567e-3 * static_cast<double>(i);
    }
    HeatedDevice heated(context(), set, settings(shared::KERNEL_WENDLAND, glm::uvec3(20), 2.6f), test_heat(), start);
    heated.conduct(0.0);
    const std::vector<double> found = heated.heat.download_enthalpy();
    for (std::size_t i = 0; i < set.size(); ++i) {
        EXPECT_NEAR(found[i], start[i], 1e-8);
    }
}

// A step may bring less than the ulp of an enthalpy, 0.03 J/kg where it has nearly melted.
TEST_F(HeatTest, NothingIsTooLittleToCount)
{
    const sim::SimulationSettings its = settings(shared::KERNEL_WENDLAND, glm::uvec3(8), 2.6f);
    ParticleSet set = lattice_state(glm::uvec3(8), glm::vec3(0.5f * test_spacing));
    shared::HeatParams heat{};
    heat.of[0] = water;
    std::vector<double> start(set.size());
    for (std::size_t i = 0; i < set.size(); ++i) { // all about to have melted, but every other layer is warmer
        start[i] = i % 2 == 0 ? 330e3 : static_cast<double>(shared::enthalpy_at(water, 10.0f));
    }
    HeatedDevice heated(context(), set, its, heat, start);
    const reference::Settings twin_settings = conformance::reference_settings(heated.device.params, its);
    const reference::State twin = reference::from_particle_set(set);
    const reference::Neighbors neighbors = reference::find_neighbors(heated.device.params, twin.position);
    std::vector<double> once = start;
    const double unit = 1e-6 * heated.heat.longest_substep();
    reference::conduct(twin_settings, heat, twin, neighbors, once, unit);
    const double dt = 2e-3 * unit / std::abs(once[0] - start[0]); // in which an enthalpy changes by about 2e-3 J/kg
    constexpr int steps = 2000;
    std::vector<float> alone(start.begin(), start.end());
    std::vector<double> change(start.size());
    for (std::size_t i = 0; i < start.size(); ++i) {
        change[i] = (once[i] - start[i]) * dt / unit;
    }
    for (int step = 0; step < steps; ++step) {
        heated.conduct(dt);
        for (std::size_t i = 0; i < start.size(); ++i) {
            alone[i] += static_cast<float>(change[i]);
        }
    }
    const std::vector<double> found = heated.heat.download_enthalpy();
    for (std::size_t i = 0; i < start.size(); ++i) {
        EXPECT_NEAR((found[i] - start[i]) / (steps * change[i]), 1.0, 1e-3) << "particle " << i;
        EXPECT_GT(std::abs(change[i]), 1e-3);
        EXPECT_EQ(alone[i], static_cast<float>(start[i])); // a float would have stayed where it was
    }
}

// --- steps ---

TEST_F(HeatTest, TheLongestStepIsThatOfTheFastestMaterialButForColliders)
{
    const sim::SimulationSettings its = settings(shared::KERNEL_WENDLAND, glm::uvec3(8), 2.6f);
    ParticleSet set = lattice_state(glm::uvec3(2), glm::vec3(0.2f));
    shared::HeatParams heat = test_heat();
    const auto longest = [&] {
        const std::vector<double> enthalpy(set.size(), 0.0);
        return sim::Heat(context(), its.options, sim::complete_params(its.params, set.size()), heat, set.attributes,
                         enthalpy)
            .longest_substep();
    };
    const double eigenvalue =
        largest_conduction_eigenvalue(shared::KERNEL_WENDLAND, static_cast<double>(its.params.support_radius), d);
    const double ice = 2.2 / (1000.0 * 2100.0);
    EXPECT_NEAR(longest() * ice * eigenvalue, 1.0, 1e-5);
    add_boundary_particle(set, glm::vec3(0.3f)); // of iron: ice amid it conducts as the harmonic mean
    EXPECT_NEAR(longest() * ice * eigenvalue * 2.0 * 80.0 / (80.0 + 2.2), 1.0, 1e-5);
    set.attributes.back() = shared::pack_attributes(shared::STATE_SOLID, 1);
    EXPECT_NEAR(longest() * 80.0 / (1000.0 * 450.0) * eigenvalue, 1.0, 1e-5);
    heat = {};
    EXPECT_EQ(longest(), std::numeric_limits<double>::infinity());
    heat.of[0].solid_conductivity = 1.0f; // and nothing else
    EXPECT_THROW((void)longest(), Error);
    heat.of[0] = water;
    heat.of[0].latent_heat = -1.0f;
    EXPECT_THROW((void)longest(), Error);
}

TEST_F(HeatTest, StepsAreCountedAndLimited)
{
    const sim::SimulationSettings its = settings(shared::KERNEL_WENDLAND, glm::uvec3(8), 2.6f);
    const ParticleSet set = lattice_state(glm::uvec3(2), glm::vec3(0.2f));
    const sim::Heat heat(context(), its.options, sim::complete_params(its.params, set.size()), test_heat(),
                         set.attributes, std::vector<double>(set.size(), 0.0));
    const double longest = heat.longest_substep();
    EXPECT_EQ(heat.substeps(0.0), 0u);
    EXPECT_EQ(heat.substeps(0.99 * longest), 1u);
    EXPECT_EQ(heat.substeps(1.01 * longest), 2u);
    EXPECT_EQ(heat.substeps(255.5 * longest), sim::Heat::max_substeps);
    EXPECT_THROW((void)heat.substeps(256.5 * longest), Error);
    EXPECT_THROW((void)heat.substeps(std::numeric_limits<double>::quiet_NaN()), Error);
}

// Explicit steps that are too long blow up. These keep between the temperatures there are, however unevenly fluid lies,
// and where a particle is alone among others that conduct a hundred times better.
TEST_F(HeatTest, NoTemperatureLeavesTheRangeThereIs)
{
    for (const std::uint32_t kernel : {shared::KERNEL_PAPER, shared::KERNEL_WENDLAND}) {
        SCOPED_TRACE(kernel);
        const sim::SimulationSettings its = settings(kernel, glm::uvec3(8), 2.6f);
        shared::HeatParams heat{};
        heat.of[0] = heat.of[2] = plain;
        heat.of[0].solid_conductivity *= 100.0f; // but half the diffusivity
        heat.of[0].solid_specific_heat *= 200.0f;
        ParticleSet set = lattice_state(glm::uvec3(8), glm::vec3(0.5f * test_spacing));
        Random random(9);
        std::vector<double> enthalpy(set.size());
        for (std::size_t i = 0; i < set.size(); ++i) {
            const std::uint32_t material = i % 50 == 0 ? 2 : 0;
            set.position[i] += 0.5f * test_spacing * (random_vector(random) - 0.5f);
            set.attributes[i] = shared::pack_attributes(shared::STATE_FLUID, material);
            enthalpy[i] = -50.0 * random.uniform() * static_cast<double>(heat.of[material].solid_specific_heat);
        }
        for (std::size_t i = 0; i < 8; ++i) { // pairs that have met
            set.position[60 * i] = set.position[60 * i + 1] + glm::vec3(1e-5f, 0.0f, 0.0f);
        }
        HeatedDevice heated(context(), set, its, heat, enthalpy);
        double widest = 50.0;
        for (int call = 0; call < 30; ++call) {
            heated.conduct(5.0 * heated.heat.longest_substep());
            std::vector<double> found = heated.heat.download_enthalpy();
            for (std::size_t i = 0; i < set.size(); ++i) {
                found[i] = reference::temperature(heat.of[shared::particle_material(set.attributes[i])], found[i]);
            }
            const auto [low, high] = std::ranges::minmax(found);
            EXPECT_GE(low, -50.0);
            EXPECT_LE(high, 0.0);
            EXPECT_LT(high - low, widest);
            widest = high - low;
        }
        EXPECT_LT(widest, 10.0);
    }
}

} // namespace
} // namespace meltpoint
