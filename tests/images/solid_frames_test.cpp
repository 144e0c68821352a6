// Pictures of solids that erode, frame by frame while the camera stands still: no hole shows what lies inside, nothing
// pops.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/parallel_for.h"
#include "gpu/transfer.h"
#include "run/frame_painter.h"
#include "run/solid_splats.h"
#include "run/start_scene.h"
#include "scene/scene_file.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

constexpr std::uint32_t width = 160;
constexpr std::uint32_t height = 90;
constexpr std::uint32_t samples = 2;

struct Case {
    const char* scene;
    float spacing;      ///< m, much coarser than the scene's own
    double start;       ///< s, of the first frame
    double interval;    ///< s, between frames
    double holes;       ///< most samples in a million of the solid
    double mean;        ///< most of the mean change from frame to frame, in 8-bit steps
    double extreme;     ///< and of that of the thousandth pixel that changes most
    float slack = 0.0f; ///< spacings, by which the surface may lie behind a particle: of sand it is a mean
};

void PrintTo(const Case& which, std::ostream* out)
{
    *out << which.scene;
}

/// A built-in scene as it runs and is drawn, small.
class Show {
public:
    Show(const gpu::Context& context, const Case& which)
        : scene_(small(which)), started_(start_scene(context, scene_)),
          painter_(context, scene_, started_.params, &*started_.simulation), context_(context)
    {
        painter_.settings().box = false;
        painter_.settings().floor.reset();
    }

    [[nodiscard]] sim::Simulation& simulation() { return *started_.simulation; }
    [[nodiscard]] FramePainter& painter() { return painter_; }
    [[nodiscard]] Image paint() { return painter_.paint(&*started_.simulation); }

    /// Where solid particles are that are less than half gone, m.
    [[nodiscard]] std::vector<glm::vec3> whole_solids()
    {
        const ParticleSet particles = simulation().download();
        const shared::SolidSplatParams params = solid_splat_params(scene_);
        const std::vector<double> enthalpy = simulation().enthalpy();
        const std::vector<double> damage = simulation().damage();
        const auto freed_at = gpu::download<float>(context_, *simulation().release_time(), particles.size());
        std::vector<glm::vec3> whole;
        for (std::size_t i = 0; i < particles.size(); ++i) {
            const std::uint32_t material = shared::particle_material(particles.attributes[i]);
            const double latent_heat = static_cast<double>(params.latent_heat[material]);
            const double front =
                static_cast<double>(params.front_time[material] > 0.0f
                                        ? shared::front_progress(freed_at[i], static_cast<float>(simulation().time()),
                                                                 params.front_time[material])
                                        : 0.0f);
            const double melted = latent_heat > 0.0 ? enthalpy[i] / latent_heat : 0.0;
            const double progress = std::max({front, melted, damage.empty() ? 0.0 : damage[i]});
            if (shared::particle_state(particles.attributes[i]) == shared::STATE_SOLID && progress < 0.5) {
                whole.push_back(particles.position[i]);
            }
        }
        return whole;
    }

    /// Those of them that the others surround: a spacing below a flat surface and deeper, below the exposed layer.
    [[nodiscard]] std::vector<glm::vec3> inner_solids()
    {
        const std::vector<glm::vec3> whole = whole_solids();
        const double reach = static_cast<double>(shared::SURFACE_SUPPORT * scene_.particles.spacing);
        const double scale =
            21.0 / (2.0 * std::numbers::pi * std::pow(static_cast<double>(shared::SURFACE_SUPPORT), 3));
        std::vector<glm::vec3> inner;
        for (const glm::vec3& x : whole) {
            double filling = 0.0; // of the space around it, by Wendland's kernel
            for (const glm::vec3& other : whole) {
                const double q = static_cast<double>(glm::distance(x, other)) / reach;
                filling += q < 1.0 ? scale * std::pow(1.0 - q, 4) * (1.0 + 4.0 * q) : 0.0;
            }
            if (filling > 0.93) {
                inner.push_back(x);
            }
        }
        return inner;
    }

    /// Of the samples behind which such particles lie, how many in a million show what lies behind the first of them:
    /// others of the inside, or the background.
    [[nodiscard]] double holes(float slack)
    {
        static_cast<void>(paint());
        const std::vector<float> seen = painter_.renderer().capture_distance();
        const std::vector<glm::vec3> solids = inner_solids();
        const shared::SplatCamera camera =
            render::splat_camera(painter_.settings().camera, width * samples, height * samples);
        std::vector<glm::vec3> centers;
        for (const glm::vec3& x : solids) {
            centers.emplace_back(camera.view * glm::vec4(x, 1.0f));
        }
        const float radius = 0.45f * scene_.particles.spacing;
        std::vector<std::uint8_t> is_solid(seen.size(), 0);
        std::vector<std::uint8_t> is_hole(seen.size(), 0);
        parallel_for(seen.size(), [&](std::size_t i) {
            const glm::vec2 sample(static_cast<float>(i % (width * samples)) + 0.5f,
                                   static_cast<float>(i / (width * samples)) + 0.5f);
            const glm::vec2 plane = (sample * camera.pixel - 1.0f) * camera.plane_scale + camera.plane_offset;
            const glm::vec3 ray = glm::normalize(glm::vec3(plane, -1.0f));
            float nearest = std::numeric_limits<float>::infinity();
            for (const glm::vec3& center : centers) {
                const float along = glm::dot(center, ray);
                const glm::vec3 off = center - along * ray;
                if (along > 0.0f && glm::dot(off, off) < radius * radius) {
                    nearest = std::min(nearest, -along * ray.z);
                }
            }
            is_solid[i] = std::isfinite(nearest) ? 1 : 0;
            is_hole[i] = seen[i] > nearest + slack * scene_.particles.spacing ? 1 : 0;
        });
        const auto solid_count = static_cast<double>(std::ranges::count(is_solid, 1));
        return 1e6 * static_cast<double>(std::ranges::count(is_hole, 1)) / std::max(solid_count, 1.0);
    }

private:
    static Scene small(const Case& which)
    {
        Scene scene = builtin_scene(which.scene);
        scene.particles.spacing = which.spacing;
        scene.render.width = width;
        scene.render.height = height;
        for (EmitterBody& emitter : scene.emitters) {
            emitter.particles.reset();
        }
        return scene;
    }

    Scene scene_;
    StartedScene started_;
    FramePainter painter_;
    const gpu::Context& context_;
};

struct Change {
    double mean = 0.0;
    double extreme = 0.0; ///< of the thousandth pixel that changes most
};

/// In 8-bit steps, of the channel that changes most.
Change change(const Image& a, const Image& b)
{
    std::vector<int> steps;
    for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
        int most = 0;
        for (std::size_t c = 0; c < 3; ++c) {
            most = std::max(most, std::abs(int{a.rgba[i + c]} - int{b.rgba[i + c]}));
        }
        steps.push_back(most);
    }
    std::ranges::sort(steps);
    double sum = 0.0;
    for (const int step : steps) {
        sum += step;
    }
    return {.mean = sum / static_cast<double>(steps.size()),
            .extreme = static_cast<double>(steps[steps.size() - 1 - steps.size() / 1000])};
}

class SolidFramesTest : public GpuTest, public testing::WithParamInterface<Case> {};

TEST_P(SolidFramesTest, NoHoleShowsTheInside)
{
    Show show(context(), GetParam());
    double worst = show.holes(GetParam().slack);
    for (int frame = 0; frame < 12; ++frame) {
        show.simulation().advance_by(0.1);
        const double holes = show.holes(GetParam().slack);
        worst = std::max(worst, holes);
    }
    RecordProperty("holes", std::to_string(worst));
    EXPECT_LE(worst, GetParam().holes);
}

TEST_P(SolidFramesTest, NothingPops)
{
    Show show(context(), GetParam());
    show.painter().settings().bounds = {};          // no shadows, which fluid casts
    show.painter().settings().splat_radius = 1e-6f; // nor its balls
    show.simulation().advance_by(GetParam().start);
    Image before = show.paint();
    Change worst;
    for (int frame = 0; frame < 40; ++frame) {
        show.simulation().advance_by(GetParam().interval);
        const Image now = show.paint();
        const Change its = change(before, now);
        worst.mean = std::max(worst.mean, its.mean);
        worst.extreme = std::max(worst.extreme, its.extreme);
        before = now;
    }
    RecordProperty("mean", std::to_string(worst.mean));
    RecordProperty("extreme", std::to_string(worst.extreme));
    EXPECT_LE(worst.mean, GetParam().mean);
    EXPECT_LE(worst.extreme, GetParam().extreme);
}

// Bounds are a quarter to a half above what a software device measures:
//   holes    0, 6603, 12116, 1804, 652, 0 in a million: the teapot's are at its thin lid and where its spout reaches
//   into
//            its body, the block's and the river's where bodies touch whose heights are no multiples of these coarse
//            spacings, so that space is left between them. Without discs that back the edges they are 0, 5282, 13086,
//            6746, 1948, 4979. The dune's are 2235, along its outline, where single columns stand above the mean that
//            is seen.
//   changes  0.156/26, 0.189/28, 0.132/42, 0.313/53, 0.046/20, 0.043/15, 0.135/22: solids change at looks, a
//            twentieth of a particle's life apart. The river's are 0.4/101 where its steps differ by a tenth: a grain
//            that settles shows at once. Where surface splats shrink in their places instead of sinking they are
//            0.184/35, 0.258/33, 0.144/40, 0.541/87, 0.058/25, 0.041/16. The dune without its sheet has 0.651/61.
INSTANTIATE_TEST_SUITE_P(Scenes, SolidFramesTest,
                         testing::Values(Case{"melt_cube", 0.025f, 0.5, 0.005, 200, 0.21, 36},
                                         Case{"melt_teapot", 0.025f, 0.3, 0.005, 8000, 0.25, 38},
                                         Case{"jet_on_block", 0.04f, 0.6, 0.005, 15'000, 0.18, 55},
                                         Case{"river_bed", 0.05f, 0.8, 0.005, 2700, 0.5, 110},
                                         Case{"vanish", 0.04f, 0.6, 0.005, 900, 0.065, 28},
                                         Case{"dissolve", 0.05f, 0.6, 0.005, 200, 0.06, 21},
                                         Case{"dune", 0.045f, 0.3, 0.005, 3700, 0.17, 28, 2.0f}),
                         [](const auto& its) { return std::string(its.param.scene); });

/// Of the normals that a picture of COLOR_NORMAL shows of ground, from pixel to pixel along rows.
struct Roughness {
    std::size_t pixels = 0;
    double mean = 0.0;    ///< of the length of their difference
    double extreme = 0.0; ///< and of the hundredth pixel where it is greatest
};

Roughness roughness(const Image& image)
{
    const auto normal = [&](std::size_t pixel) {
        glm::dvec3 n;
        for (int c = 0; c < 3; ++c) {
            const double value = image.rgba[4 * pixel + static_cast<std::size_t>(c)] / 255.0;
            n[c] = 2.0 * (value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4)) - 1.0;
        }
        return n;
    };
    const auto is_ground = [](const glm::dvec3& n) {
        return n.y > 0.6 && std::abs(glm::length(n) - 1.0) < 0.02; // neither background nor part of it
    };
    std::vector<double> differences;
    for (std::size_t i = 0; i + 1 < std::size_t{image.width} * image.height; ++i) {
        const glm::dvec3 a = normal(i);
        const glm::dvec3 b = normal(i + 1);
        if ((i + 1) % image.width != 0 && is_ground(a) && is_ground(b)) {
            differences.push_back(glm::distance(a, b));
        }
    }
    std::ranges::sort(differences);
    Roughness found{.pixels = differences.size()};
    for (const double each : differences) {
        found.mean += each / static_cast<double>(differences.size());
    }
    found.extreme = differences.empty() ? 0.0 : differences[differences.size() - 1 - differences.size() / 100];
    return found;
}

class SandFramesTest : public GpuTest {};

// The surface of sand is that of its columns, without their steps, at the start and when grains have come and gone. A
// software device measures 0.019 and 0.062, most of it the steps of 8 bits; with discs of particles instead of a sheet
// it is 0.047 and 0.32.
TEST_F(SandFramesTest, ADuneIsSmooth)
{
    Show show(context(), Case{.scene = "dune", .spacing = 0.045f});
    show.painter().settings().color_mode = shared::COLOR_NORMAL;
    show.painter().settings().splat_radius = 1e-6f; // no sand in the air
    for (const double time : {0.0, 0.5}) {
        show.simulation().advance_by(time);
        const Roughness found = roughness(show.paint());
        EXPECT_GT(found.pixels, 1000u);
        RecordProperty("rough", std::to_string(found.mean) + " " + std::to_string(found.extreme));
        EXPECT_LT(found.mean, 0.024) << "after " << time << " s";
        EXPECT_LT(found.extreme, 0.08) << "after " << time << " s";
    }
}

} // namespace
} // namespace meltpoint
