// Williams, "Casting Curved Shadows on Curved Surfaces", SIGGRAPH 1978. Reeves, Salesin & Cook, "Rendering Antialiased
// Shadows with Depth Maps", SIGGRAPH 1987.
#include "reference/visibility.h"

#include <algorithm>
#include <cmath>

namespace meltpoint::reference {

namespace {

/// In texels along the map's rows and across them, and the depth in m.
glm::dvec3 map_place(const shared::VisibilityParams& params, const glm::dvec3& x)
{
    const glm::dvec3 offset = x - glm::dvec3(params.origin);
    const auto texel = static_cast<double>(params.texel);
    return {glm::dot(offset, glm::dvec3(params.right)) / texel, glm::dot(offset, glm::dvec3(params.up)) / texel,
            glm::dot(offset, glm::dvec3(params.direction))};
}

} // namespace

std::vector<std::uint32_t> depth_map(const shared::VisibilityParams& params, const State& state)
{
    std::vector<std::uint32_t> map(std::size_t{params.width} * params.height, shared::NOTHING_SEEN);
    const double radius = static_cast<double>(shared::CASTER_RADIUS) * static_cast<double>(params.spacing) /
                          static_cast<double>(params.texel);
    for (std::size_t i = 0; i < state.size(); ++i) {
        if ((params.casters >> shared::particle_state(state.attributes[i]) & 1u) == 0u) {
            continue;
        }
        const glm::dvec3 place = map_place(params, state.position[i]);
        const double steps = std::clamp(place.z * static_cast<double>(params.depth_scale), 0.0,
                                        static_cast<double>(shared::DEPTH_STEPS - 1));
        const glm::ivec2 first = glm::max(glm::ivec2(glm::floor(glm::dvec2(place) - radius)), 0);
        const glm::ivec2 last =
            glm::min(glm::ivec2(glm::floor(glm::dvec2(place) + radius)), glm::ivec2(params.width, params.height) - 1);
        for (int y = first.y; y <= last.y; ++y) {
            for (int x = first.x; x <= last.x; ++x) {
                if (glm::distance(glm::dvec2(x, y) + 0.5, glm::dvec2(place)) <= radius) {
                    std::uint32_t& depth =
                        map[static_cast<std::size_t>(y) * params.width + static_cast<std::size_t>(x)];
                    depth = std::min(depth, static_cast<std::uint32_t>(steps));
                }
            }
        }
    }
    return map;
}

double visibility(const shared::VisibilityParams& params, std::span<const std::uint32_t> map, const glm::dvec3& x,
                  const glm::dvec3& normal)
{
    const auto spacing = static_cast<double>(params.spacing);
    const glm::dvec3 place = map_place(params, x + static_cast<double>(shared::RECEIVER_DISTANCE) * spacing * normal);
    // How much deeper the plane through this point lies, a texel on.
    const double incidence =
        std::max(-glm::dot(normal, glm::dvec3(params.direction)), static_cast<double>(shared::LEAST_INCIDENCE));
    const glm::dvec2 slope =
        static_cast<double>(params.texel) / incidence *
        glm::dvec2(glm::dot(normal, glm::dvec3(params.right)), glm::dot(normal, glm::dvec3(params.up)));
    const glm::dvec2 first = glm::floor(glm::dvec2(place) - 0.5);
    double seen = 0.0;
    for (int corner = 0; corner < 4; ++corner) {
        const glm::dvec2 texel = first + glm::dvec2(corner % 2, corner / 2);
        const glm::dvec2 offset = texel + 0.5 - glm::dvec2(place);
        const double weight = (1.0 - std::abs(offset.x)) * (1.0 - std::abs(offset.y));
        const bool in_map = texel.x >= 0.0 && texel.y >= 0.0 && texel.x < params.width && texel.y < params.height;
        double depth = 0.0;
        if (in_map) {
            depth = map[static_cast<std::size_t>(texel.y) * params.width + static_cast<std::size_t>(texel.x)] /
                    static_cast<double>(params.depth_scale);
        }
        const double needed = place.z + glm::dot(slope, offset);
        seen += !in_map || depth >= needed ? weight : 0.0;
    }
    return seen;
}

std::vector<double> visibility_of_solids(const shared::VisibilityParams& params, std::span<const std::uint32_t> map,
                                         const State& state, std::span<const glm::dvec4> exposure)
{
    std::vector<double> seen(state.size(), 0.0);
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (shared::particle_state(state.attributes[i]) == shared::STATE_SOLID && exposure[i].w > 0.0) {
            seen[i] = visibility(params, map, state.position[i], glm::dvec3(exposure[i]));
        }
    }
    return seen;
}

} // namespace meltpoint::reference
