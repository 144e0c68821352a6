#include "render/spheres.h"

#include <algorithm>

#include "core/error.h"
#include "spirv/render/sphere_look.comp.h"

namespace meltpoint::render {

using gpu::read;
using gpu::write;

Spheres::Spheres(const gpu::Context& context)
    : context_(&context), look_kernel_(context, "sphere_look", render_sphere_look_comp)
{
    make_room(1); // to be bound where there are none
}

void Spheres::make_room(std::uint32_t count)
{
    const std::uint64_t most = context_->limits().maxTexelBufferElements;
    if (count > most) {
        throw input_error("{} particles were to be drawn, more than {} can fetch: at most {}", count,
                          context_->info().name, most);
    }
    sphere_ = gpu::make_texel_buffer(*context_, count, "spheres");
    look_ = gpu::make_texel_buffer(*context_, count, "looks");
    room_ = count;
}

void Spheres::record(gpu::Commands& commands, const gpu::Buffer& params, const ParticleView& particles)
{
    if (particles.count > room_) {
        make_room(particles.count);
    }
    const gpu::Scope scope(commands, "spheres");
    const bool knows_when_freed = particles.freed_at != nullptr;
    const gpu::Buffer& none = particles.position; // bound where there is nothing to look up, never indexed
    commands.dispatch(look_kernel_, particles.count, particles.count,
                      {read(params), read(particles.position), read(particles.velocity), read(particles.density),
                       read(particles.pressure), read(particles.attributes),
                       read(knows_when_freed ? *particles.id : none),
                       read(knows_when_freed ? *particles.freed_at : none),
                       read(particles.size != nullptr ? *particles.size : none), write(sphere_), write(look_)});
}

} // namespace meltpoint::render
