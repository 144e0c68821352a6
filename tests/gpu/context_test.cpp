#include "gpu/context.h"

#include <numeric>

#include <volk.h>

#include "core/error.h"
#include "gpu/buffer.h"
#include "gpu/transfer.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class ContextTest : public GpuTest {};

TEST_F(ContextTest, ChoosesAUsableDeviceUnderValidation)
{
    EXPECT_TRUE(context().info().usable());
    EXPECT_TRUE(context().validated());
}

TEST_F(ContextTest, UploadAndDownloadKeepEveryBit)
{
    std::vector<std::uint32_t> data(10'007);
    std::iota(data.begin(), data.end(), 0x80000000u);
    const gpu::Buffer buffer = gpu::make_buffer<std::uint32_t>(context(), data.size(), "round trip");
    gpu::upload<std::uint32_t>(context(), buffer, data);
    EXPECT_EQ(gpu::download<std::uint32_t>(context(), buffer, data.size()), data);
}

TEST_F(ContextTest, ABufferBeyondTheLimitsIsADeviceError)
{
    const VkDeviceSize too_large = VkDeviceSize{context().limits().maxStorageBufferRange} + 1;
    try {
        const gpu::Buffer buffer(context(), too_large, gpu::MemoryUse::Device, "giant");
        FAIL() << "expected an error";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Device);
        EXPECT_NE(std::string(error.what()).find("giant"), std::string::npos) << error.what();
    }
}

TEST_F(ContextTest, DevicesAreChosenByIndexAndByPartOfTheName)
{
    const std::vector<gpu::DeviceInfo> devices = gpu::list_devices(context().instance_functions());
    ASSERT_FALSE(devices.empty());
    EXPECT_EQ(gpu::choose_device(devices, "0").index, 0u);
    EXPECT_EQ(gpu::choose_device({devices[0]}, devices[0].name.substr(0, 4)).index, 0u);
    EXPECT_THROW((void)gpu::choose_device(devices, "no such device"), Error);
    EXPECT_THROW((void)gpu::choose_device(devices, "99"), Error);
    EXPECT_THROW((void)gpu::choose_device({}, ""), Error);
}

TEST_F(ContextTest, ADeviceThatLacksTheBaselineIsNamedWithWhatItLacks)
{
    gpu::DeviceInfo poor = context().info();
    poor.missing = {"scalarBlockLayout"};
    try {
        (void)gpu::choose_device({poor}, "");
        FAIL() << "expected an error";
    } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find("scalarBlockLayout"), std::string::npos) << error.what();
    }
}

// Validation itself must be seen to work, or its silence means nothing.
TEST_F(ContextTest, ValidationSeesAKnownError)
{
    VkBufferCreateInfo empty{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    empty.size = 0; // VUID-VkBufferCreateInfo-size-00912
    empty.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    VkBuffer buffer = VK_NULL_HANDLE;
    if (context().vk().vkCreateBuffer(context().device(), &empty, nullptr, &buffer) == VK_SUCCESS) {
        context().vk().vkDestroyBuffer(context().device(), buffer, nullptr);
    }
    const std::vector<std::string> messages = take_validation_messages();
    ASSERT_FALSE(messages.empty());
    EXPECT_NE(messages[0].find("VUID-VkBufferCreateInfo-size-00912"), std::string::npos) << messages[0];
}

TEST_F(ContextTest, SynchronizationValidationSeesASuppressedBarrier)
{
    const gpu::Buffer buffer = gpu::make_buffer<std::uint32_t>(context(), 1024, "hazard");
    const gpu::Buffer target = gpu::make_buffer<std::uint32_t>(context(), 1024, "hazard copy");
    gpu::Commands commands(context());
    const auto record = [&](bool suppress) {
        commands.begin();
        commands.fill(buffer, 1);
        if (suppress) {
            commands.suppress_next_barrier();
        }
        commands.copy(buffer, target, buffer.size());
        commands.submit();
        commands.wait();
    };
    record(false);
    EXPECT_TRUE(take_validation_messages().empty());
    record(true);
    const std::vector<std::string> messages = take_validation_messages();
    ASSERT_FALSE(messages.empty());
    EXPECT_NE(messages[0].find("SYNC-HAZARD-READ-AFTER-WRITE"), std::string::npos) << messages[0];
}

} // namespace
} // namespace meltpoint
