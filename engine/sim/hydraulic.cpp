#include "sim/hydraulic.h"

#include <bit>
#include <limits>
#include <stdexcept>

#include "gpu/transfer.h"
#include "spirv/sim/deposit.comp.h"
#include "spirv/sim/detach.comp.h"
#include "spirv/sim/scour.comp.h"

namespace meltpoint::sim {

using gpu::read;
using gpu::read_write;

namespace {

/// Part of a particle that flow may carry off from one look to the next.
constexpr double largest_loss = 0.05;

/// Of passes in which a few particles walk, each alone, through the moving or the still ones.
FluidOptions one_by_one(FluidOptions options)
{
    options.still = false;
    options.tile = 1;
    return options;
}

} // namespace

Hydraulic::Hydraulic(const gpu::Context& context, const FluidOptions& options, const HydraulicSettings& settings,
                     std::uint32_t pool)
    : context_(&context), pool_(pool),
      scour_(context, "scour", sim_scour_comp, fluid_constants(context.info(), one_by_one(options))),
      deposit_(context, "deposit", sim_deposit_comp, fluid_constants(context.info(), one_by_one(options))),
      detach_(context, "detach", sim_detach_comp),
      params_(gpu::make_buffer<shared::HydraulicParams>(context, 1, "hydraulic params")),
      strength_(gpu::make_buffer<float>(context, pool, "strength")),
      damage_(gpu::make_buffer<glm::vec2>(context, pool, "damage")),
      rate_(gpu::make_buffer<float>(context, pool, "damage rate")),
      fastest_(gpu::make_buffer<std::uint32_t>(context, 1, "fastest damage")),
      readback_(context, sizeof(std::uint32_t), gpu::MemoryUse::Readback, "fastest damage")
{
    if (!settings.strength.empty() && settings.strength.size() != pool) {
        throw std::logic_error("Hydraulic: strengths are of each particle");
    }
    gpu::upload<shared::HydraulicParams>(context, params_, {&settings.params, 1});
    gpu::upload<float>(context, strength_,
                       settings.strength.empty() ? std::vector<float>(pool, 1.0f) : settings.strength);
    readback_.mapped<std::uint32_t>()[0] = 0;
}

void Hydraulic::record_start(gpu::Commands& commands) const
{
    commands.fill(damage_, 0);
    commands.fill(rate_, 0);
}

void Hydraulic::record_scour(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                             const NeighborGrid& grid, const Exposure& exposure, double seconds) const
{
    const gpu::Scope scope(commands, "scour");
    commands.fill(fastest_, 0);
    commands.dispatch(scour_, particles.count, static_cast<float>(seconds),
                      {read(params), read(grid.cell_start), read(params_), read(particles.id),
                       read(particles.attributes), read(particles.position), read(particles.position),
                       read(particles.velocity), read(particles.velocity), read(exposure.exposure()), read(strength_),
                       read_write(damage_), read_write(rate_), read_write(fastest_)});
    commands.copy(fastest_, readback_, sizeof(std::uint32_t));
}

void Hydraulic::record_changes(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                               const NeighborGrid& grid, const gpu::Buffer& release_time, const gpu::Buffer& changes,
                               double time, double seconds, double next_seconds) const
{
    const gpu::Scope scope(commands, "deposit and detach");
    commands.dispatch(deposit_, particles.moving, static_cast<float>(seconds),
                      {read(params), read(grid.cell_start), read(params_), read(particles.id), read(particles.position),
                       read_write(damage_), read_write(particles.attributes), read_write(particles.velocity),
                       gpu::write(release_time), read_write(changes), read(particles.density)});
    const shared::DetachPush push{.time = static_cast<float>(time), .ahead = static_cast<float>(0.5 * next_seconds)};
    commands.dispatch(detach_, particles.count, push,
                      {read(params), read(params_), read(particles.id), read_write(damage_),
                       read_write(particles.attributes), read_write(particles.velocity), gpu::write(release_time),
                       read_write(changes), read(rate_)});
}

double Hydraulic::longest_look() const
{
    const float fastest = std::bit_cast<float>(readback_.mapped<std::uint32_t>()[0]);
    return fastest > 0.0f ? largest_loss / static_cast<double>(fastest) : std::numeric_limits<double>::infinity();
}

std::vector<double> Hydraulic::download_damage() const
{
    std::vector<double> damage;
    for (const glm::vec2& each : gpu::download<glm::vec2>(*context_, damage_, pool_)) {
        damage.push_back(static_cast<double>(each.x) + static_cast<double>(each.y));
    }
    return damage;
}

} // namespace meltpoint::sim
