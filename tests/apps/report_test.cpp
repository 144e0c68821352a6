// `meltpoint report` as a user meets it.
#include "support/cli.h"

namespace meltpoint {
namespace {

class ReportCli : public test::Cli {
protected:
    test::Result report(const test::Arguments& arguments) const
    {
        test::Arguments all{"report"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        return run(all);
    }
};

TEST_F(ReportCli, ReplacesTheSectionsOfAReadme)
{
    test::write_bytes(path("READ.md"), "before\n<!-- report:splats -->\nold\n<!-- report end -->\nafter\n");
    const test::Result result = report({"--readme", "READ.md", "--out", "pictures"});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const std::string text = bytes("READ.md");
    EXPECT_TRUE(text.starts_with("before\n<!-- report:splats -->\n\n| measured")) << text;
    EXPECT_TRUE(text.ends_with("\n<!-- report end -->\nafter\n")) << text;
    EXPECT_EQ(text.find("old"), std::string::npos);
    EXPECT_NE(text.find("; commit "), std::string::npos);
}

TEST_F(ReportCli, WritesAReportOfItsOwnAndKeepsAnExistingOne)
{
    ASSERT_EQ(report({"--only", "splats"}).exit_code, 0);
    const std::string text = bytes("report/report.md");
    EXPECT_TRUE(text.starts_with("# Report\n\n## Splats against a ray cast\n")) << text;
    test::expect_one_sentence(report({"--only", "splats"}), 2, "report.md");
    EXPECT_EQ(bytes("report/report.md"), text);
    EXPECT_EQ(report({"--only", "splats", "--force"}).exit_code, 0);
}

TEST_F(ReportCli, MistakesAreOneSentenceAndLeaveNothing)
{
    test::write_bytes(path("unknown.md"), "<!-- report:splat -->\n<!-- report end -->\n");
    test::write_bytes(path("open.md"), "<!-- report:splats -->\n");
    test::write_bytes(path("plain.md"), "no section\n");
    const std::vector<std::pair<test::Arguments, std::string>> mistakes = {
        {{"--only", "splat"}, "did you mean \"splats\"?"},
        {{"--readme", "missing.md"}, "missing.md"},
        {{"--readme", "unknown.md"}, "unknown.md"},
        {{"--readme", "open.md"}, "open.md:1"},
        {{"--readme", "plain.md"}, "plain.md: has no section to replace"},
        {{"--readme", "."}, "cannot be read"},
    };
    for (const auto& [arguments, part] : mistakes) {
        test::expect_one_sentence(report(arguments), 2, part);
    }
    EXPECT_EQ(files("."), (std::vector<std::string>{"open.md", "plain.md", "unknown.md"}));
}

} // namespace
} // namespace meltpoint
