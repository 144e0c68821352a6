// Bender & Koschier, "Divergence-Free SPH for Incompressible and Viscous Fluids", IEEE TVCG 23(3), 2017.
#include "reference/dfsph.h"

#include <algorithm>
#include <cmath>

#include "core/parallel_for.h"
#include "particles/sph_kernel.h"
#include "reference/capillarity.h"
#include "reference/density.h"
#include "reference/integrate.h"
#include "reference/shifting.h"
#include "reference/viscosity.h"
#include "reference/vorticity.h"
#include "reference/walls.h"

namespace meltpoint::reference {
namespace {

/// g_ij = -grad W_ij, from j or its image to i, 1/m^4; zero for coincident particles.
glm::dvec3 descent(const Settings& settings, const State& state, std::size_t i, const Neighbor& neighbor)
{
    const glm::dvec3 offset =
        state.position[i] - reflect_position(settings.params, neighbor.reflection, state.position[neighbor.index]);
    const double r = glm::length(offset);
    const double q = r / static_cast<double>(settings.params.support_radius);
    if (q < static_cast<double>(shared::COINCIDENT_RATIO)) {
        return glm::dvec3(0.0);
    }
    return static_cast<double>(settings.params.gradient_scale) * gradient_shape(settings.kernel, q) / r * offset;
}

double rest_volume(const Settings& settings, const State& state, std::size_t i)
{
    return state.mass[i] / rest_density(settings, state, i);
}

double step_length(const Settings& settings)
{
    return static_cast<double>(settings.params.dt);
}

double density_share(const Settings& settings)
{
    return static_cast<double>(shared::density_share(settings.params.dt, settings.params.correction_time));
}

} // namespace

double jacobi_diagonal(const Settings& settings, const State& state, const Neighbors& neighbors, std::size_t i)
{
    glm::dvec3 sum(0.0);
    double squares = 0.0;
    for (const Neighbor& neighbor : neighbors.of(i)) {
        const glm::dvec3 g = descent(settings, state, i, neighbor);
        sum += state.weight[neighbor.index] * g;
        squares += is_boundary(state, neighbor.index) ? 0.0 : glm::dot(g, g) / state.mass[neighbor.index];
    }
    const double response = glm::dot(sum, sum) / state.mass[i] + squares;
    return response > 0.0 ? 1.0 / response : 0.0;
}

VectorSum velocity_correction(const Settings& settings, const State& state, const Neighbors& neighbors,
                              const std::vector<double>& impulse, std::size_t i)
{
    VectorSum sum;
    for (const Neighbor& neighbor : neighbors.of(i)) {
        const std::size_t j = neighbor.index;
        const double both = impulse[i] * state.weight[j] + impulse[j] * state.weight[i];
        sum.add(both / state.mass[i] * descent(settings, state, i, neighbor));
    }
    return sum;
}

ScalarSum excess(const Settings& settings, const State& state, const Neighbors& neighbors,
                 const std::vector<glm::dvec3>& velocity, std::uint32_t solve, std::size_t i)
{
    const double per_rate = step_length(settings) * rest_volume(settings, state, i);
    ScalarSum sum;
    for (const Neighbor& neighbor : neighbors.of(i)) {
        const std::size_t j = neighbor.index;
        const glm::dvec3 relative = reflect_velocity(neighbor.reflection, velocity[j]) - velocity[i];
        const glm::dvec3 g = descent(settings, state, i, neighbor);
        sum.value += per_rate * state.weight[j] * glm::dot(relative, g);
        sum.magnitude += per_rate * state.weight[j] * glm::length(relative) * glm::length(g);
    }
    const double compression = state.density[i] / rest_density(settings, state, i);
    if (solve == shared::SOLVE_DENSITY) {
        const double dense = compression > 1.0 ? density_share(settings) * (compression - 1.0) : compression - 1.0;
        return {dense + sum.value, compression + 1.0 + sum.magnitude};
    }
    return compression > static_cast<double>(shared::DIVERGENCE_FILL) ? sum : ScalarSum{};
}

double next_impulse(const Settings& settings, const State& state, double diagonal, double excess, double impulse,
                    std::size_t i)
{
    const double rate = excess / (step_length(settings) * rest_volume(settings, state, i));
    return std::max(impulse + static_cast<double>(settings.params.solve_relaxation) * diagonal * rate, 0.0);
}

double first_impulse(const Settings& settings, double excess, double warm_start, std::uint32_t solve)
{
    const double unit = solve == shared::SOLVE_DENSITY ? step_length(settings) : 1.0;
    return excess > 0.0 ? static_cast<double>(shared::WARM_START) * warm_start / unit : 0.0;
}

double with_momentum(double impulse, double before, double momentum)
{
    return std::max(impulse + momentum * (impulse - before), 0.0);
}

double solved_pressure(const Settings& settings, const State& state, const WarmStarts& warm_starts, std::size_t i)
{
    const double dt = step_length(settings);
    const double impulse = warm_starts[shared::SOLVE_DENSITY][i] / dt + warm_starts[shared::SOLVE_DIVERGENCE][i];
    const double volume = state.mass[i] / state.density[i];
    return is_boundary(state, i) ? 0.0 : impulse / (dt * volume * volume);
}

SolveResult solve(const Settings& settings, State& state, const Neighbors& neighbors, std::uint32_t solve,
                  std::vector<double>& warm_start)
{
    const std::size_t count = state.size();
    const double target = static_cast<double>(solve == shared::SOLVE_DENSITY ? settings.params.density_error
                                                                             : settings.params.divergence_error);
    const double share = solve == shared::SOLVE_DENSITY ? density_share(settings) : 1.0;
    std::vector<double> diagonal(count, 0.0);
    std::vector<double> impulse(count, 0.0); // of the Jacobi steps
    std::vector<double> ahead(count, 0.0);   // with momentum
    std::vector<double> acted(count, 0.0);   // what the velocities have in them
    std::uint32_t unrisen = 0;
    std::vector<double> errors(count, 0.0);
    std::vector<glm::dvec3> velocity = state.velocity;
    std::size_t fluid = 0;
    for (std::size_t i = 0; i < count; ++i) {
        fluid += is_boundary(state, i) ? 0 : 1;
    }
    SolveResult result;
    for (;; ++result.iterations) {
        parallel_for(count, [&](std::size_t i) {
            if (is_boundary(state, i)) {
                return;
            }
            const double e = excess(settings, state, neighbors, velocity, solve, i).value;
            if (result.iterations == 0) {
                diagonal[i] = jacobi_diagonal(settings, state, neighbors, i);
                impulse[i] = first_impulse(settings, e, warm_start[i], solve);
                ahead[i] = impulse[i];
            }
            acted[i] = ahead[i];
            const double before = impulse[i];
            impulse[i] = next_impulse(settings, state, diagonal[i], e, acted[i], i);
            const double momentum = result.iterations == 0 ? 0.0 : static_cast<double>(shared::solve_momentum(unrisen));
            ahead[i] = with_momentum(impulse[i], before, momentum);
            errors[i] = std::max(e, 0.0) / share;
        });
        double sum = 0.0;
        for (const double error : errors) {
            sum += error;
        }
        const double error = fluid > 0 ? sum / static_cast<double>(fluid) : 0.0;
        unrisen = result.iterations == 0 || error > result.error ? 0 : unrisen + 1;
        result.error = error;
        if (result.iterations >= settings.params.max_iterations || (result.iterations > 0 && result.error <= target)) {
            break;
        }
        parallel_for(count, [&](std::size_t i) {
            if (!is_boundary(state, i)) {
                velocity[i] = state.velocity[i] + velocity_correction(settings, state, neighbors, ahead, i).value;
            }
        });
    }
    const double unit = solve == shared::SOLVE_DENSITY ? step_length(settings) : 1.0;
    for (std::size_t i = 0; i < count; ++i) {
        warm_start[i] = acted[i] * unit;
    }
    state.velocity = velocity;
    return result;
}

DfsphStep dfsph_step(const Settings& settings, State& state, WarmStarts& warm_starts)
{
    for (std::vector<double>& warm_start : warm_starts) {
        warm_start.resize(state.size(), 0.0);
    }
    DfsphStep results;
    const Neighbors neighbors = find_neighbors(settings.params, state.position);
    update_density(settings, state, neighbors);
    smooth_velocities(settings, state, neighbors);
    results[shared::SOLVE_DIVERGENCE] =
        solve(settings, state, neighbors, shared::SOLVE_DIVERGENCE, warm_starts[shared::SOLVE_DIVERGENCE]);
    const Accelerations a = accelerations(settings, state, neighbors);
    parallel_for(state.size(), [&](std::size_t i) { state.acceleration[i] = a.total[i].value; });
    add_confinement(settings, state, neighbors);
    add_capillarity(settings, state, neighbors);
    kick(state, step_length(settings));
    if (settings.implicit_viscosity) {
        (void)solve_viscosity(settings, state, neighbors);
    }
    results[shared::SOLVE_DENSITY] =
        solve(settings, state, neighbors, shared::SOLVE_DENSITY, warm_starts[shared::SOLVE_DENSITY]);
    for (std::size_t i = 0; i < state.size(); ++i) {
        state.pressure[i] = solved_pressure(settings, state, warm_starts, i);
    }
    shift_particles(settings, state, neighbors);
    hold_off_walls(settings, state);
    drift(settings, state);
    ++state.step;
    return results;
}

} // namespace meltpoint::reference
