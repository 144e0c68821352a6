#include "gpu/device_requirements.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

namespace meltpoint::gpu {

namespace {

constexpr std::array<const char*, 1> device_extensions{VK_KHR_PUSH_DESCRIPTOR_EXTENSION_NAME};

/// The features of the baseline, in the two structs that hold them.
struct Features {
    VkPhysicalDeviceVulkan12Features v12{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES};
    VkPhysicalDeviceVulkan13Features v13{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES};
};

struct Feature12 {
    const char* name;
    VkBool32 VkPhysicalDeviceVulkan12Features::*member;
};
struct Feature13 {
    const char* name;
    VkBool32 VkPhysicalDeviceVulkan13Features::*member;
};
constexpr std::array required12{Feature12{"scalarBlockLayout", &VkPhysicalDeviceVulkan12Features::scalarBlockLayout}};
constexpr std::array required13{
    Feature13{"synchronization2", &VkPhysicalDeviceVulkan13Features::synchronization2},
    Feature13{"dynamicRendering", &VkPhysicalDeviceVulkan13Features::dynamicRendering},
    // shaders for Vulkan 1.3 name their workgroup size by LocalSizeId
    Feature13{"maintenance4", &VkPhysicalDeviceVulkan13Features::maintenance4},
};

void add_missing_features(const Features& features, std::vector<std::string>& missing)
{
    for (const Feature12& feature : required12) {
        if (features.v12.*feature.member == VK_FALSE) {
            missing.emplace_back(feature.name);
        }
    }
    for (const Feature13& feature : required13) {
        if (features.v13.*feature.member == VK_FALSE) {
            missing.emplace_back(feature.name);
        }
    }
}

template <class Struct>
const Struct& as(const VkBaseInStructure* link)
{
    return *reinterpret_cast<const Struct*>(link); // NOLINT: sType says what it is
}

/// The features of the baseline that a chain of structs asks for.
Features features_in(const void* chain)
{
    Features found;
    for (const auto* link = static_cast<const VkBaseInStructure*>(chain); link != nullptr; link = link->pNext) {
        switch (link->sType) {
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES:
            for (const Feature12& feature : required12) {
                found.v12.*feature.member |= as<VkPhysicalDeviceVulkan12Features>(link).*feature.member;
            }
            break;
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES:
            for (const Feature13& feature : required13) {
                found.v13.*feature.member |= as<VkPhysicalDeviceVulkan13Features>(link).*feature.member;
            }
            break;
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SCALAR_BLOCK_LAYOUT_FEATURES:
            found.v12.scalarBlockLayout |= as<VkPhysicalDeviceScalarBlockLayoutFeatures>(link).scalarBlockLayout;
            break;
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_SYNCHRONIZATION_2_FEATURES:
            found.v13.synchronization2 |= as<VkPhysicalDeviceSynchronization2Features>(link).synchronization2;
            break;
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_DYNAMIC_RENDERING_FEATURES:
            found.v13.dynamicRendering |= as<VkPhysicalDeviceDynamicRenderingFeatures>(link).dynamicRendering;
            break;
        case VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MAINTENANCE_4_FEATURES:
            found.v13.maintenance4 |= as<VkPhysicalDeviceMaintenance4Features>(link).maintenance4;
            break;
        default:
            break;
        }
    }
    return found;
}

std::vector<VkExtensionProperties> supported_extensions(const InstanceFunctions& vk, VkPhysicalDevice device)
{
    std::uint32_t count = 0;
    check(vk.vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr), "listing the device extensions");
    std::vector<VkExtensionProperties> extensions(count);
    check(vk.vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data()),
          "listing the device extensions");
    return extensions;
}

} // namespace

std::span<const char* const> required_device_extensions()
{
    return device_extensions;
}

void enable_required_features(VkPhysicalDeviceVulkan12Features& features12,
                              VkPhysicalDeviceVulkan13Features& features13)
{
    for (const Feature12& feature : required12) {
        features12.*feature.member = VK_TRUE;
    }
    for (const Feature13& feature : required13) {
        features13.*feature.member = VK_TRUE;
    }
}

std::vector<std::string> missing_support(const InstanceFunctions& vk, VkPhysicalDevice device)
{
    std::vector<std::string> missing;
    VkPhysicalDeviceProperties properties{};
    vk.vkGetPhysicalDeviceProperties(device, &properties);
    if (properties.apiVersion < required_api_version) {
        missing.push_back(fmt::format("Vulkan {}.{} (it has {}.{})", VK_API_VERSION_MAJOR(required_api_version),
                                      VK_API_VERSION_MINOR(required_api_version),
                                      VK_API_VERSION_MAJOR(properties.apiVersion),
                                      VK_API_VERSION_MINOR(properties.apiVersion)));
        return missing; // such a device does not know the structs below
    }
    Features supported;
    supported.v12.pNext = &supported.v13;
    VkPhysicalDeviceFeatures2 features{VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, &supported.v12};
    vk.vkGetPhysicalDeviceFeatures2(device, &features);
    add_missing_features(supported, missing);

    const std::vector<VkExtensionProperties> extensions = supported_extensions(vk, device);
    for (const char* name : device_extensions) {
        const bool found = std::any_of(extensions.begin(), extensions.end(), [&](const VkExtensionProperties& has) {
            return std::string_view(static_cast<const char*>(has.extensionName)) == name;
        });
        if (!found) {
            missing.emplace_back(name);
        }
    }
    return missing;
}

std::vector<std::string> missing_enabled(const VkDeviceCreateInfo& created_with)
{
    std::vector<std::string> missing;
    add_missing_features(features_in(created_with.pNext), missing);
    const std::span enabled(created_with.ppEnabledExtensionNames, created_with.enabledExtensionCount);
    for (const std::string_view name : device_extensions) {
        if (std::find(enabled.begin(), enabled.end(), name) == enabled.end()) {
            missing.emplace_back(name);
        }
    }
    return missing;
}

} // namespace meltpoint::gpu
