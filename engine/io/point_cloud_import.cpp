#include "io/point_cloud_import.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/aabb.h"
#include "core/color.h"
#include "core/error.h"
#include "io/input_file.h"
#include "io/ply_header.h"
#include "io/ply_read.h"
#include "io/text_scanner.h"

namespace meltpoint {

namespace {

constexpr float largest_extent = 1e9f; // m, as of a mesh

PointCloud read_ply_points(std::span<const std::uint8_t> bytes, const std::string& name)
{
    PlyContent content = read_ply(bytes, name);
    PointCloud cloud;
    cloud.positions = std::move(content.positions);
    cloud.normals = std::move(content.normals);
    cloud.colors = std::move(content.colors);
    return cloud;
}

using Columns = std::array<double, 9>;

constexpr std::string_view xyz_layout =
    "a line holds x y z, then nothing, an intensity, a normal, a color, or normal and color: 3, 4, 6 or 9 numbers, as "
    "many in each; before them may stand comments (# or //), the names of the columns, x y z first, and the number of "
    "points";

/// Whether this line holds the names of the columns: x, y, z, and whatever follows. Takes a copy, not to move on.
bool names_columns(TextScanner text)
{
    std::string names;
    for (std::string_view word = text.word_on_line(); !word.empty(); word = text.word_on_line()) {
        for (const char c : word) {
            if (std::string_view(",;\"").find(c) == std::string_view::npos) {
                names += static_cast<char>(c | 0x20); // lower case
            }
            if (names.size() == 3) {
                return names == "xyz";
            }
        }
    }
    return false;
}

/// Whether this line begins with a number.
bool holds_numbers(TextScanner text)
{
    const std::string_view word = text.word_on_line();
    return to_number(word.substr(0, word.find_first_of(",;"))).has_value() || word.starts_with("//");
}

/// The numbers of a line, before a comment. Returns how many there are: at most one too many.
std::size_t read_line(TextScanner& text, Columns& columns)
{
    std::size_t count = 0;
    for (std::string_view word = text.word_on_line(); !word.empty() && word.front() != '#';
         word = text.word_on_line()) {
        if (word.starts_with("//")) {
            break;
        }
        for (std::size_t begin = 0; begin <= word.size();) { // "1,2,3" is one word
            const std::size_t end = std::min(word.find_first_of(",;", begin), word.size());
            if (end > begin || end < word.size()) {
                const double value = text.number(word.substr(begin, end - begin), "a column");
                if (count == columns.size()) {
                    return count + 1;
                }
                columns[count++] = value;
            }
            begin = end + 1;
        }
    }
    return count;
}

bool are_colors(const std::vector<glm::vec3>& triples)
{
    const auto fits = [](const glm::vec3& c) {
        return c == glm::floor(c) && std::min({c.x, c.y, c.z}) >= 0.0f && std::max({c.x, c.y, c.z}) <= 255.0f;
    };
    const auto is_unit = [](const glm::vec3& c) {
        return std::abs(glm::length(c) - 1.0f) < 0.01f;
    };
    return std::all_of(triples.begin(), triples.end(), fits) && !std::all_of(triples.begin(), triples.end(), is_unit);
}

PointCloud read_xyz(std::span<const std::uint8_t> bytes, const std::string& name)
{
    TextScanner text(bytes, name);
    PointCloud cloud;
    Columns columns{};
    std::size_t first_count = 0;    // of columns
    std::optional<double> promised; // points
    bool named = false;             // the columns are
    for (bool more = text.next_content(); more; more = text.next_line() && text.next_content()) {
        if (first_count == 0 && !named && names_columns(text)) {
            named = true;
            continue;
        }
        if (first_count == 0 && !holds_numbers(text)) {
            throw text.error("neither a point nor a header: {}", xyz_layout);
        }
        const std::size_t count = read_line(text, columns);
        if (count == 0) { // a comment after all
            continue;
        }
        if (count == 1 && first_count == 0 && !promised) {
            promised = columns[0];
            continue;
        }
        first_count = first_count == 0 ? count : first_count;
        if ((count != 3 && count != 4 && count != 6 && count != 9) || count != first_count) {
            throw text.error("{}{} numbers in a line: {}", count > columns.size() ? "more than " : "",
                             std::min(count, columns.size()), xyz_layout);
        }
        cloud.positions.emplace_back(columns[0], columns[1], columns[2]);
        if (count >= 6) {
            cloud.normals.emplace_back(columns[3], columns[4], columns[5]);
        }
        if (count == 9) {
            cloud.colors.emplace_back(color_byte(columns[6]), color_byte(columns[7]), color_byte(columns[8]));
        }
    }
    if (promised && *promised != static_cast<double>(cloud.size())) {
        throw input_error("{}: the file says that it holds {} points, but holds {}", name, *promised, cloud.size());
    }
    cloud.intensity_ignored = first_count == 4;
    if (first_count == 6 && are_colors(cloud.normals)) {
        for (const glm::vec3& c : cloud.normals) {
            cloud.colors.emplace_back(color_byte(c.x), color_byte(c.y), color_byte(c.z));
        }
        cloud.normals.clear();
    }
    return cloud;
}

bool is_finite(const glm::vec3& v)
{
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void check(const PointCloud& cloud, const std::string& name)
{
    if (cloud.positions.empty()) {
        throw input_error("{}: the file holds no points", name);
    }
    Aabb box;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        const glm::vec3& p = cloud.positions[i];
        if (!is_finite(p)) {
            throw input_error("{}: point {} is not finite ({}, {}, {})", name, i, p.x, p.y, p.z);
        }
        box.extend(p);
    }
    const glm::vec3 reach = glm::max(glm::abs(box.min), glm::abs(box.max));
    const float extent = std::max({reach.x, reach.y, reach.z});
    if (extent > largest_extent) {
        throw input_error("{}: the points reach {:g} m, at most {:g} m are supported", name, extent, largest_extent);
    }
}

void normalize(std::vector<glm::vec3>& normals)
{
    bool any = false;
    for (glm::vec3& normal : normals) {
        const double length = is_finite(normal) ? glm::length(glm::dvec3(normal)) : 0.0;
        any = any || length > 0.0;
        normal = length > 0.0 ? glm::vec3(glm::dvec3(normal) / length) : glm::vec3(0.0f);
    }
    if (!any) {
        normals.clear();
    }
}

} // namespace

bool holds_points(std::span<const std::uint8_t> bytes, const std::filesystem::path& path)
{
    const std::string extension = lower_extension(path);
    return extension == "xyz" || (extension == "ply" && !has_faces(read_ply_header(bytes, path.string())));
}

PointCloud parse_point_cloud(std::span<const std::uint8_t> bytes, const std::filesystem::path& path)
{
    const std::string extension = lower_extension(path);
    if (extension != "ply" && extension != "xyz") {
        throw input_error("{}: points are read from files that end in .ply or .xyz, not in \"{}\"", path.string(),
                          path.extension().string());
    }
    PointCloud cloud = extension == "ply" ? read_ply_points(bytes, path.string()) : read_xyz(bytes, path.string());
    check(cloud, path.string());
    normalize(cloud.normals);
    return cloud;
}

PointCloud import_point_cloud(const std::filesystem::path& path)
{
    return parse_point_cloud(read_input_file(path), path);
}

} // namespace meltpoint
