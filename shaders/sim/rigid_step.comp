#version 460
#extension GL_GOOGLE_include_directive : require
// A step of rigid bodies (shared/rigid.h), a workgroup each: the impulses of fluid on the members and of gravity, those of contacts, then
// the new place, orientation and velocity, and with them the members'. Sums are over the members in order of id, always in the same
// order. Contacts ask for a least speed along their normal, and for none across as far as Coulomb's friction reaches; each
// iteration moves every contact's impulse as if it had its share of the body for itself, and starts from the step before. The
// angular velocity that turns a body is that of half the step, so that a spinning one keeps its energy. Twin:
// engine/reference/fragments.cpp.
#include "shared/rigid.h"
#define WORKGROUP_SIZE MEMBERS_AT_A_TIME
#define SUM_TYPE mat2x3 // impulse, and its moment
#include "include/rotation.glsl"
#include "include/workgroup_sum.glsl"
#include "shared/particle_state.h"
#include "shared/reaction.h"

layout(push_constant, scalar) uniform Push { RigidStepPush push_constants; };
layout(set = 0, binding = 0, scalar) uniform Params { SphParams params; };
layout(set = 0, binding = 1, scalar) uniform Rigid { RigidParams rigid; };
layout(set = 0, binding = 2, scalar) readonly buffer Members { BodyMember members[]; };
layout(set = 0, binding = 3, scalar) readonly buffer Place { uint place[]; };       // by id
layout(set = 0, binding = 4, scalar) readonly buffer Touches { Touch touches[]; };  // by id
layout(set = 0, binding = 5, scalar) readonly buffer Id { uint id[]; };
layout(set = 0, binding = 6, scalar) buffer Reactions { Reaction reactions[]; };    // by id
layout(set = 0, binding = 7, scalar) buffer Bodies { Body bodies[]; };
layout(set = 0, binding = 8, scalar) buffer Contacts { Contact contacts[]; };       // CONTACTS_A_MEMBER a member
layout(set = 0, binding = 9, scalar) buffer Touching { uint touching[]; };          // which of them there are
layout(set = 0, binding = 10, scalar) buffer Attributes { uint attributes[]; };
layout(set = 0, binding = 11, scalar) buffer Position { vec4 position[]; };
layout(set = 0, binding = 12, scalar) buffer Velocity { vec4 velocity[]; };
layout(set = 0, binding = 13, scalar) buffer StatusBuffer { Status status; };

#include "include/periodic.glsl"
#include "include/watch.glsl"

const float NO_CONTACT = 1e30; // m, a gap

shared Body body;
shared vec3 angular_velocity;
shared float contact_count;

mat3 rotation(vec4 q) { return mat3(rotated(q, vec3(1, 0, 0)), rotated(q, vec3(0, 1, 0)), rotated(q, vec3(0, 0, 1))); }

// In the directions of space.
mat3 inverse_inertia()
{
    mat3 turn = rotation(body.orientation);
    return turn * mat3(body.inverse_inertia[0], body.inverse_inertia[1], body.inverse_inertia[2]) * transpose(turn);
}

vec3 velocity_at(vec3 arm) { return body.velocity + cross(angular_velocity, arm); }

// To be called by all invocations: the sum of their terms changes the body's momentum.
void push(mat2x3 term)
{
    term = workgroup_sum(term);
    if (gl_LocalInvocationIndex == 0u) {
        body.velocity += term[0] / body.mass;
        body.angular_momentum += term[1];
        angular_velocity = inverse_inertia() * body.angular_momentum;
    }
    barrier();
}

// How much an impulse along a unit vector changes the speed along it, of the point that it acts on, 1/kg.
float mobility(mat3 inverse, vec3 arm, vec3 along)
{
    vec3 moment = cross(arm, along);
    return 1.0 / body.mass + dot(moment, inverse * moment);
}

// What fluid has done to the members in this step and owes them of steps before, the share that is theirs now.
void push_by_fluid()
{
    float share = share_of_fluid(body.mass, rigid.fluid_density * params.lattice_volume * float(body.count));
    mat2x3 term = mat2x3(vec3(0.0), vec3(0.0));
    for (uint m = body.first + gl_LocalInvocationIndex; m < body.first + body.count; m += WORKGROUP_SIZE) {
        uint its_id = members[m].id;
        vec3 owed = reactions[its_id].pressure + reactions[its_id].friction;
        vec3 impulse = share * owed;
        reactions[its_id] = Reaction(owed - impulse, vec3(0.0));
        term += mat2x3(impulse, cross(rotated(body.orientation, members[m].arm), impulse));
    }
    push(term);
}

// The least speed away from a plane: nothing comes nearer to it than contact, and what overlaps it parts.
float least_speed(float gap)
{
    float overlap = max(-gap - TOUCH_SLOP * params.spacing, 0.0);
    float parting = min(PUSH_OUT_SHARE * overlap / params.dt, PUSH_OUT_RATE * params.spacing);
    return gap > 0.0 ? -gap / params.dt : parting;
}

// Where the k-th contact of this invocation is listed.
uint touching_place(uint k)
{
    uint first = CONTACTS_A_MEMBER * (body.first + workgroup_index() * WORKGROUP_SIZE);
    return first + k * WORKGROUP_SIZE + gl_LocalInvocationIndex;
}

// Notes a contact, if this step would make it one, with the impulse that it had in the step before, as far as that points away.
void note_contact(uint slot, vec3 arm, vec3 normal, float gap, vec3 other, inout uint found)
{
    bool is_one = gap + params.dt * dot(velocity_at(arm) - other, normal) < TOUCH_SLOP * params.spacing;
    if (!is_one) {
        contacts[slot].normal = vec3(0.0);
        return;
    }
    bool was_one = contacts[slot].normal != vec3(0.0);
    vec3 before = was_one && dot(contacts[slot].impulse, normal) > 0.0 ? contacts[slot].impulse : vec3(0.0);
    contacts[slot] = Contact(arm, normal, other, least_speed(gap), before);
    touching[touching_place(found)] = slot;
    ++found;
}

// Finds the contacts of this invocation's members, and how many they are.
uint find_contacts()
{
    uint found = 0u;
    for (uint m = body.first + gl_LocalInvocationIndex; m < body.first + body.count; m += WORKGROUP_SIZE) {
        uint its_id = members[m].id;
        uint i = place[its_id];
        vec3 x = position[i].xyz;
        vec3 arm = rotated(body.orientation, members[m].arm);
        uint slot = m * CONTACTS_A_MEMBER;
        Touch touch = touches[its_id];
        vec3 other = mix(velocity_at(arm), touch.velocity, touch.share);
        note_contact(slot, arm, touch.normal, touch.share > 0.0 ? touch.gap : NO_CONTACT, other, found);
        for (uint axis = 0u; axis < 3u; ++axis) {
            bool low = (params.wall_mask >> (2u * axis) & 1u) != 0u;
            bool high = (params.wall_mask >> (2u * axis) & 2u) != 0u;
            float below = low ? x[axis] - params.domain_min[axis] : NO_CONTACT;
            float above = high ? params.domain_max[axis] - x[axis] : NO_CONTACT;
            vec3 normal = vec3(0.0);
            normal[axis] = below <= above ? 1.0 : -1.0;
            note_contact(slot + 1u + axis, arm, normal, min(below, above) - WALL_CONTACT * params.spacing, vec3(0.0), found);
        }
    }
    return found;
}

// The impulses that contacts start with.
void push_as_before(uint found)
{
    mat2x3 term = mat2x3(vec3(0.0), vec3(0.0));
    for (uint k = 0u; k < found; ++k) {
        Contact contact = contacts[touching[touching_place(k)]];
        term += mat2x3(contact.impulse, cross(contact.arm, contact.impulse));
    }
    push(term);
}

void iterate_contacts(uint found, float all_contacts, float sliding_friction)
{
    mat3 inverse = inverse_inertia();
    mat2x3 term = mat2x3(vec3(0.0), vec3(0.0));
    for (uint k = 0u; k < found; ++k) {
        uint slot = touching[touching_place(k)];
        Contact contact = contacts[slot];
        vec3 slip = velocity_at(contact.arm) - contact.velocity;
        float lacking = contact.target - dot(slip, contact.normal);
        slip -= dot(slip, contact.normal) * contact.normal;
        float slip_speed = length(slip);
        vec3 along = slip_speed > 0.0 ? slip / slip_speed : vec3(0.0);

        float normal_before = dot(contact.impulse, contact.normal);
        float normal_now = max(normal_before + lacking / (all_contacts * mobility(inverse, contact.arm, contact.normal)), 0.0);
        vec3 across = contact.impulse - normal_before * contact.normal;
        across -= slip_speed / (all_contacts * mobility(inverse, contact.arm, along)) * along;
        float most = sliding_friction * normal_now;
        across *= min(most / max(length(across), 1e-30), 1.0);

        vec3 now = normal_now * contact.normal + across;
        vec3 change = now - contact.impulse;
        contacts[slot].impulse = now;
        term += mat2x3(change, cross(contact.arm, change));
    }
    push(term);
}

void move_members()
{
    for (uint m = body.first + gl_LocalInvocationIndex; m < body.first + body.count; m += WORKGROUP_SIZE) {
        uint i = place[members[m].id];
        vec3 arm = rotated(body.orientation, members[m].arm);
        vec3 x = wrapped(wrapped(body.center + arm)); // one of them for the center
        vec3 v = velocity_at(arm);
        position[i].xyz = x;
        velocity[i].xyz = v;
        watch(i, x, v, push_constants.step);
    }
}

void main()
{
    if (workgroup_index() >= push_constants.bodies) {
        return; // the whole workgroup
    }
    if (gl_LocalInvocationIndex == 0u) {
        body = bodies[workgroup_index()];
        body.velocity += params.dt * params.gravity;
    }
    barrier();
    push_by_fluid();
    uint found = find_contacts();
    float all_contacts = workgroup_sum(mat2x3(vec3(float(found), 0.0, 0.0), vec3(0.0)))[0].x;
    if (gl_LocalInvocationIndex == 0u) {
        contact_count = all_contacts;
    }
    barrier();
    all_contacts = contact_count;
    float friction = rigid.sliding_friction[particle_material(attributes[place[members[body.first].id]])];
    if (all_contacts > 0.0) {
        push_as_before(found);
        for (uint iteration = 0u; iteration < CONTACT_ITERATIONS; ++iteration) {
            iterate_contacts(found, all_contacts, friction);
        }
    }
    if (gl_LocalInvocationIndex == 0u) {
        vec4 before = body.orientation;
        body.orientation = turned(before, angular_velocity, 0.5 * params.dt);
        angular_velocity = inverse_inertia() * body.angular_momentum;
        body.orientation = turned(before, angular_velocity, params.dt);
        angular_velocity = inverse_inertia() * body.angular_momentum;
        body.center = wrapped(body.center + params.dt * body.velocity);
        bodies[workgroup_index()] = body;
    }
    barrier();
    move_members();
}
