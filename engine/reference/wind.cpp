// Bagnold, The Physics of Blown Sand and Desert Dunes, 1941. Kroy, Sauermann & Herrmann, "Minimal model for sand
// dunes", Phys. Rev. Lett. 88, 2002.
#include "reference/wind.h"

#include <algorithm>
#include <cmath>

#include "particles/sph_kernel.h"
#include "reference/walls.h"

namespace meltpoint::reference {

namespace {

double height_of(const shared::WindParams& wind, const glm::dvec3& x)
{
    return glm::dot(x, glm::dvec3(wind.up)) - static_cast<double>(wind.floor_height);
}

glm::ivec2 texel_at(const SandScene& scene, const glm::dvec3& x)
{
    const glm::dvec3 offset = (x - glm::dvec3(scene.view.origin)) / static_cast<double>(scene.view.texel);
    const glm::ivec2 size(scene.view.width, scene.view.height);
    const glm::dvec2 place(glm::dot(offset, glm::dvec3(scene.view.right)), glm::dot(offset, glm::dvec3(scene.view.up)));
    return glm::clamp(glm::ivec2(glm::floor(place)), glm::ivec2(0), size - 1);
}

const Ground& ground_at(const SandScene& scene, const glm::dvec3& x)
{
    const glm::ivec2 texel = texel_at(scene, x);
    return scene.ground[static_cast<std::size_t>(texel.y) * scene.view.width + static_cast<std::size_t>(texel.x)];
}

/// Along a unit vector that is an axis or its opposite.
bool is_periodic_along(const Settings& settings, const glm::vec3& along)
{
    for (int axis = 0; axis < 3; ++axis) {
        if (std::abs(along[axis]) > 0.5f && (settings.params.periodic_mask >> (2 * axis) & 1u) != 0) {
            return true;
        }
    }
    return false;
}

/// A texel beyond the map's border: that at the border, or, where space is periodic, at the other one.
int inside(int i, int count, bool is_periodic)
{
    return is_periodic ? (i + count) % count : std::clamp(i, 0, count - 1);
}

/// The gradient of the ground along the steepest of eight ways down from x; zero where all lead up.
glm::dvec3 steepest_fall(const Settings& settings, const SandScene& scene, const glm::dvec3& x)
{
    const shared::VisibilityParams& view = scene.view;
    const auto width = static_cast<int>(view.width);
    const glm::ivec2 here = texel_at(scene, x);
    glm::dvec3 steepest(0.0);
    for (int k = 0; k < 9; ++k) {
        if (k == 4) {
            continue; // no way at all
        }
        const glm::ivec2 way = shared::FALL_REACH * glm::ivec2(k % 3 - 1, k / 3 - 1);
        const int there_x = inside(here.x + way.x, width, is_periodic_along(settings, view.right));
        const int there_y = inside(here.y + way.y, static_cast<int>(view.height), is_periodic_along(settings, view.up));
        const double drop =
            ground_at(scene, x).top - scene.ground[static_cast<std::size_t>(there_y * width + there_x)].top;
        const glm::dvec3 along =
            static_cast<double>(way.x) * glm::dvec3(view.right) + static_cast<double>(way.y) * glm::dvec3(view.up);
        const double slope = drop / (glm::length(along) * static_cast<double>(view.texel));
        if (slope > glm::length(steepest) + static_cast<double>(shared::EQUAL_FALL)) {
            steepest = -slope * glm::normalize(along);
        }
    }
    return steepest;
}

/// Of a position and all its images, the sum of body(offset from particle j to it, the image's reflection).
template <class Body>
void for_each_image(const Settings& settings, const glm::dvec3& x, const Body& body)
{
    const shared::SphParams& params = settings.params;
    for (int side = 0; side < 27; ++side) {
        Reflection reflection = 0;
        bool is_there = true;
        for (int axis = 0; axis < 3; ++axis) {
            const int which = axis == 0 ? side % 3 : (axis == 1 ? side / 3 % 3 : side / 9);
            if (which == 0) {
                continue;
            }
            const std::uint32_t border = 1u << (2 * axis + which - 1);
            const bool is_periodic = (params.periodic_mask & border) != 0;
            is_there = is_there && (((params.wall_mask | params.periodic_mask) & border) != 0);
            reflection |= border | (is_periodic ? 1u << (6 + axis) : 0u);
        }
        if (is_there) {
            body(reflect_position(params, reflection, x), reflection);
        }
    }
}

double filling_of(const Settings& settings, double r)
{
    const double q = r / static_cast<double>(settings.params.support_radius);
    return static_cast<double>(settings.params.lattice_volume) * static_cast<double>(settings.params.density_scale) *
           density_shape(settings.kernel, q);
}

/// Half a spacing off them at least.
glm::dvec3 held_by_walls(const shared::SphParams& params, glm::dvec3 x)
{
    const double distance = 0.5 * static_cast<double>(params.spacing);
    for (int border = 0; border < 6; ++border) {
        if ((params.wall_mask >> border & 1u) != 0) {
            const int axis = border / 2;
            x[axis] = border % 2 == 0 ? std::max(x[axis], static_cast<double>(params.domain_min[axis]) + distance)
                                      : std::min(x[axis], static_cast<double>(params.domain_max[axis]) - distance);
        }
    }
    return x;
}

bool is_sand(std::uint32_t attributes)
{
    return shared::particle_state(attributes) == shared::STATE_DUST && !shared::is_drifting(attributes);
}

glm::dvec3 air_velocity(const shared::WindParams& wind, double above_ground)
{
    return static_cast<double>(wind.friction_velocity) / static_cast<double>(shared::KARMAN) *
           std::log(std::max(above_ground / static_cast<double>(wind.roughness_length), 1.0)) *
           glm::dvec3(wind.direction);
}

} // namespace

std::vector<Ground> ground(const Settings& settings, const shared::VisibilityParams& view,
                           std::span<const std::uint32_t> map)
{
    const auto width = static_cast<int>(view.width);
    const auto height = static_cast<int>(view.height);
    const auto top_of = [&](int x, int y) {
        const std::uint32_t depth =
            map[static_cast<std::size_t>(inside(y, height, is_periodic_along(settings, view.up)) * width +
                                         inside(x, width, is_periodic_along(settings, view.right)))];
        return depth == shared::NOTHING_SEEN
                   ? -0.5 * static_cast<double>(view.spacing)
                   : (static_cast<double>(shared::DEPTH_STEPS) - depth) / static_cast<double>(view.depth_scale);
    };
    std::vector<Ground> planes;
    for (int i = 0; i < width * height; ++i) {
        double sum = 0.0;
        glm::dvec2 rise(0.0);
        glm::dvec2 squares(0.0);
        int texels = 0;
        for (int y = -shared::GROUND_REACH; y <= shared::GROUND_REACH; ++y) {
            for (int x = -shared::GROUND_REACH; x <= shared::GROUND_REACH; ++x) {
                const double top = top_of(i % width + x, i / width + y);
                sum += top;
                rise += top * glm::dvec2(x, y);
                squares += glm::dvec2(x * x, y * y);
                ++texels;
            }
        }
        const glm::dvec2 slope = rise / squares / static_cast<double>(view.texel);
        planes.push_back({.height = sum / texels,
                          .slope = slope.x * glm::dvec3(view.right) + slope.y * glm::dvec3(view.up),
                          .top = top_of(i % width, i / width)});
    }
    return planes;
}

std::size_t erode_by_wind(const Settings& settings, const SandScene& scene, State& state, SandState& sand,
                          std::span<const glm::dvec4> exposure, std::span<const double> visibility, double seconds)
{
    const shared::WindParams& wind = scene.wind;
    std::size_t freed = 0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        const shared::WindMaterial& its = wind.of[shared::particle_material(state.attributes[i])];
        if (shared::particle_state(state.attributes[i]) != shared::STATE_SOLID || its.erodes == 0) {
            continue;
        }
        const Ground& below = ground_at(scene, state.position[i]);
        const double along = glm::dot(below.slope, glm::dvec3(wind.direction));
        const double stress = static_cast<double>(shared::stress_on_slope(static_cast<float>(along)));
        const bool faces_up = glm::dot(glm::dvec3(exposure[i]), glm::dvec3(wind.up)) > 0.0;
        const double share = stress > static_cast<double>(its.threshold) && faces_up ? std::pow(stress, 1.5) : 0.0;
        double& damage = sand.damage[state.id[i]];
        damage += static_cast<double>(its.pick_up) * share * visibility[i] * exposure[i].w * seconds / state.mass[i];
        const bool is_top =
            height_of(wind, state.position[i]) >
            below.top - static_cast<double>(shared::COVERED) * static_cast<double>(settings.params.spacing);
        const bool hops = is_top && damage >= 1.0;
        if (hops) {
            state.attributes[i] = shared::freed_as(state.attributes[i], shared::STATE_DUST, shared::CAUSE_WIND);
            state.velocity[i] = static_cast<double>(its.launch_speed) *
                                static_cast<double>(shared::launch_share(state.id[i])) * glm::dvec3(wind.up);
            damage = 0.0;
        } else if (is_top &&
                   glm::length(steepest_fall(settings, scene, state.position[i])) > static_cast<double>(its.steepest)) {
            state.attributes[i] = shared::freed_as(state.attributes[i], shared::STATE_DUST, shared::CAUSE_SLIDE);
            state.velocity[i] = glm::dvec3(0.0);
        } else {
            continue;
        }
        state.weight[i] = 0.0;
        ++freed;
    }
    return freed;
}

glm::dvec2 solid_around(const Settings& settings, const shared::WindParams& wind, const State& state,
                        const glm::dvec3& x)
{
    glm::dvec2 sum(0.0);
    for_each_image(settings, x, [&](const glm::dvec3& image, Reflection reflection) {
        const glm::dvec3 up = reflect_velocity(reflection, glm::dvec3(wind.up));
        for (std::size_t j = 0; j < state.size(); ++j) {
            if (!shared::is_still(state.attributes[j]) || shared::is_gone(state.attributes[j])) {
                continue;
            }
            const glm::dvec3 offset = image - state.position[j];
            const double r = glm::length(offset);
            const double filling = state.weight[j] * filling_of(settings, r);
            sum += filling * glm::dvec2(1.0, r > 0.0 ? std::max(glm::dot(offset, up), 0.0) / r : 0.0);
        }
    });
    return sum;
}

void move_sand(const Settings& settings, const SandScene& scene, State& state, SandState& sand)
{
    const shared::SphParams& params = settings.params;
    const shared::WindParams& wind = scene.wind;
    const double dt = static_cast<double>(params.dt);
    const double d = static_cast<double>(params.spacing);
    const glm::dvec3 up(wind.up);
    const glm::dvec3 gravity(params.gravity);
    const double rest_support = static_cast<double>(wind.rest_support);
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (!is_sand(state.attributes[i])) {
            continue;
        }
        const shared::WindMaterial& its = wind.of[shared::particle_material(state.attributes[i])];
        const bool hops = shared::cause_of(state.attributes[i]) == shared::CAUSE_WIND;
        glm::dvec3 x = state.position[i];
        glm::dvec3 v = state.velocity[i];
        if (hops) {
            const double response = static_cast<double>(its.response_time);
            const double above = height_of(wind, x) - ground_at(scene, x).height - 0.5 * d;
            v += -std::expm1(-dt / response) * (air_velocity(wind, above) + response * gravity - v);
        } else {
            v += dt * gravity;
        }
        x = wrap_position(params, x + dt * v);
        x = hops ? x : held_by_walls(params, x);
        const double under_floor = 0.5 * d - height_of(wind, x);
        x += std::max(under_floor, 0.0) * up;

        const Ground& below = ground_at(scene, x);
        const glm::dvec3 fall = steepest_fall(settings, scene, x);
        const glm::dvec3 n = glm::normalize(up - fall);
        const glm::dvec2 around = solid_around(settings, wind, state, x);
        const bool touches = under_floor >= 0.0 || around.y >= rest_support;
        const bool runs_into_ground = height_of(wind, x) < below.height - static_cast<double>(shared::BURIED) * d;
        const bool lands = hops && (runs_into_ground || (touches && glm::dot(v, up) < 0.0));
        v = lands ? glm::dvec3(0.0) : v;
        bool at_rest = false;
        if (!hops && touches) {
            const double against = std::max(-glm::dot(v, n), 0.0);
            v += against * n;
            const glm::dvec3 along = v - glm::dot(v, n) * n;
            const double speed = glm::length(along);
            v -= speed > 0.0 ? along * std::min(static_cast<double>(its.friction) * against / speed, 1.0) : along;
            v *= std::min(static_cast<double>(wind.slide_speed) / std::max(glm::length(v), 1e-30), 1.0);
            at_rest = glm::length(v) < static_cast<double>(wind.rest_speed) &&
                      glm::length(fall) < static_cast<double>(its.friction);
        }
        if (!hops) {
            const bool crowded = around.x + static_cast<double>(wind.own_filling) > 1.0;
            const double push = crowded ? 1.0 : std::clamp(around.y / rest_support - 1.0, 0.0, 1.0);
            x = held_by_walls(params,
                              wrap_position(params, x + push * static_cast<double>(shared::LONGEST_PUSH) * d * n));
        }
        const bool inside = glm::all(glm::greaterThanEqual(x, glm::dvec3(params.domain_min))) &&
                            glm::all(glm::lessThanEqual(x, glm::dvec3(params.domain_max)));
        state.position[i] = inside ? x : state.position[i];
        state.velocity[i] = v;
        state.density[i] = hops && !lands ? static_cast<double>(shared::FLYING_VOLUME) : 1.0;
        sand.rests[state.id[i]] = at_rest && inside ? 1 : 0;
        if (lands) {
            state.attributes[i] = shared::freed_as(state.attributes[i], shared::STATE_DUST, shared::CAUSE_SLIDE);
        }
        if (!inside) {
            state.attributes[i] = shared::with_state(state.attributes[i], shared::STATE_DEAD);
        }
    }
}

std::size_t land_sand(const Settings& settings, const shared::WindParams& wind, State& state, SandState& sand)
{
    const auto rests = [&](std::size_t i) {
        return is_sand(state.attributes[i]) && shared::cause_of(state.attributes[i]) == shared::CAUSE_SLIDE &&
               sand.rests[state.id[i]] != 0;
    };
    std::vector<std::size_t> landed;
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (!rests(i)) {
            continue;
        }
        double filling = solid_around(settings, wind, state, state.position[i]).x;
        for_each_image(settings, state.position[i], [&](const glm::dvec3& image, Reflection) {
            for (std::size_t j = 0; j < state.size(); ++j) {
                if (state.id[j] < state.id[i] && rests(j)) {
                    filling += filling_of(settings, glm::distance(image, state.position[j]));
                }
            }
        });
        if (filling + static_cast<double>(wind.own_filling) <= 1.0) {
            landed.push_back(i);
        }
    }
    for (const std::size_t i : landed) {
        sand.rests[state.id[i]] = 0;
        state.attributes[i] = shared::with_state(state.attributes[i], shared::STATE_SOLID);
        state.weight[i] = 1.0;
        state.velocity[i] = glm::dvec3(0.0);
    }
    return landed.size();
}

} // namespace meltpoint::reference
