// Bagnold, The Physics of Blown Sand and Desert Dunes, 1941. Kroy, Sauermann & Herrmann, "Minimal model for sand
// dunes", Phys. Rev. Lett. 88, 2002.
#include "reference/wind.h"

#include <algorithm>
#include <cmath>

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

std::size_t index_of(const SandScene& scene, const glm::ivec2& texel)
{
    return static_cast<std::size_t>(texel.y) * scene.view.width + static_cast<std::size_t>(texel.x);
}

const Ground& ground_at(const SandScene& scene, const glm::ivec2& texel)
{
    return scene.ground[index_of(scene, texel)];
}

/// One of the eight around a texel, k % 3 - 1, k / 3 - 1 away: itself where that is beyond a border.
glm::ivec2 neighbor_of(const Settings& settings, const SandScene& scene, const glm::ivec2& texel, std::uint32_t k)
{
    const shared::VisibilityParams& view = scene.view;
    const glm::ivec2 there = texel + glm::ivec2(k % 3, k / 3) - 1;
    return {inside(there.x, static_cast<int>(view.width), is_periodic_along(settings.params, view.right)),
            inside(there.y, static_cast<int>(view.height), is_periodic_along(settings.params, view.up))};
}

/// Where a particle in the middle of a column is, so many m above the floor.
glm::dvec3 place_in_column(const Settings& settings, const SandScene& scene, const glm::ivec2& texel, double height)
{
    const shared::SphParams& params = settings.params;
    const shared::VisibilityParams& view = scene.view;
    const glm::dvec2 middle = (glm::dvec2(texel) + 0.5) * static_cast<double>(view.texel);
    glm::dvec3 x = glm::dvec3(view.origin) + middle.x * glm::dvec3(view.right) + middle.y * glm::dvec3(view.up);
    x += (height - height_of(scene.wind, x)) * glm::dvec3(scene.wind.up);
    const glm::dvec3 low(params.domain_min);
    const glm::dvec3 high(params.domain_max);
    const double off_walls = 0.5 * static_cast<double>(params.spacing);
    return glm::clamp(x, glm::min(low + off_walls, 0.5 * (low + high)), glm::max(high - off_walls, 0.5 * (low + high)));
}

/// Of what is in the columns at a look.
struct Columns {
    std::vector<std::uint32_t> top_id; ///< of the uppermost particle
    std::vector<std::uint32_t> way;    ///< shared::WAY_*
    std::vector<std::uint32_t> claim;  ///< who comes to lie there
};

glm::ivec2 end_of_way(const Settings& settings, const SandScene& scene, const glm::ivec2& texel, std::uint32_t way)
{
    return neighbor_of(settings, scene, texel, way & 15u);
}

/// m above the floor, of who comes to lie on a column: where its top is, if that is about to leave it.
double next_height(const Settings& settings, const SandScene& scene, const Columns& columns, const glm::ivec2& texel)
{
    const std::size_t here = index_of(scene, texel);
    const std::uint32_t way = columns.way[here];
    bool leaves = way >= shared::WAY_TAKEN;
    if (way < shared::WAY_TAKEN && way != shared::WAY_NONE) {
        leaves = columns.claim[index_of(scene, end_of_way(settings, scene, texel, way))] == columns.top_id[here];
    }
    return ground_at(scene, texel).top + (leaves ? 0.0 : static_cast<double>(settings.params.spacing));
}

/// The steepest way down.
struct WayDown {
    std::uint32_t way = shared::WAY_NONE;
    double drop = 0.0; ///< in spacings
};

/// From so high over a texel, where that is too steep for sand.
WayDown way_down(const Settings& settings, const SandScene& scene, const glm::ivec2& texel, double height,
                 std::uint32_t id, float steepest_ground, float steepest_step)
{
    const glm::dvec3& plane = ground_at(scene, texel).slope;
    const bool on_steep_ground = glm::length(plane) > static_cast<double>(steepest_ground);
    WayDown found;
    double steepest = 0.0;
    const std::uint32_t first = shared::first_way(id);
    for (std::uint32_t turn = 0; turn < 8; ++turn) {
        std::uint32_t k = (first + turn) % 8;
        k += k >= shared::WAY_NONE ? 1 : 0;
        const glm::dvec2 along = glm::dvec2(k % 3, k / 3) - 1.0;
        const double drop = (height - ground_at(scene, neighbor_of(settings, scene, texel, k)).top) /
                            static_cast<double>(settings.params.spacing);
        const double slope = drop / glm::length(along);
        const bool downhill =
            glm::dot(plane, along.x * glm::dvec3(scene.view.right) + along.y * glm::dvec3(scene.view.up)) < 0.0;
        const bool slides = slope > static_cast<double>(steepest_step) ||
                            (on_steep_ground && downhill && drop > static_cast<double>(shared::LEAST_STEP));
        if (slides && slope > steepest + static_cast<double>(shared::EQUAL_STEP)) {
            steepest = slope;
            found = {k, drop};
        }
    }
    return found;
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
            map[static_cast<std::size_t>(inside(y, height, is_periodic_along(settings.params, view.up)) * width +
                                         inside(x, width, is_periodic_along(settings.params, view.right)))];
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

namespace {

/// Whether fluid lies nearer to x than sand may land; along periodic axes also across the border.
bool holds_fluid(const Settings& settings, const State& state, const glm::dvec3& x)
{
    const glm::dvec3 extent(settings.params.domain_max - settings.params.domain_min);
    const double reach = static_cast<double>(shared::ROOM_TO_LAND) * static_cast<double>(settings.params.spacing);
    for (std::size_t j = 0; j < state.size(); ++j) {
        glm::dvec3 way = glm::abs(state.position[j] - x);
        for (int axis = 0; axis < 3; ++axis) {
            if ((settings.params.periodic_mask >> (2 * axis) & 1u) != 0) {
                way[axis] = std::min(way[axis], extent[axis] - way[axis]);
            }
        }
        if (shared::particle_state(state.attributes[j]) == shared::STATE_FLUID && glm::length(way) < reach) {
            return true;
        }
    }
    return false;
}

} // namespace

SandChanges look_at_sand(const Settings& settings, const SandScene& scene, State& state, SandState& sand,
                         std::span<const glm::dvec4> exposure, std::span<const double> visibility, double seconds,
                         double ahead, bool slides)
{
    const shared::WindParams& wind = scene.wind;
    const std::size_t texels = scene.ground.size();
    constexpr std::uint32_t nobody = 0xffffffffu;
    Columns columns{.top_id = std::vector(texels, nobody),
                    .way = std::vector(texels, shared::WAY_NONE),
                    .claim = std::vector(texels, nobody)};
    const auto is_solid = [&](std::size_t i) {
        return shared::particle_state(state.attributes[i]) == shared::STATE_SOLID;
    };
    const auto material = [&](std::size_t i) -> const shared::WindMaterial& {
        return wind.of[shared::particle_material(state.attributes[i])];
    };
    const auto here = [&](std::size_t i) {
        return texel_at(scene, state.position[i]);
    };
    // Who is on top.
    for (std::size_t i = 0; i < state.size(); ++i) {
        const std::size_t texel = index_of(scene, here(i));
        const double depth = ground_at(scene, here(i)).top - height_of(wind, state.position[i]);
        if (is_solid(i) && std::abs(depth) * static_cast<double>(scene.view.depth_scale) < 1.5) {
            columns.top_id[texel] = std::min(columns.top_id[texel], state.id[i]);
        }
    }
    // The wind takes.
    SandChanges changes;
    for (std::size_t i = 0; i < state.size(); ++i) {
        const shared::WindMaterial& its = material(i);
        if (!is_solid(i) || its.erodes == 0) {
            continue;
        }
        const double along = glm::dot(ground_at(scene, here(i)).slope, glm::dvec3(wind.direction));
        const double stress = static_cast<double>(shared::stress_on_slope(static_cast<float>(along)));
        const bool faces_up = glm::dot(glm::dvec3(exposure[i]), glm::dvec3(wind.up)) > 0.0;
        const double share = stress > static_cast<double>(its.threshold) && faces_up ? std::pow(stress, 1.5) : 0.0;
        double& damage = sand.damage[state.id[i]];
        const double taken =
            static_cast<double>(its.pick_up) * share * visibility[i] * exposure[i].w * seconds / state.mass[i];
        damage += taken;
        if (damage + ahead * taken >= 1.0 && columns.top_id[index_of(scene, here(i))] == state.id[i]) {
            state.attributes[i] = shared::freed_as(state.attributes[i], shared::STATE_DUST, shared::CAUSE_WIND);
            state.velocity[i] = static_cast<double>(its.launch_speed) *
                                static_cast<double>(shared::launch_share(state.id[i])) * glm::dvec3(wind.up);
            state.weight[i] = 0.0;
            damage = 0.0;
            columns.way[index_of(scene, here(i))] = shared::WAY_TAKEN;
            ++changes.picked_up;
        }
    }
    // Who is to be where: what has come down, and what slides.
    const auto has_come_down = [&](std::size_t i) {
        return shared::is_flying_sand(state.attributes[i]) && sand.rests[state.id[i]] != 0;
    };
    const auto claim = [&](const glm::ivec2& texel, std::uint32_t id) {
        std::uint32_t& smallest = columns.claim[index_of(scene, texel)];
        smallest = std::min(smallest, id);
    };
    const double d = static_cast<double>(settings.params.spacing);
    for (std::size_t i = 0; i < state.size(); ++i) {
        const glm::ivec2 texel = here(i);
        const std::uint32_t id = state.id[i];
        const double top = ground_at(scene, texel).top;
        if (has_come_down(i)) {
            const bool is_gentle =
                glm::length(ground_at(scene, texel).slope) < static_cast<double>(shared::GENTLE_SLOPE);
            const float steepest_step = shared::STEEPEST_STEP + (is_gentle ? 0.0f : 1.0f);
            const WayDown down = way_down(settings, scene, texel, top + d, id, shared::ANY_SLOPE, steepest_step);
            if (down.way == shared::WAY_NONE) {
                claim(texel, id);
            } else { // rolls on
                const glm::ivec2 there = neighbor_of(settings, scene, texel, down.way);
                const bool falls = down.drop > static_cast<double>(shared::HIGHEST_SLIDE);
                state.position[i] =
                    place_in_column(settings, scene, there, falls ? top + d : ground_at(scene, there).top + d);
                sand.rests[id] = falls ? 0 : 1;
                ++changes.rolled;
            }
        } else if (slides && is_solid(i) && material(i).erodes != 0 && columns.top_id[index_of(scene, texel)] == id) {
            const WayDown down = way_down(settings, scene, texel, top, id, material(i).steepest, shared::STEEPEST_STEP);
            const bool falls = down.drop > static_cast<double>(shared::HIGHEST_SLIDE);
            columns.way[index_of(scene, texel)] = down.way + (falls ? shared::WAY_FALLS : 0);
            if (down.way != shared::WAY_NONE && !falls) {
                claim(neighbor_of(settings, scene, texel, down.way), id);
            }
        }
    }
    // They are there.
    const State before = state;
    for (std::size_t i = 0; i < state.size(); ++i) {
        const glm::ivec2 texel = texel_at(scene, before.position[i]);
        const std::uint32_t id = state.id[i];
        if (has_come_down(i) && columns.claim[index_of(scene, texel)] == id) {
            const glm::dvec3 place =
                place_in_column(settings, scene, texel, next_height(settings, scene, columns, texel));
            if (holds_fluid(settings, state, place)) {
                continue;
            }
            state.position[i] = place;
            state.attributes[i] = shared::with_state(state.attributes[i], shared::STATE_SOLID);
            state.velocity[i] = glm::dvec3(0.0);
            state.weight[i] = 1.0;
            sand.rests[id] = 0;
            ++changes.landed;
            continue;
        }
        const std::uint32_t way = columns.way[index_of(scene, texel)];
        if (!is_solid(i) || columns.top_id[index_of(scene, texel)] != id || way == shared::WAY_NONE) {
            continue;
        }
        const glm::ivec2 there = end_of_way(settings, scene, texel, way);
        if (way >= shared::WAY_FALLS) {
            state.position[i] = place_in_column(settings, scene, there, ground_at(scene, texel).top);
            state.attributes[i] = shared::freed_as(state.attributes[i], shared::STATE_DUST, shared::CAUSE_WIND);
            state.weight[i] = 0.0;
            ++changes.fell;
        } else if (columns.claim[index_of(scene, there)] == id) {
            state.position[i] = place_in_column(settings, scene, there, next_height(settings, scene, columns, there));
            ++changes.slid;
        }
    }
    return changes;
}

void move_sand(const Settings& settings, const SandScene& scene, State& state, SandState& sand)
{
    const shared::SphParams& params = settings.params;
    const shared::WindParams& wind = scene.wind;
    const double dt = static_cast<double>(params.dt);
    const double d = static_cast<double>(params.spacing);
    const glm::dvec3 up(wind.up);
    const auto top_at = [&](const glm::dvec3& x) {
        return ground_at(scene, texel_at(scene, x)).top;
    };
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (!shared::is_flying_sand(state.attributes[i]) || sand.rests[state.id[i]] != 0) {
            continue;
        }
        const shared::WindMaterial& its = wind.of[shared::particle_material(state.attributes[i])];
        const glm::dvec3 x = state.position[i];
        glm::dvec3 v = state.velocity[i];
        const double response = static_cast<double>(its.response_time);
        const double above = height_of(wind, x) - ground_at(scene, texel_at(scene, x)).height - 0.5 * d;
        v += -std::expm1(-dt / response) * (air_velocity(wind, above) + response * glm::dvec3(params.gravity) - v);

        glm::dvec3 next = wrap_position(params, x + dt * v);
        next += std::max(0.5 * d - height_of(wind, next), 0.0) * up;
        if (top_at(next) > height_of(wind, next) + static_cast<double>(shared::HIGHEST_CLIMB) * d) {
            v = glm::dot(v, up) * up;
            next = x + dt * v;
        }
        for_each_wall(params, next, [&](double distance, const glm::dvec3& normal) {
            if (distance < 0.0) {
                next -= distance * normal;
                v -= glm::dot(v, normal) * normal;
            }
        });
        const bool inside = glm::all(glm::greaterThanEqual(next, glm::dvec3(params.domain_min))) &&
                            glm::all(glm::lessThanEqual(next, glm::dvec3(params.domain_max)));
        const double lowest = top_at(next) + d;
        const bool lands = inside && height_of(wind, next) <= lowest && glm::dot(v, up) <= 0.0;
        next += lands ? (lowest - height_of(wind, next)) * up : glm::dvec3(0.0);
        state.position[i] = inside ? next : x;
        state.velocity[i] = lands ? glm::dvec3(0.0) : v;
        state.density[i] = lands ? 1.0 : static_cast<double>(shared::FLYING_VOLUME);
        sand.rests[state.id[i]] = lands ? 1 : 0;
        if (!inside) {
            state.attributes[i] = shared::with_state(state.attributes[i], shared::STATE_DEAD);
        }
    }
}

} // namespace meltpoint::reference
