#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace meltpoint {

/// A value as a scene file writes it, free of any parser.
struct SceneValue {
    /// What TOML knows and scenes do not: a date, a table in an array.
    struct Foreign {
        std::string what;
        bool operator==(const Foreign&) const = default;
    };
    using Array = std::vector<SceneValue>;

    std::variant<bool, std::int64_t, double, std::string, Array, Foreign> data;

    bool operator==(const SceneValue&) const = default;
};

/// The value in TOML, on one line. Numbers that are floats in disguise are written with a float's shortest digits.
std::string to_toml(const SceneValue& value);

enum class ValueKind { Boolean, Boolean3, Integer, Number, Vector2, Vector3, Matrix3, Text, Choice };

/// What a key accepts. Plain data, so that checking, error messages and the documentation cannot disagree.
struct ValueRule {
    ValueKind kind = ValueKind::Number;
    double min = 0.0; ///< of every number; of a text, its length in bytes
    double max = 0.0;
    std::vector<std::string_view> choices; ///< of a Choice
    bool automatic = false;                ///< accepts "auto" too
};

/// "a number from 0 to 10000 Pa s or "auto"": the second half of "must be ...".
std::string describe(const ValueRule& rule, std::string_view unit);

/// True when the rule accepts the value: its type, every number finite and in range (after rounding to float).
bool accepts(const ValueRule& rule, const SceneValue& value);

/// The middle of the sentence about a value that the rule does not accept: "is -1.0, but must be a number from ...".
std::string complaint(const ValueRule& rule, std::string_view unit, const SceneValue& value);

/// True when the value is the string "auto".
bool is_auto(const SceneValue& value);

} // namespace meltpoint
