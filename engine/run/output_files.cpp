#include "run/output_files.h"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include "core/error.h"
#include "io/atomic_file.h"

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

void refuse_unwritable(const std::filesystem::path& path)
{
    using std::filesystem::file_type;
    std::error_code error;
    std::filesystem::path there = path.has_parent_path() ? path.parent_path() : ".";
    while (there != "." && there.has_relative_path() && status(there, error).type() == file_type::not_found) {
        there = there.has_parent_path() ? there.parent_path() : "."; // the nearest folder above that there is
    }
    if (status(there / path.filename(), error).type() == file_type::none) {
        throw runtime_error("cannot write {}: {}", path.string(), error.message());
    }
    // A file without a name: nobody sees it, and whatever ends the program leaves nothing.
    const int file = open(there.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666);
    const int error_number = errno;
    if (file >= 0) {
        close(file);
    } else if (error_number == EOPNOTSUPP || error_number == EISDIR) { // this disk knows only files with names
        const AtomicFile trial(there / path.filename());
    } else {
        throw runtime_error("cannot write {}: {}", path.string(), std::generic_category().message(error_number));
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
