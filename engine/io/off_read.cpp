#include "io/off_read.h"

#include <string_view>
#include <vector>

#include "geometry/polygon_triangulation.h"
#include "io/mesh_limits.h"
#include "io/text_scanner.h"

namespace meltpoint {

namespace {

struct OffHeader {
    bool normals = false;
    bool homogeneous = false;
    std::uint64_t vertices = 0;
    std::uint64_t faces = 0;
};

/// The first word: [ST][C][N][4][n]OFF.
OffHeader read_keyword(TextScanner& text, bool& has_dimension)
{
    std::string_view word = text.word_on_line();
    const auto skip = [&word](std::string_view prefix) {
        const bool there = word.starts_with(prefix);
        word.remove_prefix(there ? prefix.size() : 0);
        return there;
    };
    OffHeader header;
    skip("ST");
    skip("C");
    header.normals = skip("N");
    header.homogeneous = skip("4");
    has_dimension = skip("n");
    if (word != "OFF") {
        throw text.error("this is not an OFF file, which begins with \"OFF\"");
    }
    return header;
}

/// The next word, on this line or beyond blank lines and comments.
std::string_view next_word(TextScanner& text)
{
    return text.next_content() ? text.word_on_line() : std::string_view();
}

OffHeader read_header(TextScanner& text, std::size_t file_size, const std::string& name)
{
    bool has_dimension = false;
    if (!text.next_content()) {
        throw text.error("this is not an OFF file, which begins with \"OFF\"");
    }
    OffHeader header = read_keyword(text, has_dimension);
    std::string_view word = next_word(text);
    if (word == "BINARY") {
        throw text.error("binary OFF files are not supported, only ASCII ones");
    }
    if (has_dimension) {
        if (text.count(word, "the dimension") != 3) {
            throw text.error("the dimension of the vertices is not 3");
        }
        word = next_word(text);
    }
    header.vertices = text.count(word, "the number of vertices");
    header.faces = text.count(next_word(text), "the number of faces");
    // "0 0 0" and "3 0 1 2", each with the end of its line
    if (header.vertices > file_size / 6 || header.faces > file_size / 8) {
        throw input_error("{}: the header announces {} vertices and {} faces, more than the file's {} bytes can hold",
                          name, header.vertices, header.faces, file_size);
    }
    return header; // the number of edges, often missing, is the rest of the line
}

/// Coordinates stand at the beginning of a line each, before whatever else is there.
void read_vertices(TextScanner& text, const OffHeader& header, TriangleMesh& mesh)
{
    mesh.positions.reserve(header.vertices);
    for (std::uint64_t i = 0; i < header.vertices; ++i) {
        text.next_line();
        if (!text.next_content()) {
            throw text.error("the file ends after {} of {} vertices", i, header.vertices);
        }
        const auto vector = [&text](std::string_view what) {
            glm::dvec3 v(0.0);
            for (int axis = 0; axis < 3; ++axis) {
                v[axis] = text.number(text.word_on_line(), what);
            }
            return v;
        };
        glm::dvec3 position = vector("a coordinate");
        if (header.homogeneous) {
            position /= text.number(text.word_on_line(), "the fourth coordinate");
        }
        mesh.positions.emplace_back(position);
        if (header.normals) {
            mesh.normals.emplace_back(vector("a component of the normal"));
        }
    }
}

void read_faces(TextScanner& text, const OffHeader& header, const std::string& name, TriangleMesh& mesh)
{
    std::vector<std::uint32_t> polygon;
    PolygonCheck check_corners(name);
    for (std::uint64_t i = 0; i < header.faces; ++i) {
        text.next_line();
        if (!text.next_content()) {
            throw text.error("the file ends after {} of {} faces", i, header.faces);
        }
        const std::uint64_t corners = text.count(text.word_on_line(), "the number of corners");
        check_corners(corners);
        polygon.clear();
        for (std::uint64_t k = 0; k < corners; ++k) {
            const std::uint64_t index = text.count(text.word_on_line(), "a corner of a face");
            if (index >= mesh.positions.size()) {
                throw text.error("a face names vertex {} of {}", index, mesh.positions.size());
            }
            polygon.push_back(static_cast<std::uint32_t>(index));
        }
        triangulate_polygon(polygon, mesh.positions, mesh.triangles);
        check_triangles(mesh.triangles.size(), name);
    }
}

} // namespace

TriangleMesh read_off(std::span<const std::uint8_t> bytes, const std::string& name)
{
    TextScanner text(bytes, name);
    const OffHeader header = read_header(text, bytes.size(), name);
    TriangleMesh mesh;
    read_vertices(text, header, mesh);
    read_faces(text, header, name, mesh);
    return mesh;
}

} // namespace meltpoint
