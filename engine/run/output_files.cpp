#include "run/output_files.h"

#include <system_error>

#include "core/error.h"

namespace meltpoint {

void refuse_existing(const std::filesystem::path& path)
{
    std::error_code error;
    if (std::filesystem::exists(path, error)) {
        throw input_error("{} exists: give --force to replace it, or another place", path.string());
    }
}

void refuse_special(const std::filesystem::path& path)
{
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        throw input_error("{} is {}, not a file to be written", path.string(),
                          std::filesystem::is_directory(status) ? "a folder" : "a device, a pipe or a socket");
    }
}

void make_folder(const std::filesystem::path& folder)
{
    std::error_code error;
    if (!folder.empty() && !std::filesystem::create_directories(folder, error) && error) {
        throw runtime_error("cannot make the folder {}: {}", folder.string(), error.message());
    }
}

} // namespace meltpoint
