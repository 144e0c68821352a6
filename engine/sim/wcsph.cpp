#include "sim/wcsph.h"

#include <utility>

#include "sim/implicit_viscosity.h"

namespace meltpoint::sim {

using gpu::read;
using gpu::read_write;
using gpu::write;

void record_kick_drift(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                       const ParticleBuffers& particles, const gpu::Buffer& status, std::uint32_t step)
{
    const gpu::Scope scope(commands, "kick and drift");
    commands.dispatch(kernels.kick_drift, particles.moving, step,
                      {read(params), read(particles.id), read(particles.acceleration), read(particles.acceleration),
                       read_write(particles.attributes), read_write(particles.position), read(particles.position),
                       read_write(particles.velocity), read(particles.velocity), read_write(status)});
}

void record_boundary_weight(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                            ParticleBuffers& particles, NeighborGrid& grid)
{
    const gpu::Scope scope(commands, "boundary weight");
    commands.dispatch(kernels.boundary_weight, kernels.tiles(particles.count), gpu::NoPush{},
                      {read(params), read(grid.cell_start), read(particles.position), read(particles.position),
                       read(particles.attributes), write(grid.sorted_position)});
    std::swap(particles.position, grid.sorted_position);
}

void record_density(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                    const ParticleBuffers& particles, const NeighborGrid& grid)
{
    const gpu::Scope scope(commands, "density");
    commands.dispatch(kernels.density, kernels.tiles(particles.moving), gpu::NoPush{},
                      {read(params), read(grid.cell_start), read(particles.position), read(particles.position),
                       read(particles.attributes), read(particles.velocity), read(particles.velocity),
                       write(particles.density), write(particles.pressure), write(particles.interaction),
                       write(grid.neighbor_bits)});
}

void record_forces(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                   const ParticleBuffers& particles, const NeighborGrid& grid)
{
    const gpu::Scope scope(commands, "forces");
    commands.dispatch(kernels.forces, kernels.tiles(particles.moving), gpu::NoPush{},
                      {read(params), read(grid.cell_start), read(particles.position), read(particles.position),
                       read(particles.velocity), read(particles.velocity), read(particles.interaction),
                       read(particles.interaction), read(particles.attributes), write(particles.acceleration),
                       read(grid.neighbor_bits)});
}

void record_accelerations(gpu::Commands& commands, const Fluid& fluid)
{
    record_forces(commands, fluid.kernels, fluid.params, fluid.particles, fluid.grid);
    fluid.vorticity.record_confinement(commands, fluid.kernels, fluid.params, fluid.particles, fluid.grid);
    if (fluid.capillarity != nullptr) {
        fluid.capillarity->record(commands, fluid.kernels, fluid.params, fluid.particles, fluid.grid);
    }
}

void record_kick(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                 const ParticleBuffers& particles, float part)
{
    const gpu::Scope scope(commands, "kick");
    commands.dispatch(kernels.kick, particles.moving, part,
                      {read(params), read(particles.acceleration), read(particles.acceleration),
                       read_write(particles.velocity), read(particles.velocity)});
}

void record_count_neighbors(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                            const ParticleBuffers& particles, const NeighborGrid& grid, const gpu::Buffer& counts)
{
    const gpu::Scope scope(commands, "count neighbors");
    commands.dispatch(kernels.count_neighbors, kernels.tiles(particles.moving), gpu::NoPush{},
                      {read(params), read(grid.cell_start), read(particles.position), read(particles.position),
                       read(particles.id), write(counts)});
}

void record_initial_state(gpu::Commands& commands, const Fluid& fluid)
{
    if (fluid.grid.still) {
        record_partition(commands, fluid.kernels, fluid.params, fluid.particles, fluid.grid);
    } else {
        record_sort(commands, fluid.kernels, fluid.params, fluid.particles, fluid.grid);
    }
    record_boundary_weight(commands, fluid.kernels, fluid.params, fluid.particles, fluid.grid);
    record_settle(commands, fluid.kernels, fluid.params, fluid.particles, fluid.grid);
    fluid.vorticity.record_start(commands);
    if (fluid.capillarity != nullptr) {
        fluid.capillarity->record_start(commands);
    }
    record_density(commands, fluid.kernels, fluid.params, fluid.particles, fluid.grid);
    record_accelerations(commands, fluid);
}

void Wcsph::record_start(gpu::Commands& commands, const Fluid& fluid)
{
    record_initial_state(commands, fluid);
}

void Wcsph::record_step(gpu::Commands& commands, const Fluid& fluid, std::uint32_t step)
{
    fluid.time.record(commands, fluid.params, fluid.particles);
    record_kick_drift(commands, fluid.kernels, fluid.params, fluid.particles, fluid.status, step);
    record_sort(commands, fluid.kernels, fluid.params, fluid.particles, fluid.grid);
    record_density(commands, fluid.kernels, fluid.params, fluid.particles, fluid.grid);
    fluid.vorticity.record_xsph(commands, fluid.kernels, fluid.params, fluid.particles, fluid.grid);
    record_accelerations(commands, fluid);
    record_reactions(commands, fluid, false);
    record_kick(commands, fluid.kernels, fluid.params, fluid.particles);
    if (fluid.viscosity != nullptr) {
        fluid.viscosity->record_solve(commands, fluid);
        record_reactions(commands, fluid, true);
    }
    if (fluid.shifting != nullptr) {
        fluid.shifting->record(commands, fluid.kernels, fluid.params, fluid.particles, fluid.grid);
    }
}

} // namespace meltpoint::sim
