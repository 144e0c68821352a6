#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace meltpoint {

/// All bytes of a file that the user named. Only regular files of 1 byte to 2 GiB: a directory cannot be read, and a
/// pipe or a device might never end. Anything else is an Input error that names path and reason.
[[nodiscard]] std::vector<std::uint8_t> read_input_file(const std::filesystem::path& path);

/// "ply" of "scans/Horse.PLY"; empty where the name has none.
[[nodiscard]] std::string lower_extension(const std::filesystem::path& path);

} // namespace meltpoint
