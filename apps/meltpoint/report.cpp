#include <algorithm>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.h"
#include "core/error.h"
#include "core/log.h"
#include "core/nearest_name.h"
#include "exit_codes.h"
#include "interrupt.h"
#include "io/atomic_file.h"
#include "report/document.h"
#include "report/sections.h"
#include "run/output_files.h"
#include "scene_options.h"

namespace meltpoint::program {

namespace {

struct ReportOptions {
    SceneOptions scene; ///< for device and validate
    std::string out = "report";
    std::string readme;
    std::vector<std::string> only;
    bool force = false;
};

std::vector<std::string> maker_names()
{
    std::vector<std::string> names;
    for (const report::SectionMaker& maker : report::section_makers()) {
        names.emplace_back(maker.name);
    }
    return names;
}

void check_names(std::span<const std::string> found, const std::string& where)
{
    const std::vector<std::string> known = maker_names();
    for (const std::string& name : found) {
        if (std::ranges::find(known, name) == known.end()) {
            const auto nearest = nearest_name(name, known);
            throw input_error("{}: there is no section \"{}\"; {}", where, name,
                              nearest ? fmt::format("did you mean \"{}\"?", *nearest)
                                      : fmt::format("there are {}", fmt::join(known, ", ")));
        }
    }
}

std::string read_text(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    if (!file || !std::filesystem::is_regular_file(path) || !(text << file.rdbuf())) {
        throw input_error("{}: cannot be read as a text file", path);
    }
    return text.str();
}

/// How a document in one folder links to files in another.
std::string link_from(const std::filesystem::path& document_folder, const std::filesystem::path& folder)
{
    const std::filesystem::path relative = std::filesystem::proximate(
        std::filesystem::absolute(folder),
        document_folder.empty() ? std::filesystem::current_path() : std::filesystem::absolute(document_folder));
    return relative == "." ? "" : relative.generic_string() + "/";
}

int run_report(const ReportOptions& options, bool quiet)
{
    const InterruptGuard interrupt;
    const std::filesystem::path folder = options.out;
    const std::filesystem::path document =
        options.readme.empty() ? folder / "report.md" : std::filesystem::path(options.readme);
    check_names(options.only, "--only");
    std::vector<std::string> wanted = options.only.empty() ? maker_names() : options.only;
    std::string readme;
    if (!options.readme.empty()) {
        readme = read_text(options.readme);
        const std::vector<std::string> present = report::section_names(readme, options.readme);
        check_names(present, options.readme);
        if (present.empty()) {
            throw input_error("{}: has no section to replace: none begins with a line <!-- report:NAME -->",
                              options.readme);
        }
        if (options.only.empty()) {
            wanted = present;
        }
        for (const std::string& name : wanted) {
            if (std::ranges::find(present, name) == present.end()) {
                throw input_error("{}: has no section \"{}\" to replace", options.readme, name);
            }
        }
    } else if (!options.force) {
        refuse_existing(document);
    }
    make_folder(folder);

    const gpu::Context context(context_options(options.scene));
    const report::Workplace workplace{.context = context,
                                      .folder = folder,
                                      .link = link_from(document.parent_path(), folder),
                                      .quiet = quiet,
                                      .stop = &interrupt.flag()};
    std::map<std::string, std::string, std::less<>> made;
    std::string text = "# Report\n";
    try {
        for (const report::SectionMaker& maker : report::section_makers()) {
            if (std::ranges::find(wanted, maker.name) != wanted.end()) {
                report::check_stop(workplace);
                log_info(fmt::format("section {}", maker.name));
                const std::string& content = made[std::string(maker.name)] = maker.make(workplace);
                text += fmt::format("\n## {}\n\n{}", maker.title, report::section(maker.name, content));
            }
        }
    } catch (const report::Interrupted&) {
        log_warning("interrupted: the document is as it was");
        return exit_interrupted;
    }
    if (!options.readme.empty()) {
        text = report::replace_sections(readme, options.readme, [&](std::string_view name) {
            const auto found = made.find(name);
            return found == made.end() ? nullptr : &found->second;
        });
    }
    write_file_atomically(document, std::as_bytes(std::span(text)));
    require_silent_validation(context);
    fmt::print("{}: {} sections\n", document.string(), made.size());
    return exit_done;
}

} // namespace

void add_report(CLI::App& app, const GlobalOptions& global, int& exit_code)
{
    auto options = std::make_shared<ReportOptions>();
    std::string about = "Measures and draws again every number, plot and picture of the README. Sections:";
    for (const report::SectionMaker& maker : report::section_makers()) {
        about += fmt::format("\n  {:<12} {}", maker.name, maker.about);
    }
    CLI::App* command = app.add_subcommand("report", about);
    command->add_option("--out", options->out, "Folder of pictures and plots, and of report.md [report]")
        ->type_name("DIR");
    command
        ->add_option(
            "--readme", options->readme,
            "Replaces the sections of this Markdown file instead of writing report.md: what stands between a line "
            "<!-- report:NAME --> and a line <!-- report end -->")
        ->type_name("FILE.md");
    command->add_option("--only", options->only, "Only these sections [all, or all that the file has]")
        ->type_name("NAME,...")
        ->delimiter(',');
    command->add_flag("--force", options->force, "Replaces an existing report.md");
    add_device_options(*command, options->scene);
    command->callback([options, &global, &exit_code] { exit_code = run_report(*options, global.quiet); });
}

} // namespace meltpoint::program
