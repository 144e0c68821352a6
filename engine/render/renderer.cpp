#include "render/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>

#include <volk.h>

#include "core/error.h"
#include "render/frame_params.h"
#include "spirv/render/disc.frag.h"
#include "spirv/render/disc.vert.h"
#include "spirv/render/floor.frag.h"
#include "spirv/render/line.frag.h"
#include "spirv/render/line.vert.h"
#include "spirv/render/resolve.frag.h"
#include "spirv/render/sand.frag.h"
#include "spirv/render/sand.vert.h"
#include "spirv/render/screen.vert.h"
#include "spirv/render/sphere.frag.h"
#include "spirv/render/sphere.vert.h"

namespace meltpoint::render {

namespace {

constexpr std::uint32_t max_samples = 4;
constexpr std::uint32_t shadow_size = 512; // texels
constexpr std::uint32_t box_edges = 12;
constexpr std::size_t light_view = 0;
constexpr std::size_t camera_view = 1;
constexpr VkFormat visibility_format = VK_FORMAT_R32_UINT;
constexpr VkFormat depth_format = VK_FORMAT_D32_SFLOAT;
constexpr VkFormat picture_format = VK_FORMAT_R8G8B8A8_SRGB;

std::uint32_t check_samples(std::uint32_t samples)
{
    if (samples == 0 || samples > max_samples) {
        throw input_error("a pixel is to be averaged over {0} x {0} samples; 1 to {1} along each side are allowed",
                          samples, max_samples);
    }
    return samples;
}

/// size * samples without overflow; too large sizes stay too large.
std::uint32_t times(std::uint32_t size, std::uint32_t samples)
{
    return static_cast<std::uint32_t>(
        std::min<std::uint64_t>(std::uint64_t{size} * samples, std::numeric_limits<std::uint32_t>::max()));
}

void check_count(std::uint32_t count, const char* what)
{
    if (count > max_splats) {
        throw input_error("{} {} were to be drawn; at most {} are allowed", count, what, max_splats);
    }
}

} // namespace

Renderer::Renderer(const gpu::Context& context, std::uint32_t width, std::uint32_t height, std::uint32_t samples)
    : context_(&context), width_(width), height_(height), samples_(check_samples(samples)),
      shadow_map_(context, shadow_size, shadow_size, depth_format,
                  VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT, "shadow map"),
      visibility_(context, times(width, samples), times(height, samples), visibility_format,
                  VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT, "visibility"),
      depth_(context, times(width, samples), times(height, samples), depth_format,
             VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT, "depth"),
      picture_(context, width, height, picture_format,
               VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT, "picture"),
      only_floor_(context, width, height, depth_format, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT, "only floor"),
      params_(gpu::make_buffer<shared::RenderParams>(context, 1, "render parameters")),
      readback_(context, VkDeviceSize{4} * width * height, gpu::MemoryUse::Readback, "picture read-back"),
      spheres_(context), quad_kernels_(context), sphere_quads_{SplatQuads(context), SplatQuads(context)},
      disc_quads_{SplatQuads(context), SplatQuads(context)},
      sphere_shadow_(context, "sphere shadow", {render_sphere_vert, render_sphere_frag, {}, depth_format}),
      disc_shadow_(context, "disc shadow", {render_disc_vert, render_disc_frag, {}, depth_format}),
      sand_shadow_(context, "sand shadow", {render_sand_vert, render_sand_frag, {}, depth_format}),
      sphere_(context, "sphere", {render_sphere_vert, render_sphere_frag, {visibility_format}, depth_format}),
      disc_(context, "disc", {render_disc_vert, render_disc_frag, {visibility_format}, depth_format}),
      sand_(context, "sand", {render_sand_vert, render_sand_frag, {visibility_format}, depth_format}),
      line_(context, "line", {render_line_vert, render_line_frag, {visibility_format}, depth_format}),
      floor_(context, "floor", {render_screen_vert, render_floor_frag, {picture_format}, depth_format, {{0, samples}}}),
      resolve_(context, "resolve",
               {render_screen_vert, render_resolve_frag, {picture_format}, depth_format, {{0, samples}}}),
      resolve_sand_(context, "resolve with sand",
                    {render_screen_vert, render_resolve_frag, {picture_format}, depth_format, {{0, samples}, {1, 1}}}),
      transfers_(context)
{
}

void Renderer::write_params(gpu::Commands& commands, const shared::RenderParams& params)
{
    // Written by the device in the command's own order, so that frames in flight never see each other's parameters.
    static_assert(sizeof(params) <= 65536 && sizeof(params) % 4 == 0, "the limits of vkCmdUpdateBuffer");
    commands.use(params_, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, true);
    commands.flush_barriers();
    context_->vk().vkCmdUpdateBuffer(commands.handle(), params_.handle(), 0, sizeof(params), &params);
}

void Renderer::draw(gpu::Commands& commands, const Frame& frame)
{
    const std::uint32_t spheres = frame.particles ? frame.particles->count : 0;
    const std::uint32_t discs = frame.discs ? frame.discs->count : 0;
    const std::uint32_t quads = frame.sand ? frame.sand->quads : 0;
    check_count(spheres, "particles");
    check_count(discs, "discs");
    check_count(2 * quads, "triangles of sand");
    shared::RenderParams params = frame_params(frame.settings, width_, height_, samples_, shadow_size);
    const bool knows_when_freed = frame.particles && frame.particles->freed_at != nullptr;
    params.time = frame.particles ? frame.particles->time : 0.0f;
    params.sized = frame.particles && frame.particles->size != nullptr ? 1 : 0;
    params.blend_time = knows_when_freed ? frame.settings.blend_time : 0.0f;
    const gpu::Scope scope(commands, "render");
    write_params(commands, params);
    last_camera_ = params.camera;
    if (spheres > 0) {
        spheres_.record(commands, params_, *frame.particles);
    }

    const auto splats = [&](const gpu::GraphicsPipeline& sphere, const gpu::GraphicsPipeline& disc,
                            const gpu::GraphicsPipeline& sand, std::size_t view) {
        const shared::SplatCamera& camera = view == light_view ? params.light : params.camera;
        const shared::SplatPush push{camera};
        std::vector<gpu::Draw> draws;
        if (spheres > 0) {
            SplatQuads& found = sphere_quads_[view];
            found.record_spheres(commands, quad_kernels_, camera, spheres_, spheres, view == camera_view);
            draws.push_back({.pipeline = &sphere,
                             .push = gpu::push_bytes(push),
                             .bindings = {spheres_.sphere(), found.quads(), found.list(), spheres_.look(),
                                          frame.particles->id != nullptr ? *frame.particles->id : found.list()},
                             .arguments = &found.arguments()});
        }
        if (discs > 0) {
            const DiscView& its = *frame.discs;
            SplatQuads& found = disc_quads_[view];
            found.record_discs(commands, quad_kernels_, camera, its.position, its.normal, discs);
            draws.push_back({.pipeline = &disc,
                             .push = gpu::push_bytes(push),
                             .bindings = {its.position, its.normal, its.bend, its.color, found.quads(), found.list()},
                             .arguments = &found.arguments()});
        }
        if (quads > 0) {
            draws.push_back({.pipeline = &sand,
                             .vertices = quads * shared::VERTICES_PER_QUAD,
                             .push = gpu::push_bytes(push),
                             .bindings = {frame.sand->view, frame.sand->corner}});
        }
        return draws;
    };

    if (params.shadows != 0) {
        const gpu::Scope shadow(commands, "shadow map");
        const gpu::Targets targets{.colors = {}, .depth = gpu::DepthTarget{&shadow_map_}};
        gpu::record_draw_pass(commands, targets, splats(sphere_shadow_, disc_shadow_, sand_shadow_, light_view));
    }
    {
        const gpu::Scope visible(commands, "visible surface");
        std::vector<gpu::Draw> draws = splats(sphere_, disc_, sand_, camera_view);
        if (frame.settings.box && !frame.settings.bounds.empty()) {
            draws.push_back({&line_, box_edges * shared::VERTICES_PER_QUAD, {}, {params_}});
        }
        const gpu::Targets targets{.colors = {{&visibility_}}, .depth = gpu::DepthTarget{&depth_}};
        gpu::record_draw_pass(commands, targets, draws);
    }
    {
        const gpu::Scope resolve(commands, "resolve");
        const gpu::Buffer& none = spheres_.sphere(); // bound where there is nothing to look up, never indexed
        const gpu::Draw floor{&floor_, 3, {}, {params_, visibility_, shadow_map_}};
        const gpu::Draw surfaces{frame.sand ? &resolve_sand_ : &resolve_,
                                 3,
                                 {},
                                 {params_, visibility_, shadow_map_, spheres_.sphere(), spheres_.look(),
                                  frame.discs ? frame.discs->position : none, frame.discs ? frame.discs->normal : none,
                                  frame.discs ? frame.discs->color : none, frame.discs ? frame.discs->bend : none,
                                  frame.sand ? frame.sand->view : params_, frame.sand ? frame.sand->corner : none,
                                  frame.sand ? frame.sand->corner_tint : none}};
        const gpu::Targets targets{.colors = {{&picture_}}, .depth = gpu::DepthTarget{&only_floor_}};
        gpu::record_draw_pass(commands, targets, std::array{floor, surfaces});
    }
}

Image Renderer::capture()
{
    transfers_.begin();
    gpu::copy_to_buffer(transfers_, picture_, readback_);
    transfers_.submit();
    transfers_.wait();
    Image image{width_, height_, std::vector<std::uint8_t>(std::size_t{4} * width_ * height_)};
    std::memcpy(image.rgba.data(), readback_.mapped<std::uint8_t>().data(), image.rgba.size());
    return image;
}

std::vector<float> Renderer::capture_distance()
{
    const std::size_t count = std::size_t{depth_.extent().width} * depth_.extent().height;
    const gpu::Buffer staging(*context_, count * sizeof(float), gpu::MemoryUse::Readback, "depth read-back");
    transfers_.begin();
    gpu::copy_to_buffer(transfers_, depth_, staging);
    transfers_.submit();
    transfers_.wait();

    const std::span<const float> depth = staging.mapped<float>().first(count);
    std::vector<float> distance(count);
    const glm::vec2 map = last_camera_.depth_map;
    std::transform(depth.begin(), depth.end(), distance.begin(), [&](float value) {
        if (value <= 0.0f) {
            return std::numeric_limits<float>::infinity();
        }
        return last_camera_.orthographic != 0 ? (value - map.x) / map.y : map.y / (value - map.x);
    });
    return distance;
}

} // namespace meltpoint::render
