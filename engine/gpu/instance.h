#pragma once

#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "gpu/vulkan.h"

namespace meltpoint::gpu {

/// Warnings and errors of the validation layers, in order of arrival. Thread safe.
class ValidationLog {
public:
    void add(std::string message);
    [[nodiscard]] std::vector<std::string> messages() const;
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

    [[nodiscard]] VkInstance handle() const { return instance_; }
    [[nodiscard]] bool validated() const { return messenger_ != VK_NULL_HANDLE; }
    [[nodiscard]] ValidationLog& validation_log() const { return *log_; }

    [[nodiscard]] static bool validation_layer_installed();

private:
    VkInstance instance_ = VK_NULL_HANDLE;
    VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
    std::unique_ptr<ValidationLog> log_ = std::make_unique<ValidationLog>();
};

} // namespace meltpoint::gpu
