#include "sim/dfsph.h"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <utility>

#include "sim/implicit_viscosity.h"
#include "sim/wcsph.h"
#include "spirv/sim/dfsph_correct.comp.h"
#include "spirv/sim/dfsph_residual.comp.h"
#include "spirv/sim/drift.comp.h"

namespace meltpoint::sim {

using gpu::read;
using gpu::read_write;
using gpu::write;

Dfsph::Dfsph(const gpu::Context& context, const FluidOptions& options, const shared::SphParams& params)
    : max_iterations_(std::max(params.max_iterations, 1u)), particles_(params.pool_count),
      correct_(context, "dfsph_correct", sim_dfsph_correct_comp, fluid_constants(context.info(), options)),
      residual_(context, "dfsph_residual", sim_dfsph_residual_comp, fluid_constants(context.info(), options)),
      drift_(context, "drift", sim_drift_comp),
      warm_start_(gpu::make_buffer<glm::vec2>(context, particles_, "warm start")),
      sorted_warm_start_(gpu::make_buffer<glm::vec2>(context, particles_, "warm start")),
      jacobi_step_(gpu::make_buffer<float>(context, particles_, "Jacobi step")),
      solves_(gpu::make_buffer<shared::Solve>(context, shared::SOLVES, "solves"))
{
    errors_ =
        gpu::make_buffer<glm::vec2>(context, tile_workgroups(context, residual_, options, particles_), "solve errors");
}

void Dfsph::record_start(gpu::Commands& commands, const Fluid& fluid)
{
    commands.fill(warm_start_, 0);
    commands.fill(sorted_warm_start_, 0); // of the still particles, too, which no sort moves
    commands.fill(solves_, 0);
    commands.fill(fluid.particles.pressure, 0);
    record_initial_state(commands, fluid);
}

void Dfsph::record_step(gpu::Commands& commands, const Fluid& fluid, std::uint32_t step)
{
    record_sort(commands, fluid);
    record_density(commands, fluid.kernels, fluid.params, fluid.particles, fluid.grid);
    fluid.vorticity.record_xsph(commands, fluid.kernels, fluid.params, fluid.particles, fluid.grid);
    record_solve(commands, fluid, shared::SOLVE_DIVERGENCE);
    record_accelerations(commands, fluid);
    fluid.time.record(commands, fluid.params, fluid.particles);
    record_reactions(commands, fluid, false); // now that it is known how long the forces act
    record_kick(commands, fluid.kernels, fluid.params, fluid.particles, 1.0f);
    if (fluid.viscosity != nullptr) {
        fluid.viscosity->record_solve(commands, fluid);
        record_reactions(commands, fluid, true);
    }
    record_solve(commands, fluid, shared::SOLVE_DENSITY);
    record_reaction_impulses(commands, fluid, warm_start_);
    if (fluid.shifting != nullptr) {
        fluid.shifting->record(commands, fluid.kernels, fluid.params, fluid.particles, fluid.grid);
    }
    record_drift(commands, fluid, step);
}

void Dfsph::record_drift(gpu::Commands& commands, const Fluid& fluid, std::uint32_t step)
{
    const ParticleBuffers& particles = fluid.particles;
    const gpu::Scope scope(commands, "drift");
    commands.dispatch(drift_, particles.moving, step,
                      {read(fluid.params), read(particles.id), read(particles.interaction), read(warm_start_),
                       read_write(particles.attributes), read_write(particles.position), read_write(particles.velocity),
                       write(particles.pressure), read_write(fluid.status)});
}

void Dfsph::record_sort(gpu::Commands& commands, const Fluid& fluid)
{
    sim::record_sort(commands, fluid.kernels, fluid.params, fluid.particles, fluid.grid);
    record_reorder(commands, fluid, fluid.particles.moving);
}

void Dfsph::record_carry(gpu::Commands& commands, const Fluid& fluid)
{
    record_reorder(commands, fluid, fluid.particles.count);
}

void Dfsph::record_reorder(gpu::Commands& commands, const Fluid& fluid, std::uint32_t count)
{
    const gpu::Scope scope(commands, "reorder warm start");
    record_gather(commands, fluid.kernels, fluid.grid.order, warm_start_, sorted_warm_start_, {count, 2});
    std::swap(warm_start_, sorted_warm_start_);
}

void Dfsph::record_correct(gpu::Commands& commands, const Fluid& fluid, std::uint32_t solve)
{
    const ParticleBuffers& particles = fluid.particles;
    commands.dispatch_indirect(correct_, solves_, arguments_of(solve), gpu::NoPush{},
                               {read(fluid.params), read(fluid.grid.cell_start), read(particles.position),
                                read(particles.position), read(particles.interaction), read(particles.interaction),
                                read(particles.attributes), read(particles.velocity), write(fluid.grid.sorted_velocity),
                                read(fluid.grid.neighbor_bits), read(particles.velocity)});
}

void Dfsph::record_residual(gpu::Commands& commands, const Fluid& fluid, shared::ResidualPush push)
{
    const ParticleBuffers& particles = fluid.particles;
    const gpu::Buffer& velocity = push.iteration == 0 ? particles.velocity : fluid.grid.sorted_velocity;
    const std::initializer_list<gpu::Binding> bindings{read(fluid.params),
                                                       read(fluid.grid.cell_start),
                                                       read(particles.position),
                                                       read(particles.position),
                                                       read(velocity),
                                                       read(velocity),
                                                       read(particles.attributes),
                                                       read_write(particles.interaction),
                                                       read_write(warm_start_),
                                                       read_write(errors_),
                                                       read_write(solves_),
                                                       read(fluid.grid.neighbor_bits),
                                                       read_write(jacobi_step_),
                                                       read(particles.interaction)};
    if (push.iteration == 0) {
        commands.dispatch(residual_, fluid.kernels.tiles(particles.moving), push, bindings);
    } else {
        commands.dispatch_indirect(residual_, solves_, arguments_of(push.solve), push, bindings);
    }
}

void Dfsph::record_solve(gpu::Commands& commands, const Fluid& fluid, std::uint32_t solve)
{
    const gpu::Scope scope(commands, solve == shared::SOLVE_DENSITY ? "solve density" : "solve divergence");
    record_residual(commands, fluid, {.solve = solve, .iteration = 0});
    for (std::uint32_t iteration = 1; iteration <= max_iterations_; ++iteration) {
        record_correct(commands, fluid, solve);
        record_residual(commands, fluid, {.solve = solve, .iteration = iteration});
    }
    std::swap(fluid.particles.velocity, fluid.grid.sorted_velocity);
}

std::uint64_t Dfsph::device_bytes() const
{
    return warm_start_.size() + sorted_warm_start_.size() + jacobi_step_.size() + errors_.size() + solves_.size();
}

} // namespace meltpoint::sim
