#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gpu/functions.h"

namespace meltpoint::gpu {

// The baseline that the engine asks of every device: what a host program has to enable in its own, and what is checked.

/// Of the instance (VkApplicationInfo::apiVersion) and of the device.
inline constexpr std::uint32_t required_api_version = VK_API_VERSION_1_3;

/// Flags that the one queue's family must have.
inline constexpr VkQueueFlags required_queue_flags = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;

/// Names of the device extensions, for VkDeviceCreateInfo::ppEnabledExtensionNames. No instance extension is needed.
[[nodiscard]] std::span<const char* const> required_device_extensions();

/// Sets the features in two structs that belong into the chain of VkDeviceCreateInfo::pNext; leaves all others as they
/// are.
void enable_required_features(VkPhysicalDeviceVulkan12Features& features12,
                              VkPhysicalDeviceVulkan13Features& features13);

/// Names of what a physical device does not support; empty for a usable one.
[[nodiscard]] std::vector<std::string> missing_support(const InstanceFunctions& vk, VkPhysicalDevice device);

/// Names of the extensions and features that a device created so does not have enabled. Finds a feature in
/// VkPhysicalDeviceVulkan12Features and 13Features as well as in the struct of its own.
[[nodiscard]] std::vector<std::string> missing_enabled(const VkDeviceCreateInfo& created_with);

} // namespace meltpoint::gpu
