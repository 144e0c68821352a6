#include "sim/exposure.h"

#include <algorithm>

#include "gpu/transfer.h"
#include "particles/sph_kernel.h"
#include "shared/exposure.h"
#include "spirv/sim/exposure.comp.h"

namespace meltpoint::sim {

namespace {

constexpr std::uint32_t particles_a_dispatch = 1u << 18; // a third of a second on a software device

} // namespace

Exposure::Exposure(const gpu::Context& context, const FluidOptions& options, std::uint32_t pool)
    : context_(&context), pool_(pool),
      kernel_(context, "exposure", sim_exposure_comp, fluid_constants(context.info(), options)),
      exposure_(gpu::make_buffer<glm::vec4>(context, pool, "exposure")),
      scales_{.area_scale = static_cast<float>(exposed_area_scale(options.dimensions)),
              .filling_scale = static_cast<float>(solid_filling_scale(options.dimensions)),
              .faces = static_cast<float>(2 * options.dimensions)}
{
}

void Exposure::record_start(gpu::Commands& commands) const
{
    commands.fill(exposure_, 0);
}

void Exposure::record(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                      const NeighborGrid& grid, std::uint32_t first, std::uint32_t count) const
{
    const std::uint32_t still = particles.count - particles.moving;
    const std::uint32_t end = first + std::min(count, still - std::min(first, still));
    record_range(commands, params, particles, grid, particles.moving + first, particles.moving + end, false);
}

void Exposure::record_with_loose(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                                 const NeighborGrid& grid) const
{
    record_range(commands, params, particles, grid, 0, particles.count, true);
}

void Exposure::record_range(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                            const NeighborGrid& grid, std::uint32_t first, std::uint32_t end, bool any_loose) const
{
    using gpu::read;
    const gpu::Scope scope(commands, "exposure");
    for (; first < end; first += particles_a_dispatch) {
        const std::uint32_t portion = std::min(end - first, particles_a_dispatch);
        shared::ExposurePush push = scales_;
        push.first = first;
        push.count = portion;
        push.any_loose = any_loose ? 1 : 0;
        commands.dispatch(kernel_, portion, push,
                          {read(params), read(grid.cell_start), read(particles.position), read(particles.position),
                           read(particles.id), read(particles.attributes), gpu::write(exposure_),
                           read(particles.velocity), read(particles.velocity)});
    }
}

std::vector<glm::vec4> Exposure::download() const
{
    return gpu::download<glm::vec4>(*context_, exposure_, pool_);
}

} // namespace meltpoint::sim
