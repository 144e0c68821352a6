#pragma once

#include <memory>

#include "gpu/vulkan.h"

struct VolkDeviceTable; // volk.h

namespace meltpoint::gpu {

/// Vulkan's functions: volk opens the loader and fills the table of a device; the few functions that come before a
/// device are kept here. The library defines no vk or volk symbol (engine/gpu/volk.c): a host program may link the
/// Vulkan loader, use volk, or bring a loader of its own beside it.

#define MELTPOINT_LOADER_FUNCTIONS(F)                                                                                  \
    F(vkCreateInstance)                                                                                                \
    F(vkEnumerateInstanceExtensionProperties)                                                                          \
    F(vkEnumerateInstanceLayerProperties)                                                                              \
    F(vkEnumerateInstanceVersion)

#define MELTPOINT_INSTANCE_FUNCTIONS(F)                                                                                \
    F(vkCreateDevice)                                                                                                  \
    F(vkDestroyInstance)                                                                                               \
    F(vkEnumerateDeviceExtensionProperties)                                                                            \
    F(vkEnumeratePhysicalDevices)                                                                                      \
    F(vkGetDeviceProcAddr)                                                                                             \
    F(vkGetPhysicalDeviceFeatures2)                                                                                    \
    F(vkGetPhysicalDeviceMemoryProperties)                                                                             \
    F(vkGetPhysicalDeviceProperties)                                                                                   \
    F(vkGetPhysicalDeviceProperties2)                                                                                  \
    F(vkGetPhysicalDeviceQueueFamilyProperties)

#define MELTPOINT_DEBUG_FUNCTIONS(F)                                                                                   \
    F(vkCmdBeginDebugUtilsLabelEXT)                                                                                    \
    F(vkCmdEndDebugUtilsLabelEXT)                                                                                      \
    F(vkCreateDebugUtilsMessengerEXT)                                                                                  \
    F(vkDestroyDebugUtilsMessengerEXT)                                                                                 \
    F(vkSetDebugUtilsObjectNameEXT)

#define MELTPOINT_DECLARE_FUNCTION(name) PFN_##name name = nullptr;

/// What is there before any instance.
struct LoaderFunctions {
    PFN_vkGetInstanceProcAddr vkGetInstanceProcAddr = nullptr; // NOLINT(readability-identifier-naming): Vulkan's name
    MELTPOINT_LOADER_FUNCTIONS(MELTPOINT_DECLARE_FUNCTION)
};

/// The functions of one instance. Those of VK_EXT_debug_utils are null where the instance was created without it.
struct InstanceFunctions {
    VkInstance instance = VK_NULL_HANDLE;
    PFN_vkGetInstanceProcAddr vkGetInstanceProcAddr = nullptr; // NOLINT(readability-identifier-naming): Vulkan's name
    MELTPOINT_INSTANCE_FUNCTIONS(MELTPOINT_DECLARE_FUNCTION)
    MELTPOINT_DEBUG_FUNCTIONS(MELTPOINT_DECLARE_FUNCTION)
};

#undef MELTPOINT_DECLARE_FUNCTION

/// The entry point of the system's Vulkan loader, which stays open for the life of the process. Throws Device when
/// there is none.
[[nodiscard]] PFN_vkGetInstanceProcAddr system_loader();

/// Each throws a Device error that names the first function which is not there.
[[nodiscard]] LoaderFunctions load_loader_functions(PFN_vkGetInstanceProcAddr get_instance_proc_addr);
[[nodiscard]] InstanceFunctions load_instance_functions(PFN_vkGetInstanceProcAddr get_instance_proc_addr,
                                                        VkInstance instance);

/// Calls go straight to the device's driver. Whoever makes one includes <volk.h>, which no public header does: it
/// cannot stand beside Vulkan's prototypes, which a host may use. Thread safe.
[[nodiscard]] std::unique_ptr<const VolkDeviceTable> load_device_functions(const InstanceFunctions& vk,
                                                                           VkDevice device);

} // namespace meltpoint::gpu
