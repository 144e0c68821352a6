#include "run/coarse_file.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "core/aabb.h"
#include "core/log.h"

namespace meltpoint {

void warn_of_coarse_file(std::span<const glm::vec3> positions, const std::string& name)
{
    constexpr double tolerable = 1e-4; // of the extent: a tenth of the distance between a million points on a surface
    Aabb box;
    for (const glm::vec3& x : positions) {
        box.extend(x);
    }
    const glm::vec3 reach = glm::max(glm::abs(box.min), glm::abs(box.max));
    const double farthest = std::max({reach.x, reach.y, reach.z});
    const double extent = std::max({box.size().x, box.size().y, box.size().z});
    const double coarseness = farthest * static_cast<double>(std::numeric_limits<float>::epsilon());
    if (extent > 0.0 && coarseness > tolerable * extent) {
        log_warning(fmt::format("{}: lies {:.3g} m from the origin, where positions are good to {:.2g} m, and is only "
                                "{:.2g} m large: move it closer to the origin before",
                                name, farthest, coarseness, extent));
    }
}

} // namespace meltpoint
