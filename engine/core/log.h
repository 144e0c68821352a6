#pragma once

#include <string_view>

namespace meltpoint {

/// Messages for a person, on stderr (stdout carries results only). Thread safe.
void log_info(std::string_view message);
void log_warning(std::string_view message);
void log_error(std::string_view message);

/// Quiet drops log_info; warnings and errors always appear.
void set_log_quiet(bool quiet);

} // namespace meltpoint
