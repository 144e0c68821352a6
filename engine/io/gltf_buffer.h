#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace meltpoint {

/// The bytes that the URI of a buffer in the glTF file at `path` stands for: base64 in a "data:" URI, or a file in the
/// folder of the glTF file or below. Any other place, up the tree, absolute, through a link that leads out, on the
/// network, is an Input error that begins with the path, as is whatever cannot be read.
[[nodiscard]] std::vector<std::uint8_t> read_gltf_buffer(const std::string& uri, const std::filesystem::path& path);

} // namespace meltpoint
