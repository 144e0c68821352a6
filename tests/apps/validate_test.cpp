// `meltpoint validate` as a user meets it; the cases themselves are long tests (tests/physics/validation_test.cpp).
#include "support/cli.h"

namespace meltpoint {
namespace {

class ValidateCli : public test::Cli {};

TEST_F(ValidateCli, MistakesAreToldBeforeTheWork)
{
    std::filesystem::create_directory(path("plots"));
    test::write_bytes(path("plots/honey.svg"), "mine");
    const std::vector<std::pair<test::Arguments, std::string>> mistakes = {
        {{"validate", "hony"}, "there is no case \"hony\"; did you mean \"honey\"?"},
        {{"validate", "honey", "--plots", "plots"}, "plots/honey.svg exists"},
        {{"validate", "honey", "--device", "nosuch"}, "nosuch"},
    };
    for (const auto& [arguments, part] : mistakes) {
        test::expect_one_sentence(run(arguments), 2, part);
    }
    EXPECT_EQ(bytes("plots/honey.svg"), "mine");
}

} // namespace
} // namespace meltpoint
