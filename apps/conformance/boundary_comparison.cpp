#include "conformance/boundary_comparison.h"

#include "conformance/relative_error.h"
#include "core/random.h"
#include "reference/boundary_force.h"

namespace meltpoint::conformance {

namespace {

/// The impulses of both solves in the units of the device, and their sum in those of the twin.
struct Impulses {
    std::vector<glm::vec2> on_device;
    std::vector<double> together; ///< N s m^4
};

Impulses make_impulses(const reference::Settings& settings, const reference::State& state)
{
    Random random(13);
    Impulses impulses{std::vector<glm::vec2>(state.size(), glm::vec2(0.0f)), std::vector<double>(state.size(), 0.0)};
    const double dt = static_cast<double>(settings.params.dt);
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (!reference::is_boundary(state, i)) {
            const glm::vec2 each(random.uniform(), static_cast<double>(settings.params.dt) * random.uniform());
            impulses.on_device[i] = each;
            impulses.together[i] = (static_cast<double>(each[shared::SOLVE_DIVERGENCE]) +
                                    static_cast<double>(each[shared::SOLVE_DENSITY]) / dt) /
                                   static_cast<double>(settings.params.gradient_scale);
        }
    }
    return impulses;
}

} // namespace

std::vector<PassError> compare_boundary_forces(Device& device, const sim::FluidOptions& options,
                                               const reference::Settings& settings,
                                               const reference::Neighbors& neighbors)
{
    const reference::State state =
        reference::from_particle_set(download_unordered(device.context, device.particles)); // as the passes see it
    sim::BoundaryForces forces(device.context, options, download(device.context, device.particles).attributes);
    const double dt = static_cast<double>(device.params.dt);
    const auto reactions = [&](const auto& record) {
        device.run([&] {
            forces.record_reset(device.commands);
            record();
        });
        return gpu::download<shared::Reaction>(device.context, forces.reactions(), forces.count());
    };

    const auto of_forces = reactions([&] { forces.record_forces(device.commands, device.fluid()); });
    const std::vector<double> pressure = settings.solver == shared::SOLVER_WCSPH
                                             ? reference::pressure_terms(state)
                                             : std::vector<double>(state.size(), 0.0);
    const Impulses impulses = make_impulses(settings, state);
    const gpu::Buffer warm_start = gpu::make_buffer<glm::vec2>(device.context, state.size(), "warm start");
    gpu::upload<glm::vec2>(device.context, warm_start, impulses.on_device);
    const auto of_impulses = reactions([&] { forces.record_impulses(device.commands, device.fluid(), warm_start); });

    RelativeError push;
    RelativeError friction;
    RelativeError impulse;
    for (std::size_t b = 0; b < state.size(); ++b) {
        if (!reference::is_boundary(state, b)) {
            continue;
        }
        const std::size_t slot = state.id[b] - forces.first_id();
        const auto add = [](RelativeError& error, const glm::vec3& found, reference::VectorSum expected, double unit) {
            error.add(found, unit * expected.value, unit * expected.magnitude);
        };
        add(push, of_forces[slot].pressure, push_on_boundary(settings, state, neighbors, pressure, b), dt);
        add(friction, of_forces[slot].friction, friction_on_boundary(settings, state, neighbors, b), dt);
        add(impulse, of_impulses[slot].pressure, push_on_boundary(settings, state, neighbors, impulses.together, b),
            1.0);
    }
    return {{"boundary force: pressure", push.value(), pass_bound},
            {"boundary force: friction", friction.value(), pass_bound},
            {"boundary impulse", impulse.value(), pass_bound}};
}

} // namespace meltpoint::conformance
