#pragma once

#include <CLI/CLI.hpp>

namespace meltpoint::program {

/// What all subcommands share.
struct GlobalOptions {
    bool quiet = false;
};

/// Each adds one subcommand with its flags; running it sets exit_code.
void add_render(CLI::App& app, const GlobalOptions& global, int& exit_code);
void add_sample(CLI::App& app, const GlobalOptions& global, int& exit_code);
void add_compare(CLI::App& app, const GlobalOptions& global, int& exit_code);
void add_follow(CLI::App& app, const GlobalOptions& global, int& exit_code);
void add_bench(CLI::App& app, const GlobalOptions& global, int& exit_code);
void add_report(CLI::App& app, const GlobalOptions& global, int& exit_code);
void add_validate(CLI::App& app, const GlobalOptions& global, int& exit_code);
void add_info(CLI::App& app, const GlobalOptions& global, int& exit_code);

} // namespace meltpoint::program
