#include "primitives/counting_sort.h"

#include "core/error.h"
#include "primitives/require_words.h"
#include "shared/counting_sort.h"
#include "spirv/primitives/counting_sort_count.comp.h"
#include "spirv/primitives/counting_sort_crowded.comp.h"
#include "spirv/primitives/counting_sort_order.comp.h"
#include "spirv/primitives/counting_sort_scatter.comp.h"

namespace meltpoint::primitives {

namespace {

/// So many keys can be crowded at once.
std::uint32_t most_crowded(std::uint32_t count)
{
    return count / (shared::CROWDED_KEY + 1);
}

/// Words of the list of crowded keys with its head.
std::size_t crowded_words(std::uint32_t count)
{
    return sizeof(shared::CrowdedKeys) / sizeof(std::uint32_t) + most_crowded(count);
}

/// Throws unless the device launches so many workgroups at once: one for each crowded key. It does up to 33 million
/// elements, and mostly far beyond.
void require_workgroups(const gpu::Context& context, std::uint32_t workgroups)
{
    const std::uint32_t most = context.limits().maxComputeWorkGroupCount[0];
    if (workgroups > most) {
        throw device_error("{} sorts at most {} elements at once", context.info().name,
                           std::uint64_t{most} * (shared::CROWDED_KEY + 1));
    }
}

/// An empty list, and no workgroups for the keys that will be on it.
void clear_crowded(gpu::Commands& commands, const gpu::Buffer& crowded)
{
    commands.fill(crowded, 1, sizeof(shared::CrowdedKeys));
    commands.fill(crowded, 0, sizeof(shared::CrowdedKeys::count));
}

} // namespace

CountingSort::CountingSort(const gpu::Context& context)
    : context_(&context), scan_(context), count_(context, "counting_sort_count", primitives_counting_sort_count_comp),
      scatter_(context, "counting_sort_scatter", primitives_counting_sort_scatter_comp),
      order_(context, "counting_sort_order", primitives_counting_sort_order_comp),
      crowded_(context, "counting_sort_crowded", primitives_counting_sort_crowded_comp)
{
}

CountingSort::Scratch CountingSort::make_scratch(std::uint32_t count, std::uint32_t key_count) const
{
    const auto words = [&](std::size_t size, const char* name) {
        return gpu::make_buffer<std::uint32_t>(*context_, size, name);
    };
    return {.counts = words(key_count, "counting sort: counts"),
            .unordered = words(count, "counting sort: unordered"),
            .slot_ids = words(count, "counting sort: ids"),
            .crowded = words(crowded_words(count), "counting sort: crowded keys"),
            .scan = words(scan_.scratch_words(key_count), "counting sort: scan")};
}

void CountingSort::record(gpu::Commands& commands, const Input& input, const Output& output,
                          const Scratch& scratch) const
{
    const auto& [keys, ids, count, key_count] = input;
    const auto& [starts, order] = output;
    require_words(keys, count);
    require_words(ids, count);
    require_words(starts, std::size_t{key_count} + 1);
    require_words(order, count);
    require_words(scratch.counts, key_count);
    require_words(scratch.unordered, count);
    require_words(scratch.slot_ids, count);
    require_words(scratch.crowded, crowded_words(count));
    require_words(scratch.scan, scan_.scratch_words(key_count));
    require_workgroups(*context_, most_crowded(count));

    const shared::CountingSortParams params{.count = count, .key_count = key_count};
    if (key_count > 0) {
        commands.fill(scratch.counts, 0, VkDeviceSize{key_count} * sizeof(std::uint32_t));
    }
    clear_crowded(commands, scratch.crowded);
    commands.dispatch(count_, count, params, {read(keys), read_write(scratch.counts)});
    scan_.record(commands, scratch.counts, starts, key_count, scratch.scan);
    commands.dispatch(scatter_, count, params,
                      {read(keys), read(ids), read(starts), read_write(scratch.counts), write(scratch.unordered),
                       write(scratch.slot_ids)});
    commands.dispatch(order_, count, params,
                      {read(keys), read(starts), read(scratch.unordered), read(scratch.slot_ids), write(order),
                       read_write(scratch.crowded)});
    commands.dispatch_indirect(
        crowded_, scratch.crowded, 0, gpu::NoPush{},
        {read(ids), read(starts), read_write(scratch.unordered), read_write(order), read(scratch.crowded)});
}

} // namespace meltpoint::primitives
