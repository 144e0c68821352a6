// The sheet over columns of sand: the device against the twin, and what it looks like.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/random.h"
#include "gpu/transfer.h"
#include "reference/sand_surface.h"
#include "render/sand_surface.h"
#include "sim/visibility.h"
#include "sim/wind.h"
#include "support/fluid_states.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

constexpr float d = test_spacing;
constexpr std::uint32_t nobody = 0xffffffffu;
constexpr std::uint32_t sand = 1; // materials
constexpr std::uint32_t other_sand = 2;
constexpr std::uint32_t rock = 3;

/// Columns, and whoever is on top of them or in the air; particles in order of id.
struct Scenery {
    std::vector<double> top;
    std::vector<std::uint32_t> top_id;
    std::vector<double> damage;
    ParticleSet particles;
};

/// Of one device or twin, frame after frame.
struct Seen {
    reference::SandSheet sheet;
    std::vector<double> left;
    std::vector<double> size;
};

class SandSurfaceTest : public GpuTest {
protected:
    static reference::Settings settings()
    {
        reference::Settings its{.params = test_settings(shared::KERNEL_WENDLAND).params};
        its.params.domain_min = {-0.3f, 0.1f, 0.2f};
        its.params.domain_max = {-0.3f + 23.0f * d, 0.9f, 0.2f + 17.5f * d};
        its.params.gravity = {0.0f, -9.81f, 0.0f};
        its.params.periodic_mask = 0x30; // z
        its.params.moving_count = 0;
        return its;
    }

    static shared::VisibilityParams view()
    {
        return sim::visibility_params(sim::ground_view({.up = {0.0f, 1.0f, 0.0f}}), settings().params);
    }

    static shared::SolidSplatParams splats()
    {
        shared::SolidSplatParams params{};
        params.is_sand[sand] = params.is_sand[other_sand] = 1;
        params.color[sand] = {0.8f, 0.6f, 0.3f};
        params.color[other_sand] = {0.3f, 0.2f, 0.1f};
        return params;
    }

    static glm::vec3 over(const shared::VisibilityParams& map, int x, int y, double height)
    {
        const double depth = static_cast<double>(shared::DEPTH_STEPS) / static_cast<double>(map.depth_scale);
        return glm::vec3(glm::dvec3(map.origin) + (x + 0.5) * static_cast<double>(map.texel) * glm::dvec3(map.right) +
                         (y + 0.5) * static_cast<double>(map.texel) * glm::dvec3(map.up) +
                         (depth - height) * glm::dvec3(map.direction));
    }

    /// top_of: m above the floor of the particle on texel (x, y), negative where there is none.
    template <class TopOf>
    static Scenery scenery(const TopOf& top_of, std::uint32_t material = sand)
    {
        const shared::VisibilityParams map = view();
        Scenery its;
        for (int i = 0; i < static_cast<int>(map.width * map.height); ++i) {
            const int x = i % static_cast<int>(map.width);
            const int y = i / static_cast<int>(map.width);
            its.top.push_back(top_of(x, y));
            its.top_id.push_back(its.top.back() < 0.0 ? nobody : static_cast<std::uint32_t>(its.particles.size()));
            if (its.top.back() >= 0.0) {
                add_particle(its.particles, over(map, x, y, its.top.back()));
                its.particles.attributes.back() = shared::pack_attributes(shared::STATE_SOLID, material);
                its.damage.push_back(0.0);
            }
        }
        return its;
    }

    /// Rough ground of two kinds of sand, with bare floor, a rock and something that is no solid on it, and sand in the
    /// air.
    static Scenery rough_ground(std::uint64_t seed)
    {
        Random random(seed);
        Scenery its = scenery([&](int x, int y) {
            const bool bare = x > 15 && y < 8;
            return bare ? -0.5 * static_cast<double>(d)
                        : static_cast<double>(d) * (0.5 + 0.2 * x + std::floor((x < 7 ? 5.0 : 2.0) * random.uniform()));
        });
        for (std::size_t i = 0; i < its.particles.size(); ++i) {
            const std::uint32_t material = i % 7 == 0 ? other_sand : (i > 100 && i < 110 ? rock : sand);
            its.particles.attributes[i] = shared::pack_attributes(shared::STATE_SOLID, material);
            its.damage[i] = 1.1 * random.uniform();
        }
        its.top_id[its.top.size() - 5] = nobody; // a collider
        for (int i = 0; i < 20; ++i) {           // what lies below others, some of it below an overhang
            add_particle(its.particles, over(view(), 12 + i % 8, 10 + i / 8, 0.5 * random.uniform() * (i % 8) * 0.05));
            its.particles.attributes.back() = shared::pack_attributes(shared::STATE_SOLID, sand);
            its.damage.push_back(0.0);
        }
        for (int i = 0; i < 50; ++i) {
            add_particle(its.particles, over(view(), i % 20, i % 15, 0.4 * random.uniform()));
            its.particles.attributes.back() = shared::freed_as(shared::pack_attributes(shared::STATE_SOLID, sand),
                                                               shared::STATE_DUST, shared::CAUSE_WIND);
            its.damage.push_back(0.0);
        }
        return its;
    }

    /// All frames have as many particles.
    std::vector<Seen> on_device(const std::vector<Scenery>& frames, double seconds)
    {
        const shared::VisibilityParams map = view();
        const auto count = static_cast<std::uint32_t>(frames[0].particles.size());
        shared::SphParams params = settings().params;
        params.pool_count = count;
        const auto buffer = [&]<class T>(const std::vector<T>& values) {
            gpu::Buffer made = gpu::make_buffer<T>(context(), values.size(), "test");
            gpu::upload<T>(context(), made, values);
            return made;
        };
        const gpu::Buffer params_buffer = buffer(std::vector{params});
        const gpu::Buffer map_buffer = buffer(std::vector{map});
        const gpu::Buffer splats_buffer = buffer(std::vector{splats()});
        std::vector<std::uint32_t> ids(count);
        for (std::uint32_t i = 0; i < count; ++i) {
            ids[i] = i;
        }
        const gpu::Buffer place = buffer(ids);
        render::SandSurface surface(context(), {map.width, map.height});
        gpu::Commands commands(context());
        std::vector<Seen> seen;
        for (const Scenery& frame : frames) {
            std::vector<glm::vec4> ground;
            for (const double top : frame.top) {
                ground.emplace_back(0.0f, 0.0f, 0.0f, static_cast<float>(top));
            }
            std::vector<glm::vec2> damage;
            for (const double each : frame.damage) {
                damage.emplace_back(static_cast<float>(each), 0.0f);
            }
            std::vector<glm::vec4> alive;
            for (const glm::vec3& x : frame.particles.position) {
                alive.emplace_back(x, 1.0f);
            }
            const gpu::Buffer ground_buffer = buffer(ground);
            const gpu::Buffer top_id = buffer(frame.top_id);
            const gpu::Buffer damage_buffer = buffer(damage);
            const gpu::Buffer living = buffer(alive);
            const gpu::Buffer size = buffer(std::vector<float>(count, 0.25f));
            const ParticleBuffers particles = make_particle_buffers(context(), count);
            upload(context(), frame.particles, particles);
            commands.begin();
            surface.record(commands, {map_buffer, ground_buffer, top_id, damage_buffer}, particles, params_buffer,
                           splats_buffer, place, living, size, static_cast<float>(seconds));
            commands.submit();
            commands.wait();
            const render::SandSheetView sheet = surface.sheet(map_buffer);
            const std::size_t corners = (map.width + 1) * (map.height + 1);
            const auto corner = gpu::download<glm::vec4>(context(), sheet.corner, corners);
            const auto tint = gpu::download<glm::vec4>(context(), sheet.corner_tint, corners);
            Seen its;
            for (std::size_t i = 0; i < corners; ++i) {
                its.sheet.corners.push_back({.height = static_cast<double>(corner[i].x),
                                             .slope = {corner[i].y, corner[i].z},
                                             .presence = static_cast<double>(corner[i].w),
                                             .color = tint[i]});
            }
            for (const glm::vec4& each : gpu::download<glm::vec4>(context(), living, count)) {
                its.left.push_back(static_cast<double>(each.w));
            }
            for (const float each : gpu::download<float>(context(), size, count)) {
                its.size.push_back(static_cast<double>(each));
            }
            seen.push_back(std::move(its));
        }
        return seen;
    }

    static std::vector<Seen> by_twin(const std::vector<Scenery>& frames, double seconds)
    {
        const shared::VisibilityParams map = view();
        std::vector<Seen> seen;
        for (const Scenery& frame : frames) {
            const reference::State state = reference::from_particle_set(frame.particles);
            Seen its{
                .sheet = reference::sand_sheet(
                    settings(), splats(), state,
                    {.view = map, .top = frame.top, .top_id = frame.top_id, .damage = frame.damage, .seconds = seconds},
                    seen.empty() ? reference::SandSheet{} : seen.back().sheet),
                .left = std::vector<double>(state.size(), 1.0),
                .size = std::vector<double>(state.size(), 0.25)};
            reference::cover_sand(settings(), splats(), state, map, its.sheet, its.left, its.size);
            seen.push_back(std::move(its));
        }
        return seen;
    }

    /// Of a frame, the corner at (x, y).
    static const reference::SheetCorner& corner_at(const Seen& seen, int x, int y)
    {
        return seen.sheet.corners[static_cast<std::size_t>(y) * (view().width + 1) + static_cast<std::size_t>(x)];
    }
};

TEST_F(SandSurfaceTest, TheDeviceConformsToTheTwin)
{
    const std::vector<Scenery> frames{rough_ground(1), rough_ground(2), rough_ground(3)};
    constexpr double seconds = 0.04;
    const std::vector<Seen> device = on_device(frames, seconds);
    const std::vector<Seen> twin = by_twin(frames, seconds);
    std::size_t sheets = 0;
    std::size_t puffs = 0;
    for (std::size_t frame = 0; frame < frames.size(); ++frame) {
        const std::vector<reference::SheetCorner>& expected = twin[frame].sheet.corners;
        ASSERT_EQ(device[frame].sheet.corners.size(), expected.size());
        for (std::size_t i = 0; i < expected.size(); ++i) {
            const reference::SheetCorner& its = device[frame].sheet.corners[i];
            EXPECT_NEAR(its.height, expected[i].height, 1e-4 * static_cast<double>(d)) << frame << ", corner " << i;
            EXPECT_LT(glm::distance(its.slope, expected[i].slope), 1e-4) << frame << ", corner " << i;
            EXPECT_NEAR(its.presence, expected[i].presence, 1e-4) << frame << ", corner " << i;
            EXPECT_LT(glm::distance(its.color, expected[i].color), 1e-4) << frame << ", corner " << i;
            sheets += expected[i].presence > 0.5 ? 1 : 0;
        }
        for (std::size_t i = 0; i < twin[frame].left.size(); ++i) {
            EXPECT_NEAR(device[frame].left[i], twin[frame].left[i], 1e-4) << frame << ", particle " << i;
            EXPECT_NEAR(device[frame].size[i], twin[frame].size[i], 1e-3) << frame << ", particle " << i;
            puffs += twin[frame].size[i] > 1.0 ? 1 : 0;
        }
    }
    EXPECT_GT(sheets, 500u);
    EXPECT_LT(sheets, 3 * twin[0].sheet.corners.size() - 100); // some of it is too rough
    EXPECT_GT(puffs, 30u);
}

// A slope whose tops are a spacing apart: a staircase with steps 3 to 9 texels wide.
TEST_F(SandSurfaceTest, AStaircaseIsASmoothSlope)
{
    for (const double slope : {0.15, 0.3, 0.67}) {
        const Seen seen = on_device(
            {scenery([&](int x, int) { return static_cast<double>(d) * (std::floor(slope * x) + 0.5); })}, 0.0)[0];
        // Steps stay, as far as a window is too narrow for them: of a staircase they would be 1 and more.
        for (int x = 8; x < 16; ++x) {
            const reference::SheetCorner& its = corner_at(seen, x, 9);
            EXPECT_EQ(its.presence, 1.0);
            EXPECT_LT(glm::distance(its.slope, glm::dvec2(slope, 0.0)), 0.09) << "slope " << slope << " at " << x;
        }
    }
}

// A ridge whose sides are even keeps its crest: a mean over the same windows would lie half a spacing below it.
TEST_F(SandSurfaceTest, ACrestStaysSharp)
{
    const double crest = 11.0;
    const auto side = [&](double x) {
        return 9.0 - (x < crest ? 0.3 * (crest - x) : 0.65 * (x - crest));
    };
    const Seen seen =
        on_device({scenery([&](int x, int) { return static_cast<double>(d) * (side(x + 0.5) - 0.5); })}, 0.0)[0];
    for (int x = 5; x < 17; ++x) {
        EXPECT_NEAR(corner_at(seen, x, 9).height / static_cast<double>(d), side(x), 0.3) << x;
    }
    EXPECT_NEAR(corner_at(seen, 9, 9).slope.x, 0.3, 0.065);
    EXPECT_NEAR(corner_at(seen, 13, 9).slope.x, -0.65, 0.065);
}

// Particles that land and leave are not seen as steps.
TEST_F(SandSurfaceTest, HeightsFollowInTime)
{
    const auto level = [&](double layers) {
        return scenery([=](int, int) { return static_cast<double>(d) * (layers - 0.5); });
    };
    constexpr double seconds = 0.025;
    const std::vector<Seen> seen = on_device({level(3.0), level(4.0), level(4.0), level(4.0)}, seconds);
    double before = 3.0;
    for (std::size_t frame = 1; frame < seen.size(); ++frame) {
        const double height = corner_at(seen[frame], 10, 9).height / static_cast<double>(d);
        EXPECT_GT(height, before);
        EXPECT_NEAR(height,
                    4.0 - std::exp(-seconds * static_cast<double>(frame) / static_cast<double>(shared::COLUMN_TIME)),
                    1e-3);
        before = height;
    }
}

// Of a wall of sand there is no sheet, and its particles have their splats.
TEST_F(SandSurfaceTest, SteepSandHasNoSheet)
{
    const Scenery wall = scenery([&](int x, int) { return static_cast<double>(d) * (x < 11 ? 8.5 : 0.5); });
    const Seen seen = on_device({wall}, 0.0)[0];
    EXPECT_EQ(corner_at(seen, 11, 9).presence, 0.0);
    EXPECT_EQ(corner_at(seen, 5, 9).presence, 1.0);
    EXPECT_EQ(corner_at(seen, 18, 9).presence, 1.0);
    for (std::size_t i = 0; i < wall.particles.size(); ++i) {
        const int x = static_cast<int>(i % view().width);
        if (x == 10) {
            EXPECT_GT(seen.left[i], 0.4) << i;
        } else if (x < 5 || x > 17) {
            EXPECT_EQ(seen.left[i], 0.0) << i;
        }
    }
}

} // namespace
} // namespace meltpoint
