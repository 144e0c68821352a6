#pragma once

#include <cstdint>
#include <filesystem>

#include <sys/types.h>

#include "core/image.h"

namespace meltpoint {

/// Encodes frames to a video by the ffmpeg program, to a file beside the wanted one, which finish() renames: the path
/// holds a whole video or what it held before.
class VideoWriter {
public:
    /// Throws Runtime when ffmpeg is not installed or cannot be started, Input for an ending that names no video
    /// format.
    VideoWriter(std::filesystem::path path, std::uint32_t width, std::uint32_t height, double frame_rate);
    /// Without finish() the unfinished file is removed.
    ~VideoWriter();
    VideoWriter(const VideoWriter&) = delete;
    VideoWriter& operator=(const VideoWriter&) = delete;

    /// Throws Runtime when ffmpeg has stopped (a full disk, an unknown codec).
    void add(const Image& frame);
    void finish();

private:
    int wait_for_encoder();

    std::filesystem::path path_;
    std::filesystem::path temporary_path_;
    pid_t encoder_ = -1;
    int pipe_ = -1;
};

} // namespace meltpoint
