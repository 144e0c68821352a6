// The report's pictures: frames of the built-in scenes.
#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "core/error.h"
#include "core/log.h"
#include "report/document.h"
#include "report/sections.h"
#include "run/mesh_scene.h"
#include "run/run_scene.h"

namespace meltpoint::report {

namespace {

struct Shot {
    std::uint32_t frame;
    std::string file; ///< in the report's folder
    std::string caption;
};

/// Pictures of one run.
struct Run {
    std::string scene;
    std::vector<std::string> overrides;
    std::vector<Shot> shots;
};

/// The frames of a run, which nobody asked for, gone in any case.
class ScratchFolder {
public:
    explicit ScratchFolder(std::filesystem::path path) : path_(std::move(path)) { remove(); }
    ~ScratchFolder() { remove(); }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

private:
    void remove() noexcept
    {
        std::error_code error;
        std::filesystem::remove_all(path_, error);
    }

    std::filesystem::path path_;
};

void take(const Workplace& workplace, const Run& run)
{
    const ScratchFolder frames(workplace.folder / ".frames");
    std::vector<std::string> overrides = run.overrides;
    overrides.push_back(fmt::format("time.frames={}", std::ranges::max(run.shots, {}, &Shot::frame).frame + 1));
    log_info(fmt::format("{}: pictures", run.scene));
    const RunSummary summary = run_scene(workplace.context, find_scene(run.scene, overrides),
                                         {.out = frames.path(), .quiet = workplace.quiet, .stop = workplace.stop});
    if (summary.stopped) {
        throw Interrupted{};
    }
    for (const Shot& shot : run.shots) {
        std::error_code error;
        std::filesystem::rename(frames.path() / fmt::format("frame_{:04}.png", shot.frame),
                                workplace.folder / shot.file, error);
        if (error) {
            throw runtime_error("{}: {}", (workplace.folder / shot.file).string(), error.message());
        }
    }
}

std::string command(const Run& run)
{
    std::string text = "meltpoint render " + run.scene;
    for (const std::string& change : run.overrides) {
        text += " --set " + change;
    }
    return text;
}

/// Two pictures a row, what they show and the command that made them below.
std::string take_all(const Workplace& workplace, const std::vector<Run>& runs)
{
    std::vector<std::string> cells;
    for (const Run& run : runs) {
        check_stop(workplace);
        take(workplace, run);
        for (const Shot& shot : run.shots) {
            cells.push_back(fmt::format("![{0}]({1}{2})<br>{0}: frame {3} of `{4}`", shot.caption, workplace.link,
                                        shot.file, shot.frame, command(run)));
        }
    }
    std::vector<Row> rows;
    for (std::size_t i = 0; i < cells.size(); i += 2) {
        rows.push_back({cells[i], i + 1 < cells.size() ? cells[i + 1] : ""});
    }
    return table({"", ""}, rows);
}

} // namespace

std::string make_gallery(const Workplace& workplace)
{
    return take_all(
        workplace,
        {{"melt_teapot",
          {},
          {{0, "melt_teapot_00.png", "a teapot of ice in the sun"},
           {22, "melt_teapot_22.png", "what is thin melts first"},
           {89, "melt_teapot_89.png", "and most of it is water"}}},
         {"jet_on_block", {}, {{119, "jet_on_block_119.png", "a jet has hollowed out layered stone"}}},
         {"river_bed", {}, {{159, "river_bed_159.png", "a stream has eaten into its banks"}}},
         {"dune",
          {},
          {{0, "dune_00.png", "a dune of sand"},
           {59, "dune_59.png", "and the wind, which has carried sand over its crest"}}},
         {"teapot_drop", {}, {{31, "teapot_drop_31.png", "a teapot of syrup has hit the floor"}}},
         {"dam_break", {"render.color=speed"}, {{27, "dam_break_speed.png", "a dam break colored by speed"}}},
         {"dissolve", {}, {{32, "dissolve_32.png", "a rabbit dissolves into a thick fluid"}}},
         {"vanish", {}, {{38, "vanish_38.png", "and crumbles into dust that the wind carries off"}}}});
}

std::string make_figures(const Workplace& workplace)
{
    return take_all(workplace,
                    {{"bunny_samples", {}, {{0, "bunny_samples.png", "figure 1, random samples of a rabbit"}}},
                     {"teapot_samples", {}, {{0, "teapot_samples.png", "figure 2, of the teapot"}}},
                     {"block_2d", {}, {{26, "block_2d.png", "figure 3, left: 2D, magenta below the rest density"}}},
                     {"block_3d", {}, {{26, "block_3d.png", "figure 3, right: 3D"}}},
                     {"splat_sphere", {}, {{0, "splat_sphere.png", "figure 4, splats on a sphere"}}},
                     {"drop", {}, {{18, "drop.png", "figure 5, a drop throws up columns of liquid"}}},
                     {"teapot_floor", {}, {{18, "teapot_floor.png", "figure 6, the teapot hits a floor"}}}});
}

} // namespace meltpoint::report
