#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "reference/cells.h"
#include "reference/state.h"

namespace meltpoint::reference {

/// A sum of vectors and the sum of their lengths. Where the vectors cancel, the second is what a rounding error is
/// small against.
struct VectorSum {
    glm::dvec3 value{0.0};
    double magnitude = 0.0;

    void add(const glm::dvec3& term)
    {
        value += term;
        magnitude += glm::length(term);
    }
    void add(const VectorSum& other)
    {
        value += other.value;
        magnitude += other.magnitude;
    }
};

/// Twins of sim/forces.comp, one function a term: acceleration of particle i in m/s^2. They read density, pressure and
/// velocity from the state; velocity is that of the half step. Sums over j include the images behind walls. Pairs
/// nearer than COINCIDENT_RATIO support radii have no gradient. Particle i is fluid; the volume of a boundary particle
/// j is s_j d^3.

/// Of fluid i against j, Pa s: the harmonic mean of two fluids (Cleary & Monaghan 1999), a boundary particle's
/// friction.
[[nodiscard]] double viscosity_against(const Settings& settings, const State& state, std::size_t i, std::size_t j);

/// -(1/m_i) sum_j (p_i V_i^2 s_j + p_j V_j^2 s_i) grad W_ij with V = m/rho and the weights s; boundary particles have
/// no pressure.
[[nodiscard]] VectorSum pressure_acceleration(const Settings& settings, const State& state, const Neighbors& neighbors,
                                              std::size_t i);

/// (V_i/m_i) sum_j mu_j V_j (v_j - v_i) L_ij (Müller et al. 2003, equation 14, made to conserve momentum); of two
/// fluids mu is the harmonic mean of their viscosities (Cleary & Monaghan 1999), against a boundary particle its
/// friction.
[[nodiscard]] VectorSum viscosity_acceleration(const Settings& settings, const State& state, const Neighbors& neighbors,
                                               std::size_t i);

/// The color field c = sum_j V_j W_ij, 1 inside the fluid and 0 outside.
struct ColorField {
    VectorSum gradient;               ///< n, 1/m: points into the fluid
    double laplacian = 0.0;           ///< 1/m^2
    double laplacian_magnitude = 0.0; ///< sum of the absolute values of its terms
};
[[nodiscard]] ColorField color_field(const Settings& settings, const State& state, const Neighbors& neighbors,
                                     std::size_t i);

/// The paper's tension, -(sigma/rho_i) lap c n/|n| where |n| H exceeds the threshold, else 0 (Müller et al. 2003,
/// equation 19).
[[nodiscard]] VectorSum tension_acceleration(const Settings& settings, const State& state, const Neighbors& neighbors,
                                             std::size_t i);

/// Friction of the walls: half spaces of fluid at rest, or of the lid's velocity, with viscosity params.wall_viscosity.
/// Without it walls let fluid slip.
[[nodiscard]] VectorSum wall_viscosity_acceleration(const Settings& settings, const State& state, std::size_t i);

/// The damped spring that holds a particle nearer to a wall than params.contact_distance. It never pulls.
[[nodiscard]] VectorSum contact_acceleration(const Settings& settings, const State& state, std::size_t i);

/// Every term of every particle; all are zero for boundary particles.
struct Accelerations {
    std::vector<VectorSum> pressure;
    std::vector<VectorSum> viscosity;
    std::vector<VectorSum> tension;
    std::vector<VectorSum> wall_viscosity;
    std::vector<VectorSum> contact;
    std::vector<VectorSum> total;       ///< all of the above and gravity
    std::uint32_t coincident_pairs = 0; ///< ordered pairs that had no gradient
};
[[nodiscard]] Accelerations accelerations(const Settings& settings, const State& state, const Neighbors& neighbors);

} // namespace meltpoint::reference
