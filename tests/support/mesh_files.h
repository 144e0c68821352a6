#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "geometry/triangle_mesh.h"

namespace meltpoint::test {

// A mesh as the text or bytes of a file, written here by the formats' definitions alone.

enum class ByteOrder { Little, Big };

template <class T>
void append_bytes(std::string& file, T value, ByteOrder order = ByteOrder::Little)
{
    auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (order == ByteOrder::Big) {
        std::reverse(bytes.begin(), bytes.end());
    }
    file.append(bytes.data(), bytes.size());
}

inline void append_vector(std::string& file, const glm::vec3& v, ByteOrder order = ByteOrder::Little)
{
    for (int axis = 0; axis < 3; ++axis) {
        append_bytes(file, v[axis], order);
    }
}

inline std::string obj_of(const TriangleMesh& mesh)
{
    std::string text;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3& p = mesh.positions[i];
        text += fmt::format("v {} {} {}", p.x, p.y, p.z);
        if (!mesh.colors.empty()) {
            const glm::dvec3 c = glm::dvec3(mesh.colors[i]) / 255.0;
            text += fmt::format(" {} {} {}", c.r, c.g, c.b);
        }
        text += "\n";
    }
    for (const glm::vec3& n : mesh.normals) {
        text += fmt::format("vn {} {} {}\n", n.x, n.y, n.z);
    }
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::uvec3 c = t + 1u;
        text += mesh.normals.empty() ? fmt::format("f {} {} {}\n", c.x, c.y, c.z)
                                     : fmt::format("f {0}//{0} {1}//{1} {2}//{2}\n", c.x, c.y, c.z);
    }
    return text;
}

inline std::string ply_header(const TriangleMesh& mesh, const std::string& format)
{
    return fmt::format("ply\nformat {} 1.0\ncomment a test\nelement vertex {}\nproperty float x\nproperty float y\n"
                       "property float z\n{}{}element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                       format, mesh.positions.size(),
                       mesh.normals.empty() ? "" : "property float nx\nproperty float ny\nproperty float nz\n",
                       mesh.colors.empty() ? "" : "property uchar red\nproperty uchar green\nproperty uchar blue\n",
                       mesh.triangles.size());
}

inline std::string ascii_ply_of(const TriangleMesh& mesh)
{
    std::string text = ply_header(mesh, "ascii");
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3& p = mesh.positions[i];
        text += fmt::format("{} {} {}", p.x, p.y, p.z);
        if (!mesh.normals.empty()) {
            text += fmt::format(" {} {} {}", mesh.normals[i].x, mesh.normals[i].y, mesh.normals[i].z);
        }
        if (!mesh.colors.empty()) {
            text += fmt::format(" {} {} {}", mesh.colors[i].r, mesh.colors[i].g, mesh.colors[i].b);
        }
        text += "\n";
    }
    for (const glm::uvec3& t : mesh.triangles) {
        text += fmt::format("3 {} {} {}\n", t.x, t.y, t.z);
    }
    return text;
}

inline std::string binary_ply_of(const TriangleMesh& mesh, ByteOrder order)
{
    std::string file = ply_header(mesh, order == ByteOrder::Little ? "binary_little_endian" : "binary_big_endian");
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        append_vector(file, mesh.positions[i], order);
        if (!mesh.normals.empty()) {
            append_vector(file, mesh.normals[i], order);
        }
        for (int channel = 0; !mesh.colors.empty() && channel < 3; ++channel) {
            append_bytes(file, mesh.colors[i][channel]);
        }
    }
    for (const glm::uvec3& t : mesh.triangles) {
        file += '\3';
        for (int corner = 0; corner < 3; ++corner) {
            append_bytes(file, t[corner], order);
        }
    }
    return file;
}

inline std::string ascii_stl_of(const TriangleMesh& mesh)
{
    std::string text = "solid a test\n";
    for (const glm::uvec3& t : mesh.triangles) {
        text += "  facet normal 0 0 0\n    outer loop\n";
        for (int corner = 0; corner < 3; ++corner) {
            const glm::vec3& p = mesh.positions[t[corner]];
            text += fmt::format("      vertex {} {} {}\n", p.x, p.y, p.z);
        }
        text += "    endloop\n  endfacet\n";
    }
    return text + "endsolid a test\n";
}

inline std::string binary_stl_of(const TriangleMesh& mesh)
{
    std::string file(80, ' ');
    append_bytes(file, static_cast<std::uint32_t>(mesh.triangles.size()));
    for (const glm::uvec3& t : mesh.triangles) {
        append_vector(file, glm::vec3(0.0f));
        for (int corner = 0; corner < 3; ++corner) {
            append_vector(file, mesh.positions[t[corner]]);
        }
        append_bytes(file, std::uint16_t{0});
    }
    return file;
}

inline std::string off_of(const TriangleMesh& mesh)
{
    std::string text = fmt::format("{}OFF\n# a test\n\n{} {} 0\n", mesh.normals.empty() ? "" : "N",
                                   mesh.positions.size(), mesh.triangles.size());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3& p = mesh.positions[i];
        text += fmt::format("{} {} {}", p.x, p.y, p.z);
        if (!mesh.normals.empty()) {
            text += fmt::format("  {} {} {}", mesh.normals[i].x, mesh.normals[i].y, mesh.normals[i].z);
        }
        text += " # a vertex\n";
    }
    for (const glm::uvec3& t : mesh.triangles) {
        text += fmt::format("3 {} {} {} 0.5 0.5 0.5\n", t.x, t.y, t.z);
    }
    return text;
}

/// The light of a color (IEC 61966-2-1).
inline glm::vec3 linear_of(const glm::u8vec3& srgb)
{
    glm::vec3 light;
    for (int channel = 0; channel < 3; ++channel) {
        const double c = srgb[channel] / 255.0;
        light[channel] = static_cast<float>(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return light;
}

/// The buffer of a glTF file: indices, positions, normals, linear colors.
inline std::string gltf_buffer_of(const TriangleMesh& mesh)
{
    std::string buffer;
    for (const glm::uvec3& t : mesh.triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            append_bytes(buffer, t[corner]);
        }
    }
    for (const glm::vec3& p : mesh.positions) {
        append_vector(buffer, p);
    }
    for (const glm::vec3& n : mesh.normals) {
        append_vector(buffer, n);
    }
    for (const glm::u8vec3& c : mesh.colors) {
        append_vector(buffer, linear_of(c));
    }
    return buffer;
}

/// Its JSON. buffer_uri: "\"uri\": ..., " or nothing. nodes: the array, without its brackets; the mesh is number 0.
inline std::string gltf_json_of(const TriangleMesh& mesh, const std::string& buffer_uri,
                                const std::string& nodes = R"({"mesh": 0})")
{
    const std::size_t index_bytes = mesh.triangles.size() * 12;
    const std::size_t vertex_bytes = mesh.positions.size() * 12;
    const std::string accessor = R"({{"bufferView": {}, "componentType": {}, "count": {}, "type": "{}"}})";
    std::string views = fmt::format(R"({{"buffer": 0, "byteLength": {}}}, )"
                                    R"({{"buffer": 0, "byteOffset": {}, "byteLength": {}}})",
                                    index_bytes, index_bytes, vertex_bytes);
    std::string accessors = fmt::format(fmt::runtime(accessor), 0, 5125, mesh.triangles.size() * 3, "SCALAR") + ", " +
                            fmt::format(fmt::runtime(accessor), 1, 5126, mesh.positions.size(), "VEC3");
    std::size_t vectors = 1; // a vertex
    std::string attributes = R"("POSITION": 1)";
    const auto add = [&](const char* attribute) {
        views += fmt::format(R"(, {{"buffer": 0, "byteOffset": {}, "byteLength": {}}})",
                             index_bytes + vectors * vertex_bytes, vertex_bytes);
        ++vectors;
        accessors += ", " + fmt::format(fmt::runtime(accessor), vectors, 5126, mesh.positions.size(), "VEC3");
        attributes += fmt::format(R"(, "{}": {})", attribute, vectors);
    };
    if (!mesh.normals.empty()) {
        add("NORMAL");
    }
    if (!mesh.colors.empty()) {
        add("COLOR_0");
    }
    return fmt::format(R"({{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}], "nodes": [{}],
"meshes": [{{"primitives": [{{"attributes": {{{}}}, "indices": 0, "material": 7}}]}}],
"buffers": [{{{}"byteLength": {}}}], "bufferViews": [{}], "accessors": [{}]}})",
                       nodes, attributes, buffer_uri, index_bytes + vertex_bytes * vectors, views, accessors);
}

inline std::string base64_of(const std::string& bytes)
{
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            text += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63] : '=';
        }
    }
    return text;
}

inline std::string glb(std::string json, std::string buffer)
{
    json.resize((json.size() + 3) / 4 * 4, ' ');
    buffer.resize((buffer.size() + 3) / 4 * 4);
    std::string file = "glTF";
    append_bytes(file, std::uint32_t{2});
    append_bytes(file, static_cast<std::uint32_t>(28 + json.size() + buffer.size()));
    append_bytes(file, static_cast<std::uint32_t>(json.size()));
    file += "JSON" + json;
    append_bytes(file, static_cast<std::uint32_t>(buffer.size()));
    return file + std::string("BIN\0", 4) + buffer;
}

inline std::string gltf_of(const TriangleMesh& mesh, const std::string& nodes = R"({"mesh": 0})")
{
    const std::string buffer = base64_of(gltf_buffer_of(mesh));
    return gltf_json_of(mesh, "\"uri\": \"data:application/octet-stream;base64," + buffer + "\", ", nodes);
}

inline std::string glb_of(const TriangleMesh& mesh, const std::string& nodes = R"({"mesh": 0})")
{
    return glb(gltf_json_of(mesh, "", nodes), gltf_buffer_of(mesh));
}

} // namespace meltpoint::test
