#include "sim/volume_relaxation.h"

#include "spirv/sim/relax_volume.comp.h"

namespace meltpoint::sim {

using gpu::read;
using gpu::read_write;

VolumeRelaxation::VolumeRelaxation(const gpu::Context& context) : relax_(context, "relax_volume", sim_relax_volume_comp)
{
}

bool VolumeRelaxation::is_needed(const ParticleSet& particles)
{
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const std::uint32_t state = shared::particle_state(particles.attributes[i]);
        const bool may_be_fluid = state == shared::STATE_SOLID || state == shared::STATE_FLUID;
        if (may_be_fluid && particles.weight[i] != 1.0f) {
            return true;
        }
    }
    return false;
}

void VolumeRelaxation::record(gpu::Commands& commands, const Fluid& fluid) const
{
    const gpu::Scope scope(commands, "relax volume");
    commands.dispatch(relax_, fluid.particles.moving, gpu::NoPush{},
                      {read(fluid.params), read(fluid.particles.attributes), read_write(fluid.particles.position)});
}

} // namespace meltpoint::sim
