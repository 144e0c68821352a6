#include "report/document.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/error.h"

namespace meltpoint::report {

namespace {

constexpr std::string_view begin_mark = "<!-- report:";
constexpr std::string_view mark_end = " -->";
constexpr std::string_view end_mark = "<!-- report end -->";

/// The next line of the rest of a text, its newline included.
std::string_view take_line(std::string_view& rest)
{
    const std::string_view line = rest.substr(0, std::min(rest.find('\n'), rest.size() - 1) + 1);
    rest.remove_prefix(line.size());
    return line;
}

/// Of any system's making: a line that ends with a carriage return too is the same mark.
std::string_view without_newline(std::string_view line)
{
    for (const char end : {'\n', '\r'}) {
        line.remove_suffix(line.ends_with(end) ? 1 : 0);
    }
    return line;
}

/// The name in a line that begins a section; empty in any other.
std::string_view name_in(std::string_view line)
{
    line = without_newline(line);
    const bool begins =
        line.starts_with(begin_mark) && line.ends_with(mark_end) && line.size() > begin_mark.size() + mark_end.size();
    return begins ? line.substr(begin_mark.size(), line.size() - begin_mark.size() - mark_end.size())
                  : std::string_view{};
}

} // namespace

std::string replace_sections(std::string_view text, const std::string& source,
                             const std::function<const std::string*(std::string_view)>& content)
{
    std::string result;
    std::string_view open;
    std::size_t open_line = 0;
    const std::string* replacement = nullptr;
    std::size_t number = 0;
    while (!text.empty()) {
        const std::string_view line = take_line(text);
        ++number;
        const std::string_view name = name_in(line);
        const bool ends = without_newline(line) == end_mark;
        if (!open.empty() && !name.empty()) {
            throw input_error("{}:{}: section \"{}\" begins within section \"{}\" of line {}", source, number, name,
                              open, open_line);
        }
        if (open.empty() && ends) {
            throw input_error("{}:{}: a section ends here, but none has begun", source, number);
        }
        if (ends) {
            open = {};
            replacement = nullptr;
        }
        if (replacement == nullptr) {
            result += line;
        }
        if (!name.empty()) {
            open = name;
            open_line = number;
            replacement = content(name);
            if (replacement != nullptr) {
                result += "\n" + *replacement + "\n"; // an HTML block ends only at an empty line
            }
        }
    }
    if (!open.empty()) {
        throw input_error("{}:{}: section \"{}\" has no end: a line {}", source, open_line, open, end_mark);
    }
    return result;
}

std::vector<std::string> section_names(std::string_view text, const std::string& source)
{
    std::vector<std::string> names;
    static_cast<void>(replace_sections(text, source, [&](std::string_view name) {
        names.emplace_back(name);
        return nullptr;
    }));
    return names;
}

std::string section(std::string_view name, std::string_view content)
{
    return fmt::format("{}{}{}\n\n{}\n{}\n", begin_mark, name, mark_end, content, end_mark);
}

std::string table(const Row& header, std::span<const Row> rows)
{
    const auto line = [](const Row& cells) {
        return fmt::format("| {} |\n", fmt::join(cells, " | "));
    };
    std::string text = line(header) + line(Row(header.size(), "---"));
    for (const Row& row : rows) {
        text += line(row);
    }
    return text;
}

} // namespace meltpoint::report
