#include "io/text_scanner.h"

#include <cctype>
#include <charconv>
#include <limits>
#include <system_error>

namespace meltpoint {

namespace {

/// A word as it can stand in a message: short, and without control characters.
std::string quoted(std::string_view word)
{
    constexpr std::size_t longest = 40;
    std::string text(word.substr(0, longest));
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return std::isprint(c) == 0; }, '?');
    return fmt::format("\"{}{}\"", text, word.size() > longest ? "..." : "");
}

} // namespace

std::optional<double> to_number(std::string_view word)
{
    const std::string_view digits = word.starts_with('+') ? word.substr(1) : word;
    double value = 0.0;
    const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (end != digits.data() + digits.size()) {
        return {};
    }
    if (code == std::errc::result_out_of_range) { // 1e-999 or 1e999
        return digits.find("e-") != std::string_view::npos ? 0.0 : std::numeric_limits<double>::infinity();
    }
    return code == std::errc() ? std::optional(value) : std::nullopt;
}

bool TextScanner::next_content()
{
    while (true) {
        const std::size_t before = at_;
        const std::string_view first = word_on_line();
        if (!first.empty() && first.front() != '#') {
            at_ = before;
            return true;
        }
        if (!next_line()) {
            return false;
        }
    }
}

double TextScanner::number(std::string_view word, std::string_view what) const
{
    const std::optional<double> value = to_number(word);
    if (!value) {
        throw word.empty() ? error("{} is missing", what) : error("{} is {}, not a number", what, quoted(word));
    }
    return *value;
}

std::uint64_t TextScanner::count(std::string_view word, std::string_view what) const
{
    std::uint64_t value = 0;
    const auto [end, code] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (code != std::errc() || end != word.data() + word.size() || value > std::uint64_t{1} << 53) {
        throw word.empty() ? error("{} is missing", what) : error("{} is {}, not a whole number", what, quoted(word));
    }
    return value;
}

std::size_t TextScanner::line() const
{
    const std::string_view before = text_.substr(0, word_begin_);
    return first_line_ + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

} // namespace meltpoint
