#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "scene/scene_value.h"

namespace meltpoint {

enum class TomlEntryKind {
    Value,
    Table,        ///< [path], or a table in braces
    TableArray,   ///< the array that [[path]] is an element of
    TableElement, ///< [[path]]: path.0, path.1, ...
};

/// One key of a TOML text, or the mention of one of its tables.
struct TomlEntry {
    std::string path; ///< "fluid.0.velocity"
    TomlEntryKind kind = TomlEntryKind::Value;
    SceneValue value;  ///< of a Value
    std::string where; ///< "FILE:LINE", or the override
    bool is_override = false;
};

/// All entries of a TOML text, in the order of the text. Tables deeper than a scene can use are cut off below their
/// entry. Throws Error (Input) with FILE:LINE:COLUMN and the parser's sentence when the text is not TOML.
std::vector<TomlEntry> read_toml(std::string_view text, const std::string& source_name);

/// The entries of one override "key=value": one, or several when the value is a table. The value is TOML; a bare word
/// that is no TOML value is a string. Throws Error (Input) that names the override.
std::vector<TomlEntry> read_toml_override(const std::string& text);

} // namespace meltpoint
