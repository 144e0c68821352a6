#include "scene/toml_entries.h"

#include <algorithm>
#include <cctype>
#include <utility>

namespace {

/// What toml++ takes for granted, but a file can break: thrown instead of its assertions.
struct BrokenAssumption {};

[[noreturn]] void throw_broken_assumption()
{
    throw BrokenAssumption();
}

} // namespace

// toml++ 3.3 asserts that a key follows "[" and whatever else it does not check, and where NDEBUG is defined it lets
// the compiler assume so: "[,a]" would end a debug build, and make anything happen in a release.
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(expr) (static_cast<bool>(expr) ? static_cast<void>(0) : throw_broken_assumption())
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

#include "core/error.h"

namespace meltpoint {

namespace {

// Scenes nest three deep (fluid, its index, its key). Deeper tables are unknown keys in any case.
constexpr int DEEPEST_TABLE = 4;

// The parser builds a table for every part of a dotted key and recurses to free them: a key of a hundred thousand parts
// would overflow the stack. No line of a scene has so many dots, prose included.
constexpr int MOST_DOTS_IN_LINE = 64;

using Position = std::pair<toml::source_index, toml::source_index>; // line and column, from 1

Position begin_of(const toml::source_region& region)
{
    return {region.begin.line, region.begin.column};
}

struct PlacedEntry {
    TomlEntry entry;
    Position position;
};

bool is_bare(char c)
{
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
}

/// A key as it appears in a path: quoted when it is not a bare key, so that "a.b" is never taken for a and b.
std::string path_part(std::string_view key)
{
    const bool bare = !key.empty() && std::ranges::all_of(key, is_bare);
    return bare ? std::string(key) : to_toml({std::string(key)});
}

std::string join(const std::string& path, const std::string& part)
{
    return path.empty() ? part : path + "." + part;
}

bool is_array_of_tables(const toml::node& node)
{
    const toml::array* array = node.as_array();
    return array != nullptr && !array->empty() &&
           std::ranges::all_of(*array, [](const toml::node& element) { return element.is_table(); });
}

SceneValue to_value(const toml::node& node, int depth)
{
    if (const auto* boolean = node.as_boolean()) {
        return {boolean->get()};
    }
    if (const auto* integer = node.as_integer()) {
        return {integer->get()};
    }
    if (const auto* number = node.as_floating_point()) {
        return {number->get()};
    }
    if (const auto* text = node.as_string()) {
        return {text->get()};
    }
    if (const auto* array = node.as_array(); array != nullptr && depth < DEEPEST_TABLE) {
        SceneValue::Array values;
        for (const toml::node& element : *array) {
            values.push_back(to_value(element, depth + 1));
        }
        return {values};
    }
    return {SceneValue::Foreign{node.is_table() ? "a table" : node.is_array() ? "a deep array" : "a date or time"}};
}

/// Appends the node and all below it, a table before its keys: nothing is placed before what contains it.
void append_entries(std::vector<PlacedEntry>& entries, const std::string& path, const toml::node& node,
                    Position position, TomlEntryKind kind_of_table, int depth)
{
    if (depth > DEEPEST_TABLE) {
        return;
    }
    if (is_array_of_tables(node)) {
        entries.push_back({{path, TomlEntryKind::TableArray, {}, {}}, position});
        std::size_t index = 0;
        for (const toml::node& element : *node.as_array()) {
            append_entries(entries, join(path, std::to_string(index++)), element,
                           std::max(position, begin_of(element.source())), TomlEntryKind::TableElement, depth + 1);
        }
    } else if (const toml::table* table = node.as_table()) {
        if (!path.empty()) {
            entries.push_back({{path, kind_of_table, {}, {}}, position});
        }
        for (const auto& [key, child] : *table) {
            append_entries(entries, join(path, path_part(key.str())), child, std::max(position, begin_of(key.source())),
                           TomlEntryKind::Table, depth + 1);
        }
    } else {
        entries.push_back({{path, TomlEntryKind::Value, to_value(node, 0), {}}, position});
    }
}

/// The line, from 1, of the first key too deep to parse; 0 when there is none. Rows of dots are no key.
std::size_t line_of_endless_key(std::string_view text)
{
    std::size_t line = 1;
    int dots = 0;
    char last = '\n';
    for (const char c : text) {
        if (c == '\n') {
            ++line;
            dots = 0;
        } else if (c == '.' && last != '.' && ++dots > MOST_DOTS_IN_LINE) {
            return line;
        }
        last = c;
    }
    return 0;
}

/// The first line that begins with "[" and no key behind it, counting from 1; 1 where there is none.
std::size_t line_of_broken_header(std::string_view text)
{
    std::size_t line = 1;
    for (std::size_t at = 0; at < text.size(); ++line) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        const std::string_view row = text.substr(at, end - at);
        const std::size_t bracket = row.find_first_not_of(" \t");
        const std::size_t key = row.find_first_not_of("[ \t", bracket);
        if (bracket != std::string_view::npos && row[bracket] == '[' && key != std::string_view::npos &&
            !is_bare(row[key]) && row[key] != '"' && row[key] != '\'') {
            return line;
        }
        at = end + 1;
    }
    return 1;
}

toml::table parse_toml(std::string_view text, const std::string& source_name)
{
    if (const std::size_t line = line_of_endless_key(text); line > 0) {
        throw input_error("{}:{}: more than {} dots in a line, which no scene needs", source_name, line,
                          MOST_DOTS_IN_LINE);
    }
    try {
        return toml::parse(text);
    } catch (const toml::parse_error& error) {
        throw input_error("{}:{}:{}: {}", source_name, error.source().begin.line, error.source().begin.column,
                          error.description());
    } catch (const BrokenAssumption&) {
        throw input_error("{}:{}: \"[\" is followed by no name of a table", source_name, line_of_broken_header(text));
    }
}

std::string_view trimmed(std::string_view text)
{
    constexpr std::string_view BLANK = " \t";
    const std::size_t begin = text.find_first_not_of(BLANK);
    return begin == std::string_view::npos ? std::string_view{}
                                           : text.substr(begin, text.find_last_not_of(BLANK) - begin + 1);
}

/// What follows the "=" of an override, as the table { value = ... }.
toml::table parse_override_value(const std::string& where, std::string_view value)
{
    constexpr std::string_view OPENING = "\"'[{";
    constexpr std::string_view LINE_BREAK = "\r\n";
    if (value.empty()) {
        throw input_error("{} has no value after \"=\"", where);
    }
    if (value.find_first_of(LINE_BREAK) != std::string_view::npos) {
        throw input_error("{} has a line break", where);
    }
    const bool opens_toml = OPENING.find(value.front()) != std::string_view::npos;
    try {
        return parse_toml("value = " + std::string(value), where);
    } catch (const Error&) {
        if (opens_toml) {
            throw;
        }
        return toml::table{{"value", value}};
    }
}

} // namespace

std::vector<TomlEntry> read_toml(std::string_view text, const std::string& source_name)
{
    const toml::table document = parse_toml(text, source_name);
    std::vector<PlacedEntry> placed;
    append_entries(placed, "", document, {}, TomlEntryKind::Table, 0);

    std::ranges::stable_sort(placed, {}, &PlacedEntry::position);
    std::vector<TomlEntry> entries;
    for (PlacedEntry& each : placed) {
        each.entry.where = fmt::format("{}:{}", source_name, each.position.first);
        entries.push_back(std::move(each.entry));
    }
    return entries;
}

std::vector<TomlEntry> read_toml_override(const std::string& text)
{
    const std::string where = fmt::format("override {}", to_toml({text}));
    const std::size_t equals = text.find('=');
    const std::string_view key = trimmed(std::string_view(text).substr(0, equals));
    const bool is_dotted_key = std::ranges::all_of(key, [](char c) { return is_bare(c) || c == '.'; });
    if (equals == std::string::npos || key.empty() || !is_dotted_key) {
        throw input_error("{} is not of the form key=value, as in physics.viscosity=0.1", where);
    }
    const toml::table parsed = parse_override_value(where, trimmed(std::string_view(text).substr(equals + 1)));

    std::vector<PlacedEntry> placed;
    append_entries(placed, std::string(key), *parsed.get("value"), {}, TomlEntryKind::Table, 0);
    std::vector<TomlEntry> entries;
    for (PlacedEntry& each : placed) {
        each.entry.where = where;
        each.entry.is_override = true;
        entries.push_back(std::move(each.entry));
    }
    return entries;
}

} // namespace meltpoint
