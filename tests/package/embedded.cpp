// A host with a Vulkan instance, device and queue of its own: the engine works in them, and the host uses the particles
// where they lie. It links the Vulkan loader itself; the engine neither defines nor needs a symbol of it.
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <vector>

#include <glm/glm.hpp>
#include <vulkan/vulkan.h>

#include <meltpoint/core/error.h>
#include <meltpoint/gpu/device_requirements.h>
#include <meltpoint/run/frame_statistics.h>
#include <meltpoint/run/mesh_scene.h>
#include <meltpoint/run/start_scene.h>

namespace {

namespace gpu = meltpoint::gpu;

void check(VkResult result, const char* what)
{
    if (result != VK_SUCCESS) {
        throw std::runtime_error(what);
    }
}

// Index of the device's first queue family with what the engine needs of a queue, or -1.
int find_family(VkPhysicalDevice device)
{
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    for (std::uint32_t i = 0; i < count; ++i) {
        if ((families[i].queueFlags & gpu::required_queue_flags) == gpu::required_queue_flags) {
            return static_cast<int>(i);
        }
    }
    return -1;
}

// What the host makes before the engine comes, and destroys after it has gone.
struct Host {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    std::uint32_t family = 0;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE;
    VkCommandPool pool = VK_NULL_HANDLE;
    VkFence fence = VK_NULL_HANDLE;
    VkBuffer buffer = VK_NULL_HANDLE; // host-visible: a vec4 a particle
    VkDeviceMemory memory = VK_NULL_HANDLE;
    glm::vec4* mapped = nullptr;

    Host() = default;
    Host(const Host&) = delete;
    Host& operator=(const Host&) = delete;

    ~Host()
    {
        if (device != VK_NULL_HANDLE) {
            vkDestroyBuffer(device, buffer, nullptr);
            vkFreeMemory(device, memory, nullptr);
            vkDestroyFence(device, fence, nullptr);
            vkDestroyCommandPool(device, pool, nullptr);
            vkDestroyDevice(device, nullptr);
        }
        if (instance != VK_NULL_HANDLE) {
            vkDestroyInstance(instance, nullptr);
        }
    }
};

void create_instance(Host& host)
{
    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.apiVersion = gpu::required_api_version; // or later
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pApplicationInfo = &application;
    check(vkCreateInstance(&info, nullptr, &host.instance), "no Vulkan instance");

    std::uint32_t count = 0;
    check(vkEnumeratePhysicalDevices(host.instance, &count, nullptr), "no devices");
    std::vector<VkPhysicalDevice> devices(count);
    check(vkEnumeratePhysicalDevices(host.instance, &count, devices.data()), "no devices");
    const gpu::InstanceFunctions functions = gpu::load_instance_functions(vkGetInstanceProcAddr, host.instance);
    for (const VkPhysicalDevice device : devices) {
        if (gpu::missing_support(functions, device).empty() && find_family(device) >= 0) {
            host.physical = device;
            host.family = static_cast<std::uint32_t>(find_family(device));
            return;
        }
    }
    throw std::runtime_error("no device has what the engine needs");
}

// Creates the device with what the engine needs and adopts it. A real host adds features and extensions of its own.
gpu::HostDevice create_device(Host& host, VkDeviceCreateInfo& info, VkPhysicalDeviceVulkan12Features& features12,
                              VkPhysicalDeviceVulkan13Features& features13, VkDeviceQueueCreateInfo& queue)
{
    static const float priority = 1.0f;
    queue.queueFamilyIndex = host.family;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    gpu::enable_required_features(features12, features13);
    features12.pNext = &features13;
    info.pNext = &features12;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.enabledExtensionCount = static_cast<std::uint32_t>(gpu::required_device_extensions().size());
    info.ppEnabledExtensionNames = gpu::required_device_extensions().data();
    check(vkCreateDevice(host.physical, &info, nullptr, &host.device), "no device");
    vkGetDeviceQueue(host.device, host.family, 0, &host.queue);
    return {.get_instance_proc_addr = vkGetInstanceProcAddr,
            .instance = host.instance,
            .api_version = gpu::required_api_version,
            .physical = host.physical,
            .device = host.device,
            .created_with = &info,
            .queue = host.queue,
            .queue_family = host.family};
}

void create_buffer(Host& host, VkDeviceSize bytes)
{
    VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
    info.size = bytes;
    info.usage = VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    check(vkCreateBuffer(host.device, &info, nullptr, &host.buffer), "no buffer");
    VkMemoryRequirements needs{};
    vkGetBufferMemoryRequirements(host.device, host.buffer, &needs);
    VkPhysicalDeviceMemoryProperties memory{};
    vkGetPhysicalDeviceMemoryProperties(host.physical, &memory);
    constexpr VkMemoryPropertyFlags wanted = VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
    VkMemoryAllocateInfo allocation{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
    allocation.allocationSize = needs.size;
    while ((needs.memoryTypeBits >> allocation.memoryTypeIndex & 1u) == 0 ||
           (memory.memoryTypes[allocation.memoryTypeIndex].propertyFlags & wanted) != wanted) {
        ++allocation.memoryTypeIndex; // Vulkan promises that there is one
    }
    check(vkAllocateMemory(host.device, &allocation, nullptr, &host.memory), "no memory");
    check(vkBindBufferMemory(host.device, host.buffer, host.memory, 0), "no memory");
    void* mapped = nullptr;
    check(vkMapMemory(host.device, host.memory, 0, VK_WHOLE_SIZE, 0, &mapped), "no mapping");
    host.mapped = static_cast<glm::vec4*>(mapped);
}

// Copies the particles' positions by commands of the host, on the host's queue. What the engine wrote is visible
// without a barrier (meltpoint/gpu/context.h); the barrier here is the host's own, between its copy and its reading.
void copy_positions(const Host& host, VkCommandBuffer commands, const meltpoint::ParticleBuffers& particles)
{
    VkCommandBufferBeginInfo begin{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vkBeginCommandBuffer(commands, &begin), "not recording");
    const VkBufferCopy region{0, 0, particles.count * sizeof(glm::vec4)};
    vkCmdCopyBuffer(commands, particles.position.handle(), host.buffer, 1, &region);
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_TRANSFER_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_HOST_READ_BIT;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_TRANSFER_BIT, VK_PIPELINE_STAGE_HOST_BIT, 0, 1, &barrier, 0,
                         nullptr, 0, nullptr);
    check(vkEndCommandBuffer(commands), "not recorded");
    VkSubmitInfo submit{VK_STRUCTURE_TYPE_SUBMIT_INFO};
    submit.commandBufferCount = 1;
    submit.pCommandBuffers = &commands;
    check(vkQueueSubmit(host.queue, 1, &submit, host.fence), "not submitted");
}

// Of particles of equal mass.
glm::dvec3 center_of_mass(const glm::vec4* particles, std::uint32_t count)
{
    glm::dvec3 sum(0.0);
    for (std::uint32_t i = 0; i < count; ++i) {
        sum += glm::dvec3(particles[i]);
    }
    return sum / static_cast<double>(count);
}

void run()
{
    Host host;
    create_instance(host);
    VkDeviceQueueCreateInfo queue{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    VkPhysicalDeviceVulkan12Features features12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceVulkan13Features features13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkDeviceCreateInfo info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO};
    const gpu::Context context(create_device(host, info, features12, features13, queue)); // destroyed before the host

    const std::vector<std::string> overrides{"particles.spacing=0.03"};
    auto started = meltpoint::start_scene(context, meltpoint::find_scene("teapot_drop", overrides));
    auto& simulation = started.simulation;
    const std::uint32_t count = simulation->particles().count;
    create_buffer(host, count * sizeof(glm::vec4));

    VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT;
    pool.queueFamilyIndex = host.family;
    check(vkCreateCommandPool(host.device, &pool, nullptr, &host.pool), "no command pool");
    VkCommandBufferAllocateInfo allocation{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    allocation.commandPool = host.pool;
    allocation.commandBufferCount = 1;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    check(vkAllocateCommandBuffers(host.device, &allocation, &commands), "no command buffer");
    const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    check(vkCreateFence(host.device, &fence, nullptr, &host.fence), "no fence");

    for (int round = 0; round < 3; ++round) {
        // The particles are sorted anew in every step, and swap buffers with the sort: ask for the handles every time.
        copy_positions(host, commands, simulation->particles());
        const meltpoint::ParticleSet before = simulation->download();
        simulation->advance(10); // waits for the copy, which reads what the steps write
        check(vkWaitForFences(host.device, 1, &host.fence, VK_TRUE, UINT64_MAX), "device lost");
        check(vkResetFences(host.device, 1, &host.fence), "device lost");

        const glm::dvec3 center = center_of_mass(host.mapped, count);
        const auto fluid = meltpoint::measure(before, started.params).fluid_part.value();
        std::printf("%.9g %.9g %.9g\n", center.x, center.y, center.z);
        if (!(glm::distance(center, fluid.center_of_mass) < 1e-9)) {
            throw std::runtime_error("the host does not see the particles that the engine sees");
        }
    }
}

} // namespace

int main()
{
    try {
        run();
    } catch (const std::exception& error) { // meltpoint::Error is one
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
