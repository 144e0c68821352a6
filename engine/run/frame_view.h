#pragma once

#include <optional>

#include "render/frame.h"
#include "render/legend.h"
#include "scene/scene.h"
#include "shared/sph_params.h"

namespace meltpoint {

/// How a scene's frames look: camera, colors and floor, automatic values resolved. The color range stays the same over
/// all frames, so that they can be compared.
[[nodiscard]] render::FrameSettings frame_settings(const Scene& any_scene, const shared::SphParams& params);

/// The legend of the scene's color mode; none for the material mode or where the scene wants none.
[[nodiscard]] std::optional<render::Legend> frame_legend(const Scene& scene, const render::FrameSettings& settings);

} // namespace meltpoint
