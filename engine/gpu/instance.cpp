#include "gpu/instance.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "core/error.h"

namespace meltpoint::gpu {

namespace {

constexpr const char* validation_layer = "VK_LAYER_KHRONOS_validation";

VKAPI_ATTR VkBool32 VKAPI_CALL on_validation_message(VkDebugUtilsMessageSeverityFlagBitsEXT /*severity*/,
                                                     VkDebugUtilsMessageTypeFlagsEXT /*types*/,
                                                     const VkDebugUtilsMessengerCallbackDataEXT* data, void* log)
{
    static_cast<ValidationLog*>(log)->add(data->pMessage != nullptr ? data->pMessage : "(no text)");
    return VK_FALSE;
}

bool debug_utils_supported()
{
    std::uint32_t count = 0;
    check(vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr), "listing the instance extensions");
    std::vector<VkExtensionProperties> extensions(count);
    check(vkEnumerateInstanceExtensionProperties(nullptr, &count, extensions.data()),
          "listing the instance extensions");
    return std::any_of(extensions.begin(), extensions.end(), [](const VkExtensionProperties& extension) {
        return std::strcmp(static_cast<const char*>(extension.extensionName), VK_EXT_DEBUG_UTILS_EXTENSION_NAME) == 0;
    });
}

void load_loader()
{
    // volk keeps the loader open for the life of the process; asking twice is harmless.
    if (volkInitialize() != VK_SUCCESS) {
        throw device_error("no Vulkan loader was found (libvulkan.so.1; Debian package libvulkan1)");
    }
}

} // namespace

void ValidationLog::add(std::string message)
{
    const std::scoped_lock lock(mutex_);
    messages_.push_back(std::move(message));
}

std::vector<std::string> ValidationLog::messages() const
{
    const std::scoped_lock lock(mutex_);
    return messages_;
}

void ValidationLog::clear()
{
    const std::scoped_lock lock(mutex_);
    messages_.clear();
}

bool Instance::validation_layer_installed()
{
    load_loader();
    std::uint32_t count = 0;
    check(vkEnumerateInstanceLayerProperties(&count, nullptr), "listing the instance layers");
    std::vector<VkLayerProperties> layers(count);
    check(vkEnumerateInstanceLayerProperties(&count, layers.data()), "listing the instance layers");
    return std::any_of(layers.begin(), layers.end(), [](const VkLayerProperties& layer) {
        return std::strcmp(static_cast<const char*>(layer.layerName), validation_layer) == 0;
    });
}

Instance::Instance(bool validation)
{
    load_loader();
    if (validation && !validation_layer_installed()) {
        throw device_error("validation was asked for, but {} is not installed (Debian package vulkan-validationlayers)",
                           validation_layer);
    }
    const bool debug_utils = debug_utils_supported();
    if (validation && !debug_utils) {
        throw device_error("validation was asked for, but {} is not supported", VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
    }

    VkDebugUtilsMessengerCreateInfoEXT messenger{VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT};
    messenger.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_GENERAL_BIT_EXT |
                            VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT |
                            VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    messenger.pfnUserCallback = on_validation_message;
    messenger.pUserData = log_.get();

    constexpr std::array enabled{VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
    VkValidationFeaturesEXT features{VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT, &messenger};
    features.enabledValidationFeatureCount = static_cast<std::uint32_t>(enabled.size());
    features.pEnabledValidationFeatures = enabled.data();

    VkApplicationInfo application{VK_STRUCTURE_TYPE_APPLICATION_INFO};
    application.pApplicationName = "meltpoint";
    application.pEngineName = "meltpoint";
    application.apiVersion = VK_API_VERSION_1_3;

    const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pNext = validation ? &features : nullptr;
    info.pApplicationInfo = &application;
    info.enabledLayerCount = validation ? 1 : 0;
    info.ppEnabledLayerNames = &validation_layer;
    info.enabledExtensionCount = debug_utils ? 1 : 0;
    info.ppEnabledExtensionNames = &extension;
    check(vkCreateInstance(&info, nullptr, &instance_), "creating a Vulkan instance");
    volkLoadInstanceOnly(instance_);

    if (validation) {
        check(vkCreateDebugUtilsMessengerEXT(instance_, &messenger, nullptr, &messenger_),
              "creating the validation messenger");
    }
}

Instance::~Instance()
{
    if (messenger_ != VK_NULL_HANDLE) {
        vkDestroyDebugUtilsMessengerEXT(instance_, messenger_, nullptr);
    }
    vkDestroyInstance(instance_, nullptr);
}

} // namespace meltpoint::gpu
