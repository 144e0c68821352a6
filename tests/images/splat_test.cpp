#include <functional>

#include "conformance/ray_cast.h"
#include "conformance/splat_accuracy.h"
#include "core/random.h"
#include "images/picture_test_support.h"

namespace meltpoint {
namespace {

constexpr std::uint32_t size = 96;
constexpr double nearest = 0.5;

struct View {
    const char* name;
    ray_cast::Camera reference;
    render::Camera camera;
};

std::vector<View> views()
{
    const auto perspective = [](const char* name, float degrees) {
        View view{name,
                  {},
                  render::perspective_camera({}, {0.0f, 0.0f, -1.0f}, {0.0f, 1.0f, 0.0f}, degrees, 1.0f,
                                             static_cast<float>(nearest))};
        view.reference.half_height = std::tan(0.5 * degrees * 3.14159265358979323846 / 180.0);
        view.reference.near = nearest;
        return view;
    };
    View orthographic{"orthographic",
                      {},
                      render::orthographic_camera({}, {0.0f, 0.0f, -1.0f}, {0.0f, 1.0f, 0.0f}, 4.0f, 1.0f,
                                                  static_cast<float>(nearest), 9.0f)};
    orthographic.reference = {{}, true, 2.0, nearest, 9.0};
    return {perspective("narrow", 30.0f), perspective("wide", 120.0f), orthographic};
}

double uniform(Random& random, double low, double high)
{
    return low + (high - low) * random.uniform();
}

glm::dvec3 direction(Random& random)
{
    const double z = uniform(random, -1.0, 1.0);
    const double angle = uniform(random, 0.0, 6.283185307179586);
    const double r = std::sqrt(1.0 - z * z);
    return {r * std::cos(angle), r * std::sin(angle), z};
}

using Cast = std::function<ray_cast::Hit(const ray_cast::Ray&)>;

/// What the reference sees around a pixel's center: where all of five points a hundredth of a pixel apart agree, the
/// picture has to.
enum class Seen { Hit, Miss, Border };

Seen look(const ray_cast::Camera& camera, const Cast& cast, std::uint32_t x, std::uint32_t y)
{
    int hits = 0;
    constexpr double step = 0.01;
    for (const auto& [dx, dy] : {std::pair{0.0, 0.0}, {step, 0.0}, {-step, 0.0}, {0.0, step}, {0.0, -step}}) {
        hits += cast(camera.ray(x + 0.5 + dx, y + 0.5 + dy, size, size)) ? 1 : 0;
    }
    return hits == 5 ? Seen::Hit : hits == 0 ? Seen::Miss : Seen::Border;
}

struct Comparison {
    int hits = 0; ///< pixels that the reference sees
    int borders = 0;
    int wrong = 0; ///< pixels missed, or drawn where nothing is
};

Comparison compare_coverage(const Drawn& drawn, const ray_cast::Camera& camera, const Cast& cast)
{
    Comparison result;
    for (std::uint32_t y = 0; y < size; ++y) {
        for (std::uint32_t x = 0; x < size; ++x) {
            const bool visible = std::isfinite(drawn.distance[y * size + x]);
            const Seen seen = look(camera, cast, x, y);
            result.hits += seen == Seen::Hit ? 1 : 0;
            result.borders += seen == Seen::Border ? 1 : 0;
            result.wrong += seen != Seen::Border && visible != (seen == Seen::Hit) ? 1 : 0;
        }
    }
    return result;
}

/// Where the picture shows something, its point in space in the renderer's coordinates.
template <class Check>
void for_each_visible(const Drawn& drawn, const ray_cast::Camera& camera, const Check& check)
{
    for (std::uint32_t y = 0; y < size; ++y) {
        for (std::uint32_t x = 0; x < size; ++x) {
            const double distance = drawn.distance[y * size + x];
            if (std::isfinite(distance)) {
                const ray_cast::Ray ray = camera.ray(x + 0.5, y + 0.5, size, size);
                check(ray.origin + distance * ray.direction);
            }
        }
    }
}

render::FrameSettings settings_of(const View& view)
{
    render::FrameSettings settings;
    settings.camera = view.camera;
    settings.lit = false;
    return settings;
}

class SplatTest : public PictureTest {};

/// A point at this distance along the view axis, within the picture or a little outside.
glm::dvec3 point_in_view(Random& random, const ray_cast::Camera& camera, double distance)
{
    const double reach = 1.2 * camera.half_height * (camera.orthographic ? 1.0 : std::abs(distance));
    return glm::vec3(uniform(random, -reach, reach), uniform(random, -reach, reach), -distance);
}

/// Discs everywhere around the eye, small and large; every other one nearly edge-on, every third across the near plane.
Disc random_disc(Random& random, const ray_cast::Camera& camera, int index)
{
    const double distance = index % 3 == 0 ? uniform(random, 0.0, 1.0) : uniform(random, 0.6, 6.0);
    const glm::dvec3 center = point_in_view(random, camera, distance);
    glm::dvec3 normal = direction(random);
    if (index % 2 == 0) { // tilt it until it contains the eye, almost
        const glm::dvec3 gaze = glm::normalize(center);
        normal = glm::normalize(normal - glm::dot(normal, gaze) * gaze + uniform(random, -0.05, 0.05) * gaze);
    }
    const double radius = std::exp(uniform(random, std::log(0.03), std::log(2.0)));
    return {glm::vec3(center), glm::vec3(normal), static_cast<float>(radius)};
}

TEST_F(SplatTest, DiscsMatchTheRayCastAtEveryAngleAndAcrossTheNearPlane)
{
    for (const View& view : views()) {
        Random random(7);
        int hits = 0;
        int borders = 0;
        for (int i = 0; i < 80; ++i) {
            const Disc disc = random_disc(random, view.reference, i);
            const std::vector<Disc> discs{disc};
            const Drawn drawn = draw(size, size, settings_of(view), nullptr, &discs);
            const glm::dvec3 normal = glm::normalize(glm::dvec3(disc.normal));
            const glm::dvec3 center(disc.center);
            const Comparison seen = compare_coverage(drawn, view.reference, [&](const ray_cast::Ray& ray) {
                return ray_cast::disc(view.reference, ray, center, normal, disc.radius);
            });
            EXPECT_EQ(seen.wrong, 0) << view.name << ", disc " << i;
            hits += seen.hits;
            borders += seen.borders;
            const double scale = glm::length(center) + disc.radius;
            for_each_visible(drawn, view.reference, [&](const glm::dvec3& point) {
                EXPECT_NEAR(glm::dot(point - center, normal), 0.0, 1e-5 * scale) << view.name << ", disc " << i;
            });
        }
        EXPECT_GT(hits, 5'000) << view.name; // there was something to compare
        EXPECT_LT(borders, hits / 50) << view.name;
    }
}

TEST_F(SplatTest, SpheresMatchTheRayCastAlsoAroundTheEyeAndAcrossTheNearPlane)
{
    for (const View& view : views()) {
        Random random(11);
        int hits = 0;
        int borders = 0;
        for (int i = 0; i < 60; ++i) {
            const double distance = i % 3 == 0 ? uniform(random, -0.5, 1.0) : uniform(random, 0.6, 6.0);
            const glm::dvec3 center(
                glm::vec3(uniform(random, -1.5, 1.5) * distance, uniform(random, -1.5, 1.5) * distance, -distance));
            render::FrameSettings settings = settings_of(view);
            settings.splat_radius = static_cast<float>(std::exp(uniform(random, std::log(0.03), std::log(1.5))));
            const double radius = settings.splat_radius;
            TestParticles particles;
            particles.add(glm::vec3(center));
            const Drawn drawn = draw(size, size, settings, &particles);
            const Comparison seen = compare_coverage(drawn, view.reference, [&](const ray_cast::Ray& ray) {
                return ray_cast::sphere(view.reference, ray, center, radius);
            });
            EXPECT_EQ(seen.wrong, 0) << view.name << ", sphere " << i;
            hits += seen.hits;
            borders += seen.borders;
            for_each_visible(drawn, view.reference, [&](const glm::dvec3& point) {
                EXPECT_NEAR(glm::length(point - center), radius, 1e-5 * (glm::length(center) + radius))
                    << view.name << ", sphere " << i;
            });
        }
        EXPECT_GT(hits, 5'000) << view.name;
        EXPECT_LT(borders, hits / 50) << view.name;
    }
}

TEST_F(SplatTest, TheNearestOfManySpheresIsSeen)
{
    for (const View& view : views()) {
        Random random(3);
        TestParticles particles;
        for (int i = 0; i < 150; ++i) {
            const double distance = uniform(random, 0.4, 5.0);
            particles.add(
                glm::vec3(uniform(random, -1.0, 1.0) * distance, uniform(random, -1.0, 1.0) * distance, -distance));
        }
        render::FrameSettings settings = settings_of(view);
        settings.splat_radius = 0.3f;
        const Drawn drawn = draw(size, size, settings, &particles);
        const Cast cast = [&](const ray_cast::Ray& ray) {
            ray_cast::Hit first;
            for (const glm::vec4& position : particles.position) {
                const ray_cast::Hit hit = ray_cast::sphere(view.reference, ray, glm::dvec3(position), 0.3f);
                first = hit && (!first || *hit < *first) ? hit : first;
            }
            return first;
        };
        EXPECT_EQ(compare_coverage(drawn, view.reference, cast).wrong, 0) << view.name;
        int far_off = 0;
        for (std::uint32_t y = 0; y < size; ++y) {
            for (std::uint32_t x = 0; x < size; ++x) {
                const ray_cast::Hit hit = cast(view.reference.ray(x + 0.5, y + 0.5, size, size));
                const float distance = drawn.distance[y * size + x];
                far_off += hit && std::isfinite(distance) && std::abs(distance - *hit) > 1e-3 ? 1 : 0;
            }
        }
        EXPECT_LE(far_off, 3) << view.name; // pixels through which an outline passes within float's reach
    }
}

TEST_F(SplatTest, ASphereOfDiscsKeepsItsOutlineItsNormalsAndItsPlace)
{
    const conformance::SplatAccuracy accuracy = conformance::measure_splats(context());
    RecordProperty("spill_percent", std::to_string(100.0 * accuracy.spill_share()));
    RecordProperty("mean_normal_error_degrees", std::to_string(accuracy.normal_error));
    EXPECT_GT(accuracy.inside, 100'000u);
    EXPECT_EQ(accuracy.holes, 0u);
    EXPECT_LE(accuracy.spill_share(), conformance::spill_bound);
    EXPECT_LE(accuracy.normal_error, conformance::normal_error_bound);
    EXPECT_LE(accuracy.worst_offset, accuracy.expected_offset + 2e-6);
}

} // namespace
} // namespace meltpoint
