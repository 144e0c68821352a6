#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "commands.h"
#include "core/error.h"
#include "core/log.h"
#include "exit_codes.h"
#include "interrupt.h"
#include "run/run_scene.h"
#include "scene_options.h"

namespace meltpoint::program {

namespace {

struct RenderOptions {
    SceneOptions scene;
    std::string out;
    std::optional<std::uint32_t> frames;
    std::string size;
    std::string video;
    std::string particles;
    std::string stats;
    std::string forces;
    bool force = false;
};

/// "WxH" as the overrides of a scene, which is where the allowed sizes are known.
std::vector<std::string> size_overrides(const std::string& text)
{
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    const char* end = text.data() + text.size();
    const auto [after_width, width_error] = std::from_chars(text.data(), end, width);
    if (width_error == std::errc() && after_width != end && *after_width == 'x') {
        const auto [after_height, height_error] = std::from_chars(after_width + 1, end, height);
        if (height_error == std::errc() && after_height == end) {
            return {fmt::format("render.width={}", width), fmt::format("render.height={}", height)};
        }
    }
    throw input_error("--size {}: expected WIDTHxHEIGHT in pixels, as in 960x540", text);
}

/// A folder named after the scene, inside out/ whatever the name.
std::filesystem::path default_folder(const std::string& scene_name)
{
    std::string folder = scene_name;
    const auto is_awkward = [](char c) {
        return c == '/' || static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    };
    std::replace_if(folder.begin(), folder.end(), is_awkward, '_');
    return std::filesystem::path("out") / (folder == "." || folder == ".." ? "_" : folder);
}

int render(const RenderOptions& options, bool quiet)
{
    const InterruptGuard interrupt;
    SceneOptions scene_options = options.scene;
    if (options.frames) {
        scene_options.overrides.push_back(fmt::format("time.frames={}", *options.frames));
    }
    if (!options.size.empty()) {
        for (const std::string& text : size_overrides(options.size)) {
            scene_options.overrides.push_back(text);
        }
    }
    const Scene scene = load_scene(scene_options);
    const std::filesystem::path out =
        options.out.empty() ? default_folder(scene.name) : std::filesystem::path(options.out);

    const gpu::Context context(context_options(options.scene));
    const RunSummary summary = run_scene(context, scene,
                                         {.out = out,
                                          .video = options.video,
                                          .stats = options.stats,
                                          .forces = options.forces,
                                          .particles = !options.particles.empty(),
                                          .force = options.force,
                                          .quiet = quiet,
                                          .stop = &interrupt.flag()});
    fmt::print("{}: {} frames of {} particles, {:.4g} s simulated in {} steps, {:.1f} s\n", out.string(),
               summary.frames, summary.particles, summary.time, summary.steps, summary.seconds);
    require_silent_validation(context);
    if (summary.stopped) {
        log_warning(fmt::format("interrupted after {} of {} frames", summary.frames, scene.time.frames));
        return exit_interrupted;
    }
    return exit_done;
}

} // namespace

void add_render(CLI::App& app, const GlobalOptions& global, int& exit_code)
{
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command =
        app.add_subcommand("render", "Runs a scene without a window and writes its frames as PNG files");
    add_scene_options(*command, options->scene);
    command->add_option("--out", options->out, "Folder of the frames, made when missing [out/NAME of the scene]")
        ->type_name("DIR");
    command
        ->add_option("--frames", options->frames,
                     "Number of frames, the initial state included [the scene's time.frames]")
        ->type_name("N")
        ->check(CLI::Range(1u, 1'000'000u));
    command
        ->add_option("--size", options->size, "Size of the frames in pixels [the scene's render.width x render.height]")
        ->type_name("WxH");
    command->add_option("--video", options->video, "Also encodes a video by ffmpeg (.mp4, .mkv, .mov)")
        ->type_name("FILE");
    command
        ->add_option("--particles", options->particles, "Also writes particles_NNNN beside each frame, in this format")
        ->type_name("ply")
        ->check(CLI::IsMember({"ply"}));
    command
        ->add_option("--stats", options->stats, "Also writes a table, one row a frame, SI units (README, Statistics)")
        ->type_name("FILE.csv");
    command
        ->add_option("--forces", options->forces,
                     "Also writes the forces of fluid on each collider, one row a frame and collider, N and N m "
                     "(README, Forces)")
        ->type_name("FILE.csv");
    command->add_flag("--force", options->force, "Replaces existing output");
    command->callback([options, &global, &exit_code] { exit_code = render(*options, global.quiet); });
}

} // namespace meltpoint::program
