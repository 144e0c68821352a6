#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/parallel_for.h"

namespace meltpoint {

/// A list of values for each of many items, of different lengths: made in parallel and stored almost without gaps.
template <class T>
class Lists {
public:
    Lists() = default;

    /// make(i, values) appends what belongs to item i, from several threads.
    template <class Make>
    Lists(std::size_t count, const Make& make) : blocks_((count + block_size - 1) / block_size)
    {
        parallel_for(blocks_.size(), [&](std::size_t b) {
            Block& block = blocks_[b];
            const std::size_t end = std::min((b + 1) * block_size, count);
            for (std::size_t i = b * block_size; i < end; ++i) {
                block.begin.push_back(static_cast<std::uint32_t>(block.values.size()));
                make(i, block.values);
            }
            block.begin.push_back(static_cast<std::uint32_t>(block.values.size()));
            block.values.shrink_to_fit();
        });
    }

    [[nodiscard]] std::span<const T> operator[](std::size_t i) const ///< list i
    {
        const Block& block = blocks_[i / block_size];
        const std::uint32_t begin = block.begin[i % block_size];
        return std::span(block.values).subspan(begin, block.begin[i % block_size + 1] - begin);
    }

private:
    static constexpr std::size_t block_size = 1024;

    struct Block {
        std::vector<T> values;
        std::vector<std::uint32_t> begin; ///< of each item's, and the end
    };

    std::vector<Block> blocks_;
};

} // namespace meltpoint
