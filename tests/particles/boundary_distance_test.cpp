#include "particles/boundary_distance.h"

#include <cmath>

#include <gtest/gtest.h>

#include "particles/sph_kernel.h"

namespace meltpoint {
namespace {

// A lattice of layers z, z + 1, ... over a lattice layer of boundary particles of pitch f, by plain sums: the density
// of its first layer, in rest densities, averaged over where the two lattices meet.
double density_of_first_layer(std::uint32_t kernel, double h, double f, double z)
{
    const auto shape = [&](double x, double y, double w) {
        return density_shape(kernel, std::sqrt(x * x + y * y + w * w) / h);
    };
    const int n = static_cast<int>(h / f) + 2;
    double whole = 0.0;
    double fluid = 0.0;
    for (int x = -n; x <= n; ++x) {
        for (int y = -n; y <= n; ++y) {
            for (int w = -n; w <= n; ++w) {
                whole += shape(x, y, w);
                fluid += w >= 0 ? shape(x, y, w) : 0.0;
            }
        }
    }
    double in_layer = 0.0;
    double boundary = 0.0;
    constexpr int shifts = 8;
    for (int x = -n; x <= n; ++x) {
        for (int y = -n; y <= n; ++y) {
            in_layer += shape(f * x, f * y, 0.0);
            for (int i = 0; i < shifts; ++i) {
                for (int j = 0; j < shifts; ++j) {
                    const double dx = (i + 0.5) / shifts;
                    const double dy = (j + 0.5) / shifts;
                    boundary += shape(f * (x + dx), f * (y + dy), z) / (shifts * shifts);
                }
            }
        }
    }
    return (fluid + whole / in_layer * boundary) / whole;
}

TEST(BoundaryDistance, IsWhereALatticeIsAtRest)
{
    for (const std::uint32_t kernel : {shared::KERNEL_PAPER, shared::KERNEL_WENDLAND}) {
        for (const double h : {1.6, 2.0, 2.6, 3.0, 4.0}) {
            for (const double f : {0.5, 0.75, 1.0}) {
                const double z = boundary_distance(kernel, h);
                EXPECT_NEAR(density_of_first_layer(kernel, h, f, z), 1.0, 0.015) << kernel << " " << h << " " << f;
                EXPECT_GT(density_of_first_layer(kernel, h, f, z - 0.1), 1.015) << kernel << " " << h << " " << f;
            }
        }
    }
}

} // namespace
} // namespace meltpoint
