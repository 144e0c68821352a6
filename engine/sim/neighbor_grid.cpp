#include "sim/neighbor_grid.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/error.h"

namespace meltpoint::sim {

namespace {

constexpr double max_cells = 16.0 * 1024 * 1024; // 64 MiB of starts: more would cost more than the particles themselves

std::uint32_t checked_cell_count(const glm::uvec3& size)
{
    const double cells = static_cast<double>(size.x) * size.y * size.z;
    if (cells > max_cells) {
        throw input_error("the domain has {} x {} x {} grid cells, more than {:.0f}: make it smaller or the particle "
                          "spacing larger",
                          size.x, size.y, size.z, max_cells);
    }
    return size.x * size.y * size.z;
}

std::size_t neighbor_bit_words(const gpu::Context& context, std::uint32_t particle_count)
{
    const std::size_t most = context.limits().maxStorageBufferRange / sizeof(std::uint32_t);
    return std::min(most, std::size_t{particle_count} * NeighborGrid::neighbor_words);
}

} // namespace

glm::uvec3 grid_size(const glm::vec3& domain_min, const glm::vec3& domain_max, float support_radius)
{
    const glm::vec3 cell(support_radius / static_cast<float>(shared::CELLS_PER_SUPPORT_X), support_radius,
                         support_radius);
    return glm::max(glm::uvec3(glm::ceil((domain_max - domain_min) / cell)), glm::uvec3(1));
}

NeighborGrid::NeighborGrid(const gpu::Context& context, std::uint32_t particle_count, const glm::uvec3& size,
                           bool has_still)
    : cell_count(checked_cell_count(size)), still(has_still), sort(context),
      key(gpu::make_buffer<std::uint32_t>(context, particle_count, "cell key")),
      order(gpu::make_buffer<std::uint32_t>(context, particle_count, "sorted order")),
      cell_start(
          gpu::make_buffer<std::uint32_t>(context, (has_still ? 2 * cell_count + 1 : cell_count) + 1, "cell start")),
      scratch(sort.make_scratch(particle_count, has_still ? 2 * cell_count + 1 : cell_count)),
      sorted_id(gpu::make_buffer<std::uint32_t>(context, particle_count, "id")),
      sorted_attributes(gpu::make_buffer<std::uint32_t>(context, particle_count, "attributes")),
      sorted_position(gpu::make_texel_buffer(context, particle_count, "position")),
      sorted_velocity(gpu::make_texel_buffer(context, particle_count, "velocity")),
      spare(gpu::make_buffer<float>(context, particle_count, "spare")),
      neighbor_bits(
          gpu::make_buffer<std::uint32_t>(context, neighbor_bit_words(context, particle_count), "neighbor bits"))
{
}

namespace {

/// Particles in the order of the last sort: the first `count`. Swaps their buffers with the grid's.
void record_reorder(gpu::Commands& commands, const FluidKernels& kernels, ParticleBuffers& particles,
                    NeighborGrid& grid, std::uint32_t count)
{
    using gpu::read;
    using gpu::write;
    const gpu::Scope scope(commands, "reorder");
    commands.dispatch(kernels.reorder, count, count,
                      {read(grid.order), read(particles.id), read(particles.attributes), read(particles.position),
                       read(particles.position), read(particles.velocity), read(particles.velocity),
                       write(grid.sorted_id), write(grid.sorted_attributes), write(grid.sorted_position),
                       write(grid.sorted_velocity)});
    std::swap(particles.id, grid.sorted_id);
    std::swap(particles.attributes, grid.sorted_attributes);
    std::swap(particles.position, grid.sorted_position);
    std::swap(particles.velocity, grid.sorted_velocity);
}

} // namespace

void record_gather(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& order,
                   const gpu::Buffer& source, const gpu::Buffer& target, shared::GatherPush push)
{
    commands.dispatch(kernels.gather, push.count, push, {gpu::read(order), gpu::read(source), gpu::write(target)});
}

void record_partition(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                      ParticleBuffers& particles, NeighborGrid& grid)
{
    const std::uint32_t count = particles.count;
    {
        const gpu::Scope scope(commands, "partition");
        commands.dispatch(kernels.partition_key, count, gpu::NoPush{},
                          {read(params), read(particles.position), read(particles.attributes), gpu::write(grid.key)});
        grid.sort.record(commands, {grid.key, particles.id, count, 2 * grid.cell_count + 1},
                         {grid.cell_start, grid.order}, grid.scratch);
    }
    record_reorder(commands, kernels, particles, grid, count);
    if (particles.moving == 0) {
        return;
    }
    const gpu::Scope scope(commands, "carry"); // of the moving ones: those who were still have nothing of it
    const std::uint32_t moving = particles.moving;
    record_gather(commands, kernels, grid.order, particles.acceleration, particles.interaction, {moving, 4});
    commands.copy(particles.interaction, particles.acceleration, moving * sizeof(glm::vec4));
    for (gpu::Buffer* values : {&particles.density, &particles.pressure}) {
        record_gather(commands, kernels, grid.order, *values, grid.spare, {moving, 1});
        commands.copy(grid.spare, *values, moving * sizeof(float));
    }
}

void record_settle(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                   const ParticleBuffers& particles, const NeighborGrid& grid)
{
    using gpu::read;
    using gpu::write;
    if (particles.count == particles.moving) {
        return;
    }
    const gpu::Scope scope(commands, "settle");
    commands.dispatch(kernels.settle, particles.count - particles.moving, gpu::NoPush{},
                      {read(params), read(particles.position), read(particles.attributes),
                       write(particles.acceleration), write(particles.density), write(particles.pressure),
                       write(particles.interaction)});
    for (const auto& [from, to] : {std::pair{&particles.id, &grid.sorted_id},
                                   {&particles.attributes, &grid.sorted_attributes},
                                   {&particles.position, &grid.sorted_position},
                                   {&particles.velocity, &grid.sorted_velocity}}) {
        const VkDeviceSize element = from->size() / particles.count;
        const VkDeviceSize first = element * particles.moving;
        commands.copy(*from, *to, from->size() - first, first, first);
    }
}

void record_sort(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                 ParticleBuffers& particles, NeighborGrid& grid)
{
    using gpu::read;
    using gpu::write;
    {
        const gpu::Scope scope(commands, "cell key");
        commands.dispatch(kernels.cell_key, particles.moving, gpu::NoPush{},
                          {read(params), read(particles.position), read(particles.position), write(grid.key)});
    }
    {
        const gpu::Scope scope(commands, "sort");
        grid.sort.record(commands, {grid.key, particles.id, particles.moving, grid.cell_count},
                         {grid.cell_start, grid.order}, grid.scratch);
    }
    record_reorder(commands, kernels, particles, grid, particles.moving);
}

} // namespace meltpoint::sim
