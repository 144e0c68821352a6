#include "gpu/vulkan.h"

#include "core/error.h"

namespace meltpoint::gpu {

namespace {

std::string_view describe(VkResult result)
{
    switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
        return "out of host memory";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
        return "out of device memory";
    case VK_ERROR_DEVICE_LOST:
        return "the device was lost (it crashed, was reset or was removed)";
    case VK_ERROR_INITIALIZATION_FAILED:
        return "the driver failed to initialize";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
        return "no Vulkan driver was found (mesa-vulkan-drivers brings a software device)";
    case VK_ERROR_LAYER_NOT_PRESENT:
        return "a requested layer is not installed";
    case VK_ERROR_EXTENSION_NOT_PRESENT:
        return "a requested extension is not supported";
    case VK_ERROR_FEATURE_NOT_PRESENT:
        return "a requested feature is not supported";
    case VK_ERROR_TOO_MANY_OBJECTS:
        return "too many objects of this kind exist";
    default:
        return "unexpected result";
    }
}

} // namespace

void check(VkResult result, std::string_view what)
{
    if (result != VK_SUCCESS) {
        throw device_error("{} failed: {} (VkResult {})", what, describe(result), static_cast<int>(result));
    }
}

} // namespace meltpoint::gpu
