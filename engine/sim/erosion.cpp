#include "sim/erosion.h"

#include <cmath>
#include <iterator>
#include <limits>

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
    std::ranges::copy_if(release_time, std::back_inserter(arrivals_), [](float time) { return std::isfinite(time); });
    std::ranges::sort(arrivals_);
}

double Erosion::longest_look(double time) const
{
    const auto next = std::ranges::upper_bound(arrivals_, static_cast<float>(time));
    if (next == arrivals_.end()) {
        return std::numeric_limits<double>::infinity();
    }
    const auto share = static_cast<std::ptrdiff_t>(arrivals_.size() / 50);
    const auto last = next + std::min(share, std::distance(next, arrivals_.end()) - 1);
    return static_cast<double>(*last) - time;
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
