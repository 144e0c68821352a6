#include "core/log.h"

#include <gtest/gtest.h>

namespace meltpoint {
namespace {

TEST(Log, WritesOutWhatATerminalWouldObey)
{
    testing::internal::CaptureStderr();
    log_warning("\x1b[31mred\r\x7f ü\tline\nbreak {}");
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "warning: \\x1b[31mred\\x0d\\x7f ü\tline\nbreak {}\n");
}

} // namespace
} // namespace meltpoint
