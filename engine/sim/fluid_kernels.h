#pragma once

#include <array>
#include <cstdint>

#include "gpu/kernel.h"
#include "shared/sph_params.h"

namespace meltpoint::sim {

/// What is compiled into the fluid's kernels as specialization constants.
struct FluidOptions {
    std::uint32_t solver = shared::SOLVER_WCSPH;
    std::uint32_t kernel = shared::KERNEL_PAPER;
    bool tension = false;     ///< of the paper, a look
    bool capillarity = false; ///< tension in SI units (sim/capillarity)
    bool colliders = false;   ///< there are boundary particles that tension must know of
    bool still = false;       ///< boundary particles stay where they are, out of the way of each step's passes
    bool xsph = false;
    bool confinement = false;
    bool shifting = false;
    bool implicit_viscosity = false; ///< solved for (sim/implicit_viscosity)
    bool mixed_viscosity = false;    ///< the fluids' materials differ in viscosity
    std::uint32_t dimensions = 3;    ///< or 2
    std::uint32_t tile = 0;          ///< particles an invocation, 1 to 16; 0 chooses for the device
};

/// Values of the specialization constants that shaders/ agree on. Throws Input when options.tile is out of range.
[[nodiscard]] std::array<gpu::SpecConstant, 10> fluid_constants(const gpu::DeviceInfo& device,
                                                                const FluidOptions& options);

/// 4 on software devices, where loading a candidate costs more than using it; 1 on GPUs.
[[nodiscard]] std::uint32_t default_tile(const gpu::DeviceInfo& device);

/// Workgroups of a pass of which each invocation owns a tile.
[[nodiscard]] std::uint32_t tile_workgroups(const gpu::Context& context, const gpu::Kernel& kernel,
                                            const FluidOptions& options, std::uint32_t particles);

/// One kernel a pass of the fluid step (shaders/sim).
struct FluidKernels {
    /// Throws Input when options.tile is out of range.
    FluidKernels(const gpu::Context& context, const FluidOptions& options);

    std::uint32_t tile;
    gpu::Kernel kick_drift;
    gpu::Kernel kick;
    gpu::Kernel cell_key;
    gpu::Kernel partition_key;
    gpu::Kernel reorder;
    gpu::Kernel gather;
    gpu::Kernel settle;
    gpu::Kernel boundary_weight;
    gpu::Kernel density;
    gpu::Kernel forces;
    gpu::Kernel count_neighbors;

    /// Invocations of a pass that owns a tile each.
    [[nodiscard]] std::uint32_t tiles(std::uint32_t particles) const { return (particles + tile - 1) / tile; }
};

} // namespace meltpoint::sim
