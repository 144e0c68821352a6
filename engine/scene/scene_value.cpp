#include "scene/scene_value.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/nearest_name.h"

namespace meltpoint {

namespace {

constexpr double LARGEST_FLOAT = std::numeric_limits<float>::max();

/// Numbers end up as floats: they are checked as the floats they become, so that 0.7 passes a limit of 0.7f either way.
bool in_range(double number, double min, double max)
{
    if (!(std::abs(number) <= LARGEST_FLOAT)) {
        return false; // infinite, NaN, or no float at all
    }
    const auto narrowed = static_cast<float>(number);
    return narrowed >= static_cast<float>(min) && narrowed <= static_cast<float>(max);
}

bool is_number_in_range(const SceneValue& value, const ValueRule& rule)
{
    if (const auto* number = std::get_if<double>(&value.data)) {
        return in_range(*number, rule.min, rule.max);
    }
    const auto* integer = std::get_if<std::int64_t>(&value.data);
    return integer != nullptr && in_range(static_cast<double>(*integer), rule.min, rule.max);
}

template <class Predicate>
bool is_array_of(const SceneValue& value, std::size_t size, const Predicate& accepts_element)
{
    const auto* array = std::get_if<SceneValue::Array>(&value.data);
    return array != nullptr && array->size() == size && std::ranges::all_of(*array, accepts_element);
}

/// Length in bytes of the UTF-8 character at the head of the text, 0 where there is none (RFC 3629, section 4).
std::size_t utf8_length(std::string_view text)
{
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
    };
    const auto in = [&](std::size_t i, unsigned low, unsigned high) {
        return byte(i) >= low && byte(i) <= high;
    };
    const auto tail = [&](std::size_t i) {
        return in(i, 0x80, 0xbf);
    };
    if (byte(0) < 0x80) {
        return 1;
    }
    if (in(0, 0xc2, 0xdf)) {
        return tail(1) ? 2 : 0;
    }
    if (in(0, 0xe0, 0xef)) {
        const bool second = byte(0) == 0xe0 ? in(1, 0xa0, 0xbf) : byte(0) == 0xed ? in(1, 0x80, 0x9f) : tail(1);
        return second && tail(2) ? 3 : 0;
    }
    if (in(0, 0xf0, 0xf4)) {
        const bool second = byte(0) == 0xf0 ? in(1, 0x90, 0xbf) : byte(0) == 0xf4 ? in(1, 0x80, 0x8f) : tail(1);
        return second && tail(2) && tail(3) ? 4 : 0;
    }
    return 0;
}

bool is_text(const SceneValue& value, const ValueRule& rule)
{
    const auto* text = std::get_if<std::string>(&value.data);
    if (text == nullptr || static_cast<double>(text->size()) < rule.min ||
        static_cast<double>(text->size()) > rule.max || text->find('\0') != std::string::npos) {
        return false;
    }
    for (std::size_t i = 0; i < text->size();) {
        const std::size_t length = utf8_length(std::string_view(*text).substr(i));
        if (length == 0) {
            return false;
        }
        i += length;
    }
    return true;
}

std::string number_to_toml(double number)
{
    const bool is_float =
        std::abs(number) <= LARGEST_FLOAT && static_cast<double>(static_cast<float>(number)) == number;
    std::string text = is_float ? fmt::format("{}", static_cast<float>(number)) : fmt::format("{}", number);
    if (text.find_first_of(".en") == std::string::npos) { // neither a fraction, an exponent, inf nor nan
        text += ".0";
    }
    return text;
}

std::string string_to_toml(std::string_view text)
{
    std::string quoted = "\"";
    for (const char c : text) {
        switch (c) {
        case '"':
            quoted += "\\\"";
            break;
        case '\\':
            quoted += "\\\\";
            break;
        case '\n':
            quoted += "\\n";
            break;
        case '\t':
            quoted += "\\t";
            break;
        default:
            if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
                quoted += fmt::format("\\u{:04X}", static_cast<unsigned>(c));
            } else {
                quoted += c;
            }
        }
    }
    return quoted + '"';
}

struct TomlWriter {
    std::string operator()(bool value) const { return value ? "true" : "false"; }
    std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
    std::string operator()(double value) const { return number_to_toml(value); }
    std::string operator()(const std::string& value) const { return string_to_toml(value); }
    std::string operator()(const SceneValue::Foreign& value) const { return value.what; }
    std::string operator()(const SceneValue::Array& values) const
    {
        std::string text = "[";
        for (const SceneValue& value : values) {
            text += (text.size() > 1 ? ", " : "") + to_toml(value);
        }
        return text + "]";
    }
};

} // namespace

std::string to_toml(const SceneValue& value)
{
    return std::visit(TomlWriter{}, value.data);
}

bool is_auto(const SceneValue& value)
{
    const auto* text = std::get_if<std::string>(&value.data);
    return text != nullptr && *text == "auto";
}

bool accepts(const ValueRule& rule, const SceneValue& value)
{
    if (rule.automatic && is_auto(value)) {
        return true;
    }
    const auto is_number = [&](const SceneValue& element) {
        return is_number_in_range(element, rule);
    };
    switch (rule.kind) {
    case ValueKind::Boolean:
        return std::holds_alternative<bool>(value.data);
    case ValueKind::Boolean3:
        return is_array_of(value, 3, [](const SceneValue& each) { return std::holds_alternative<bool>(each.data); });
    case ValueKind::Integer: {
        const auto* integer = std::get_if<std::int64_t>(&value.data);
        return integer != nullptr && static_cast<double>(*integer) >= rule.min &&
               static_cast<double>(*integer) <= rule.max;
    }
    case ValueKind::Number:
        return is_number(value);
    case ValueKind::Vector2:
        return is_array_of(value, 2, is_number);
    case ValueKind::Vector3:
        return is_array_of(value, 3, is_number);
    case ValueKind::Matrix3:
        return is_array_of(value, 3, [&](const SceneValue& row) { return is_array_of(row, 3, is_number); });
    case ValueKind::Text:
        return is_text(value, rule);
    case ValueKind::Choice: {
        const auto* text = std::get_if<std::string>(&value.data);
        return text != nullptr && std::ranges::find(rule.choices, *text) != rule.choices.end();
    }
    }
    return false;
}

std::string describe(const ValueRule& rule, std::string_view unit)
{
    const std::string range =
        fmt::format("from {:.16g} to {:.16g}{}{}", rule.min, rule.max, unit.empty() ? "" : " ", unit);
    std::string text;
    switch (rule.kind) {
    case ValueKind::Boolean:
        text = "true or false";
        break;
    case ValueKind::Boolean3:
        text = "[x, y, z], each true or false";
        break;
    case ValueKind::Integer:
        text = "a whole number " + range;
        break;
    case ValueKind::Number:
        text = "a number " + range;
        break;
    case ValueKind::Vector2:
        text = "[a, b], each " + range;
        break;
    case ValueKind::Vector3:
        text = "[x, y, z], each " + range;
        break;
    case ValueKind::Matrix3:
        text = "three rows of three numbers, each " + range;
        break;
    case ValueKind::Text:
        text = fmt::format("a string of {:g} to {:g} bytes of UTF-8", rule.min, rule.max);
        break;
    case ValueKind::Choice:
        for (const std::string_view choice : rule.choices) {
            text += fmt::format("{}\"{}\"", text.empty() ? "" : choice == rule.choices.back() ? " or " : ", ", choice);
        }
        break;
    }
    return rule.automatic ? text + " or \"auto\"" : text;
}

std::string complaint(const ValueRule& rule, std::string_view unit, const SceneValue& value)
{
    constexpr std::size_t LONGEST_QUOTE = 80;
    std::string found = to_toml(value);
    if (found.size() > LONGEST_QUOTE) {
        found = fmt::format("{} bytes long", found.size());
    }
    std::string sentence = fmt::format("is {}, but must be {}", found, describe(rule, unit));
    if (const auto* word = std::get_if<std::string>(&value.data); word != nullptr && rule.kind == ValueKind::Choice) {
        const std::vector<std::string> names(rule.choices.begin(), rule.choices.end());
        if (const auto nearest = nearest_name(*word, names)) {
            sentence += fmt::format("; did you mean \"{}\"?", *nearest);
        }
    }
    return sentence;
}

} // namespace meltpoint
