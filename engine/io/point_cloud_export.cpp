#include "io/point_cloud_export.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/compile.h>

#include "core/error.h"
#include "io/input_file.h"
#include "io/point_cloud_formats.h"

namespace meltpoint {

namespace {

struct Format {
    std::string_view extension;
    bool (*write)(AtomicFile&, RowWriter&, const PointCloud&);
};

constexpr std::array<Format, 4> formats{
    {{"ply", write_ply}, {"msh", write_msh}, {"vtp", write_vtp}, {"xyz", write_xyz}}};

const Format& format_of(const std::filesystem::path& path)
{
    const std::string extension = lower_extension(path);
    const auto* const format =
        std::find_if(formats.begin(), formats.end(), [&](const Format& each) { return each.extension == extension; });
    if (format == formats.end()) {
        throw input_error("{}: points are written to files that end in .ply, .msh, .vtp or .xyz, not in \"{}\"",
                          path.string(), path.extension().string());
    }
    return *format;
}

void check_lengths(const std::filesystem::path& path, const PointCloud& cloud)
{
    for (const std::size_t length :
         {cloud.normals.size(), cloud.triangle.size(), cloud.barycentric.size(), cloud.colors.size()}) {
        if (length != 0 && length != cloud.size()) {
            throw runtime_error("cannot write {}: of {} points, an attribute has {}", path.string(), cloud.size(),
                                length);
        }
    }
}

} // namespace

void check_point_cloud_format(const std::filesystem::path& path)
{
    (void)format_of(path);
}

bool export_point_cloud(const std::filesystem::path& path, const PointCloud& cloud, const std::atomic<bool>* stop)
{
    const Format& format = format_of(path);
    check_lengths(path, cloud);
    AtomicFile file(path);
    RowWriter rows(file, stop);
    if (!format.write(file, rows, cloud)) {
        return false;
    }
    file.commit();
    return true;
}

// --- PLY (Turk 1994) -----------------------------------------------------------------------------

bool write_ply(AtomicFile& file, RowWriter& rows, const PointCloud& cloud)
{
    std::string header = fmt::format("ply\nformat binary_little_endian 1.0\ncomment points of meltpoint, lengths in m\n"
                                     "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n",
                                     cloud.size());
    std::size_t row_bytes = sizeof(glm::vec3);
    const auto add = [&](bool there, std::string_view properties, std::size_t bytes) {
        header += there ? properties : "";
        row_bytes += there ? bytes : 0;
        return there;
    };
    const bool normals =
        add(!cloud.normals.empty(), "property float nx\nproperty float ny\nproperty float nz\n", sizeof(glm::vec3));
    const bool colors = add(!cloud.colors.empty(), "property uchar red\nproperty uchar green\nproperty uchar blue\n",
                            sizeof(glm::u8vec3));
    const bool triangle = add(!cloud.triangle.empty(), "property uint triangle\n", sizeof(std::uint32_t));
    const bool barycentric = add(!cloud.barycentric.empty(), "property float u\nproperty float v\n", sizeof(glm::vec2));
    file.write(header + "end_header\n");
    return rows.binary(cloud.size(), row_bytes, [&](std::byte* place, std::size_t i) {
        place = put(place, cloud.positions[i]);
        place = normals ? put(place, cloud.normals[i]) : place;
        place = colors ? put(place, cloud.colors[i]) : place;
        place = triangle ? put(place, cloud.triangle[i]) : place;
        place = barycentric ? put(place, cloud.barycentric[i]) : place;
    });
}

// --- Gmsh 2.2, binary (Geuzaine & Remacle 2009; "MSH file format" of its manual) -----------------

bool write_msh(AtomicFile& file, RowWriter& rows, const PointCloud& cloud)
{
    constexpr int version_check = 1; // tells the byte order
    constexpr int point_element = 15;
    constexpr int tags = 2; // of an element: physical and elementary entity
    const auto write_ints = [&file](std::initializer_list<int> values) {
        file.write(std::as_bytes(std::span(values.begin(), values.size())));
    };
    const auto number = [](std::size_t i) {
        return static_cast<int>(i + 1);
    };
    const auto count = static_cast<int>(cloud.size());

    file.write("$MeshFormat\n2.2 1 8\n");
    write_ints({version_check});
    file.write(fmt::format("\n$EndMeshFormat\n$Nodes\n{}\n", count));
    bool done = rows.binary(cloud.size(), sizeof(int) + sizeof(glm::dvec3), [&](std::byte* place, std::size_t i) {
        put(put(place, number(i)), glm::dvec3(cloud.positions[i]));
    });
    file.write(fmt::format("\n$EndNodes\n$Elements\n{}\n", count));
    write_ints({point_element, count, tags});
    done = done && rows.binary(cloud.size(), 4 * sizeof(int), [&](std::byte* place, std::size_t i) {
        put(place, std::array<int, 4>{number(i), 1, 1, number(i)});
    });
    file.write("\n$EndElements\n");
    if (!cloud.normals.empty()) {
        // One text (the view's name), one number (its time), three whole numbers (time step, components, nodes).
        file.write(fmt::format("$NodeData\n1\n\"normals\"\n1\n0\n3\n0\n3\n{}\n", count));
        done =
            done && rows.binary(cloud.size(), sizeof(int) + sizeof(glm::dvec3), [&](std::byte* place, std::size_t i) {
                put(put(place, number(i)), glm::dvec3(cloud.normals[i]));
            });
        file.write("\n$EndNodeData\n");
    }
    return done;
}

// --- VTK XML PolyData ("VTK file formats" of its user's guide) -----------------------------------

bool write_vtp(AtomicFile& file, RowWriter& rows, const PointCloud& cloud)
{
    std::uint64_t offset = 0;
    // Each array lies behind the XML, behind its own number of bytes.
    const auto array = [&](std::string_view type, std::string_view name, int components, std::size_t value_bytes) {
        std::string text = fmt::format(
            "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n", type,
            name, components, offset);
        offset += sizeof(std::uint64_t) + cloud.size() * value_bytes;
        return text;
    };
    std::string xml = "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" "
                      "header_type=\"UInt64\">\n<PolyData>\n";
    xml += fmt::format("<Piece NumberOfPoints=\"{0}\" NumberOfVerts=\"{0}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
                       "NumberOfPolys=\"0\">\n<Points>\n",
                       cloud.size());
    xml += array("Float32", "Points", 3, sizeof(glm::vec3)) + "</Points>\n<Verts>\n";
    xml += array("Int32", "connectivity", 1, sizeof(std::int32_t));
    xml += array("Int32", "offsets", 1, sizeof(std::int32_t)) + "</Verts>\n";
    xml += cloud.normals.empty() ? "<PointData>\n" : "<PointData Normals=\"Normals\">\n";
    xml += cloud.normals.empty() ? "" : array("Float32", "Normals", 3, sizeof(glm::vec3));
    xml += cloud.colors.empty() ? "" : array("UInt8", "Colors", 3, sizeof(glm::u8vec3));
    xml += cloud.triangle.empty() ? "" : array("UInt32", "triangle", 1, sizeof(std::uint32_t));
    xml += cloud.barycentric.empty() ? "" : array("Float32", "barycentric", 2, sizeof(glm::vec2));
    xml += "</PointData>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
    file.write(xml);

    bool done = true;
    const auto append = [&](std::size_t value_bytes, const auto& value_at) {
        const std::uint64_t bytes = cloud.size() * value_bytes;
        file.write(std::as_bytes(std::span(&bytes, 1)));
        done = done && rows.binary(cloud.size(), value_bytes,
                                   [&](std::byte* place, std::size_t i) { put(place, value_at(i)); });
    };
    const auto append_all = [&](const auto& values) {
        if (!values.empty()) {
            append(sizeof(values[0]), [&](std::size_t i) -> const auto& { return values[i]; });
        }
    };
    append(sizeof(glm::vec3), [&](std::size_t i) { return cloud.positions[i]; });
    append(sizeof(std::int32_t), [](std::size_t i) { return static_cast<std::int32_t>(i); });
    append(sizeof(std::int32_t), [](std::size_t i) { return static_cast<std::int32_t>(i + 1); });
    append_all(cloud.normals);
    append_all(cloud.colors);
    append_all(cloud.triangle);
    append_all(cloud.barycentric);
    file.write("\n</AppendedData>\n</VTKFile>\n");
    return done;
}

// --- XYZ -----------------------------------------------------------------------------------------

bool write_xyz(AtomicFile& /*file*/, RowWriter& rows, const PointCloud& cloud)
{
    return rows.text(cloud.size(), [&](std::string& text, std::size_t i) {
        const auto out = std::back_inserter(text);
        const glm::vec3& p = cloud.positions[i];
        fmt::format_to(out, FMT_COMPILE("{} {} {}"), p.x, p.y, p.z);
        if (!cloud.normals.empty()) {
            const glm::vec3& n = cloud.normals[i];
            fmt::format_to(out, FMT_COMPILE(" {} {} {}"), n.x, n.y, n.z);
        }
        if (!cloud.colors.empty()) {
            const glm::u8vec3& c = cloud.colors[i];
            fmt::format_to(out, FMT_COMPILE(" {} {} {}"), c.r, c.g, c.b);
        }
        text.push_back('\n');
    });
}

} // namespace meltpoint
