#include <limits>

#include "core/error.h"
#include "images/picture_test_support.h"

namespace meltpoint {
namespace {

class FrameTest : public PictureTest {
protected:
    /// A particle's sphere of 1 cm in the middle of the picture, in plain colors.
    static render::FrameSettings close_up()
    {
        render::FrameSettings settings;
        settings.camera = render::perspective_camera({0.0f, 0.0f, 0.1f}, {}, {0.0f, 1.0f, 0.0f}, 30.0f, 1.0f, 0.001f);
        settings.splat_radius = 0.01f;
        settings.lit = false;
        settings.rest_density.fill(1000.0f);
        settings.material_color[0] = {0.1f, 0.2f, 0.3f};
        settings.material_color[1] = {0.7f, 0.5f, 0.0f};
        return settings;
    }

    static glm::ivec3 center_color(const render::FrameSettings& settings, const TestParticles& particles)
    {
        return draw(33, 33, settings, &particles).pixel(16, 16);
    }
};

::testing::AssertionResult close(const glm::ivec3& seen, const glm::vec3& linear)
{
    const glm::ivec3 expected(encode_srgb(linear.r), encode_srgb(linear.g), encode_srgb(linear.b));
    const glm::ivec3 error = glm::abs(seen - expected);
    if (glm::max(error.x, glm::max(error.y, error.z)) <= 1) {
        return ::testing::AssertionSuccess();
    }
    return ::testing::AssertionFailure() << "saw (" << seen.r << ", " << seen.g << ", " << seen.b << "), expected ("
                                         << expected.r << ", " << expected.g << ", " << expected.b << ")";
}

TEST_F(FrameTest, AnEmptyFrameIsBackground)
{
    render::FrameSettings settings = close_up();
    settings.background = {0.2f, 0.4f, 0.8f};
    const Drawn drawn = draw(40, 30, settings, nullptr, nullptr, 2);
    ASSERT_EQ(drawn.picture.rgba.size(), 4u * 40 * 30);
    for (std::uint32_t y = 0; y < 30; ++y) {
        for (std::uint32_t x = 0; x < 40; ++x) {
            ASSERT_TRUE(close(drawn.pixel(x, y), settings.background)) << x << ", " << y;
        }
    }
    for (const float distance : drawn.distance) {
        ASSERT_EQ(distance, std::numeric_limits<float>::infinity());
    }
}

TEST_F(FrameTest, SolidsHaveColorsOfTheirOwn)
{
    render::FrameSettings settings = close_up();
    settings.solid_color[1] = {0.2f, 0.6f, 0.4f};
    TestParticles particles;
    particles.add({}, 1);
    EXPECT_TRUE(close(center_color(settings, particles), settings.material_color[1]));
    particles.attributes[0] = shared::pack_attributes(shared::STATE_SOLID, 1);
    EXPECT_TRUE(close(center_color(settings, particles), settings.solid_color[1]));
    settings.color_mode = shared::COLOR_SPEED; // of which it has none: gray
    const glm::ivec3 gray = center_color(settings, particles);
    EXPECT_EQ(gray.r, gray.g);
    EXPECT_EQ(gray.g, gray.b);
}

TEST_F(FrameTest, DustShrinksWithWhatIsLeftOfIt)
{
    render::FrameSettings settings = close_up();
    settings.solid_color[0] = {0.2f, 0.6f, 0.4f};
    TestParticles particles;
    particles.add({}, 0, shared::STATE_DUST);
    const auto covered = [&](float left) {
        particles.density[0] = left;
        const Drawn drawn = draw(65, 65, settings, &particles);
        int pixels = 0;
        for (std::uint32_t y = 0; y < 65; ++y) {
            for (std::uint32_t x = 0; x < 65; ++x) {
                pixels += close(drawn.pixel(x, y), settings.solid_color[0]) ? 1 : 0;
            }
        }
        return pixels;
    };
    const int whole = covered(1.0f);
    EXPECT_GT(whole, 300);
    EXPECT_NEAR(covered(0.125f), 0.25 * whole, 0.08 * whole); // half the radius
    EXPECT_EQ(covered(0.0f), 0);
}

TEST_F(FrameTest, MaterialsHaveTheirColors)
{
    TestParticles particles;
    particles.add({}, 1);
    EXPECT_TRUE(close(center_color(close_up(), particles), {0.7f, 0.5f, 0.0f}));
}

TEST_F(FrameTest, DensityBelowTheRestDensityIsMagenta)
{
    render::FrameSettings settings = close_up();
    settings.color_mode = shared::COLOR_DENSITY;
    settings.color_range = {1000.0f, 1100.0f};
    settings.rest_density[1] = 900.0f;
    TestParticles particles;
    particles.add({});
    particles.density[0] = 999.0f;
    EXPECT_TRUE(close(center_color(settings, particles), shared::below_rest_color()));
    particles.density[0] = 1025.0f;
    EXPECT_TRUE(close(center_color(settings, particles), shared::colormap(0.25f)));
    particles.density[0] = 2000.0f;
    EXPECT_TRUE(close(center_color(settings, particles), shared::colormap(1.0f)));
    particles.attributes[0] = shared::pack_attributes(shared::STATE_FLUID, 1);
    particles.density[0] = 950.0f; // below the range, but not below this material's rest density
    EXPECT_TRUE(close(center_color(settings, particles), shared::colormap(0.0f)));
}

TEST_F(FrameTest, SpeedAndPressureFollowTheColormap)
{
    render::FrameSettings settings = close_up();
    TestParticles particles;
    particles.add({});
    particles.velocity[0] = {2.0f, -3.0f, 6.0f, 0.0f}; // 7 m/s
    particles.pressure[0] = 300.0f;
    settings.color_mode = shared::COLOR_SPEED;
    settings.color_range = {0.0f, 10.0f};
    EXPECT_TRUE(close(center_color(settings, particles), shared::colormap(0.7f)));
    settings.color_mode = shared::COLOR_PRESSURE;
    settings.color_range = {0.0f, 1000.0f};
    EXPECT_TRUE(close(center_color(settings, particles), shared::colormap(0.3f)));
}

TEST_F(FrameTest, DeadAndNonFiniteParticlesAreNotDrawn)
{
    const render::FrameSettings settings = close_up();
    TestParticles particles;
    particles.add({}, 0, shared::STATE_DEAD);
    particles.add(glm::vec3(std::numeric_limits<float>::quiet_NaN()));
    particles.add(glm::vec3(std::numeric_limits<float>::infinity()));
    EXPECT_TRUE(close(center_color(settings, particles), settings.background));
}

TEST_F(FrameTest, WhatWasSolidTakesOnTheColorOfItsFluid)
{
    render::FrameSettings settings = close_up();
    settings.material_color[0] = {0.1f, 0.2f, 0.9f};
    settings.solid_color[0] = {0.8f, 0.6f, 0.1f};
    settings.blend_time = 2.0f;
    TestParticles particles;
    particles.add({});
    particles.add(glm::vec3(0.0f, 0.0f, -1.0f)); // out of sight: so that ids and places differ
    const auto color = [&](float time) {
        particles.time = time;
        return center_color(settings, particles);
    };
    particles.freed_at = {7.0f, 3.0f};
    EXPECT_TRUE(close(color(3.0f), settings.material_color[0])); // it never was solid
    particles.attributes[0] = shared::freed_as(particles.attributes[0], shared::STATE_FLUID, shared::CAUSE_MELT);
    EXPECT_TRUE(close(color(3.0f), settings.solid_color[0]));
    EXPECT_TRUE(close(color(4.0f), 0.5f * (settings.solid_color[0] + settings.material_color[0])));
    EXPECT_TRUE(close(color(5.1f), settings.material_color[0]));
    settings.blend_time = 0.0f;
    EXPECT_TRUE(close(color(3.0f), settings.material_color[0]));
}

TEST_F(FrameTest, TheSameFrameHasTheSameBits)
{
    render::FrameSettings settings = close_up();
    settings.lit = true;
    settings.splat_radius = 0.003f;
    settings.bounds.extend(glm::vec3(-0.02f));
    settings.bounds.extend(glm::vec3(0.02f));
    settings.box = true;
    settings.floor = render::Floor{.height = -0.02f, .extent = 1.0f, .grid = 0.01f};
    TestParticles particles;
    for (int i = 0; i < 500; ++i) {
        const float a = 2.4f * static_cast<float>(i);
        particles.add(0.02f * glm::vec3(std::sin(a), std::cos(1.7f * a), std::sin(0.3f * a)), i % 2);
    }
    const Drawn first = draw(200, 150, settings, &particles, nullptr, 2);
    const Drawn second = draw(200, 150, settings, &particles, nullptr, 2);
    EXPECT_EQ(first.picture.rgba, second.picture.rgba);
}

TEST_F(FrameTest, BadSettingsAreNamed)
{
    render::FrameSettings settings = close_up();
    settings.splat_radius = 0.0f;
    EXPECT_THROW(draw(8, 8, settings), Error);
    settings = close_up();
    settings.light_direction = {};
    EXPECT_THROW(draw(8, 8, settings), Error);
    settings = close_up();
    settings.color_range = {1.0f, 1.0f};
    EXPECT_THROW(draw(8, 8, settings), Error);
    EXPECT_THROW(draw(8, 8, close_up(), nullptr, nullptr, 9), Error);
}

TEST_F(FrameTest, ASizeBeyondTheDeviceIsNamedWithTheLimit)
{
    const std::uint32_t limit = gpu::max_target_size(context());
    for (const auto& [width, height] : {std::pair{limit + 1, 8u}, std::pair{8u, limit + 1}, std::pair{0u, 8u}}) {
        try {
            const render::Renderer renderer(context(), width, height, 1);
            FAIL() << "expected an error for " << width << " x " << height;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::Device);
            EXPECT_NE(std::string(error.what()).find(std::to_string(limit)), std::string::npos) << error.what();
        }
    }
    const Drawn thin = draw(limit, 1, close_up());
    EXPECT_EQ(thin.picture.width, limit);
}

} // namespace
} // namespace meltpoint
