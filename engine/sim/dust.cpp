#include "sim/dust.h"

#include "gpu/transfer.h"
#include "spirv/sim/dust.comp.h"

namespace meltpoint::sim {

using gpu::read;
using gpu::read_write;
using gpu::write;

Dust::Dust(const gpu::Context& context, const shared::DustParams& params)
    : drift_(context, "dust", sim_dust_comp), params_(gpu::make_buffer<shared::DustParams>(context, 1, "dust params"))
{
    gpu::upload<shared::DustParams>(context, params_, {&params, 1});
}

void Dust::record(gpu::Commands& commands, const Fluid& fluid, const gpu::Buffer& release_time,
                  const gpu::Buffer& ledger, float start) const
{
    const ParticleBuffers& particles = fluid.particles;
    const gpu::Scope scope(commands, "dust");
    commands.dispatch(drift_, particles.moving, start,
                      {read(fluid.params), read(params_), read(fluid.time.state()), read(particles.id),
                       read(release_time), read_write(particles.attributes), read_write(particles.position),
                       read_write(particles.velocity), write(particles.density), read_write(ledger)});
}

} // namespace meltpoint::sim
