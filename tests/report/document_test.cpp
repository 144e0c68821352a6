// The report's Markdown: sections of a document and tables.
#include <algorithm>
#include <iterator>

#include <gtest/gtest.h>

#include "core/error.h"
#include "report/document.h"
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

TEST(ReportDocument, ThePagesHaveEverySectionOnce)
{
    std::vector<std::string> found;
    for (const std::string page : {"/README.md", "/apps/validation/README.md"}) {
        const std::string path = MELTPOINT_SOURCE_DIR + page;
        std::ranges::copy(report::section_names(test::read_bytes(path), path), std::back_inserter(found));
    }
    std::vector<std::string> expected;
    for (const report::SectionMaker& maker : report::section_makers()) {
        expected.emplace_back(maker.name);
    }
    std::ranges::sort(found);
    std::ranges::sort(expected);
    EXPECT_EQ(found, expected);
}

} // namespace
} // namespace meltpoint
