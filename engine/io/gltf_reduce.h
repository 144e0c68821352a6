#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace meltpoint {

/// A binary glTF 2.0 file (GLB) of its own that holds the triangles of a glTF file and nothing else: the nodes of its
/// scene with their transforms, meshes with positions, normals, colors (COLOR_0, without its alpha) and indices, and
/// the buffers that those lie in, which may be in the GLB, in a data URI or in files beside `path`. Colors are linear
/// in the file and sRGB in what is written, 8 bits a channel. Materials, textures, animations, skins, cameras and
/// extensions are left out, so that the importer behind never meets them; every number that it relies on is checked.
/// Input errors that name the path: what is no glTF 2.0 or broken; buffers outside the file's folder; nodes that are
/// deeper than 1000 levels or no tree; instances of meshes beyond ten million triangles; extensions that the triangles
/// depend on (compression); colors that are not finite, or that share bytes so that there are more than fit in the
/// file.
[[nodiscard]] std::vector<std::uint8_t> reduce_gltf(std::span<const std::uint8_t> bytes,
                                                    const std::filesystem::path& path);

} // namespace meltpoint
