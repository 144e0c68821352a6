#pragma once

#include <cstdint>

#include "gpu/buffer.h"
#include "gpu/commands.h"
#include "gpu/context.h"
#include "gpu/kernel.h"
#include "primitives/prefix_scan.h"

namespace meltpoint::primitives {

/// Sorts elements by (key, id). Ids being unique, the result is one and the same whatever the device and however its
/// atomics fall. Made for many keys with few elements each, such as the cells of a neighbor grid, and safe for any: a
/// crowded key goes to a radix sort, so that the time grows with the number of elements, not with its square.
class CountingSort {
public:
    /// What is sorted.
    struct Input {
        const gpu::Buffer& keys; ///< a uint for each element; elements whose key is key_count or more are left out
        const gpu::Buffer& ids;  ///< a uint for each element, unique within a key
        std::uint32_t count = 0; ///< elements
        std::uint32_t key_count = 0;
    };

    /// What comes out.
    struct Output {
        const gpu::Buffer&
            starts;               ///< key_count + 1: key k has the slots starts[k] .. starts[k + 1] - 1; last the total
        const gpu::Buffer& order; ///< count: slot -> index of the element
    };

    /// Working memory. The caller owns it; sorts recorded one after the other may share it.
    struct Scratch {
        gpu::Buffer counts;    ///< elements of each key
        gpu::Buffer unordered; ///< as order, but in any order within a key
        gpu::Buffer slot_ids;  ///< the ids of these elements
        gpu::Buffer crowded;   ///< list of the crowded keys
        gpu::Buffer scan;      ///< of the prefix scan
    };

    /// Compiles its kernels.
    explicit CountingSort(const gpu::Context& context);

    /// Working memory for sorts of up to `count` elements and `key_count` keys.
    [[nodiscard]] Scratch make_scratch(std::uint32_t count, std::uint32_t key_count) const;

    /// Records the passes. All buffers differ from each other. Throws std::logic_error when one is too small, having
    /// recorded nothing.
    void record(gpu::Commands& commands, const Input& input, const Output& output, const Scratch& scratch) const;

private:
    const gpu::Context* context_;
    PrefixScan scan_;
    gpu::Kernel count_;
    gpu::Kernel scatter_;
    gpu::Kernel order_;
    gpu::Kernel crowded_;
};

} // namespace meltpoint::primitives
