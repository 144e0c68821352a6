#pragma once

#include <cstdint>

namespace meltpoint {

/// Seeded random numbers: SplitMix64 (Steele, Lea & Flood 2014). A stream is a pure function of (seed, stream), so work
/// split over threads draws the same numbers whatever the thread count: give each item its own stream.
class Random {
public:
    explicit Random(std::uint64_t seed, std::uint64_t stream = 0)
        : state_(mix(seed) ^ mix(stream + 0x632be59bd9b4e019ULL))
    {
    }

    /// 64 uniformly distributed bits.
    std::uint64_t next()
    {
        state_ += 0x9e3779b97f4a7c15ULL;
        return mix(state_);
    }

    /// Uniform in [0, 1), 53 bits.
    double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }

    /// Uniform in [0, bound) without modulo bias worth the name (Lemire 2019, multiply-shift).
    std::uint32_t below(std::uint32_t bound) { return static_cast<std::uint32_t>(((next() >> 32) * bound) >> 32); }

private:
    static std::uint64_t mix(std::uint64_t z)
    {
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        return z ^ (z >> 31);
    }

    std::uint64_t state_;
};

} // namespace meltpoint
