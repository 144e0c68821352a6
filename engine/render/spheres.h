#pragma once

#include <cstdint>

#include "gpu/commands.h"
#include "gpu/kernel.h"
#include "render/frame.h"

namespace meltpoint::render {

/// The spheres of a frame's particles, in their order: where they are and what they look like.
class Spheres {
public:
    explicit Spheres(const gpu::Context& context);

    /// params: shared::RenderParams of the frame. Makes new buffers for more particles than ever before. Throws Input
    /// where they are more than the device fetches, Device when the buffers do not fit.
    void record(gpu::Commands& commands, const gpu::Buffer& params, const ParticleView& particles);

    /// vec4, texels: center and radius in m, 0 of particles that are not to be seen.
    [[nodiscard]] const gpu::Buffer& sphere() const { return sphere_; }
    /// vec4, texels: linear RGB, and w is shared::GLOSS_*.
    [[nodiscard]] const gpu::Buffer& look() const { return look_; }

private:
    void make_room(std::uint32_t count);

    const gpu::Context* context_;
    gpu::Kernel look_kernel_;
    std::uint32_t room_ = 0;
    gpu::Buffer sphere_;
    gpu::Buffer look_;
};

} // namespace meltpoint::render
