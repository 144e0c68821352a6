#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace meltpoint {

enum class PlyType { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

[[nodiscard]] std::size_t byte_size(PlyType type);

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::Float32;   ///< of the value, or of each value of a list
    std::optional<PlyType> count_type; ///< of the number before a list's values; none: a single value
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0;
    std::vector<PlyProperty> properties;
};

enum class PlyEncoding { Ascii, LittleEndian, BigEndian };

/// The header of a PLY file, the Stanford polygon file format (Turk 1994): which elements follow, with which
/// properties.
struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::Ascii;
    std::vector<PlyElement> elements;
    std::size_t size = 0;  ///< bytes before the first element's
    std::size_t lines = 0; ///< lines of the header
};

/// Reads the header that a PLY file begins with. What is no such header, and counts of elements that cannot fit into
/// the file, are an Input error that begins with `name`.
[[nodiscard]] PlyHeader read_ply_header(std::span<const std::uint8_t> bytes, const std::string& name);

/// Whether the header tells of faces (or strips of them): a mesh rather than a cloud of points.
[[nodiscard]] bool has_faces(const PlyHeader& header);

} // namespace meltpoint
