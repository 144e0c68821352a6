// The report's Markdown: sections of a document and tables.
#include <algorithm>

#include <gtest/gtest.h>

#include "core/error.h"
#include "report/document.h"
#include "report/line_plot.h"
#include "report/sections.h"
#include "support/scratch_folder.h"

namespace meltpoint {
namespace {

constexpr std::string_view readme = "# Title\n"
                                    "<!-- report:one -->\n"
                                    "old one\n"
                                    "<!-- report end -->\n"
                                    "between\n"
                                    "<!-- report:two -->\n"
                                    "<!-- report end -->";

std::string complaint_of(std::string_view text)
{
    try {
        static_cast<void>(report::section_names(text, "file.md"));
    } catch (const Error& error) {
        return error.what();
    }
    return "none";
}

TEST(ReportDocument, KnowsItsSections)
{
    EXPECT_EQ(report::section_names(readme, "file.md"), (std::vector<std::string>{"one", "two"}));
    EXPECT_TRUE(report::section_names("", "file.md").empty());
    EXPECT_TRUE(report::section_names("no section <!-- report:x --> within a line\n", "file.md").empty());
}

TEST(ReportDocument, OnlyWantedSectionsChange)
{
    const std::string fresh = "fresh\n";
    const std::string text = report::replace_sections(
        readme, "file.md", [&](std::string_view name) { return name == "one" ? &fresh : nullptr; });
    EXPECT_EQ(text, "# Title\n<!-- report:one -->\n\nfresh\n\n<!-- report end -->\nbetween\n<!-- report:two -->\n"
                    "<!-- report end -->");
    // And a second time nothing more changes.
    EXPECT_EQ(report::replace_sections(text, "file.md",
                                       [&](std::string_view name) { return name == "one" ? &fresh : nullptr; }),
              text);
}

TEST(ReportDocument, AWrittenSectionIsFoundAgain)
{
    EXPECT_EQ(report::section_names(report::section("one", "a\n") + report::section("two", "b\n"), "file.md"),
              (std::vector<std::string>{"one", "two"}));
}

TEST(ReportDocument, CarriageReturnsHideNoSection)
{
    EXPECT_EQ(report::section_names("<!-- report:one -->\r\nold\r\n<!-- report end -->\r\n", "file.md"),
              (std::vector<std::string>{"one"}));
}

TEST(ReportDocument, MistakesHaveTheirLine)
{
    EXPECT_EQ(complaint_of("a\n<!-- report:one -->\nb\n"),
              "file.md:2: section \"one\" has no end: a line <!-- report end -->");
    EXPECT_EQ(complaint_of("<!-- report:one -->\n<!-- report:two -->\n<!-- report end -->\n"),
              "file.md:2: section \"two\" begins within section \"one\" of line 1");
    EXPECT_EQ(complaint_of("a\n<!-- report end -->\n"), "file.md:2: a section ends here, but none has begun");
}

TEST(ReportDocument, TablesAreMarkdown)
{
    const std::vector<report::Row> rows = {{"1", "2"}, {"3", "4"}};
    EXPECT_EQ(report::table({"a", "b"}, rows), "| a | b |\n| --- | --- |\n| 1 | 2 |\n| 3 | 4 |\n");
}

TEST(ReportDocument, TheReadmeHasEverySectionOnce)
{
    const std::string path = MELTPOINT_SOURCE_DIR "/README.md";
    std::vector<std::string> found = report::section_names(test::read_bytes(path), path);
    std::vector<std::string> expected;
    for (const report::SectionMaker& maker : report::section_makers()) {
        expected.emplace_back(maker.name);
    }
    std::ranges::sort(found);
    std::ranges::sort(expected);
    EXPECT_EQ(found, expected);
}

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
    const report::LinePlot plot{"t", "x", "y", {{"a & b", {{10.0, 1.0}, {100.0, 10.0}, {1000.0, 100.0}}}}};
    const std::string svg = report::to_svg(plot);
    const std::vector<double> y = heights(svg);
    ASSERT_EQ(y.size(), 3u);
    EXPECT_GT(y[0], y[1]); // pictures count down from the top
    EXPECT_NEAR(y[0] - y[1], y[1] - y[2], 0.2);
    EXPECT_NE(svg.find("a &amp; b"), std::string::npos);
    EXPECT_EQ(svg.find("a & b"), std::string::npos);
}

TEST(LinePlot, StaysWithinItsFrame)
{
    const report::LinePlot plot{"t", "x", "y", {{"a", {{7.9e3, 0.93}, {1.25e5, 2.1e7}}}}};
    for (const double y : heights(report::to_svg(plot))) {
        EXPECT_GE(y, 48.0);
        EXPECT_LE(y, 364.0);
    }
}

TEST(LinePlot, WhatHasNoLogarithmIsRefused)
{
    EXPECT_THROW(static_cast<void>(report::to_svg({"t", "x", "y", {{"a", {{1.0, 0.0}}}}})), Error);
    EXPECT_THROW(static_cast<void>(report::to_svg({"t", "x", "y", {}})), Error);
}

} // namespace
} // namespace meltpoint
