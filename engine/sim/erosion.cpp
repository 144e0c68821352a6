#include "sim/erosion.h"

#include "gpu/transfer.h"
#include "spirv/sim/count_dead.comp.h"
#include "spirv/sim/front.comp.h"

namespace meltpoint::sim {

using gpu::read;
using gpu::read_write;

Erosion::Erosion(const gpu::Context& context, std::span<const float> release_time)
    : front_(context, "front", sim_front_comp), count_dead_(context, "count_dead", sim_count_dead_comp),
      release_time_(gpu::make_buffer<float>(context, release_time.size(), "release time")),
      changes_(gpu::make_buffer<shared::PoolChanges>(context, 1, "pool changes")),
      readback_(context, sizeof(shared::PoolChanges), gpu::MemoryUse::Readback, "pool changes")
{
    gpu::upload<float>(context, release_time_, release_time);
}

void Erosion::record_look(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                          float time) const
{
    const gpu::Scope scope(commands, "erosion");
    commands.fill(changes_, 0);
    commands.dispatch(front_, particles.count, time,
                      {read(params), read(particles.id), read(release_time_), read_write(particles.attributes),
                       read_write(particles.velocity), read_write(particles.position), read_write(changes_)});
    commands.dispatch(count_dead_, particles.moving, gpu::NoPush{},
                      {read(params), read(particles.attributes), read_write(changes_)});
}

void Erosion::record_readback(gpu::Commands& commands) const
{
    commands.copy(changes_, readback_, sizeof(shared::PoolChanges));
}

shared::PoolChanges Erosion::found() const
{
    return readback_.mapped<shared::PoolChanges>()[0];
}

} // namespace meltpoint::sim
