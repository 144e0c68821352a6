#include "sim/fluid_kernels.h"

#include <array>
#include <cstdint>

#include "core/error.h"
#include "gpu/commands.h"
#include "spirv/sim/boundary_weight.comp.h"
#include "spirv/sim/cell_key.comp.h"
#include "spirv/sim/count_neighbors.comp.h"
#include "spirv/sim/density.comp.h"
#include "spirv/sim/forces.comp.h"
#include "spirv/sim/gather.comp.h"
#include "spirv/sim/kick.comp.h"
#include "spirv/sim/kick_drift.comp.h"
#include "spirv/sim/partition_key.comp.h"
#include "spirv/sim/reorder.comp.h"
#include "spirv/sim/settle.comp.h"

namespace meltpoint::sim {

namespace {

constexpr std::uint32_t max_tile = 16;

std::uint32_t checked_tile(const gpu::DeviceInfo& device, std::uint32_t tile)
{
    if (tile > max_tile) {
        throw input_error("a tile of {} particles was asked for; 1 to {} are possible", tile, max_tile);
    }
    return tile == 0 ? default_tile(device) : tile;
}

} // namespace

std::array<gpu::SpecConstant, 10> fluid_constants(const gpu::DeviceInfo& device, const FluidOptions& options)
{
    // constant_id in shaders/. Tiles are for devices that fetch texels fast.
    const std::uint32_t tile = checked_tile(device, options.tile);
    return {{{0, options.kernel},
             {1, tile},
             {2, options.tension ? 1u : 0u},
             {3, tile > 1 ? 1u : 0u},
             {4, options.solver != shared::SOLVER_WCSPH ? 1u : 0u},
             {5, options.still ? 1u : 0u},
             {6, options.implicit_viscosity ? 1u : 0u},
             {8, options.mixed_viscosity ? 1u : 0u},
             {10, options.dimensions},
             {12, options.colliders ? 1u : 0u}}};
}

std::uint32_t default_tile(const gpu::DeviceInfo& device)
{
    return device.software() ? 4 : 1;
}

std::uint32_t tile_workgroups(const gpu::Context& context, const gpu::Kernel& kernel, const FluidOptions& options,
                              std::uint32_t particles)
{
    const std::uint32_t tile = checked_tile(context.info(), options.tile);
    const auto [x, y, z] = gpu::workgroups(context, kernel, (particles + tile - 1) / tile);
    return x * y * z;
}

FluidKernels::FluidKernels(const gpu::Context& context, const FluidOptions& options)
    : tile(checked_tile(context.info(), options.tile)),
      kick_drift(context, "kick_drift", sim_kick_drift_comp, fluid_constants(context.info(), options)),
      kick(context, "kick", sim_kick_comp, fluid_constants(context.info(), options)),
      cell_key(context, "cell_key", sim_cell_key_comp, fluid_constants(context.info(), options)),
      partition_key(context, "partition_key", sim_partition_key_comp),
      reorder(context, "reorder", sim_reorder_comp, fluid_constants(context.info(), options)),
      gather(context, "gather", sim_gather_comp), settle(context, "settle", sim_settle_comp),
      boundary_weight(context, "boundary_weight", sim_boundary_weight_comp, fluid_constants(context.info(), options)),
      density(context, "density", sim_density_comp, fluid_constants(context.info(), options)),
      forces(context, "forces", sim_forces_comp, fluid_constants(context.info(), options)),
      count_neighbors(context, "count_neighbors", sim_count_neighbors_comp, fluid_constants(context.info(), options))
{
}

} // namespace meltpoint::sim
