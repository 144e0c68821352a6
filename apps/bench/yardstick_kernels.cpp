#include "yardstick_kernels.h"

#include <cstddef>

namespace meltpoint::bench::kernels {

extern const char* const required_features[] = {
#ifdef __AVX512F__
    "avx512f",
#endif
#ifdef __AVX512VL__
    "avx512vl",
#endif
#ifdef __AVX512BW__
    "avx512bw",
#endif
#ifdef __AVX512DQ__
    "avx512dq",
#endif
#ifdef __AVX2__
    "avx2",
#endif
#ifdef __FMA__
    "fma",
#endif
#ifdef __BMI2__
    "bmi2",
#endif
#ifdef __SSE4_2__
    "sse4.2",
#endif
    nullptr,
};

namespace {

constexpr float tiny = 1e-30f;

// The loops over candidates count in std::size_t: of a 32-bit index, which may wrap, g++ does not see that its
// addresses follow each other, and vectorizes with every element loaded on its own, at two thirds of the speed.

template <bool wendland>
inline float density_shape(float r2, float inverse_h)
{
    if constexpr (wendland) {
        const float q = __builtin_fminf(__builtin_sqrtf(r2) * inverse_h, 1.0f);
        const float u = 1.0f - q;
        return u * u * u * u * (1.0f + 4.0f * q);
    }
    const float u = __builtin_fmaxf(1.0f - r2 * inverse_h * inverse_h, 0.0f);
    return u * u * u;
}

template <bool wendland>
void density_loop(const Fluid& fluid, const Grid& grid, const Arrays& arrays, const std::uint8_t* is_ghost,
                  std::uint32_t begin, std::uint32_t end)
{
    const float inverse_h = 1.0f / fluid.support_radius;
    const float* const x = arrays.x;
    const float* const y = arrays.y;
    const float* const z = arrays.z;
    for (std::uint32_t i = begin; i < end; ++i) {
        if (is_ghost[i] != 0) {
            continue;
        }
        const float xi = x[i];
        const float yi = y[i];
        const float zi = z[i];
        float sum = 0.0f;
        for (int row = 0; row < 9; ++row) {
            const std::uint32_t cell = grid.cell[i] + static_cast<std::uint32_t>(row / 3) * grid.layer - grid.layer +
                                       static_cast<std::uint32_t>(row % 3) * grid.row - grid.row;
            const std::size_t first = grid.cell_start[cell - 2];
            const std::size_t last = grid.cell_start[cell + 3];
#pragma omp simd reduction(+ : sum)
            for (std::size_t j = first; j < last; ++j) {
                const float dx = xi - x[j];
                const float dy = yi - y[j];
                const float dz = zi - z[j];
                sum += density_shape<wendland>(dx * dx + dy * dy + dz * dz, inverse_h);
            }
        }
        arrays.density[i] = arrays.mass[i] * fluid.density_scale * sum;
    }
}

template <bool wendland>
void force_loop(const Fluid& fluid, const Grid& grid, const Arrays& arrays, const std::uint8_t* is_ghost,
                std::uint32_t begin, std::uint32_t end)
{
    const float inverse_h = 1.0f / fluid.support_radius;
    const float* const x = arrays.x;
    const float* const y = arrays.y;
    const float* const z = arrays.z;
    const float* const vx = arrays.vx;
    const float* const vy = arrays.vy;
    const float* const vz = arrays.vz;
    const float* const pressure_term = arrays.pressure_term;
    const float* const volume = arrays.volume;
    for (std::uint32_t i = begin; i < end; ++i) {
        if (is_ghost[i] != 0) {
            continue;
        }
        const float xi = x[i];
        const float yi = y[i];
        const float zi = z[i];
        const float vxi = vx[i];
        const float vyi = vy[i];
        const float vzi = vz[i];
        const float pressure_i = pressure_term[i];
        const float viscous_i = fluid.viscous_scale * volume[i];
        float fx = 0.0f;
        float fy = 0.0f;
        float fz = 0.0f;
        for (int row = 0; row < 9; ++row) {
            const std::uint32_t cell = grid.cell[i] + static_cast<std::uint32_t>(row / 3) * grid.layer - grid.layer +
                                       static_cast<std::uint32_t>(row % 3) * grid.row - grid.row;
            const std::size_t first = grid.cell_start[cell - 2];
            const std::size_t last = grid.cell_start[cell + 3];
#pragma omp simd reduction(+ : fx, fy, fz)
            for (std::size_t j = first; j < last; ++j) {
                const float dx = xi - x[j];
                const float dy = yi - y[j];
                const float dz = zi - z[j];
                const float r2 = dx * dx + dy * dy + dz * dz + tiny;
                float u = 0.0f;
                float along = 0.0f; // of the unscaled gradient, over r
                if constexpr (wendland) {
                    u = __builtin_fmaxf(1.0f - __builtin_sqrtf(r2) * inverse_h, 0.0f);
                    u = u * u * u;
                    along = u * inverse_h;
                } else {
                    const float inverse_r = 1.0f / __builtin_sqrtf(r2);
                    u = __builtin_fmaxf(1.0f - r2 * inverse_r * inverse_h, 0.0f);
                    along = u * u * inverse_r;
                }
                const float pressure = (pressure_i + pressure_term[j]) * along;
                const float viscous = viscous_i * volume[j] * u;
                fx += pressure * dx + viscous * (vx[j] - vxi);
                fy += pressure * dy + viscous * (vy[j] - vyi);
                fz += pressure * dz + viscous * (vz[j] - vzi);
            }
        }
        const float inverse_mass = 1.0f / arrays.mass[i];
        arrays.ax[i] = fx * inverse_mass;
        arrays.ay[i] = fy * inverse_mass;
        arrays.az[i] = fz * inverse_mass;
    }
}

} // namespace

void density(const Fluid& fluid, const Grid& grid, const Arrays& arrays, const std::uint8_t* is_ghost,
             std::uint32_t begin, std::uint32_t end)
{
    (fluid.wendland ? density_loop<true> : density_loop<false>)(fluid, grid, arrays, is_ghost, begin, end);
}

void forces(const Fluid& fluid, const Grid& grid, const Arrays& arrays, const std::uint8_t* is_ghost,
            std::uint32_t begin, std::uint32_t end)
{
    (fluid.wendland ? force_loop<true> : force_loop<false>)(fluid, grid, arrays, is_ghost, begin, end);
}

} // namespace meltpoint::bench::kernels
