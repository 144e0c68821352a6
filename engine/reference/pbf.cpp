// Macklin & Müller, "Position Based Fluids", ACM Trans. Graph. 32(4), 2013.
#include "reference/pbf.h"

#include <algorithm>
#include <cmath>

#include "core/parallel_for.h"
#include "particles/sph_kernel.h"
#include "reference/capillarity.h"
#include "reference/density.h"
#include "reference/integrate.h"
#include "reference/vorticity.h"
#include "reference/walls.h"

namespace meltpoint::reference {
namespace {

/// A neighbor as particle i sees it now.
struct Pair {
    double q;     // r/H
    glm::dvec3 g; // -grad W_ij, 1/m^4; zero for coincident particles
};

Pair make_pair(const Settings& settings, const std::vector<glm::dvec3>& moved, std::size_t i, const Neighbor& neighbor)
{
    const glm::dvec3 offset = moved[i] - reflect_position(settings.params, neighbor.reflection, moved[neighbor.index]);
    const double r = glm::length(offset);
    const double q = r / static_cast<double>(settings.params.support_radius);
    if (q < static_cast<double>(shared::COINCIDENT_RATIO)) {
        return {q, glm::dvec3(0.0)};
    }
    return {q, static_cast<double>(settings.params.gradient_scale) * gradient_shape(settings.kernel, q) / r * offset};
}

double rest_volume(const Settings& settings, const State& state, std::size_t i)
{
    return state.mass[i] / rest_density(settings, state, i);
}

double nearness(const Settings& settings, double q)
{
    const double scale = static_cast<double>(settings.params.artificial_pressure_scale);
    return std::pow(scale * density_shape(settings.kernel, q), 4.0);
}

} // namespace

void predict(const Settings& settings, State& state)
{
    hold_off_walls(settings, state);
    parallel_for(state.size(), [&](std::size_t i) {
        if (!is_boundary(state, i)) {
            const glm::dvec3 move = static_cast<double>(settings.params.dt) * state.velocity[i];
            state.position[i] = wrap_position(settings.params, state.position[i] + move);
        }
    });
}

void hold_moves_off_walls(const Settings& settings, const State& state, std::vector<glm::dvec3>& moves)
{
    parallel_for(state.size(), [&](std::size_t i) {
        if (!is_boundary(state, i)) {
            moves[i] = held_off_walls(settings.params, state.position[i], moves[i], 1.0);
        }
    });
}

std::vector<glm::dvec3> moved_positions(const State& state, const std::vector<glm::dvec3>& moves)
{
    std::vector<glm::dvec3> moved = state.position;
    for (std::size_t i = 0; i < state.size(); ++i) {
        moved[i] += moves[i];
    }
    return moved;
}

Constraint constraint(const Settings& settings, const State& state, const Neighbors& neighbors,
                      const std::vector<glm::dvec3>& moved, std::size_t i)
{
    double number_density = state.weight[i] * density_shape(settings.kernel, 0.0);
    glm::dvec3 sum(0.0);
    double squares = 0.0;
    for (const Neighbor& neighbor : neighbors.of(i)) {
        const std::size_t j = neighbor.index;
        const Pair pair = make_pair(settings, moved, i, neighbor);
        number_density += state.weight[j] * density_shape(settings.kernel, pair.q);
        sum += state.weight[j] * pair.g;
        squares += is_boundary(state, j) ? 0.0 : glm::dot(pair.g, pair.g) / state.mass[j];
    }
    const double softness = static_cast<double>(settings.params.constraint_softness) *
                            std::pow(static_cast<double>(settings.params.gradient_scale), 2);
    const double response = (glm::dot(sum, sum) + softness) / state.mass[i] + squares;

    Constraint result;
    result.density = state.mass[i] * static_cast<double>(settings.params.density_scale) * number_density;
    result.excess = result.density / rest_density(settings, state, i) - 1.0;
    if (response > 0.0) {
        result.impulse_per_excess =
            static_cast<double>(settings.params.solve_relaxation) / (rest_volume(settings, state, i) * response);
    }
    const double wanted = settings.params.clamp_pressure != 0u ? std::max(result.excess, 0.0) : result.excess;
    result.impulse = result.impulse_per_excess * wanted;
    result.artificial = result.impulse_per_excess * static_cast<double>(settings.params.artificial_pressure);
    return result;
}

VectorSum position_correction(const Settings& settings, const State& state, const Neighbors& neighbors,
                              const std::vector<glm::dvec3>& moved, const std::vector<Constraint>& constraints,
                              std::size_t i)
{
    VectorSum sum;
    for (const Neighbor& neighbor : neighbors.of(i)) {
        const std::size_t j = neighbor.index;
        const Pair pair = make_pair(settings, moved, i, neighbor);
        const double near = nearness(settings, pair.q);
        const auto asked = [&](std::size_t k) {
            return constraints[k].impulse + constraints[k].artificial * near;
        };
        sum.add((asked(i) * state.weight[j] + asked(j) * state.weight[i]) / state.mass[i] * pair.g);
    }
    return sum;
}

SolveResult solve_positions(const Settings& settings, State& state, const Neighbors& neighbors,
                            std::vector<glm::dvec3>& moves)
{
    const std::size_t count = state.size();
    const double dt = static_cast<double>(settings.params.dt);
    std::size_t fluid = 0;
    moves.assign(count, glm::dvec3(0.0));
    for (std::size_t i = 0; i < count; ++i) {
        fluid += is_boundary(state, i) ? 0 : 1;
        moves[i] = dt * dt * state.acceleration[i];
        state.pressure[i] = 0.0;
    }
    std::vector<Constraint> constraints(count);
    SolveResult result;
    for (;; ++result.iterations) {
        hold_moves_off_walls(settings, state, moves);
        const std::vector<glm::dvec3> moved = moved_positions(state, moves);
        parallel_for(count, [&](std::size_t i) {
            if (!is_boundary(state, i)) {
                constraints[i] = constraint(settings, state, neighbors, moved, i);
                state.density[i] = constraints[i].density;
            }
        });
        double sum = 0.0;
        for (std::size_t i = 0; i < count; ++i) {
            sum += std::max(constraints[i].excess, 0.0);
        }
        result.error = fluid > 0 ? sum / static_cast<double>(fluid) : 0.0;
        const bool met = result.error <= static_cast<double>(settings.params.density_error);
        if (result.iterations >= settings.params.max_iterations ||
            (met && result.iterations >= settings.params.least_iterations)) {
            return result;
        }
        parallel_for(count, [&](std::size_t i) {
            if (!is_boundary(state, i)) {
                moves[i] += position_correction(settings, state, neighbors, moved, constraints, i).value;
                state.pressure[i] += constraints[i].impulse;
            }
        });
    }
}

std::uint32_t finish(const Settings& settings, State& state, const std::vector<glm::dvec3>& moves)
{
    const double dt = static_cast<double>(settings.params.dt);
    const double limit = static_cast<double>(settings.params.speed_cap) / dt;
    std::uint32_t capped = 0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (is_boundary(state, i)) {
            continue;
        }
        const glm::dvec3 before = state.velocity[i];
        state.velocity[i] += moves[i] / dt;
        const double speed = glm::length(state.velocity[i]);
        if (speed > limit) {
            state.velocity[i] *= limit / speed;
            ++capped;
        }
        const glm::dvec3 move = speed > limit ? dt * (state.velocity[i] - before) : moves[i];
        state.position[i] = wrap_position(settings.params, state.position[i] + move);
        state.pressure[i] /= dt * dt * std::pow(state.mass[i] / state.density[i], 2);
    }
    watch(settings, state);
    return capped;
}

SolveResult pbf_step(const Settings& settings, State& state)
{
    predict(settings, state);
    const Neighbors neighbors = find_neighbors(settings.params, state.position);
    update_density(settings, state, neighbors);
    smooth_velocities(settings, state, neighbors);
    const Accelerations a = accelerations(settings, state, neighbors);
    parallel_for(state.size(), [&](std::size_t i) { state.acceleration[i] = a.total[i].value; });
    add_confinement(settings, state, neighbors);
    add_capillarity(settings, state, neighbors);
    std::vector<glm::dvec3> moves;
    const SolveResult result = solve_positions(settings, state, neighbors, moves);
    (void)finish(settings, state, moves);
    ++state.step;
    return result;
}

} // namespace meltpoint::reference
