#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include <glm/glm.hpp>

#include "core/aabb.h"
#include "gpu/buffer.h"
#include "render/camera.h"
#include "shared/render_params.h"

namespace meltpoint::render {

/// Most particles, and most discs, of a frame: six vertices each must have an index of 32 bits.
inline constexpr std::uint32_t max_splats = 1u << 28;

/// Particles in device buffers, read only. Fluid, solid and dust alike are drawn as spheres; dead ones are not drawn.
struct ParticleView {
    const gpu::Buffer& position;   ///< vec4: xyz in m
    const gpu::Buffer& velocity;   ///< vec4: xyz in m/s
    const gpu::Buffer& density;    ///< float, kg/m^3
    const gpu::Buffer& pressure;   ///< float, Pa
    const gpu::Buffer& attributes; ///< uint, shared/particle_state.h
    std::uint32_t count = 0;

    /// When what was solid was freed: float by id, s, and the particles' ids, uint. Null where nobody knows.
    const gpu::Buffer* freed_at = nullptr;
    const gpu::Buffer* id = nullptr;
    float time = 0.0f; ///< s, of the frame

    /// Of each sphere, in radii of FrameSettings: float, in the particles' order; sand in the air is then a puff of
    /// specks, and needs ids. Null: all have one size, but for dust.
    const gpu::Buffer* size = nullptr;
};

/// Surface splats in device buffers, read only: flat discs.
struct DiscView {
    const gpu::Buffer& position; ///< vec4: xyz in m, w the radius in m
    const gpu::Buffer& normal;   ///< vec4: xyz, of any length but 0; w is shared::DISC_*
    const gpu::Buffer& color;    ///< vec4: linear RGB
    /// vec4: of a bent disc, xyz says how its normal turns along it (include/splat.glsl), 1/m; an edged one is where
    /// the way from its center times xyz is at most 1; w is how wet it is, 0 to 1.
    const gpu::Buffer& bend;
    std::uint32_t count = 0;
};

/// The sheet over columns of sand (shared/sand_surface.h) in device buffers, read only.
struct SandSheetView {
    const gpu::Buffer& view;        ///< shared::VisibilityParams, of the map from above
    const gpu::Buffer& corner;      ///< vec4: height, slope, how much of a sheet there is
    const gpu::Buffer& corner_tint; ///< vec4: linear RGB
    std::uint32_t quads = 0;        ///< texels of the map
};

/// A ground plane that fades into the background.
struct Floor {
    float height = 0.0f;                   ///< m; the plane y = height
    glm::vec2 center{0.0f};                ///< m, x and z, of the fade
    float extent = 5.0f;                   ///< m from the center to where nothing of it is left
    float grid = 0.25f;                    ///< m between its lines
    glm::vec3 color{0.80f, 0.815f, 0.83f}; ///< linear RGB
};

/// How a frame looks. Lengths in meters, colors linear RGB.
struct FrameSettings {
    Camera camera;
    glm::vec3 light_direction{0.45f, 1.0f, 0.35f}; ///< from the scene to the light, of any length but 0
    glm::vec3 background{0.86f, 0.89f, 0.92f};
    std::optional<Floor> floor;
    Aabb bounds;      ///< what may cast a shadow; empty: no shadows
    bool box = false; ///< draws the edges of bounds
    glm::vec3 box_color{0.42f, 0.46f, 0.51f};
    std::uint32_t color_mode = shared::COLOR_MATERIAL; ///< shared::COLOR_*
    glm::vec2 color_range{0.0f, 1.0f};                 ///< at the ends of the colormap, in the mode's unit
    bool lit = true;                                   ///< false: plain colors without light and shadow
    float splat_radius = 0.01f;                        ///< of particles
    std::array<float, shared::MAX_MATERIALS> rest_density{};
    std::array<glm::vec3, shared::MAX_MATERIALS> material_color{};
    std::array<glm::vec3, shared::MAX_MATERIALS> solid_color{}; ///< of solid particles of a material
    float blend_time = 0.5f; ///< s, in which what was solid takes on the color of its fluid
};

/// What a frame shows.
struct Frame {
    FrameSettings settings;
    std::optional<ParticleView> particles;
    std::optional<DiscView> discs;
    std::optional<SandSheetView> sand = std::nullopt;
};

} // namespace meltpoint::render
