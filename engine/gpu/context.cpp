#include "gpu/context.h"

#include <algorithm>
#include <span>

#include <fmt/ranges.h>
#include <volk.h>

#include "core/error.h"
#include "gpu/device_requirements.h"

namespace meltpoint::gpu {

namespace {

bool has_queue_of(const VkDeviceCreateInfo& device, std::uint32_t family)
{
    const std::span queues(device.pQueueCreateInfos, device.queueCreateInfoCount);
    return std::any_of(queues.begin(), queues.end(), [&](const VkDeviceQueueCreateInfo& queue) {
        return queue.queueFamilyIndex == family && queue.queueCount > 0;
    });
}

/// What a host forgot to give, in words; empty where nothing is missing.
std::vector<std::string> not_given(const HostDevice& host)
{
    std::vector<std::string> names;
    const auto ask_for = [&](bool given, const char* name) {
        if (!given) {
            names.emplace_back(name);
        }
    };
    ask_for(host.instance != VK_NULL_HANDLE, "instance");
    ask_for(host.physical != VK_NULL_HANDLE, "physical");
    ask_for(host.device != VK_NULL_HANDLE, "device");
    ask_for(host.created_with != nullptr, "created_with");
    ask_for(host.queue != VK_NULL_HANDLE, "queue");
    return names;
}

/// The loader's entry point, once it is known that the instance may be asked for functions of Vulkan 1.3.
PFN_vkGetInstanceProcAddr loader_of(const HostDevice& host)
{
    const std::vector<std::string> names = not_given(host);
    if (!names.empty()) {
        throw device_error("the host's device cannot be used: HostDevice::{} was not given", fmt::join(names, ", "));
    }
    if (host.api_version < required_api_version) {
        throw device_error("the host's instance was created for Vulkan {}.{}, but {}.{} is needed "
                           "(VkApplicationInfo::apiVersion, HostDevice::api_version)",
                           VK_API_VERSION_MAJOR(host.api_version), VK_API_VERSION_MINOR(host.api_version),
                           VK_API_VERSION_MAJOR(required_api_version), VK_API_VERSION_MINOR(required_api_version));
    }
    return host.get_instance_proc_addr != nullptr ? host.get_instance_proc_addr : system_loader();
}

/// The family's properties; those of no queue at all where there is no such family.
VkQueueFamilyProperties family_of(const InstanceFunctions& vk, const HostDevice& host)
{
    std::uint32_t count = 0;
    vk.vkGetPhysicalDeviceQueueFamilyProperties(host.physical, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vk.vkGetPhysicalDeviceQueueFamilyProperties(host.physical, &count, families.data());
    return host.queue_family < count ? families[host.queue_family] : VkQueueFamilyProperties{};
}

} // namespace

Context::Context(const ContextOptions& options)
    : instance_(std::make_unique<Instance>(options.validation)), instance_functions_(instance_->functions()),
      info_(choose_device(list_devices(instance_functions_), options.device))
{
    VkPhysicalDeviceVulkan13Features features13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
    VkPhysicalDeviceVulkan12Features features12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES, &features13};
    enable_required_features(features12, features13);

    const float priority = 1.0f;
    VkDeviceQueueCreateInfo queue_info{VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO};
    queue_info.queueFamilyIndex = info_.queue_family;
    queue_info.queueCount = 1;
    queue_info.pQueuePriorities = &priority;

    const std::span<const char* const> extensions = required_device_extensions();
    VkDeviceCreateInfo device_info{VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO, &features12};
    device_info.queueCreateInfoCount = 1;
    device_info.pQueueCreateInfos = &queue_info;
    device_info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    device_info.ppEnabledExtensionNames = extensions.data();
    check(instance_functions_.vkCreateDevice(info_.handle, &device_info, nullptr, &device_),
          "creating the Vulkan device");
    device_functions_ = load_device_functions(instance_functions_, device_);
    device_functions_->vkGetDeviceQueue(device_, info_.queue_family, 0, &queue_);
    instance_functions_.vkGetPhysicalDeviceMemoryProperties(info_.handle, &memory_);
}

Context::Context(const HostDevice& host)
    : instance_functions_(load_instance_functions(loader_of(host), host.instance)), device_(host.device),
      queue_(host.queue), queue_mutex_(host.queue_mutex)
{
    for (const DeviceInfo& candidate : list_devices(instance_functions_)) {
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
    const std::vector<std::string> disabled = missing_enabled(*host.created_with);
    if (!disabled.empty()) {
        throw device_error("the host's device {} was created without {}, which it supports and the engine needs",
                           info_.name, fmt::join(disabled, ", "));
    }
    const VkQueueFamilyProperties family = family_of(instance_functions_, host);
    if ((family.queueFlags & required_queue_flags) != required_queue_flags ||
        !has_queue_of(*host.created_with, host.queue_family)) {
        throw device_error("the host's queue family {} has no graphics and compute, or its device was created without "
                           "a queue of it",
                           host.queue_family);
    }
    info_.queue_family = host.queue_family;
    info_.timestamp_bits = family.timestampValidBits;
    device_functions_ = load_device_functions(instance_functions_, device_);
    instance_functions_.vkGetPhysicalDeviceMemoryProperties(info_.handle, &memory_);
}

Context::~Context()
{
    if (instance_ && device_ != VK_NULL_HANDLE) {
        device_functions_->vkDestroyDevice(device_, nullptr);
    }
}

VkResult Context::submit(const VkSubmitInfo2& work, VkFence fence) const
{
    std::unique_lock<std::mutex> lock;
    if (queue_mutex_ != nullptr) {
        lock = std::unique_lock(*queue_mutex_);
    }
    return device_functions_->vkQueueSubmit2(queue_, 1, &work, fence);
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
    if (instance_functions_.vkSetDebugUtilsObjectNameEXT == nullptr) {
        return;
    }
    VkDebugUtilsObjectNameInfoEXT info{VK_STRUCTURE_TYPE_DEBUG_UTILS_OBJECT_NAME_INFO_EXT};
    info.objectType = type;
    info.objectHandle = handle;
    info.pObjectName = name.c_str();
    check(instance_functions_.vkSetDebugUtilsObjectNameEXT(device_, &info), "naming an object");
}

} // namespace meltpoint::gpu
