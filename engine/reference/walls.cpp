#include "reference/walls.h"

#include "particles/sph_kernel.h"

namespace meltpoint::reference {

double inside_fraction(const Settings& settings, const glm::dvec3& position, int leave_out)
{
    const double support_radius = static_cast<double>(settings.params.support_radius);
    const double offset = static_cast<double>(settings.params.wall_density_offset);
    double inside = 1.0;
    for_each_wall(settings.params, position, [&](double distance, const glm::dvec3&, int wall) {
        if (wall != leave_out) {
            inside *= 1.0 - wall_density_integral(settings.kernel, distance + offset, support_radius);
        }
    });
    return inside;
}

} // namespace meltpoint::reference
