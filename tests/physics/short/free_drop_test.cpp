// Angular momentum of fluid that nothing touches.
#include "support/fluid_box.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class FreeDrop : public GpuTest {};

struct AngularMomentum {
    glm::dvec3 sum{0.0};    ///< kg m^2/s
    double magnitude = 0.0; ///< sum of m |x| |v|
};

AngularMomentum angular_momentum(const ParticleSet& set, const glm::dvec3& center)
{
    AngularMomentum result;
    for (std::size_t i = 0; i < set.size(); ++i) {
        const glm::dvec3 arm = glm::dvec3(set.position[i]) - center;
        const glm::dvec3 momentum = static_cast<double>(set.mass[i]) * glm::dvec3(set.velocity[i]);
        result.sum += glm::cross(arm, momentum);
        result.magnitude += glm::length(arm) * glm::length(momentum);
    }
    return result;
}

// No gravity, no walls, no viscosity: a block whose jittered particles push each other apart.
void expect_conserved(const gpu::Context& context, std::uint32_t kernel, const glm::mat3& velocity_gradient)
{
    sim::SimulationSettings settings = test_settings(kernel);
    settings.params.gravity = glm::vec3(0.0f);
    settings.params.wall_mask = 0;
    set_viscosity(settings.params, 0.0f);
    settings.params.speed_of_sound = 20.0f;
    const glm::vec3 center(0.5f);
    Random random(8);
    ParticleSet start = lattice_state(glm::uvec3(9), center - 4.0f * test_spacing);
    for (std::size_t i = 0; i < start.size(); ++i) {
        start.velocity[i] = velocity_gradient * (start.position[i] - center);
        start.position[i] += 0.5f * test_spacing * (random_vector(random) - 0.5f);
    }
    const std::uint32_t steps = 200;
    sim::Simulation simulation(context, start, settings);
    simulation.advance(steps);
    const ParticleSet end = simulation.download();

    double change_of_speed = 0.0;
    double speed = 0.0;
    for (std::size_t i = 0; i < start.size(); ++i) {
        change_of_speed += static_cast<double>(glm::distance(start.velocity[i], end.velocity[i]));
        speed += static_cast<double>(glm::length(start.velocity[i]));
    }
    const AngularMomentum before = angular_momentum(start, center);
    const AngularMomentum after = angular_momentum(end, center);
    EXPECT_GT(change_of_speed, 0.2 * speed); // forces were at work
    // A position near 0.5 m is rounded by up to 3e-8 m a step, 1.5e-7 of its arm about the center; a particle that
    // flies straight is rounded the same way each time. So 3e-5 in 200 steps if all agreed; of 729 that do not, 1e-6.
    EXPECT_LE(glm::length(after.sum - before.sum), 2e-6 * after.magnitude);
}

TEST_F(FreeDrop, KeepsItsAngularMomentum)
{
    const glm::mat3 spin(glm::vec3(0.0f, 5.0f, -2.0f), glm::vec3(-5.0f, 0.0f, 1.0f), glm::vec3(2.0f, -1.0f, 0.0f));
    const glm::mat3 shear(glm::vec3(0.0f), glm::vec3(8.0f, 0.0f, 0.0f), glm::vec3(0.0f));
    for (const std::uint32_t kernel : {shared::KERNEL_PAPER, shared::KERNEL_WENDLAND}) {
        expect_conserved(context(), kernel, spin);
        expect_conserved(context(), kernel, shear);
    }
}

} // namespace
} // namespace meltpoint
