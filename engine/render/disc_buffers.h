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
    /// Uploads and waits. All arrays have the same length; with `room` for others, which are nowhere yet, at most
    /// max_discs(context). Throws Device when memory does not suffice.
    DiscBuffers(const gpu::Context& context, std::span<const glm::vec4> position_radius,
                std::span<const glm::vec4> normal, std::span<const glm::vec4> color, std::uint32_t room = 0);

    [[nodiscard]] DiscView view() const { return {position_, normal_, color_, bend_, count_}; }

    // Of all discs, for passes that place them. DiscView says what each holds.
    [[nodiscard]] const gpu::Buffer& position() const { return position_; }
    [[nodiscard]] const gpu::Buffer& normal() const { return normal_; }
    [[nodiscard]] const gpu::Buffer& color() const { return color_; }
    [[nodiscard]] const gpu::Buffer& bend() const { return bend_; }

    /// How many the device's buffers can hold.
    [[nodiscard]] static std::uint64_t max_discs(const gpu::Context& context);

private:
    std::uint32_t count_;
    gpu::Buffer position_;
    gpu::Buffer normal_;
    gpu::Buffer color_;
    gpu::Buffer bend_;
};

} // namespace meltpoint::render
