#pragma once

#include <atomic>

namespace meltpoint::program {

/// Turns Ctrl-C (SIGINT) and SIGTERM into a flag for as long as it lives; a second Ctrl-C ends the program at once.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    [[nodiscard]] const std::atomic<bool>& flag() const;
};

} // namespace meltpoint::program
