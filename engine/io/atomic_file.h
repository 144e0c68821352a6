#pragma once

#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace meltpoint {

/// A file that is either written whole or not at all: bytes go to a hidden file in the same folder, which commit()
/// renames to the path. Without commit(), by an error or an interrupted run, the path is as it was and the hidden file
/// is gone. Every failure is one Error (Runtime) that names the path: no permission, a full disk, a path that is a
/// folder or a device.
class AtomicFile {
public:
    explicit AtomicFile(std::filesystem::path path);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void write(std::span<const std::byte> bytes);
    void write(std::string_view text) { write(std::as_bytes(std::span(text))); }

    /// Replaces what is at the path. Nothing may be written afterwards.
    void commit();

private:
    [[noreturn]] void fail(int error_number) const;

    std::filesystem::path path_;
    std::filesystem::path temporary_path_;
    std::FILE* file_ = nullptr;
};

/// All bytes in one call.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

} // namespace meltpoint
