#include "render/legend.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "core/error.h"
#include "render/bitmap_font.h"
#include "shared/render_params.h"

namespace meltpoint {
namespace {

Image white(std::uint32_t width, std::uint32_t height)
{
    return {width, height, std::vector<std::uint8_t>(std::size_t{4} * width * height, 255)};
}

TEST(LegendTest, TicksAreRoundAndWithinTheRange)
{
    EXPECT_EQ(render::round_ticks(0.0, 10.0, 5), (std::vector<double>{0, 2, 4, 6, 8, 10}));
    EXPECT_EQ(render::round_ticks(0.0, 1000.0, 4), (std::vector<double>{0, 500, 1000}));
    EXPECT_EQ(render::round_ticks(-3.0, 3.0, 3), (std::vector<double>{-2, 0, 2}));
    EXPECT_EQ(render::round_ticks(995.0, 1012.0, 4), (std::vector<double>{995, 1000, 1005, 1010}));
    EXPECT_EQ(render::round_ticks(10.0, 0.0, 5), render::round_ticks(0.0, 10.0, 5));
    EXPECT_FALSE(std::signbit(render::round_ticks(0.0, 3.0, 4)[0]));
    EXPECT_TRUE(render::round_ticks(1.0, 1.0, 5).empty());
}

TEST(LegendTest, EveryGlyphDiffersFromEveryOther)
{
    std::set<std::string> shapes;
    const std::string characters = " .,-+/()<>%^0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ?";
    for (const char character : characters) {
        Image image = white(5, 9);
        render::draw_text(image, 0, 0, std::string(1, character), 1, {0, 0, 0});
        shapes.emplace(image.rgba.begin(), image.rgba.end());
    }
    // Capital O and 0 look alike by design.
    EXPECT_EQ(shapes.size(), characters.size() - 1);
}

TEST(LegendTest, TextOutsideThePictureIsCutOff)
{
    Image image = white(20, 10);
    render::draw_text(image, -3, -3, "888888", 2, {0, 0, 0});
    render::draw_text(image, 15, 8, "888888", 2, {0, 0, 0});
    EXPECT_EQ(image.rgba.size(), 4u * 20 * 10);
    EXPECT_TRUE(std::any_of(image.rgba.begin(), image.rgba.end(), [](std::uint8_t v) { return v == 0; }));
    EXPECT_EQ(render::text_width("abc", 2), 34);
}

TEST(LegendTest, ALegendStaysInItsCornerAndTooSmallPicturesStayAsTheyAre)
{
    const render::Legend legend = render::legend_for(shared::COLOR_DENSITY, {1000.0f, 1020.0f}, glm::vec3(0.9f));
    Image image = white(640, 360);
    render::draw_legend(image, legend);
    int changed = 0;
    for (std::uint32_t y = 0; y < image.height; ++y) {
        for (std::uint32_t x = 0; x < image.width; ++x) {
            if (image.rgba[std::size_t{4} * (y * image.width + x)] != 255) {
                ++changed;
                EXPECT_TRUE(x < 200 && y > 280) << x << ", " << y;
            }
        }
    }
    EXPECT_GT(changed, 1000);

    Image tiny = white(60, 40);
    render::draw_legend(tiny, legend);
    EXPECT_EQ(tiny.rgba, white(60, 40).rgba);
}

TEST(LegendTest, ModesWithoutAQuantityHaveNone)
{
    EXPECT_THROW((void)render::legend_for(shared::COLOR_MATERIAL, {0.0f, 1.0f}, {}), Error);
    EXPECT_THROW((void)render::legend_for(shared::COLOR_NORMAL, {0.0f, 1.0f}, {}), Error);
}

} // namespace
} // namespace meltpoint
