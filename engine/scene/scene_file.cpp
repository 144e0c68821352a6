#include "scene/scene_file.h"

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <system_error>
#include <utility>

#include "core/error.h"
#include "core/nearest_name.h"
#include "scene/key_table.h"
#include "scene/scene_check.h"
#include "scene/toml_entries.h"

namespace meltpoint {

namespace {

constexpr std::size_t LARGEST_FILE = std::size_t{16} << 20; // bytes
constexpr std::string_view FLUID = "fluid";
constexpr std::string_view BUILTIN_MESH = "builtin:";

// --- names of keys and tables --------------------------------------------------------------------

/// "physics" of "physics.viscosity", empty for a top-level key.
std::string_view table_of(std::string_view path)
{
    const std::size_t dot = path.rfind('.');
    return dot == std::string_view::npos ? std::string_view{} : path.substr(0, dot);
}

std::string_view leaf_of(std::string_view path)
{
    return path.substr(path.rfind('.') + 1);
}

template <class Owner>
const Key<Owner>* find_key(std::span<const Key<Owner>> keys, std::string_view name)
{
    const auto found = std::ranges::find(keys, name, &Key<Owner>::name);
    return found == keys.end() ? nullptr : &*found;
}

bool is_table(std::string_view path)
{
    return !path.empty() &&
           std::ranges::any_of(scene_keys(), [&](const SceneKey& key) { return table_of(key.name) == path; });
}

/// "fluid.2.radius" taken apart.
struct FluidPath {
    std::size_t index = 0;
    std::string_view name; ///< empty for the table itself, "fluid.2"
};

std::optional<FluidPath> split_fluid_path(std::string_view path)
{
    if (!path.starts_with("fluid.")) {
        return std::nullopt;
    }
    const std::string_view rest = path.substr(FLUID.size() + 1);
    FluidPath result;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), result.index);
    if (error != std::errc{} || (end != rest.data() + rest.size() && *end != '.')) {
        return std::nullopt;
    }
    const auto digits = static_cast<std::size_t>(end - rest.data());
    if (rest.substr(0, digits) != std::to_string(result.index)) {
        return std::nullopt; // fluid.00 is no second name of fluid.0
    }
    result.name = digits == rest.size() ? std::string_view{} : rest.substr(digits + 1);
    return result;
}

/// Every path that a scene with so many fluids knows, tables included.
std::vector<std::string> known_paths(std::size_t fluid_count)
{
    std::vector<std::string> paths;
    for (const SceneKey& key : scene_keys()) {
        const std::string table(table_of(key.name));
        if (!table.empty() && std::ranges::find(paths, table) == paths.end()) {
            paths.push_back(table);
        }
        paths.emplace_back(key.name);
    }
    paths.emplace_back(FLUID);
    for (std::size_t i = 0; i < fluid_count; ++i) {
        for (const FluidKey& key : fluid_keys()) {
            paths.push_back(fmt::format("{}.{}.{}", FLUID, i, key.name));
        }
    }
    return paths;
}

/// What to say after "is unknown": the key most likely meant, or else the keys of the same table.
std::string hint(std::string_view path, std::size_t fluid_count)
{
    const std::vector<std::string> known = known_paths(fluid_count);
    const std::string_view table = table_of(path);
    std::vector<std::string> siblings;
    for (const std::string& candidate : known) {
        if (table_of(candidate) == table) {
            siblings.emplace_back(leaf_of(candidate));
        }
    }
    std::optional<std::string> meant = nearest_name(leaf_of(path), siblings);
    if (meant && !table.empty()) {
        meant = fmt::format("{}.{}", table, *meant);
    }
    if (!meant) { // the right key in the wrong table
        const auto same_leaf =
            std::ranges::find_if(known, [&](const std::string& each) { return leaf_of(each) == leaf_of(path); });
        meant = same_leaf != known.end() ? *same_leaf : nearest_name(path, known);
    }
    if (meant) {
        return fmt::format("did you mean \"{}\"?", *meant);
    }
    return siblings.empty()
               ? fmt::format("there is no table \"{}\"", table)
               : fmt::format("{} has the keys {}", table.empty() ? "a scene" : fmt::format("\"{}\"", table),
                             fmt::join(siblings, ", "));
}

// --- reading -------------------------------------------------------------------------------------

[[noreturn]] void fail(const TomlEntry& entry, const std::string& what)
{
    constexpr std::size_t LONGEST_PATH = 120;
    const std::string path = entry.path.size() > LONGEST_PATH ? entry.path.substr(0, LONGEST_PATH) + "..." : entry.path;
    throw input_error("{}: key \"{}\" {}", entry.where, path, what);
}

/// The scene of a list of entries, each key checked by itself.
class SceneBuilder {
public:
    SceneBuilder(std::span<const TomlEntry> entries, const std::filesystem::path& base_dir)
        : entries_(entries), base_dir_(base_dir)
    {
        for (const TomlEntry& entry : entries) {
            by_path_.emplace(entry.path, &entry);
        }
    }

    Scene build()
    {
        const auto is_element = [](const TomlEntry& entry) {
            return entry.kind == TomlEntryKind::TableElement;
        };
        scene_.fluids.resize(static_cast<std::size_t>(std::ranges::count_if(
            entries_, [&](const TomlEntry& entry) { return is_element(entry) && table_of(entry.path) == FLUID; })));
        for (const TomlEntry& entry : entries_) {
            check_structure(entry);
        }
        for (std::size_t i = 0; i < scene_.fluids.size(); ++i) {
            set_shape(i);
        }
        for (const TomlEntry& entry : entries_) {
            if (entry.kind == TomlEntryKind::Value) {
                set(entry);
            }
        }
        for (std::size_t i = 0; i < scene_.fluids.size(); ++i) {
            check_required(i);
        }
        return std::move(scene_);
    }

private:
    /// Is the path known, and a table where a table is due?
    void check_structure(const TomlEntry& entry) const
    {
        const std::string& path = entry.path;
        const auto fluid = split_fluid_path(path);
        if (fluid && fluid->index >= scene_.fluids.size()) {
            fail(entry, fmt::format("is unknown; the scene has {} fluid{}, counted from 0", scene_.fluids.size(),
                                    scene_.fluids.size() == 1 ? "" : "s"));
        }
        if (path == FLUID) {
            const auto* array = std::get_if<SceneValue::Array>(&entry.value.data);
            const bool is_empty_array =
                entry.kind == TomlEntryKind::Value && array != nullptr && array->empty(); // no fluids: checked later
            if (entry.kind != TomlEntryKind::TableArray && !is_empty_array) {
                fail(entry, "must be an array of tables: [[fluid]], once for each fluid");
            }
        } else if (is_table(path)) {
            if (entry.kind != TomlEntryKind::Table) {
                fail(entry, fmt::format("must be one table: [{}]", path));
            }
        } else if (const bool is_fluid_table = fluid && fluid->name.empty();
                   !is_fluid_table || entry.kind == TomlEntryKind::Value) {
            check_is_key(entry, fluid);
        }
    }

    void check_is_key(const TomlEntry& entry, const std::optional<FluidPath>& fluid) const
    {
        const auto check_value = [&](const auto* key) {
            if (key == nullptr) {
                fail(entry, "is unknown; " + hint(entry.path, scene_.fluids.size()));
            }
            if (entry.kind != TomlEntryKind::Value) {
                fail(entry, "is a table, but must be " + describe(key->rule, key->unit));
            }
        };
        if (fluid) {
            check_value(find_key(fluid_keys(), fluid->name));
        } else {
            check_value(find_key(scene_keys(), entry.path));
        }
    }

    [[nodiscard]] const TomlEntry* find(std::string_view path) const
    {
        const auto found = by_path_.find(path);
        return found == by_path_.end() ? nullptr : found->second;
    }

    void set_shape(std::size_t index)
    {
        const std::string path = fmt::format("{}.{}", FLUID, index);
        const TomlEntry* shape = find(path + ".shape");
        const FluidKey& key = *find_key(fluid_keys(), "shape");
        if (shape == nullptr) {
            fail(*find(path), fmt::format("has no \"shape\", which must be {}", describe(key.rule, key.unit)));
        }
        set_value(key, scene_.fluids[index], *shape);
    }

    template <class Owner>
    void set_value(const Key<Owner>& key, Owner& owner, const TomlEntry& entry)
    {
        if (!accepts(key.rule, entry.value)) {
            fail(entry, complaint(key.rule, key.unit, entry.value));
        }
        key.set(owner, entry.value);
    }

    void set(const TomlEntry& entry)
    {
        const auto fluid = split_fluid_path(entry.path);
        if (!fluid) {
            if (const SceneKey* key = find_key(scene_keys(), entry.path)) { // else it is "fluid = []"
                set_value(*key, scene_, entry);
            }
            return;
        }
        const FluidKey& key = *find_key(fluid_keys(), fluid->name);
        FluidBody& body = scene_.fluids[fluid->index];
        if (key.name == "shape") {
            return; // set before all others
        }
        if (!key.shape.empty() && key.shape != shape_name(body)) {
            fail(entry, fmt::format(R"(belongs to shape = "{}", but this fluid has shape = "{}" with the keys {})",
                                    key.shape, shape_name(body), fmt::join(keys_of_shape(shape_name(body)), ", ")));
        }
        set_value(key, body, entry);
        if (key.name == "mesh") {
            resolve_mesh(std::get<MeshShape>(body.shape), entry);
        }
    }

    /// A path typed into an override is meant from where it was typed.
    void resolve_mesh(MeshShape& shape, const TomlEntry& entry) const
    {
        if (!shape.mesh.starts_with(BUILTIN_MESH)) {
            const std::filesystem::path base = entry.is_override ? std::filesystem::path() : base_dir_;
            shape.mesh = std::filesystem::absolute(base / shape.mesh).lexically_normal().string();
        }
    }

    static std::vector<std::string_view> keys_of_shape(std::string_view shape)
    {
        std::vector<std::string_view> names;
        for (const FluidKey& key : fluid_keys()) {
            if (key.shape == shape) {
                names.push_back(key.name);
            }
        }
        return names;
    }

    void check_required(std::size_t index) const
    {
        const std::string path = fmt::format("{}.{}", FLUID, index);
        const std::string_view shape = shape_name(scene_.fluids[index]);
        for (const FluidKey& key : fluid_keys()) {
            if (key.required && key.shape == shape && find(fmt::format("{}.{}", path, key.name)) == nullptr) {
                fail(*find(path), fmt::format("is a {} without \"{}\", which must be {}", shape, key.name,
                                              describe(key.rule, key.unit)));
            }
        }
    }

    std::span<const TomlEntry> entries_;
    std::map<std::string_view, const TomlEntry*> by_path_;
    const std::filesystem::path& base_dir_;
    Scene scene_;
};

/// Lets an override replace what it names: a key, all keys of a table, or all fluids.
void apply_override(std::vector<TomlEntry>& entries, const std::string& text)
{
    std::vector<TomlEntry> added = read_toml_override(text);
    const std::string path = added.front().path;
    std::erase_if(entries, [&](const TomlEntry& old) {
        const bool is_named = old.path == path || old.path.starts_with(path + ".");
        return is_named && (old.kind == TomlEntryKind::Value || path == FLUID);
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
    Scene scene = SceneBuilder(entries, base_dir).build();
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
    for (const FluidBody& body : scene.fluids) {
        text += fmt::format("\n[[{}]]\n", FLUID);
        for (const FluidKey& key : fluid_keys()) {
            if (key.shape.empty() || key.shape == shape_name(body)) {
                text += line(key, body);
            }
        }
    }
    return text;
}

} // namespace meltpoint
