#include <csignal>
#include <exception>
#include <new>

#include <CLI/CLI.hpp>

#include "commands.h"
#include "core/error.h"
#include "core/log.h"
#include "exit_codes.h"

namespace {

using namespace meltpoint; // NOLINT(google-build-using-namespace): this file is the program

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
    program::add_compare(app, global, exit_code);
    program::add_info(app, global, exit_code);

    app.parse_complete_callback([&] { set_log_quiet(global.quiet); });
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        const bool asked_for = error.get_exit_code() == static_cast<int>(CLI::ExitCodes::Success);
        app.exit(error); // prints help and version to stdout, mistakes to stderr
        return asked_for ? program::exit_done : program::exit_bad_input;
    }
    return exit_code;
}

} // namespace

int main(int argc, char** argv)
{
    std::signal(SIGPIPE, SIG_IGN); // a closed pipe is an error to report, not a reason to vanish
    try {
        return run(argc, argv);
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
