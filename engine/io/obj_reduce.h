#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace meltpoint {

/// The lines of an OBJ file (Wavefront 1990s) that make its surface: vertices without what follows their coordinates,
/// normals, faces; texture coordinates only as places to count. Groups, materials, lines, curves and the other files
/// that it names are left out, so that the importer behind never meets them. Lines that this importer would skip in
/// silence, or misread, are an Input error "name:line: reason".
[[nodiscard]] std::vector<std::uint8_t> reduce_obj(std::span<const std::uint8_t> bytes, const std::string& name);

} // namespace meltpoint
