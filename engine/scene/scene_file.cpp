#include "scene/scene_file.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "scene/key_table.h"
#include "scene/scene_builder.h"
#include "scene/scene_check.h"
#include "scene/toml_entries.h"

namespace meltpoint {

namespace {

constexpr std::size_t LARGEST_FILE = std::size_t{16} << 20; // bytes

// --- overrides and places of keys ----------------------------------------------------------------

/// Lets an override replace what it names: a key, all keys of a table, or all fluids or colliders.
void apply_override(std::vector<TomlEntry>& entries, const std::string& text)
{
    std::vector<TomlEntry> added = read_toml_override(text);
    const std::string path = added.front().path;
    std::erase_if(entries, [&](const TomlEntry& old) {
        const bool is_named = old.path == path || old.path.starts_with(path + ".");
        return is_named && (old.kind == TomlEntryKind::Value || is_body_list(path));
    });
    std::ranges::move(added, std::back_inserter(entries));
}

/// Where a key, or else the nearest table around it, was last set.
KeyLocator make_locator(std::span<const TomlEntry> entries, const std::string& source_name)
{
    std::map<std::string, std::string, std::less<>> places;
    for (const TomlEntry& entry : entries) {
        places.insert_or_assign(entry.path, entry.where);
    }
    return [places = std::move(places), source_name](std::string_view key) {
        for (; !key.empty(); key = table_of(key)) {
            if (const auto place = places.find(key); place != places.end()) {
                return place->second;
            }
        }
        return source_name;
    };
}

std::string read_text(const std::filesystem::path& path)
{
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
        throw input_error("{}: cannot read the scene: it is a folder", path.string());
    }
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        throw input_error("{}: cannot read the scene: {}", path.string(), std::generic_category().message(errno));
    }
    std::string text(LARGEST_FILE + 1, '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (file.bad()) {
        throw input_error("{}: cannot read the scene: {}", path.string(), std::generic_category().message(errno));
    }
    text.resize(static_cast<std::size_t>(file.gcount()));
    if (text.size() > LARGEST_FILE) {
        throw input_error("{}: larger than 16 MiB, which no scene is", path.string());
    }
    return text;
}

// --- writing -------------------------------------------------------------------------------------

template <class Owner>
std::string line(const Key<Owner>& key, const Owner& owner)
{
    const std::string assignment = fmt::format("{} = {}", leaf_of(key.name), to_toml(key.get(owner)));
    return key.unit.empty() ? assignment + "\n" : fmt::format("{} # {}\n", assignment, key.unit);
}

} // namespace

Scene parse_scene(std::string_view toml, const std::string& source_name, const std::filesystem::path& base_dir,
                  std::span<const std::string> overrides)
{
    std::vector<TomlEntry> entries = read_toml(toml, source_name);
    for (const std::string& text : overrides) {
        apply_override(entries, text);
    }
    Scene scene = build_scene(entries, base_dir);
    validate_scene(scene, make_locator(entries, source_name));
    return scene;
}

Scene read_scene_file(const std::filesystem::path& path, std::span<const std::string> overrides)
{
    Scene scene = parse_scene(read_text(path), path.string(), path.parent_path(), overrides);
    const std::string stem = path.stem().string();
    if (scene.name == Scene{}.name && accepts(find_key(scene_keys(), "name")->rule, {stem})) {
        scene.name = stem;
    }
    return scene;
}

std::string write_scene(const Scene& scene)
{
    validate_scene(scene);
    std::string text;
    std::string_view table;
    for (const SceneKey& key : scene_keys()) {
        if (table_of(key.name) != table) {
            table = table_of(key.name);
            text += fmt::format("\n[{}]\n", table);
        }
        text += line(key, scene);
    }
    for_each_body_list(scene, [&](std::string_view list, const auto& bodies, const auto& keys) {
        for (const auto& body : bodies) {
            text += fmt::format("\n[[{}]]\n", list);
            for (const auto& key : keys) {
                if (belongs_to(key, shape_name(body.shape))) {
                    text += line(key, body);
                }
            }
        }
    });
    return text;
}

} // namespace meltpoint
