#include "core/progress.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <utility>

#include <fmt/format.h>

#include <sys/ioctl.h>
#include <unistd.h>

namespace meltpoint {

namespace {

constexpr std::chrono::milliseconds REDRAW_INTERVAL{100};
constexpr std::size_t BAR_WIDTH = 24;
constexpr const char* CLEAR_LINE = "\r\x1b[K";

// Of the one terminal that stderr may be.
std::atomic<bool> bar_is_showing{false};

std::size_t terminal_columns()
{
    winsize size{};
    const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return known ? size.ws_col : 80;
}

/// A full disk or a closed pipe behind stderr is no reason to end the work: what cannot be written is lost.
void write_to_stderr(const std::string& text)
{
    static_cast<void>(std::fwrite(text.data(), 1, text.size(), stderr));
    std::fflush(stderr);
}

/// "0:07", "12:30", "3:00:00".
std::string clock_text(double seconds)
{
    const auto whole = static_cast<long long>(std::ceil(std::min(seconds, 359999.0)));
    return whole < 3600 ? fmt::format("{}:{:02}", whole / 60, whole % 60)
                        : fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

} // namespace

std::string progress_bar_line(std::string_view label, std::size_t done, std::size_t total, double seconds,
                              std::string_view detail, std::size_t columns)
{
    const double fraction = total == 0 ? 1.0 : std::min(1.0, static_cast<double>(done) / static_cast<double>(total));
    const auto filled = static_cast<std::size_t>(fraction * static_cast<double>(BAR_WIDTH));
    std::string line = fmt::format("{} [{}{}] {}/{}", label, std::string(filled, '='),
                                   std::string(BAR_WIDTH - filled, ' '), done, total);
    if (done > 0 && seconds > 0.0) {
        const double rate = static_cast<double>(done) / seconds;
        const double left = done < total ? static_cast<double>(total - done) / rate : 0.0;
        line += fmt::format("  {:.3g}/s  {} left", rate, clock_text(left));
    }
    if (!detail.empty()) {
        line += fmt::format("  {}", detail);
    }
    // A line that wraps could not be cleared.
    return line.substr(0, columns);
}

Progress::Progress(std::string label, std::size_t total, bool quiet)
    : label_(std::move(label)), total_(total), style_(quiet                        ? Style::Quiet
                                                      : isatty(STDERR_FILENO) != 0 ? Style::Bar
                                                                                   : Style::Lines)
{
}

void Progress::advance(std::string_view detail)
{
    ++done_;
    const Clock::time_point now = Clock::now();
    if (style_ == Style::Lines) {
        write_to_stderr(fmt::format("{} {}/{}{}{}\n", label_, done_, total_, detail.empty() ? "" : "  ", detail));
    } else if (style_ == Style::Bar && (!bar_is_showing || now - last_drawn_ >= REDRAW_INTERVAL)) {
        const double seconds = std::chrono::duration<double>(now - start_).count();
        write_to_stderr(CLEAR_LINE + progress_bar_line(label_, done_, total_, seconds, detail, terminal_columns() - 1));
        last_drawn_ = now;
        bar_is_showing = true;
    }
}

void Progress::finish()
{
    if (style_ == Style::Bar) {
        clear_progress_line();
    }
}

void clear_progress_line()
{
    if (bar_is_showing.exchange(false)) {
        write_to_stderr(CLEAR_LINE);
    }
}

} // namespace meltpoint
