#include "interrupt.h"

#include <csignal>
#include <string_view>

#include <unistd.h>

#include "exit_codes.h"

namespace meltpoint::program {

namespace {

// A signal handler can reach nothing but a global; lock-free atomics are safe in it.
std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

/// A frame can take minutes: silence would look like a program that does not listen.
constexpr std::string_view NOTICE = "\ninterrupted: ends after this frame; once more ends at once\n";

void on_signal(int signal_number)
{
    interrupted = true;
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, NOTICE.data(), NOTICE.size());
    std::signal(signal_number, SIG_DFL);
}

void on_signal_quietly(int signal_number)
{
    interrupted = true;
    std::signal(signal_number, SIG_DFL);
}

void exit_on_signal(int /*signal_number*/)
{
    _exit(exit_interrupted);
}

} // namespace

InterruptGuard::InterruptGuard(OnInterrupt on_interrupt)
{
    interrupted = false;
    void (*const handler)(int) = on_interrupt == OnInterrupt::FinishFrame ? on_signal
                                 : on_interrupt == OnInterrupt::Stop      ? on_signal_quietly
                                                                          : exit_on_signal;
    std::signal(SIGINT, handler);
    std::signal(SIGTERM, handler);
}

InterruptGuard::~InterruptGuard()
{
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
}

const std::atomic<bool>& InterruptGuard::flag() const
{
    return interrupted;
}

} // namespace meltpoint::program
