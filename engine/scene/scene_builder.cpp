#include "scene/scene_builder.h"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <system_error>
#include <type_traits>
#include <utility>

#include "core/error.h"
#include "core/nearest_name.h"
#include "scene/key_table.h"
#include "scene/liquids.h"

namespace meltpoint {

namespace {

constexpr std::string_view BUILTIN_MESH = "builtin:";

// --- names of keys and tables --------------------------------------------------------------------

bool is_table(std::string_view path)
{
    return !path.empty() &&
           std::ranges::any_of(scene_keys(), [&](const SceneKey& key) { return table_of(key.name) == path; });
}

/// "fluid.2.radius" taken apart.
struct BodyPath {
    std::string_view list; ///< "fluid"
    std::size_t index = 0;
    std::string_view name; ///< empty for the table itself, "fluid.2"
};

std::optional<BodyPath> split_body_path(std::string_view path)
{
    const std::size_t dot = path.find('.');
    if (dot == std::string_view::npos || !is_body_list(path.substr(0, dot))) {
        return std::nullopt;
    }
    const std::string_view rest = path.substr(dot + 1);
    BodyPath result{.list = path.substr(0, dot)};
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

/// Every path that a scene with so many bodies knows, tables included.
std::vector<std::string> known_paths(const Scene& scene)
{
    std::vector<std::string> paths;
    for (const SceneKey& key : scene_keys()) {
        const std::string table(table_of(key.name));
        if (!table.empty() && std::ranges::find(paths, table) == paths.end()) {
            paths.push_back(table);
        }
        paths.emplace_back(key.name);
    }
    for_each_body_list(scene, [&](std::string_view list, const auto& bodies, const auto& keys) {
        paths.emplace_back(list);
        for (std::size_t i = 0; i < bodies.size(); ++i) {
            for (const auto& key : keys) {
                paths.push_back(fmt::format("{}.{}.{}", list, i, key.name));
            }
        }
    });
    return paths;
}

/// What to say after "is unknown": the key most likely meant, or else the keys of the same table.
std::string hint(std::string_view path, const Scene& scene)
{
    const std::vector<std::string> known = known_paths(scene);
    const std::string_view table = table_of(path);
    std::vector<std::string> siblings;
    for (const std::string& candidate : known) {
        if (table_of(candidate) == table) {
            siblings.emplace_back(leaf_of(candidate));
        }
    }
    std::optional<std::string> meant = nearest_name(leaf_of(path), siblings);
    if (!meant) { // a word of its name
        const auto longer = std::ranges::find_if(siblings, [&](const std::string& each) {
            return fmt::format("_{}_", each).find(fmt::format("_{}_", leaf_of(path))) != std::string::npos;
        });
        meant = longer != siblings.end() ? std::optional(*longer) : std::nullopt;
    }
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
        for_each_body_list(scene_, [&](std::string_view list, auto& bodies, const auto&) {
            bodies.resize(static_cast<std::size_t>(std::ranges::count_if(entries_, [&](const TomlEntry& entry) {
                return entry.kind == TomlEntryKind::TableElement && table_of(entry.path) == list;
            })));
        });
        for (const TomlEntry& entry : entries_) {
            check_structure(entry);
        }
        for_each_body(
            [&](const std::string& path, auto& body, const auto& keys) { set_shape(path, body, keys.front()); });
        set_liquids();
        for (const TomlEntry& entry : entries_) {
            if (entry.kind == TomlEntryKind::Value) {
                set(entry);
            }
        }
        for_each_body([&](const std::string& path, const auto& body, const auto& keys) {
            check_required(path, shape_name(body.shape), keys);
        });
        return std::move(scene_);
    }

private:
    /// Calls visit(path, body, keys of such bodies): path is "fluid.0".
    template <class Visit>
    void for_each_body(const Visit& visit)
    {
        for_each_body_list(scene_, [&](std::string_view list, auto& bodies, const auto& keys) {
            for (std::size_t i = 0; i < bodies.size(); ++i) {
                visit(fmt::format("{}.{}", list, i), bodies[i], keys);
            }
        });
    }

    /// Is the path known, and a table where a table is due?
    void check_structure(const TomlEntry& entry) const
    {
        const std::string& path = entry.path;
        const auto body = split_body_path(path);
        if (body) {
            check_index(entry, *body);
        }
        if (is_body_list(path)) {
            const auto* array = std::get_if<SceneValue::Array>(&entry.value.data);
            const bool is_empty_array =
                entry.kind == TomlEntryKind::Value && array != nullptr && array->empty(); // none: checked later
            if (entry.kind != TomlEntryKind::TableArray && !is_empty_array) {
                fail(entry, fmt::format("must be an array of tables: [[{0}]], once for each {0}", path));
            }
        } else if (is_table(path)) {
            if (entry.kind != TomlEntryKind::Table) {
                fail(entry, fmt::format("must be one table: [{}]", path));
            }
        } else if (const bool is_body_table = body && body->name.empty();
                   !is_body_table || entry.kind == TomlEntryKind::Value) {
            check_is_key(entry, body);
        }
    }

    void check_index(const TomlEntry& entry, const BodyPath& body) const
    {
        for_each_body_list(scene_, [&](std::string_view list, const auto& bodies, const auto&) {
            if (list == body.list && body.index >= bodies.size()) {
                fail(entry, fmt::format("is unknown; the scene has {} {}{}, counted from 0", bodies.size(), list,
                                        bodies.size() == 1 ? "" : "s"));
            }
        });
    }

    void check_is_key(const TomlEntry& entry, const std::optional<BodyPath>& body) const
    {
        const auto check_value = [&](const auto* key) {
            if (key == nullptr) {
                fail(entry, "is unknown; " + hint(entry.path, scene_));
            }
            if (entry.kind != TomlEntryKind::Value) {
                fail(entry, "is a table, but must be " + describe(key->rule, key->unit));
            }
        };
        if (!body) {
            check_value(find_key(scene_keys(), entry.path));
        }
        for_each_body_list(scene_, [&](std::string_view list, const auto&, const auto& keys) {
            if (body && list == body->list) {
                check_value(find_key(keys, body->name));
            }
        });
    }

    [[nodiscard]] const TomlEntry* find(std::string_view path) const
    {
        const auto found = by_path_.find(path);
        return found == by_path_.end() ? nullptr : found->second;
    }

    template <class Body>
    void set_shape(const std::string& path, Body& body, const Key<Body>& key)
    {
        const TomlEntry* shape = find(path + ".shape");
        if (shape == nullptr) {
            fail(*find(path), fmt::format("has no \"shape\", which must be {}", describe(key.rule, key.unit)));
        }
        set_value(key, body, *shape);
    }

    /// The values of named liquids, before those that stand in the scene.
    void set_liquids()
    {
        for_each_body([&](const std::string& path, auto& body, const auto& keys) {
            const auto* key = find_key(keys, "liquid");
            const TomlEntry* entry = find(path + ".liquid");
            if (key != nullptr && entry != nullptr) {
                set_value(*key, body, *entry);
            }
        });
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
        const auto path = split_body_path(entry.path);
        if (!path) {
            if (const SceneKey* key = find_key(scene_keys(), entry.path)) { // else it is "fluid = []"
                set_value(*key, scene_, entry);
            }
            return;
        }
        for_each_body_list(scene_, [&](std::string_view list, auto& bodies, const auto& keys) {
            if (list == path->list) {
                auto& body = bodies[path->index];
                set_in_body(entry, list, body, keys, *find_key(keys, path->name, shape_name(body.shape)));
            }
        });
    }

    template <class Body>
    void set_in_body(const TomlEntry& entry, std::string_view list, Body& body, std::span<const Key<Body>> keys,
                     const Key<Body>& key)
    {
        if (key.name == "shape" || key.name == "liquid") {
            return; // set before all others
        }
        const std::string_view shape = shape_name(body.shape);
        if (!belongs_to(key, shape)) {
            fail(entry, fmt::format(R"(belongs to shape = "{}", but this {} has shape = "{}" with the keys {})",
                                    key.shape, list, shape, fmt::join(keys_of_shape(keys, shape), ", ")));
        }
        set_value(key, body, entry);
        if constexpr (std::is_same_v<decltype(body.shape), BodyShape>) { // those of emitters and sinks are no meshes
            if (key.name == "mesh") {
                resolve_mesh(std::get<MeshShape>(body.shape), entry);
            }
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

    template <class Body>
    static std::vector<std::string_view> keys_of_shape(std::span<const Key<Body>> keys, std::string_view shape)
    {
        std::vector<std::string_view> names;
        for (const Key<Body>& key : keys) {
            if (key.shape == shape) {
                names.push_back(key.name);
            }
        }
        return names;
    }

    template <class Keys>
    void check_required(const std::string& path, std::string_view shape, const Keys& keys) const
    {
        for (const auto& key : keys) {
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

} // namespace

bool is_body_list(std::string_view path)
{
    static const Scene any;
    bool found = false;
    for_each_body_list(any, [&](std::string_view list, const auto&, const auto&) { found |= list == path; });
    return found;
}

Scene build_scene(std::span<const TomlEntry> entries, const std::filesystem::path& base_dir)
{
    return SceneBuilder(entries, base_dir).build();
}

} // namespace meltpoint
