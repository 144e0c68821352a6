#include "sim/visibility.h"

#include <cmath>

#include "core/error.h"
#include "gpu/transfer.h"
#include "shared/particle_state.h"
#include "spirv/sim/visibility_depth.comp.h"
#include "spirv/sim/visibility_query.comp.h"

namespace meltpoint::sim {

namespace {

constexpr double max_texels = 16.0 * 1024 * 1024; // 64 MiB
constexpr float least_texel = 0.125f;             // spacings: a particle covers a hundred of them
constexpr float most_texel = 2.0f;

} // namespace

shared::VisibilityParams visibility_params(const VisibilitySettings& settings, const shared::SphParams& params)
{
    const double length = glm::length(glm::dvec3(settings.direction));
    if (!(length > 0.0) || !std::isfinite(length)) {
        throw input_error("a direction of ({}, {}, {}) leads nowhere", settings.direction.x, settings.direction.y,
                          settings.direction.z);
    }
    if (!(settings.texel >= least_texel && settings.texel <= most_texel)) {
        throw input_error("texels of {} particle spacings were asked for; {} to {} are possible", settings.texel,
                          least_texel, most_texel);
    }
    const glm::dvec3 direction = glm::dvec3(settings.direction) / length;
    const glm::dvec3 aside = std::abs(direction.y) > 0.9 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 right = glm::normalize(glm::cross(direction, aside));
    const glm::dvec3 up = glm::cross(right, direction);

    const glm::dvec3 low(params.domain_min);
    const glm::dvec3 high(params.domain_max);
    const auto extent = [&](const glm::dvec3& axis) {
        return glm::dot(glm::abs(axis), high - low);
    };
    const glm::dvec3 origin =
        0.5 * (low + high) - 0.5 * (extent(right) * right + extent(up) * up + extent(direction) * direction);
    const double texel = static_cast<double>(settings.texel) * static_cast<double>(params.spacing);
    const double width = std::ceil(extent(right) / texel);
    const double height = std::ceil(extent(up) / texel);
    if (!(width * height <= max_texels)) {
        throw input_error(
            "a visibility map of {:.0f} x {:.0f} texels has more than {:.0f}: make the domain smaller, the "
            "particle spacing larger or the texels larger",
            width, height, max_texels);
    }
    return {.origin = origin,
            .texel = static_cast<float>(texel),
            .right = right,
            .depth_scale = static_cast<float>(static_cast<double>(shared::DEPTH_STEPS) / extent(direction)),
            .up = up,
            .spacing = params.spacing,
            .direction = direction,
            .casters = 1u << shared::STATE_SOLID | 1u << shared::STATE_COLLIDER |
                       (settings.fluid_casts ? 1u << shared::STATE_FLUID : 0u),
            .width = static_cast<std::uint32_t>(width),
            .height = static_cast<std::uint32_t>(height)};
}

Visibility::Visibility(const gpu::Context& context, const VisibilitySettings& settings, const shared::SphParams& params)
    : params_(visibility_params(settings, params)), depth_(context, "visibility_depth", sim_visibility_depth_comp),
      query_(context, "visibility_query", sim_visibility_query_comp),
      params_buffer_(gpu::make_buffer<shared::VisibilityParams>(context, 1, "visibility params")),
      map_(gpu::make_buffer<std::uint32_t>(context, std::size_t{params_.width} * params_.height, "visibility map")),
      visibility_(gpu::make_buffer<float>(context, params.pool_count, "visibility"))
{
    gpu::upload<shared::VisibilityParams>(context, params_buffer_, {&params_, 1});
}

void Visibility::record(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                        const gpu::Buffer& exposure) const
{
    using gpu::read;
    const gpu::Scope scope(commands, "visibility");
    commands.fill(map_, shared::NOTHING_SEEN);
    commands.dispatch(depth_, particles.count, gpu::NoPush{},
                      {read(params), read(params_buffer_), read(particles.position), read(particles.attributes),
                       gpu::read_write(map_)});
    commands.dispatch(query_, particles.count, gpu::NoPush{},
                      {read(params), read(params_buffer_), read(particles.position), read(particles.attributes),
                       read(particles.id), read(exposure), read(map_), gpu::write(visibility_)});
}

} // namespace meltpoint::sim
