#include "primitives/counting_sort.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <tuple>

#include "core/random.h"
#include "gpu/transfer.h"
#include "shared/counting_sort.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

using Words = std::vector<std::uint32_t>;

constexpr std::uint32_t sentinel = 0xdeadbeefu;
constexpr std::size_t guard_words = 64;
constexpr std::uint32_t crowded = shared::CROWDED_KEY;

/// 0 .. count - 1, shuffled.
Words shuffled_ids(std::size_t count, std::uint64_t seed)
{
    Random random(seed);
    Words ids(count);
    std::iota(ids.begin(), ids.end(), 0u);
    for (std::size_t i = count; i > 1; --i) {
        std::swap(ids[i - 1], ids[random.below(static_cast<std::uint32_t>(i))]);
    }
    return ids;
}

/// Shuffled ids that differ in all 32 bits: an odd multiplier maps unique ids to unique ones.
Words wide_ids(std::size_t count, std::uint64_t seed)
{
    Words ids = shuffled_ids(count, seed);
    std::transform(ids.begin(), ids.end(), ids.begin(), [](std::uint32_t id) { return id * 0x9e3779b1u; });
    return ids;
}

Words random_keys(std::size_t count, std::uint32_t key_count, std::uint64_t seed)
{
    Random random(seed);
    Words keys(count);
    std::generate(keys.begin(), keys.end(), [&] { return random.below(key_count); });
    return keys;
}

Words sorted(Words keys)
{
    std::sort(keys.begin(), keys.end());
    return keys;
}

Words reversed(Words keys)
{
    std::sort(keys.begin(), keys.end(), std::greater<>());
    return keys;
}

/// Keys 0, 1, 2, ... with as many elements each as `sizes` says, shuffled.
Words keys_of_sizes(const Words& sizes, std::uint64_t seed)
{
    Words ascending;
    for (std::uint32_t key = 0; key < sizes.size(); ++key) {
        ascending.insert(ascending.end(), sizes[key], key);
    }
    const Words places = shuffled_ids(ascending.size(), seed);
    Words keys(ascending.size());
    std::transform(places.begin(), places.end(), keys.begin(), [&](std::uint32_t i) { return ascending[i]; });
    return keys;
}

/// What the sort promises, by the standard library.
struct Expected {
    Expected(const Words& keys, const Words& ids, std::uint32_t key_count) : starts(key_count + 1, 0)
    {
        for (std::uint32_t i = 0; i < keys.size(); ++i) {
            if (keys[i] < key_count) {
                order.push_back(i);
                ++starts[keys[i] + 1];
            }
        }
        std::partial_sum(starts.begin(), starts.end(), starts.begin());
        std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
            return std::tie(keys[a], ids[a]) < std::tie(keys[b], ids[b]);
        });
    }

    Words starts;
    Words order;
};

class CountingSortTest : public GpuTest {
protected:
    static const primitives::CountingSort& counting_sort()
    {
        static const primitives::CountingSort instance(context());
        return instance;
    }

    static gpu::Buffer device_words(const Words& data, const std::string& name)
    {
        gpu::Buffer buffer = gpu::make_buffer<std::uint32_t>(context(), data.size(), name);
        gpu::upload<std::uint32_t>(context(), buffer, data);
        return buffer;
    }

    /// Room for `words` words and guard words behind them, all sentinels.
    static gpu::Buffer guarded(std::size_t words, const std::string& name)
    {
        return device_words(Words(words + guard_words, sentinel), name);
    }
    static gpu::Buffer guarded(const gpu::Buffer& exact)
    {
        return guarded(exact.size() / sizeof(std::uint32_t), exact.name());
    }

    /// The first words of a guarded buffer, having checked the guard.
    static Words take(const gpu::Buffer& buffer, std::size_t words)
    {
        Words data = gpu::download<std::uint32_t>(context(), buffer, buffer.size() / sizeof(std::uint32_t));
        EXPECT_TRUE(std::all_of(data.end() - guard_words, data.end(), [](auto word) { return word == sentinel; }))
            << "wrote behind " << buffer.name();
        data.resize(words);
        return data;
    }

    /// A data set on the device with every buffer guarded.
    struct SortCase {
        SortCase(const Words& key_words, const Words& id_words, std::uint32_t keys_in_range)
            : expected(key_words, id_words, keys_in_range), count(static_cast<std::uint32_t>(key_words.size())),
              key_count(keys_in_range), keys(device_words(key_words, "keys")), ids(device_words(id_words, "ids")),
              starts(guarded(key_count + std::size_t{1}, "starts")), order(guarded(count, "order")),
              scratch(counting_sort().make_scratch(count, key_count))
        {
            scratch.counts = guarded(scratch.counts);
            scratch.unordered = guarded(scratch.unordered);
            scratch.slot_ids = guarded(scratch.slot_ids);
            scratch.crowded = guarded(scratch.crowded);
            scratch.scan = guarded(scratch.scan);
        }

        void record(gpu::Commands& commands, const primitives::CountingSort::Scratch& with) const
        {
            counting_sort().record(commands, {.keys = keys, .ids = ids, .count = count, .key_count = key_count},
                                   {.starts = starts, .order = order}, with);
        }

        void check() const
        {
            const Words found_starts = take(starts, expected.starts.size());
            const Words found_order = take(order, expected.order.size());
            EXPECT_TRUE(found_starts == expected.starts) << "starts differ";
            const auto [found, wanted] = std::mismatch(found_order.begin(), found_order.end(), expected.order.begin());
            EXPECT_TRUE(found == found_order.end()) << "order differs from slot " << found - found_order.begin()
                                                    << " on: " << *found << ", not " << *wanted;
            for (const gpu::Buffer* buffer :
                 {&scratch.counts, &scratch.unordered, &scratch.slot_ids, &scratch.crowded, &scratch.scan}) {
                (void)take(*buffer, 0);
            }
        }

        Expected expected;
        std::uint32_t count;
        std::uint32_t key_count;
        gpu::Buffer keys;
        gpu::Buffer ids;
        gpu::Buffer starts;
        gpu::Buffer order;
        primitives::CountingSort::Scratch scratch;
    };

    static void expect_sorted(const Words& keys, const Words& ids, std::uint32_t key_count)
    {
        SCOPED_TRACE(testing::Message() << keys.size() << " elements, " << key_count << " keys");
        const SortCase data_set(keys, ids, key_count);
        gpu::Commands commands(context());
        commands.begin();
        data_set.record(commands, data_set.scratch);
        commands.submit();
        commands.wait();
        data_set.check();
    }
};

/// The number of elements.
class CountingSortSizeTest : public CountingSortTest, public testing::WithParamInterface<std::uint32_t> {
protected:
    static std::uint32_t count() { return GetParam(); }
    static std::uint32_t key_count() { return count() / 10 + 2; }
    static Words ids() { return shuffled_ids(count(), 1); }
};

INSTANTIATE_TEST_SUITE_P(Sizes, CountingSortSizeTest,
                         testing::Values(0, 1, 2, 31, 32, 33, 255, 256, 257, 100'000, 1'000'000));

TEST_P(CountingSortSizeTest, RandomKeys)
{
    expect_sorted(random_keys(count(), key_count(), 2), ids(), key_count());
}

TEST_P(CountingSortSizeTest, SortedKeys)
{
    expect_sorted(sorted(random_keys(count(), key_count(), 3)), ids(), key_count());
}

TEST_P(CountingSortSizeTest, ReversedKeys)
{
    expect_sorted(reversed(random_keys(count(), key_count(), 4)), ids(), key_count());
}

TEST_P(CountingSortSizeTest, FewDistinctKeys)
{
    expect_sorted(random_keys(count(), 5, 5), ids(), 5);
}

TEST_P(CountingSortSizeTest, AllKeysEqual)
{
    expect_sorted(Words(count(), 1), ids(), 3);
}

TEST_F(CountingSortTest, ElementsBeyondTheLastKeyAreLeftOut)
{
    Words keys = random_keys(10'000, 300, 6);
    keys[17] = ~0u;
    expect_sorted(keys, shuffled_ids(keys.size(), 7), 200);
    expect_sorted(Words(5000, 9), shuffled_ids(5000, 7), 9); // all of them
    expect_sorted(Words(5000, 9), shuffled_ids(5000, 7), 0);
}

TEST_F(CountingSortTest, IdsMayUseAllTheirBits)
{
    expect_sorted(random_keys(50'000, 3000, 8), wide_ids(50'000, 9), 3000);
    expect_sorted(random_keys(50'000, 7, 8), wide_ids(50'000, 9), 7);
}

// The most work for one workgroup: eight digits.
TEST_F(CountingSortTest, AMillionElementsOfOneKeyWithIdsOfAllBits)
{
    expect_sorted(Words(1'000'000, 0), wide_ids(1'000'000, 9), 1);
}

TEST_F(CountingSortTest, KeysOnTheBorderOfBeingCrowded)
{
    const Words keys = keys_of_sizes({crowded - 1, crowded, crowded + 1, 0, crowded, 1, crowded + 1, 2 * crowded}, 10);
    expect_sorted(keys, wide_ids(keys.size(), 11), 8);
}

TEST_F(CountingSortTest, AsManyCrowdedKeysAsTheElementsAllow)
{
    const Words keys = keys_of_sizes(Words(200, crowded + 1), 12);
    expect_sorted(keys, wide_ids(keys.size(), 13), 200);
}

// The list of crowded keys has no room for them.
TEST_F(CountingSortTest, ManyKeysThatAreAlmostCrowded)
{
    const Words keys = keys_of_sizes(Words(200, crowded), 12);
    expect_sorted(keys, wide_ids(keys.size(), 13), 200);
}

// The radix sort goes from one array to the other and back: the result ends in either one.
TEST_F(CountingSortTest, CrowdedKeysWithIdsOfAnyNumberOfDigits)
{
    constexpr std::uint32_t count = 16 * crowded;
    for (std::uint32_t shift = 0; shift <= 16; shift += 2) {
        Words ids = shuffled_ids(count, shift);
        for (std::uint32_t& id : ids) {
            id = ((id >> 7) << (7 + shift)) | (id & 127u) |
                 0x80000000u; // two groups of bits, a gap, and one that is set
        }
        expect_sorted(Words(count, 0), ids, 1);
    }
}

// Digits in which the ids do not differ are skipped: one element is enough to need them.
TEST_F(CountingSortTest, ACrowdedKeyInWhichOneIdAloneHasAHighBit)
{
    constexpr std::uint32_t count = 8 * crowded;
    for (const std::uint32_t place : {0u, 100u, 1001u, 2222u, count - 1}) {
        Words ids = shuffled_ids(count, place);
        ids[place] |= 0x40000000u;
        expect_sorted(Words(count, 0), ids, 1);
    }
}

TEST_F(CountingSortTest, SortsRecordedTogetherMayShareTheirScratch)
{
    const SortCase first(random_keys(60'000, 4000, 14), shuffled_ids(60'000, 15), 4000);
    const SortCase second(random_keys(60'000, 4000, 16), shuffled_ids(60'000, 17), 4000);
    const SortCase crowded_one(random_keys(60'000, 3, 18), shuffled_ids(60'000, 19), 3);
    gpu::Commands commands(context());
    commands.begin();
    for (const SortCase* data_set : {&first, &crowded_one, &second, &crowded_one, &first}) {
        data_set->record(commands, first.scratch);
    }
    commands.submit();
    commands.wait();
    first.check();
    second.check();
    crowded_one.check();
}

// The next sort's keys are this one's order: each pass must wait for the one before it, across sorts too.
TEST_F(CountingSortTest, ASortOfASortsResult)
{
    const Words keys = random_keys(20'000, 20'000, 20);
    const Words ids = shuffled_ids(keys.size(), 21);
    const SortCase first(keys, ids, 20'000);
    const SortCase second(first.expected.order, ids, 20'000);
    gpu::Commands commands(context());
    commands.begin();
    first.record(commands, first.scratch);
    counting_sort().record(commands, {.keys = first.order, .ids = first.ids, .count = 20'000, .key_count = 20'000},
                           {.starts = second.starts, .order = second.order}, first.scratch);
    commands.submit();
    commands.wait();
    first.check();
    second.check();
}

TEST_F(CountingSortTest, ResultsAreTheSameFromRunToRun)
{
    const SortCase data_set(random_keys(100'000, 20, 22), shuffled_ids(100'000, 23), 20);
    gpu::Commands commands(context());
    for (int run = 0; run < 5; ++run) {
        commands.begin();
        commands.fill(data_set.order, sentinel);
        data_set.record(commands, data_set.scratch);
        commands.submit();
        commands.wait();
        data_set.check();
    }
}

TEST_F(CountingSortTest, ABufferTooSmallIsRefused)
{
    constexpr std::uint32_t count = 8 * crowded;
    constexpr std::uint32_t key_count = 100'000;
    const SortCase large(Words(count, 0), shuffled_ids(count, 25), key_count);
    const gpu::Buffer small = gpu::make_buffer<std::uint32_t>(context(), 4, "small");
    const auto& sort = counting_sort();
    gpu::Commands commands(context());
    commands.begin();
    const auto expect_refused = [&](const gpu::Buffer& keys, const gpu::Buffer& ids, const gpu::Buffer& starts,
                                    const gpu::Buffer& order, const primitives::CountingSort::Scratch& scratch) {
        EXPECT_THROW(sort.record(commands, {.keys = keys, .ids = ids, .count = count, .key_count = key_count},
                                 {.starts = starts, .order = order}, scratch),
                     std::logic_error);
    };
    expect_refused(small, large.ids, large.starts, large.order, large.scratch);
    expect_refused(large.keys, small, large.starts, large.order, large.scratch);
    expect_refused(large.keys, large.ids, small, large.order, large.scratch);
    expect_refused(large.keys, large.ids, large.starts, small, large.scratch);
    using Scratch = primitives::CountingSort::Scratch;
    for (gpu::Buffer Scratch::*member :
         {&Scratch::counts, &Scratch::unordered, &Scratch::slot_ids, &Scratch::crowded, &Scratch::scan}) {
        Scratch scratch = sort.make_scratch(count, key_count);
        scratch.*member = gpu::make_buffer<std::uint32_t>(context(), 4, "small");
        expect_refused(large.keys, large.ids, large.starts, large.order, scratch);
    }
    commands.submit();
    commands.wait();
}

} // namespace
} // namespace meltpoint
