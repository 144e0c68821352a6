#include "primitives/prefix_scan.h"

#include <array>

#include "primitives/require_words.h"
#include "spirv/primitives/prefix_scan_apply.comp.h"
#include "spirv/primitives/prefix_scan_blocks.comp.h"
#include "spirv/primitives/prefix_scan_reduce.comp.h"

namespace meltpoint::primitives {

namespace {

// GPUs want many invocations and short strides between them; software devices long loops and few workgroups.
constexpr std::uint32_t elements_on_gpus = 16;
constexpr std::uint32_t elements_on_software = 256;

gpu::Kernel make_kernel(const gpu::Context& context, const char* name, std::span<const std::uint32_t> spirv,
                        std::uint32_t elements)
{
    const std::array constants{gpu::SpecConstant{.id = 0, .value = elements}};
    return {context, name, spirv, constants};
}

} // namespace

std::uint32_t PrefixScan::default_elements(const gpu::Context& context)
{
    return context.info().software() ? elements_on_software : elements_on_gpus;
}

PrefixScan::PrefixScan(const gpu::Context& context, std::uint32_t elements)
    : elements_(elements),
      reduce_(make_kernel(context, "prefix_scan_reduce", primitives_prefix_scan_reduce_comp, elements_)),
      blocks_(make_kernel(context, "prefix_scan_blocks", primitives_prefix_scan_blocks_comp, elements_)),
      apply_(make_kernel(context, "prefix_scan_apply", primitives_prefix_scan_apply_comp, elements_))
{
}

std::size_t PrefixScan::scratch_words(std::uint32_t count) const
{
    const std::size_t block = std::size_t{elements_} * apply_.shader().workgroup_size;
    return (count + block - 1) / block;
}

void PrefixScan::record(gpu::Commands& commands, const gpu::Buffer& counts, const gpu::Buffer& starts,
                        std::uint32_t count, const gpu::Buffer& scratch) const
{
    require_words(counts, count);
    require_words(starts, std::size_t{count} + 1);
    require_words(scratch, scratch_words(count));

    const std::uint32_t workgroup = apply_.shader().workgroup_size;
    const auto invocations = static_cast<std::uint32_t>(scratch_words(count)) * workgroup;
    commands.dispatch(reduce_, invocations, count, {read(counts), write(scratch)});
    commands.dispatch(blocks_, workgroup, count, {read_write(scratch), write(starts)});
    commands.dispatch(apply_, invocations, count, {read(counts), read(scratch), write(starts)});
}

} // namespace meltpoint::primitives
