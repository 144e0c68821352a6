// Brackbill, Kothe & Zemach, "A continuum method for modeling surface tension", J. Comput. Phys. 100, 1992; Morris,
// "Simulating surface tension with smoothed particle hydrodynamics", Int. J. Numer. Meth. Fluids 33, 2000. What is ours
// in it: shared/capillarity.h.
#include "reference/capillarity.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel_for.h"
#include "particles/sph_kernel.h"
#include "reference/walls.h"
#include "shared/capillarity.h"

namespace meltpoint::reference {
namespace {

double volume(const Settings& settings, const State& state, std::size_t i)
{
    return is_boundary(state, i) ? state.weight[i] * static_cast<double>(settings.params.lattice_volume)
                                 : state.mass[i] / state.density[i];
}

double tension_of(const Settings& settings, const State& state, std::size_t i)
{
    return is_boundary(state, i)
               ? 0.0
               : static_cast<double>(settings.params.tension[shared::particle_material(state.attributes[i])]);
}

/// A pair as particle i sees it.
struct Pair {
    glm::dvec3 offset; ///< from j, or its image, to i, m
    double r;
    double q;
    bool coincident;
};

Pair make_pair(const Settings& settings, const State& state, std::size_t i, const Neighbor& neighbor)
{
    const glm::dvec3 offset =
        state.position[i] - reflect_position(settings.params, neighbor.reflection, state.position[neighbor.index]);
    const double r = glm::length(offset);
    const double q = r / static_cast<double>(settings.params.support_radius);
    return {.offset = offset, .r = r, .q = q, .coincident = q < static_cast<double>(shared::COINCIDENT_RATIO)};
}

/// Mirrors show no normals, periodic borders do.
bool shows_normals(Reflection reflection)
{
    return reflect_velocity(reflection, glm::dvec3(1.0)) == glm::dvec3(1.0);
}

/// A solid as the fluid near it sees it.
struct Solid {
    glm::dvec3 normal{0.0}; ///< unit, into the fluid
    double closeness = 0.0; ///< 1 of the layer that touches it, 0 of those beyond the next
    double cosine = 0.0;    ///< of the contact angle
};

Solid nearest_wall(const shared::SphParams& params, const glm::dvec3& x)
{
    Solid solid{.cosine = static_cast<double>(params.wall_contact_cosine)};
    double nearest = std::numeric_limits<double>::infinity();
    for_each_wall(params, x, [&](double distance, const glm::dvec3& normal) {
        if (distance < nearest) {
            nearest = distance;
            solid.normal = normal;
        }
    });
    solid.closeness = std::clamp(
        static_cast<double>(shared::CONTACT_REACH) - nearest / static_cast<double>(params.spacing), 0.0, 1.0);
    return solid;
}

glm::dvec3 unit(const glm::dvec3& v)
{
    const double length = glm::length(v);
    return length > 0.0 ? v / length : glm::dvec3(0.0);
}

/// Turns the gradient into the solid's plane, and the normal to the contact angle (Brackbill et al. 1992, section 5). A
/// share of what the gradient should be lies beyond the solid, where nothing adds to it.
void meet(const Solid& solid, double share_beyond, SurfaceNormal& surface)
{
    const glm::dvec3 along = surface.gradient - glm::dot(surface.gradient, solid.normal) * solid.normal;
    const double sine = std::sqrt(std::max(1.0 - solid.cosine * solid.cosine, 0.0));
    const glm::dvec3 at_contact = sine * unit(along) - solid.cosine * solid.normal;
    surface.gradient = glm::mix(surface.gradient, along / (1.0 - share_beyond), solid.closeness);
    const glm::dvec3 mixed = glm::mix(unit(surface.normal), at_contact, solid.closeness);
    surface.normal = glm::length(surface.gradient) * unit(mixed);
}

double surface_share(const Settings& settings, const glm::dvec3& normal)
{
    const double steepness = glm::length(normal) * static_cast<double>(settings.params.support_radius);
    const double inside = static_cast<double>(shared::INSIDE_STEEPNESS);
    return std::clamp((steepness - inside) / (static_cast<double>(shared::SURFACE_STEEPNESS) - inside), 0.0, 1.0);
}

/// 0 in the fluid and at its surfaces, 1 of a particle with next to no neighbors.
double looseness(const Settings& settings, double volume)
{
    const double loose = static_cast<double>(shared::LOOSE_FILLING);
    const double filling = static_cast<double>(settings.params.lattice_volume) / volume;
    return std::clamp((loose - filling) / (loose - static_cast<double>(shared::LEAST_FILLING)), 0.0, 1.0);
}

/// 1/m, of a drop one support radius in radius: finer ones are not resolved.
double largest_curvature(const Settings& settings)
{
    return (settings.dimensions - 1.0) / static_cast<double>(settings.params.support_radius);
}

/// 1/m, of the surface, from that of the parallel surface at the particle.
double surface_curvature(const Settings& settings, double below, const glm::dvec3& normal)
{
    const shared::SphParams& params = settings.params;
    const double spacing = static_cast<double>(params.spacing);
    const double first = static_cast<double>(params.first_layer_steepness);
    const double second = static_cast<double>(params.second_layer_steepness);
    const double steepness = glm::length(normal) * static_cast<double>(params.support_radius);
    const double depth = spacing * (0.5 + std::clamp((first - steepness) / (first - second), 0.0, 1.0));
    const double curvature = below / (1.0 + std::max(below * depth / (settings.dimensions - 1.0), -0.5));
    const double most = largest_curvature(settings);
    return std::clamp(curvature, -most, most);
}

} // namespace

SurfaceNormal surface_normal(const Settings& settings, const State& state, const Neighbors& neighbors, std::size_t i)
{
    const shared::SphParams& params = settings.params;
    const double sigma = tension_of(settings, state, i);
    if (!(sigma > 0.0)) {
        return {};
    }
    const double scale = static_cast<double>(params.lattice_volume) * static_cast<double>(params.gradient_scale);
    VectorSum gradient;
    glm::dvec3 solids(0.0);
    double cosines = 0.0;
    double shares = 0.0;
    for (const Neighbor& neighbor : neighbors.of(i)) {
        const std::size_t j = neighbor.index;
        const Pair pair = make_pair(settings, state, i, neighbor);
        if (pair.coincident) {
            continue;
        }
        const double share = state.weight[j] * scale * gradient_shape(settings.kernel, pair.q) / pair.r;
        gradient.add(-share * pair.offset);
        if (is_boundary(state, j)) {
            solids -= share * pair.offset;
            cosines +=
                share * static_cast<double>(params.contact_cosine[shared::particle_material(state.attributes[j])]);
            shares += share;
        }
    }
    SurfaceNormal surface{
        .gradient = gradient.value, .normal = gradient.value, .magnitude = gradient.magnitude, .sigma = sigma};
    if (shares > 0.0) {
        const double steepness = glm::length(solids) * static_cast<double>(params.support_radius);
        meet({.normal = -unit(solids), .closeness = std::min(steepness, 1.0), .cosine = cosines / shares},
             static_cast<double>(params.share_beyond_solid), surface);
    }
    meet(nearest_wall(params, state.position[i]), 0.0, surface);
    return surface;
}

VectorSum smooth_normal(const Settings& settings, const State& state, const Neighbors& neighbors,
                        const std::vector<glm::dvec3>& normals, const std::vector<double>& sigma, std::size_t i)
{
    VectorSum sum;
    double weight = 0.0;
    const auto add = [&](std::size_t j, double q) {
        const double share = density_shape(settings.kernel, q);
        sum.add(share * normals[j]);
        weight += share;
    };
    add(i, 0.0);
    for (const Neighbor& neighbor : neighbors.of(i)) {
        if (sigma[neighbor.index] > 0.0 && shows_normals(neighbor.reflection)) {
            add(neighbor.index, make_pair(settings, state, i, neighbor).q);
        }
    }
    return {sum.value / weight, sum.magnitude / weight};
}

VectorSum capillary_acceleration(const Settings& settings, const State& state, const Neighbors& neighbors,
                                 const std::vector<SurfaceNormal>& surface, const std::vector<glm::dvec3>& normals,
                                 std::size_t i)
{
    const shared::SphParams& params = settings.params;
    const double spacing = static_cast<double>(params.spacing);
    const double crowding_distance = static_cast<double>(shared::CROWDING_DISTANCE) * spacing;
    const double support_radius = static_cast<double>(params.support_radius);
    const double loose = looseness(settings, volume(settings, state, i));
    const double crowding = static_cast<double>(params.lattice_volume) / (spacing * spacing);
    const glm::dvec3 outward = -unit(normals[i]);
    const double at_surface = surface_share(settings, normals[i]);
    double turning = 0.0;
    double turning_magnitude = 0.0;
    double spread = 0.0;
    double spread_along = 0.0;
    VectorSum force;
    for (const Neighbor& neighbor : neighbors.of(i)) {
        const std::size_t j = neighbor.index;
        if (!(surface[j].sigma > 0.0)) {
            continue;
        }
        const Pair pair = make_pair(settings, state, i, neighbor);
        if (shows_normals(neighbor.reflection)) {
            const double w = surface_share(settings, normals[j]) * (1.0 - pair.q) * (1.0 - pair.q);
            const double across = glm::dot(pair.offset, outward);
            turning -= w * glm::dot(-unit(normals[j]) - outward, pair.offset);
            turning_magnitude += 2.0 * w * pair.r;
            spread += w * pair.r * pair.r;
            spread_along += w * (pair.r * pair.r - across * across);
        }
        const double sigma = 0.5 * (surface[i].sigma + surface[j].sigma);
        if (!pair.coincident) {
            const double apart = std::clamp((pair.r - spacing) / (support_radius - spacing), 0.0, 1.0);
            const double cling =
                std::max(loose, looseness(settings, volume(settings, state, j))) * 4.0 * apart * (1.0 - apart);
            const double push = sigma * crowding * (std::max(1.0 - pair.r / crowding_distance, 0.0) - cling);
            force.add(push / pair.r * pair.offset);
        }
        const double density = 0.5 * (state.density[i] + state.density[j]);
        const double drag = static_cast<double>(shared::SURFACE_DRAG) * std::sqrt(sigma * density * spacing) *
                            std::max(at_surface, surface_share(settings, normals[j]));
        const double laplacian = static_cast<double>(params.viscosity_scale) * viscosity_shape(settings.kernel, pair.q);
        force.add(drag * volume(settings, state, i) * volume(settings, state, j) * laplacian *
                  (reflect_velocity(neighbor.reflection, state.velocity[j]) - state.velocity[i]));
    }
    const double along = std::max(spread_along, static_cast<double>(shared::LEAST_SPREAD) * spread);
    const double to_curvature = along > 0.0 ? (settings.dimensions - 1.0) / along : 0.0;
    const double curvature = at_surface * surface_curvature(settings, to_curvature * turning, normals[i]);
    const glm::dvec3 pull = 2.0 * surface[i].sigma / state.density[i] * surface[i].gradient;
    const double certainty = std::min(to_curvature * turning_magnitude, largest_curvature(settings));
    VectorSum a{curvature * pull, at_surface * certainty * glm::length(pull)};
    a.add(VectorSum{force.value / state.mass[i], force.magnitude / state.mass[i]});
    return a;
}

bool has_tension(const Settings& settings)
{
    return std::ranges::any_of(settings.params.tension, [](float sigma) { return sigma > 0.0f; });
}

void add_capillarity(const Settings& settings, State& state, const Neighbors& neighbors)
{
    if (!has_tension(settings)) {
        return;
    }
    std::vector<SurfaceNormal> surface(state.size());
    std::vector<glm::dvec3> normals(state.size());
    std::vector<double> sigma(state.size());
    parallel_for(state.size(), [&](std::size_t i) {
        surface[i] = surface_normal(settings, state, neighbors, i);
        normals[i] = surface[i].normal;
        sigma[i] = surface[i].sigma;
    });
    for (std::uint32_t smoothing = 0; smoothing < shared::NORMAL_SMOOTHINGS; ++smoothing) {
        const std::vector<glm::dvec3> before = normals;
        parallel_for(state.size(), [&](std::size_t i) {
            if (sigma[i] > 0.0) {
                normals[i] = smooth_normal(settings, state, neighbors, before, sigma, i).value;
            }
        });
    }
    parallel_for(state.size(), [&](std::size_t i) {
        if (sigma[i] > 0.0) {
            state.acceleration[i] += capillary_acceleration(settings, state, neighbors, surface, normals, i).value;
        }
    });
}

} // namespace meltpoint::reference
