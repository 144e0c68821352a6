#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace meltpoint {

/// The name that a mistyped word most likely meant, for "did you mean": the one fewest edits away (insert, delete,
/// replace, swap neighbors), the first of equals. Nothing when even that differs in more than a third of the word.
std::optional<std::string> nearest_name(std::string_view word, std::span<const std::string> names);

} // namespace meltpoint
