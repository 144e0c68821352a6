// What of solids is seen along a direction: the device against the twin, and both against scenes whose shadows are
// known.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "conformance/device.h"
#include "core/error.h"
#include "core/random.h"
#include "reference/exposure.h"
#include "reference/visibility.h"
#include "sim/exposure.h"
#include "sim/visibility.h"
#include "support/fluid_states.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

constexpr float d = test_spacing;
constexpr float untouched = 7.0f;
constexpr float middle = 20.0f; // of the box, in spacings

class VisibilityTest : public GpuTest {
protected:
    /// A box 40 spacings wide without walls.
    static sim::SimulationSettings settings()
    {
        sim::SimulationSettings settings = test_settings(shared::KERNEL_WENDLAND);
        settings.options.still = true;
        settings.params.domain_max = glm::vec3(2.0f * middle * d);
        settings.params.wall_mask = 0;
        return settings;
    }

    /// What the device has, by id.
    struct Found {
        ParticleSet particles;
        shared::VisibilityParams params;
        std::vector<std::uint32_t> map;
        std::vector<glm::vec4> exposure;
        std::vector<float> seen;
    };

    /// Of the surface that the solids have, or, where there is one, of a made-up exposure.
    static Found find(const ParticleSet& set, const sim::SimulationSettings& settings,
                      const sim::VisibilitySettings& view, const std::vector<glm::vec4>& made_up = {})
    {
        conformance::Device device(context(), set, settings);
        const auto count = static_cast<std::uint32_t>(set.size());
        sim::Exposure exposure(context(), settings.options, count,
                               device.params.grid_size.x * device.params.grid_size.y * device.params.grid_size.z);
        const sim::Visibility visibility(context(), view, device.params);
        gpu::upload<float>(context(), visibility.visibility(), std::vector<float>(count, untouched));
        gpu::upload<glm::vec4>(context(), exposure.exposure(), made_up);
        device.run([&] {
            sim::record_partition(device.commands, device.kernels, device.params_buffer, device.particles, device.grid);
            sim::record_boundary_weight(device.commands, device.kernels, device.params_buffer, device.particles,
                                        device.grid);
            if (made_up.empty()) {
                exposure.record_start(device.commands);
                exposure.record(device.commands, device.params_buffer, device.particles, device.grid);
            }
            visibility.record(device.commands, device.params_buffer, device.particles, exposure.exposure());
        });
        const shared::VisibilityParams params = sim::visibility_params(view, device.params);
        return {.particles = download(context(), device.particles),
                .params = params,
                .map = gpu::download<std::uint32_t>(context(), visibility.map(), params.width * params.height),
                .exposure = gpu::download<glm::vec4>(context(), exposure.exposure(), count),
                .seen = gpu::download<float>(context(), visibility.visibility(), count)};
    }

    /// At an angle off straight down, and one around that, in degrees.
    static glm::vec3 slanting(double angle, double around)
    {
        const double a = angle * std::numbers::pi / 180.0;
        const double b = around * std::numbers::pi / 180.0;
        return {std::sin(a) * std::cos(b), -std::cos(a), std::sin(a) * std::sin(b)};
    }

    /// The solid particles of a lattice, or one that lies askew, for which `is_inside` holds of the place in spacings
    /// from the middle of the box; each moved by up to `jitter` spacings along each axis.
    template <class Inside>
    static ParticleSet carve(bool is_askew, float jitter, const Inside& is_inside)
    {
        Random random(3);
        const glm::vec2 angles = is_askew ? glm::vec2(0.8f, 0.6f) : glm::vec2(0.0f);
        const glm::vec2 c = glm::cos(angles);
        const glm::vec2 s = glm::sin(angles);
        const glm::mat3 turn =
            glm::mat3(1, 0, 0, 0, c.y, s.y, 0, -s.y, c.y) * glm::mat3(c.x, s.x, 0, -s.x, c.x, 0, 0, 0, 1);
        ParticleSet set;
        constexpr int reach = 20;
        for (int z = -reach; z < reach; ++z) {
            for (int y = -reach; y < reach; ++y) {
                for (int x = -reach; x < reach; ++x) {
                    const glm::vec3 place =
                        turn * (glm::vec3(x, y, z) + 0.5f) + jitter * (2.0f * random_vector(random) - 1.0f);
                    if (is_inside(place)) {
                        add_particle(set, d * (place + middle));
                        set.attributes.back() = shared::pack_attributes(shared::STATE_SOLID, 2);
                    }
                }
            }
        }
        return set;
    }

    static glm::vec3 place(const Found& found, std::size_t i) { return found.particles.position[i] / d - middle; }

    /// Something of every state, here and there, and on the borders.
    static ParticleSet scattered()
    {
        Random random(5);
        ParticleSet set;
        for (std::uint32_t i = 0; i < 3000; ++i) {
            const glm::vec3 x = 2.0f * middle * d * random_vector(random);
            add_particle(set, i % 5 == 0 ? x * glm::vec3(1.0f, 0.0f, 1.0f) : x);
            const std::uint32_t state = i % 7 == 0   ? shared::STATE_FLUID
                                        : i % 7 == 1 ? shared::STATE_DUST
                                        : i % 7 == 2 ? shared::STATE_COLLIDER
                                                     : shared::STATE_SOLID;
            set.attributes.back() = shared::pack_attributes(state, 2);
        }
        return set;
    }

    static std::vector<glm::vec4> random_exposure(std::size_t count)
    {
        Random random(6);
        std::vector<glm::vec4> exposure;
        for (std::size_t i = 0; i < count; ++i) {
            exposure.emplace_back(glm::normalize(random_vector(random) - 0.5f), i % 4 == 0 ? 0.0f : d * d);
        }
        return exposure;
    }
};

TEST_F(VisibilityTest, MapAndSharesAreThoseOfTheirTwins)
{
    const ParticleSet set = scattered();
    const std::vector<glm::vec4> exposure = random_exposure(set.size());
    for (const glm::vec3& direction : {glm::vec3(0.0f, -1.0f, 0.0f), glm::vec3(2.0f, -3.0f, 0.7f),
                                       glm::vec3(0.0f, 0.0f, 1.0f), glm::vec3(-1.0f, 0.2f, 0.1f)}) {
        for (const float texel : {0.25f, 0.5f, 1.7f}) {
            for (const std::uint32_t dimensions : {2u, 3u}) {
                SCOPED_TRACE(testing::Message() << direction.x << " " << direction.y << " " << direction.z
                                                << ", texels of " << texel << " d, " << dimensions << " D");
                sim::SimulationSettings its = settings();
                ParticleSet flat = set;
                if (dimensions == 2) {
                    lay_flat(its);
                    flat = in_plane(set);
                }
                const sim::VisibilitySettings view{
                    .direction = direction, .texel = texel, .fluid_casts = texel == 0.5f};
                const Found found = find(flat, its, view, exposure);
                const reference::State state = reference::from_particle_set(found.particles);

                // Rounding decides whether a disc covers a center that its rim runs through.
                shared::VisibilityParams wider = found.params;
                shared::VisibilityParams narrower = found.params;
                wider.spacing *= 1.0f + 1e-5f;
                narrower.spacing *= 1.0f - 1e-5f;
                const auto twin = reference::depth_map(found.params, state);
                const auto least = reference::depth_map(wider, state);
                const auto most = reference::depth_map(narrower, state);
                std::size_t differ = 0;
                std::size_t covered = 0;
                for (std::size_t i = 0; i < twin.size(); ++i) {
                    // A depth of floats may be a few of its 16 million steps off.
                    EXPECT_GE(std::int64_t{found.map[i]} + 4, std::int64_t{least[i]});
                    EXPECT_LE(std::int64_t{found.map[i]}, std::int64_t{most[i]} + 4);
                    covered += twin[i] != shared::NOTHING_SEEN ? 1 : 0;
                    differ += std::abs(std::int64_t{found.map[i]} - std::int64_t{twin[i]}) > 4 ? 1 : 0;
                }
                EXPECT_GT(covered, 20u);
                EXPECT_LE(differ, 2 + covered / 1000);

                // Or whether something hides what lies just behind it: a hair's breadth along the direction.
                const glm::dvec3 hair = 1e-4 * static_cast<double>(d) * glm::dvec3(found.params.direction);
                std::size_t close = 0;
                std::size_t exposed = 0;
                std::size_t lit = 0;
                for (std::size_t i = 0; i < set.size(); ++i) {
                    if (shared::particle_state(set.attributes[i]) != shared::STATE_SOLID) {
                        EXPECT_EQ(found.seen[i], untouched);
                        continue;
                    }
                    if (exposure[i].w == 0.0f) {
                        EXPECT_EQ(found.seen[i], 0.0f);
                        continue;
                    }
                    const glm::dvec3 normal(exposure[i]);
                    const double dark =
                        reference::visibility(found.params, found.map, state.position[i] + hair, normal);
                    const double bright =
                        reference::visibility(found.params, found.map, state.position[i] - hair, normal);
                    EXPECT_GE(static_cast<double>(found.seen[i]), dark - 2e-4) << "particle " << i;
                    EXPECT_LE(static_cast<double>(found.seen[i]), bright + 2e-4) << "particle " << i;
                    close += bright - dark > 1e-9 ? 1 : 0;
                    lit += dark > 0.5 ? 1 : 0;
                    ++exposed;
                }
                EXPECT_LE(close, exposed / 200);
                EXPECT_GT(lit, exposed / 50);
                EXPECT_LT(lit, exposed - exposed / 50);

                // And the whole twin, fed with the device's exposure and map.
                const auto shares = reference::visibility_of_solids(
                    found.params, found.map, state, std::vector<glm::dvec4>(exposure.begin(), exposure.end()));
                std::size_t equal = 0;
                for (std::size_t i = 0; i < set.size(); ++i) {
                    equal += std::abs(static_cast<double>(found.seen[i]) - shares[i]) < 2e-4 ? 1 : 0;
                    equal += found.seen[i] == untouched && shares[i] == 0.0 ? 1 : 0;
                }
                EXPECT_GE(equal, set.size() - close);
            }
        }
    }
}

TEST_F(VisibilityTest, AMapCoversTheDomain)
{
    Random random(9);
    shared::SphParams params = settings().params;
    params.domain_min = glm::vec3(-0.7f, 0.3f, 2.0f);
    params.domain_max = glm::vec3(1.0f, 0.9f, 2.2f);
    for (int i = 0; i < 100; ++i) {
        const glm::vec3 direction = i == 0 ? glm::vec3(0.0f, -1.0f, 0.0f) : random_vector(random) - 0.5f;
        const shared::VisibilityParams view = sim::visibility_params({.direction = direction}, params);
        EXPECT_LT(glm::distance(view.direction, glm::normalize(direction)), 1e-6f);
        EXPECT_LT(glm::distance(view.direction, glm::cross(view.up, view.right)), 1e-6f);
        glm::vec3 least(1e9f);
        glm::vec3 most(-1e9f);
        for (int corner = 0; corner < 8; ++corner) {
            const glm::vec3 x =
                glm::mix(params.domain_min, params.domain_max, glm::vec3(corner & 1, corner >> 1 & 1, corner >> 2)) -
                view.origin;
            const glm::vec3 in_map(glm::dot(x, view.right), glm::dot(x, view.up), glm::dot(x, view.direction));
            least = glm::min(least, in_map);
            most = glm::max(most, in_map);
        }
        EXPECT_LT(glm::length(least), 1e-5f);
        EXPECT_LE(std::abs(most.x / view.texel - static_cast<float>(view.width) + 0.5f), 0.501f);
        EXPECT_LE(std::abs(most.y / view.texel - static_cast<float>(view.height) + 0.5f), 0.501f);
        EXPECT_NEAR(most.z * view.depth_scale / static_cast<float>(shared::DEPTH_STEPS), 1.0f, 1e-5f);
    }
}

TEST_F(VisibilityTest, SaysWhatIsWrong)
{
    const auto message = [](const sim::VisibilitySettings& view, float size) {
        shared::SphParams params = settings().params;
        params.domain_max = glm::vec3(size);
        try {
            (void)sim::visibility_params(view, params);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::Input);
            return std::string(error.what());
        }
        return std::string("nothing");
    };
    EXPECT_EQ(message({}, 1.0f), "nothing");
    EXPECT_EQ(message({.direction = glm::vec3(0.0f)}, 1.0f), "a direction of (0, 0, 0) leads nowhere");
    EXPECT_EQ(message({.texel = 0.1f}, 1.0f),
              "texels of 0.1 particle spacings were asked for; 0.125 to 2 are possible");
    EXPECT_EQ(message({}, 200.0f), "a visibility map of 8000 x 8000 texels has more than 16777216: make the domain "
                                   "smaller, the particle spacing larger or the texels larger");
}

// A face that the light meets at up to 80 degrees is not in its own shadow.
TEST_F(VisibilityTest, AFlatFaceIsSeenFromAnyAngle)
{
    const auto slab = [](const glm::vec3& place) {
        return std::abs(place.x) < 12.0f && std::abs(place.z) < 12.0f && place.y > -7.0f && place.y < 3.0f;
    };
    for (const bool is_askew : {false, true}) {
        for (const float jitter : {0.0f, 0.1f}) {
            const ParticleSet set = carve(is_askew, jitter, slab);
            for (const auto& [angle, around] : {std::pair{0.0, 0.0},
                                                {30.0, 22.0},
                                                {60.0, 45.0},
                                                {70.0, 0.0},
                                                {75.0, 77.0},
                                                {80.0, 0.0},
                                                {80.0, 45.0}}) {
                SCOPED_TRACE(testing::Message() << (is_askew ? "askew, " : "") << "jitter " << jitter << ", " << angle
                                                << " degrees, around " << around);
                const Found found = find(set, settings(), {.direction = slanting(angle, around)});
                double area = 0.0;
                double seen = 0.0;
                double outer = 0.0;
                double outer_seen = 0.0;
                for (std::size_t i = 0; i < set.size(); ++i) {
                    const glm::vec3 x = place(found, i);
                    const double its_area = static_cast<double>(found.exposure[i].w);
                    if (x.y < 0.0f || std::abs(x.x) > 8.0f || std::abs(x.z) > 8.0f || its_area == 0.0) {
                        continue;
                    }
                    const auto its_share = static_cast<double>(found.seen[i]);
                    area += its_area;
                    seen += its_share * its_area;
                    const bool is_outer = found.exposure[i].w > 0.3f * d * d;
                    outer += is_outer ? 1.0 : 0.0;
                    outer_seen += is_outer ? its_share : 0.0;
                    if (!is_askew && jitter == 0.0f) {
                        EXPECT_NEAR(its_share, 1.0, 1e-5);
                    }
                }
                EXPECT_GT(outer, 200.0);
                EXPECT_GT(outer_seen / outer, 0.999);
                EXPECT_GT(seen / area, 0.98);
            }
        }
    }
}

TEST_F(VisibilityTest, AParticleThreeSpacingsBehindAnotherIsNotSeen)
{
    Random random(4);
    for (int run = 0; run < 6; ++run) {
        const glm::vec3 direction =
            run == 0 ? glm::vec3(0.0f, -1.0f, 0.0f) : glm::normalize(random_vector(random) - 0.5f);
        const shared::VisibilityParams axes = sim::visibility_params({.direction = direction}, settings().params);
        ParticleSet set;
        for (int i = 0; i < 36; ++i) { // pairs far enough apart, anywhere in their texels
            const glm::vec2 place = 4.0f * (glm::vec2(i % 6, i / 6) - 2.5f) + glm::vec2(random_vector(random)) - 0.5f;
            const glm::vec3 x = middle + place.x * axes.right + place.y * axes.up;
            add_particle(set, d * x);
            add_particle(set, d * (x + 3.0f * direction));
        }
        std::ranges::fill(set.attributes, shared::pack_attributes(shared::STATE_SOLID, 2));
        const std::vector<glm::vec4> facing(set.size(), glm::vec4(-axes.direction, d * d));
        const Found found = find(set, settings(), {.direction = direction}, facing);
        for (std::size_t i = 0; i < set.size(); i += 2) {
            EXPECT_NEAR(found.seen[i], 1.0f, 1e-5f);
            EXPECT_EQ(found.seen[i + 1], 0.0f) << "pair " << i / 2 << ", run " << run;
        }
    }
}

// A roof above a floor: the edge of its shadow lies where the light leads it, and beyond it all is lit.
TEST_F(VisibilityTest, ABlockCastsItsShadowOntoAnother)
{
    const auto is_inside = [](const glm::vec3& place) {
        const bool floor = place.y < -6.0f && place.y > -10.0f && std::abs(place.x) < 16.0f;
        const bool roof = place.y > 0.0f && place.y < 3.0f && place.x < 4.0f && place.x > -16.0f;
        return (floor || roof) && std::abs(place.z) < 14.0f;
    };
    for (const bool is_askew : {false, true}) {
        const ParticleSet set = carve(is_askew, 0.0f, is_inside);
        for (const double angle : {-45.0, 0.0, 30.0}) {
            SCOPED_TRACE(testing::Message() << is_askew << ", " << angle << " degrees");
            const Found found = find(set, settings(), {.direction = slanting(angle, 0.0)});
            // The upper edge of the roof's end casts it where the light comes from the roof's side, else the lower one.
            const double below = angle > 0.0 ? 9.0 : 6.0;
            const double edge = 4.0 + below * std::tan(angle * std::numbers::pi / 180.0);
            std::size_t lit = 0;
            std::size_t dark = 0;
            for (std::size_t i = 0; i < set.size(); ++i) {
                const glm::vec3 x = place(found, i);
                const bool on_floor = x.y < -6.0f && x.y > -7.5f && std::abs(x.z) < 8.0f && found.exposure[i].w > 0.0f;
                if (on_floor && x.x > edge + 3.0 && x.x < 14.0f) {
                    EXPECT_GT(found.seen[i], 0.99f) << x.x;
                    ++lit;
                } else if (on_floor && x.x < edge - 3.0 && x.x > -9.0f) {
                    EXPECT_EQ(found.seen[i], 0.0f) << x.x;
                    ++dark;
                }
            }
            EXPECT_GT(lit, 20u);
            EXPECT_GT(dark, 15u);
        }
    }
}

TEST_F(VisibilityTest, ACavitySeesNothing)
{
    const auto is_inside = [](const glm::vec3& place) {
        const glm::vec3 a = glm::abs(place);
        const float distance = std::max({a.x, a.y, a.z});
        return distance < 11.0f && distance > 6.0f;
    };
    for (const float jitter : {0.0f, 0.1f}) {
        const ParticleSet set = carve(jitter > 0.0f, jitter, is_inside);
        for (const auto& [angle, around] :
             {std::pair{0.0, 0.0}, {25.0, 40.0}, {60.0, 10.0}, {85.0, 45.0}, {140.0, 200.0}}) {
            const Found found = find(set, settings(), {.direction = slanting(angle, around)});
            std::size_t inside = 0;
            for (std::size_t i = 0; i < set.size(); ++i) {
                const glm::vec3 a = glm::abs(place(found, i));
                if (std::max({a.x, a.y, a.z}) < 8.5f && found.exposure[i].w > 0.0f) {
                    EXPECT_EQ(found.seen[i], 0.0f) << "jitter " << jitter << ", " << angle << " degrees";
                    ++inside;
                }
            }
            EXPECT_GT(inside, 900u);
        }
    }
}

TEST_F(VisibilityTest, CollidersHideAndFluidDoesWhereAskedTo)
{
    const auto slab = [](const glm::vec3& place) {
        const bool is_cover = place.y > 6.0f && place.y < 8.0f;
        return (is_cover || (place.y < 0.0f && place.y > -4.0f)) && std::abs(place.x) < 10.0f &&
               std::abs(place.z) < 10.0f;
    };
    ParticleSet set = carve(false, 0.0f, slab);
    for (const std::uint32_t cover : {shared::STATE_FLUID, shared::STATE_DUST, shared::STATE_COLLIDER}) {
        for (const bool fluid_casts : {false, true}) {
            for (std::size_t i = 0; i < set.size(); ++i) {
                if (set.position[i].y > (middle + 5.0f) * d) {
                    set.attributes[i] = shared::pack_attributes(cover, 1);
                }
            }
            const Found found = find(set, settings(), {.fluid_casts = fluid_casts});
            const bool hides = cover == shared::STATE_COLLIDER || (cover == shared::STATE_FLUID && fluid_casts);
            for (std::size_t i = 0; i < set.size(); ++i) {
                const glm::vec3 x = place(found, i);
                if (x.y < 0.0f && x.y > -2.0f && std::abs(x.x) < 6.0f && std::abs(x.z) < 6.0f) {
                    EXPECT_NEAR(found.seen[i], hides ? 0.0f : 1.0f, 1e-5f) << "state " << cover << " " << fluid_casts;
                }
            }
        }
    }
}

TEST_F(VisibilityTest, IsTheSameAgain)
{
    const ParticleSet set = scattered();
    const std::vector<glm::vec4> exposure = random_exposure(set.size());
    const sim::VisibilitySettings view{.direction = {0.3f, -1.0f, 0.2f}};
    const Found first = find(set, settings(), view, exposure);
    const Found second = find(set, settings(), view, exposure);
    EXPECT_EQ(first.map, second.map);
    EXPECT_EQ(first.seen, second.seen);
}

} // namespace
} // namespace meltpoint
