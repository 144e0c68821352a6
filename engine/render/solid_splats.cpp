#include "render/solid_splats.h"

#include <array>

#include "gpu/transfer.h"
#include "spirv/render/bend_splat.comp.h"
#include "spirv/render/particle_splat.comp.h"
#include "spirv/render/solid_progress.comp.h"
#include "spirv/render/surface_splat.comp.h"

namespace meltpoint::render {

using gpu::read;
using gpu::read_write;
using gpu::write;

namespace {

/// include/candidate.glsl: software devices fetch texels faster.
std::array<gpu::SpecConstant, 1> texel_constants(const gpu::DeviceInfo& device)
{
    return {{{3, device.software() ? 1u : 0u}}};
}

} // namespace

SolidSplats::SolidSplats(const gpu::Context& context, const shared::SolidSplatParams& params,
                         std::span<const shared::HostedSplat> hosted, std::span<const std::uint32_t> cover,
                         glm::uvec2 sand_map)
    : pool_(static_cast<std::uint32_t>(cover.size())), hosted_count_(static_cast<std::uint32_t>(hosted.size())),
      progress_(context, "solid_progress", render_solid_progress_comp),
      particle_splat_(context, "particle_splat", render_particle_splat_comp, texel_constants(context.info())),
      bend_splat_(context, "bend_splat", render_bend_splat_comp),
      surface_splat_(context, "surface_splat", render_surface_splat_comp, texel_constants(context.info())),
      params_(gpu::make_buffer<shared::SolidSplatParams>(context, 1, "solid splat params")),
      hosted_(gpu::make_buffer<shared::HostedSplat>(context, hosted.size(), "hosted splats")),
      cover_(gpu::make_buffer<std::uint32_t>(context, pool_, "cover")),
      living_(gpu::make_texel_buffer(context, pool_, "living solids")),
      place_(gpu::make_buffer<std::uint32_t>(context, pool_, "place")),
      size_(gpu::make_buffer<float>(context, pool_, "ball size")),
      kept_(gpu::make_buffer<shared::KeptOfSolid>(context, pool_, "kept of solids"))
{
    if (sand_map.x > 0) {
        sand_.emplace(context, sand_map);
    }
    gpu::upload<shared::SolidSplatParams>(context, params_, {&params, 1});
    gpu::upload<shared::HostedSplat>(context, hosted_, hosted);
    gpu::upload<std::uint32_t>(context, cover_, cover);
    gpu::Commands commands(context);
    commands.begin();
    commands.fill(kept_, 0);
    commands.submit();
    commands.wait();
}

void SolidSplats::record(gpu::Commands& commands, const SolidView& view, const DiscBuffers& discs, std::uint32_t first)
{
    const gpu::Scope scope(commands, "solid splats");
    const ParticleBuffers& particles = view.particles;
    const shared::SolidSplatPush push{.time = static_cast<float>(view.time),
                                      .seconds = static_cast<float>(view.time - time_),
                                      .first_disc = first,
                                      .hosted = hosted_count_,
                                      .first_hosted = first + pool_};
    time_ = view.time;
    const gpu::Buffer& none = kept_; // bound where there is nothing to look up
    const auto or_none = [&](const gpu::Buffer* buffer) {
        return read(buffer != nullptr ? *buffer : none);
    };
    commands.dispatch(progress_, pool_, push,
                      {read(view.params), read(params_), read(particles.id), read(particles.attributes),
                       read(particles.position), read(particles.density), or_none(view.freed_at),
                       or_none(view.enthalpy), or_none(view.damage), write(living_), write(place_), write(size_)});
    if (sand_) {
        sand_->record(commands, *view.sand, particles, view.params, params_, place_, living_, size_, push.seconds);
    }
    if (hosted_count_ > 0) {
        commands.dispatch(surface_splat_, hosted_count_, push,
                          {read(view.params), read(view.cell_start), read(living_), read(living_), read_write(hosted_),
                           read(place_), read(kept_), write(discs.position()), write(discs.normal()),
                           write(discs.color()), write(discs.bend())});
    }
    commands.dispatch(particle_splat_, pool_, push,
                      {read(view.params), read(params_), read(view.cell_start), read(living_), read(living_),
                       read(particles.id), read(particles.attributes), read_write(kept_), read_write(size_),
                       read(hosted_), read(cover_), write(discs.position()), write(discs.normal()),
                       write(discs.color()), write(discs.bend())});
    commands.dispatch(bend_splat_, pool_, push,
                      {read(view.params), read(view.cell_start), read(living_), read(discs.position()),
                       read(discs.normal()), read_write(discs.bend())});
}

} // namespace meltpoint::render
