#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace meltpoint {

/// The lines of an OBJ file (Wavefront 1990s) that make its surface: vertices, normals, faces; texture coordinates only
/// as places to count. Groups, materials, lines, curves and the other files that it names are left out, so that the
/// importer behind never meets them. A vertex may have a color, as many programs write it: red, green and blue behind x
/// y z, sRGB from 0 to 1, or, where one of the file is 2 or more, from 0 to 255; an alpha behind it is ignored. What is
/// written has colors from 0 to 1, of all vertices where one has any: the others are white. Lines that the importer
/// would skip in silence, or misread, and colors that are no finite numbers are an Input error "name:line: reason".
[[nodiscard]] std::vector<std::uint8_t> reduce_obj(std::span<const std::uint8_t> bytes, const std::string& name);

} // namespace meltpoint
