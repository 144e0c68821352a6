#pragma once

#include <filesystem>

#include "core/image.h"

namespace meltpoint {

/// Writes an 8-bit sRGB PNG with alpha, whole or not at all (atomic_file.h). Compresses for speed: frames of a video
/// are many. Throws Error (Runtime) when the file cannot be written or the image's size and bytes disagree.
void write_png(const std::filesystem::path& path, const Image& image);

} // namespace meltpoint
