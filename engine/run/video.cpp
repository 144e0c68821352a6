#include "run/video.h"

#include <array>
#include <csignal>
#include <cstring>
#include <string>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "core/error.h"

extern char** environ; // NOLINT(readability-redundant-declaration): POSIX wants it declared here

namespace meltpoint {

namespace {

std::filesystem::path partial_path(const std::filesystem::path& path)
{
    return path.parent_path() / fmt::format(".{}.partial{}", path.stem().string(), path.extension().string());
}

std::vector<std::string> ffmpeg_arguments(const std::filesystem::path& output, std::uint32_t width,
                                          std::uint32_t height, double frame_rate)
{
    return {"ffmpeg", "-y", "-loglevel", "error",
            "-xerror", // or a disk that fills up while the file is closed would still end in exit code 0
            "-f", "rawvideo", "-pixel_format", "rgba", "-video_size", fmt::format("{}x{}", width, height), "-framerate",
            fmt::format("{}", frame_rate), "-i", "-",
            // Most players want even sizes and 4:2:0 chroma.
            "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", "-crf", "18", "-movflags", "+faststart",
            "file:" + output.string()}; // or ffmpeg would take a colon in a path for the end of a protocol's name
}

} // namespace

VideoWriter::VideoWriter(std::filesystem::path path, std::uint32_t width, std::uint32_t height, double frame_rate)
    : path_(std::move(path)), temporary_path_(partial_path(path_))
{
    const std::string ending = path_.extension().string();
    if (ending != ".mp4" && ending != ".mkv" && ending != ".mov") {
        throw input_error("--video {}: the ending \"{}\" is none of .mp4, .mkv, .mov", path_.string(), ending);
    }
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) {
        throw runtime_error("cannot open a pipe to ffmpeg: {}", std::strerror(errno));
    }
    posix_spawn_file_actions_t actions{};
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
    posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO); // stdout is for results
    posix_spawnattr_t attributes{};
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP); // a Ctrl-C is ours to handle, not the encoder's
    posix_spawnattr_setpgroup(&attributes, 0);

    const std::vector<std::string> arguments = ffmpeg_arguments(temporary_path_, width, height, frame_rate);
    std::vector<char*> argv;
    for (const std::string& argument : arguments) {
        argv.push_back(
            const_cast<char*>(argument.c_str())); // NOLINT(cppcoreguidelines-pro-type-const-cast): C interface
    }
    argv.push_back(nullptr);
    const int error = posix_spawnp(&encoder_, "ffmpeg", &actions, &attributes, argv.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    close(ends[0]);
    pipe_ = ends[1];
    if (error != 0) {
        close(pipe_);
        encoder_ = -1;
        throw runtime_error("--video needs the program ffmpeg, which cannot be started: {} (Debian package ffmpeg)",
                            std::strerror(error));
    }
}

VideoWriter::~VideoWriter()
{
    if (encoder_ > 0) {
        kill(encoder_, SIGKILL);
        wait_for_encoder();
    }
    std::error_code ignored;
    std::filesystem::remove(temporary_path_, ignored);
}

void VideoWriter::add(const Image& frame)
{
    const std::uint8_t* data = frame.rgba.data();
    std::size_t left = frame.rgba.size();
    while (left > 0) {
        const ssize_t written = write(pipe_, data, left);
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written <= 0) {
            wait_for_encoder();
            throw runtime_error("writing {} failed: ffmpeg stopped (its own message stands above)", path_.string());
        }
        data += written;
        left -= static_cast<std::size_t>(written);
    }
}

void VideoWriter::finish()
{
    const int status = wait_for_encoder();
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        throw runtime_error("writing {} failed: ffmpeg reported an error (its own message stands above)",
                            path_.string());
    }
    std::error_code error;
    std::filesystem::rename(temporary_path_, path_, error);
    if (error) {
        throw runtime_error("cannot write {}: {}", path_.string(), error.message());
    }
}

int VideoWriter::wait_for_encoder()
{
    close(pipe_);
    int status = 0;
    while (waitpid(encoder_, &status, 0) < 0 && errno == EINTR) {
    }
    encoder_ = -1;
    return status;
}

} // namespace meltpoint
