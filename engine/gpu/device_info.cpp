#include "gpu/device_info.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <optional>
#include <utility>

#include <fmt/ranges.h>

#include "core/error.h"
#include "gpu/device_requirements.h"

namespace meltpoint::gpu {

namespace {

/// Index and timestamp bits of the first family with graphics and compute (and so transfer).
std::optional<std::pair<std::uint32_t, std::uint32_t>> find_queue_family(const InstanceFunctions& vk,
                                                                         VkPhysicalDevice device)
{
    std::uint32_t count = 0;
    vk.vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vk.vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    for (std::uint32_t i = 0; i < count; ++i) {
        if ((families[i].queueFlags & required_queue_flags) == required_queue_flags) {
            return std::pair{i, families[i].timestampValidBits};
        }
    }
    return std::nullopt;
}

std::uint64_t largest_device_heap(const InstanceFunctions& vk, VkPhysicalDevice device)
{
    VkPhysicalDeviceMemoryProperties memory{};
    vk.vkGetPhysicalDeviceMemoryProperties(device, &memory);
    std::uint64_t largest = 0;
    for (std::uint32_t i = 0; i < memory.memoryHeapCount; ++i) {
        if ((memory.memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0) {
            largest = std::max<std::uint64_t>(largest, memory.memoryHeaps[i].size);
        }
    }
    return largest;
}

DeviceInfo describe_device(const InstanceFunctions& vk, std::uint32_t index, VkPhysicalDevice device)
{
    VkPhysicalDeviceProperties base{};
    vk.vkGetPhysicalDeviceProperties(device, &base);

    DeviceInfo info;
    info.index = index;
    info.handle = device;
    info.name = static_cast<const char*>(base.deviceName);
    info.api_version = base.apiVersion;
    info.type = base.deviceType;
    info.limits = base.limits;
    info.memory_bytes = largest_device_heap(vk, device);

    if (const auto family = find_queue_family(vk, device)) {
        info.queue_family = family->first;
        info.timestamp_bits = family->second;
    } else {
        info.missing.emplace_back("a queue with graphics and compute");
    }
    const std::vector<std::string> missing = missing_support(vk, device);
    info.missing.insert(info.missing.end(), missing.begin(), missing.end());
    if (base.apiVersion < required_api_version) {
        return info; // such a device does not know the structs below
    }

    VkPhysicalDeviceVulkan12Properties properties12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES};
    VkPhysicalDeviceVulkan11Properties properties11{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES,
                                                    &properties12};
    VkPhysicalDeviceProperties2 properties{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, &properties11};
    vk.vkGetPhysicalDeviceProperties2(device, &properties);
    info.subgroup_size = properties11.subgroupSize;
    info.driver = fmt::format("{} {}", static_cast<const char*>(properties12.driverName),
                              static_cast<const char*>(properties12.driverInfo));
    return info;
}

int preference(const DeviceInfo& device)
{
    switch (device.type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return 4;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return 3;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return 1;
    default:
        return 0;
    }
}

std::string lower(std::string text)
{
    std::transform(text.begin(), text.end(), text.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return text;
}

std::string names(const std::vector<DeviceInfo>& devices)
{
    std::vector<std::string> lines;
    for (const DeviceInfo& device : devices) {
        lines.push_back(fmt::format("{} {}", device.index, device.name));
    }
    return fmt::format("{}", fmt::join(lines, ", "));
}

const DeviceInfo& find_by_wish(const std::vector<DeviceInfo>& devices, const std::string& wish)
{
    std::uint32_t index = 0;
    const auto [end, error] = std::from_chars(wish.data(), wish.data() + wish.size(), index);
    if (error == std::errc() && end == wish.data() + wish.size()) {
        if (index >= devices.size()) {
            throw input_error("there is no device {}; the devices are: {}", index, names(devices));
        }
        return devices[index];
    }
    const DeviceInfo* found = nullptr;
    for (const DeviceInfo& device : devices) {
        if (lower(device.name).find(lower(wish)) == std::string::npos) {
            continue;
        }
        if (found != nullptr) {
            throw input_error("more than one device is named like \"{}\"; choose by index: {}", wish, names(devices));
        }
        found = &device;
    }
    if (found == nullptr) {
        throw input_error("no device is named like \"{}\"; the devices are: {}", wish, names(devices));
    }
    return *found;
}

} // namespace

std::vector<DeviceInfo> list_devices(const InstanceFunctions& vk)
{
    std::uint32_t count = 0;
    check(vk.vkEnumeratePhysicalDevices(vk.instance, &count, nullptr), "listing the Vulkan devices");
    std::vector<VkPhysicalDevice> handles(count);
    check(vk.vkEnumeratePhysicalDevices(vk.instance, &count, handles.data()), "listing the Vulkan devices");
    std::vector<DeviceInfo> devices;
    for (std::uint32_t i = 0; i < count; ++i) {
        devices.push_back(describe_device(vk, i, handles[i]));
    }
    return devices;
}

DeviceInfo choose_device(const std::vector<DeviceInfo>& devices, const std::string& wish)
{
    if (devices.empty()) {
        throw device_error("no Vulkan device was found (on a machine without a GPU, the Debian package "
                           "mesa-vulkan-drivers brings a software device)");
    }
    if (!wish.empty()) {
        const DeviceInfo& device = find_by_wish(devices, wish);
        if (!device.usable()) {
            throw device_error("device {} ({}) lacks {}", device.index, device.name, fmt::join(device.missing, ", "));
        }
        return device;
    }
    const DeviceInfo* best = nullptr;
    for (const DeviceInfo& device : devices) {
        if (device.usable() && (best == nullptr || preference(device) > preference(*best))) {
            best = &device;
        }
    }
    if (best == nullptr) {
        std::vector<std::string> reasons;
        for (const DeviceInfo& device : devices) {
            reasons.push_back(fmt::format("{} lacks {}", device.name, fmt::join(device.missing, ", ")));
        }
        throw device_error("no usable Vulkan device: {}", fmt::join(reasons, "; "));
    }
    return *best;
}

} // namespace meltpoint::gpu
