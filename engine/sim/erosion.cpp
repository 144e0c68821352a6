#include "sim/erosion.h"

#include "gpu/transfer.h"
#include "spirv/sim/front.comp.h"

namespace meltpoint::sim {

using gpu::read;
using gpu::read_write;

Erosion::Erosion(const gpu::Context& context, std::span<const float> release_time)
    : front_(context, "front", sim_front_comp),
      release_time_(gpu::make_buffer<float>(context, release_time.size(), "release time")),
      freed_(gpu::make_buffer<std::uint32_t>(context, 1, "freed")),
      readback_(context, sizeof(std::uint32_t), gpu::MemoryUse::Readback, "freed")
{
    gpu::upload<float>(context, release_time_, release_time);
}

void Erosion::record_front(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                           float time) const
{
    const gpu::Scope scope(commands, "front");
    commands.fill(freed_, 0);
    commands.dispatch(front_, particles.count - particles.moving, time,
                      {read(params), read(particles.id), read(release_time_), read_write(particles.attributes),
                       read_write(particles.velocity), read_write(freed_)});
    commands.copy(freed_, readback_, sizeof(std::uint32_t));
}

std::uint32_t Erosion::freed() const
{
    return readback_.mapped<std::uint32_t>()[0];
}

} // namespace meltpoint::sim
