// Heat: every particle carries its specific enthalpy H in J/kg, 0 of solid at the melting point. Temperature follows from it: it
// stays at the melting point until all latent heat L is there, so none can be lost,
//     H < 0: T = Tm + H / c_solid,    0 <= H <= L: T = Tm,    H > L: T = Tm + (H - L) / c_fluid.
// H is kept by particle id as a two-float (shared/two_float.h): the sun adds less in a step than the ulp of L.
//
// Heat flows between neighbors (Cleary & Monaghan, "Conduction Modelling Using Smoothed Particle Hydrodynamics", J. Comput. Phys.
// 148, 1999, equation 28), with volumes V = m / rho0 at rest, rho0 of solids their own:
//     rho0_i dH_i/dt = sum_j V_j 4 k_i k_j / (k_i + k_j) (T_j - T_i) (-W'(r) / r).
// What i gets, j gives. W is the kernel that pressure uses. The moment of this sum is that of its gradient: its scale makes the
// second derivative of a quadratic temperature on a lattice exact.
//
// Fluids and solids have heat, and colliders whose material conducts: these hold their temperature, whatever flows. Dust and the
// dead have none. Walls of the domain are mirrors and insulate, as free surfaces do. Colliders hold their temperature at the
// centers of their outermost particles where they conduct as their neighbors do; where they conduct much better, at their
// surface, half a spacing farther out.
#ifndef MELTPOINT_SHARED_HEAT_H
#define MELTPOINT_SHARED_HEAT_H
#include "prelude.h"
#include "sph_params.h"

SHARED_BEGIN

// Pairs nearer than this conduct as at this distance, in spacings: one that had almost met would otherwise need an ever
// shorter step. Nothing of a lattice is so near.
SHARED_CONSTANT float NEAREST_CONDUCTION = 0.5f;

struct HeatMaterial {
    float solid_conductivity;  // W/(m K)
    float fluid_conductivity;
    float solid_specific_heat; // J/(kg K)
    float fluid_specific_heat;
    float latent_heat;         // L, J/kg
    float melting_point;       // Tm, degrees C
};

struct HeatParams {
    HeatMaterial of[MAX_MATERIALS];
};

// What conduction.comp reads of a particle, a vec4: x = T in degrees C, y = k in W/(m K), 0 where there is no heat, z = V in m^3,
// w = 1 / rho0 in m^3/kg, 0 where the enthalpy stays. Solids may have another rho0 than their fluid (shared/volume_relaxation.h).

// Between those who are at the same temperature nothing flows. Most of a melting solid is at its melting point, so that is the
// common temperature, and nobody looks for heat where no cell within reach holds another one. 32-bit words of a row of cells, with
// a bit for each cell:
SHARED_FUNCTION uint warm_words(uint cells) { return (cells + 31u) / 32u; }

// From 0, solid, to 1, fluid. enthalpy: J/kg.
SHARED_FUNCTION float melted_fraction(HeatMaterial material, float enthalpy)
{
    if (enthalpy <= 0.0f) {
        return 0.0f;
    }
    return enthalpy < material.latent_heat ? enthalpy / material.latent_heat : 1.0f;
}

// degrees C, of an enthalpy as a two-float.
SHARED_FUNCTION float temperature(HeatMaterial material, vec2 enthalpy)
{
    if (enthalpy.x < 0.0f) {
        return material.melting_point + enthalpy.x / material.solid_specific_heat;
    }
    float beyond = (enthalpy.x - material.latent_heat) + enthalpy.y;
    return material.melting_point + (beyond > 0.0f ? beyond / material.fluid_specific_heat : 0.0f);
}

// The other way around, J/kg: at the melting point that of the solid.
SHARED_FUNCTION float enthalpy_at(HeatMaterial material, float temperature)
{
    float above = temperature - material.melting_point;
    return above > 0.0f ? material.latent_heat + material.fluid_specific_heat * above : material.solid_specific_heat * above;
}

// W/(m K): on the plateau that of a mixture.
SHARED_FUNCTION float conductivity(HeatMaterial material, float enthalpy)
{
    float melted = melted_fraction(material, enthalpy);
    return (1.0f - melted) * material.solid_conductivity + melted * material.fluid_conductivity;
}

// J/(kg K); 0 while it melts, where nothing gets warmer.
SHARED_FUNCTION float specific_heat(HeatMaterial material, float enthalpy)
{
    if (enthalpy < 0.0f) {
        return material.solid_specific_heat;
    }
    return enthalpy > material.latent_heat ? material.fluid_specific_heat : 0.0f;
}

// 4 k_i k_j / (k_i + k_j), so that flux is continuous where conductivity is not; 0 against what does not conduct.
SHARED_FUNCTION float pair_conductivity(float k_i, float k_j)
{
    return k_i * k_j > 0.0f ? 4.0f * k_i / (k_i + k_j) * k_j : 0.0f;
}

SHARED_END
#endif
