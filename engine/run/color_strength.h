#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>
#include <glm/gtc/type_precision.hpp>

#include "geometry/point_cloud.h"
#include "scene/materials.h"
#include "scene/scene.h"

namespace meltpoint {

/// contrast^(2 L - 1), L the luminance of an sRGB color, linear, from 0 to 1: black is 1 / contrast, white contrast.
[[nodiscard]] float color_strength(const glm::u8vec3& color, float contrast);

/// Points on the surfaces of the solids of a material, half a particle spacing apart, with the colors of their files.
/// Throws Input, which names solid and file, where one has no colors; and as placed_surface.
[[nodiscard]] PointCloud colored_surfaces(const Scene& scene, const SceneMaterials& materials, std::size_t material);

/// Of each place (m): color_strength of the point of the surface that is nearest.
[[nodiscard]] std::vector<float> color_strengths(const PointCloud& surface, float contrast,
                                                 std::span<const glm::vec3> places);

} // namespace meltpoint
