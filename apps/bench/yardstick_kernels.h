#pragma once

#include <cstdint>

/// The yardstick's inner loops. This header and its source file use nothing but plain C++, and no inline function of
/// any library: they are compiled for the very processor they run on and with -ffast-math, and an inline function
/// compiled so could end up in the rest of the program.
namespace meltpoint::bench::kernels {

/// Structure of arrays, in sorted order: particles and the ghosts that mirror them behind the walls.
struct Arrays {
    float* x;
    float* y;
    float* z;
    float* vx;
    float* vy;
    float* vz;
    float* ax;
    float* ay;
    float* az;
    float* mass;
    float* density;
    float* pressure_term; ///< p V^2 gradient_scale
    float* volume;
};

/// Cells half a support radius long in x, one in y and z; one row of cells is one range of slots.
struct Grid {
    const std::uint32_t* cell_start;
    const std::uint32_t* cell; ///< of each slot; the cells at the grid's border hold nothing but ghosts
    std::uint32_t row;         ///< cells in a row: from one to the next in y
    std::uint32_t layer;       ///< cells in a layer: from one to the next in z
};

struct Fluid {
    float support_radius;
    float density_scale;
    float viscous_scale; ///< viscosity mu times viscosity_scale
    bool wendland;       ///< else the paper's kernels
};

/// What the kernels were compiled for, as far as a program could run into it: names for __builtin_cpu_supports, null
/// last.
extern const char* const required_features[];

/// density[i] = m_i density_scale sum_j W_ij for the slots begin .. end - 1 whose `is_ghost` is 0.
void density(const Fluid& fluid, const Grid& grid, const Arrays& arrays, const std::uint8_t* is_ghost,
             std::uint32_t begin, std::uint32_t end);

/// (ax, ay, az) = pressure and viscous force on i over its mass, likewise.
void forces(const Fluid& fluid, const Grid& grid, const Arrays& arrays, const std::uint8_t* is_ghost,
            std::uint32_t begin, std::uint32_t end);

} // namespace meltpoint::bench::kernels
