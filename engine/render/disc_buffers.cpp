#include "render/disc_buffers.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "gpu/transfer.h"

namespace meltpoint::render {

namespace {

/// Zero beyond the data.
gpu::Buffer to_device(const gpu::Context& context, std::span<const glm::vec4> data, std::size_t count,
                      const std::string& name)
{
    gpu::Buffer buffer = gpu::make_texel_buffer(context, count, name);
    gpu::Commands commands(context);
    commands.begin();
    commands.fill(buffer, 0);
    commands.submit();
    commands.wait();
    gpu::upload<glm::vec4>(context, buffer, data);
    return buffer;
}

} // namespace

DiscBuffers::DiscBuffers(const gpu::Context& context, std::span<const glm::vec4> position_radius,
                         std::span<const glm::vec4> normal, std::span<const glm::vec4> color, std::uint32_t room)
    : count_(static_cast<std::uint32_t>(position_radius.size()) + room),
      position_(to_device(context, position_radius, count_, "disc position")),
      normal_(to_device(context, normal, count_, "disc normal")),
      color_(to_device(context, color, count_, "disc color")), bend_(to_device(context, {}, count_, "disc bend"))
{
    if (normal.size() != position_radius.size() || color.size() != position_radius.size()) {
        throw std::logic_error("DiscBuffers: the arrays differ in length");
    }
}

std::uint64_t DiscBuffers::max_discs(const gpu::Context& context)
{
    constexpr std::uint64_t bytes_per_disc = 4 * sizeof(glm::vec4);
    const std::uint64_t by_binding = context.limits().maxStorageBufferRange / sizeof(glm::vec4);
    const std::uint64_t by_memory = context.info().memory_bytes / bytes_per_disc;
    const std::uint64_t by_texels = context.limits().maxTexelBufferElements;
    return std::min({by_binding, by_texels, by_memory, std::uint64_t{max_splats}});
}

} // namespace meltpoint::render
