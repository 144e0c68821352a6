#include "sim/capillarity.h"

#include <utility>

#include "shared/capillarity.h"
#include "spirv/sim/capillarity.comp.h"
#include "spirv/sim/smooth_normal.comp.h"
#include "spirv/sim/surface_normal.comp.h"

namespace meltpoint::sim {

using gpu::read;
using gpu::read_write;
using gpu::write;

Capillarity::Capillarity(const gpu::Context& context, const FluidOptions& options, std::uint32_t particle_count)
    : surface_normal_(context, "surface_normal", sim_surface_normal_comp, fluid_constants(context.info(), options)),
      smooth_normal_(context, "smooth_normal", sim_smooth_normal_comp, fluid_constants(context.info(), options)),
      force_(context, "capillarity", sim_capillarity_comp, fluid_constants(context.info(), options)),
      gradient_(gpu::make_texel_buffer(context, particle_count, "surface gradient")),
      normal_(gpu::make_texel_buffer(context, particle_count, "surface normal")),
      smoothed_(gpu::make_texel_buffer(context, particle_count, "smoothed normal"))
{
}

void Capillarity::record_start(gpu::Commands& commands) const
{
    commands.fill(gradient_, 0);
    commands.fill(normal_, 0);
    commands.fill(smoothed_, 0);
}

void Capillarity::record(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                         const ParticleBuffers& particles, const NeighborGrid& grid)
{
    const gpu::Scope scope(commands, "surface tension");
    record_normals(commands, kernels, params, particles, grid);
    for (std::uint32_t smoothing = 0; smoothing < shared::NORMAL_SMOOTHINGS; ++smoothing) {
        record_smoothing(commands, kernels, params, particles, grid);
    }
    record_forces(commands, kernels, params, particles, grid);
}

void Capillarity::record_normals(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                                 const ParticleBuffers& particles, const NeighborGrid& grid)
{
    commands.dispatch(surface_normal_, kernels.tiles(particles.moving), gpu::NoPush{},
                      {read(params), read(grid.cell_start), read(particles.position), read(particles.position),
                       read(particles.velocity), read(particles.velocity), read(particles.attributes), write(gradient_),
                       write(normal_), read(grid.neighbor_bits)});
}

void Capillarity::record_smoothing(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                                   const ParticleBuffers& particles, const NeighborGrid& grid)
{
    commands.dispatch(smooth_normal_, kernels.tiles(particles.moving), gpu::NoPush{},
                      {read(params), read(grid.cell_start), read(particles.position), read(particles.position),
                       read(normal_), read(normal_), read(particles.attributes), write(smoothed_),
                       read(grid.neighbor_bits)});
    std::swap(normal_, smoothed_);
}

void Capillarity::record_forces(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                                const ParticleBuffers& particles, const NeighborGrid& grid)
{
    commands.dispatch(force_, kernels.tiles(particles.moving), gpu::NoPush{},
                      {read(params), read(grid.cell_start), read(particles.position), read(particles.position),
                       read(particles.velocity), read(particles.velocity), read(particles.interaction),
                       read(particles.interaction), read(normal_), read(normal_), read(gradient_),
                       read(particles.attributes), read_write(particles.acceleration), read(grid.neighbor_bits)});
}

} // namespace meltpoint::sim
