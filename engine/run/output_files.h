#pragma once

#include <filesystem>

namespace meltpoint {

// What is asked of a path before a run writes a file there.

/// Throws an Input error where there is something already.
void refuse_existing(const std::filesystem::path& path);

/// Throws an Input error for a folder or a device, which is nothing to replace.
void refuse_special(const std::filesystem::path& path);

/// Throws Runtime where no file can be written: no permission, a read-only disk, a folder that is none, a name too
/// long. Leaves nothing behind and no folder made.
void refuse_unwritable(const std::filesystem::path& path);

/// Makes a folder and those above it, where it is missing and has a name. Throws Runtime where that fails.
void make_folder(const std::filesystem::path& folder);

} // namespace meltpoint
