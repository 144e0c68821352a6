#pragma once

#include "gpu/vulkan.h"

namespace meltpoint::gpu {

/// Vulkan's functions, loaded by name. The library defines no vk symbol and keeps no function pointer in a global
/// variable: a host program may link the Vulkan loader, use volk, or bring a loader of its own beside it.

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

#define MELTPOINT_DEVICE_FUNCTIONS(F)                                                                                  \
    F(vkAllocateCommandBuffers)                                                                                        \
    F(vkAllocateMemory)                                                                                                \
    F(vkBeginCommandBuffer)                                                                                            \
    F(vkBindBufferMemory)                                                                                              \
    F(vkBindImageMemory)                                                                                               \
    F(vkCmdBeginRendering)                                                                                             \
    F(vkCmdBindPipeline)                                                                                               \
    F(vkCmdCopyBuffer)                                                                                                 \
    F(vkCmdCopyImageToBuffer)                                                                                          \
    F(vkCmdDispatch)                                                                                                   \
    F(vkCmdDispatchIndirect)                                                                                           \
    F(vkCmdDraw)                                                                                                       \
    F(vkCmdEndRendering)                                                                                               \
    F(vkCmdFillBuffer)                                                                                                 \
    F(vkCmdPipelineBarrier2)                                                                                           \
    F(vkCmdPushConstants)                                                                                              \
    F(vkCmdPushDescriptorSetKHR)                                                                                       \
    F(vkCmdResetQueryPool)                                                                                             \
    F(vkCmdSetScissor)                                                                                                 \
    F(vkCmdSetViewport)                                                                                                \
    F(vkCmdUpdateBuffer)                                                                                               \
    F(vkCmdWriteTimestamp2)                                                                                            \
    F(vkCreateBuffer)                                                                                                  \
    F(vkCreateBufferView)                                                                                              \
    F(vkCreateCommandPool)                                                                                             \
    F(vkCreateComputePipelines)                                                                                        \
    F(vkCreateDescriptorSetLayout)                                                                                     \
    F(vkCreateFence)                                                                                                   \
    F(vkCreateGraphicsPipelines)                                                                                       \
    F(vkCreateImage)                                                                                                   \
    F(vkCreateImageView)                                                                                               \
    F(vkCreatePipelineLayout)                                                                                          \
    F(vkCreateQueryPool)                                                                                               \
    F(vkCreateSampler)                                                                                                 \
    F(vkCreateShaderModule)                                                                                            \
    F(vkDestroyBuffer)                                                                                                 \
    F(vkDestroyBufferView)                                                                                             \
    F(vkDestroyCommandPool)                                                                                            \
    F(vkDestroyDescriptorSetLayout)                                                                                    \
    F(vkDestroyDevice)                                                                                                 \
    F(vkDestroyFence)                                                                                                  \
    F(vkDestroyImage)                                                                                                  \
    F(vkDestroyImageView)                                                                                              \
    F(vkDestroyPipeline)                                                                                               \
    F(vkDestroyPipelineLayout)                                                                                         \
    F(vkDestroyQueryPool)                                                                                              \
    F(vkDestroySampler)                                                                                                \
    F(vkDestroyShaderModule)                                                                                           \
    F(vkEndCommandBuffer)                                                                                              \
    F(vkFreeMemory)                                                                                                    \
    F(vkGetBufferMemoryRequirements)                                                                                   \
    F(vkGetDeviceQueue)                                                                                                \
    F(vkGetImageMemoryRequirements)                                                                                    \
    F(vkGetQueryPoolResults)                                                                                           \
    F(vkMapMemory)                                                                                                     \
    F(vkQueueSubmit2)                                                                                                  \
    F(vkResetCommandPool)                                                                                              \
    F(vkResetFences)                                                                                                   \
    F(vkWaitForFences)

#define MELTPOINT_DECLARE_FUNCTION(name) PFN_##name name = nullptr;

/// What is there before any instance.
struct LoaderFunctions {
    PFN_vkGetInstanceProcAddr vkGetInstanceProcAddr = nullptr; // NOLINT(readability-identifier-naming): Vulkan's name
    MELTPOINT_LOADER_FUNCTIONS(MELTPOINT_DECLARE_FUNCTION)
};

/// The functions of one instance. Those of VK_EXT_debug_utils are null where the instance was created without it.
struct InstanceFunctions {
    VkInstance instance = VK_NULL_HANDLE;
    MELTPOINT_INSTANCE_FUNCTIONS(MELTPOINT_DECLARE_FUNCTION)
    MELTPOINT_DEBUG_FUNCTIONS(MELTPOINT_DECLARE_FUNCTION)
};

/// The functions of one device: calls go straight to its driver. A pass that needs one more adds it to the list above.
struct DeviceFunctions {
    MELTPOINT_DEVICE_FUNCTIONS(MELTPOINT_DECLARE_FUNCTION)
};

#undef MELTPOINT_DECLARE_FUNCTION

/// The entry point of the system's Vulkan loader, which stays open for the life of the process. Throws Device when
/// there is none.
[[nodiscard]] PFN_vkGetInstanceProcAddr system_loader();

/// Each throws a Device error that names the first function which is not there.
[[nodiscard]] LoaderFunctions load_loader_functions(PFN_vkGetInstanceProcAddr get_instance_proc_addr);
[[nodiscard]] InstanceFunctions load_instance_functions(PFN_vkGetInstanceProcAddr get_instance_proc_addr,
                                                        VkInstance instance);
[[nodiscard]] DeviceFunctions load_device_functions(const InstanceFunctions& vk, VkDevice device);

} // namespace meltpoint::gpu
