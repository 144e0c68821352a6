#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reference/state.h"
#include "shared/sand_surface.h"
#include "shared/solid_splats.h"
#include "shared/visibility.h"

namespace meltpoint::reference {

/// What stands on a texel of the map from above.
struct SandColumn {
    double height = 0.0;    ///< m above the floor
    bool is_ground = false; ///< sand or floor, and nothing else
    double share = 0.0;     ///< how much it is sand, 0 to 1
    glm::dvec3 color{0.0};  ///< linear RGB
};

/// The plane through the columns around a texel.
struct SandPlane {
    double height = 0.0;   ///< m above the floor, over the texel's middle
    glm::dvec2 slope{0.0}; ///< along the map's axes
    double off = 0.0;      ///< mean square of how far columns are off it, in spacings
};

/// A corner of texels.
struct SheetCorner {
    double height = 0.0; ///< m above the floor
    glm::dvec2 slope{0.0};
    double presence = 0.0; ///< how much of a sheet is there, 0 to 1
    glm::dvec3 color{0.0};
};

struct SandSheet {
    std::vector<SandColumn> columns;  ///< width * height
    std::vector<SheetCorner> corners; ///< (width + 1) * (height + 1)
};

/// What the sheet of a frame is made from besides the particles, of each texel, and by id.
struct SandSources {
    const shared::VisibilityParams& view;  ///< the map from above
    std::span<const double> top;           ///< m above the floor of the uppermost particle; negative: there is none
    std::span<const std::uint32_t> top_id; ///< who of the solids that is; 0xffffffff: none of them
    std::span<const double> damage;        ///< by id: what of it the wind has taken
    double seconds = 0.0;                  ///< since the frame before
};

/// Twin of render/sand_column.comp, sand_plane.comp and sand_surface.comp. Particles are in order of id. before: of the
/// frame before; empty where there is none.
[[nodiscard]] SandSheet sand_sheet(const Settings& settings, const shared::SolidSplatParams& splats, const State& state,
                                   const SandSources& sources, const SandSheet& before);

/// Twin of render/sand_cover.comp. left, size: of each particle, as in reference::SolidSplats.
void cover_sand(const Settings& settings, const shared::SolidSplatParams& splats, const State& state,
                const shared::VisibilityParams& view, const SandSheet& sheet, std::vector<double>& left,
                std::vector<double>& size);

} // namespace meltpoint::reference
