#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/commands.h"
#include "particle_buffers/particle_buffers.h"
#include "shared/heat.h"
#include "shared/melting.h"
#include "sim/exposure.h"
#include "sim/heat.h"
#include "sim/visibility.h"

namespace meltpoint::sim {

/// What heat needs of a scene.
struct MeltingSettings {
    shared::HeatParams heat{};
    shared::MeltingParams params{};
    double time_scale = 1.0;      ///< seconds of heat in one of motion
    std::vector<double> enthalpy; ///< J/kg, of each particle at the start, by id
};

/// Heat, and whom it turns into fluid or back: at the looks of a simulation.
class Melting {
public:
    /// attributes: by id. Throws as Heat and Visibility.
    Melting(const gpu::Context& context, const FluidOptions& options, const shared::SphParams& params,
            const MeltingSettings& settings, const std::vector<std::uint32_t>& attributes);

    /// Where solids are seen by the sun: to be found out again, after the exposure, whenever others are solid.
    void record_surface(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                        const Exposure& exposure) const;

    /// What happened to heat in the `seconds` of motion since the last look: sun, air, conduction. Throws Input where
    /// that takes too many steps.
    void record_heat(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                     const ParticleBuffers& particles, const NeighborGrid& grid, const Exposure& exposure,
                     double seconds) const;

    /// Solids melt and fluid freezes at push.time, counted in `changes`, shared::PoolChanges: they lie among the others
    /// yet. When a solid melts is noted in release_time, by id.
    /// body_of: of loose solids (sim/fragments), null where there are none.
    void record_changes(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                        const NeighborGrid& grid, const gpu::Buffer& release_time, const gpu::Buffer& changes,
                        const shared::MeltPush& push, const gpu::Buffer* body_of = nullptr) const;

    /// s of motion, the longest from one look to the next: in it sun and air melt a twentieth of a particle. Infinite
    /// where neither melts anything.
    [[nodiscard]] double longest_look() const { return longest_look_; }

    [[nodiscard]] const Heat& heat() const { return heat_; }

    [[nodiscard]] std::uint64_t device_bytes() const;

private:
    double time_scale_;
    double longest_look_;
    Visibility visibility_;
    Heat heat_;
    gpu::Kernel warm_;
    gpu::Kernel melt_;
    gpu::Kernel freeze_;
    gpu::Buffer params_; ///< shared::MeltingParams
    gpu::Buffer before_; ///< float, by id: J/kg at the last look, of those who were solid then
};

} // namespace meltpoint::sim
