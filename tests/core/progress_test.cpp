#include "core/progress.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include <fcntl.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "core/log.h"

namespace meltpoint {
namespace {

TEST(Progress, BarTellsRateAndTimeLeft)
{
    EXPECT_EQ(progress_bar_line("frames", 30, 90, 10.0, "16,000 particles", 100),
              "frames [========                ] 30/90  3/s  0:20 left  16,000 particles");
    EXPECT_EQ(progress_bar_line("frames", 0, 90, 0.0, "", 100), "frames [                        ] 0/90");
    EXPECT_EQ(progress_bar_line("frames", 1, 101, 60.0, "", 100),
              "frames [                        ] 1/101  0.0167/s  1:40:00 left");
    EXPECT_EQ(progress_bar_line("frames", 90, 90, 45.0, "", 100),
              "frames [========================] 90/90  2/s  0:00 left");
}

TEST(Progress, BarKeepsWithinItsBounds)
{
    EXPECT_EQ(progress_bar_line("frames", 30, 90, 10.0, "", 12), "frames [====");
    EXPECT_EQ(progress_bar_line("a", 5, 3, 1.0, "", 100), "a [========================] 5/3  5/s  0:00 left");
    EXPECT_EQ(progress_bar_line("a", 0, 0, 0.0, "", 100), "a [========================] 0/0");
}

TEST(Progress, WritesALineAnItemWhereThereIsNoTerminal)
{
    testing::internal::CaptureStderr();
    {
        Progress progress("frame", 2, false);
        progress.advance("0.1 s");
        progress.advance();
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "frame 1/2  0.1 s\nframe 2/2\n");
}

TEST(Progress, QuietWritesNothing)
{
    testing::internal::CaptureStderr();
    {
        Progress progress("frame", 2, true);
        progress.advance("0.1 s");
        progress.finish();
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(Progress, GoesOnWhereStderrCannotBeWritten)
{
    const int real_stderr = dup(STDERR_FILENO);
    const int full = open("/dev/full", O_WRONLY);
    ASSERT_GE(full, 0);
    dup2(full, STDERR_FILENO);
    EXPECT_NO_THROW({
        Progress progress("frame", 2, false);
        progress.advance("0.1 s");
        log_warning("beware");
        progress.advance();
    });
    dup2(real_stderr, STDERR_FILENO);
    close(real_stderr);
    close(full);
    std::clearerr(stderr);
}

/// What a function writes to stderr while that is a terminal.
template <class Function>
std::string written_to_terminal(const Function& function)
{
    const int terminal = posix_openpt(O_RDWR | O_NOCTTY);
    EXPECT_GE(terminal, 0);
    EXPECT_EQ(grantpt(terminal), 0);
    EXPECT_EQ(unlockpt(terminal), 0);
    const int slave = open(ptsname(terminal), O_RDWR | O_NOCTTY);
    EXPECT_GE(slave, 0);
    const int real_stderr = dup(STDERR_FILENO);
    dup2(slave, STDERR_FILENO);
    function();
    dup2(real_stderr, STDERR_FILENO);
    close(real_stderr);
    close(slave); // then reading ends after the last byte

    std::string output;
    std::array<char, 4096> buffer{};
    for (ssize_t length = 0; (length = read(terminal, buffer.data(), buffer.size())) > 0;) {
        output.append(buffer.data(), static_cast<std::size_t>(length));
    }
    close(terminal);
    return output;
}

TEST(Progress, DrawsABarOnATerminalAndClearsIt)
{
    constexpr int ITEMS = 30;
    const auto start = std::chrono::steady_clock::now();
    const std::string output = written_to_terminal([] {
        Progress progress("frame", ITEMS, false);
        for (int i = 0; i < ITEMS; ++i) {
            progress.advance();
        }
    });
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    ASSERT_GE(output.size(), 4u);
    EXPECT_EQ(output.find("\r\x1b[Kframe [                        ] 1/30"), 0u);
    EXPECT_EQ(output.rfind("\r\x1b[K"), output.size() - 4);
    EXPECT_EQ(output.find('\n'), std::string::npos);
    const auto drawn =
        std::ranges::count(output, '[') - std::ranges::count(output, 'K'); // brackets, less those of the clearing
    EXPECT_LE(static_cast<double>(drawn), 1.0 + 10.0 * seconds);
}

TEST(Progress, ALogLineClearsTheBarAndTheBarComesBack)
{
    const std::string output = written_to_terminal([] {
        Progress progress("frame", 3, false);
        progress.advance();
        log_warning("beware");
        progress.advance();
    });
    const std::size_t warning = output.find("\r\x1b[Kwarning: beware\r\n"); // the terminal makes \n a new line
    ASSERT_NE(warning, std::string::npos) << output;
    EXPECT_LT(output.find(" 1/3"), warning);
    EXPECT_NE(output.find("\r\x1b[Kframe [", warning + 4), std::string::npos) << output;
    EXPECT_NE(output.find(" 2/3", warning), std::string::npos) << output;
}

} // namespace
} // namespace meltpoint
