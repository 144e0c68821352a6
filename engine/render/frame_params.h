#pragma once

#include <cstdint>

#include "render/frame.h"
#include "shared/render_params.h"

namespace meltpoint::render {

/// The settings of a frame as shaders read them, for a picture of width x height pixels of samples x samples each and a
/// square shadow map. Throws Input as Renderer::draw documents.
[[nodiscard]] shared::RenderParams frame_params(const FrameSettings& settings, std::uint32_t width,
                                                std::uint32_t height, std::uint32_t samples, std::uint32_t shadow_size);

} // namespace meltpoint::render
