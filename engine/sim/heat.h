#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/commands.h"
#include "particle_buffers/particle_buffers.h"
#include "shared/heat.h"
#include "sim/fluid_kernels.h"
#include "sim/neighbor_grid.h"

namespace meltpoint::sim {

/// The enthalpy of the particles, and how it flows between them (shared/heat.h). It does not tell solids from fluids
/// but by their enthalpy: whoever changes states does so between two calls, and whoever adds energy adds it to
/// enthalpy() with two_float_add (shared/two_float.h).
class Heat {
public:
    /// Steps of conduction that one call may take: beyond, there is more heat to follow than fluid.
    static constexpr std::uint32_t max_substeps = 256;

    /// params: of the simulation. enthalpy: J/kg, and attributes: both by id, of all particles. Throws Input where a
    /// material of a particle conducts and has no specific heat or, but for colliders, no rest density, or where one
    /// of its values is negative (the sentence names it).
    Heat(const gpu::Context& context, const FluidOptions& options, const shared::SphParams& params,
         const shared::HeatParams& heat, std::span<const std::uint32_t> attributes, std::span<const double> enthalpy);

    /// Conducts heat for `seconds`, in equal steps, between sorted particles that stay where they are meanwhile.
    /// Throws as substeps.
    void record_conduction(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                           const ParticleBuffers& particles, const NeighborGrid& grid, double seconds) const;

    /// s, the longest step of conduction: in it the fastest wave of a lattice is gone, of the material in which
    /// temperature spreads fastest, amid the best conductor that there is. An explicit step is unstable from twice as
    /// long on; what lies between is for particles that lie less evenly. Infinite where nothing conducts.
    [[nodiscard]] double longest_substep() const { return longest_substep_; }
    /// Steps of conduction that so many seconds take. Throws Input where they are more than max_substeps.
    [[nodiscard]] std::uint32_t substeps(double seconds) const;

    /// vec2: J/kg, by id, as two-floats.
    [[nodiscard]] const gpu::Buffer& enthalpy() const { return enthalpy_; }
    /// shared::HeatParams.
    [[nodiscard]] const gpu::Buffer& params() const { return params_; }
    /// J/kg, by id. Waits.
    [[nodiscard]] std::vector<double> download_enthalpy() const;

    /// Device memory of its own.
    [[nodiscard]] std::uint64_t device_bytes() const
    {
        return params_.size() + enthalpy_.size() + thermal_.size() + warm_cells_.size();
    }

private:
    const gpu::Context* context_;
    gpu::Kernel temperature_;
    gpu::Kernel conduction_;
    double longest_substep_;
    std::size_t count_; ///< particles
    gpu::Buffer params_;
    gpu::Buffer enthalpy_;
    gpu::Buffer thermal_;      ///< vec4 of shared/heat.h, in the particles' order
    gpu::Buffer warm_cells_;   ///< uint: a bit for each cell, warm_words a row
    float common_temperature_; ///< degrees C, of most particles
};

} // namespace meltpoint::sim
