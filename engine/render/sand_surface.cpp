#include "render/sand_surface.h"

#include "gpu/transfer.h"
#include "shared/sand_surface.h"
#include "spirv/render/sand_column.comp.h"
#include "spirv/render/sand_cover.comp.h"
#include "spirv/render/sand_plane.comp.h"
#include "spirv/render/sand_surface.comp.h"

namespace meltpoint::render {

using gpu::read;
using gpu::read_write;
using gpu::write;

SandSurface::SandSurface(const gpu::Context& context, glm::uvec2 map)
    : texels_(map.x * map.y), corners_((map.x + 1) * (map.y + 1)),
      column_kernel_(context, "sand_column", render_sand_column_comp),
      plane_kernel_(context, "sand_plane", render_sand_plane_comp),
      surface_kernel_(context, "sand_surface", render_sand_surface_comp),
      cover_kernel_(context, "sand_cover", render_sand_cover_comp),
      column_(gpu::make_texel_buffer(context, texels_, "columns of sand")),
      tint_(gpu::make_texel_buffer(context, texels_, "colors of columns")),
      plane_(gpu::make_texel_buffer(context, texels_, "planes of sand")),
      corner_(gpu::make_texel_buffer(context, corners_, "sheet of sand")),
      corner_tint_(gpu::make_texel_buffer(context, corners_, "colors of the sheet"))
{
    gpu::Commands commands(context);
    commands.begin();
    for (const gpu::Buffer* kept : {&column_, &tint_, &corner_, &corner_tint_}) {
        commands.fill(*kept, 0);
    }
    commands.submit();
    commands.wait();
}

void SandSurface::record(gpu::Commands& commands, const SandView& view, const ParticleBuffers& particles,
                         const gpu::Buffer& params, const gpu::Buffer& splats, const gpu::Buffer& place,
                         const gpu::Buffer& living, const gpu::Buffer& size, float seconds)
{
    const gpu::Scope scope(commands, "sheet of sand");
    const shared::SandPush push{.seconds = seconds, .first = first_ ? 1u : 0u};
    first_ = false;
    commands.dispatch(column_kernel_, texels_, push,
                      {read(splats), read(view.view), read(view.ground), read(view.top_id), read(view.damage),
                       read(place), read(particles.attributes), read_write(column_), read_write(tint_)});
    commands.dispatch(plane_kernel_, texels_, gpu::NoPush{},
                      {read(params), read(view.view), read(column_), write(plane_)});
    commands.dispatch(surface_kernel_, corners_, push,
                      {read(params), read(view.view), read(column_), read(tint_), read(plane_), read_write(corner_),
                       read_write(corner_tint_)});
    commands.dispatch(cover_kernel_, particles.count, gpu::NoPush{},
                      {read(params), read(splats), read(view.view), read(corner_), read(particles.attributes),
                       read_write(living), read_write(size)});
}

} // namespace meltpoint::render
