// Counting sort, pass 5: orders the elements of each crowded key by id. One workgroup a key sorts from the least significant
// digit up (LSD radix sort), from one array to the other and back. Each invocation has a chunk of consecutive elements and
// a counter for each digit, so that equal digits keep their order without any atomics.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_control_flow_attributes : require
#define WORKGROUP_SIZE 128u // with it the counters fit the shared memory that every device has
#include "include/invocation.glsl"
#include "include/workgroup_scan.glsl"
#include "shared/counting_sort.h"

layout(std430, binding = 0) readonly buffer Ids { uint ids[]; };
layout(std430, binding = 1) readonly buffer Starts { uint starts[]; };
layout(std430, binding = 2) coherent buffer Unordered { uint unordered[]; };
layout(std430, binding = 3) coherent buffer Order { uint order[]; };
layout(scalar, binding = 4) readonly buffer Crowded
{
    CrowdedKeys crowded;
    uint crowded_keys[];
};

const uint DIGIT_BITS = 4u;
const uint DIGITS = 1u << DIGIT_BITS;

// llvmpipe ends an invocation's loops, silently, after 65,535 iterations in all. Unrolled by this much, a key may have 1.9
// million elements there, even if their ids differ in every digit.
const uint UNROLLED = 4u;
#define FOR_EACH_SLOT(slot, begin, end)                                 \
    for (uint base = begin, slot = begin; base < end; base += UNROLLED) \
        [[unroll]] for (uint k = 0u; k < UNROLLED; ++k)                 \
            if ((slot = base + k) < end)

shared uint counters[DIGITS * WORKGROUP_SIZE]; // of (digit, invocation), the digit in the outer place
shared uint differing_bits;

uint load(bool from_order, uint slot) { return from_order ? order[slot] : unordered[slot]; }

void store(bool to_order, uint slot, uint element)
{
    if (to_order) {
        order[slot] = element;
    } else {
        unordered[slot] = element;
    }
}

uint counter_of(uint element, uint shift)
{
    const uint digit = (ids[element] >> shift) & (DIGITS - 1u);
    return digit * WORKGROUP_SIZE + gl_LocalInvocationIndex;
}

// The bits in which the ids of the key differ: digits without any need no pass. `begin`, `end`: this invocation's chunk.
uint find_differing_bits(uint first, uint begin, uint end)
{
    if (gl_LocalInvocationIndex == 0u) {
        differing_bits = 0u;
    }
    barrier();
    const uint first_id = ids[unordered[first]];
    uint bits = 0u;
    FOR_EACH_SLOT(slot, begin, end) {
        bits |= ids[unordered[slot]] ^ first_id;
    }
    atomicOr(differing_bits, bits);
    barrier();
    return differing_bits;
}

// Moves the key's elements into the other array, stably ordered by one digit.
void sort_by_digit(uint shift, bool from_order, uint first, uint begin, uint end)
{
    for (uint digit = 0u; digit < DIGITS; ++digit) {
        counters[digit * WORKGROUP_SIZE + gl_LocalInvocationIndex] = 0u;
    }
    FOR_EACH_SLOT(slot, begin, end) {
        ++counters[counter_of(load(from_order, slot), shift)];
    }
    barrier();

    // Scan over all counters: each becomes the first slot of its digit and invocation.
    const uint run = gl_LocalInvocationIndex * DIGITS;
    uint sum = 0u;
    for (uint i = run; i < run + DIGITS; ++i) {
        sum += counters[i];
    }
    uint total;
    uint running = first + workgroup_exclusive_sum(sum, total);
    for (uint i = run; i < run + DIGITS; ++i) {
        const uint elements = counters[i];
        counters[i] = running;
        running += elements;
    }
    barrier();

    FOR_EACH_SLOT(slot, begin, end) {
        const uint element = load(from_order, slot);
        const uint counter = counter_of(element, shift);
        store(!from_order, counters[counter], element);
        ++counters[counter];
    }
    memoryBarrierBuffer();
    barrier();
}

void sort_key(uint key)
{
    const uint first = starts[key];
    const uint last = starts[key + 1u];
    const uint chunk = (last - first + WORKGROUP_SIZE - 1u) / WORKGROUP_SIZE;
    const uint begin = min(first + gl_LocalInvocationIndex * chunk, last);
    const uint end = min(begin + chunk, last);

    const uint bits = find_differing_bits(first, begin, end);
    bool in_order = false;
    for (uint shift = 0u; shift < 32u; shift += DIGIT_BITS) {
        if (((bits >> shift) & (DIGITS - 1u)) != 0u) {
            sort_by_digit(shift, in_order, first, begin, end);
            in_order = !in_order;
        }
    }
    if (!in_order) {
        FOR_EACH_SLOT(slot, begin, end) {
            order[slot] = unordered[slot];
        }
    }
}

void main()
{
    sort_key(crowded_keys[gl_WorkGroupID.x]);
}
