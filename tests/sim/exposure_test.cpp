// Where solids are exposed: the device against the twin, and both against the surfaces of blocks and balls.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "conformance/device.h"
#include "core/random.h"
#include "reference/exposure.h"
#include "shared/exposure.h"
#include "sim/exposure.h"
#include "support/fluid_states.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

constexpr float d = test_spacing;
constexpr double face = static_cast<double>(d) * static_cast<double>(d); // of a lattice cell
const glm::vec4 untouched(7.0f);

class ExposureTest : public GpuTest {
protected:
    static sim::SimulationSettings settings(float support_ratio = 3.0f)
    {
        sim::SimulationSettings settings = test_settings(shared::KERNEL_WENDLAND);
        settings.options.still = true;
        settings.params.support_radius = support_ratio * d;
        settings.params.wall_mask = 0;
        return settings;
    }

    /// What the device has: the particles, with their weights, and their exposure, both by id.
    struct Found {
        ParticleSet particles;
        shared::SphParams params;
        std::vector<glm::vec4> exposure;
    };

    /// portion: particles a call; 0 for all at once.
    static Found find(const ParticleSet& set, const sim::SimulationSettings& settings, std::uint32_t portion = 0)
    {
        conformance::Device device(context(), set, settings);
        const auto count = static_cast<std::uint32_t>(set.size());
        sim::Exposure exposure(context(), settings.options, count,
                               device.params.grid_size.x * device.params.grid_size.y * device.params.grid_size.z);
        gpu::upload<glm::vec4>(context(), exposure.exposure(), std::vector<glm::vec4>(count, untouched));
        device.run([&] {
            sim::record_partition(device.commands, device.kernels, device.params_buffer, device.particles, device.grid);
            sim::record_boundary_weight(device.commands, device.kernels, device.params_buffer, device.particles,
                                        device.grid);
            if (portion == 0) {
                exposure.record(device.commands, device.params_buffer, device.particles, device.grid);
            }
            for (std::uint32_t first = 0; portion > 0 && first < count; first += portion) { // beyond the last one too
                exposure.record(device.commands, device.params_buffer, device.particles, device.grid, first, portion);
            }
        });
        return {.particles = download(context(), device.particles),
                .params = device.params,
                .exposure = gpu::download<glm::vec4>(context(), exposure.exposure(), count)};
    }

    static void make_solid(ParticleSet& set, std::size_t first = 0)
    {
        std::fill(set.attributes.begin() + static_cast<std::ptrdiff_t>(first), set.attributes.end(),
                  shared::pack_attributes(shared::STATE_SOLID, 2));
    }

    /// The solid particles of a lattice turned by `angles` (radians, about z and then x) for which `is_inside` holds of
    /// the place in spacings from the middle of the box, each moved by up to `jitter` spacings along each axis before.
    template <class Inside>
    static ParticleSet carve(const glm::vec2& angles, float jitter, const Inside& is_inside)
    {
        Random random(3);
        const glm::vec2 c = glm::cos(angles);
        const glm::vec2 s = glm::sin(angles);
        const glm::mat3 turn =
            glm::mat3(1, 0, 0, 0, c.y, s.y, 0, -s.y, c.y) * glm::mat3(c.x, s.x, 0, -s.x, c.x, 0, 0, 0, 1);
        ParticleSet set;
        constexpr int reach = 18;
        for (int z = -reach; z < reach; ++z) {
            for (int y = -reach; y < reach; ++y) {
                for (int x = -reach; x < reach; ++x) {
                    const glm::vec3 place =
                        turn * (glm::vec3(x, y, z) + 0.5f) + jitter * (2.0f * random_vector(random) - 1.0f);
                    if (is_inside(place)) {
                        add_particle(set, d * (place + 20.0f));
                    }
                }
            }
        }
        make_solid(set);
        return set;
    }

    /// A box 40 spacings wide.
    static sim::SimulationSettings wide_settings()
    {
        sim::SimulationSettings its = settings();
        its.params.domain_max = glm::vec3(40.0f * d);
        return its;
    }

    static bool in_cube(const glm::vec3& place) { return glm::all(glm::lessThan(glm::abs(place), glm::vec3(10.0f))); }

    /// The area in the middle of the upper face of that cube, over the truth.
    static double share_of_top(const Found& found)
    {
        double sum = 0.0;
        for (std::size_t i = 0; i < found.exposure.size(); ++i) {
            const glm::vec3 place = found.particles.position[i] / d - 20.0f;
            sum += place.y > 5.0f && std::abs(place.x) < 6.0f && std::abs(place.z) < 6.0f
                       ? static_cast<double>(found.exposure[i].w)
                       : 0.0;
        }
        return sum / (144.0 * face);
    }

    /// A disordered solid in a corner of the domain, with fluid on and in it, a sheet of boundary particles on it, some
    /// dust, and single solid particles all over the domain.
    static ParticleSet mixed_state(const sim::SimulationSettings& settings)
    {
        Random random(11);
        const bool is_flat = settings.options.dimensions == 2;
        const glm::vec3& size = settings.params.domain_max;
        ParticleSet all = lattice_state({12, 11, is_flat ? 1u : 10u}, glm::vec3(0.4f * d));
        for (std::size_t i = 0; i < all.size(); ++i) {
            all.position[i] += 0.3f * d * (random_vector(random) - 0.5f);
            const bool is_fluid = all.position[i].y > 0.35f || random.uniform() < 0.05;
            all.attributes[i] = shared::pack_attributes(is_fluid ? shared::STATE_FLUID : shared::STATE_SOLID, 2);
        }
        add_plate(all, 1.0f, 0.45f, 0.75f * d, 0.3f, 3);
        for (int i = 0; i < 80; ++i) {
            add_particle(all, random_vector(random) * glm::vec3(size.x, size.y, 1.0f));
            const bool is_dust = i < 20;
            all.attributes.back() = shared::pack_attributes(is_dust ? shared::STATE_DUST : shared::STATE_SOLID, 2);
            all.weight.back() = is_dust ? 0.0f : 1.0f;
        }
        ParticleSet set;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const bool is_first_row = all.position[i].z < 0.5f * d || i + 80 >= all.size();
            if (all.position[i].x < size.x && (!is_flat || is_first_row)) {
                add_particle(set, all.position[i]);
                set.attributes.back() = all.attributes[i];
                set.weight.back() = all.weight[i];
            }
        }
        return is_flat ? in_plane(set) : set;
    }
};

TEST_F(ExposureTest, NearChangesItIsThatOfAllAndElsewhereAsItWas)
{
    for (const std::uint32_t periodic : {0x00u, 0x3fu}) {
        for (const float ratio : {1.25f, 2.0f, 3.0f}) {
            SCOPED_TRACE(testing::Message() << "H = " << ratio << " d, periodic " << periodic);
            sim::SimulationSettings its = settings(ratio);
            set_kernel_scales(its.params, shared::KERNEL_WENDLAND, static_cast<double>(d));
            its.params.wall_mask = 0x3fu & ~periodic;
            its.params.periodic_mask = periodic;
            its.params.domain_max = {1.03f, 0.97f, 1.01f}; // no whole number of cells
            Random random(5);
            ParticleSet set;
            for (int i = 0; i < 6000; ++i) { // clumps, some of them at borders
                const glm::vec3 clump = glm::vec3(i % 3, i / 3 % 3, i / 9 % 3) * 0.48f;
                const glm::vec3 x = clump + 0.3f * (random_vector(random) - 0.5f);
                add_particle(set, glm::clamp(x, glm::vec3(0.01f), its.params.domain_max - 0.01f));
            }
            make_solid(set);
            conformance::Device device(context(), set, its);
            const glm::uvec3 cells = device.params.grid_size;
            const auto count = static_cast<std::uint32_t>(set.size());
            sim::Exposure exposure(context(), its.options, count, cells.x * cells.y * cells.z);
            const auto find_changes = [&](bool start) {
                device.run([&] {
                    if (start) {
                        exposure.record_start(device.commands);
                    }
                    sim::record_partition(device.commands, device.kernels, device.params_buffer, device.particles,
                                          device.grid);
                    sim::record_boundary_weight(device.commands, device.kernels, device.params_buffer, device.particles,
                                                device.grid);
                    exposure.record_changes(device.commands, device.params_buffer, device.particles, device.grid,
                                            false);
                });
                return exposure.download();
            };
            const std::vector<glm::vec4> first = find_changes(true);
            EXPECT_EQ(find_changes(false), first) << "nothing has changed";
            ParticleSet changed = download(context(), device.particles);
            for (std::size_t i = 0; i < changed.size(); i += 450) {
                if (i / 450 % 3 == 0) {
                    changed.position[i] = glm::vec3(0.02f, 0.5f, 0.02f) + 0.1f * random_vector(random);
                } else {
                    changed.attributes[i] =
                        shared::pack_attributes(i / 450 % 3 == 1 ? shared::STATE_COLLIDER : shared::STATE_DEAD, 2);
                    changed.weight[i] = i / 450 % 3 == 1 ? changed.weight[i] : 0.0f;
                }
            }
            upload(context(), changed, device.particles);
            const std::vector<glm::vec4> after = find_changes(false);
            const std::vector<glm::vec4> all = find_changes(true);
            EXPECT_TRUE(after == all);
            EXPECT_FALSE(after == first);
        }
    }
}

TEST_F(ExposureTest, IsThatOfItsTwin)
{
    struct Domain {
        float support_ratio;
        std::uint32_t dimensions;
        float width; // m; less than 7 d: both borders are within reach
    };
    struct Borders {
        std::uint32_t walls;
        std::uint32_t periodic;
    };
    for (const Domain& domain : {Domain{2.0f, 3, 1.0f},
                                 {3.0f, 3, 1.0f},
                                 {1.25f, 3, 4.2f * d},
                                 {4.0f, 3, 8.0f * d},
                                 {2.0f, 2, 1.0f},
                                 {3.0f, 2, 6.0f * d}}) {
        for (const Borders& borders : {Borders{0, 0}, {0x3f, 0}, {0, 0x3f}, {0x0d, 0x30}}) {
            SCOPED_TRACE(testing::Message()
                         << "H = " << domain.support_ratio << " d, " << domain.dimensions << " D, " << domain.width
                         << " m wide, walls " << borders.walls << ", periodic " << borders.periodic);
            sim::SimulationSettings its = settings(domain.support_ratio);
            set_kernel_scales(its.params, shared::KERNEL_WENDLAND, static_cast<double>(d));
            if (domain.dimensions == 2) {
                lay_flat(its);
            }
            const std::uint32_t axes = domain.dimensions == 2 ? 0x0f : 0x3f;
            its.params.wall_mask = borders.walls & axes;
            its.params.periodic_mask = borders.periodic & axes;
            its.params.domain_max.x = domain.width;
            const ParticleSet set = mixed_state(its);
            const Found found = find(set, its);
            const reference::State twin = reference::from_particle_set(found.particles);
            const reference::Settings twin_settings = conformance::reference_settings(found.params, its);
            const auto all = reference::exposure_of_all(twin_settings, twin);
            const auto exposed = reference::exposure(twin_settings, twin);
            const double cell_face = domain.dimensions == 2 ? static_cast<double>(d) : face;
            const double least = static_cast<double>(shared::LEAST_EXPOSURE) * cell_face;
            std::size_t outside = 0;
            std::size_t inside = 0;
            for (std::size_t i = 0; i < set.size(); ++i) {
                if (shared::particle_state(set.attributes[i]) != shared::STATE_SOLID) {
                    EXPECT_EQ(found.exposure[i], untouched);
                    EXPECT_EQ(all[i], glm::dvec4(0.0));
                    continue;
                }
                (exposed[i].w > 0.0 ? outside : inside) += 1;
                if (std::abs(all[i].w - least) > 1e-4 * least) { // or rounding decides
                    const glm::dvec4 gpu(found.exposure[i]);
                    const double bound =
                        1e-5 * std::max(cell_face, exposed[i].w); // of what is thin it is several faces
                    EXPECT_LT(glm::length(gpu.w * glm::dvec3(gpu) - exposed[i].w * glm::dvec3(exposed[i])), bound)
                        << "particle " << i;
                    EXPECT_NEAR(gpu.w, exposed[i].w, bound) << "particle " << i;
                }
            }
            EXPECT_GT(outside, 40u);
            EXPECT_GT(inside, domain.dimensions == 2 ? 0u : domain.width < 6.0f * d ? 1u : 20u);
        }
    }
}

TEST_F(ExposureTest, WhatIsThinIsExposedOnAllItsSides)
{
    struct Shape {
        glm::ivec3 particles;
        double faces; // that the middle one shows
    };
    for (const Shape& shape : {Shape{{1, 1, 1}, 6.0}, {{9, 1, 1}, 4.0}, {{9, 9, 1}, 2.0}}) {
        const sim::SimulationSettings its = settings(2.0f);
        ParticleSet set = lattice_state(shape.particles, glm::vec3(0.3f));
        make_solid(set);
        const Found found = find(set, its);
        const std::size_t middle = set.size() / 2;
        EXPECT_GT(found.exposure[middle].w, 0.6 * shape.faces * face);
        EXPECT_LT(found.exposure[middle].w, 1.1 * shape.faces * face);
    }
}

TEST_F(ExposureTest, LayersOfALatticeAddUpToItsFace)
{
    for (const float ratio : {2.0f, 3.0f}) {
        sim::SimulationSettings its = wide_settings();
        its.params.support_radius = ratio * d;
        const Found found = find(carve(glm::vec2(0.0f), 0.0f, in_cube), its);
        EXPECT_NEAR(share_of_top(found), 1.0, 1e-5);
        std::size_t inside = 0;
        for (std::size_t i = 0; i < found.exposure.size(); ++i) {
            const glm::vec3 depth = 10.0f - glm::abs(found.particles.position[i] / d - 20.0f);
            if (glm::all(glm::greaterThan(depth, glm::vec3(2.0f)))) {
                EXPECT_EQ(found.exposure[i], glm::vec4(0.0f));
                ++inside;
            } else if (depth.x < 2.0f && std::min(depth.y, depth.z) > 4.0f) {
                const float outward = found.particles.position[i].x > 20.0f * d ? 1.0f : -1.0f;
                EXPECT_NEAR(found.exposure[i].x, outward, 1e-6f);
                EXPECT_NEAR(found.exposure[i].w / static_cast<float>(face), depth.x < 1.0f ? 0.7755f : 0.2245f, 1e-4f);
            }
        }
        EXPECT_EQ(inside, 16u * 16u * 16u);
    }
}

TEST_F(ExposureTest, OfASolidThatMeltsToAnotherVolumeIsItsFace)
{
    for (const float volume :
         {1000.0f / 917.0f, 0.9f}) { // over that of its fluid, which its particles are weighted with
        const float pitch = d * std::cbrt(volume);
        ParticleSet set;
        for (int i = 0; i < 14 * 14 * 14; ++i) {
            add_particle(set, glm::vec3(0.5f) + pitch * (glm::vec3(i % 14, i / 14 % 14, i / 196) - 6.5f));
            set.weight.back() = volume;
        }
        make_solid(set);
        const Found found = find(set, settings());
        double sum = 0.0;
        for (std::size_t i = 0; i < set.size(); ++i) {
            const glm::vec3 place = (found.particles.position[i] - 0.5f) / pitch;
            const bool in_middle = std::max(std::abs(place.x), std::abs(place.z)) < 2.0f;
            sum += in_middle && place.y > 3.0f ? static_cast<double>(found.exposure[i].w) : 0.0;
        }
        EXPECT_NEAR(sum / (16.0 * std::pow(static_cast<double>(pitch), 2)), 1.0, 0.03) << volume;
    }
}

TEST_F(ExposureTest, LinesOfALatticeInThePlaneAddUpToItsSide)
{
    sim::SimulationSettings its = settings();
    lay_flat(its);
    its.params.wall_mask = 0;
    ParticleSet set = square_state({14, 14}, glm::vec2(3.0f * d));
    make_solid(set);
    const Found found = find(set, its);
    double sum = 0.0;
    for (std::size_t i = 0; i < set.size(); ++i) {
        const glm::vec2 place = glm::vec2(found.particles.position[i]) / d - 3.0f;
        sum += place.y > 8.0f && std::abs(place.x - 6.5f) < 2.0f ? static_cast<double>(found.exposure[i].w) : 0.0;
    }
    EXPECT_NEAR(sum, 4.0 * static_cast<double>(d), 1e-5 * static_cast<double>(d));
}

// Lattices that lie askew, and particles off their lattice, have a surface as well.
TEST_F(ExposureTest, IsThatOfOtherArrangementsToo)
{
    const auto share = [](const glm::vec2& angles, float jitter) {
        return share_of_top(find(carve(angles, jitter, in_cube), wide_settings()));
    };
    EXPECT_NEAR(share({0.4f, 0.3f}, 0.0f), 1.0, 0.07);
    EXPECT_NEAR(share({0.8f, 0.6f}, 0.0f), 1.0, 0.07);
    EXPECT_NEAR(share({0.8f, 0.6f}, 0.1f), 1.0, 0.07);
}

TEST_F(ExposureTest, OfABallIsAsLargeAsItsCurvatureLetsItBe)
{
    constexpr double radius = 11.5;
    const Found found =
        find(carve(glm::vec2(0.0f), 0.0f, [](const glm::vec3& place) { return glm::length(place) < 11.5f; }),
             wide_settings());
    double area = 0.0;
    double tilt = 0.0; // weighted with the area
    glm::dvec3 sum(0.0);
    for (std::size_t i = 0; i < found.exposure.size(); ++i) {
        const glm::dvec4 exposed(found.exposure[i]);
        const glm::dvec3 outward =
            glm::normalize(glm::dvec3(found.particles.position[i]) - 20.0 * static_cast<double>(d));
        if (exposed.w > 0.0) {
            const double angle = std::acos(std::min(glm::dot(outward, glm::dvec3(exposed)), 1.0));
            EXPECT_LT(angle, 14.0 * std::numbers::pi / 180.0);
            tilt += exposed.w * angle;
            area += exposed.w;
            sum += exposed.w * glm::dvec3(exposed);
        }
    }
    EXPECT_NEAR(area / (4.0 * std::numbers::pi * radius * radius * face), 0.911, 0.01);
    EXPECT_LT(tilt / area, 4.5 * std::numbers::pi / 180.0);
    EXPECT_LT(glm::length(sum), 1e-4 * area);
}

TEST_F(ExposureTest, WhatStandsAtAWallIsNotExposedThere)
{
    // In the corner of floor and a side wall, and from border to border along z, periodic or between walls.
    for (const bool periodic : {false, true}) {
        SCOPED_TRACE(periodic);
        sim::SimulationSettings its = settings(2.0f);
        its.params.wall_mask = periodic ? 0x0fu : 0x3fu;
        its.params.periodic_mask = periodic ? 0x30u : 0u;
        ParticleSet set = lattice_state({10, 8, 20}, glm::vec3(0.5f * d));
        make_solid(set);
        const Found found = find(set, its);
        glm::dvec3 sum(0.0);
        for (std::size_t i = 0; i < set.size(); ++i) {
            const glm::vec4& exposed = found.exposure[i];
            const glm::vec3 place = found.particles.position[i] / d;
            sum += static_cast<double>(exposed.w) * glm::dvec3(exposed);
            EXPECT_NEAR(exposed.z, 0.0f, 1e-5f);
            if (place.x < 6.0f && place.y < 4.0f) {
                EXPECT_EQ(exposed, glm::vec4(0.0f)) << "particle " << i;
            } else if (place.x > 9.0f && place.y < 4.0f) { // the side rises straight from the floor
                EXPECT_NEAR(exposed.x, 1.0f, 1e-6f);
                EXPECT_NEAR(exposed.w / static_cast<float>(face), 0.7755f, 1e-4f);
            }
        }
        EXPECT_NEAR(sum.x, 0.95 * 8.0 * 20.0 * face, 0.05 * 8.0 * 20.0 * face); // its edge is worn
        EXPECT_NEAR(sum.y, 0.95 * 10.0 * 20.0 * face, 0.05 * 10.0 * 20.0 * face);
    }
}

TEST_F(ExposureTest, CollidersCoverAndFluidDoesNot)
{
    for (const std::uint32_t state : {shared::STATE_SOLID, shared::STATE_FLUID, shared::STATE_COLLIDER}) {
        ParticleSet set = carve(glm::vec2(0.0f), 0.0f, in_cube);
        for (std::size_t i = 0; i < set.size(); ++i) {
            if (set.position[i].y > 25.0f * d) { // the upper quarter
                set.attributes[i] = shared::pack_attributes(state, 2);
            }
        }
        const Found found = find(set, wide_settings());
        double upward = 0.0; // of the face below that quarter
        for (std::size_t i = 0; i < set.size(); ++i) {
            const glm::vec3 place = found.particles.position[i] / d - 20.0f;
            if (place.y < 5.0f && place.y > 3.0f && std::abs(place.x) < 5.0f && std::abs(place.z) < 5.0f) {
                upward +=
                    static_cast<double>(std::max(found.exposure[i].y, 0.0f) * found.exposure[i].w) / (100.0 * face);
            }
        }
        EXPECT_NEAR(upward, state == shared::STATE_FLUID ? 1.0 : 0.0, 1e-5) << "state " << state;
    }
}

TEST_F(ExposureTest, IsTheSameInPortionsAndAgain)
{
    sim::SimulationSettings its = settings(2.0f);
    its.params.wall_mask = 0x3f;
    const ParticleSet set = mixed_state(its);
    const Found whole = find(set, its);
    EXPECT_EQ(whole.exposure, find(set, its).exposure);
    EXPECT_EQ(whole.exposure, find(set, its, 100).exposure);
}

} // namespace
} // namespace meltpoint
