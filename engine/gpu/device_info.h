#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gpu/functions.h"

namespace meltpoint::gpu {

/// One physical device as `meltpoint info` shows it and as the choice of a device needs it.
struct DeviceInfo {
    std::uint32_t index = 0;
    VkPhysicalDevice handle = VK_NULL_HANDLE;
    std::string name;
    std::string driver;            ///< name and version of the driver
    std::uint32_t api_version = 0; ///< as VK_MAKE_API_VERSION
    VkPhysicalDeviceType type = VK_PHYSICAL_DEVICE_TYPE_OTHER;
    VkPhysicalDeviceLimits limits{};
    std::uint32_t subgroup_size = 0;
    std::uint64_t memory_bytes = 0;   ///< of the largest device-local heap
    std::uint32_t queue_family = 0;   ///< the first family with graphics, compute and transfer
    std::uint32_t timestamp_bits = 0; ///< of that family; 0 when the queue has no timestamps
    std::vector<std::string> missing; ///< what of the baseline it lacks; empty for a usable device

    /// Lacks nothing of the baseline.
    [[nodiscard]] bool usable() const { return missing.empty(); }
    /// Runs shaders on the CPU (lavapipe): some passes choose another tile size there.
    [[nodiscard]] bool software() const { return type == VK_PHYSICAL_DEVICE_TYPE_CPU; }
};

/// All physical devices of an instance in the loader's order.
[[nodiscard]] std::vector<DeviceInfo> list_devices(const InstanceFunctions& vk);

/// The device that wish names: an index, or a part of the name whatever its case; an empty wish takes the best usable
/// one (discrete, integrated, virtual, software). Throws Input when nothing or more than one matches, Device when the
/// match lacks something of the baseline or no device is usable.
[[nodiscard]] DeviceInfo choose_device(const std::vector<DeviceInfo>& devices, const std::string& wish);

} // namespace meltpoint::gpu
