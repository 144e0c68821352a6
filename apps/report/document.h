#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace meltpoint::report {

/// Text between <!-- report:NAME --> and <!-- report end --> is a report's section; the lines around it are anyone's.

/// The names of a text's sections, in order. Throws Input, with the number of the line, for one without an end, or that
/// begins within another; `source` stands for the text in messages.
[[nodiscard]] std::vector<std::string> section_names(std::string_view text, const std::string& source);

/// The text with new content for its sections: content(name) is Markdown that ends with a newline, or null to keep what
/// is there. Throws as section_names.
[[nodiscard]] std::string replace_sections(std::string_view text, const std::string& source,
                                           const std::function<const std::string*(std::string_view)>& content);

/// A new text of such sections.
[[nodiscard]] std::string section(std::string_view name, std::string_view content);

using Row = std::vector<std::string>;

/// A Markdown table; rows have as many cells as the header.
[[nodiscard]] std::string table(const Row& header, std::span<const Row> rows);

} // namespace meltpoint::report
