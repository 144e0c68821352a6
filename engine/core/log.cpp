#include "core/log.h"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include "core/progress.h"

namespace meltpoint {

namespace {

/// Ready for a line of its own.
spdlog::logger& logger()
{
    clear_progress_line();
    static const std::shared_ptr<spdlog::logger> instance = [] {
        auto created = std::make_shared<spdlog::logger>("meltpoint", std::make_shared<spdlog::sinks::stderr_sink_mt>());
        created->set_pattern("%v");
        return created;
    }();
    return *instance;
}

} // namespace

void log_info(std::string_view message)
{
    logger().info(message);
}
void log_warning(std::string_view message)
{
    logger().warn("warning: {}", message);
}
void log_error(std::string_view message)
{
    logger().error("error: {}", message);
}

void set_log_quiet(bool quiet)
{
    logger().set_level(quiet ? spdlog::level::warn : spdlog::level::info);
}

} // namespace meltpoint
