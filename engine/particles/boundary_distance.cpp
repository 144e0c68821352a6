#include "particles/boundary_distance.h"

#include <cmath>

#include "particles/sph_kernel.h"

namespace meltpoint {

namespace {

/// The kernel's shape summed over a plane at distance z, as an integral over 2 pi: r dr from z to H, in spacings.
double plane_integral(std::uint32_t kernel, double support_ratio, double z)
{
    constexpr int intervals = 256;
    const double step = (support_ratio - z) / intervals;
    double sum = 0.0;
    for (int i = 0; i < intervals; ++i) {
        const double r = z + (i + 0.5) * step;
        sum += density_shape(kernel, r / support_ratio) * r * step;
    }
    return sum;
}

} // namespace

double boundary_distance(std::uint32_t kernel, double support_ratio)
{
    const int reach = static_cast<int>(support_ratio);
    double whole = 0.0;
    double beyond = 0.0; // layers 1, 2, ... of it
    for (int z = -reach; z <= reach; ++z) {
        for (int y = -reach; y <= reach; ++y) {
            for (int x = -reach; x <= reach; ++x) {
                const double r = std::sqrt(static_cast<double>(x * x + y * y + z * z));
                const double shape = density_shape(kernel, r / support_ratio);
                whole += shape;
                beyond += z > 0 ? shape : 0.0;
            }
        }
    }
    // What a plane adds falls with its distance, from all of the sum in the plane itself.
    const double in_plane = plane_integral(kernel, support_ratio, 0.0);
    double low = 0.0;
    double high = support_ratio;
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        const bool too_much = plane_integral(kernel, support_ratio, middle) / in_plane * whole > beyond;
        (too_much ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

} // namespace meltpoint
