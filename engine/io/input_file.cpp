#include "io/input_file.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <system_error>

#include "core/error.h"

namespace meltpoint {

namespace {

constexpr std::uintmax_t largest_file = std::uintmax_t{2} << 30; // bytes

} // namespace

std::vector<std::uint8_t> read_input_file(const std::filesystem::path& path)
{
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) {
        throw input_error("{}: there is no such file", path.string());
    }
    if (std::filesystem::is_directory(status)) {
        throw input_error("{}: this is a directory, not a file", path.string());
    }
    if (!std::filesystem::is_regular_file(status)) {
        throw input_error("{}: this is not a regular file", path.string());
    }
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error) {
        throw input_error("{}: cannot be read ({})", path.string(), error.message());
    }
    if (size == 0) {
        throw input_error("{}: the file is empty", path.string());
    }
    if (size > largest_file) {
        throw input_error("{}: the file has {} bytes, at most {} are supported", path.string(), size, largest_file);
    }
    std::vector<std::uint8_t> bytes(size);
    std::ifstream file(path, std::ios::binary);
    if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))) {
        throw input_error("{}: cannot be read", path.string());
    }
    return bytes;
}

std::string lower_extension(const std::filesystem::path& path)
{
    std::string extension = path.extension().string();
    extension.erase(0, std::min<std::size_t>(extension.size(), 1)); // the dot
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

} // namespace meltpoint
