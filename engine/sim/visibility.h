#pragma once

#include <cstdint>

#include "gpu/commands.h"
#include "particle_buffers/particle_buffers.h"
#include "shared/sph_params.h"
#include "shared/visibility.h"

namespace meltpoint::sim {

/// What a visibility map is made with.
struct VisibilitySettings {
    glm::vec3 direction{0.0f, -1.0f, 0.0f}; ///< from the light, or with the wind, into the scene; of any length
    /// Side of a texel, in spacings. Half a spacing is small enough for each particle's shadow to be without a gap.
    float texel = 0.5f;
    bool fluid_casts = false; ///< fluid hides what is behind it, as solids and colliders do
};

/// The params of a map that covers the domain. Throws Input where the direction has no length, a texel is out of range
/// or the map would have too many of them.
[[nodiscard]] shared::VisibilityParams visibility_params(const VisibilitySettings& settings,
                                                         const shared::SphParams& params);

/// What of the solids is seen along a direction (shared/visibility.h): by the sun, or by the wind. What lies beyond the
/// domain hides nothing, nor do images behind its borders.
class Visibility {
public:
    /// Throws as visibility_params, and Device when its buffers do not fit.
    Visibility(const gpu::Context& context, const VisibilitySettings& settings, const shared::SphParams& params);

    /// Makes the map anew, and with it the visibility of the solids. `exposure` is that of Exposure.
    void record(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                const gpu::Buffer& exposure) const;

    /// By id: float, how much of a solid particle's surface is seen, 0 to 1; 0 of those inside. Of a particle that is
    /// no longer solid it is what it was last.
    [[nodiscard]] const gpu::Buffer& visibility() const { return visibility_; }

    /// shared::VisibilityParams and the map itself, uint a texel: for passes that include include/visibility.glsl.
    [[nodiscard]] const gpu::Buffer& params() const { return params_buffer_; }
    [[nodiscard]] const gpu::Buffer& map() const { return map_; }
    [[nodiscard]] glm::uvec2 size() const { return {params_.width, params_.height}; }
    [[nodiscard]] std::uint32_t texels() const { return params_.width * params_.height; }

    [[nodiscard]] std::uint64_t device_bytes() const { return visibility_.size() + map_.size(); }

private:
    shared::VisibilityParams params_;
    gpu::Kernel depth_;
    gpu::Kernel query_;
    gpu::Buffer params_buffer_;
    gpu::Buffer map_;
    gpu::Buffer visibility_;
};

} // namespace meltpoint::sim
