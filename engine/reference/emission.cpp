#include "reference/emission.h"

#include <algorithm>

#include "reference/walls.h"

namespace meltpoint::reference {

namespace {

bool is_due(const State& state, std::size_t i, std::span<const float> release_time, double time)
{
    return (state.attributes[i] & shared::FLAG_DUE) != 0 && static_cast<double>(release_time[state.id[i]]) <= time;
}

/// m, of the shortest way between two places of a domain that may be periodic.
double distance(const shared::SphParams& params, const glm::dvec3& a, const glm::dvec3& b)
{
    const glm::dvec3 size = glm::dvec3(params.domain_max) - glm::dvec3(params.domain_min);
    glm::dvec3 offset = b - a;
    for (int axis = 0; axis < 3; ++axis) {
        if ((params.periodic_mask >> (2 * axis) & 1u) != 0) {
            offset[axis] -= size[axis] * std::round(offset[axis] / size[axis]);
        }
    }
    return glm::length(offset);
}

bool is_inside(const shared::SphParams& params, const glm::dvec3& x)
{
    return glm::all(glm::greaterThanEqual(x, glm::dvec3(params.domain_min))) &&
           glm::all(glm::lessThanEqual(x, glm::dvec3(params.domain_max)));
}

} // namespace

glm::dvec3 birth_place(const shared::Emitter& emitter, std::span<const glm::vec3> points, std::uint32_t birth)
{
    const glm::dvec3 random(shared::birth_random(emitter, birth, 0), shared::birth_random(emitter, birth, 1),
                            shared::birth_random(emitter, birth, 2));
    return glm::dvec3(points[emitter.first_point + birth % emitter.points]) + glm::dvec3(emitter.spread) * random;
}

std::size_t call_up(State& state, const shared::Emitter& emitter, std::span<const glm::vec3> points,
                    std::uint32_t first_birth, std::uint32_t births, const std::vector<bool>& gone,
                    std::span<float> release_time)
{
    std::uint32_t called = 0;
    for (std::size_t i = 0; i < state.size() && called < births; ++i) { // in order of id
        const std::uint32_t id = state.id[i];
        if (id < emitter.first_id || id >= emitter.first_id + emitter.slots || !gone[id]) {
            continue;
        }
        state.attributes[i] |= shared::FLAG_DUE;
        state.position[i] = birth_place(emitter, points, first_birth + called);
        state.velocity[i] = glm::dvec3(emitter.velocity);
        release_time[id] = shared::birth_time(emitter, first_birth + called);
        ++called;
    }
    return called;
}

std::size_t bear(const Settings& settings, State& state, std::span<const float> release_time, double time)
{
    const double dt = static_cast<double>(settings.params.dt);
    const double reach = static_cast<double>(shared::BIRTH_DISTANCE) * static_cast<double>(settings.params.spacing);
    std::vector<std::size_t> due;
    std::vector<glm::dvec3> place;
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (is_due(state, i, release_time, time)) {
            const double late = time - static_cast<double>(release_time[state.id[i]]);
            due.push_back(i);
            place.push_back(state.position[i] + std::min(late, dt) * state.velocity[i]);
        }
    }
    std::vector<bool> is_free(due.size());
    for (std::size_t k = 0; k < due.size(); ++k) {
        is_free[k] = is_inside(settings.params, place[k]);
        for (std::size_t j = 0; j < state.size(); ++j) {
            is_free[k] = is_free[k] &&
                         !(state.weight[j] > 0.0 && distance(settings.params, place[k], state.position[j]) < reach);
        }
        for (std::size_t before = 0; before < k; ++before) { // of smaller id
            is_free[k] = is_free[k] && distance(settings.params, place[k], place[before]) >= reach;
        }
    }
    for (std::size_t k = 0; k < due.size(); ++k) {
        const std::size_t i = due[k];
        state.attributes[i] &= ~shared::FLAG_DUE;
        state.density[i] = 0.0;
        if (is_free[k]) {
            state.attributes[i] = shared::with_state(state.attributes[i], shared::STATE_FLUID);
            state.position[i] = place[k];
            state.weight[i] = 1.0;
        }
    }
    return static_cast<std::size_t>(std::ranges::count(is_free, true));
}

std::size_t sink(State& state, std::span<const shared::Sink> sinks)
{
    const auto is_in = [](const shared::Sink& sink, const glm::dvec3& x) {
        const glm::dvec3 low(sink.low);
        const glm::dvec3 high(sink.high);
        return sink.shape == shared::SINK_BLOCK
                   ? glm::all(glm::greaterThanEqual(x, low)) && glm::all(glm::lessThanEqual(x, high))
                   : glm::distance(x, low) <= high.x;
    };
    std::size_t sunk = 0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        const std::uint32_t its_state = shared::particle_state(state.attributes[i]);
        if ((its_state == shared::STATE_FLUID || its_state == shared::STATE_DUST) &&
            std::ranges::any_of(sinks, [&](const shared::Sink& each) { return is_in(each, state.position[i]); })) {
            state.attributes[i] = shared::with_state(state.attributes[i], shared::STATE_DEAD);
            state.weight[i] = 0.0;
            ++sunk;
        }
    }
    return sunk;
}

} // namespace meltpoint::reference
