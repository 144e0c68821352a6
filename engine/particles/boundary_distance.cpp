#include "particles/boundary_distance.h"

#include <algorithm>
#include <cmath>

#include "particles/sph_kernel.h"

namespace meltpoint {

namespace {

/// The kernel's shape summed over a line at distance z, as half the integral along it, in spacings.
double line_integral(std::uint32_t kernel, double support_ratio, double z)
{
    constexpr int intervals = 256;
    const double step = std::sqrt(std::max(support_ratio * support_ratio - z * z, 0.0)) / intervals;
    double sum = 0.0;
    for (int i = 0; i < intervals; ++i) {
        sum += density_shape(kernel, std::hypot((i + 0.5) * step, z) / support_ratio) * step;
    }
    return sum;
}

/// Over a plane, as an integral over 2 pi: r dr from z to H; in two dimensions, over a line.
double layer_integral(std::uint32_t kernel, double support_ratio, double z, std::uint32_t dimensions)
{
    if (dimensions == 2) {
        return line_integral(kernel, support_ratio, z);
    }
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

double boundary_distance(std::uint32_t kernel, double support_ratio, std::uint32_t dimensions)
{
    const int reach = static_cast<int>(support_ratio);
    double whole = 0.0;
    double beyond = 0.0; // layers 1, 2, ... of it
    for (int z = -reach; z <= reach; ++z) {
        for (int y = dimensions == 2 ? 0 : -reach; y <= (dimensions == 2 ? 0 : reach); ++y) {
            for (int x = -reach; x <= reach; ++x) {
                const double r = std::sqrt(static_cast<double>(x * x + y * y + z * z));
                const double shape = density_shape(kernel, r / support_ratio);
                whole += shape;
                beyond += z > 0 ? shape : 0.0;
            }
        }
    }
    // What a plane adds falls with its distance, from all of the sum in the plane itself.
    const double in_plane = layer_integral(kernel, support_ratio, 0.0, dimensions);
    double low = 0.0;
    double high = support_ratio;
    for (int i = 0; i < 40; ++i) {
        const double middle = 0.5 * (low + high);
        const bool too_much = layer_integral(kernel, support_ratio, middle, dimensions) / in_plane * whole > beyond;
        (too_much ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

} // namespace meltpoint
