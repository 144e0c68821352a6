#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "core/error.h"

namespace meltpoint {

/// The value of a word that is a number as a whole: decimal, in any notation that C++ knows, nan and inf too.
[[nodiscard]] std::optional<double> to_number(std::string_view word);

/// Walks over the words of a text file, and says in its errors which line they stand on. The text must outlive it.
class TextScanner {
public:
    /// first_line: the number of the text's first line in the file.
    TextScanner(std::span<const std::uint8_t> text, std::string name, std::size_t first_line = 1)
        : text_(reinterpret_cast<const char*>(text.data()), text.size()), name_(std::move(name)),
          first_line_(first_line)
    {
    }

    /// The next word, on this line or a later one; empty at the end of the text.
    std::string_view word()
    {
        while (at_ < text_.size() && is_space(text_[at_])) {
            ++at_;
        }
        return take();
    }

    /// The next word of this line; empty at its end.
    std::string_view word_on_line()
    {
        while (at_ < text_.size() && is_space(text_[at_]) && text_[at_] != '\n') {
            ++at_;
        }
        return take();
    }

    /// Goes to the beginning of the next line, even from the middle of this one. False at the end of the text.
    bool next_line()
    {
        at_ = std::min(text_.find('\n', at_), text_.size() - 1) + 1;
        return at_ < text_.size();
    }

    /// Goes to the first word of the next line that holds more than blanks and a comment (from # to the end of a line).
    /// That may be this line, where nothing of it was read. False at the end of the text.
    bool next_content();

    /// The value of a word that must be a number (to_number). `what` names it in the error: "a coordinate".
    [[nodiscard]] double number(std::string_view word, std::string_view what) const;

    /// The value of a word that must be a whole number from 0 to 2^53.
    [[nodiscard]] std::uint64_t count(std::string_view word, std::string_view what) const;

    /// An Input error "name:line: message".
    template <class... Args>
    [[nodiscard]] Error error(fmt::format_string<Args...> format, Args&&... args) const
    {
        return input_error("{}:{}: {}", name_, line(), fmt::format(format, std::forward<Args>(args)...));
    }

private:
    static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

    std::string_view take()
    {
        word_begin_ = at_;
        while (at_ < text_.size() && !is_space(text_[at_])) {
            ++at_;
        }
        return text_.substr(word_begin_, at_ - word_begin_);
    }

    [[nodiscard]] std::size_t line() const;

    std::string_view text_;
    std::string name_;
    std::size_t first_line_;
    std::size_t at_ = 0;
    std::size_t word_begin_ = 0; ///< of the last word taken: where errors are
};

} // namespace meltpoint
