// How fast viscosity stills a vortex.
#include <numbers>

#include "support/fluid_box.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class ViscousDecay : public GpuTest {};

// A vortex that fills a square of side L between walls that let it slip: v = U (sin kx cos ky, -cos kx sin ky),
// k = pi/L, dies as exp(-2 k^2 nu t) (Taylor & Green 1937). It is so slow that particles move a tenth of a spacing
// meanwhile: viscosity alone is at work, on a lattice.
TEST_F(ViscousDecay, HasTheExactRate)
{
    const std::uint32_t side = 20;
    const double viscosity = 100.0;
    const double nu = viscosity / static_cast<double>(test_rest_density);
    const double k = std::numbers::pi / (side * static_cast<double>(test_spacing));
    const double rate = 2.0 * k * k * nu;
    const double speed = 0.1 * static_cast<double>(test_spacing) * rate;
    for (const std::uint32_t kernel : {shared::KERNEL_PAPER, shared::KERNEL_WENDLAND}) {
        const double support_ratio = kernel == shared::KERNEL_PAPER ? 2.0 : 3.0;
        sim::SimulationSettings settings =
            box_settings(kernel, support_ratio, {side, side, 6}, 10.0 * speed, viscosity);
        settings.params.gravity = glm::vec3(0.0f);
        const double support_radius = static_cast<double>(settings.params.support_radius);
        settings.params.dt = static_cast<float>(0.03 * support_radius * support_radius / nu); // half the viscous bound

        ParticleSet set = fluid_in_corner({side, side, 6});
        for (std::size_t i = 0; i < set.size(); ++i) {
            const glm::dvec3 x = k * glm::dvec3(set.position[i]);
            set.velocity[i] = speed * glm::dvec3(std::sin(x.x) * std::cos(x.y), -std::cos(x.x) * std::sin(x.y), 0.0);
        }
        const double start = kinetic_energy(set);
        sim::Simulation simulation(context(), set, settings);
        simulation.advance(steps_for(1.0 / rate, settings));
        const double end = kinetic_energy(simulation.download());
        EXPECT_NEAR(0.5 * std::log(start / end) / simulation.time(), rate, 0.01 * rate) << "kernel " << kernel;
    }
}

} // namespace
} // namespace meltpoint
