// Discs that are seen from outside alone: bent ones and those that end at an edge; and balls that have sizes of their own.
#include <cmath>

#include "images/picture_test_support.h"

namespace meltpoint {
namespace {

constexpr std::uint32_t size = 65;
constexpr float radius = 0.01f;

class DiscTest : public PictureTest {
protected:
    /// A view along -z of a square 2.6 radii wide around the origin.
    static render::FrameSettings settings()
    {
        render::FrameSettings settings;
        settings.camera = render::orthographic_camera({0.0f, 0.0f, 0.1f}, {}, {0.0f, 1.0f, 0.0f}, 2.6f * radius, 1.0f,
                                                      0.001f, 1.0f);
        settings.splat_radius = radius;
        settings.lit = false;
        settings.background = glm::vec3(0.0f);
        settings.material_color[0] = glm::vec3(1.0f);
        return settings;
    }

    /// The disc around the origin.
    static Drawn draw_disc(const render::FrameSettings& settings, const glm::vec4& normal, const glm::vec4& bend,
                           float edge = 0.0f)
    {
        const glm::vec4 position(0.0f, 0.0f, 0.0f, radius);
        const glm::vec4 color(1.0f, 1.0f, 1.0f, edge);
        const render::DiscBuffers discs(context(), {&position, 1}, {&normal, 1}, {&color, 1});
        gpu::upload<glm::vec4>(context(), discs.bend(), {&bend, 1});
        render::Frame frame{.settings = settings, .particles = std::nullopt, .discs = discs.view()};
        return show(frame);
    }

    static Drawn show(const render::Frame& frame)
    {
        render::Renderer renderer(context(), size, size, 1);
        gpu::Commands commands(context());
        commands.begin();
        renderer.draw(commands, frame);
        commands.submit();
        commands.wait();
        return {renderer.capture(), renderer.capture_distance()};
    }

    /// How far it reaches from the middle, in radii, to the left and to the right, down and up.
    static glm::vec4 reach(const Drawn& drawn)
    {
        const float pixel = 2.6f / static_cast<float>(size);
        glm::vec4 sum(0.0f);
        for (std::uint32_t i = 0; i < size; ++i) {
            const float along = drawn.pixel(i, size / 2).r > 0 ? pixel : 0.0f;
            const float across = drawn.pixel(size / 2, i).r > 0 ? pixel : 0.0f;
            (i < size / 2 ? sum.x : sum.y) += along;
            (i < size / 2 ? sum.w : sum.z) += across;
        }
        return sum;
    }

    static void expect_reach(const Drawn& drawn, const glm::vec4& expected)
    {
        const glm::vec4 error = glm::abs(reach(drawn) - expected);
        EXPECT_LT(glm::max(glm::max(error.x, error.y), glm::max(error.z, error.w)), 0.06f)
            << reach(drawn).x << ' ' << reach(drawn).y << ' ' << reach(drawn).z << ' ' << reach(drawn).w;
    }
};

TEST_F(DiscTest, BentAndEdgedOnesAreSeenFromOutsideAlone)
{
    for (const float kind : {shared::DISC_FLAT, shared::DISC_BENT, shared::DISC_EDGED}) {
        const float edge = 1.0f; // far off
        expect_reach(draw_disc(settings(), {0.0f, 0.0f, 1.0f, kind}, glm::vec4(0.0f), edge), glm::vec4(1.0f));
        expect_reach(draw_disc(settings(), {0.0f, 0.0f, -1.0f, kind}, glm::vec4(0.0f), edge),
                     glm::vec4(kind == shared::DISC_FLAT ? 1.0f : 0.0f));
    }
}

TEST_F(DiscTest, AnEdgedOneEndsAtItsEdge)
{
    const glm::vec4 normal(0.0f, 0.0f, 1.0f, shared::DISC_EDGED);
    expect_reach(draw_disc(settings(), normal, {1.0f, 0.0f, 0.0f, 0.0f}, 0.5f * radius), {1.0f, 0.5f, 1.0f, 1.0f});
    expect_reach(draw_disc(settings(), normal, {0.0f, -1.0f, 0.0f, 0.0f}, 0.2f * radius), {1.0f, 1.0f, 0.2f, 1.0f});
    expect_reach(draw_disc(settings(), normal, {0.0f, 1.0f, 0.0f, 0.0f}, -radius), glm::vec4(0.0f));
}

TEST_F(DiscTest, ABentOneEndsWhereItsSurfaceLeavesItAndItsNormalsTurn)
{
    // Along u, which is x for this normal, it is a cylinder of a radius of 0.8 discs: off the plane by 0.15 at half of it.
    const glm::vec4 normal(0.0f, 0.0f, 1.0f, shared::DISC_BENT);
    const glm::vec4 bend(1.25f / radius, 0.0f, 0.0f, 0.0f);
    const float end = std::sqrt(2.0f * shared::BENT_OFF / 1.25f);
    expect_reach(draw_disc(settings(), normal, bend), {end, end, 1.0f, 1.0f});

    render::FrameSettings as_normals = settings();
    as_normals.color_mode = shared::COLOR_NORMAL;
    const Drawn drawn = draw_disc(as_normals, normal, bend);
    const std::uint32_t off = 10; // pixels
    const float way = 2.6f / static_cast<float>(size) * static_cast<float>(off);
    const glm::vec3 expected = 0.5f * glm::normalize(glm::vec3(1.25f * way, 0.0f, 1.0f)) + 0.5f;
    const glm::ivec3 seen = drawn.pixel(size / 2 + off, size / 2);
    EXPECT_NEAR(seen.r, encode_srgb(expected.r), 2);
    EXPECT_NEAR(seen.b, encode_srgb(expected.b), 2);
    EXPECT_NEAR(drawn.pixel(size / 2, size / 2 + off).g, encode_srgb(0.5f), 2);
}

TEST_F(DiscTest, BallsMayHaveSizesOfTheirOwn)
{
    for (const float part : {1.0f, 0.5f, 0.0f}) {
        const std::vector<glm::vec4> origin(1, glm::vec4(0.0f));
        const gpu::Buffer vectors = to_device(context(), origin, "zeros");
        const gpu::Buffer scalars = to_device(context(), std::vector<float>{1000.0f}, "densities");
        const gpu::Buffer sizes = to_device(context(), std::vector<float>{part}, "sizes");
        const gpu::Buffer attributes = to_device(
            context(), std::vector<std::uint32_t>{shared::pack_attributes(shared::STATE_FLUID, 0)}, "attributes");
        render::ParticleView particles{vectors, vectors, scalars, scalars, attributes, 1};
        particles.size = &sizes;
        expect_reach(show({.settings = settings(), .particles = particles, .discs = std::nullopt}), glm::vec4(part));
    }
}

} // namespace
} // namespace meltpoint
