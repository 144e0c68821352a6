#pragma once

#include <cstdint>

#include "gpu/buffer.h"
#include "particles/particle_set.h"

namespace meltpoint {

/// The particles on the device: one buffer an attribute, all of the same fixed length. The simulation keeps them sorted
/// by (cell, id), the moving ones before the still ones, so a particle's place changes from step to step and its id is
/// what names it.
struct ParticleBuffers {
    std::uint32_t count = 0;  ///< all of them: the pool
    std::uint32_t moving = 0; ///< the first so many; those behind them lie still
    gpu::Buffer id;           ///< uint
    gpu::Buffer attributes;   ///< uint: state, material and flags (shared/particle_state.h)
    gpu::Buffer position;     ///< vec4: x, y, z in m; w = weight (ParticleSet)
    gpu::Buffer velocity;     ///< vec4: m/s; w = mass in kg, of boundary particles its negative
    gpu::Buffer acceleration; ///< vec4: m/s^2; w unused
    gpu::Buffer density;      ///< float: kg/m^3
    gpu::Buffer pressure;     ///< float: Pa
    gpu::Buffer interaction;  ///< vec4: what the forces need of density and pressure (shared/sph_params.h)
};

/// Device memory of one particle in these buffers.
inline constexpr std::uint32_t particle_buffer_bytes =
    2 * sizeof(std::uint32_t) + 4 * sizeof(glm::vec4) + 2 * sizeof(float);

/// Allocates buffers for `count` particles with undefined content. Throws Device when they do not fit.
[[nodiscard]] ParticleBuffers make_particle_buffers(const gpu::Context& context, std::uint32_t count);

/// Copies a host set of exactly particles.count particles to the device, in its order.
void upload(const gpu::Context& context, const ParticleSet& set, const ParticleBuffers& particles);

/// Copies the particles to the host, in order of id.
[[nodiscard]] ParticleSet download(const gpu::Context& context, const ParticleBuffers& particles);

/// Copies the particles to the host in the order they lie in on the device, for tests that feed a pass's own input to
/// its twin.
[[nodiscard]] ParticleSet download_unordered(const gpu::Context& context, const ParticleBuffers& particles);

} // namespace meltpoint
