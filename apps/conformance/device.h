#pragma once

#include "gpu/transfer.h"
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
    gpu::Commands commands;

    Device(const gpu::Context& device_context, const ParticleSet& set, const sim::SimulationSettings& settings)
        : context(device_context), params(sim::complete_params(settings.params, set.size())),
          kernels(context, settings.options), particles(make_particle_buffers(context, params.particle_count)),
          grid(context, params.particle_count, params.grid_size),
          params_buffer(gpu::make_buffer<shared::SphParams>(context, 1, "params")),
          status(gpu::make_buffer<shared::Status>(context, 1, "status")), commands(context)
    {
        upload(context, set, particles);
        gpu::upload<shared::SphParams>(context, params_buffer, {&params, 1});
        run([&] { commands.fill(status, shared::NO_STEP); });
    }

    template <class Record>
    void run(const Record& record)
    {
        commands.begin();
        record();
        commands.submit();
        commands.wait();
    }
};

} // namespace meltpoint::conformance
