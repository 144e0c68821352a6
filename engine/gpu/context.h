#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "gpu/device_info.h"
#include "gpu/functions.h"
#include "gpu/instance.h"

namespace meltpoint::gpu {

/// Which device a Context of its own takes.
struct ContextOptions {
    std::string device;      ///< index or part of a name; empty: the best usable one
    bool validation = false; ///< Khronos validation with synchronization validation
};

/// Handles of a host program that wants the engine to work in its own device (gpu/device_requirements.h says what that
/// has to be created with). The host keeps owning them: it destroys them, after the Context and all that was made from
/// it. Everything but queue_mutex and get_instance_proc_addr must be given.
struct HostDevice {
    /// Of the loader that the host uses; null: the system's libvulkan.so.1.
    PFN_vkGetInstanceProcAddr get_instance_proc_addr = nullptr;
    VkInstance instance = VK_NULL_HANDLE;
    std::uint32_t api_version = 0; ///< VkApplicationInfo::apiVersion of the instance
    VkPhysicalDevice physical = VK_NULL_HANDLE;
    VkDevice device = VK_NULL_HANDLE;
    /// What the device was created with, as Vulkan does not tell what a device has enabled. Read by the constructor of
    /// Context only.
    const VkDeviceCreateInfo* created_with = nullptr;
    VkQueue queue = VK_NULL_HANDLE; ///< graphics and compute
    std::uint32_t queue_family = 0;
    /// Locked around every submission to the queue, for a host whose other threads submit to it too, under this mutex.
    /// Null: the host keeps these threads from the queue while one of them is inside a call of the engine.
    std::mutex* queue_mutex = nullptr;
};

/// A logical device with one queue: what everything on the GPU hangs on. Device functions are called through vk(), the
/// device's own table, so that several contexts and a host program can live side by side.
///
/// In a host's device, every submission of the engine waits for all that was submitted to the queue before, and all
/// that is submitted to it afterwards waits for the engine and sees what it wrote: on this queue, the host needs no
/// barriers, semaphores or fences of its own around the engine's buffers. They belong to the one queue family
/// (VK_SHARING_MODE_EXCLUSIVE): a host that reads them on a queue of another family hands them over there and back.
class Context {
public:
    /// Creates an instance and a device. Throws as Instance and choose_device do.
    explicit Context(const ContextOptions& options = {});
    /// Adopts a host program's device; the host keeps ownership. Throws Device, in one sentence that names all that is
    /// missing, when a handle is null, the device lacks or has not enabled something of the baseline, or the queue's
    /// family is not one that the device was created with or has no graphics and compute.
    explicit Context(const HostDevice& host);
    ~Context();
    Context(const Context&) = delete;
    Context& operator=(const Context&) = delete;

    /// The device's functions: include <volk.h> to call them.
    [[nodiscard]] const VolkDeviceTable& vk() const { return *device_functions_; }

    /// The logical device.
    [[nodiscard]] VkDevice device() const { return device_; }
    /// The one queue: graphics, compute and transfer.
    [[nodiscard]] VkQueue queue() const { return queue_; }
    /// The engine's own or the host's.
    [[nodiscard]] VkInstance instance() const { return instance_functions_.instance; }
    /// The functions of the instance.
    [[nodiscard]] const InstanceFunctions& instance_functions() const { return instance_functions_; }
    /// The physical device; queue_family and timestamp_bits are those of queue().
    [[nodiscard]] const DeviceInfo& info() const { return info_; }
    /// The physical device's.
    [[nodiscard]] const VkPhysicalDeviceLimits& limits() const { return info_.limits; }

    /// Whether the device is a host program's.
    [[nodiscard]] bool adopted() const { return instance_ == nullptr; }
    /// Hands work to the queue, under the host's mutex where it gave one.
    VkResult submit(const VkSubmitInfo2& work, VkFence fence) const;

    /// Warnings and errors of the validation layers so far; empty without validation.
    [[nodiscard]] std::vector<std::string> validation_messages() const;
    /// Forgets them.
    void clear_validation_messages();
    /// Whether the engine's own instance runs under validation; never so for a host's.
    [[nodiscard]] bool validated() const { return instance_ && instance_->validated(); }

    /// Index of a memory type among type_bits with the required properties, preferring those that also have
    /// `preferred`.
    [[nodiscard]] std::uint32_t memory_type(std::uint32_t type_bits, VkMemoryPropertyFlags required,
                                            VkMemoryPropertyFlags preferred) const;

    /// Gives a handle the name that validation messages and GPU debuggers show. Nothing without debug utils.
    void set_name(VkObjectType type, std::uint64_t handle, const std::string& name) const;

private:
    std::unique_ptr<Instance> instance_; ///< null when adopted
    InstanceFunctions instance_functions_;
    DeviceInfo info_;
    VkDevice device_ = VK_NULL_HANDLE;
    std::unique_ptr<const VolkDeviceTable> device_functions_;
    VkQueue queue_ = VK_NULL_HANDLE;
    std::mutex* queue_mutex_ = nullptr; ///< of the host, or null
    VkPhysicalDeviceMemoryProperties memory_{};
};

} // namespace meltpoint::gpu
