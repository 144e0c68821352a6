#include "io/atomic_file.h"

#include <atomic>
#include <cerrno>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "core/error.h"

namespace meltpoint {

namespace {

/// A name beside the path that no other thread or process uses.
std::filesystem::path hidden_neighbor(const std::filesystem::path& path)
{
    static std::atomic<unsigned> counter{0};
    // The name of the file is left out: with it, a name of the longest length allowed could not be written.
    return path.parent_path() / fmt::format(".meltpoint-{}-{}.part", getpid(), counter++);
}

} // namespace

AtomicFile::AtomicFile(std::filesystem::path path) : path_(std::move(path)), temporary_path_(hidden_neighbor(path_))
{
    std::error_code ignored;
    const std::filesystem::file_status status = std::filesystem::status(path_, ignored);
    if (std::filesystem::is_directory(status)) {
        fail(EISDIR);
    }
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status)) {
        throw runtime_error("cannot write {}: it is a device, a pipe or a socket, not a file", path_.string());
    }
    const int descriptor = open(temporary_path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0) {
        fail(errno);
    }
    file_ = fdopen(descriptor, "wb");
    if (file_ == nullptr) {
        const int error_number = errno;
        close(descriptor);
        unlink(temporary_path_.c_str());
        fail(error_number);
    }
}

AtomicFile::~AtomicFile()
{
    if (file_ != nullptr) {
        std::fclose(file_);
    }
    if (!temporary_path_.empty()) {
        unlink(temporary_path_.c_str());
    }
}

void AtomicFile::write(std::span<const std::byte> bytes)
{
    // An empty span may have no address, and fwrite must not be given a null one.
    if (!bytes.empty() && std::fwrite(bytes.data(), 1, bytes.size(), file_) != bytes.size()) {
        fail(errno);
    }
}

void AtomicFile::commit()
{
    // Closing writes what is still buffered: a full disk may only show here.
    if (std::fclose(std::exchange(file_, nullptr)) != 0) {
        fail(errno);
    }
    if (std::rename(temporary_path_.c_str(), path_.c_str()) != 0) {
        fail(errno);
    }
    temporary_path_.clear();
}

void AtomicFile::fail(int error_number) const
{
    throw runtime_error("cannot write {}: {}", path_.string(), std::generic_category().message(error_number));
}

void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes)
{
    AtomicFile file(path);
    file.write(bytes);
    file.commit();
}

} // namespace meltpoint
