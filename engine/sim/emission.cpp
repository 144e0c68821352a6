#include "sim/emission.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "gpu/transfer.h"
#include "spirv/sim/birth.comp.h"
#include "spirv/sim/birth_place.comp.h"
#include "spirv/sim/call_up.comp.h"
#include "spirv/sim/sink.comp.h"

namespace meltpoint::sim {

using gpu::read;
using gpu::read_write;
using gpu::write;

namespace {

/// A buffer of at least one element, which may be of no meaning.
template <class T>
gpu::Buffer upload_list(const gpu::Context& context, const std::vector<T>& list, const char* name)
{
    gpu::Buffer buffer = gpu::make_buffer<T>(context, std::max(list.size(), std::size_t{1}), name);
    if (!list.empty()) {
        gpu::upload<T>(context, buffer, list);
    }
    return buffer;
}

} // namespace

std::uint32_t births_until(const shared::Emitter& emitter, double time)
{
    if (time < static_cast<double>(emitter.start)) {
        return 0;
    }
    const double layers =
        std::floor((time - static_cast<double>(emitter.start)) / static_cast<double>(emitter.period)) + 1.0;
    return static_cast<std::uint32_t>(
        std::min(layers * static_cast<double>(emitter.points), static_cast<double>(emitter.births)));
}

Emission::Emission(const gpu::Context& context, EmissionSettings settings)
    : settings_(std::move(settings)), call_up_(context, "call_up", sim_call_up_comp),
      birth_place_(context, "birth_place", sim_birth_place_comp,
                   fluid_constants(context.info(), {.still = true, .tile = 1})),
      birth_(context, "birth", sim_birth_comp), sink_(context, "sink", sim_sink_comp),
      emitters_(upload_list(context, settings_.emitters, "emitters")),
      points_(upload_list(context, settings_.points, "nozzle points")),
      sinks_(upload_list(context, settings_.sinks, "sinks")),
      ledger_(gpu::make_buffer<shared::Ledger>(context, 1, "ledger")), next_birth_(settings_.emitters.size(), 0),
      missed_(settings_.emitters.size(), 0)
{
    if (settings_.emitters.size() > shared::MAX_EMITTERS || settings_.sinks.size() > shared::MAX_SINKS) {
        throw std::logic_error("Emission: too many emitters or sinks");
    }
    const shared::Ledger nothing{};
    gpu::upload<shared::Ledger>(context, ledger_, {&nothing, 1});
}

void Emission::record_calls(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                            const gpu::Buffer& release_time, const gpu::Buffer& changes, std::uint32_t gone,
                            double time, double horizon)
{
    const gpu::Scope scope(commands, "calls");
    for (std::uint32_t e = 0; e < settings_.emitters.size(); ++e) {
        const shared::Emitter& emitter = settings_.emitters[e];
        const std::uint32_t past = std::max(births_until(emitter, time), emitter.points) - emitter.points;
        missed_[e] += past > next_birth_[e] ? past - next_birth_[e] : 0;
        next_birth_[e] = std::max(next_birth_[e], past);
        // The last look may have looked farther ahead, where steps have become shorter since.
        const std::uint32_t until = std::max(births_until(emitter, horizon), next_birth_[e]);
        const shared::Call call{.emitter = e,
                                .first_birth = next_birth_[e],
                                .births = std::min(until - next_birth_[e], emitter.slots),
                                .first_dead = particles.count - gone};
        if (call.births > 0) {
            commands.dispatch(call_up_, call.births, call,
                              {read(params), read(emitters_), read(points_), read(particles.id),
                               read_write(particles.attributes), read_write(particles.position),
                               read_write(particles.velocity), write(release_time), read_write(changes)});
        }
    }
}

void Emission::note_called(const shared::PoolChanges& changes)
{
    for (std::size_t e = 0; e < next_birth_.size(); ++e) {
        next_birth_[e] += changes.called[e];
    }
}

void Emission::record_step(gpu::Commands& commands, const Fluid& fluid, const gpu::Buffer& release_time,
                           float start) const
{
    const gpu::Scope scope(commands, "emission");
    const ParticleBuffers& particles = fluid.particles;
    if (!settings_.emitters.empty()) {
        commands.dispatch(birth_place_, particles.moving, start,
                          {read(fluid.params), read(fluid.grid.cell_start), read(fluid.time.state()),
                           read(particles.id), read(release_time), read(particles.attributes), read(particles.position),
                           read(particles.position), read(particles.velocity), write(particles.density)});
        commands.dispatch(birth_, particles.moving, start,
                          {read(fluid.params), read(fluid.time.state()), read(particles.id), read(release_time),
                           read_write(particles.attributes), read_write(particles.position),
                           read_write(particles.velocity), read_write(particles.density), read_write(ledger_)});
    }
    if (!settings_.sinks.empty()) {
        commands.dispatch(sink_, particles.moving, static_cast<std::uint32_t>(settings_.sinks.size()),
                          {read(fluid.params), read(sinks_), read_write(particles.attributes),
                           read_write(particles.position), read_write(particles.velocity), read_write(ledger_)});
    }
}

std::uint64_t Emission::device_bytes() const
{
    return emitters_.size() + points_.size() + sinks_.size() + ledger_.size();
}

} // namespace meltpoint::sim
