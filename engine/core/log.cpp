#include "core/log.h"

#include <string>

#include <fmt/format.h>
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

/// Names come from scenes and meshes of strangers: what a terminal would obey is written out instead.
std::string harmless(std::string_view message)
{
    std::string text;
    for (const char c : message) {
        const auto byte = static_cast<unsigned char>(c);
        const bool is_control = (byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7f;
        text += is_control ? fmt::format("\\x{:02x}", byte) : std::string(1, c);
    }
    return text;
}

} // namespace

void log_info(std::string_view message)
{
    logger().info("{}", harmless(message));
}
void log_warning(std::string_view message)
{
    logger().warn("warning: {}", harmless(message));
}
void log_error(std::string_view message)
{
    logger().error("error: {}", harmless(message));
}

void set_log_quiet(bool quiet)
{
    logger().set_level(quiet ? spdlog::level::warn : spdlog::level::info);
}

} // namespace meltpoint
