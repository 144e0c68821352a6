#pragma once

#include <cstddef>
#include <cstdint>

#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "gpu/context.h"
#include "gpu/kernel.h"

namespace meltpoint::primitives {

/// Exclusive prefix sum of uints, reduce-then-scan: sums of blocks, a scan over these, a scan within each block. Uses
/// no subgroup operations and assumes no subgroup size. Sums wrap at 2^32.
class PrefixScan {
public:
    /// `elements`: consecutive elements that each invocation scans serially, at least 1; by default what is fast on the
    /// device.
    explicit PrefixScan(const gpu::Context& context) : PrefixScan(context, default_elements(context)) {}
    /// With `elements` chosen by the caller.
    PrefixScan(const gpu::Context& context, std::uint32_t elements);

    /// More on software devices, where an invocation costs more than its work.
    [[nodiscard]] static std::uint32_t default_elements(const gpu::Context& context);

    /// Size of the scratch buffer, in 32-bit words, for up to `count` elements.
    [[nodiscard]] std::size_t scratch_words(std::uint32_t count) const;

    /// starts[i] = counts[0] + ... + counts[i - 1] for i in 0 .. count, so that the total is last. Any count from 0 on;
    /// three different buffers. Throws std::logic_error when one is too small.
    void record(gpu::Commands& commands, const gpu::Buffer& counts, const gpu::Buffer& starts, std::uint32_t count,
                const gpu::Buffer& scratch) const;

private:
    std::uint32_t elements_;
    gpu::Kernel reduce_;
    gpu::Kernel blocks_;
    gpu::Kernel apply_;
};

} // namespace meltpoint::primitives
