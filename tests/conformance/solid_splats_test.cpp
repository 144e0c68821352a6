// The splats of solids: the device against the twin, and what they do when solids erode.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "conformance/device.h"
#include "core/random.h"
#include "reference/solid_splats.h"
#include "render/solid_splats.h"
#include "run/solid_splats.h"
#include "shared/render_params.h"
#include "support/fluid_states.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

constexpr float d = test_spacing;
constexpr float never = std::numeric_limits<float>::infinity();
constexpr std::uint32_t ice = 2; // a material
constexpr double latent_heat = 334e3;

/// Particles and what is known of them by id, and the frame they are seen at.
struct Solids {
    ParticleSet particles;
    std::vector<float> freed_at;
    std::vector<double> enthalpy;
    std::vector<double> damage;
    std::vector<shared::HostedSplat> hosted;
    std::vector<std::uint32_t> cover;
    double time = 0.0;
};

class SolidSplatsTest : public GpuTest {
protected:
    static sim::SimulationSettings settings()
    {
        sim::SimulationSettings settings = test_settings(shared::KERNEL_WENDLAND);
        settings.options.still = true;
        settings.params.support_radius = 2.0f * d;
        return settings;
    }

    static shared::SolidSplatParams splat_params()
    {
        shared::SolidSplatParams params{.progress =
                                            shared::PROGRESS_MELTING | shared::PROGRESS_DAMAGE | shared::PROGRESS_FRONT,
                                        .blend_time = 0.5f};
        params.latent_heat[ice] = static_cast<float>(latent_heat);
        params.front_time[ice] = 0.2f;
        params.color[ice] = {0.2f, 0.4f, 0.8f};
        params.wet_albedo[ice] = 0.6f;
        return params;
    }

    /// What the device makes of it, in the form of the twin, after `frames` frames a tenth of a second apart. In the
    /// first of them all have that damage, if it is positive.
    static reference::SolidSplats on_device(const Solids& solids, int frames = 1, double first_damage = -1.0)
    {
        conformance::Device device(context(), solids.particles, settings());
        const auto count = static_cast<std::uint32_t>(solids.particles.size());
        const auto two_floats = [&](const std::vector<double>& values) {
            std::vector<glm::vec2> pairs;
            for (const double value : values) {
                pairs.emplace_back(static_cast<float>(value), 0.0f);
            }
            gpu::Buffer buffer = gpu::make_buffer<glm::vec2>(context(), count, "two-floats");
            gpu::upload<glm::vec2>(context(), buffer, pairs);
            return buffer;
        };
        const gpu::Buffer enthalpy = two_floats(solids.enthalpy);
        const gpu::Buffer damage = two_floats(solids.damage);
        const gpu::Buffer damage_before = two_floats(std::vector<double>(count, first_damage));
        const gpu::Buffer freed_at = gpu::make_buffer<float>(context(), count, "freed at");
        gpu::upload<float>(context(), freed_at, solids.freed_at);
        render::SolidSplats splats(context(), splat_params(), solids.hosted, solids.cover);
        constexpr std::uint32_t first = 3;
        const std::vector<glm::vec4> before(first, glm::vec4(1.0f));
        const render::DiscBuffers discs(context(), before, before, before, splats.room());
        device.run([&] {
            sim::record_partition(device.commands, device.kernels, device.params_buffer, device.particles, device.grid);
        });
        for (int frame = 1; frame <= frames; ++frame) {
            device.run([&] {
                splats.record(device.commands,
                              {.params = device.params_buffer,
                               .cell_start = device.grid.cell_start,
                               .particles = device.particles,
                               .enthalpy = &enthalpy,
                               .damage = frame == 1 && first_damage > 0.0 ? &damage_before : &damage,
                               .freed_at = &freed_at,
                               .time = solids.time + 0.1 * (frame - frames)},
                              discs, first);
            });
        }
        const std::vector<std::uint32_t> id = download_unordered(context(), device.particles).id;
        const auto size = gpu::download<float>(context(), splats.size(), count);
        const auto kept = gpu::download<shared::KeptOfSolid>(context(), splats.kept(), count);
        const std::uint32_t all = first + splats.room();
        const auto position = gpu::download<glm::vec4>(context(), discs.position(), all);
        const auto normal = gpu::download<glm::vec4>(context(), discs.normal(), all);
        const auto color = gpu::download<glm::vec4>(context(), discs.color(), all);
        const auto bend = gpu::download<glm::vec4>(context(), discs.bend(), all);
        EXPECT_EQ(position[first - 1], before[0]);
        const auto disc = [&](std::size_t k) {
            return reference::Disc{.center = position[k],
                                   .radius = position[k].w,
                                   .normal = normal[k],
                                   .color = color[k],
                                   .bend = bend[k],
                                   .edge = color[k].w,
                                   .wet = bend[k].w};
        };
        reference::SolidSplats found{.left = {},
                                     .size = std::vector<double>(count),
                                     .wet = std::vector<double>(count),
                                     .start = {},
                                     .changed = {},
                                     .kept = {},
                                     .particle = {},
                                     .hosted = {}};
        found.particle.resize(count);
        for (std::uint32_t place = 0; place < count; ++place) {
            found.wet[place] = static_cast<double>(kept[place].wetness);
            found.size[id[place]] = static_cast<double>(size[place]);
            found.particle[id[place]] = disc(first + place);
            EXPECT_TRUE(position[first + place].w == 0.0f || normal[first + place].w == shared::DISC_BENT);
        }
        for (std::size_t k = first + count; k < all; ++k) {
            found.hosted.push_back(disc(k));
            EXPECT_EQ(normal[k].w, shared::DISC_EDGED);
        }
        return found;
    }

    static reference::SolidSplats by_twin(const Solids& solids, int frames = 1)
    {
        const reference::State state = reference::from_particle_set(solids.particles);
        reference::SolidSplats found;
        for (int frame = 1; frame <= frames; ++frame) {
            const double time = solids.time + 0.1 * (frame - frames);
            found = reference::solid_splats({.params = settings().params}, splat_params(), state,
                                            {.freed_at = solids.freed_at,
                                             .enthalpy = solids.enthalpy,
                                             .damage = solids.damage,
                                             .hosted = solids.hosted,
                                             .cover = solids.cover,
                                             .time = time,
                                             .seconds = frame == 1 ? time : 0.1},
                                            found);
        }
        return found;
    }

    static void expect_equal(const reference::Disc& device, const reference::Disc& twin, const std::string& which)
    {
        constexpr double tiny = 2e-4 * static_cast<double>(d);
        ASSERT_NEAR(device.radius, twin.radius, tiny) << which;
        if (twin.radius <= tiny) {
            return;
        }
        EXPECT_LT(glm::distance(device.center, twin.center), tiny) << which;
        EXPECT_LT(glm::distance(device.normal, twin.normal), 1e-4) << which;
        EXPECT_LT(glm::distance(device.color, twin.color), 1e-4) << which;
        EXPECT_LT(glm::distance(device.bend, twin.bend), 2e-3 / static_cast<double>(d)) << which;
        EXPECT_NEAR(device.wet, twin.wet, 1e-4) << which;
    }

    /// A block of solid with fluid on its left half and dust above, whose particles are as far as they are by chance.
    static Solids eroding_block()
    {
        Solids solids;
        Random random(7);
        solids.particles = lattice_state({9, 8, 7}, glm::vec3(0.26f, 0.22f, 0.27f));
        std::ranges::fill(solids.particles.attributes, shared::pack_attributes(shared::STATE_SOLID, ice));
        for (glm::vec3& x : solids.particles.position) {
            x += 0.1f * d * (2.0f * random_vector(random) - 1.0f);
        }
        const std::size_t solid_count = solids.particles.size();
        for (int i = 0; i < 120; ++i) {
            add_particle(solids.particles,
                         glm::vec3(0.25f, 0.59f, 0.25f) + glm::vec3(0.4f, 0.15f, 0.3f) * random_vector(random));
        }
        add_particle(solids.particles, glm::vec3(0.1f)); // a solid particle all alone
        solids.particles.attributes.back() = shared::pack_attributes(shared::STATE_SOLID, ice);
        add_boundary_particle(solids.particles, glm::vec3(0.8f, 0.1f, 0.8f));
        const std::size_t count = solids.particles.size();
        solids.freed_at.assign(count, never);
        solids.enthalpy.assign(count, -1000.0);
        solids.damage.assign(count, 0.0);
        solids.cover.assign(count, shared::NO_COVER);
        solids.time = 3.0;
        for (std::size_t i = 0; i < solid_count; ++i) {
            solids.cover[i] = i % 3 == 0 ? static_cast<std::uint32_t>(i % 60) : shared::NO_COVER;
            switch (i % 4) {
            case 0:
                solids.enthalpy[i] = latent_heat * random.uniform();
                break;
            case 1:
                solids.damage[i] = random.uniform();
                break;
            case 2:
                solids.freed_at[i] = static_cast<float>(3.0 + 0.3 * random.uniform());
                break;
            default:
                break;
            }
        }
        const std::uint32_t causes[] = {shared::CAUSE_NONE, shared::CAUSE_FRONT, shared::CAUSE_MELT,
                                        shared::CAUSE_HYDRAULIC};
        for (std::size_t i = solid_count; i < solid_count + 120; ++i) {
            const std::uint32_t state = i % 10 == 0   ? shared::STATE_DUST
                                        : i % 10 == 1 ? shared::STATE_DEAD
                                                      : shared::STATE_FLUID;
            solids.particles.attributes[i] =
                shared::freed_as(shared::pack_attributes(state, ice), state, causes[i % 4]);
            solids.particles.density[i] = static_cast<float>(random.uniform());
            solids.freed_at[i] = static_cast<float>(3.0 - 0.7 * random.uniform());
        }
        for (std::uint32_t i = 0; i < 60; ++i) { // anywhere: the pass only follows hosts
            solids.hosted.push_back({.host = {i, i + 9, i + 1},
                                     .weight = {0.5f, 0.2f, 0.3f},
                                     .offset = random_vector(random),
                                     .normal = glm::vec3(0.1f, 0.2f, 1.0f) + random_vector(random),
                                     .edge = random_vector(random),
                                     .edge_distance = 0.01f,
                                     .color = {0.1f, 0.2f, 0.3f},
                                     .radius = 0.5f * d,
                                     .wet_albedo = 0.7f,
                                     .span = 1.3f * d}); // rows end between some of them
        }
        return solids;
    }

    /// The upper face of a block 9 x 6 x 9 whose layers are as far as `progress` says, from the top down.
    static Solids layered_block(const std::vector<double>& progress)
    {
        Solids solids;
        solids.particles = lattice_state({9, 6, 9}, glm::vec3(0.25f, 0.25f, 0.25f));
        const std::size_t count = solids.particles.size();
        std::ranges::fill(solids.particles.attributes, shared::pack_attributes(shared::STATE_SOLID, ice));
        solids.freed_at.assign(count, never);
        solids.damage.assign(count, 0.0);
        solids.cover.assign(count, shared::NO_COVER);
        solids.enthalpy.assign(count, 0.0);
        for (std::size_t i = 0; i < count; ++i) {
            const auto layer = static_cast<std::size_t>(5 - std::lround((solids.particles.position[i].y - 0.25f) / d));
            solids.enthalpy[i] = layer < progress.size() ? latent_heat * progress[layer] : 0.0;
        }
        return solids;
    }

    /// Id of the particle in the middle of a layer, from the top down.
    static std::size_t in_middle(std::size_t layer) { return 4 + 9 * (5 - layer) + 9 * 6 * 4; }

    /// A surface splat half a spacing above the particle in the middle of the first layer.
    static shared::HostedSplat in_top_face()
    {
        const auto host = static_cast<std::uint32_t>(in_middle(0));
        return {.host = {host, host + 1, host + 54}, // axes: x, z, -y
                .weight = glm::vec3(1.0f / 3.0f),
                .offset = {0.0f, 0.0f, -0.5f},
                .normal = {0.0f, 0.0f, -1.0f},
                .radius = 0.55f * d,
                .span = 1.5f * d};
    }
};

TEST_F(SolidSplatsTest, TheDeviceConformsToTheTwin)
{
    const Solids solids = eroding_block();
    for (const int frames : {1, 3}) {
        const reference::SolidSplats device = on_device(solids, frames);
        const reference::SolidSplats twin = by_twin(solids, frames);
        std::size_t discs = 0;
        std::size_t wet = 0;
        for (std::size_t i = 0; i < twin.size.size(); ++i) {
            EXPECT_NEAR(device.size[i], twin.size[i], 1e-4) << "ball " << i;
            EXPECT_NEAR(device.wet[i], twin.wet[i], 1e-4) << "wetness " << i;
            expect_equal(device.particle[i], twin.particle[i], "particle " + std::to_string(i));
            discs += twin.particle[i].radius > 0.0 ? 1 : 0;
            wet += twin.wet[i] > 0.1 ? 1 : 0;
        }
        EXPECT_GT(discs, 200u);
        EXPECT_GT(wet, 30u);
        ASSERT_EQ(device.hosted.size(), twin.hosted.size());
        for (std::size_t i = 0; i < twin.hosted.size(); ++i) {
            expect_equal(device.hosted[i], twin.hosted[i], "hosted " + std::to_string(i));
            EXPECT_NEAR(device.hosted[i].edge, twin.hosted[i].edge, 1e-5);
        }
    }
}

TEST_F(SolidSplatsTest, WhoseHostWasFreedIsGoneForGood)
{
    Solids solids = layered_block({});
    solids.hosted.push_back({.host = {0, 1, 9},
                             .weight = glm::vec3(1.0f / 3.0f),
                             .normal = {0, 0, 1},
                             .edge_distance = shared::NO_EDGE,
                             .radius = d,
                             .span = 2.0f * d});
    solids.cover[in_middle(0)] = 0;
    EXPECT_EQ(on_device(solids, 2).hosted[0].radius, static_cast<double>(d));
    EXPECT_EQ(on_device(solids, 2, 0.9).hosted[0].radius, static_cast<double>(d));
    EXPECT_EQ(on_device(solids, 2, 1.0).hosted[0].radius, 0.0);
    EXPECT_EQ(on_device(solids, 2).particle[in_middle(0)].radius, 0.0); // covered
    solids.hosted[0].edge_distance = 0.0f;
    EXPECT_GT(on_device(solids, 2).particle[in_middle(0)].radius, 0.7 * static_cast<double>(d)); // backs it
    EXPECT_GT(on_device(solids, 2, 1.0).particle[in_middle(0)].radius, 0.0);
}

// As those of sand that slides: none is stretched over many spacings.
TEST_F(SolidSplatsTest, WhoseHostsPartIsGone)
{
    Solids solids = layered_block({});
    solids.hosted.push_back(
        {.host = {0, 1, 9}, .weight = glm::vec3(1.0f / 3.0f), .normal = {0, 0, 1}, .radius = d, .span = 1.5f * d});
    solids.particles.position[1].x += 0.5f * d;
    EXPECT_EQ(on_device(solids).hosted[0].radius, static_cast<double>(d));
    solids.particles.position[1].x += 1.0f * d;
    EXPECT_EQ(on_device(solids).hosted[0].radius, 0.0);
}

TEST_F(SolidSplatsTest, InteriorParticlesHaveNoneAndLoneOnesAreBalls)
{
    const Solids solids = eroding_block();
    const reference::SolidSplats whole = on_device(layered_block({}));
    for (std::size_t layer = 2; layer < 4; ++layer) {
        EXPECT_EQ(whole.particle[in_middle(layer)].radius, 0.0);
        EXPECT_EQ(whole.size[in_middle(layer)], 0.0);
    }
    EXPECT_GT(whole.particle[in_middle(0)].radius, 0.99 * static_cast<double>(d));
    EXPECT_EQ(whole.size[in_middle(0)], 0.0);
    EXPECT_NEAR(on_device(solids).size[solids.particles.size() - 2], 1.0, 1e-3); // the lone one
}

TEST_F(SolidSplatsTest, TheSurfaceRecedesSteadilyFromLayerToLayer)
{
    const double spacing = static_cast<double>(d);
    const double top = static_cast<double>(0.25f) + 5.5 * spacing;
    double previous = 1e9;
    for (int step = 0; step <= 20; ++step) { // the first layer goes, then the second
        const double melted = 0.1 * step;
        const reference::SolidSplats found =
            on_device(layered_block({std::min(melted, 1.0), std::clamp(melted - 1.0, 0.0, 1.0)}));
        double height = -1e9;
        for (std::size_t layer = 0; layer < 4; ++layer) {
            const reference::Disc& disc = found.particle[in_middle(layer)];
            if (disc.radius > 0.75 * spacing) { // of those that cover
                EXPECT_GT(disc.normal.y, 0.999);
                height = std::max(height, disc.center.y);
            }
        }
        const double expected = top - (melted + static_cast<double>(shared::PARTICLE_SPLAT_DEPTH)) * spacing;
        EXPECT_NEAR(height, expected, 0.15 * spacing) << melted << " layers have melted";
        EXPECT_LT(height, previous);
        previous = height;
    }
}

TEST_F(SolidSplatsTest, SurfaceSplatsSinkBelowParticleSplatsBeforeTheyShrink)
{
    const double spacing = static_cast<double>(d);
    double previous = 0.0;
    for (int step = 0; step < 20; ++step) {
        const double melted = 0.05 * step;
        Solids solids = layered_block({melted});
        solids.hosted.push_back(in_top_face());
        solids.cover[in_middle(0)] = solids.cover[in_middle(1)] = 0;
        const reference::SolidSplats found = on_device(solids);
        const reference::Disc& surface = found.hosted[0];
        double highest = -1e9;
        for (const std::size_t layer : {0, 1}) {
            const reference::Disc& disc = found.particle[in_middle(layer)];
            highest = std::max(highest, disc.radius > 0.75 * spacing ? disc.center.y : -1e9);
        }
        if (melted < 0.5) {
            EXPECT_GT(surface.center.y, highest + 0.2 * spacing) << melted;
        }
        if (surface.radius < 0.99 * static_cast<double>(in_top_face().radius)) {
            EXPECT_LT(surface.center.y, highest - 0.05 * spacing) << melted;
        }
        if (step > 0) {
            EXPECT_LT(surface.center.y, previous);
            EXPECT_GT(surface.center.y, previous - 0.2 * spacing);
        }
        EXPECT_GT(surface.normal.y, 0.999);
        previous = surface.center.y;
    }
}

// At the edge of what is left, where those beside it have gone.
TEST_F(SolidSplatsTest, SurfaceSplatsDoNotStandOutOfWhatIsLeft)
{
    Solids solids = layered_block({});
    solids.hosted.push_back(in_top_face());
    solids.hosted[0].offset.x = -0.3f;
    for (std::size_t i = 0; i < solids.damage.size(); ++i) {
        solids.damage[i] = i / 9 % 6 >= 3 && i % 9 < 4 ? 1.0 : 0.0;
    }
    const reference::Disc before = on_device(layered_block({}), 1).particle[in_middle(0)];
    const reference::Disc whole = on_device(solids, 1, 1e-3).hosted[0];
    const reference::Disc after = on_device(solids, 3, 1e-3).hosted[0]; // which it notices a frame later
    EXPECT_GT(whole.center.y, before.center.y);
    EXPECT_EQ(after.radius, whole.radius);
    EXPECT_LT(after.center.y, whole.center.y - 0.2 * static_cast<double>(d));
    EXPECT_LT(after.normal.x, -0.2); // toward what has gone
}

TEST_F(SolidSplatsTest, NothingJumpsWhenAParticleIsFreed)
{
    Solids before = layered_block({1.0 - 1e-6});
    Solids after = before;
    for (std::size_t i = 0; i < after.particles.size(); ++i) {
        if (after.enthalpy[i] > 0.0) {
            after.particles.attributes[i] =
                shared::freed_as(after.particles.attributes[i], shared::STATE_FLUID, shared::CAUSE_MELT);
            after.freed_at[i] = 0.0f; // now
        }
    }
    const reference::SolidSplats a = on_device(before);
    const reference::SolidSplats b = on_device(after);
    for (std::size_t i = 0; i < a.size.size(); ++i) {
        EXPECT_NEAR(a.size[i], b.size[i], 1e-3);
        EXPECT_NEAR(a.particle[i].radius, b.particle[i].radius, 1e-3 * static_cast<double>(d));
        if (b.particle[i].radius > 1e-3 * static_cast<double>(d)) {
            EXPECT_LT(glm::distance(a.particle[i].center, b.particle[i].center), 1e-3 * static_cast<double>(d));
        }
    }
}

} // namespace
} // namespace meltpoint
