#include "particles/sph_kernel.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/random.h"
#include "particles/kernel_fixture.h"

namespace meltpoint {
namespace {

constexpr double PI = std::numbers::pi;

class SphKernel : public KernelTest {
protected:
    SphKernel() : KernelTest(3) {}
};

INSTANTIATE_TEST_SUITE_P(Kernels, SphKernel, both_kernels, kernel_name);

TEST_P(SphKernel, EveryKernelHasUnitMoment)
{
    const auto over_ball = [&](const std::function<double(double)>& f) {
        return integrate(0.0, h, [&](double r) { return 4.0 * PI * r * r * f(r); });
    };
    EXPECT_NEAR(over_ball([&](double r) { return density(r); }), 1.0, 1e-9);
    // Integrals of x dW/dx and x^2 L / 2; averaged over directions x^2 is r^2 / 3.
    EXPECT_NEAR(over_ball([&](double r) { return -r / 3.0 * gradient(r); }), 1.0, 1e-9);
    EXPECT_NEAR(over_ball([&](double r) { return r * r / 6.0 * viscosity(r); }), 1.0, 1e-9);
    EXPECT_NEAR(over_ball([&](double r) { return -r / 3.0 * color_gradient(r); }), 1.0, 1e-9);
    EXPECT_NEAR(over_ball([&](double r) { return r * r / 6.0 * color_laplacian(r); }), 1.0, 1e-9);
    EXPECT_NEAR(over_ball([&](double r) { return color_laplacian(r); }) * h * h, 0.0, 1e-7);
}

TEST_P(SphKernel, DerivativesMatchCentralDifferences)
{
    const double e = 1e-5 * h;
    for (double q = 0.05; q < 0.99; q += 0.0437) {
        const double r = q * h;
        const auto derivative = [&](const std::function<double(double)>& f) {
            return (f(r + e) - f(r - e)) / (2.0 * e);
        };
        EXPECT_NEAR(color_gradient(r), derivative([&](double s) { return density(s); }), 1e-8 * scale.color_gradient);
        EXPECT_NEAR(color_laplacian(r), derivative([&](double s) { return s * s * color_gradient(s); }) / (r * r),
                    1e-6 * scale.color_laplacian);
        if (kernel() == shared::KERNEL_PAPER) {
            const auto spiky = [&](double s) {
                return 15.0 / (PI * std::pow(h, 6)) * std::pow(h - s, 3);
            };
            EXPECT_NEAR(gradient(r), derivative(spiky), 1e-8 * scale.gradient);
        } else {
            EXPECT_NEAR(gradient(r), derivative([&](double s) { return density(s); }), 1e-8 * scale.gradient);
            EXPECT_NEAR(viscosity(r), -2.0 * gradient(r) / r, 1e-12 * scale.viscosity);
        }
    }
}

TEST_P(SphKernel, VanishesAtAndBeyondTheSupportRadius)
{
    for (const double q : {1.0, 1.0 + 1e-12, 1.5, 100.0}) {
        EXPECT_EQ(density_shape(kernel(), q), 0.0);
        EXPECT_EQ(gradient_shape(kernel(), q), 0.0);
        EXPECT_EQ(viscosity_shape(kernel(), q), 0.0);
        EXPECT_EQ(color_gradient_shape(kernel(), q), 0.0);
        EXPECT_EQ(color_laplacian_shape(kernel(), q), 0.0);
    }
}

TEST_P(SphKernel, GradientSumsToZeroOverASymmetricNeighborhood)
{
    glm::dvec3 sum(0.0);
    double length = 0.0;
    const double spacing = h / 2.6;
    for (int x = -3; x <= 3; ++x) {
        for (int y = -3; y <= 3; ++y) {
            for (int z = -3; z <= 3; ++z) {
                const glm::dvec3 offset = spacing * glm::dvec3(x, y, z);
                const double r = glm::length(offset);
                if (r > 0.0) {
                    sum += gradient(r) / r * offset;
                    length += std::abs(gradient(r));
                }
            }
        }
    }
    EXPECT_GT(length, 0.0);
    EXPECT_LT(glm::length(sum), 1e-14 * length);
}

// --- lattice moments -----------------------------------------------------------------------------

TEST_P(SphKernel, LatticeMomentsTendToOne)
{
    const LatticeMoments fine = lattice_moments(kernel(), h, h / 8.0);
    for (const double moment :
         {fine.density, fine.gradient, fine.viscosity, fine.color_gradient, fine.color_laplacian}) {
        EXPECT_NEAR(moment, 1.0, 3e-3);
    }
}

TEST(LatticeMoments, KnownValues)
{
    // Sums by hand: a lattice of H = 1.5 d has neighbors at d (6) and sqrt(2) d (12) only.
    const double first = 1.0 / 1.5;
    const double second = std::sqrt(2.0) / 1.5;
    const LatticeMoments paper = lattice_moments(shared::KERNEL_PAPER, 1.5, 1.0);
    const double w0 = 315.0 / (64.0 * PI * std::pow(1.5, 3));
    const auto poly6 = [](double q) {
        return std::pow(1.0 - q * q, 3);
    };
    EXPECT_NEAR(paper.density, w0 * (1.0 + 6.0 * poly6(first) + 12.0 * poly6(second)), 1e-12);
    const double g0 = 45.0 / (PI * std::pow(1.5, 4));
    EXPECT_NEAR(paper.gradient,
                g0 * (2.0 * std::pow(1.0 - first, 2) + 8.0 / std::sqrt(2.0) * std::pow(1.0 - second, 2)), 1e-12);

    EXPECT_NEAR(lattice_moments(shared::KERNEL_PAPER, 2.3, 1.0).viscosity, 0.93, 5e-3);
    EXPECT_NEAR(lattice_moments(shared::KERNEL_PAPER, 2.6, 1.0).viscosity, 1.07, 5e-3);
    EXPECT_NEAR(lattice_moments(shared::KERNEL_PAPER, 3.0, 1.0).viscosity, 0.96, 5e-3);
    EXPECT_NEAR(lattice_moments(shared::KERNEL_PAPER, 2.0, 1.0).gradient, 0.96, 5e-3);
    EXPECT_NEAR(lattice_moments(shared::KERNEL_WENDLAND, 2.6, 1.0).density, 1.010, 5e-4);
}

TEST(LatticeMoments, RefusesSupportRatiosThatHaveNoMeaning)
{
    EXPECT_THROW(static_cast<void>(lattice_moments(shared::KERNEL_PAPER, 1.0, 1.0)), Error);
    EXPECT_THROW(static_cast<void>(lattice_moments(shared::KERNEL_PAPER, 8.1, 1.0)), Error);
    EXPECT_THROW(static_cast<void>(lattice_moments(shared::KERNEL_PAPER, 1.0, 0.0)), Error);
    EXPECT_THROW(static_cast<void>(lattice_moments(shared::KERNEL_PAPER, 1.0, -0.5)), Error);
    EXPECT_THROW(static_cast<void>(lattice_moments(shared::KERNEL_PAPER, std::nan(""), 1.0)), Error);
}

// --- conduction ----------------------------------------------------------------------------------

// d^n sum_j L_j f(x_j) over the neighbors on a lattice of spacing 1, L = -2 W'/r divided by the gradient's moment.
double conduction_sum(std::uint32_t kernel, double ratio, int dimensions,
                      const std::function<double(const glm::dvec3&)>& f)
{
    const auto n = static_cast<std::uint32_t>(dimensions);
    const double scale = continuum_scales(kernel, ratio, n).gradient / lattice_moments(kernel, ratio, 1.0, n).gradient;
    double sum = 0.0;
    for (int x = -4; x <= 4; ++x) {
        for (int y = -4; y <= 4; ++y) {
            for (int z = dimensions == 3 ? -4 : 0; z <= (dimensions == 3 ? 4 : 0); ++z) {
                const glm::dvec3 place(x, y, z);
                const double r = glm::length(place);
                sum += r > 0.0 ? 2.0 * scale * gradient_shape(kernel, r / ratio) / r * f(place) : 0.0;
            }
        }
    }
    return sum;
}

TEST_P(SphKernel, ConductionTakesTheSecondDerivativeOfAQuadratic)
{
    for (const double ratio : {1.5, 2.0, 2.6, 3.0, 4.0}) {
        for (const int dimensions : {2, 3}) {
            const auto laplacian = [&](const std::function<double(const glm::dvec3&)>& f) {
                return conduction_sum(kernel(), ratio, dimensions, f);
            };
            EXPECT_NEAR(laplacian([](const glm::dvec3& x) { return x.x * x.x; }), 2.0, 1e-12);
            EXPECT_NEAR(laplacian([](const glm::dvec3& x) { return 3.0 * x.x * x.x - 2.0 * x.y * x.y; }), 2.0, 1e-12);
            EXPECT_NEAR(laplacian([](const glm::dvec3& x) { return 7.0 * x.x + x.x * x.y; }), 0.0, 1e-12);
        }
    }
}

TEST_P(SphKernel, NoWaveOfALatticeDecaysFasterThanTheEigenvalueSays)
{
    Random random(2);
    for (const double ratio : {1.2, 2.0, 2.6, 3.0, 4.0}) {
        for (const int dimensions : {2, 3}) {
            const double largest =
                largest_conduction_eigenvalue(kernel(), ratio, 1.0, static_cast<std::uint32_t>(dimensions));
            double fastest = 0.0;
            for (int i = 0; i < 2000; ++i) {
                const glm::dvec3 k = PI * glm::dvec3(random.uniform(), random.uniform(), random.uniform());
                const double rate = conduction_sum(kernel(), ratio, dimensions,
                                                   [&](const glm::dvec3& x) { return 1.0 - std::cos(glm::dot(k, x)); });
                fastest = std::max(fastest, rate);
            }
            EXPECT_LE(fastest, 1.001 * largest) << "H = " << ratio << " d, " << dimensions << " dimensions";
            EXPECT_GE(fastest, 0.9 * largest);
        }
    }
    // Of the nearest neighbors alone it is 4 an axis, at the shortest wave.
    EXPECT_NEAR(largest_conduction_eigenvalue(kernel(), 1.2, 1.0, 3), 12.0, 2e-3);
    EXPECT_NEAR(largest_conduction_eigenvalue(kernel(), 1.2, 1.0, 2), 8.0, 2e-3);
    EXPECT_NEAR(largest_conduction_eigenvalue(kernel(), 0.24, 0.2, 3) * 0.04, 12.0, 2e-3); // 1/m^2
}

// --- walls ---------------------------------------------------------------------------------------

// Integral of f(r) over the half space beyond a plane at that distance.
double half_space_integral(double distance, double h, const std::function<double(double)>& f)
{
    const auto plane = [&](double z) {
        return integrate(
            std::abs(z), h, [&](double r) { return 2.0 * PI * r * f(r); }, 100);
    };
    return distance < 0.0 ? integrate(distance, 0.0, plane) + integrate(0.0, h, plane) : integrate(distance, h, plane);
}

TEST_P(SphKernel, WallViscosityMatchesQuadrature)
{
    for (const double q : {-0.93, -0.5, -0.1, 0.0, 0.05, 0.25, 0.5, 0.77, 0.95}) {
        const double expected = half_space_integral(q * h, h, [&](double r) { return viscosity(r); });
        EXPECT_NEAR(wall_viscosity_integral(kernel(), q * h, h) * h * h, expected * h * h, 1e-6) << "q = " << q;
    }
    EXPECT_EQ(wall_viscosity_integral(kernel(), h, h), 0.0);
    EXPECT_EQ(wall_viscosity_integral(kernel(), 2.0 * h, h), 0.0);
}

TEST_P(SphKernel, SetKernelScalesFillsTheParameters)
{
    shared::SphParams params{};
    params.support_radius = 0.05f;
    params.speed_of_sound = 20.0f;
    const double d = 0.025;
    set_kernel_scales(params, kernel(), d);
    const LatticeMoments moments = lattice_moments(kernel(), h, d);
    const double e = 1e-6;
    EXPECT_NEAR(params.density_scale * moments.density / scale.density, 1.0, e);
    EXPECT_NEAR(params.gradient_scale * moments.gradient / scale.gradient, 1.0, e);
    EXPECT_NEAR(params.viscosity_scale * moments.viscosity / scale.viscosity, 1.0, e);
    EXPECT_NEAR(params.color_gradient_scale * moments.color_gradient / scale.color_gradient, 1.0, e);
    EXPECT_NEAR(params.color_laplacian_scale * moments.color_laplacian / scale.color_laplacian, 1.0, e);
    EXPECT_NEAR(params.contact_distance, 0.25 * d, e * d);
    EXPECT_NEAR(params.contact_stiffness / 640000.0f, 1.0, e);
    EXPECT_NEAR(params.contact_damping / 800.0f, 1.0, e);
}

} // namespace
} // namespace meltpoint
