// Weiler, Koschier, Brand & Bender, "A Physically Consistent Implicit Viscosity Solver for SPH Fluids", Eurographics
// 2018. Hestenes & Stiefel, "Methods of Conjugate Gradients for Solving Linear Systems", 1952.
#include "reference/viscosity.h"

#include <cmath>

#include "core/parallel_for.h"
#include "particles/sph_kernel.h"
#include "reference/walls.h"
#include "shared/viscosity_solve.h"

namespace meltpoint::reference {
namespace {

double volume(const Settings& settings, const State& state, std::size_t i)
{
    return is_boundary(state, i) ? state.weight[i] * static_cast<double>(settings.params.lattice_volume)
                                 : state.mass[i] / state.density[i];
}

/// c_ij x x^T or c_ij 1 of a pair, N s/m.
glm::dmat3 pair_matrix(const Settings& settings, const State& state, std::size_t i, const Neighbor& neighbor)
{
    const shared::SphParams& params = settings.params;
    const std::size_t j = neighbor.index;
    const glm::dvec3 offset = state.position[i] - reflect_position(params, neighbor.reflection, state.position[j]);
    const double r = glm::length(offset);
    const double q = r / static_cast<double>(params.support_radius);
    const double volumes = volume(settings, state, i) * volume(settings, state, j);
    if (is_boundary(state, j)) {
        const double friction = static_cast<double>(params.friction[shared::particle_material(state.attributes[j])]);
        return glm::dmat3(friction * volumes * static_cast<double>(params.viscosity_scale) *
                          viscosity_shape(settings.kernel, q));
    }
    if (q < static_cast<double>(shared::COINCIDENT_RATIO)) {
        return glm::dmat3(0.0);
    }
    const double shape = pair_viscosity_shape(static_cast<double>(params.pair_viscosity_taper), q);
    const double c =
        viscosity_against(settings, state, i, j) * volumes * static_cast<double>(params.pair_viscosity_scale) * shape;
    return c * glm::outerProduct(offset / r, offset / r);
}

/// Of all walls, N s/m.
double wall_drag(const Settings& settings, const State& state, std::size_t i)
{
    const double support_radius = static_cast<double>(settings.params.support_radius);
    const double moment = continuum_scales(settings.kernel, support_radius, settings.dimensions).viscosity /
                          static_cast<double>(settings.params.viscosity_scale);
    double sum = 0.0;
    for_each_wall(settings.params, state.position[i], [&](double distance, const glm::dvec3&) {
        sum += wall_viscosity_integral(settings.kernel, distance, support_radius, settings.dimensions);
    });
    return static_cast<double>(settings.params.wall_viscosity) / moment * sum * volume(settings, state, i);
}

/// What the lid drags along with it, N.
glm::dvec3 lid_force(const Settings& settings, const State& state, std::size_t i)
{
    const double support_radius = static_cast<double>(settings.params.support_radius);
    const double moment = continuum_scales(settings.kernel, support_radius, settings.dimensions).viscosity /
                          static_cast<double>(settings.params.viscosity_scale);
    glm::dvec3 sum(0.0);
    for_each_wall(settings.params, state.position[i], [&](double distance, const glm::dvec3& normal) {
        sum += wall_viscosity_integral(settings.kernel, distance, support_radius, settings.dimensions) *
               wall_velocity(settings.params, normal);
    });
    return static_cast<double>(settings.params.wall_viscosity) / moment * volume(settings, state, i) * sum;
}

double step_over_mass(const Settings& settings, const State& state, std::size_t i)
{
    return static_cast<double>(settings.params.dt) / state.mass[i];
}

} // namespace

VectorSum viscous_change(const Settings& settings, const State& state, const Neighbors& neighbors,
                         const std::vector<glm::dvec3>& velocity, std::size_t i)
{
    const double factor = step_over_mass(settings, state, i);
    VectorSum sum;
    for (const Neighbor& neighbor : neighbors.of(i)) {
        const glm::dvec3 relative = reflect_velocity(neighbor.reflection, velocity[neighbor.index]) - velocity[i];
        sum.add(factor * (pair_matrix(settings, state, i, neighbor) * relative));
    }
    sum.add(-factor * wall_drag(settings, state, i) * velocity[i]);
    return sum;
}

glm::dvec3 lid_change(const Settings& settings, const State& state, std::size_t i)
{
    return step_over_mass(settings, state, i) * lid_force(settings, state, i);
}

glm::dmat3 viscosity_block(const Settings& settings, const State& state, const Neighbors& neighbors, std::size_t i)
{
    glm::dmat3 sum(wall_drag(settings, state, i));
    for (const Neighbor& neighbor : neighbors.of(i)) {
        sum += pair_matrix(settings, state, i, neighbor);
    }
    return glm::dmat3(1.0) + step_over_mass(settings, state, i) * sum;
}

double viscosity_error(double residual, double change, double momentum)
{
    return std::sqrt(residual) /
           (std::sqrt(change) + static_cast<double>(shared::VISCOSITY_CHANGE_FLOOR) * std::sqrt(momentum) + 1e-30);
}

SolveResult solve_viscosity(const Settings& settings, State& state, const Neighbors& neighbors)
{
    const std::size_t count = state.size();
    const double dt = static_cast<double>(settings.params.dt);
    state.viscous_acceleration.resize(count, glm::dvec3(0.0));
    const auto for_each_fluid = [&](const auto& body) {
        parallel_for(count, [&](std::size_t i) {
            if (!is_boundary(state, i)) {
                body(i);
            }
        });
    };
    const auto product = [&](const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
        double sum = 0.0;
        for (std::size_t i = 0; i < count; ++i) {
            sum += is_boundary(state, i) ? 0.0 : state.mass[i] * glm::dot(a[i], b[i]);
        }
        return sum;
    };
    const std::vector<glm::dvec3> zero(count, glm::dvec3(0.0));
    std::vector<glm::dvec3> u = zero;           // the change of velocity
    std::vector<glm::dvec3> r = zero;           // the residual
    std::vector<glm::dvec3> z = zero;           // preconditioned
    std::vector<glm::dvec3> p = state.velocity; // the direction; first the velocities with the change
    std::vector<glm::dvec3> q = zero;           // A p
    std::vector<glm::dmat3> preconditioner(count);
    for_each_fluid([&](std::size_t i) {
        u[i] = dt * state.viscous_acceleration[i];
        p[i] += u[i];
    });
    for_each_fluid([&](std::size_t i) {
        r[i] = viscous_change(settings, state, neighbors, p, i).value + lid_change(settings, state, i) - u[i];
        preconditioner[i] = glm::inverse(viscosity_block(settings, state, neighbors, i));
        z[i] = preconditioner[i] * r[i];
    });
    p = zero;
    const double momentum = product(state.velocity, state.velocity);
    double residual = product(r, z);
    double turn = 0.0;
    SolveResult result;
    for (;; ++result.iterations) {
        result.error = viscosity_error(product(r, r), product(u, u), momentum);
        if (result.error <= static_cast<double>(settings.params.viscosity_error) ||
            result.iterations >= settings.params.viscosity_iterations) {
            break;
        }
        for_each_fluid([&](std::size_t i) { p[i] = z[i] + turn * p[i]; });
        for_each_fluid([&](std::size_t i) { q[i] = p[i] - viscous_change(settings, state, neighbors, p, i).value; });
        const double curvature = product(p, q);
        const double advance = curvature > 0.0 ? residual / curvature : 0.0;
        for_each_fluid([&](std::size_t i) {
            u[i] += advance * p[i];
            r[i] -= advance * q[i];
            z[i] = preconditioner[i] * r[i];
        });
        turn = residual > 0.0 ? product(r, z) / residual : 0.0;
        residual = product(r, z);
    }
    for (std::size_t i = 0; i < count; ++i) {
        state.velocity[i] += u[i];
        state.viscous_acceleration[i] = u[i] / dt;
    }
    return result;
}

} // namespace meltpoint::reference
