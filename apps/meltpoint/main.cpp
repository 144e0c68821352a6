#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include <fcntl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "commands.h"
#include "core/error.h"
#include "core/log.h"
#include "exit_codes.h"

namespace {

using namespace meltpoint; // NOLINT(google-build-using-namespace): this file is the program

std::vector<CLI::App*> subcommands_of(CLI::App& app)
{
    return app.get_subcommands([](const CLI::App*) { return true; });
}

/// What a shell makes of a variable that is not set would else read as an option that is not given.
void refuse_empty_values(CLI::App& subcommand)
{
    const CLI::Validator not_empty(
        [](std::string& value) { return std::string(value.empty() ? "must not be empty" : ""); }, "");
    for (CLI::Option* option : subcommand.get_options()) {
        if (option->get_items_expected_max() > 0) {
            option->check(not_empty);
        }
    }
}

int run(int argc, char** argv)
{
    CLI::App app{"Meltpoint: things made of points that melt, erode and dissolve into fluid, on Vulkan compute."};
    app.name("meltpoint");
    app.set_version_flag("--version", std::string("meltpoint ") + MELTPOINT_VERSION);
    app.require_subcommand(1);
    app.fallthrough();
    app.footer("Exit codes: 0 done, 1 failed at run time, 2 bad input or usage, 130 interrupted (Ctrl-C).\n"
               "meltpoint SUBCOMMAND --help explains a subcommand.");

    program::GlobalOptions global;
    app.add_flag("-q,--quiet", global.quiet, "No progress or notes on stderr; warnings and errors still appear");
    int exit_code = program::exit_done;
    program::add_render(app, global, exit_code);
    program::add_sample(app, global, exit_code);
    program::add_compare(app, global, exit_code);
    program::add_follow(app, global, exit_code);
    program::add_bench(app, global, exit_code);
    program::add_report(app, global, exit_code);
    program::add_validate(app, global, exit_code);
    program::add_info(app, global, exit_code);
    for (CLI::App* subcommand : subcommands_of(app)) {
        refuse_empty_values(*subcommand);
        subcommand->footer("-q, --quiet, before or after the subcommand: no progress or notes on stderr.");
    }

    app.parse_complete_callback([&] { set_log_quiet(global.quiet); });
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const bool asked_for = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
        if (!asked_for && argc > 1 && app.get_subcommands().empty() && argv[1][0] != '-') {
            std::vector<std::string> names;
            for (const CLI::App* subcommand : subcommands_of(app)) {
                names.push_back(subcommand->get_name());
            }
            throw input_error("there is no subcommand \"{}\"; there are {}", argv[1], fmt::join(names, ", "));
        }
        app.exit(error); // prints help and version to stdout, mistakes to stderr
        return asked_for ? program::exit_done : program::exit_bad_input;
    }
    return exit_code;
}

/// A stream that the caller closed would give its number to the next file opened, which would then receive our text.
void reserve_standard_streams()
{
    while (true) {
        const int descriptor = open("/dev/null", O_RDWR);
        if (descriptor > STDERR_FILENO) {
            close(descriptor);
        }
        if (descriptor < 0 || descriptor > STDERR_FILENO) {
            return;
        }
    }
}

/// Results that did not arrive, on a full disk or a closed pipe, are a failure like any other.
int run_and_flush(int argc, char** argv)
{
    const int exit_code = run(argc, argv);
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) {
        throw runtime_error("cannot write to the standard output: {}", std::generic_category().message(errno));
    }
    return exit_code;
}

} // namespace

int main(int argc, char** argv)
{
    // A closed pipe and a file at its size limit are errors to report, not reasons to vanish.
    std::signal(SIGPIPE, SIG_IGN);
    std::signal(SIGXFSZ, SIG_IGN);
    reserve_standard_streams();
    try {
        return run_and_flush(argc, argv);
    } catch (const Error& error) {
        log_error(error.what());
        return error.kind() == ErrorKind::Input ? program::exit_bad_input : program::exit_failed;
    } catch (const std::bad_alloc&) {
        log_error("out of memory");
    } catch (const std::exception& error) {
        log_error(error.what());
    }
    return program::exit_failed;
}
