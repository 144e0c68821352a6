#include "sim/pbf.h"

#include <algorithm>
#include <cstddef>
#include <initializer_list>

#include "sim/wcsph.h"
#include "spirv/sim/pbf_correct.comp.h"
#include "spirv/sim/pbf_finish.comp.h"
#include "spirv/sim/pbf_move.comp.h"
#include "spirv/sim/pbf_predict.comp.h"
#include "spirv/sim/pbf_residual.comp.h"

namespace meltpoint::sim {

using gpu::read;
using gpu::read_write;
using gpu::write;

Pbf::Pbf(const gpu::Context& context, const FluidOptions& options, const shared::SphParams& params)
    : max_iterations_(std::max(params.max_iterations, 1u)), particles_(params.pool_count),
      predict_(context, "pbf_predict", sim_pbf_predict_comp),
      move_kernel_(context, "pbf_move", sim_pbf_move_comp, fluid_constants(context.info(), options)),
      residual_(context, "pbf_residual", sim_pbf_residual_comp, fluid_constants(context.info(), options)),
      correct_(context, "pbf_correct", sim_pbf_correct_comp, fluid_constants(context.info(), options)),
      finish_(context, "pbf_finish", sim_pbf_finish_comp),
      move_(gpu::make_buffer<glm::vec4>(context, particles_, "move")),
      moved_(gpu::make_texel_buffer(context, particles_, "moved position")),
      solves_(gpu::make_buffer<shared::Solve>(context, shared::SOLVES, "solves"))
{
    errors_ =
        gpu::make_buffer<glm::vec2>(context, tile_workgroups(context, residual_, options, particles_), "solve errors");
}

void Pbf::record_start(gpu::Commands& commands, const Fluid& fluid)
{
    commands.fill(solves_, 0);
    commands.fill(fluid.particles.pressure, 0);
    record_initial_state(commands, fluid);
    record_still(commands, fluid);
}

void Pbf::record_carry(gpu::Commands& commands, const Fluid& fluid)
{
    record_still(commands, fluid);
}

void Pbf::record_still(gpu::Commands& commands, const Fluid& fluid) const
{
    commands.copy(fluid.particles.position, moved_, moved_.size());
    commands.fill(move_, 0);
}

void Pbf::record_step(gpu::Commands& commands, const Fluid& fluid, std::uint32_t step)
{
    fluid.time.record(commands, fluid.params, fluid.particles);
    record_predict(commands, fluid);
    record_sort(commands, fluid.kernels, fluid.params, fluid.particles, fluid.grid);
    record_density(commands, fluid.kernels, fluid.params, fluid.particles, fluid.grid);
    fluid.vorticity.record_xsph(commands, fluid.kernels, fluid.params, fluid.particles, fluid.grid);
    record_accelerations(commands, fluid);
    record_solve(commands, fluid);
    record_finish(commands, fluid, step);
    if (fluid.forces_on_loose != nullptr) { // of the pressures that the moves stand for
        fluid.forces_on_loose->record_forces(commands, fluid);
    }
}

void Pbf::record_predict(gpu::Commands& commands, const Fluid& fluid)
{
    const ParticleBuffers& particles = fluid.particles;
    const gpu::Scope scope(commands, "predict");
    commands.dispatch(predict_, particles.moving, gpu::NoPush{},
                      {read(fluid.params), read(particles.attributes), read_write(particles.position),
                       read_write(particles.velocity)});
}

void Pbf::record_move(gpu::Commands& commands, const Fluid& fluid, std::uint32_t iteration)
{
    const ParticleBuffers& particles = fluid.particles;
    const std::initializer_list<gpu::Binding> bindings{
        read(fluid.params), read(particles.position), read(particles.acceleration), read_write(move_),
        write(moved_),      write(particles.pressure)};
    if (iteration == 0) {
        commands.dispatch(move_kernel_, fluid.kernels.tiles(particles.moving), iteration, bindings);
    } else {
        commands.dispatch_indirect(move_kernel_, solves_, arguments_of(shared::SOLVE_DENSITY), iteration, bindings);
    }
}

void Pbf::record_residual(gpu::Commands& commands, const Fluid& fluid, std::uint32_t iteration)
{
    const ParticleBuffers& particles = fluid.particles;
    const shared::ResidualPush push{.solve = shared::SOLVE_DENSITY, .iteration = iteration};
    const std::initializer_list<gpu::Binding> bindings{read(fluid.params),
                                                       read(fluid.grid.cell_start),
                                                       read(particles.position),
                                                       read(particles.position),
                                                       read(moved_),
                                                       read(moved_),
                                                       read(particles.velocity),
                                                       read(particles.velocity),
                                                       read(particles.attributes),
                                                       write(particles.density),
                                                       write(particles.interaction),
                                                       read_write(errors_),
                                                       read_write(solves_),
                                                       read(fluid.grid.neighbor_bits)};
    if (iteration == 0) {
        commands.dispatch(residual_, fluid.kernels.tiles(particles.moving), push, bindings);
    } else {
        commands.dispatch_indirect(residual_, solves_, arguments_of(shared::SOLVE_DENSITY), push, bindings);
    }
}

void Pbf::record_correct(gpu::Commands& commands, const Fluid& fluid)
{
    const ParticleBuffers& particles = fluid.particles;
    commands.dispatch_indirect(correct_, solves_, arguments_of(shared::SOLVE_DENSITY), gpu::NoPush{},
                               {read(fluid.params), read(fluid.grid.cell_start), read(particles.position),
                                read(particles.position), read(moved_), read(moved_), read(particles.interaction),
                                read(particles.interaction), read(particles.attributes), read(particles.velocity),
                                read_write(move_), read_write(particles.pressure), read(fluid.grid.neighbor_bits)});
}

void Pbf::record_solve(gpu::Commands& commands, const Fluid& fluid)
{
    const gpu::Scope scope(commands, "solve density");
    record_move(commands, fluid, 0);
    record_residual(commands, fluid, 0);
    for (std::uint32_t iteration = 1; iteration <= max_iterations_; ++iteration) {
        record_correct(commands, fluid);
        record_move(commands, fluid, iteration);
        record_residual(commands, fluid, iteration);
    }
}

void Pbf::record_finish(gpu::Commands& commands, const Fluid& fluid, std::uint32_t step)
{
    const ParticleBuffers& particles = fluid.particles;
    const gpu::Scope scope(commands, "finish");
    commands.dispatch(finish_, particles.moving, step,
                      {read(fluid.params), read(particles.id), read_write(particles.interaction), read(move_),
                       read_write(particles.attributes), read_write(particles.position), read_write(particles.velocity),
                       read_write(particles.pressure), read_write(fluid.status), read_write(solves_)});
}

std::uint64_t Pbf::device_bytes() const
{
    return move_.size() + moved_.size() + errors_.size() + solves_.size();
}

} // namespace meltpoint::sim
