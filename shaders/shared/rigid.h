// Fragments: pieces of solids that nothing holds are rigid bodies. A piece is what is connected: solids nearer to each other than
// BOND_DISTANCE. An anchored piece lies among the still particles; the particles of a loose one move, and carry FLAG_LOOSE.
//
// A body keeps its angular momentum, not its angular velocity, so that nothing but torques changes it. Where it touches something it
// is held off by impulses: those of a step are solved for, contact by contact, each with its share of the body's mass (Tonge,
// Benevolenski & Voroshilov, "Mass splitting for jitter-free parallel rigid body simulation", SIGGRAPH 2012). No contact is a
// spring, so none asks for a shorter time step, and what lies still stays where it is.
#ifndef MELTPOINT_SHARED_RIGID_H
#define MELTPOINT_SHARED_RIGID_H
#include "sph_params.h"

SHARED_BEGIN

// Spacings, also to walls and colliders. As far as fluid freezes to a solid and sediment settles on one, so that these are of one
// piece with it.
SHARED_CONSTANT float BOND_DISTANCE = 1.5f;

SHARED_CONSTANT uint LEAST_PIECE = 8u; // particles: a loose piece of fewer is none, it falls to fluid or dust

SHARED_CONSTANT uint NO_PIECE = 0xffffffffu; // in the place of a piece's name, the smallest id in it
SHARED_CONSTANT uint NO_BODY = 0xffffffffu;  // in the place of a body's number

// What holds a particle, and all that is connected to it, in its place.
SHARED_CONSTANT uint ANCHOR_GROUND = 0u; // a wall or a collider that it touches
SHARED_CONSTANT uint ANCHOR_ALL = 1u;    // it holds itself
SHARED_CONSTANT uint ANCHOR_NONE = 2u;   // nothing but its neighbors

// Fluid resists a body's acceleration with its own inertia, the added mass, but only a step later, for a solve takes bodies as they
// move already: one that is lighter than that would be thrown to and fro, ever harder (Causin, Gerbeau & Nobile, "Added-mass effect
// in the design of partitioned algorithms for fluid-structure problems", CMAME 194, 2005). So of the impulse that fluid owes a body
// it gets a share in each step, and the rest later: none is lost.
SHARED_FUNCTION float share_of_fluid(float mass, float displaced_mass) { return mass / (mass + displaced_mass); }

struct RigidParams {
    float fluid_density; // kg/m^3, of the heaviest fluid: of what bodies displace
    uint anchor[MAX_MATERIALS];         // ANCHOR_*
    float sliding_friction[MAX_MATERIALS]; // mu, Coulomb's, of loose solids on anything
};

// Of the piece whose smallest id is the place in the list.
struct Piece {
    uint size; // particles
    uint held; // 1 where it has an anchor
};

// What has become of pieces that nothing holds.
struct PieceChanges {
    uint unsettled;      // labels that the last round has changed
    uint loosened;       // still particles that are loose from now on
    uint crumbled;       // still particles that are fluid or dust from now on
    uint crumbled_loose; // the same of loose ones
};

// A rigid body. Its members' places are center + R arm, R the rotation of the orientation.
struct Body {
    vec3 center; // m, of mass
    float mass;  // kg
    vec4 orientation; // a quaternion of length 1, w last; none when the body was made
    vec3 velocity; // m/s
    uint first;    // member
    vec3 angular_momentum; // kg m^2/s, around the center
    uint count;            // of members
    vec3 inverse_inertia[3]; // 1/(kg m^2), columns, when the body was made
};

struct BodyMember {
    uint id;
    vec3 arm; // m, from the center when the body was made
};

// Where a loose particle meets what is not of its body: a plane through the mean of the particles there.
struct Touch {
    vec3 normal; // away from it
    float gap;   // m, beyond where contact begins; negative where the two overlap
    vec3 velocity; // m/s, of what is there
    float share;   // of the impulse's work that the particle's body has to do: 1 where the other does not give way; 0: it touches nothing
};

// Of a member: its touch, and the walls along x, y and z.
SHARED_CONSTANT uint CONTACTS_A_MEMBER = 4u;

struct Contact {
    vec3 arm;    // m, from the body's center
    vec3 normal; // away from the other
    vec3 velocity; // m/s, of the other
    float target;  // m/s, least speed along the normal, relative to the other
    vec3 impulse;  // N s, of this step
};

SHARED_CONSTANT uint MEMBERS_AT_A_TIME = 128u; // the workgroup that steps a body

struct RigidStepPush {
    uint bodies;
    uint step; // its number, which a fault is reported with
};

SHARED_CONSTANT float SOLID_CONTACT = 1.0f;     // spacings between the particles of two solids that touch
SHARED_CONSTANT float COLLIDER_CONTACT = 0.75f; // and to a collider's surface
SHARED_CONSTANT float WALL_CONTACT = 0.5f;      // and to a wall
SHARED_CONSTANT float TOUCH_REACH = 1.5f;       // spacings: who is nearer has a say in where the plane is
SHARED_CONSTANT float TOUCH_SLOP = 0.01f;       // spacings of overlap that nobody minds
SHARED_CONSTANT float PUSH_OUT_SHARE = 0.1f;    // of an overlap that a step takes away,
SHARED_CONSTANT float PUSH_OUT_RATE = 2.0f;     // and spacings a second at most: parting must not be a jump
SHARED_CONSTANT uint CONTACT_ITERATIONS = 16u;

SHARED_END
#endif
