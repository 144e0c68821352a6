#pragma once

#include <cstddef>
#include <stdexcept>

#include <fmt/format.h>

#include "gpu/buffer.h"

namespace meltpoint::primitives {

/// Throws std::logic_error when a buffer holds fewer than `words` 32-bit words: shaders must not write past its end.
inline void require_words(const gpu::Buffer& buffer, std::size_t words)
{
    if (buffer.size() < words * sizeof(std::uint32_t)) {
        throw std::logic_error(fmt::format("buffer {} has {} bytes, but {} are needed", buffer.name(), buffer.size(),
                                           words * sizeof(std::uint32_t)));
    }
}

} // namespace meltpoint::primitives
