#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>

namespace meltpoint {

/// Shows on stderr how far a long task is. On a terminal one line with a bar, the rate and the time left, redrawn at
/// most ten times a second and cleared at the end; elsewhere, as in a log file, one line an item. Quiet shows nothing.
/// For one thread.
class Progress {
public:
    /// label: what the items are, as in "frames". total: how many there will be.
    Progress(std::string label, std::size_t total, bool quiet);
    ~Progress() { finish(); }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// One more item is done; detail says something about it, as in "12,345 particles".
    void advance(std::string_view detail = {});

    /// Clears the bar. More calls change nothing.
    void finish();

private:
    using Clock = std::chrono::steady_clock;
    enum class Style { Quiet, Lines, Bar };

    std::string label_;
    std::size_t total_;
    std::size_t done_ = 0;
    Style style_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point last_drawn_;
};

/// Clears the line of a bar that is showing, so that something else can be written to stderr; the bar comes back with
/// its next item. Thread safe.
void clear_progress_line();

/// The bar's line, at most `columns` wide: "frames [=====     ] 30/90  4.1/s  0:15 left  detail".
std::string progress_bar_line(std::string_view label, std::size_t done, std::size_t total, double seconds,
                              std::string_view detail, std::size_t columns);

} // namespace meltpoint
