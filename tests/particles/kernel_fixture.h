#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include <gtest/gtest.h>

#include "particles/sph_kernel.h"

namespace meltpoint {

/// Simpson's rule on 2 n intervals.
inline double integrate(double from, double to, const std::function<double(double)>& f, int n = 500)
{
    const double h = (to - from) / (2 * n);
    double sum = f(from) + f(to);
    for (int i = 1; i < 2 * n; ++i) {
        sum += (i % 2 == 1 ? 4.0 : 2.0) * f(from + i * h);
    }
    return sum * h / 3.0;
}

/// The kernels of the continuum, at a support radius of 0.05 m.
class KernelTest : public testing::TestWithParam<std::uint32_t> {
protected:
    explicit KernelTest(std::uint32_t dimensions) : dimensions_(dimensions) {}

    [[nodiscard]] std::uint32_t kernel() const { return GetParam(); }
    [[nodiscard]] double density(double r) const { return scale.density * density_shape(kernel(), r / h); }
    [[nodiscard]] double gradient(double r) const { return -scale.gradient * gradient_shape(kernel(), r / h); }
    [[nodiscard]] double viscosity(double r) const { return scale.viscosity * viscosity_shape(kernel(), r / h); }
    [[nodiscard]] double color_gradient(double r) const
    {
        return -scale.color_gradient * color_gradient_shape(kernel(), r / h);
    }
    [[nodiscard]] double color_laplacian(double r) const
    {
        return -scale.color_laplacian * color_laplacian_shape(kernel(), r / h, dimensions_);
    }

private:
    std::uint32_t dimensions_;

protected:
    const double h = 0.05;
    const KernelScales scale = continuum_scales(GetParam(), h, dimensions_);
};

inline const auto both_kernels = testing::Values(shared::KERNEL_PAPER, shared::KERNEL_WENDLAND);
inline std::string kernel_name(const testing::TestParamInfo<std::uint32_t>& test)
{
    return test.param == shared::KERNEL_PAPER ? "Paper" : "Wendland";
}

} // namespace meltpoint
