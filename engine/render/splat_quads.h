#pragma once

#include <cstdint>

#include "gpu/commands.h"
#include "gpu/kernel.h"
#include "primitives/prefix_scan.h"
#include "render/spheres.h"
#include "shared/render_params.h"

namespace meltpoint::render {

/// The passes that find the quads of splats (shared by those of all kinds and cameras).
class QuadKernels {
public:
    explicit QuadKernels(const gpu::Context& context);

private:
    friend class SplatQuads;

    gpu::Kernel sphere_;
    gpu::Kernel disc_;
    gpu::Kernel list_;
    primitives::PrefixScan scan_;
};

/// The quads that cover many splats of one kind on a camera's screen, and a list of those that are to be drawn: who has
/// no radius, is turned away, or is not on the screen is not. All is found on the device, and no vertices are spent on
/// them.
class SplatQuads {
public:
    explicit SplatQuads(const gpu::Context& context);

    /// Of the first `count` spheres; puffs of sand are not seen without `puffs`. Makes new buffers for more splats than
    /// ever before: then no frame may be under way. Throws Input where they are more than the device fetches, Device
    /// when the buffers do not fit.
    void record_spheres(gpu::Commands& commands, const QuadKernels& kernels, const shared::SplatCamera& camera,
                        const Spheres& spheres, std::uint32_t count, bool puffs);
    /// Of the first `count` discs (render/frame.h, DiscView).
    void record_discs(gpu::Commands& commands, const QuadKernels& kernels, const shared::SplatCamera& camera,
                      const gpu::Buffer& position, const gpu::Buffer& normal, std::uint32_t count);

    /// vec4, texels, two of each splat: the quad's (low x, low y, high x, high y) in ndc, and its depth four times.
    [[nodiscard]] const gpu::Buffer& quads() const { return quads_; }
    /// uint: the indices of those who are to be drawn, ascending.
    [[nodiscard]] const gpu::Buffer& list() const { return list_; }
    /// shared::DrawArguments of a draw of these.
    [[nodiscard]] const gpu::Buffer& arguments() const { return arguments_; }

private:
    void make_room(std::uint32_t count);
    void record_list(gpu::Commands& commands, const QuadKernels& kernels, std::uint32_t count);

    const gpu::Context* context_;
    std::uint32_t room_ = 0;
    gpu::Buffer quads_;
    gpu::Buffer flags_;
    gpu::Buffer starts_;
    gpu::Buffer scratch_;
    gpu::Buffer list_;
    gpu::Buffer arguments_;
};

} // namespace meltpoint::render
