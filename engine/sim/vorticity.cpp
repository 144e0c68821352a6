#include "sim/vorticity.h"

#include <utility>

#include "spirv/sim/confinement.comp.h"
#include "spirv/sim/vorticity.comp.h"
#include "spirv/sim/xsph.comp.h"

namespace meltpoint::sim {

using gpu::read;
using gpu::read_write;
using gpu::write;

Vorticity::Vorticity(const gpu::Context& context, const FluidOptions& options, std::uint32_t particle_count)
{
    const auto constants = fluid_constants(context.info(), options);
    if (options.xsph) {
        xsph_.emplace(context, "xsph", sim_xsph_comp, constants);
    }
    if (options.confinement) {
        curl_.emplace(Curl{.kernel = {context, "vorticity", sim_vorticity_comp, constants},
                           .confinement = {context, "confinement", sim_confinement_comp, constants},
                           .vorticity = gpu::make_texel_buffer(context, particle_count, "vorticity")});
    }
}

void Vorticity::record_start(gpu::Commands& commands) const
{
    if (curl_) {
        commands.fill(curl_->vorticity, 0);
    }
}

void Vorticity::record_xsph(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                            ParticleBuffers& particles, NeighborGrid& grid)
{
    if (!xsph_) {
        return;
    }
    const gpu::Scope scope(commands, "xsph");
    commands.dispatch(*xsph_, kernels.tiles(particles.moving), gpu::NoPush{},
                      {read(params), read(grid.cell_start), read(particles.position), read(particles.position),
                       read(particles.velocity), read(particles.velocity), read(particles.interaction),
                       read(particles.interaction), read(particles.attributes), write(grid.sorted_velocity),
                       read(grid.neighbor_bits)});
    std::swap(particles.velocity, grid.sorted_velocity);
}

void Vorticity::record_confinement(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                                   const ParticleBuffers& particles, const NeighborGrid& grid)
{
    if (!curl_) {
        return;
    }
    const gpu::Scope scope(commands, "confinement");
    commands.dispatch(curl_->kernel, kernels.tiles(particles.moving), gpu::NoPush{},
                      {read(params), read(grid.cell_start), read(particles.position), read(particles.position),
                       read(particles.velocity), read(particles.velocity), read(particles.interaction),
                       read(particles.interaction), read(particles.attributes), write(curl_->vorticity),
                       read(grid.neighbor_bits)});
    commands.dispatch(curl_->confinement, kernels.tiles(particles.moving), gpu::NoPush{},
                      {read(params), read(grid.cell_start), read(particles.position), read(particles.position),
                       read(curl_->vorticity), read(curl_->vorticity), read(particles.attributes),
                       read_write(particles.acceleration), read(grid.neighbor_bits)});
}

} // namespace meltpoint::sim
