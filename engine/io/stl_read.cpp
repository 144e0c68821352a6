#include "io/stl_read.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstring>
#include <string_view>

#include "io/mesh_limits.h"
#include "io/text_scanner.h"

namespace meltpoint {

namespace {

static_assert(std::endian::native == std::endian::little);

constexpr std::size_t header_bytes = 80;
constexpr std::size_t triangle_bytes = 50; // normal, three corners, two bytes that nobody agrees on

bool same_ignoring_case(std::string_view a, std::string_view b)
{
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

void append_triangle(TriangleMesh& mesh, const std::array<glm::vec3, 3>& corners)
{
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), corners.begin(), corners.end());
    mesh.triangles.emplace_back(first, first + 1, first + 2);
}

TriangleMesh read_binary(std::span<const std::uint8_t> bytes, std::size_t count, const std::string& name)
{
    check_triangles(count, name);
    TriangleMesh mesh;
    mesh.positions.reserve(3 * count);
    mesh.triangles.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint8_t* row = &bytes[header_bytes + sizeof(std::uint32_t) + i * triangle_bytes];
        std::array<glm::vec3, 3> corners{};
        std::memcpy(corners.data(), row + sizeof(glm::vec3), sizeof(corners));
        append_triangle(mesh, corners);
    }
    return mesh;
}

// --- ASCII: "solid NAME", then facets, then "endsolid NAME", any number of times -----------------

void expect(TextScanner& text, std::string_view keyword)
{
    if (!same_ignoring_case(text.word(), keyword)) {
        throw text.error("expected \"{}\"", keyword);
    }
}

glm::vec3 read_vector(TextScanner& text)
{
    glm::vec3 v(0.0f);
    for (int axis = 0; axis < 3; ++axis) {
        v[axis] = static_cast<float>(text.number(text.word(), "a coordinate"));
    }
    return v;
}

void read_facet(TextScanner& text, TriangleMesh& mesh)
{
    expect(text, "normal");
    (void)read_vector(text);
    expect(text, "outer");
    expect(text, "loop");
    std::array<glm::vec3, 3> corners{};
    for (glm::vec3& corner : corners) {
        expect(text, "vertex");
        corner = read_vector(text);
    }
    expect(text, "endloop");
    expect(text, "endfacet");
    append_triangle(mesh, corners);
}

TriangleMesh read_ascii(std::span<const std::uint8_t> bytes, const std::string& name)
{
    TextScanner text(bytes, name);
    TriangleMesh mesh;
    for (std::string_view word = text.word(); !word.empty(); word = text.word()) {
        if (!same_ignoring_case(word, "solid")) {
            throw text.error("expected \"solid\": this is neither an ASCII nor a binary STL file");
        }
        text.next_line(); // the rest of the line is its name
        for (word = text.word(); same_ignoring_case(word, "facet"); word = text.word()) {
            read_facet(text, mesh);
            check_triangles(mesh.triangles.size(), name);
        }
        if (!same_ignoring_case(word, "endsolid")) {
            throw text.error(R"(expected "facet" or "endsolid")");
        }
        text.next_line();
    }
    return mesh;
}

} // namespace

TriangleMesh read_stl(std::span<const std::uint8_t> bytes, const std::string& name)
{
    // Binary files may begin with "solid" as well: their size tells them apart.
    const bool is_solid =
        bytes.size() >= 5 && same_ignoring_case({reinterpret_cast<const char*>(bytes.data()), 5}, "solid");
    if (bytes.size() >= header_bytes + sizeof(std::uint32_t)) {
        std::uint32_t count = 0;
        std::memcpy(&count, &bytes[header_bytes], sizeof(count));
        const std::uint64_t needed = header_bytes + sizeof(count) + std::uint64_t{count} * triangle_bytes;
        if (bytes.size() == needed || (!is_solid && bytes.size() > needed)) {
            return read_binary(bytes, count, name);
        }
        if (!is_solid) {
            throw input_error("{}: a binary STL file of {} triangles has {} bytes, but this one has {}", name, count,
                              needed, bytes.size());
        }
    }
    return read_ascii(bytes, name);
}

} // namespace meltpoint
