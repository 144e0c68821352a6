// glTF 2.0 (Khronos Group 2017; the names of its JSON objects are used here as they are there).
#include "io/gltf_reduce.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "core/color.h"
#include "core/error.h"
#include "io/gltf_buffer.h"
#include "io/mesh_limits.h"

namespace meltpoint {

namespace {

using Json = nlohmann::json;

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t largest_json = std::size_t{128} << 20;  // bytes: what it becomes takes up to thirty times as many
constexpr std::size_t largest_buffers = std::size_t{2} << 30; // bytes
constexpr std::size_t most_buffers = 1000;
constexpr int deepest_json = 100;
constexpr int deepest_node = 1000;
constexpr std::uint64_t most_instances = 10'000'000; // triangles, and vertices, where the file holds fewer

constexpr std::uint32_t magic = 0x46546c67;      // "glTF"
constexpr std::uint32_t json_chunk = 0x4e4f534a; // "JSON"
constexpr std::uint32_t bin_chunk = 0x004e4942;  // "BIN"

constexpr int mode_triangles = 4;
constexpr int mode_fan = 6;
constexpr int type_uint8 = 5121;
constexpr int type_uint16 = 5123;
constexpr int type_uint32 = 5125;
constexpr int type_float = 5126;

std::size_t size_of(int component_type)
{
    return component_type == type_uint8 ? 1 : component_type == type_uint16 ? 2 : 4;
}

/// A component of a color, which is a whole number or a float, from 0 to 1.
double color_component(const std::uint8_t* bytes, int type)
{
    std::uint16_t whole = 0;
    float real = 0.0f;
    switch (type) {
    case type_uint8:
        return *bytes / 255.0;
    case type_uint16:
        std::memcpy(&whole, bytes, sizeof(whole));
        return whole / 65535.0;
    default:
        std::memcpy(&real, bytes, sizeof(real));
        return static_cast<double>(real);
    }
}

std::uint32_t word_at(std::span<const std::uint8_t> bytes, std::size_t offset)
{
    std::uint32_t word = 0;
    std::memcpy(&word, &bytes[offset], sizeof(word));
    return word;
}

void append_word(std::vector<std::uint8_t>& bytes, std::uint32_t word)
{
    const auto parts = std::bit_cast<std::array<std::uint8_t, sizeof(word)>>(word);
    bytes.insert(bytes.end(), parts.begin(), parts.end());
}

/// How deep arrays and objects are nested.
int json_depth(std::span<const std::uint8_t> text)
{
    int depth = 0;
    int deepest = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::uint8_t c = text[i];
        if (in_string) {
            i += c == '\\' ? 1 : 0;
            in_string = c != '"';
        } else if (c == '[' || c == '{') {
            deepest = std::max(deepest, ++depth);
        } else if (c == ']' || c == '}') {
            --depth;
        } else {
            in_string = c == '"';
        }
    }
    return deepest;
}

class GltfReducer {
public:
    GltfReducer(std::span<const std::uint8_t> bytes, std::filesystem::path path) : path_(std::move(path))
    {
        std::span<const std::uint8_t> text = bytes;
        std::span<const std::uint8_t> bin;
        if (bytes.size() >= 4 && word_at(bytes, 0) == magic) {
            std::tie(text, bin) = split_glb(bytes);
        }
        parse(text);
        check_version();
        load_buffers(bin);
        size_ = bytes.size() + data_.size();
    }

    std::vector<std::uint8_t> reduce()
    {
        reduce_meshes();
        reduce_nodes();
        out_["asset"]["version"] = "2.0";
        out_["buffers"] = Json::array({{{"byteLength", data_.size()}}});
        return assemble();
    }

private:
    struct Accessor {
        std::size_t index = 0; ///< in what is written
        std::uint64_t count = 0;
        std::uint64_t highest = 0; ///< of indices: the vertex furthest back
    };
    /// What an accessor stands for, in data_.
    struct Elements {
        std::size_t accessor = 0; ///< in the file
        std::string_view type;    ///< "SCALAR", "VEC3" or "VEC4"
        int component_type = 0;
        std::uint64_t begin = 0;
        std::uint64_t stride = 0; ///< bytes from one to the next
        std::uint64_t count = 0;

        [[nodiscard]] std::size_t size() const // bytes of one
        {
            return size_of(component_type) * (type == "SCALAR" ? 1 : type == "VEC3" ? 3 : 4);
        }
        [[nodiscard]] std::uint64_t extent() const { return (count - 1) * stride + size(); } // bytes, of one or more
    };
    struct MeshSize {
        std::uint64_t vertices = 0;
        std::uint64_t triangles = 0;
    };
    using Chunks = std::pair<std::span<const std::uint8_t>, std::span<const std::uint8_t>>;

    [[nodiscard]] Error error(std::string_view message) const { return input_error("{}: {}", path_.string(), message); }

    // --- the container ---------------------------------------------------------------------------------------------

    [[nodiscard]] Chunks split_glb(std::span<const std::uint8_t> bytes) const
    {
        constexpr std::size_t header = 12;
        constexpr std::size_t chunk_header = 8;
        if (bytes.size() < header + chunk_header || word_at(bytes, 4) != 2 || word_at(bytes, 8) > bytes.size()) {
            throw error("this is not a whole GLB file of version 2");
        }
        bytes = bytes.subspan(header, std::max<std::size_t>(word_at(bytes, 8), header) - header);
        const auto take_chunk = [&](std::uint32_t type) -> std::span<const std::uint8_t> {
            if (bytes.size() < chunk_header || word_at(bytes, 4) != type) {
                return {};
            }
            const std::size_t size = word_at(bytes, 0);
            if (size > bytes.size() - chunk_header) {
                throw error("a chunk of the GLB file is longer than the file");
            }
            const auto content = bytes.subspan(chunk_header, size);
            bytes = bytes.subspan(chunk_header + size);
            return content;
        };
        const auto json = take_chunk(json_chunk);
        return {json, take_chunk(bin_chunk)};
    }

    void parse(std::span<const std::uint8_t> text)
    {
        if (text.size() > largest_json) {
            throw error("the JSON part of the glTF file is longer than 128 MiB: export it with its buffers outside");
        }
        if (json_depth(text) > deepest_json) {
            throw error("the JSON of the glTF file is nested too deep");
        }
        in_ = Json::parse(text.begin(), text.end(), nullptr, false);
        if (in_.is_discarded() || !in_.is_object()) {
            throw error("this is not a glTF file: its JSON is broken");
        }
    }

    void check_version()
    {
        const Json& version = member(member(in_, "asset"), "version");
        if (!version.is_string() || !version.get_ref<const std::string&>().starts_with("2.")) {
            throw error("this is not glTF 2.0, the only version that is supported");
        }
        for (const Json& extension : list(in_, "extensionsRequired")) {
            const std::string name = extension.is_string() ? extension.get<std::string>() : "";
            const bool is_look = name.starts_with("KHR_materials") || name.starts_with("KHR_texture") ||
                                 name.starts_with("EXT_texture") || name.starts_with("KHR_lights");
            if (!is_look) {
                throw input_error("{}: the file needs the glTF extension {}, which is not supported: export it without "
                                  "compression",
                                  path_.string(), extension.dump(-1, ' ', true, Json::error_handler_t::replace));
            }
        }
    }

    void load_buffers(std::span<const std::uint8_t> bin)
    {
        const Json& buffers = list(in_, "buffers");
        if (buffers.size() > most_buffers) {
            throw error("the file has more than 1000 buffers");
        }
        for (std::size_t i = 0; i < buffers.size(); ++i) {
            const std::uint64_t size = number(buffers[i], "byteLength");
            const Json& uri = member(buffers[i], "uri");
            std::vector<std::uint8_t> loaded;
            std::span<const std::uint8_t> bytes = i == 0 ? bin : std::span<const std::uint8_t>();
            if (uri.is_string()) {
                loaded = read_gltf_buffer(uri.get_ref<const std::string&>(), path_);
                bytes = loaded;
            }
            if (size > bytes.size()) {
                throw input_error("{}: buffer {} announces {} bytes, but has {}", path_.string(), i, size,
                                  bytes.size());
            }
            if (data_.size() + size > largest_buffers) {
                throw error("the buffers have more than 2 GiB");
            }
            buffers_.emplace_back(data_.size(), size);
            data_.insert(data_.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
            data_.resize((data_.size() + 3) / 4 * 4);
        }
    }

    // --- the JSON --------------------------------------------------------------------------------------------------

    /// null where there is none
    static const Json& member(const Json& object, const char* key)
    {
        static const Json none;
        const auto found = object.find(key); // end() too if it is no object
        return found == object.end() ? none : *found;
    }

    /// The array under a key; empty where there is none.
    [[nodiscard]] const Json& list(const Json& object, const char* key) const
    {
        static const Json none = Json::array();
        const Json& value = member(object, key);
        if (!value.is_null() && !value.is_array()) {
            throw input_error("{}: \"{}\" of the glTF file is no array", path_.string(), key);
        }
        return value.is_null() ? none : value;
    }

    [[nodiscard]] std::uint64_t whole_number(const Json& value, const char* key) const
    {
        if (!value.is_number_unsigned() || value.get<std::uint64_t>() > std::uint64_t{1} << 40) {
            throw input_error("{}: \"{}\" of the glTF file is no whole number", path_.string(), key);
        }
        return value.get<std::uint64_t>();
    }

    [[nodiscard]] std::uint64_t number(const Json& object, const char* key,
                                       std::optional<std::uint64_t> fallback = {}) const
    {
        const Json& value = member(object, key);
        return value.is_null() && fallback ? *fallback : whole_number(value, key);
    }

    /// The object of a list that a number under a key names.
    [[nodiscard]] std::size_t reference(const Json& value, const char* key, const Json& target) const
    {
        const std::uint64_t index = whole_number(value, key);
        if (index >= target.size()) {
            throw input_error("{}: \"{}\" of the glTF file is {}, but there are only {}", path_.string(), key, index,
                              target.size());
        }
        return index;
    }

    // --- accessors -------------------------------------------------------------------------------------------------

    /// The elements of the accessor that a value names. Checks that they are of one of these types, and lie in a
    /// buffer.
    [[nodiscard]] Elements elements_of(const Json& value, const char* key,
                                       std::initializer_list<std::string_view> types,
                                       std::initializer_list<int> component_types) const
    {
        const std::size_t index = reference(value, key, list(in_, "accessors"));
        const Json& accessor = list(in_, "accessors")[index];
        const std::uint64_t component = number(accessor, "componentType");
        const auto* const type = std::find_if(types.begin(), types.end(),
                                              [&](std::string_view each) { return member(accessor, "type") == each; });
        const auto* const component_type = std::find_if(component_types.begin(), component_types.end(), [&](int each) {
            return static_cast<std::uint64_t>(each) == component;
        });
        if (type == types.end() || component_type == component_types.end()) {
            throw input_error("{}: \"{}\" of the glTF file has a type that is not supported", path_.string(), key);
        }
        if (!member(accessor, "sparse").is_null()) {
            throw error("sparse accessors of glTF are not supported");
        }
        Elements elements{.accessor = index, .type = *type, .component_type = *component_type};
        elements.count = number(accessor, "count");
        const Json& views = list(in_, "bufferViews");
        const Json& view = views[reference(member(accessor, "bufferView"), "bufferView", views)];
        const auto& [base, size] = buffers_[reference(member(view, "buffer"), "buffer", list(in_, "buffers"))];
        const std::uint64_t view_offset = number(view, "byteOffset", 0);
        const std::uint64_t view_size = number(view, "byteLength");
        const std::uint64_t offset = number(accessor, "byteOffset", 0);
        elements.stride = number(view, "byteStride", elements.size());
        const bool view_fits = view_offset <= size && view_size <= size - view_offset;
        const bool stride_fits = elements.stride >= elements.size() && elements.stride <= 4096;
        if (!view_fits || !stride_fits || elements.count == 0 || elements.count > view_size ||
            offset + elements.extent() > view_size) {
            throw input_error("{}: accessor {} of the glTF file reaches beyond its buffer", path_.string(), index);
        }
        elements.begin = base + view_offset + offset;
        return elements;
    }

    /// Checks an accessor and where its data lie, and makes one with a view of its own.
    Accessor reduce_accessor(const Json& value, const char* key, std::string_view type,
                             std::initializer_list<int> component_types)
    {
        const Elements elements = elements_of(value, key, {type}, component_types);
        if (!accessors_.contains(elements.accessor)) {
            Accessor& added = accessors_[elements.accessor];
            added = {.index = write_accessor(elements), .count = elements.count};
            for (std::uint64_t i = 0; type == "SCALAR" && i < elements.count; ++i) {
                std::uint32_t vertex = 0;
                std::memcpy(&vertex, &data_[elements.begin + i * elements.stride], elements.size());
                added.highest = std::max<std::uint64_t>(added.highest, vertex);
            }
        }
        return accessors_.at(elements.accessor);
    }

    /// Checks the colors of `count` vertices, and writes them as sRGB. Returns the index of their accessor in what is
    /// written.
    std::size_t reduce_colors(const Json& value, std::uint64_t count)
    {
        const Elements elements =
            elements_of(value, "COLOR_0", {"VEC3", "VEC4"}, {type_float, type_uint8, type_uint16});
        if (elements.count != count) {
            throw error("a mesh of the glTF file has not as many colors as vertices");
        }
        const auto known = colors_.find(elements.accessor);
        if (known != colors_.end()) {
            return known->second;
        }
        color_count_ += count;
        if (color_count_ > size_ / 3) { // of three bytes or more each
            throw error("the accessors of colors in the glTF file overlap");
        }
        Elements written{.type = "VEC4", .component_type = type_uint8, .begin = data_.size(), .count = count};
        written.stride = written.size();
        if (written.extent() > largest_buffers - data_.size()) {
            throw error("the buffers have more than 2 GiB");
        }
        data_.resize(data_.size() + written.extent(), 255);
        for (std::uint64_t i = 0; i < count; ++i) {
            for (std::size_t channel = 0; channel < 3; ++channel) {
                const std::uint64_t place =
                    elements.begin + i * elements.stride + channel * size_of(elements.component_type);
                const double light = color_component(&data_[place], elements.component_type);
                if (!std::isfinite(light)) {
                    throw input_error("{}: color {} of accessor {} of the glTF file is not finite", path_.string(), i,
                                      elements.accessor);
                }
                data_[written.begin + i * written.stride + channel] = color_byte(255.0 * srgb_from_linear(light));
            }
        }
        return colors_[elements.accessor] = write_accessor(written);
    }

    /// Returns its index in what is written.
    std::size_t write_accessor(const Elements& elements)
    {
        Json& views = out_["bufferViews"];
        views.push_back({{"buffer", 0}, {"byteOffset", elements.begin}, {"byteLength", elements.extent()}});
        if (elements.stride != elements.size()) {
            views.back()["byteStride"] = elements.stride;
        }
        Json& accessors = out_["accessors"];
        accessors.push_back({{"bufferView", views.size() - 1},
                             {"componentType", elements.component_type},
                             {"type", elements.type},
                             {"count", elements.count}});
        return accessors.size() - 1;
    }

    // --- meshes ----------------------------------------------------------------------------------------------------

    void reduce_meshes()
    {
        out_["meshes"] = Json::array();
        for (const Json& mesh : list(in_, "meshes")) {
            MeshSize size;
            Json primitives = Json::array();
            for (const Json& primitive : list(mesh, "primitives")) {
                const std::uint64_t mode = number(primitive, "mode", mode_triangles);
                const Json& attributes = member(primitive, "attributes");
                if (mode >= mode_triangles && mode <= mode_fan && !member(attributes, "POSITION").is_null()) {
                    reduce_primitive(primitive, mode, primitives, size);
                }
            }
            check_total(size);
            mesh_sizes_.push_back(size);
            mesh_index_.push_back(primitives.empty() ? std::nullopt : std::optional(out_["meshes"].size()));
            if (!primitives.empty()) {
                out_["meshes"].push_back({{"primitives", std::move(primitives)}});
            }
        }
    }

    void reduce_primitive(const Json& primitive, std::uint64_t mode, Json& primitives, MeshSize& size)
    {
        const Json& attributes = member(primitive, "attributes");
        const Accessor positions = reduce_accessor(member(attributes, "POSITION"), "POSITION", "VEC3", {type_float});
        Json out = {{"mode", mode}, {"attributes", {{"POSITION", positions.index}}}};
        if (!member(attributes, "NORMAL").is_null()) {
            const Accessor normals = reduce_accessor(member(attributes, "NORMAL"), "NORMAL", "VEC3", {type_float});
            if (normals.count != positions.count) {
                throw error("a mesh of the glTF file has not as many normals as vertices");
            }
            out["attributes"]["NORMAL"] = normals.index;
        }
        std::uint64_t corners = positions.count;
        if (!member(primitive, "indices").is_null()) {
            const Accessor indices = reduce_accessor(member(primitive, "indices"), "indices", "SCALAR",
                                                     {type_uint8, type_uint16, type_uint32});
            if (indices.highest >= positions.count) {
                throw input_error("{}: a face names vertex {} of {}", path_.string(), indices.highest, positions.count);
            }
            corners = indices.count;
            out["indices"] = indices.index;
        }
        if (corners < 3 || (mode == mode_triangles && corners % 3 != 0)) {
            throw input_error("{}: {} corners of a mesh in the glTF file make no triangles", path_.string(), corners);
        }
        size.vertices += positions.count;
        size.triangles += mode == mode_triangles ? corners / 3 : corners - 2;
        check_total(size);
        if (!member(attributes, "COLOR_0").is_null()) {
            out["attributes"]["COLOR_0"] = reduce_colors(member(attributes, "COLOR_0"), positions.count);
        }
        primitives.push_back(std::move(out));
    }

    /// Instances let a small file grow: beyond ten million, a mesh must really be in the file, byte for byte.
    void check_total(const MeshSize& size) const
    {
        const std::uint64_t most = std::max<std::uint64_t>(most_instances, size_ / 3);
        if (size.vertices > most || size.triangles > std::min<std::uint64_t>(most, most_triangles)) {
            throw input_error("{}: the meshes and their instances have more than {} triangles or vertices",
                              path_.string(), std::min<std::uint64_t>(most, most_triangles));
        }
    }

    // --- nodes -----------------------------------------------------------------------------------------------------

    void reduce_nodes()
    {
        const Json& nodes = list(in_, "nodes");
        std::vector<bool> has_parent(nodes.size(), false);
        out_["nodes"] = Json::array();
        for (const Json& node : nodes) {
            out_["nodes"].push_back(reduced_node(node, has_parent));
        }

        Json roots = Json::array();
        const Json& scenes = list(in_, "scenes");
        if (!scenes.empty()) {
            const Json& scene = scenes[in_.contains("scene") ? reference(in_["scene"], "scene", scenes) : 0];
            for (const Json& root : list(scene, "nodes")) {
                roots.push_back(reference(root, "nodes", nodes));
            }
        } else {
            for (std::size_t i = 0; i < nodes.size(); ++i) {
                if (!has_parent[i]) {
                    roots.push_back(i);
                }
            }
        }
        check_tree(roots, has_parent);
        out_["scenes"] = Json::array({{{"nodes", std::move(roots)}}});
        out_["scene"] = 0;
    }

    Json reduced_node(const Json& node, std::vector<bool>& has_parent)
    {
        Json out = Json::object();
        const Json& nodes = list(in_, "nodes");
        for (const Json& child : list(node, "children")) {
            const std::size_t index = reference(child, "children", nodes);
            if (has_parent[index]) {
                throw error("a node of the glTF file has two parents");
            }
            has_parent[index] = true;
            out["children"].push_back(index);
        }
        if (!member(node, "mesh").is_null()) {
            const std::size_t mesh = reference(node["mesh"], "mesh", list(in_, "meshes"));
            if (mesh_index_[mesh]) {
                out["mesh"] = *mesh_index_[mesh];
            }
        }
        constexpr std::array<std::pair<const char*, std::size_t>, 4> transforms{
            {{"matrix", 16}, {"translation", 3}, {"rotation", 4}, {"scale", 3}}};
        for (const auto& [key, length] : transforms) {
            const Json& values = list(node, key);
            const bool finite = std::all_of(values.begin(), values.end(), [](const Json& value) {
                return value.is_number() && std::isfinite(value.get<float>());
            });
            if (!values.empty() && (values.size() != length || !finite)) {
                throw input_error("{}: the {} of a node in the glTF file is broken", path_.string(), key);
            }
            if (!values.empty()) {
                out[key] = values;
            }
        }
        return out;
    }

    /// Every node has at most one parent here, so that a walk down from nodes without one ends.
    void check_tree(const Json& roots, const std::vector<bool>& has_parent)
    {
        std::vector<std::pair<std::size_t, int>> open; // node, depth
        std::vector<bool> is_root(has_parent.size(), false);
        for (const Json& root : roots) {
            const auto index = root.get<std::size_t>();
            if (has_parent[index] || is_root[index]) {
                throw error("the nodes of the glTF file are no tree");
            }
            is_root[index] = true;
            open.emplace_back(index, 0);
        }
        MeshSize total;
        while (!open.empty()) {
            const auto [index, depth] = open.back();
            open.pop_back();
            if (depth > deepest_node) {
                throw input_error("{}: the nodes are nested more than {} deep", path_.string(), deepest_node);
            }
            const Json& in = list(in_, "nodes")[index];
            if (!member(in, "mesh").is_null()) {
                const MeshSize& size = mesh_sizes_[in["mesh"].get<std::size_t>()];
                total.vertices += size.vertices;
                total.triangles += size.triangles;
                check_total(total);
            }
            for (const Json& child : list(in, "children")) {
                open.emplace_back(child.get<std::size_t>(), depth + 1);
            }
        }
    }

    std::vector<std::uint8_t> assemble()
    {
        std::string text = out_.dump();
        text.resize((text.size() + 3) / 4 * 4, ' ');
        std::vector<std::uint8_t> glb;
        const std::size_t size = 12 + 8 + text.size() + 8 + data_.size();
        glb.reserve(size);
        for (const std::uint32_t word :
             {magic, 2u, static_cast<std::uint32_t>(size), static_cast<std::uint32_t>(text.size()), json_chunk}) {
            append_word(glb, word);
        }
        glb.insert(glb.end(), text.begin(), text.end());
        append_word(glb, static_cast<std::uint32_t>(data_.size()));
        append_word(glb, bin_chunk);
        glb.insert(glb.end(), data_.begin(), data_.end());
        return glb;
    }

    std::uint64_t size_ = 0; ///< bytes of the file and its buffers
    std::filesystem::path path_;
    Json in_;
    Json out_ = Json::object();
    std::vector<std::uint8_t> data_;                           ///< all buffers, one after the other, then colors
    std::vector<std::pair<std::size_t, std::size_t>> buffers_; ///< where each begins, and its size
    std::map<std::size_t, Accessor> accessors_;                ///< indices in the file -> in what is written
    std::map<std::size_t, std::size_t> colors_;                ///< likewise
    std::uint64_t color_count_ = 0;                            ///< of all that are written
    std::vector<MeshSize> mesh_sizes_;                         ///< of all meshes of the file
    std::vector<std::optional<std::size_t>> mesh_index_;       ///< in what is written
};

} // namespace

std::vector<std::uint8_t> reduce_gltf(std::span<const std::uint8_t> bytes, const std::filesystem::path& path)
{
    return GltfReducer(bytes, path).reduce();
}

} // namespace meltpoint
