#pragma once

#include <atomic>

namespace meltpoint::program {

enum class OnInterrupt {
    FinishFrame, ///< sets the flag and says what happens next; a second Ctrl-C ends the program at once
    Stop,        ///< sets the flag, for work that ends soon
    Exit,        ///< ends the program at once, with the exit code of an interrupted run: where nothing is half written
};

/// Decides what Ctrl-C (SIGINT) and SIGTERM do for as long as it lives.
class InterruptGuard {
public:
    explicit InterruptGuard(OnInterrupt on_interrupt = OnInterrupt::FinishFrame);
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    [[nodiscard]] const std::atomic<bool>& flag() const;
};

} // namespace meltpoint::program
