// Optimal string alignment distance: Levenshtein (1966) with swaps of neighbors, by three rolling rows.
#include "core/nearest_name.h"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace meltpoint {

namespace {

constexpr std::size_t LONGEST_WORD =
    256; // nobody means a key by more, and the distance costs the product of the lengths

std::size_t edit_distance(std::string_view a, std::string_view b)
{
    std::vector<std::size_t> before_last(b.size() + 1);
    std::vector<std::size_t> last(b.size() + 1);
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) {
        last[j] = j;
    }
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
            row[j] = std::min({replaced, last[j] + 1, row[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                row[j] = std::min(row[j], before_last[j - 2] + 1);
            }
        }
        std::swap(before_last, last);
        std::swap(last, row);
    }
    return last[b.size()];
}

} // namespace

std::optional<std::string> nearest_name(std::string_view word, std::span<const std::string> names)
{
    if (word.empty() || word.size() > LONGEST_WORD) {
        return std::nullopt;
    }
    const std::string* nearest = nullptr;
    std::size_t nearest_distance = std::max<std::size_t>(1, word.size() / 3) + 1;
    for (const std::string& name : names) {
        const std::size_t distance = edit_distance(word, name);
        if (distance < nearest_distance) {
            nearest_distance = distance;
            nearest = &name;
        }
    }
    return nearest == nullptr ? std::nullopt : std::optional<std::string>(*nearest);
}

} // namespace meltpoint
