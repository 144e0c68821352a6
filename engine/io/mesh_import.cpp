#include "io/mesh_import.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

#include <assimp/BaseImporter.h>
#include <assimp/Importer.hpp>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/importerdesc.h>
#include <assimp/scene.h>
#include <fmt/ranges.h>

#include "core/error.h"
#include "geometry/polygon_triangulation.h"

namespace meltpoint {

namespace {

constexpr std::array<std::string_view, 1> supported_extensions = {"obj"};
constexpr std::uintmax_t largest_file = std::uintmax_t{2} << 30; // bytes
constexpr unsigned most_polygon_corners = 4096;                  // triangulation takes the square of their number
constexpr std::size_t most_triangles = 200'000'000;
constexpr int deepest_node = 1000;

std::string lower_extension(const std::filesystem::path& path)
{
    std::string extension = path.extension().string();
    extension.erase(0, std::min<std::size_t>(extension.size(), 1)); // the dot
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return extension;
}

/// The whole file. Only regular files: a directory cannot be read, and a pipe or device might never end.
std::vector<std::uint8_t> read_file(const std::filesystem::path& path)
{
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) {
        throw input_error("{}: there is no such file", path.string());
    }
    if (std::filesystem::is_directory(status)) {
        throw input_error("{}: this is a directory, not a mesh file", path.string());
    }
    if (!std::filesystem::is_regular_file(status)) {
        throw input_error("{}: this is not a regular file", path.string());
    }
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error) {
        throw input_error("{}: cannot be read ({})", path.string(), error.message());
    }
    if (size == 0) {
        throw input_error("{}: the file is empty", path.string());
    }
    if (size > largest_file) {
        throw input_error("{}: the file has {} bytes, at most {} are supported", path.string(), size, largest_file);
    }
    std::vector<std::uint8_t> bytes(size);
    std::ifstream file(path, std::ios::binary);
    if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))) {
        throw input_error("{}: cannot be read", path.string());
    }
    return bytes;
}

/// Leaves only the importers of the supported formats: a crafted file cannot reach the parser of another one.
void keep_supported_importers(Assimp::Importer& importer)
{
    for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
        const aiImporterDesc* description = importer.GetImporterInfo(i);
        Assimp::BaseImporter* loader = importer.GetImporter(i);
        const std::string_view extensions = description != nullptr ? description->mFileExtensions : "";
        if (std::find(supported_extensions.begin(), supported_extensions.end(), extensions) ==
            supported_extensions.end()) {
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

/// Appends the triangles of one of the scene's meshes. Parts without normals get zero ones beside parts with.
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
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
        const aiFace& face = part.mFaces[i];
        triangulate_polygon({face.mIndices, face.mNumIndices}, mesh.positions, mesh.triangles);
    }
    transform(mesh, placement);

    const auto first = static_cast<std::uint32_t>(whole.positions.size());
    if (!mesh.normals.empty() || !whole.normals.empty()) {
        whole.normals.resize(whole.positions.size(), glm::vec3(0.0f));
        mesh.normals.resize(mesh.positions.size(), glm::vec3(0.0f));
        whole.normals.insert(whole.normals.end(), mesh.normals.begin(), mesh.normals.end());
    }
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
        if (whole.triangles.size() + part.mNumFaces > most_triangles) {
            throw input_error("{}: the mesh has more than {} triangles", name, most_triangles);
        }
        append(whole, part, placement);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
        append_node(whole, scene, *node.mChildren[i], placement, depth + 1, name);
    }
}

/// What triangulation relies on.
void check_faces(const aiScene& scene, const std::string& name)
{
    for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
        const aiMesh& part = *scene.mMeshes[i];
        for (const aiFace& face : std::span(part.mFaces, part.mNumFaces)) {
            if (face.mNumIndices > most_polygon_corners) {
                throw input_error("{}: a polygon has {} corners, at most {} are supported", name, face.mNumIndices,
                                  most_polygon_corners);
            }
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

} // namespace

TriangleMesh import_mesh(const std::filesystem::path& path)
{
    const std::string name = path.string();
    const std::string extension = lower_extension(path);
    const std::vector<std::uint8_t> bytes = read_file(path);
    if (std::find(supported_extensions.begin(), supported_extensions.end(), extension) == supported_extensions.end()) {
        throw input_error("{}: meshes are read from files that end in .{}, not in \"{}\"", name,
                          fmt::join(supported_extensions, ", ."), path.extension().string());
    }

    Assimp::Importer importer;
    keep_supported_importers(importer);
    // The importer sees this one file, from memory: whatever else the file names, it cannot open.
    importer.SetIOHandler(new Assimp::MemoryIOSystem(bytes.data(), bytes.size(), nullptr));
    const aiScene* scene = importer.ReadFile(AI_MEMORYIO_MAGIC_FILENAME "." + extension, 0);
    if (scene == nullptr) {
        throw input_error("{}: cannot be read as a mesh ({})", name, reason(importer.GetErrorString()));
    }
    if (scene->mNumMeshes == 0 || scene->mRootNode == nullptr) {
        throw input_error("{}: the file holds no mesh", name);
    }
    check_faces(*scene, name);

    TriangleMesh mesh;
    append_node(mesh, *scene, *scene->mRootNode, glm::mat4(1.0f), 0, name);
    validate(mesh, name);
    mesh = weld(mesh);
    validate(mesh, name);
    return mesh;
}

} // namespace meltpoint
