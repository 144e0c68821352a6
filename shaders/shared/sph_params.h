// Everything a simulation pass needs besides the particles themselves: one struct in one device buffer, written by the
// host before the first step (dt and speed_limit also by time_step.comp). SI units.
//
// Number density form (Solenthaler & Pajarola 2008): rho_i = m_i sum_j W_ij, so that fluids of different rest density may
// touch. With equal masses it is the usual rho_i = sum_j m_j W_ij. The sums include i itself.
//
// Colliders are boundary particles (Akinci et al. 2012): each counts in the sum with its weight s_b = V_b / d^3, where
// V_b = 1 / sum_k W_bk over boundary particles is its share of the space that their layer takes; a fluid particle's weight
// is 1, a solid's that of shared/volume_relaxation.h. The energy sum_i m_i e(rho_i) is that of the fluid alone, so the pressure force, its exact derivative, is
// -(p_i V_i^2 s_j + p_j V_j^2 s_i) grad W_ij with p_b = 0.
//
// Two dimensions: all particles lie in one plane, z = 0, which no force leaves by itself. Volumes are areas, masses are
// kg per meter of depth, and the kernel scales are those of the plane; units below are those of three dimensions.
//
// Lattice moments: sums over a lattice of the scene's spacing miss the continuum integrals by some percent, so every kernel
// scale below is already divided by its moment on that lattice (README, "Moments").
//
// Walls are mirrors: a particle nearer to walls than the support radius also meets the images of its neighbors and of itself
// behind them, reflected across one, two or three walls, with their density, pressure and reflected velocity. So a wall
// supplies density and pressure, conserves energy and lets fluid slip; a lattice half a spacing off a wall does not notice it.
// Along a periodic axis the images are the particles near the other border, a domain's length away and as they are.
#ifndef MELTPOINT_SHARED_SPH_PARAMS_H
#define MELTPOINT_SHARED_SPH_PARAMS_H
#include "prelude.h"

SHARED_BEGIN

SHARED_CONSTANT uint KERNEL_PAPER = 0u;    // poly6 density, spiky pressure, viscosity Laplacian (Mueller et al. 2003)
SHARED_CONSTANT uint KERNEL_WENDLAND = 1u; // Wendland C2 for all three

SHARED_CONSTANT uint STATE_EQUATION_LINEAR = 0u; // p = c0^2 (rho - rho0) + p_background
SHARED_CONSTANT uint STATE_EQUATION_TAIT = 1u;   // p = (c0^2 rho0 / gamma) ((rho/rho0)^gamma - 1) + p_background

SHARED_CONSTANT uint SOLVER_WCSPH = 0u; // pressure from density by a state equation (Mueller et al. 2003; Monaghan 1994)
SHARED_CONSTANT uint SOLVER_DFSPH = 1u; // pressure that keeps density and divergence (Bender & Koschier 2015)
SHARED_CONSTANT uint SOLVER_PBF = 2u;   // positions moved until they keep the density (Macklin & Mueller 2013)

SHARED_CONSTANT uint MAX_MATERIALS = 64u;

// Pairs closer than this fraction of the support radius have no direction: zero gradient, counted in NeighborCount.
SHARED_CONSTANT float COINCIDENT_RATIO = 1e-6f;

// Particle shifting: how much stronger near particles part, and the farthest that a step shifts one, in spacings.
SHARED_CONSTANT float SHIFT_NEAR = 0.2f;
SHARED_CONSTANT float SHIFT_CAP = 0.1f;

// A vorticity that rises by less than this part of itself in a support radius has no direction to confine it in.
SHARED_CONSTANT float FLAT_VORTICITY = 1e-3f;

// Grid cells are half a support radius long in x and one support radius in y and z. A particle's neighbors lie in the 9 rows
// (y, z offsets -1, 0, 1) of cells x-2 .. x+2: each row is one contiguous range of the sorted particles.
//
// Still particles, boundary particles that stay where they are, lie behind the moving ones, sorted likewise but once. So there
// are two tables of cell starts, one behind the other: cell c begins at cell_start[c] among the moving particles and at
// cell_start[cells + c] among the still ones.
SHARED_CONSTANT uint CELLS_PER_SUPPORT_X = 2u;

// What the forces need of a particle's density and pressure is computed once, with them: `interaction`, a vec4 a particle of
// x = p V^2 gradient_scale, y = V = m / rho (m^3), z = mu V viscosity_scale. Of a boundary particle x = 0, y = V_b, and mu is
// the friction. Where pressure is solved for, x holds dt p instead of p while a solve runs, and w the solve's diagonal; where
// positions are, x holds dt^2 p of the present iteration, and w the same of the artificial pressure (shared/pbf.h).

struct SphParams {
    vec3 domain_min;      // m
    float support_radius; // H, m: kernels vanish at r >= H
    vec3 domain_max;      // m
    float dt;             // s; where adaptive_dt, of the present step
    vec3 gravity;         // m/s^2
    uint moving_count;    // particles of a step's passes: the first of the sorted order
    uvec3 grid_size;      // cells along x, y, z; cell index = (z * grid_size.y + y) * grid_size.x + x
    uint pool_count;      // all particles: those from moving_count on are still
    uint wall_mask;       // bit 2a: wall at domain_min[a], bit 2a + 1: wall at domain_max[a]

    uint periodic_mask;   // bits as those of wall_mask: both borders of each periodic axis
    vec3 lid_velocity;    // m/s, of the wall at domain_max.y

    uint state_equation;       // STATE_EQUATION_*
    uint clamp_pressure;       // 1: p = max(p, 0)
    float speed_of_sound;      // c0, m/s
    float gamma;               // Tait exponent
    float background_pressure; // Pa
    float wall_viscosity;      // dynamic, of fluid against walls, Pa s; 0 is free slip
    float surface_tension;     // sigma of the paper's tension, N/m
    float tension_threshold;   // on |n| H, dimensionless: below it a particle is interior and feels no tension

    // Kernel scales, divided by their lattice moments. q = r/H.
    float density_scale;         // paper: W = scale (1-q^2)^3         wendland: W = scale (1-q)^4 (1+4q)      [1/m^3]
    float gradient_scale;        // paper: W' = -scale (1-q)^2         wendland: W' = -scale q (1-q)^3         [1/m^4]
    float viscosity_scale;       // paper: lap = scale (1-q)           wendland: lap = scale (1-q)^3           [1/m^5]
    float pair_viscosity_scale;  // of the viscous forces of pairs, solved for: scale u (1 + taper u), u = 1-q [1/m^5]
    float pair_viscosity_taper;
    float color_gradient_scale;  // paper: W' = -scale q (1-q^2)^2     wendland: as gradient_scale             [1/m^4]
    float color_laplacian_scale; // paper: lap = -scale (1-q^2)(3-7q^2)   wendland: lap = -scale (1-q)^2 (1-2q) [1/m^5]

    // A lone particle never reaches rest density at a plane, so pressure alone cannot hold it: a damped spring acts nearer
    // than contact_distance, where fluid in bulk never settles.
    float contact_distance;  // m
    float contact_stiffness; // 1/s^2
    float contact_damping;   // 1/s

    // Where pressure is solved for: the mean relative error at which a solve ends, and the iterations that it has at most.
    float density_error;
    float divergence_error; // a time step
    uint max_iterations;
    float solve_relaxation; // of a Jacobi iteration: neighbors correct the same error, and together would overshoot
    float correction_time;  // s, in which the density solve takes away what the density has already; 0: in each step

    // Where viscosity is solved for (shared/viscosity_solve.h): the error at which a solve ends, and its most iterations.
    float viscosity_error;
    uint viscosity_iterations;

    // Where positions are solved for (shared/pbf.h).
    uint least_iterations;           // of a solve
    float constraint_softness;       // added to sum_j m_i |g_ij / gradient_scale|^2, the response of a constraint
    float artificial_pressure;       // as if a pair's density were wrong by this, relative
    float artificial_pressure_scale; // 1 / W(ARTIFICIAL_PRESSURE_DISTANCE), W without density_scale
    float speed_cap;                 // m, the farthest that a particle may move in a step

    // Of any solver, 0 for none.
    float xsph;                  // part of the difference to the velocities around that a step takes away
    float vorticity_confinement; // epsilon, m/s
    float shifting;              // D of shift.comp, m^2/s
    float shifting_scale;        // 1 / W(d), W without density_scale

    // Where the device chooses dt (time_step.comp): cfl_length / (cfl_speed + the fastest particle's speed).
    uint adaptive_dt;
    float cfl_length;   // m
    float cfl_speed;    // m/s
    float longest_dt;   // s
    float shortest_dt;  // s: a particle that asks for less is FAULT_TOO_FAST, instead of the run standing still
    float longest_move; // m: speed_limit times dt

    float speed_limit; // m/s: faster particles are FAULT_TOO_FAST
    float spacing;     // d, m, of particles at rest
    float lattice_volume; // d^3, m^3; in two dimensions d^2, m^2

    float rest_density[MAX_MATERIALS]; // kg/m^3, of fluids
    float viscosity[MAX_MATERIALS];    // dynamic, mu, Pa s, of fluids
    float friction[MAX_MATERIALS];     // dynamic viscosity of fluid against colliders, Pa s; 0 is free slip

    // Surface tension in SI units (shared/capillarity.h).
    float tension[MAX_MATERIALS];        // sigma, N/m, of fluids
    float contact_cosine[MAX_MATERIALS]; // of the contact angle of fluid at colliders
    float wall_contact_cosine;           // and at walls
    float first_layer_steepness;         // |n'| H of smoothed normals in the outermost layer of a lattice with a flat surface
    float second_layer_steepness;        // and in the next one
    float share_beyond_solid;            // of n in the lowest layer on a solid, what fluid in its place would add
};

SHARED_END
#endif
