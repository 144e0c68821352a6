#include "sim/boundary_forces.h"

#include <algorithm>

#include "sim/solver.h"
#include "spirv/sim/boundary_force.comp.h"
#include "spirv/sim/boundary_impulse.comp.h"

namespace meltpoint::sim {

using gpu::read;
using gpu::read_write;

BoundaryForces::BoundaryForces(const gpu::Context& context, const FluidOptions& options,
                               std::span<const std::uint32_t> attributes, Reach reach)
    : reach_(reach),
      force_(context, "boundary_force", sim_boundary_force_comp, fluid_constants(context.info(), options)),
      impulse_(context, "boundary_impulse", sim_boundary_impulse_comp, fluid_constants(context.info(), options))
{
    const auto is_one = [](std::uint32_t each) {
        return shared::is_boundary(each);
    };
    const auto first = std::ranges::find_if(attributes, is_one);
    const auto last = std::find_if(attributes.rbegin(), attributes.rend(), is_one).base();
    if (first != attributes.end()) {
        first_id_ = static_cast<std::uint32_t>(first - attributes.begin());
        count_ = static_cast<std::uint32_t>(last - attributes.begin()) - first_id_;
    }
    reactions_ = gpu::make_buffer<shared::Reaction>(context, std::max(count_, 1u), "reactions");
}

shared::ReactionPush BoundaryForces::push(const Fluid& fluid) const
{
    return {.first_id = first_id_, .count = reach_ == Reach::All ? fluid.particles.count : fluid.particles.moving};
}

void BoundaryForces::record_forces(gpu::Commands& commands, const Fluid& fluid)
{
    const gpu::Scope scope(commands, "boundary forces");
    const ParticleBuffers& particles = fluid.particles;
    commands.dispatch(force_, fluid.kernels.tiles(push(fluid).count), push(fluid),
                      {read(fluid.params), read(fluid.grid.cell_start), read(particles.position),
                       read(particles.position), read(particles.velocity), read(particles.velocity),
                       read(particles.interaction), read(particles.interaction), read(particles.attributes),
                       read(particles.id), read_write(reactions_)});
}

void BoundaryForces::record_impulses(gpu::Commands& commands, const Fluid& fluid, const gpu::Buffer& warm_start)
{
    const gpu::Scope scope(commands, "boundary impulses");
    const ParticleBuffers& particles = fluid.particles;
    commands.dispatch(impulse_, fluid.kernels.tiles(push(fluid).count), push(fluid),
                      {read(fluid.params), read(fluid.grid.cell_start), read(particles.position),
                       read(particles.position), read(warm_start), read(particles.attributes), read(particles.id),
                       read_write(reactions_)});
}

void BoundaryForces::record_reset(gpu::Commands& commands) const
{
    commands.fill(reactions_, 0);
}

} // namespace meltpoint::sim
