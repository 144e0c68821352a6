#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/type_precision.hpp>

namespace meltpoint {

/// What a PLY file tells of a surface. Normals and colors: one a vertex, or none.
struct PlyContent {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals; ///< as in the file, of any length
    std::vector<glm::u8vec3> colors;
    std::vector<glm::uvec3> triangles; ///< polygons cut into triangles, strips taken apart
};

/// Reads a PLY file, ASCII or binary of either byte order: x y z; nx ny nz; red green blue (0 to 255, or to 65535, or,
/// if float, to 1) of "vertex"; vertex_indices of "face" and "tristrips". Other elements and properties are skipped.
/// Whatever is broken, cut off or points outside the file is an Input error that begins with `name`. Values may be not
/// finite.
[[nodiscard]] PlyContent read_ply(std::span<const std::uint8_t> bytes, const std::string& name);

} // namespace meltpoint
