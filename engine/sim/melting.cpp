#include "sim/melting.h"

#include <algorithm>
#include <limits>

#include "gpu/transfer.h"
#include "shared/pool_changes.h"
#include "spirv/sim/freeze.comp.h"
#include "spirv/sim/melt.comp.h"
#include "spirv/sim/warm.comp.h"

namespace meltpoint::sim {

using gpu::read;
using gpu::read_write;
using gpu::write;

namespace {

/// Of passes in which a few particles walk, each alone, through the moving or the still ones.
FluidOptions one_by_one(FluidOptions options)
{
    options.still = false;
    options.tile = 1;
    return options;
}

/// s of motion, in which sun and air melt a layer of particles.
double shortest_melting(const shared::SphParams& params, const MeltingSettings& settings)
{
    double shortest = std::numeric_limits<double>::infinity();
    for (std::uint32_t material = 0; material < shared::MAX_MATERIALS; ++material) {
        const shared::HeatMaterial& its = settings.heat.of[material];
        const shared::MeltingParams& from = settings.params;
        const double power = static_cast<double>(from.absorptivity[material]) * static_cast<double>(from.sun) +
                             static_cast<double>(from.air_transfer) *
                                 std::max(static_cast<double>(from.air_temperature - its.melting_point), 0.0);
        const double heat = static_cast<double>(its.latent_heat) * static_cast<double>(params.rest_density[material]) *
                            static_cast<double>(params.spacing);
        if (from.melts[material] != 0 && power > 0.0) {
            shortest = std::min(shortest, heat / (power * settings.time_scale));
        }
    }
    return shortest;
}

} // namespace

Melting::Melting(const gpu::Context& context, const FluidOptions& options, const shared::SphParams& params,
                 const MeltingSettings& settings, const std::vector<std::uint32_t>& attributes)
    : time_scale_(settings.time_scale), longest_look_(0.05 * shortest_melting(params, settings)),
      visibility_(context, {.direction = settings.params.sun_direction}, params),
      heat_(context, options, params, settings.heat, attributes, settings.enthalpy),
      warm_(context, "warm", sim_warm_comp, fluid_constants(context.info(), one_by_one(options))),
      melt_(context, "melt", sim_melt_comp),
      freeze_(context, "freeze", sim_freeze_comp, fluid_constants(context.info(), one_by_one(options))),
      params_(gpu::make_buffer<shared::MeltingParams>(context, 1, "melting params")),
      before_(gpu::make_buffer<float>(context, params.pool_count, "enthalpy before"))
{
    const std::vector<float> before(settings.enthalpy.begin(), settings.enthalpy.end());
    gpu::upload<float>(context, before_, before);
    gpu::upload<shared::MeltingParams>(context, params_, {&settings.params, 1});
}

void Melting::record_surface(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                             const Exposure& exposure) const
{
    const gpu::Scope scope(commands, "sunlight");
    visibility_.record(commands, params, particles, exposure.exposure());
}

void Melting::record_heat(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                          const ParticleBuffers& particles, const NeighborGrid& grid, const Exposure& exposure,
                          double seconds) const
{
    const double heat_seconds = seconds * time_scale_;
    {
        const gpu::Scope scope(commands, "warm");
        commands.dispatch(warm_, particles.count, static_cast<float>(heat_seconds),
                          {read(params), read(grid.cell_start), read(heat_.params()), read(params_), read(particles.id),
                           read(particles.attributes), read(particles.position), read(particles.velocity),
                           read(exposure.exposure()), read(visibility_.visibility()), read_write(heat_.enthalpy())});
    }
    heat_.record_conduction(commands, kernels, params, particles, grid, heat_seconds);
}

void Melting::record_changes(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                             const NeighborGrid& grid, const gpu::Buffer& release_time, const gpu::Buffer& changes,
                             const shared::MeltPush& push, const gpu::Buffer* body_of) const
{
    const gpu::Scope scope(commands, "melt and freeze");
    commands.dispatch(freeze_, particles.moving, body_of != nullptr ? 1u : 0u,
                      {read(params), read(grid.cell_start), read(params_), read(particles.id), read(heat_.enthalpy()),
                       read(particles.position), read_write(particles.attributes), read_write(particles.velocity),
                       write(release_time), read_write(changes),
                       read(body_of != nullptr ? *body_of : heat_.enthalpy())});
    commands.dispatch(melt_, particles.count, push,
                      {read(params), read(heat_.params()), read(params_), read(particles.id), read(heat_.enthalpy()),
                       read_write(particles.attributes), read_write(particles.velocity), write(release_time),
                       read_write(changes), read_write(before_)});
}

std::uint64_t Melting::device_bytes() const
{
    return visibility_.device_bytes() + heat_.device_bytes() + params_.size() + before_.size();
}

} // namespace meltpoint::sim
