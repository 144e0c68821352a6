#include "render/splat_quads.h"

#include <algorithm>

#include "core/error.h"
#include "spirv/render/disc_quad.comp.h"
#include "spirv/render/sphere_quad.comp.h"
#include "spirv/render/splat_list.comp.h"

namespace meltpoint::render {

using gpu::read;
using gpu::write;

QuadKernels::QuadKernels(const gpu::Context& context)
    : sphere_(context, "sphere_quad", render_sphere_quad_comp), disc_(context, "disc_quad", render_disc_quad_comp),
      list_(context, "splat_list", render_splat_list_comp), scan_(context)
{
}

SplatQuads::SplatQuads(const gpu::Context& context)
    : context_(&context), arguments_(gpu::make_buffer<shared::DrawArguments>(context, 1, "draw arguments"))
{
}

void SplatQuads::make_room(std::uint32_t count)
{
    if (count <= room_) {
        return;
    }
    const std::uint64_t most = context_->limits().maxTexelBufferElements / 2;
    if (count > most) {
        throw input_error("{} splats were to be drawn, more than {} can fetch: at most {}", count,
                          context_->info().name, most);
    }
    const primitives::PrefixScan scan(*context_);
    quads_ = gpu::make_texel_buffer(*context_, 2 * std::size_t{count}, "splat quads");
    flags_ = gpu::make_buffer<std::uint32_t>(*context_, count, "splat flags");
    starts_ = gpu::make_buffer<std::uint32_t>(*context_, std::size_t{count} + 1, "splat starts");
    scratch_ =
        gpu::make_buffer<std::uint32_t>(*context_, std::max(scan.scratch_words(count), std::size_t{1}), "splat scan");
    list_ = gpu::make_buffer<std::uint32_t>(*context_, count, "splat list");
    room_ = count;
}

void SplatQuads::record_spheres(gpu::Commands& commands, const QuadKernels& kernels, const shared::SplatCamera& camera,
                                const Spheres& spheres, std::uint32_t count, bool puffs)
{
    make_room(count);
    const gpu::Scope scope(commands, "sphere quads");
    commands.dispatch(kernels.sphere_, count, shared::QuadPush{camera, count, puffs ? 1u : 0u},
                      {read(spheres.sphere()), read(spheres.look()), write(quads_), write(flags_)});
    record_list(commands, kernels, count);
}

void SplatQuads::record_discs(gpu::Commands& commands, const QuadKernels& kernels, const shared::SplatCamera& camera,
                              const gpu::Buffer& position, const gpu::Buffer& normal, std::uint32_t count)
{
    make_room(count);
    const gpu::Scope scope(commands, "disc quads");
    commands.dispatch(kernels.disc_, count, shared::QuadPush{camera, count, 1},
                      {read(position), read(normal), write(quads_), write(flags_)});
    record_list(commands, kernels, count);
}

void SplatQuads::record_list(gpu::Commands& commands, const QuadKernels& kernels, std::uint32_t count)
{
    kernels.scan_.record(commands, flags_, starts_, count, scratch_);
    commands.dispatch(kernels.list_, count, count, {read(flags_), read(starts_), write(list_), write(arguments_)});
}

} // namespace meltpoint::render
