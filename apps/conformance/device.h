#pragma once

#include "gpu/transfer.h"
#include "reference/state.h"
#include "sim/simulation.h"
#include "sim/wcsph.h"

namespace meltpoint::conformance {

/// The passes on the device one at a time, with the host looking on in between.
struct Device {
    const gpu::Context& context;
    shared::SphParams params;
    sim::FluidKernels kernels;
    ParticleBuffers particles;
    sim::NeighborGrid grid;
    gpu::Buffer params_buffer;
    gpu::Buffer status;
    sim::TimeControl time;
    sim::Vorticity vorticity;
    gpu::Commands commands;

    Device(const gpu::Context& device_context, const ParticleSet& set, const sim::SimulationSettings& settings)
        : context(device_context), params(sim::complete_params(settings.params, settings.options, set)),
          kernels(context, settings.options), particles(make_particle_buffers(context, params.pool_count)),
          grid(context, params.pool_count, params.grid_size, settings.options.still),
          params_buffer(gpu::make_buffer<shared::SphParams>(context, 1, "params")),
          status(gpu::make_buffer<shared::Status>(context, 1, "status")), time(context, params),
          vorticity(context, settings.options, params.pool_count), commands(context)
    {
        particles.moving = params.moving_count;
        upload(context, set, particles);
        gpu::upload<shared::SphParams>(context, params_buffer, {&params, 1});
        run([&] { commands.fill(status, shared::NO_STEP); });
    }

    [[nodiscard]] sim::Fluid fluid() { return {kernels, params_buffer, particles, grid, status, time, vorticity}; }

    template <class Record>
    void run(const Record& record)
    {
        commands.begin();
        record();
        commands.submit();
        commands.wait();
    }
};

/// What the twins of the passes read besides the particles.
[[nodiscard]] inline reference::Settings reference_settings(const shared::SphParams& params,
                                                            const sim::SimulationSettings& settings)
{
    return {.kernel = settings.options.kernel,
            .params = params,
            .solver = settings.options.solver,
            .implicit_viscosity = settings.options.implicit_viscosity,
            .dimensions = settings.options.dimensions};
}

} // namespace meltpoint::conformance
