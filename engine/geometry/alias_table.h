#pragma once

#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "core/random.h"

namespace meltpoint {

/// Draws indices with given relative weights: built in O(n), drawn from in O(1) (Walker 1977, built as in Vose 1991).
class AliasTable {
public:
    /// At least one weight; none negative, their sum positive and finite. An index of weight zero is never drawn.
    explicit AliasTable(std::span<const double> weights) : slots_(weights.size())
    {
        const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
        std::vector<double> share(weights.size()); // of the weight, in slots: 1 on average
        std::vector<std::uint32_t> small;
        std::vector<std::uint32_t> large;
        std::uint32_t heaviest = 0;
        for (std::uint32_t i = 0; i < weights.size(); ++i) {
            share[i] = weights[i] / sum * static_cast<double>(weights.size());
            (share[i] < 1.0 ? small : large).push_back(i);
            heaviest = weights[i] > weights[heaviest] ? i : heaviest;
        }
        // Each small share takes one slot and fills it up from a large one.
        while (!small.empty() && !large.empty()) {
            const std::uint32_t low = small.back();
            const std::uint32_t high = large.back();
            small.pop_back();
            slots_[low] = {share[low], high};
            share[high] -= 1.0 - share[low];
            if (share[high] < 1.0) {
                large.pop_back();
                small.push_back(high);
            }
        }
        // Rounding leaves some: large ones keep their slot, and what a small one lacks falls to the heaviest.
        for (const std::uint32_t i : large) {
            slots_[i] = {1.0, i};
        }
        for (const std::uint32_t i : small) {
            slots_[i] = {share[i], heaviest};
        }
    }

    [[nodiscard]] std::uint32_t draw(Random& random) const
    {
        const Slot& slot = slots_[random.below(static_cast<std::uint32_t>(slots_.size()))];
        const auto own = static_cast<std::uint32_t>(&slot - slots_.data());
        return random.uniform() < slot.own_share ? own : slot.alias;
    }

private:
    struct Slot {
        double own_share = 1.0;
        std::uint32_t alias = 0;
    };

    std::vector<Slot> slots_;
};

} // namespace meltpoint
