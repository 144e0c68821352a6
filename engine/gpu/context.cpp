#include "gpu/context.h"

#include <fmt/ranges.h>

#include "core/error.h"

namespace meltpoint::gpu {

Context::Context(const ContextOptions& options) : instance_(std::make_unique<Instance>(options.validation))
{
    info_ = choose_device(list_devices(instance_->handle()), options.device);

    VkPhysicalDeviceVulkan13Features features13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    features13.synchronization2 = VK_TRUE;
    features13.dynamicRendering = VK_TRUE;
    features13.maintenance4 = VK_TRUE; // shaders for Vulkan 1.3 name their workgroup size by LocalSizeId
    VkPhysicalDeviceVulkan12Features features12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, &features13};
    features12.scalarBlockLayout = VK_TRUE;
    const VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &features12};

    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue_info{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue_info.queueFamilyIndex = info_.queue_family;
    queue_info.queueCount = 1;
    queue_info.pQueuePriorities = &priority;

    const char* extension = VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME;
    VkDeviceCreateInfo device_info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &features};
    device_info.queueCreateInfoCount = 1;
    device_info.pQueueCreateInfos = &queue_info;
    device_info.enabledExtensionCount = 1;
    device_info.ppEnabledExtensionNames = &extension;
    check(vkCreateDevice(info_.handle, &device_info, nullptr, &device_), "creating the Vulkan device");
    volkLoadDeviceTable(&vk, device_);
    vk.vkGetDeviceQueue(device_, info_.queue_family, 0, &queue_);
    vkGetPhysicalDeviceMemoryProperties(info_.handle, &memory_);
}

Context::Context(const HostDevice& host) : host_instance_(host.instance), device_(host.device), queue_(host.queue)
{
    if (volkInitialize() != VK_SUCCESS) {
        throw device_error("no Vulkan loader was found");
    }
    volkLoadInstanceOnly(host.instance);
    for (const DeviceInfo& candidate : list_devices(host.instance)) {
        if (candidate.handle == host.physical) {
            info_ = candidate;
        }
    }
    if (info_.handle == VK_NULL_HANDLE) {
        throw device_error("the host's physical device does not belong to its instance");
    }
    if (!info_.usable()) {
        throw device_error("the host's device {} lacks {}", info_.name, fmt::join(info_.missing, ", "));
    }
    info_.queue_family = host.queue_family;
    volkLoadDeviceTable(&vk, device_);
    vkGetPhysicalDeviceMemoryProperties(info_.handle, &memory_);
}

Context::~Context()
{
    if (instance_ && device_ != VK_NULL_HANDLE) {
        vk.vkDestroyDevice(device_, nullptr);
    }
}

std::vector<std::string> Context::validation_messages() const
{
    return instance_ ? instance_->validation_log().messages() : std::vector<std::string>{};
}

void Context::clear_validation_messages()
{
    if (instance_) {
        instance_->validation_log().clear();
    }
}

std::uint32_t Context::memory_type(std::uint32_t type_bits, VkMemoryPropertyFlags required,
                                   VkMemoryPropertyFlags preferred) const
{
    for (const VkMemoryPropertyFlags wanted : {required | preferred, required}) {
        for (std::uint32_t i = 0; i < memory_.memoryTypeCount; ++i) {
            if ((type_bits & (1u << i)) != 0 && (memory_.memoryTypes[i].propertyFlags & wanted) == wanted) {
                return i;
            }
        }
    }
    throw device_error("{} has no memory type with the properties {:#x}", info_.name, required);
}

void Context::set_name(VkObjectType type, std::uint64_t handle, const std::string& name) const
{
    if (vkSetDebugUtilsObjectNameEXT == nullptr) {
        return;
    }
    VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT};
    info.objectType = type;
    info.objectHandle = handle;
    info.pObjectName = name.c_str();
    check(vkSetDebugUtilsObjectNameEXT(device_, &info), "naming an object");
}

} // namespace meltpoint::gpu
