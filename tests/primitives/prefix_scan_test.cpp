#include "primitives/prefix_scan.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

#include "core/random.h"
#include "gpu/transfer.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

using Words = std::vector<std::uint32_t>;

constexpr std::uint32_t sentinel = 0xdeadbeefu;
constexpr std::size_t guard_words = 64;

Words random_counts(std::size_t count, std::uint32_t bound, std::uint64_t seed)
{
    Random random(seed);
    Words counts(count);
    std::generate(counts.begin(), counts.end(), [&] { return random.below(bound); });
    return counts;
}

Words expected_starts(const Words& counts)
{
    Words starts(counts.size() + 1, 0);
    std::partial_sum(counts.begin(), counts.end(), starts.begin() + 1);
    return starts;
}

/// A data set on the device. Behind what the scan may write, in starts and scratch, lie guard words.
struct ScanCase {
    ScanCase(const gpu::Context& context, const primitives::PrefixScan& scan, const Words& data)
        : expected(expected_starts(data)), scratch_words(scan.scratch_words(count())),
          counts(gpu::make_buffer<std::uint32_t>(context, data.size(), "counts")),
          starts(gpu::make_buffer<std::uint32_t>(context, data.size() + 1 + guard_words, "starts")),
          scratch(gpu::make_buffer<std::uint32_t>(context, scratch_words + guard_words, "scratch"))
    {
        gpu::upload<std::uint32_t>(context, counts, data);
    }

    [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(expected.size() - 1); }

    void record(gpu::Commands& commands, const primitives::PrefixScan& scan) const
    {
        commands.fill(starts, sentinel);
        commands.fill(scratch, sentinel);
        scan.record(commands, counts, starts, count(), scratch);
    }

    void check(const gpu::Context& context) const
    {
        const Words guard(guard_words, sentinel);
        Words result = gpu::download<std::uint32_t>(context, starts, expected.size() + guard_words);
        EXPECT_TRUE(std::equal(guard.begin(), guard.end(), result.end() - guard_words)) << "wrote behind starts";
        result.resize(expected.size());
        EXPECT_EQ(result.back(), expected.back()) << "total";
        EXPECT_TRUE(result == expected) << "first difference at "
                                        << std::mismatch(result.begin(), result.end(), expected.begin()).first -
                                               result.begin();
        const Words used = gpu::download<std::uint32_t>(context, scratch, scratch_words + guard_words);
        EXPECT_TRUE(std::equal(guard.begin(), guard.end(), used.end() - guard_words)) << "wrote behind the scratch";
    }

    Words expected;
    std::size_t scratch_words;
    gpu::Buffer counts;
    gpu::Buffer starts;
    gpu::Buffer scratch;
};

class PrefixScanTest : public GpuTest {
protected:
    static void expect_scanned(const primitives::PrefixScan& scan, const Words& data)
    {
        SCOPED_TRACE(testing::Message() << data.size() << " elements");
        const ScanCase data_set(context(), scan, data);
        gpu::Commands commands(context());
        commands.begin();
        data_set.record(commands, scan);
        commands.submit();
        commands.wait();
        data_set.check(context());
    }
};

/// Elements per invocation: what GPUs and software devices get by default, and the least, whose block sums take many
/// rounds.
class PrefixScanElementsTest : public PrefixScanTest, public testing::WithParamInterface<std::uint32_t> {};

INSTANTIATE_TEST_SUITE_P(Elements, PrefixScanElementsTest, testing::Values(1, 16, 256));

TEST_P(PrefixScanElementsTest, EqualsTheStandardLibrarysForEverySize)
{
    const primitives::PrefixScan scan(context(), GetParam());
    const std::uint32_t block = 64 * GetParam();
    for (const std::uint32_t count : {0u, 1u, 2u, 31u, 32u, 33u, 255u, 256u, 257u, block - 1, block, block + 1,
                                      64 * block + 1, 100'000u, 1'000'000u}) {
        expect_scanned(scan, random_counts(count, 40, count));
    }
}

TEST_P(PrefixScanElementsTest, EqualsTheStandardLibrarysForEveryKindOfData)
{
    const primitives::PrefixScan scan(context(), GetParam());
    constexpr std::size_t count = 50'001;
    expect_scanned(scan, Words(count, 0));
    expect_scanned(scan, Words(count, 1));
    expect_scanned(scan, random_counts(count, ~0u, 1)); // the sums wrap
    Words rising(count);
    std::iota(rising.begin(), rising.end(), 0u);
    expect_scanned(scan, rising);
    Words one(count, 0);
    one[count / 2] = 7;
    expect_scanned(scan, one);
}

// One element an invocation would do it with half the elements, but its block sums need more rounds than llvmpipe's
// loops may have (65,535 iterations).
TEST_F(PrefixScanTest, MoreWorkgroupsThanOneAxisOfADispatchHolds)
{
    const primitives::PrefixScan scan(context(), 2);
    const std::uint32_t groups = context().limits().maxComputeWorkGroupCount[0];
    if (groups > 100'000) {
        GTEST_SKIP() << "this device's axes hold " << groups << " workgroups: no data set in reason needs two";
    }
    expect_scanned(scan, random_counts(std::size_t{groups} * 128 + 1000, 3, 4));
}

TEST_F(PrefixScanTest, SixteenMillionElements)
{
    expect_scanned(primitives::PrefixScan(context()), random_counts(16u << 20u, 40, 5));
}

// The second data set overwrites the first one's scratch, and the first scan is repeated on its own result.
TEST_F(PrefixScanTest, ScansRecordedTogetherDoNotDisturbEachOther)
{
    const primitives::PrefixScan scan(context());
    const ScanCase first(context(), scan, random_counts(100'000, 10, 6));
    const ScanCase second(context(), scan, random_counts(99'999, 10, 7));
    const ScanCase of_starts(context(), scan, first.expected);
    gpu::Commands commands(context());
    commands.begin();
    first.record(commands, scan);
    scan.record(commands, second.counts, second.starts, second.count(), first.scratch);
    scan.record(commands, first.starts, of_starts.starts, of_starts.count(), first.scratch);
    commands.submit();
    commands.wait();
    EXPECT_EQ(gpu::download<std::uint32_t>(context(), first.starts, first.expected.size()), first.expected);
    EXPECT_EQ(gpu::download<std::uint32_t>(context(), second.starts, second.expected.size()), second.expected);
    EXPECT_EQ(gpu::download<std::uint32_t>(context(), of_starts.starts, of_starts.expected.size()), of_starts.expected);
}

TEST_F(PrefixScanTest, ValidationSeesAScanThatDoesNotWaitForItsInput)
{
    const primitives::PrefixScan scan(context());
    const ScanCase data_set(context(), scan, Words(1000, 1));
    gpu::Commands commands(context());
    commands.begin();
    commands.fill(data_set.counts, 1);
    commands.suppress_next_barrier();
    scan.record(commands, data_set.counts, data_set.starts, data_set.count(), data_set.scratch);
    commands.submit();
    commands.wait();
    const std::vector<std::string> messages = take_validation_messages();
    ASSERT_FALSE(messages.empty());
    EXPECT_NE(messages[0].find("SYNC-HAZARD-READ-AFTER-WRITE"), std::string::npos) << messages[0];
}

TEST_F(PrefixScanTest, ABufferTooSmallIsRefused)
{
    const primitives::PrefixScan scan(context());
    const gpu::Buffer large = gpu::make_buffer<std::uint32_t>(context(), 100'001, "large");
    const gpu::Buffer scratch = gpu::make_buffer<std::uint32_t>(context(), scan.scratch_words(100'000), "scratch");
    const gpu::Buffer small = gpu::make_buffer<std::uint32_t>(context(), 4, "small");
    gpu::Commands commands(context());
    commands.begin();
    EXPECT_THROW(scan.record(commands, small, large, 100'000, scratch), std::logic_error);
    EXPECT_THROW(scan.record(commands, large, small, 100'000, scratch), std::logic_error);
    EXPECT_THROW(scan.record(commands, large, large, 100'000, small), std::logic_error);
    EXPECT_THROW(scan.record(commands, large, large, 100'001, scratch), std::logic_error); // no room for the total
    commands.submit();
    commands.wait();
}

} // namespace
} // namespace meltpoint
