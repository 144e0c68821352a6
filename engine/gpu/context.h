#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gpu/device_info.h"
#include "gpu/instance.h"
#include "gpu/vulkan.h"

namespace meltpoint::gpu {

struct ContextOptions {
    std::string device;      ///< index or part of a name; empty: the best usable one
    bool validation = false; ///< Khronos validation with synchronization validation
};

/// Handles of a host program that wants the engine to work in its own device. The device must have been created with
/// Vulkan 1.3, scalarBlockLayout, synchronization2, dynamicRendering, maintenance4 and VK_KHR_push_descriptor.
struct HostDevice {
    VkInstance instance = VK_NULL_HANDLE;
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    VkQueue queue = VK_NULL_HANDLE; ///< graphics and compute; used only inside calls of the engine
    std::uint32_t queue_family = 0;
};

/// A logical device with one queue: what everything on the GPU hangs on. Device functions are called through `vk`, the
/// device's own table, so that several contexts and a host program can live side by side.
class Context {
public:
    /// Creates an instance and a device. Throws as Instance and choose_device do.
    explicit Context(const ContextOptions& options);
    /// Adopts a host program's device; the host keeps ownership. Throws Device when the device lacks the baseline.
    explicit Context(const HostDevice& host);
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    VolkDeviceTable vk{};

    [[nodiscard]] VkDevice device() const { return device_; }
    [[nodiscard]] VkQueue queue() const { return queue_; }
    [[nodiscard]] VkInstance instance() const { return instance_ ? instance_->handle() : host_instance_; }
    [[nodiscard]] const DeviceInfo& info() const { return info_; }
    [[nodiscard]] const VkPhysicalDeviceLimits& limits() const { return info_.limits; }

    /// Warnings and errors of the validation layers so far; empty without validation.
    [[nodiscard]] std::vector<std::string> validation_messages() const;
    void clear_validation_messages();
    [[nodiscard]] bool validated() const { return instance_ && instance_->validated(); }

    /// Index of a memory type among type_bits with the required properties, preferring those that also have
    /// `preferred`.
    [[nodiscard]] std::uint32_t memory_type(std::uint32_t type_bits, VkMemoryPropertyFlags required,
                                            VkMemoryPropertyFlags preferred) const;

    /// Gives a handle the name that validation messages and GPU debuggers show. Nothing without debug utils.
    void set_name(VkObjectType type, std::uint64_t handle, const std::string& name) const;

private:
    std::unique_ptr<Instance> instance_; ///< null when adopted
    VkInstance host_instance_ = VK_NULL_HANDLE;
    DeviceInfo info_;
    VkDevice device_ = VK_NULL_HANDLE;
    VkQueue queue_ = VK_NULL_HANDLE;
    VkPhysicalDeviceMemoryProperties memory_{};
};

} // namespace meltpoint::gpu
