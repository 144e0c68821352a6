#include "render/camera.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/error.h"

namespace meltpoint {
namespace {

using render::Camera;

constexpr glm::vec3 up{0.0f, 1.0f, 0.0f};
constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr float nan = std::numeric_limits<float>::quiet_NaN();

glm::vec3 project(const Camera& camera, const glm::vec3& point)
{
    const glm::vec4 clip = camera.projection * camera.view * glm::vec4(point, 1.0f);
    return glm::vec3(clip) / clip.w;
}

void expect_near(const glm::vec3& seen, const glm::vec3& expected)
{
    EXPECT_LT(glm::length(seen - expected), 1e-5f) << seen.x << ' ' << seen.y << ' ' << seen.z << " instead of "
                                                   << expected.x << ' ' << expected.y << ' ' << expected.z;
}

TEST(CameraTest, PerspectiveReversesDepthAndTurnsYDown)
{
    const Camera camera = render::perspective_camera({0, 0, 5}, {}, up, 90.0f, 2.0f, 1.0f, 11.0f);
    expect_near(project(camera, {0, 0, 4}), {0, 0, 1});
    expect_near(project(camera, {0, 0, -6}), {0, 0, 0});
    expect_near(project(camera, {10, 5, 0}), {1, -1, project(camera, {0, 0, 0}).z});
    const Camera endless = render::perspective_camera({0, 0, 5}, {}, up, 90.0f, 2.0f, 1.0f);
    expect_near(project(endless, {0, 0, 4}), {0, 0, 1});
    expect_near(project(endless, {0, 0, -5}), {0, 0, 0.1f});
}

TEST(CameraTest, OrthographicKeepsSizesAtEveryDistance)
{
    const Camera camera = render::orthographic_camera({0, 0, 5}, {}, up, 4.0f, 1.5f, -1.0f, 9.0f);
    expect_near(project(camera, {3, 2, 6}), {1, -1, 1});
    expect_near(project(camera, {3, 2, -4}), {1, -1, 0});
}

TEST(CameraTest, SplatCamerasAgreeWithTheMatrices)
{
    Camera cameras[] = {render::perspective_camera({1, 2, 5}, {0.3f, 0, 0}, up, 50.0f, 1.6f, 0.1f),
                        render::perspective_camera({1, 2, 5}, {0.3f, 0, 0}, up, 50.0f, 1.6f, 0.1f, 20.0f),
                        render::orthographic_camera({1, 2, 5}, {0.3f, 0, 0}, up, 3.0f, 1.6f, 0.1f, 20.0f)};
    cameras[0].projection[2][0] = 0.2f; // off center, as for a tile of a larger picture
    cameras[1].projection[2][1] = -0.1f;
    cameras[2].projection[3][0] = 0.3f;
    for (const Camera& camera : cameras) {
        const shared::SplatCamera splat = render::splat_camera(camera, 200, 100);
        const glm::vec3 point(0.4f, -0.7f, 0.2f);
        const glm::vec3 p = splat.view * glm::vec4(point, 1.0f);
        const glm::vec2 plane = camera.orthographic ? glm::vec2(p) : glm::vec2(p) / -p.z;
        const glm::vec2 ndc = (plane - splat.plane_offset) / splat.plane_scale;
        const float depth = splat.depth_map.x + splat.depth_map.y * (camera.orthographic ? -p.z : -1.0f / p.z);
        expect_near({ndc, depth}, project(camera, point));
    }
}

TEST(CameraTest, LookingAlongUpIsAllowed)
{
    const Camera camera = render::perspective_camera({0, 3, 0}, {}, up, 60.0f, 1.0f, 0.1f);
    const glm::vec3 center = project(camera, {});
    EXPECT_NEAR(center.x, 0.0f, 1e-6f);
    EXPECT_NEAR(center.y, 0.0f, 1e-6f);
    EXPECT_NEAR(glm::determinant(glm::mat3(camera.view)), 1.0f, 1e-5f);
}

TEST(CameraTest, FramingShowsTheWholeBoxAndNoFarther)
{
    Aabb box;
    box.extend({-1.0f, 0.0f, -0.5f});
    box.extend({1.0f, 2.0f, 0.7f});
    const glm::vec3 target = box.center();
    const glm::vec3 direction = glm::normalize(glm::vec3(-0.4f, -0.5f, -1.0f));
    const float distance = render::framing_distance(box, target, direction, up, 40.0f, 1.5f);
    const Camera camera = render::perspective_camera(target - distance * direction, target, up, 40.0f, 1.5f, 0.01f);
    float reach = 0.0f;
    for (unsigned corner = 0; corner < 8; ++corner) {
        const glm::vec3 p((corner & 1u) != 0 ? 1.0f : -1.0f, (corner & 2u) != 0 ? 2.0f : 0.0f,
                          (corner & 4u) != 0 ? 0.7f : -0.5f);
        const glm::vec3 ndc = project(camera, p);
        reach = std::max({reach, std::abs(ndc.x), std::abs(ndc.y)});
    }
    EXPECT_NEAR(reach, 1.0f, 1e-4f);
}

TEST(CameraTest, BadNumbersAreErrors)
{
    const auto perspective = [](float degrees, float aspect, float near, float far) {
        return render::perspective_camera({0, 0, 1}, {}, up, degrees, aspect, near, far);
    };
    EXPECT_THROW((void)perspective(0.0f, 1.0f, 0.1f, infinite), Error);
    EXPECT_THROW((void)perspective(180.0f, 1.0f, 0.1f, infinite), Error);
    EXPECT_THROW((void)perspective(nan, 1.0f, 0.1f, infinite), Error);
    EXPECT_THROW((void)perspective(40.0f, 0.0f, 0.1f, infinite), Error);
    EXPECT_THROW((void)perspective(40.0f, 1.0f, 0.0f, infinite), Error);
    EXPECT_THROW((void)perspective(40.0f, 1.0f, 2.0f, 1.0f), Error);
    EXPECT_THROW((void)render::perspective_camera({}, {}, up, 40.0f, 1.0f, 0.1f), Error);
    EXPECT_THROW((void)render::perspective_camera({nan, 0, 0}, {}, up, 40.0f, 1.0f, 0.1f), Error);
    EXPECT_THROW((void)render::orthographic_camera({0, 0, 1}, {}, up, 0.0f, 1.0f, 0.1f, 1.0f), Error);
    EXPECT_THROW((void)render::orthographic_camera({0, 0, 1}, {}, up, 1.0f, 1.0f, 0.1f, infinite), Error);
}

} // namespace
} // namespace meltpoint
