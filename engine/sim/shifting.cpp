#include "sim/shifting.h"

#include <utility>

#include "spirv/sim/shift.comp.h"

namespace meltpoint::sim {

using gpu::read;
using gpu::write;

Shifting::Shifting(const gpu::Context& context, const FluidOptions& options)
    : shift_(context, "shift", sim_shift_comp, fluid_constants(context.info(), options))
{
}

void Shifting::record(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                      ParticleBuffers& particles, NeighborGrid& grid) const
{
    const gpu::Scope scope(commands, "shift");
    commands.dispatch(shift_, kernels.tiles(particles.moving), gpu::NoPush{},
                      {read(params), read(grid.cell_start), read(particles.position), read(particles.position),
                       read(particles.interaction), read(particles.interaction), read(particles.attributes),
                       write(grid.sorted_position), read(grid.neighbor_bits)});
    std::swap(particles.position, grid.sorted_position);
}

} // namespace meltpoint::sim
