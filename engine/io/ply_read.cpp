#include "io/ply_read.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <string_view>

#include "core/color.h"
#include "geometry/polygon_triangulation.h"
#include "io/mesh_limits.h"
#include "io/ply_header.h"
#include "io/text_scanner.h"

namespace meltpoint {

namespace {

static_assert(std::endian::native == std::endian::little);

/// The values of a PLY file behind its header, one after the other.
class Body {
public:
    Body(std::span<const std::uint8_t> bytes, const PlyHeader& header, const std::string& name)
        : encoding_(header.encoding), bytes_(bytes.subspan(header.size)), text_(bytes_, name, header.lines + 1),
          name_(name)
    {
    }

    double value(PlyType type)
    {
        if (encoding_ == PlyEncoding::Ascii) {
            return text_.number(text_.word(), "a value");
        }
        switch (type) {
        case PlyType::Int8:
            return binary<std::int8_t>();
        case PlyType::Uint8:
            return binary<std::uint8_t>();
        case PlyType::Int16:
            return binary<std::int16_t>();
        case PlyType::Uint16:
            return binary<std::uint16_t>();
        case PlyType::Int32:
            return binary<std::int32_t>();
        case PlyType::Uint32:
            return binary<std::uint32_t>();
        case PlyType::Float32:
            return binary<float>();
        case PlyType::Float64:
            break;
        }
        return binary<double>();
    }

    void skip(PlyType type, std::uint64_t values)
    {
        if (encoding_ != PlyEncoding::Ascii) {
            take(values * byte_size(type));
            return;
        }
        for (std::uint64_t i = 0; i < values; ++i) {
            (void)value(type);
        }
    }

    /// The values of a list, which are whole numbers.
    void list(const PlyProperty& property, std::vector<std::int64_t>& values)
    {
        values.resize(list_length(property));
        for (std::int64_t& each : values) {
            const double number = value(property.type);
            // What is no index, and not a number too, becomes one that nobody accepts.
            each = number >= -1.0 && number < 4294967296.0 ? static_cast<std::int64_t>(number) : INT64_MAX;
        }
    }

    void skip(const PlyProperty& property) { skip(property.type, property.count_type ? list_length(property) : 1); }

private:
    std::uint64_t list_length(const PlyProperty& property)
    {
        const double length = value(property.count_type.value_or(PlyType::Uint8));
        const std::size_t least = encoding_ == PlyEncoding::Ascii ? 1 : byte_size(property.type);
        const auto most = static_cast<double>(bytes_.size()) / static_cast<double>(least);
        if (length < 0.0 || length > most || std::isnan(length)) {
            throw input_error("{}: a list of {:g} values is longer than the file", name_, length);
        }
        return static_cast<std::uint64_t>(length);
    }

    const std::uint8_t* take(std::uint64_t count)
    {
        if (count > bytes_.size() - at_) {
            throw input_error("{}: the file ends too early, before all that its header announces", name_);
        }
        at_ += count;
        return bytes_.data() + at_ - count;
    }

    template <class T>
    double binary()
    {
        std::array<std::uint8_t, sizeof(T)> bytes{};
        std::memcpy(bytes.data(), take(sizeof(T)), sizeof(T));
        if (encoding_ == PlyEncoding::BigEndian) {
            std::reverse(bytes.begin(), bytes.end());
        }
        return static_cast<double>(std::bit_cast<T>(bytes));
    }

    PlyEncoding encoding_;
    std::span<const std::uint8_t> bytes_;
    std::size_t at_ = 0;
    TextScanner text_;
    std::string name_;
};

std::optional<std::size_t> find_property(const PlyElement& element, std::string_view name)
{
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
        if (element.properties[i].name == name && !element.properties[i].count_type) {
            return i;
        }
    }
    return {};
}

/// Where three properties stand, if all three are there.
std::optional<std::array<std::size_t, 3>> find_triple(const PlyElement& element, std::string_view a, std::string_view b,
                                                      std::string_view c)
{
    const auto first = find_property(element, a);
    const auto second = find_property(element, b);
    const auto third = find_property(element, c);
    if (!first || !second || !third) {
        return {};
    }
    return {{*first, *second, *third}};
}

glm::vec3 vector_at(const std::vector<double>& row, const std::array<std::size_t, 3>& place)
{
    return {row[place[0]], row[place[1]], row[place[2]]};
}

std::uint8_t color_of(double value, PlyType type)
{
    const bool is_float = type == PlyType::Float32 || type == PlyType::Float64;
    const bool is_wide = type == PlyType::Int16 || type == PlyType::Uint16;
    return color_byte(is_float ? 255.0 * value : is_wide ? value / 257.0 : value);
}

void read_vertices(Body& body, const PlyElement& element, const std::string& name, PlyContent& content)
{
    const auto position = find_triple(element, "x", "y", "z");
    if (!position) {
        throw input_error("{}: the vertices of the PLY file lack x, y or z", name);
    }
    const auto normal = find_triple(element, "nx", "ny", "nz");
    auto color = find_triple(element, "red", "green", "blue");
    if (!color) {
        color = find_triple(element, "diffuse_red", "diffuse_green", "diffuse_blue");
    }
    content.positions.reserve(element.count);
    content.normals.reserve(normal ? element.count : 0);
    content.colors.reserve(color ? element.count : 0);
    std::vector<double> row(element.properties.size(), 0.0);
    for (std::uint64_t i = 0; i < element.count; ++i) {
        for (std::size_t k = 0; k < row.size(); ++k) {
            if (element.properties[k].count_type) {
                body.skip(element.properties[k]);
            } else {
                row[k] = body.value(element.properties[k].type);
            }
        }
        content.positions.push_back(vector_at(row, *position));
        if (normal) {
            content.normals.push_back(vector_at(row, *normal));
        }
        if (color) {
            glm::u8vec3& rgb = content.colors.emplace_back();
            for (int channel = 0; channel < 3; ++channel) {
                const std::size_t place = (*color)[static_cast<std::size_t>(channel)];
                rgb[channel] = color_of(row[place], element.properties[place].type);
            }
        }
    }
}

std::uint32_t checked_index(std::int64_t index, const PlyContent& content, const std::string& name)
{
    if (index < 0 || static_cast<std::uint64_t>(index) >= content.positions.size()) {
        throw input_error("{}: a face names a vertex that is not one of the {}", name, content.positions.size());
    }
    return static_cast<std::uint32_t>(index);
}

void append_polygon(const std::vector<std::int64_t>& corners, const std::string& name, PlyContent& content,
                    std::vector<std::uint32_t>& polygon)
{
    polygon.clear();
    for (const std::int64_t corner : corners) {
        polygon.push_back(checked_index(corner, content, name));
    }
    triangulate_polygon(polygon, content.positions, content.triangles);
}

/// Strips of triangles, each begun anew after a -1; every other triangle of a strip is turned round.
void append_strips(const std::vector<std::int64_t>& corners, const std::string& name, PlyContent& content)
{
    std::size_t begin = 0; // of the strip
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (corners[i] == -1) {
            begin = i + 1;
        } else if (i - begin >= 2) {
            const glm::uvec3 triangle(checked_index(corners[i - 2], content, name),
                                      checked_index(corners[i - 1], content, name),
                                      checked_index(corners[i], content, name));
            const bool turned = (i - begin) % 2 == 1;
            content.triangles.push_back(turned ? glm::uvec3(triangle.y, triangle.x, triangle.z) : triangle);
        }
    }
}

void read_faces(Body& body, const PlyElement& element, const std::string& name, PlyContent& content)
{
    const auto is_corners = [](const PlyProperty& property) {
        return property.count_type && (property.name == "vertex_indices" || property.name == "vertex_index");
    };
    if (std::count_if(element.properties.begin(), element.properties.end(), is_corners) != 1) {
        throw input_error("{}: the faces of the PLY file have no list of vertex_indices", name);
    }
    std::vector<std::int64_t> corners;
    std::vector<std::uint32_t> polygon;
    PolygonCheck check_corners(name);
    content.triangles.reserve(element.name == "face" ? element.count : 0);
    for (std::uint64_t i = 0; i < element.count; ++i) {
        for (const PlyProperty& property : element.properties) {
            if (!is_corners(property)) {
                body.skip(property);
                continue;
            }
            body.list(property, corners);
            if (element.name == "face") {
                check_corners(corners.size());
                append_polygon(corners, name, content, polygon);
            } else {
                append_strips(corners, name, content);
            }
            check_triangles(content.triangles.size(), name);
        }
    }
}

} // namespace

PlyContent read_ply(std::span<const std::uint8_t> bytes, const std::string& name)
{
    const PlyHeader header = read_ply_header(bytes, name);
    Body body(bytes, header, name);
    PlyContent content;
    bool has_vertices = false;
    for (const PlyElement& element : header.elements) {
        if (element.name == "vertex") {
            read_vertices(body, element, name, content);
            has_vertices = true;
        } else if ((element.name == "face" || element.name == "tristrips") && element.count > 0) {
            if (!has_vertices) {
                throw input_error("{}: the faces of the PLY file stand before its vertices", name);
            }
            read_faces(body, element, name, content);
        } else if (!element.properties.empty()) {
            for (std::uint64_t i = 0; i < element.count; ++i) {
                for (const PlyProperty& property : element.properties) {
                    body.skip(property);
                }
            }
        }
    }
    if (!has_vertices) {
        throw input_error("{}: the PLY file has no vertices", name);
    }
    return content;
}

} // namespace meltpoint
