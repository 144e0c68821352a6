#pragma once

#include <memory>

#include <gtest/gtest.h>

#include "gpu/context.h"

namespace meltpoint {

/// A test on the GPU under validation and synchronization validation: any message of theirs fails it. Fails, not skips,
/// where there is no device or no validation layer. One context serves all tests of a program; MELTPOINT_DEVICE chooses
/// it.
class GpuTest : public testing::Test {
protected:
    static gpu::Context& context()
    {
        static const std::unique_ptr<gpu::Context> instance = [] {
            const char* device = std::getenv("MELTPOINT_DEVICE");
            return std::make_unique<gpu::Context>(
                gpu::ContextOptions{.device = device != nullptr ? device : "", .validation = true});
        }();
        return *instance;
    }

    void SetUp() override { context().clear_validation_messages(); }

    void TearDown() override
    {
        for (const std::string& message : context().validation_messages()) {
            ADD_FAILURE() << "Vulkan validation: " << message;
        }
    }

    /// For the tests that provoke a message on purpose: hands the messages over and forgets them.
    static std::vector<std::string> take_validation_messages()
    {
        std::vector<std::string> messages = context().validation_messages();
        context().clear_validation_messages();
        return messages;
    }
};

} // namespace meltpoint
