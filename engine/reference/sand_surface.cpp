#include "reference/sand_surface.h"

#include <algorithm>
#include <cmath>

#include "reference/walls.h"

namespace meltpoint::reference {

namespace {

/// The texels of a map, by column and row, which may lie beyond its borders.
class Map {
public:
    Map(const Settings& settings, const shared::VisibilityParams& view)
        : width_(static_cast<int>(view.width)), height_(static_cast<int>(view.height)),
          along_(is_periodic_along(settings.params, view.right)), across_(is_periodic_along(settings.params, view.up))
    {
    }

    [[nodiscard]] std::size_t texel(int x, int y) const
    {
        return static_cast<std::size_t>(inside(y, height_, across_)) * static_cast<std::size_t>(width_) +
               static_cast<std::size_t>(inside(x, width_, along_));
    }

private:
    int width_;
    int height_;
    bool along_;
    bool across_;
};

/// Of a fit, falling from 1 to 0 where it is out of reach.
double nearness(const glm::dvec2& way)
{
    const double reach = shared::SHEET_REACH + 1;
    return std::pow(std::max(1.0 - glm::dot(way, way) / (reach * reach), 0.0), 2);
}

SandColumn column(const shared::SolidSplatParams& splats, const State& state, const SandSources& sources,
                  std::size_t texel, const SandColumn* before)
{
    constexpr std::uint32_t nobody = 0xffffffffu;
    const std::uint32_t id = sources.top_id[texel];
    const std::uint32_t material = id != nobody ? shared::particle_material(state.attributes[id]) : 0;
    const bool is_sand = id != nobody && splats.is_sand[material] != 0;
    const bool is_floor = sources.top[texel] < 0.0;
    const double taken = is_sand ? std::clamp(sources.damage[id], 0.0, 1.0) : 0.0;
    const double spacing = static_cast<double>(sources.view.spacing);

    SandColumn now{.height = is_floor ? 0.0 : sources.top[texel] + (0.5 - taken) * spacing,
                   .is_ground = is_sand || is_floor,
                   .share = is_sand ? 1.0 : 0.0,
                   .color = is_sand ? glm::dvec3(splats.color[material]) : glm::dvec3(0.0)};
    if (before == nullptr) {
        return now;
    }
    const double follows = -std::expm1(-sources.seconds / static_cast<double>(shared::COLUMN_TIME));
    if (now.is_ground && before->is_ground) {
        now.height = glm::mix(before->height, now.height, follows);
    }
    if (before->share > 0.0) {
        now.color = is_sand ? glm::mix(before->color, now.color, follows) : before->color;
    }
    now.share = glm::mix(before->share, now.share, follows);
    return now;
}

SandPlane plane(const std::vector<SandColumn>& columns, const Map& map, const shared::VisibilityParams& view, int x,
                int y)
{
    const double spacing = static_cast<double>(view.spacing);
    const double base = columns[map.texel(x, y)].height;
    double sum = 0.0;
    glm::dvec2 way(0.0);
    glm::dmat2 ways(0.0);
    double height = 0.0;
    double heights = 0.0;
    glm::dvec2 rise(0.0);
    for (int v = -shared::SHEET_REACH; v <= shared::SHEET_REACH; ++v) {
        for (int u = -shared::SHEET_REACH; u <= shared::SHEET_REACH; ++u) {
            const SandColumn& its = columns[map.texel(x + u, y + v)];
            const glm::dvec2 at(u, v);
            const double weight = its.is_ground ? nearness(at) : 0.0;
            const double h = (its.height - base) / spacing;
            sum += weight;
            way += weight * at;
            ways += weight * glm::outerProduct(at, at);
            height += weight * h;
            heights += weight * h * h;
            rise += weight * h * at;
        }
    }
    if (sum <= 0.0) {
        return {.height = base};
    }
    const glm::dvec2 mean = way / sum;
    const double mean_height = height / sum;
    const glm::dmat2 spread =
        ways / sum - glm::outerProduct(mean, mean) + glm::dmat2(static_cast<double>(shared::SHEET_ROUNDING));
    const glm::dvec2 lean = rise / sum - mean * mean_height;
    const glm::dvec2 slope = glm::inverse(spread) * lean; // in spacings a texel
    return {.height = base + (mean_height - glm::dot(slope, mean)) * spacing,
            .slope = slope * spacing / static_cast<double>(view.texel),
            .off = std::max(heights / sum - mean_height * mean_height - glm::dot(slope, lean), 0.0)};
}

SheetCorner corner(const std::vector<SandColumn>& columns, const std::vector<SandPlane>& planes, const Map& map,
                   const SandSources& sources, int x, int y, const SheetCorner* before)
{
    double sum = 0.0;
    double off = 0.0;
    double sand = 0.0;
    SheetCorner now;
    glm::dvec3 color(0.0);
    for (int v = -shared::SHEET_REACH; v < shared::SHEET_REACH; ++v) {
        for (int u = -shared::SHEET_REACH; u < shared::SHEET_REACH; ++u) {
            const std::size_t texel = map.texel(x + u, y + v);
            const glm::dvec2 way = glm::dvec2(u, v) + 0.5;
            const double share = columns[texel].is_ground ? nearness(way) : 0.0;
            const double scatter = planes[texel].off + std::pow(static_cast<double>(shared::SHEET_NOISE), 2);
            const double weight = share / (scatter * scatter);
            sum += weight;
            now.height += weight * (planes[texel].height -
                                    glm::dot(planes[texel].slope, way) * static_cast<double>(sources.view.texel));
            now.slope += weight * planes[texel].slope;
            off += weight * planes[texel].off;
            sand += share * columns[texel].share;
            color += share * columns[texel].share * columns[texel].color;
        }
    }
    const double scale = sum > 0.0 ? 1.0 / sum : 0.0;
    now.height = std::max(now.height * scale, 0.0);
    now.slope *= scale;
    const bool is_sheet = sum > 0.0 && glm::length(now.slope) <= static_cast<double>(shared::STEEPEST_SHEET) &&
                          off * scale <= std::pow(static_cast<double>(shared::ROUGHEST_SHEET), 2);
    now.presence = is_sheet ? 1.0 : 0.0;
    if (before != nullptr) {
        const double most = sources.seconds / static_cast<double>(shared::SHEET_TIME);
        now.presence = before->presence + std::clamp(now.presence - before->presence, -most, most);
    }
    now.color = sand > 0.0 ? color / sand : (before != nullptr ? before->color : glm::dvec3(0.0));
    return now;
}

} // namespace

SandSheet sand_sheet(const Settings& settings, const shared::SolidSplatParams& splats, const State& state,
                     const SandSources& sources, const SandSheet& before)
{
    const Map map(settings, sources.view);
    const auto width = static_cast<int>(sources.view.width);
    const auto height = static_cast<int>(sources.view.height);
    SandSheet sheet;
    for (std::size_t i = 0; i < sources.top.size(); ++i) {
        sheet.columns.push_back(
            column(splats, state, sources, i, before.columns.empty() ? nullptr : &before.columns[i]));
    }
    std::vector<SandPlane> planes;
    for (int i = 0; i < width * height; ++i) {
        planes.push_back(plane(sheet.columns, map, sources.view, i % width, i / width));
    }
    for (int i = 0; i < (width + 1) * (height + 1); ++i) {
        const SheetCorner* last = before.corners.empty() ? nullptr : &before.corners[static_cast<std::size_t>(i)];
        sheet.corners.push_back(corner(sheet.columns, planes, map, sources, i % (width + 1), i / (width + 1), last));
    }
    return sheet;
}

void cover_sand(const Settings& settings, const shared::SolidSplatParams& splats, const State& state,
                const shared::VisibilityParams& view, const SandSheet& sheet, std::vector<double>& left,
                std::vector<double>& size)
{
    const double depth = static_cast<double>(shared::DEPTH_STEPS) / static_cast<double>(view.depth_scale);
    const glm::dvec2 last(view.width - 1, view.height - 1);
    for (std::size_t i = 0; i < state.size(); ++i) {
        const std::uint32_t attributes = state.attributes[i];
        if (splats.is_sand[shared::particle_material(attributes)] == 0) {
            continue;
        }
        const glm::dvec3 way = state.position[i] - glm::dvec3(view.origin);
        const glm::dvec2 at = glm::dvec2(glm::dot(way, glm::dvec3(view.right)), glm::dot(way, glm::dvec3(view.up))) /
                              static_cast<double>(view.texel);
        const glm::dvec2 texel = glm::clamp(glm::floor(at), glm::dvec2(0.0), last);
        const glm::dvec2 f = glm::clamp(at - texel, 0.0, 1.0);
        const auto corner_at = [&](int x, int y) -> const SheetCorner& {
            return sheet.corners[static_cast<std::size_t>(texel.y + y) * (view.width + 1) +
                                 static_cast<std::size_t>(texel.x + x)];
        };
        const auto between = [&](double SheetCorner::*of) {
            return glm::mix(glm::mix(corner_at(0, 0).*of, corner_at(1, 0).*of, f.x),
                            glm::mix(corner_at(0, 1).*of, corner_at(1, 1).*of, f.x), f.y);
        };
        const double above = (depth - glm::dot(way, glm::dvec3(view.direction)) - between(&SheetCorner::height)) /
                             static_cast<double>(settings.params.spacing);
        if (shared::particle_state(attributes) == shared::STATE_SOLID) {
            const double presence = std::min({corner_at(0, 0).presence, corner_at(1, 0).presence,
                                              corner_at(0, 1).presence, corner_at(1, 1).presence});
            left[i] *= above < -static_cast<double>(shared::COVERED_BELOW) ? 1.0 : 1.0 - presence;
        } else if (shared::is_flying_sand(attributes)) {
            const double t = std::clamp(above / static_cast<double>(shared::PUFF_HEIGHT), 0.0, 1.0);
            size[i] = static_cast<double>(shared::PUFF_RADIUS) * t * t * (3.0 - 2.0 * t);
        }
    }
}

} // namespace meltpoint::reference
