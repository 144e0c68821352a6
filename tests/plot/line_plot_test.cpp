#include "plot/line_plot.h"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/error.h"

namespace meltpoint {
namespace {

/// The y of the first curve's dots.
std::vector<double> heights(const std::string& svg)
{
    std::vector<double> found;
    for (std::size_t at = svg.find("cy=\""); at != std::string::npos; at = svg.find("cy=\"", at + 1)) {
        found.push_back(std::stod(svg.substr(at + 4)));
    }
    return found;
}

TEST(LinePlot, EqualRatiosAreEqualLengths)
{
    const plot::LinePlot lines{"t", "x", "y", {{"a & b", {{10.0, 1.0}, {100.0, 10.0}, {1000.0, 100.0}}}}};
    const std::string svg = plot::to_svg(lines);
    const std::vector<double> y = heights(svg);
    ASSERT_EQ(y.size(), 3u);
    EXPECT_GT(y[0], y[1]); // pictures count down from the top
    EXPECT_NEAR(y[0] - y[1], y[1] - y[2], 0.2);
    EXPECT_NE(svg.find("a &amp; b"), std::string::npos);
    EXPECT_EQ(svg.find("a & b"), std::string::npos);
}

TEST(LinePlot, StaysWithinItsFrame)
{
    const plot::LinePlot lines{"t", "x", "y", {{"a", {{7.9e3, 0.93}, {1.25e5, 2.1e7}}}}};
    for (const double y : heights(plot::to_svg(lines))) {
        EXPECT_GE(y, 48.0);
        EXPECT_LE(y, 364.0);
    }
}

TEST(LinePlot, OnLinearAxesEqualDifferencesAreEqualLengths)
{
    const plot::LinePlot lines{
        "t", "x", "y", {{"a", {{0.0, -1.0}, {1.0, 0.5}, {3.0, 2.0}}, false}}, plot::Scale::Linear};
    const std::string svg = plot::to_svg(lines);
    const std::vector<double> y = heights(svg);
    ASSERT_EQ(y.size(), 3u);
    EXPECT_NEAR(y[0] - y[1], y[1] - y[2], 0.2);
    EXPECT_LE(y[0], 364.0);
    EXPECT_GE(y[2], 48.0);
    EXPECT_EQ(svg.find("stroke-width=\"2\""), std::string::npos); // not joined
}

TEST(LinePlot, NamesOfCurvesThatEndTogetherStayInThePicture)
{
    plot::LinePlot lines{"t", "x", "y", {}, plot::Scale::Linear};
    for (const char* name : {"c0", "c1", "c2", "c3", "c4", "c5"}) {
        lines.curves.push_back({name, {{0.0, 1.0}, {1.0, 0.0}}});
    }
    const std::string svg = plot::to_svg(lines);
    std::vector<double> y;
    for (const plot::Curve& curve : lines.curves) {
        const std::size_t text = svg.rfind("<text", svg.find(">" + curve.name + "<"));
        y.push_back(std::stod(svg.substr(svg.find("y=\"", text) + 3)));
    }
    std::ranges::sort(y);
    EXPECT_LE(y.back(), 420.0);
    for (std::size_t i = 1; i < y.size(); ++i) {
        EXPECT_GE(y[i] - y[i - 1], 12.0); // none covers another
    }
}

// What never changes has axes too.
TEST(LinePlot, OnePointIsDrawn)
{
    for (const plot::Scale scale : {plot::Scale::Linear, plot::Scale::Logarithmic}) {
        const std::string svg = plot::to_svg({"t", "x", "y", {{"a", {{2.0, 3.0}}}}, scale});
        EXPECT_EQ(heights(svg).size(), 1u);
        EXPECT_EQ(svg.find("nan"), std::string::npos);
    }
}

// So large that a step of the axis is less than the number's last digit.
TEST(LinePlot, LargeNumbersThatHardlyDifferAreDrawn)
{
    const std::string svg =
        plot::to_svg({"t", "x", "y", {{"a", {{0.0, 1e17}, {1.0, 1e17 + 16.0}}}}, plot::Scale::Linear});
    const std::vector<double> y = heights(svg);
    ASSERT_EQ(y.size(), 2u);
    EXPECT_NEAR(y[0], y[1], 0.1);
    EXPECT_EQ(svg.find("nan"), std::string::npos);
}

TEST(LinePlot, WhatHasNoPlaceIsRefused)
{
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(static_cast<void>(plot::to_svg({"t", "x", "y", {{"a", {{1.0, nan}}}}, plot::Scale::Linear})), Error);
    EXPECT_THROW(static_cast<void>(plot::to_svg({"t", "x", "y", {{"a", {{1.0, 0.0}}}}})), Error);
    EXPECT_THROW(static_cast<void>(plot::to_svg({"t", "x", "y", {}})), Error);
}

} // namespace
} // namespace meltpoint
