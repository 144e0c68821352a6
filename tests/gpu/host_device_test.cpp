#include <cstdlib>
#include <cstring>
#include <future>
#include <mutex>

#include <gtest/gtest.h>
#include <volk.h>

#include "core/error.h"
#include "gpu/context.h"
#include "gpu/device_requirements.h"
#include "sim/simulation.h"
#include "support/fluid_states.h"

namespace meltpoint {
namespace {

/// What a host's device is created with: by default what the engine needs.
struct DeviceWishes {
    VkPhysicalDeviceVulkan12Features features12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceVulkan13Features features13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    bool push_descriptor = true;

    DeviceWishes() { gpu::enable_required_features(features12, features13); }
};

/// The same features, each in the struct of its own.
struct SeparateFeatures {
    VkPhysicalDeviceMaintenance4Features maintenance4{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES, nullptr,
                                                      VK_TRUE};
    VkPhysicalDeviceDynamicRenderingFeatures rendering{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES,
                                                       &maintenance4, VK_TRUE};
    VkPhysicalDeviceSynchronization2Features synchronization{
        VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES, &rendering, VK_TRUE};
    VkPhysicalDeviceScalarBlockLayoutFeatures layout{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SCALAR_BLOCK_LAYOUT_FEATURES,
                                                     &synchronization, VK_TRUE};
    VkPhysicalDeviceFeatures2 chain{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &layout};
};

/// An instance whose validation also looks across submissions, for hosts that synchronize with the engine.
std::unique_ptr<gpu::Instance> make_instance()
{
    setenv("VK_LAYER_ENABLES", "VALIDATION_CHECK_ENABLE_SYNCHRONIZATION_VALIDATION_QUEUE_SUBMIT", 1);
    auto instance = std::make_unique<gpu::Instance>(true);
    unsetenv("VK_LAYER_ENABLES");
    return instance;
}

/// A host program with a device of its own. Any message of validation fails the test.
class HostProgram {
public:
    explicit HostProgram(const DeviceWishes& wishes = {}, bool separate = false) : wishes_(wishes)
    {
        wishes_.features12.pNext = &wishes_.features13;
        queue_.queueFamilyIndex = physical_.queue_family;
        queue_.queueCount = 1;
        queue_.pQueuePriorities = &priority_;
        created_with.pNext = separate ? static_cast<const void*>(&separate_.chain) : &wishes_.features12;
        created_with.queueCreateInfoCount = 1;
        created_with.pQueueCreateInfos = &queue_;
        created_with.enabledExtensionCount = wishes.push_descriptor ? 1 : 0;
        created_with.ppEnabledExtensionNames = gpu::required_device_extensions().data();
        handles.instance = instance_->handle();
        handles.api_version = gpu::required_api_version;
        handles.physical = physical_.handle;
        handles.created_with = &created_with;
        handles.queue_family = physical_.queue_family;
        gpu::check(functions().vkCreateDevice(physical_.handle, &created_with, nullptr, &handles.device), "creating");
        load<PFN_vkGetDeviceQueue>("vkGetDeviceQueue")(handles.device, handles.queue_family, 0, &handles.queue);
    }

    ~HostProgram()
    {
        load<PFN_vkDestroyDevice>("vkDestroyDevice")(handles.device, nullptr); // complains about what is left on it
        for (const std::string& message : instance_->validation_log().messages()) {
            ADD_FAILURE() << "Vulkan validation: " << message;
        }
    }

    HostProgram(const HostProgram&) = delete;
    HostProgram& operator=(const HostProgram&) = delete;

    [[nodiscard]] const gpu::InstanceFunctions& functions() const { return instance_->functions(); }
    [[nodiscard]] gpu::ValidationLog& validation_log() const { return instance_->validation_log(); }

    template <class Function>
    [[nodiscard]] Function load(const char* name) const
    {
        return reinterpret_cast<Function>(functions().vkGetDeviceProcAddr(handles.device, name)); // NOLINT
    }

    gpu::HostDevice handles;
    VkDeviceCreateInfo created_with{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};

private:
    std::unique_ptr<gpu::Instance> instance_ = make_instance();
    gpu::DeviceInfo physical_ = gpu::choose_device(gpu::list_devices(instance_->functions()), "");
    DeviceWishes wishes_;
    SeparateFeatures separate_;
    const float priority_ = 1.0f;
    VkDeviceQueueCreateInfo queue_{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
};

std::string refusal(const gpu::HostDevice& host)
{
    try {
        const gpu::Context context(host);
        return "adopted";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::Device);
        return error.what();
    }
}

std::string refusal(const DeviceWishes& wishes)
{
    const HostProgram host(wishes);
    return refusal(host.handles);
}

TEST(HostDevice, WhatIsNotEnabledIsNamed)
{
    EXPECT_EQ(refusal(DeviceWishes()), "adopted");

    DeviceWishes wishes;
    wishes.features12.scalarBlockLayout = VK_FALSE;
    const std::string one = refusal(wishes);
    EXPECT_NE(one.find("was created without scalarBlockLayout, which it supports"), std::string::npos) << one;

    wishes = {};
    wishes.push_descriptor = false;
    wishes.features13.synchronization2 = VK_FALSE;
    wishes.features13.dynamicRendering = VK_FALSE;
    wishes.features13.maintenance4 = VK_FALSE;
    const std::string many = refusal(wishes);
    EXPECT_NE(many.find("without synchronization2, dynamicRendering, maintenance4, VK_KHR_push_descriptor, which"),
              std::string::npos)
        << many;
}

TEST(HostDevice, FeaturesCountInStructsOfTheirOwn)
{
    const HostProgram host({}, true);
    EXPECT_EQ(refusal(host.handles), "adopted");
}

TEST(HostDevice, WhatCannotBeUsedIsRefused)
{
    EXPECT_EQ(refusal(gpu::HostDevice{}), "the host's device cannot be used: HostDevice::instance, physical, device, "
                                          "created_with, queue was not given");
    const HostProgram host;
    gpu::HostDevice handles = host.handles;
    handles.api_version = VK_API_VERSION_1_1;
    EXPECT_NE(refusal(handles).find("for Vulkan 1.1, but 1.3 is needed"), std::string::npos) << refusal(handles);

    handles = host.handles;
    handles.queue_family = 77;
    EXPECT_NE(refusal(handles).find("queue family 77 has no graphics"), std::string::npos) << refusal(handles);

    handles = host.handles;
    VkDeviceCreateInfo without_queue = host.created_with;
    without_queue.queueCreateInfoCount = 0;
    handles.created_with = &without_queue;
    EXPECT_NE(refusal(handles).find("created without a queue of it"), std::string::npos) << refusal(handles);

    const gpu::Instance stranger(false);
    handles = host.handles;
    handles.instance = stranger.handle();
    EXPECT_NE(refusal(handles).find("does not belong to its instance"), std::string::npos) << refusal(handles);
}

/// A copy of the positions by commands of the host, without a barrier before it.
class HostsCopy {
public:
    HostsCopy(const HostProgram& host, const gpu::Context& context, VkDeviceSize bytes)
        : vk_(context.vk()), device_(host.handles.device), queue_(host.handles.queue),
          target(context, bytes, gpu::MemoryUse::Readback, "of the host")
    {
        VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
        pool.queueFamilyIndex = host.handles.queue_family;
        gpu::check(vk_.vkCreateCommandPool(device_, &pool, nullptr, &pool_), "a pool");
        const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
        gpu::check(vk_.vkCreateFence(device_, &fence, nullptr, &fence_), "a fence");
    }
    ~HostsCopy()
    {
        vk_.vkDestroyFence(device_, fence_, nullptr);
        vk_.vkDestroyCommandPool(device_, pool_, nullptr);
    }
    HostsCopy(const HostsCopy&) = delete;
    HostsCopy& operator=(const HostsCopy&) = delete;

    void submit(const gpu::Buffer& source)
    {
        VkCommandBufferAllocateInfo allocation{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
        allocation.commandPool = pool_;
        allocation.commandBufferCount = 1;
        VkCommandBuffer commands = VK_NULL_HANDLE;
        gpu::check(vk_.vkAllocateCommandBuffers(device_, &allocation, &commands), "commands");
        const VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
        gpu::check(vk_.vkBeginCommandBuffer(commands, &begin), "begin");
        const VkBufferCopy region{0, 0, target.size()};
        vk_.vkCmdCopyBuffer(commands, source.handle(), target.handle(), 1, &region);
        gpu::check(vk_.vkEndCommandBuffer(commands), "end");
        VkCommandBufferSubmitInfo command{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
        command.commandBuffer = commands;
        VkSubmitInfo2 work{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
        work.commandBufferInfoCount = 1;
        work.pCommandBufferInfos = &command;
        gpu::check(vk_.vkQueueSubmit2(queue_, 1, &work, fence_), "submit");
    }
    void wait() { gpu::check(vk_.vkWaitForFences(device_, 1, &fence_, VK_TRUE, UINT64_MAX), "wait"); }

private:
    const VolkDeviceTable& vk_;
    VkDevice device_;
    VkQueue queue_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;

public:
    gpu::Buffer target;
};

// Submissions that neither the engine nor the host waits for between: the queue's order and the engine's barriers must
// do.
TEST(HostDevice, TheHostSeesWhatTheEngineWroteWithoutBarriersOfItsOwn)
{
    const HostProgram host;
    const gpu::Context context(host.handles);
    const gpu::Buffer buffer = gpu::make_buffer<float>(context, 1024, "shared");
    HostsCopy copy(host, context, buffer.size());
    gpu::Commands commands(context);
    commands.begin();
    commands.fill(buffer, 0x3f800000);
    commands.submit();
    copy.submit(buffer);
    copy.wait();
    commands.wait();
    EXPECT_EQ(copy.target.mapped<float>()[1023], 1.0f);
}

TEST(HostDevice, TheEngineWritesWhenTheHostHasReadWithoutBarriersOfItsOwn)
{
    const HostProgram host;
    const gpu::Context context(host.handles);
    const gpu::Buffer buffer = gpu::make_buffer<float>(context, 1024, "shared"); // which the engine has not used before
    HostsCopy copy(host, context, buffer.size());
    gpu::Commands commands(context);
    copy.submit(buffer);
    commands.begin();
    commands.fill(buffer, 0);
    commands.submit();
    commands.wait();
    copy.wait();
}

TEST(HostDevice, TheHostReadsTheParticlesOfAStep)
{
    const HostProgram host;
    const gpu::Context context(host.handles);
    const ParticleSet set = lattice_state({6, 6, 6}, glm::vec3(0.3f));
    sim::Simulation simulation(context, set, test_settings(shared::KERNEL_WENDLAND));
    simulation.advance(3);
    HostsCopy copy(host, context, set.size() * sizeof(glm::vec4));
    copy.submit(simulation.particles().position);
    const ParticleSet before = download_unordered(context, simulation.particles());
    simulation.advance(3); // writes what the host may still be reading
    copy.wait();
    for (std::size_t i = 0; i < set.size(); ++i) {
        EXPECT_EQ(glm::vec3(copy.target.mapped<glm::vec4>()[i]), before.position[i]) << i;
    }
}

// The layer must be seen to look across submissions, or its silence above means nothing.
TEST(HostDevice, ValidationSeesAHazardBetweenTwoSubmissionsOfTheHost)
{
    const HostProgram host;
    {
        const gpu::Context context(host.handles);
        const gpu::Buffer source = gpu::make_buffer<float>(context, 1024, "source");
        HostsCopy first(host, context, source.size());
        HostsCopy second(host, context, source.size());
        first.submit(source);
        second.submit(first.target);
        second.wait();
        first.wait();
    }
    const std::vector<std::string> messages = host.validation_log().messages();
    host.validation_log().clear();
    ASSERT_FALSE(messages.empty());
    EXPECT_NE(messages[0].find("SYNC-HAZARD-READ-AFTER-WRITE"), std::string::npos) << messages[0];
}

// A loader of the host that watches submissions: Vulkan's entry points have no room for an object of the test's.
struct Watch {
    PFN_vkGetInstanceProcAddr next_instance = nullptr;
    PFN_vkGetDeviceProcAddr next_device = nullptr;
    PFN_vkQueueSubmit2 next_submit = nullptr;
    std::mutex mutex;
    int submissions = 0;
    int unlocked = 0;
};
Watch watch; // NOLINT

VKAPI_ATTR VkResult VKAPI_CALL watched_submit(VkQueue queue, std::uint32_t count, const VkSubmitInfo2* work,
                                              VkFence fence)
{
    ++watch.submissions;
    const auto another_thread_gets_it = [] {
        return std::unique_lock(watch.mutex, std::try_to_lock).owns_lock();
    };
    watch.unlocked += std::async(std::launch::async, another_thread_gets_it).get() ? 1 : 0;
    return watch.next_submit(queue, count, work, fence);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL watched_device(VkDevice device, const char* name)
{
    return std::strcmp(name, "vkQueueSubmit2") == 0 ? reinterpret_cast<PFN_vkVoidFunction>(watched_submit) // NOLINT
                                                    : watch.next_device(device, name);
}

VKAPI_ATTR PFN_vkVoidFunction VKAPI_CALL watched_instance(VkInstance instance, const char* name)
{
    return std::strcmp(name, "vkGetDeviceProcAddr") == 0
               ? reinterpret_cast<PFN_vkVoidFunction>(watched_device) // NOLINT
               : watch.next_instance(instance, name);
}

TEST(HostDevice, EverySubmissionGoesThroughTheHostsLoaderUnderItsMutex)
{
    HostProgram host;
    watch.next_instance = gpu::system_loader();
    watch.next_device = host.functions().vkGetDeviceProcAddr;
    watch.next_submit = host.load<PFN_vkQueueSubmit2>("vkQueueSubmit2");
    host.handles.get_instance_proc_addr = watched_instance;
    host.handles.queue_mutex = &watch.mutex;
    const gpu::Context context(host.handles);
    sim::Simulation simulation(context, lattice_state({4, 4, 4}, glm::vec3(0.3f)),
                               test_settings(shared::KERNEL_WENDLAND));
    const int before = watch.submissions;
    simulation.advance(1);
    EXPECT_EQ(watch.submissions, before + 1);
    EXPECT_GT(before, 0);
    EXPECT_EQ(watch.unlocked, 0);
}

TEST(HostDevice, HostsMayBindTheParticlesAsVertices)
{
    const HostProgram host;
    const gpu::Context context(host.handles);
    const gpu::Buffer positions = gpu::make_texel_buffer(context, 64, "positions");
    gpu::Commands commands(context);
    commands.begin();
    const VkBuffer handle = positions.handle();
    const VkDeviceSize offset = 0;
    host.load<PFN_vkCmdBindVertexBuffers>("vkCmdBindVertexBuffers")(commands.handle(), 0, 1, &handle, &offset);
    commands.submit();
    commands.wait();
}

} // namespace
} // namespace meltpoint
