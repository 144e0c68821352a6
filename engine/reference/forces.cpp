// Müller, Charypar & Gross, "Particle-Based Fluid Simulation for Interactive Applications", SCA 2003.
// Akinci, Ihmsen, Akinci, Solenthaler & Teschner, "Versatile Rigid-Fluid Coupling for Incompressible SPH", SIGGRAPH
// 2012 (boundary particles). Monaghan, "Smoothed Particle Hydrodynamics", Rep. Prog. Phys. 68, 2005 (the pressure sum
// that conserves momentum).
#include "reference/forces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/parallel_for.h"
#include "particles/sph_kernel.h"
#include "reference/walls.h"

namespace meltpoint::reference {
namespace {

double volume(const Settings& settings, const State& state, std::size_t i)
{
    return is_boundary(state, i) ? state.weight[i] * static_cast<double>(settings.params.lattice_volume)
                                 : state.mass[i] / state.density[i];
}

// A pair as particle i sees it.
struct Pair {
    std::size_t j;
    double q;             // r/H
    glm::dvec3 direction; // unit vector from j, or its image, to i; zero for coincident particles
    glm::dvec3 velocity;  // of j, or its image
    bool coincident;
};

Pair make_pair(const Settings& settings, const State& state, std::size_t i, const Neighbor& neighbor)
{
    const std::size_t j = neighbor.index;
    const glm::dvec3 image = reflect_position(settings.params, neighbor.reflection, state.position[j]);
    const glm::dvec3 offset = state.position[i] - image;
    const double r = glm::length(offset);
    const double q = r / static_cast<double>(settings.params.support_radius);
    const bool coincident = q < static_cast<double>(shared::COINCIDENT_RATIO);
    return {.j = j,
            .q = q,
            .direction = coincident ? glm::dvec3(0.0) : offset / r,
            .velocity = reflect_velocity(neighbor.reflection, state.velocity[j]),
            .coincident = coincident};
}

} // namespace

double viscosity_against(const Settings& settings, const State& state, std::size_t i, std::size_t j)
{
    const auto of = [&](std::size_t k) {
        return static_cast<double>(settings.params.viscosity[shared::particle_material(state.attributes[k])]);
    };
    if (is_boundary(state, j)) {
        return static_cast<double>(settings.params.friction[shared::particle_material(state.attributes[j])]);
    }
    return of(i) > 0.0 && of(j) > 0.0 ? 2.0 * of(i) * of(j) / (of(i) + of(j)) : 0.0;
}

VectorSum pressure_acceleration(const Settings& settings, const State& state, const Neighbors& neighbors, std::size_t i)
{
    const double scale = static_cast<double>(settings.params.gradient_scale);
    const auto pressure_term = [&](std::size_t k) {
        return is_boundary(state, k) ? 0.0 : state.pressure[k] * std::pow(volume(settings, state, k), 2);
    };
    VectorSum sum;
    for (const Neighbor& neighbor : neighbors.of(i)) {
        const Pair pair = make_pair(settings, state, i, neighbor);
        const glm::dvec3 kernel_gradient = -scale * gradient_shape(settings.kernel, pair.q) * pair.direction;
        const double factor = pressure_term(i) * state.weight[pair.j] + pressure_term(pair.j) * state.weight[i];
        sum.add(-factor / state.mass[i] * kernel_gradient);
    }
    return sum;
}

VectorSum viscosity_acceleration(const Settings& settings, const State& state, const Neighbors& neighbors,
                                 std::size_t i)
{
    const double scale = static_cast<double>(settings.params.viscosity_scale);
    const double factor = volume(settings, state, i) / state.mass[i];
    VectorSum sum;
    for (const Neighbor& neighbor : neighbors.of(i)) {
        const Pair pair = make_pair(settings, state, i, neighbor);
        const double laplacian = scale * viscosity_shape(settings.kernel, pair.q);
        const double viscosity = viscosity_against(settings, state, i, pair.j);
        sum.add(factor * viscosity * volume(settings, state, pair.j) * laplacian * (pair.velocity - state.velocity[i]));
    }
    return sum;
}

ColorField color_field(const Settings& settings, const State& state, const Neighbors& neighbors, std::size_t i)
{
    const double gradient_scale = static_cast<double>(settings.params.color_gradient_scale);
    const double laplacian_scale = static_cast<double>(settings.params.color_laplacian_scale);
    ColorField color;
    const auto add_laplacian = [&](double term) {
        color.laplacian += term;
        color.laplacian_magnitude += std::abs(term);
    };
    add_laplacian(-volume(settings, state, i) * laplacian_scale *
                  color_laplacian_shape(settings.kernel, 0.0, settings.dimensions));
    for (const Neighbor& neighbor : neighbors.of(i)) {
        const Pair pair = make_pair(settings, state, i, neighbor);
        color.gradient.add(-volume(settings, state, pair.j) * gradient_scale *
                           color_gradient_shape(settings.kernel, pair.q) * pair.direction);
        add_laplacian(-volume(settings, state, pair.j) * laplacian_scale *
                      color_laplacian_shape(settings.kernel, pair.q, settings.dimensions));
    }
    return color;
}

VectorSum tension_acceleration(const Settings& settings, const State& state, const Neighbors& neighbors, std::size_t i)
{
    const double sigma = static_cast<double>(settings.params.surface_tension);
    if (!(sigma > 0.0)) {
        return {};
    }
    const ColorField color = color_field(settings, state, neighbors, i);
    const double length = glm::length(color.gradient.value);
    const double steepness = length * static_cast<double>(settings.params.support_radius);
    if (!(steepness > static_cast<double>(settings.params.tension_threshold))) {
        return {};
    }
    const double factor = sigma / state.density[i];
    return {-factor * color.laplacian * color.gradient.value / length, factor * color.laplacian_magnitude};
}

VectorSum wall_viscosity_acceleration(const Settings& settings, const State& state, std::size_t i)
{
    const double support_radius = static_cast<double>(settings.params.support_radius);
    const double moment = continuum_scales(settings.kernel, support_radius, settings.dimensions).viscosity /
                          static_cast<double>(settings.params.viscosity_scale);
    const double factor = static_cast<double>(settings.params.wall_viscosity) / (state.density[i] * moment);
    VectorSum sum;
    for_each_wall(settings.params, state.position[i], [&](double distance, const glm::dvec3& normal) {
        sum.add(-factor * wall_viscosity_integral(settings.kernel, distance, support_radius, settings.dimensions) *
                (state.velocity[i] - wall_velocity(settings.params, normal)));
    });
    return sum;
}

VectorSum contact_acceleration(const Settings& settings, const State& state, std::size_t i)
{
    const double reach = static_cast<double>(settings.params.contact_distance);
    const double stiffness = static_cast<double>(settings.params.contact_stiffness);
    const double damping = static_cast<double>(settings.params.contact_damping);
    VectorSum sum;
    for_each_wall(settings.params, state.position[i], [&](double distance, const glm::dvec3& normal) {
        if (distance < reach) {
            const double push = stiffness * (reach - distance) - damping * glm::dot(state.velocity[i], normal);
            sum.add(std::max(0.0, push) * normal);
        }
    });
    return sum;
}

Accelerations accelerations(const Settings& settings, const State& state, const Neighbors& neighbors)
{
    const std::size_t count = state.size();
    Accelerations a;
    for (auto* term : {&a.pressure, &a.viscosity, &a.tension, &a.wall_viscosity, &a.contact, &a.total}) {
        term->resize(count);
    }
    std::vector<std::uint32_t> coincident(count, 0u);
    parallel_for(count, [&](std::size_t i) {
        if (is_boundary(state, i)) {
            return;
        }
        if (settings.solver == shared::SOLVER_WCSPH) { // else pressure and contact come later in the step
            a.pressure[i] = pressure_acceleration(settings, state, neighbors, i);
            a.contact[i] = contact_acceleration(settings, state, i);
        }
        if (!settings.implicit_viscosity) {
            a.viscosity[i] = viscosity_acceleration(settings, state, neighbors, i);
            a.wall_viscosity[i] = wall_viscosity_acceleration(settings, state, i);
        }
        a.tension[i] = tension_acceleration(settings, state, neighbors, i);
        a.total[i].add(glm::dvec3(settings.params.gravity));
        for (const auto* term : {&a.pressure, &a.viscosity, &a.tension, &a.wall_viscosity, &a.contact}) {
            a.total[i].add((*term)[i]);
        }
        for (const Neighbor& neighbor : neighbors.of(i)) {
            coincident[i] += make_pair(settings, state, i, neighbor).coincident ? 1u : 0u;
        }
    });
    a.coincident_pairs = std::accumulate(coincident.begin(), coincident.end(), 0u);
    return a;
}

} // namespace meltpoint::reference
