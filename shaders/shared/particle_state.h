// What a particle is, and what the simulation has noticed about it.
#ifndef MELTPOINT_SHARED_PARTICLE_STATE_H
#define MELTPOINT_SHARED_PARTICLE_STATE_H
#include "prelude.h"

SHARED_BEGIN

SHARED_CONSTANT uint STATE_SOLID = 0u; // of a body that may turn into fluid: a boundary particle with a mass
SHARED_CONSTANT uint STATE_FLUID = 1u;
SHARED_CONSTANT uint STATE_DUST = 2u;  // of what was a solid, drifts with the air (shared/dust.h)
SHARED_CONSTANT uint STATE_COLLIDER = 3u;
SHARED_CONSTANT uint STATE_DEAD = 4u;

// A particle's attributes in one word: state in bits 0..7, material in bits 8..15, flags above.
SHARED_CONSTANT uint MATERIAL_SHIFT = 8u;
SHARED_CONSTANT uint FLAG_LEFT_DOMAIN = 0x10000u; // was outside the domain at least once; never cleared
SHARED_CONSTANT uint FLAG_CRUMBLES = 0x20000u;   // solid that turns into dust, not fluid
SHARED_CONSTANT uint FLAG_DUE = 0x40000u;        // dead, and called up to be born soon (shared/emission.h)
SHARED_CONSTANT uint FLAG_LOOSE = 0x80000u;      // solid of a piece that nothing holds: it moves (shared/rigid.h)

SHARED_FUNCTION uint particle_state(uint attributes) { return attributes & 0xffu; } // STATE_*
SHARED_FUNCTION uint particle_material(uint attributes) { return (attributes >> MATERIAL_SHIFT) & 0xffu; } // its number
// A boundary particle: no force of the fluid moves it. Fluid meets it where it has a weight: dust and the dead have none.
SHARED_FUNCTION bool is_boundary(uint attributes) { return particle_state(attributes) != STATE_FLUID; }
// One that is nowhere: dead, and not called up.
SHARED_FUNCTION bool is_gone(uint attributes)
{
    return particle_state(attributes) == STATE_DEAD && (attributes & FLAG_DUE) == 0u;
}
// Solid, of a piece that nothing holds.
SHARED_FUNCTION bool is_loose(uint attributes)
{
    return particle_state(attributes) == STATE_SOLID && (attributes & FLAG_LOOSE) != 0u;
}
// One that stays where it is. Those who are gone are no longer anywhere, which is the same.
SHARED_FUNCTION bool is_still(uint attributes)
{
    uint state = particle_state(attributes);
    return (state == STATE_SOLID && !is_loose(attributes)) || state == STATE_COLLIDER || is_gone(attributes);
}
SHARED_FUNCTION uint with_state(uint attributes, uint state) { return (attributes & ~0xffu) | state; }
SHARED_FUNCTION uint pack_attributes(uint state, uint material) { return state | (material << MATERIAL_SHIFT); } // no flags

// What has freed a solid particle last, in bits 24..26.
SHARED_CONSTANT uint CAUSE_SHIFT = 24u;
SHARED_CONSTANT uint CAUSE_NONE = 0u;
SHARED_CONSTANT uint CAUSE_FRONT = 1u;
SHARED_CONSTANT uint CAUSE_MELT = 2u;
SHARED_CONSTANT uint CAUSE_HYDRAULIC = 3u;
SHARED_CONSTANT uint CAUSE_WIND = 4u; // it hops, or falls off a slope (shared/wind.h)
SHARED_CONSTANT uint CAUSE_FRAGMENT = 5u; // of a piece too small to be one (shared/rigid.h)
SHARED_FUNCTION uint cause_of(uint attributes) { return (attributes >> CAUSE_SHIFT) & 7u; } // CAUSE_*
// Dust that drifts with the air until its life is over: not sand, which comes down again.
SHARED_FUNCTION bool is_drifting(uint attributes)
{
    return particle_state(attributes) == STATE_DUST && cause_of(attributes) != CAUSE_WIND;
}
// Sand in the air, which does.
SHARED_FUNCTION bool is_flying_sand(uint attributes)
{
    return particle_state(attributes) == STATE_DUST && cause_of(attributes) == CAUSE_WIND;
}
SHARED_FUNCTION uint freed_as(uint attributes, uint state, uint cause)
{
    return (with_state(attributes, state) & ~(FLAG_LOOSE | 7u << CAUSE_SHIFT)) | (cause << CAUSE_SHIFT);
}

// Why the simulation stopped.
SHARED_CONSTANT uint FAULT_NONE = 0u;
SHARED_CONSTANT uint FAULT_NOT_FINITE = 1u; // a position or velocity is NaN or infinite
SHARED_CONSTANT uint FAULT_ESCAPED = 2u;    // a particle left the domain
SHARED_CONSTANT uint FAULT_TOO_FAST = 3u;   // a particle moves farther in a step than the CFL bound allows

// Which particle and why in one word, so that one atomicMin finds the faulty particle of smallest id.
SHARED_FUNCTION uint pack_offender(uint particle_id, uint fault) { return (particle_id << 2u) | fault; }
SHARED_FUNCTION uint offender_id(uint offender) { return offender >> 2u; } // the particle's
SHARED_FUNCTION uint offender_fault(uint offender) { return offender & 3u; } // FAULT_*

SHARED_CONSTANT uint NO_STEP = 0xffffffffu;

// Written by the GPU, read by the host after the fence.
struct Status {
    uint first_faulty_step; // NO_STEP while all is well
    uint offender;          // pack_offender(smallest faulty id of that step, its FAULT_*)
};

SHARED_END
#endif
