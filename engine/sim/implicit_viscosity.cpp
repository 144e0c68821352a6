#include "sim/implicit_viscosity.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "spirv/sim/viscosity_direction.comp.h"
#include "spirv/sim/viscosity_end.comp.h"
#include "spirv/sim/viscosity_product.comp.h"
#include "spirv/sim/viscosity_residual.comp.h"
#include "spirv/sim/viscosity_start.comp.h"
#include "spirv/sim/viscosity_update.comp.h"

namespace meltpoint::sim {

using gpu::read;
using gpu::read_write;
using gpu::write;

namespace {

constexpr VkDeviceSize arguments = offsetof(shared::ViscositySolve, solve) + offsetof(shared::Solve, groups);

} // namespace

ImplicitViscosity::ImplicitViscosity(const gpu::Context& context, const FluidOptions& options,
                                     const shared::SphParams& params)
    : max_iterations_(params.viscosity_iterations), particles_(params.pool_count),
      start_(context, "viscosity_start", sim_viscosity_start_comp),
      initial_residual_(context, "viscosity_residual", sim_viscosity_residual_comp,
                        fluid_constants(context.info(), options)),
      next_direction_(context, "viscosity_direction", sim_viscosity_direction_comp,
                      fluid_constants(context.info(), options)),
      apply_(context, "viscosity_product", sim_viscosity_product_comp, fluid_constants(context.info(), options)),
      update_(context, "viscosity_update", sim_viscosity_update_comp, fluid_constants(context.info(), options)),
      end_(context, "viscosity_end", sim_viscosity_end_comp),
      change_(gpu::make_buffer<glm::vec4>(context, particles_, "viscous change")),
      residual_(gpu::make_buffer<glm::vec4>(context, particles_, "viscous residual")),
      direction_(gpu::make_texel_buffer(context, particles_, "viscous direction")),
      product_(gpu::make_buffer<glm::vec4>(context, particles_, "viscous product")),
      blocks_(gpu::make_buffer<shared::ViscosityBlock>(context, particles_, "viscous blocks")),
      state_(gpu::make_buffer<shared::ViscositySolve>(context, 1, "viscosity solve"))
{
    sums_ = gpu::make_buffer<glm::vec4>(context, tile_workgroups(context, initial_residual_, options, particles_),
                                        "viscous sums");
}

void ImplicitViscosity::record_start(gpu::Commands& commands)
{
    commands.fill(change_, 0);
    commands.fill(direction_, 0); // of the still particles
    commands.fill(state_, 0);
}

void ImplicitViscosity::record_carry(gpu::Commands& commands, const Fluid& fluid)
{
    record_gather(commands, fluid.kernels, fluid.grid.order, change_, product_, {fluid.particles.count, 4});
    std::swap(change_, product_);
    commands.fill(direction_, 0);
}

void ImplicitViscosity::record_solve(gpu::Commands& commands, const Fluid& fluid)
{
    const gpu::Scope scope(commands, "solve viscosity");
    record_residual(commands, fluid);
    for (std::uint32_t iteration = 1; iteration <= max_iterations_; ++iteration) {
        record_direction(commands, fluid);
        record_product(commands, fluid);
        record_update(commands, fluid, iteration);
    }
    record_end(commands, fluid);
}

void ImplicitViscosity::record_residual(gpu::Commands& commands, const Fluid& fluid)
{
    const ParticleBuffers& particles = fluid.particles;
    commands.dispatch(start_, particles.moving, gpu::NoPush{},
                      {read(fluid.params), read(fluid.grid.order), read(particles.attributes), read(particles.velocity),
                       read(change_), write(product_), write(direction_)});
    std::swap(change_, product_);
    commands.dispatch(initial_residual_, fluid.kernels.tiles(particles.moving), gpu::NoPush{},
                      {read(fluid.params), read(fluid.grid.cell_start), read(particles.position),
                       read(particles.position), read(particles.interaction), read(particles.interaction),
                       read(particles.attributes), read(direction_), read(direction_), read(change_), write(residual_),
                       write(blocks_), read_write(sums_), read_write(state_), read(fluid.grid.neighbor_bits)});
}

void ImplicitViscosity::record_direction(gpu::Commands& commands, const Fluid& fluid)
{
    commands.dispatch_indirect(
        next_direction_, state_, arguments, gpu::NoPush{},
        {read(fluid.params), read(residual_), read(blocks_), read(state_), read_write(direction_)});
}

void ImplicitViscosity::record_product(gpu::Commands& commands, const Fluid& fluid)
{
    const ParticleBuffers& particles = fluid.particles;
    commands.dispatch_indirect(apply_, state_, arguments, gpu::NoPush{},
                               {read(fluid.params), read(fluid.grid.cell_start), read(particles.position),
                                read(particles.position), read(particles.interaction), read(particles.interaction),
                                read(particles.attributes), read(direction_), read(direction_), write(product_),
                                read_write(sums_), read_write(state_), read(fluid.grid.neighbor_bits)});
}

void ImplicitViscosity::record_update(gpu::Commands& commands, const Fluid& fluid, std::uint32_t iteration)
{
    commands.dispatch_indirect(update_, state_, arguments, iteration,
                               {read(fluid.params), read(direction_), read(product_), read(blocks_),
                                read_write(change_), read_write(residual_), read_write(sums_), read_write(state_)});
}

void ImplicitViscosity::record_end(gpu::Commands& commands, const Fluid& fluid)
{
    commands.dispatch(end_, fluid.particles.moving, gpu::NoPush{},
                      {read(fluid.params), read_write(change_), read_write(fluid.particles.velocity)});
}

std::uint64_t ImplicitViscosity::device_bytes() const
{
    return change_.size() + residual_.size() + direction_.size() + product_.size() + blocks_.size() + sums_.size() +
           state_.size();
}

} // namespace meltpoint::sim
