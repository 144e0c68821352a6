#pragma once

#include <cstdint>
#include <span>

#include <glm/glm.hpp>

#include "gpu/buffer.h"
#include "render/frame.h"

namespace meltpoint::render {

/// Surface splats on the device, which it owns; DiscView says what each array holds.
class DiscBuffers {
public:
    /// Uploads and waits. All arrays have the same length; at most max_discs(context). Throws Device when memory does
    /// not suffice.
    DiscBuffers(const gpu::Context& context, std::span<const glm::vec4> position_radius,
                std::span<const glm::vec4> normal, std::span<const glm::vec4> color);

    [[nodiscard]] DiscView view() const { return {position_, normal_, color_, count_}; }

    /// How many the device's buffers can hold.
    [[nodiscard]] static std::uint64_t max_discs(const gpu::Context& context);

private:
    std::uint32_t count_;
    gpu::Buffer position_;
    gpu::Buffer normal_;
    gpu::Buffer color_;
};

} // namespace meltpoint::render
