#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "gpu/functions.h"

namespace meltpoint::gpu {

/// Warnings and errors of the validation layers, in order of arrival. Thread safe.
class ValidationLog {
public:
    /// Appends one.
    void add(std::string message);
    /// All so far.
    [[nodiscard]] std::vector<std::string> messages() const;
    /// Forgets them.
    void clear();

private:
    mutable std::mutex mutex_;
    std::vector<std::string> messages_;
};

/// A Vulkan instance, with the Khronos validation layer and its synchronization validation on request.
class Instance {
public:
    /// Throws a Device error when there is no Vulkan loader or driver, or when validation is asked for and the layer is
    /// not installed.
    explicit Instance(bool validation);
    ~Instance();
    Instance(const Instance&) = delete;
    Instance& operator=(const Instance&) = delete;

    /// Owned by this object.
    [[nodiscard]] VkInstance handle() const { return vk_.instance; }
    /// The functions of the instance.
    [[nodiscard]] const InstanceFunctions& functions() const { return vk_; }
    /// Whether the validation layer is on.
    [[nodiscard]] bool validated() const { return messenger_ != VK_NULL_HANDLE; }
    /// What the validation layer has said.
    [[nodiscard]] ValidationLog& validation_log() const { return *log_; }

    /// Throws as the constructor where there is no loader.
    [[nodiscard]] static bool validation_layer_installed();
    /// The highest version of Vulkan that the loader knows, as VK_MAKE_API_VERSION.
    [[nodiscard]] static std::uint32_t loader_version();

private:
    InstanceFunctions vk_;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    std::unique_ptr<ValidationLog> log_ = std::make_unique<ValidationLog>();
};

} // namespace meltpoint::gpu
