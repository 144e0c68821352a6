#include "io/mesh_import.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <assimp/BaseImporter.h>
#include <assimp/Importer.hpp>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/importerdesc.h>
#include <assimp/scene.h>

#include "core/color.h"
#include "core/error.h"
#include "geometry/polygon_triangulation.h"
#include "io/gltf_reduce.h"
#include "io/input_file.h"
#include "io/mesh_limits.h"
#include "io/obj_reduce.h"
#include "io/off_read.h"
#include "io/ply_read.h"
#include "io/stl_read.h"

namespace meltpoint {

namespace {

// --- OBJ and glTF: assimp, fed with what was checked and reduced to the surface ------------------

constexpr std::array<std::string_view, 2> importer_names = {"Wavefront Object Importer", "glTF2 Importer"};
constexpr int deepest_node = 1100; // gltf_reduce.h allows 1000, below which assimp may put some of its own

/// Leaves only the importers that are needed: a crafted file cannot reach the parser of another format.
void keep_supported_importers(Assimp::Importer& importer)
{
    for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
        const aiImporterDesc* description = importer.GetImporterInfo(i);
        Assimp::BaseImporter* loader = importer.GetImporter(i);
        const std::string_view name = description != nullptr ? description->mName : "";
        if (std::find(importer_names.begin(), importer_names.end(), name) == importer_names.end()) {
            importer.UnregisterLoader(loader);
            delete loader; // unregistering hands it over
        }
    }
}

glm::mat4 to_glm(const aiMatrix4x4& m) // row by row, where glm's are column by column
{
    return {m.a1, m.b1, m.c1, m.d1, m.a2, m.b2, m.c2, m.d2, m.a3, m.b3, m.c3, m.d3, m.a4, m.b4, m.c4, m.d4};
}

glm::vec3 to_glm(const aiVector3D& v)
{
    return {v.x, v.y, v.z};
}

glm::u8vec3 to_glm(const aiColor4D& c)
{
    return {color_byte(255.0 * static_cast<double>(c.r)), color_byte(255.0 * static_cast<double>(c.g)),
            color_byte(255.0 * static_cast<double>(c.b))};
}

/// Appends one value a vertex of a part, if the part or the whole has any; `none` stands for those that have none.
template <class T>
void append_values(std::vector<T>& whole, std::size_t whole_count, std::vector<T> part, std::size_t part_count, T none)
{
    if (!whole.empty() || !part.empty()) {
        whole.resize(whole_count, none);
        part.resize(part_count, none);
        whole.insert(whole.end(), part.begin(), part.end());
    }
}

/// Appends the triangles of one of the scene's meshes. Beside parts with normals or colors, those without have normals
/// of zero and are white.
void append(TriangleMesh& whole, const aiMesh& part, const glm::mat4& placement)
{
    TriangleMesh mesh;
    mesh.positions.reserve(part.mNumVertices);
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
        mesh.positions.push_back(to_glm(part.mVertices[i]));
    }
    if (part.HasNormals()) {
        for (unsigned i = 0; i < part.mNumVertices; ++i) {
            mesh.normals.push_back(to_glm(part.mNormals[i]));
        }
    }
    if (part.HasVertexColors(0)) {
        for (unsigned i = 0; i < part.mNumVertices; ++i) {
            mesh.colors.push_back(to_glm(part.mColors[0][i]));
        }
    }
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
        const aiFace& face = part.mFaces[i];
        triangulate_polygon({face.mIndices, face.mNumIndices}, mesh.positions, mesh.triangles);
    }
    transform(mesh, placement);

    const auto first = static_cast<std::uint32_t>(whole.positions.size());
    append_values(whole.normals, whole.positions.size(), std::move(mesh.normals), mesh.positions.size(),
                  glm::vec3(0.0f));
    append_values(whole.colors, whole.positions.size(), std::move(mesh.colors), mesh.positions.size(),
                  glm::u8vec3(255));
    whole.positions.insert(whole.positions.end(), mesh.positions.begin(), mesh.positions.end());
    for (const glm::uvec3& corners : mesh.triangles) {
        whole.triangles.push_back(corners + first);
    }
}

void append_node(TriangleMesh& whole, const aiScene& scene, const aiNode& node, const glm::mat4& parent, int depth,
                 const std::string& name)
{
    if (depth > deepest_node) {
        throw input_error("{}: the nodes are nested more than {} deep", name, deepest_node);
    }
    const glm::mat4 placement = parent * to_glm(node.mTransformation);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        const aiMesh& part = *scene.mMeshes[node.mMeshes[i]];
        check_triangles(whole.triangles.size() + part.mNumFaces, name);
        append(whole, part, placement);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
        append_node(whole, scene, *node.mChildren[i], placement, depth + 1, name);
    }
}

/// What triangulation relies on.
void check_faces(const aiScene& scene, const std::string& name)
{
    PolygonCheck check_corners(name);
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
        const aiMesh& part = *scene.mMeshes[i];
        for (const aiFace& face : std::span(part.mFaces, part.mNumFaces)) {
            check_corners(face.mNumIndices);
            for (const unsigned index : std::span(face.mIndices, face.mNumIndices)) {
                if (index >= part.mNumVertices) {
                    throw input_error("{}: a face names vertex {} of {}", name, index, part.mNumVertices);
                }
            }
        }
    }
}

/// The first line of a library's message, without its trailing period.
std::string reason(const char* message)
{
    std::string text(message);
    text.erase(std::min(text.find('\n'), text.size()));
    while (!text.empty() && (text.back() == '.' || text.back() == ' ' || text.back() == '\r')) {
        text.pop_back();
    }
    return text.empty() ? "unknown reason" : text;
}

TriangleMesh read_through_assimp(const std::vector<std::uint8_t>& bytes, const char* extension, const std::string& name)
{
    Assimp::Importer importer;
    keep_supported_importers(importer);
    // The importer sees these bytes alone: whatever else they may name, it cannot open.
    importer.SetIOHandler(new Assimp::MemoryIOSystem(bytes.data(), bytes.size(), nullptr));
    const aiScene* scene = importer.ReadFile(std::string(AI_MEMORYIO_MAGIC_FILENAME ".") + extension, 0);
    if (scene == nullptr) {
        throw input_error("{}: cannot be read as a mesh ({})", name, reason(importer.GetErrorString()));
    }
    if (scene->mNumMeshes == 0 || scene->mRootNode == nullptr) {
        throw input_error("{}: the file holds no mesh", name);
    }
    check_faces(*scene, name);
    TriangleMesh mesh;
    append_node(mesh, *scene, *scene->mRootNode, glm::mat4(1.0f), 0, name);
    return mesh;
}

// --- the formats ---------------------------------------------------------------------------------

using Bytes = std::span<const std::uint8_t>;

TriangleMesh read_obj(Bytes bytes, const std::filesystem::path& path)
{
    return read_through_assimp(reduce_obj(bytes, path.string()), "obj", path.string());
}

TriangleMesh read_gltf(Bytes bytes, const std::filesystem::path& path)
{
    return read_through_assimp(reduce_gltf(bytes, path), "glb", path.string());
}

TriangleMesh read_ply_mesh(Bytes bytes, const std::filesystem::path& path)
{
    PlyContent content = read_ply(bytes, path.string());
    if (content.triangles.empty()) {
        throw input_error("{}: the file holds {} points, but no faces", path.string(), content.positions.size());
    }
    return {std::move(content.positions), std::move(content.triangles), std::move(content.normals),
            std::move(content.colors)};
}

struct Format {
    std::string_view extension;
    TriangleMesh (*read)(Bytes, const std::filesystem::path&);
};

constexpr std::array<Format, 6> formats{{{"obj", read_obj},
                                         {"ply", read_ply_mesh},
                                         {"stl",
                                          [](Bytes bytes, const std::filesystem::path& path) {
                                              return read_stl(bytes, path.string());
                                          }},
                                         {"gltf", read_gltf},
                                         {"glb", read_gltf},
                                         {"off", [](Bytes bytes, const std::filesystem::path& path) {
                                              return read_off(bytes, path.string());
                                          }}}};

const Format& format_of(const std::filesystem::path& path)
{
    const std::string extension = lower_extension(path);
    const auto* const format =
        std::find_if(formats.begin(), formats.end(), [&](const Format& each) { return each.extension == extension; });
    if (format == formats.end()) {
        throw input_error(
            "{}: meshes are read from files that end in .obj, .ply, .stl, .gltf, .glb or .off, not in \"{}\"",
            path.string(), path.extension().string());
    }
    return *format;
}

} // namespace

TriangleMesh parse_mesh(std::span<const std::uint8_t> bytes, const std::filesystem::path& path)
{
    TriangleMesh mesh = format_of(path).read(bytes, path);
    validate(mesh, path.string());
    mesh = weld(mesh);
    validate(mesh, path.string());
    return mesh;
}

TriangleMesh import_mesh(const std::filesystem::path& path)
{
    const std::vector<std::uint8_t> bytes = read_input_file(path);
    return parse_mesh(bytes, path);
}

} // namespace meltpoint
