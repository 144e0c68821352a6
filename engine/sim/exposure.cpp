#include "sim/exposure.h"

#include <algorithm>

#include "gpu/transfer.h"
#include "particles/sph_kernel.h"
#include "shared/exposure.h"
#include "spirv/sim/exposure.comp.h"
#include "spirv/sim/surface_change.comp.h"

namespace meltpoint::sim {

namespace {

constexpr std::uint32_t particles_a_dispatch = 1u << 18; // a third of a second on a software device

} // namespace

Exposure::Exposure(const gpu::Context& context, const FluidOptions& options, std::uint32_t pool, std::uint32_t cells)
    : context_(&context), pool_(pool), change_(context, "surface_change", sim_surface_change_comp),
      kernel_(context, "exposure", sim_exposure_comp, fluid_constants(context.info(), options)),
      exposure_(gpu::make_buffer<glm::vec4>(context, pool, "exposure")),
      known_(gpu::make_buffer<glm::vec4>(context, pool, "known surface")),
      marks_(gpu::make_buffer<std::uint32_t>(context, cells, "surface changes")),
      scales_{.area_scale = static_cast<float>(exposed_area_scale(options.dimensions)),
              .filling_scale = static_cast<float>(solid_filling_scale(options.dimensions)),
              .faces = static_cast<float>(2 * options.dimensions)}
{
}

void Exposure::record_start(gpu::Commands& commands)
{
    commands.fill(exposure_, 0);
    commands.fill(known_, 0);
    commands.fill(marks_, 0);
    round_ = 0;
}

void Exposure::record(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                      const NeighborGrid& grid, std::uint32_t first, std::uint32_t count) const
{
    const gpu::Scope scope(commands, "exposure");
    const std::uint32_t still = particles.count - particles.moving;
    const std::uint32_t end = first + std::min(count, still - std::min(first, still));
    record_range(commands, params, particles, grid, particles.moving + first, particles.moving + end, scales_);
}

void Exposure::record_changes(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                              const NeighborGrid& grid, bool any_loose)
{
    const gpu::Scope scope(commands, "exposure");
    shared::ExposurePush push = scales_;
    push.any_loose = any_loose ? 1 : 0;
    push.round = ++round_;
    commands.dispatch(change_, particles.count, push.round,
                      {gpu::read(params), gpu::read(particles.position), gpu::read(particles.id),
                       gpu::read(particles.attributes), gpu::read_write(known_), gpu::write(marks_),
                       gpu::write(exposure_)});
    record_range(commands, params, particles, grid, any_loose ? 0 : particles.moving, particles.count, push);
}

void Exposure::record_range(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                            const NeighborGrid& grid, std::uint32_t first, std::uint32_t end,
                            shared::ExposurePush push) const
{
    using gpu::read;
    for (; first < end; first += particles_a_dispatch) {
        push.first = first;
        push.count = std::min(end - first, particles_a_dispatch);
        commands.dispatch(kernel_, push.count, push,
                          {read(params), read(grid.cell_start), read(particles.position), read(particles.position),
                           read(particles.id), read(particles.attributes), gpu::write(exposure_),
                           read(particles.velocity), read(particles.velocity), read(marks_)});
    }
}

std::vector<glm::vec4> Exposure::download() const
{
    return gpu::download<glm::vec4>(*context_, exposure_, pool_);
}

} // namespace meltpoint::sim
