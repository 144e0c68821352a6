#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace meltpoint {

/// A picture on the host: sRGB, 8 bits a channel, rows from top to bottom without padding.
struct Image {
    std::uint32_t width = 0;        ///< pixels
    std::uint32_t height = 0;       ///< pixels
    std::vector<std::uint8_t> rgba; ///< 4 * width * height bytes, alpha not premultiplied
};

} // namespace meltpoint
