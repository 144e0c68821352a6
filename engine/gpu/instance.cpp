#include "gpu/instance.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "core/error.h"
#include "gpu/device_requirements.h"

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

bool debug_utils_supported(const LoaderFunctions& vk)
{
    std::uint32_t count = 0;
    check(vk.vkEnumerateInstanceExtensionProperties(nullptr, &count, nullptr), "listing the instance extensions");
    std::vector<VkExtensionProperties> extensions(count);
    check(vk.vkEnumerateInstanceExtensionProperties(nullptr, &count, extensions.data()),
          "listing the instance extensions");
    return std::any_of(extensions.begin(), extensions.end(), [](const VkExtensionProperties& extension) {
        return std::strcmp(static_cast<const char*>(extension.extensionName), VK_EXT_DEBUG_UTILS_EXTENSION_NAME) == 0;
    });
}

bool layer_installed(const LoaderFunctions& vk)
{
    std::uint32_t count = 0;
    check(vk.vkEnumerateInstanceLayerProperties(&count, nullptr), "listing the instance layers");
    std::vector<VkLayerProperties> layers(count);
    check(vk.vkEnumerateInstanceLayerProperties(&count, layers.data()), "listing the instance layers");
    return std::any_of(layers.begin(), layers.end(), [](const VkLayerProperties& layer) {
        return std::strcmp(static_cast<const char*>(layer.layerName), validation_layer) == 0;
    });
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
    return layer_installed(load_loader_functions(system_loader()));
}

std::uint32_t Instance::loader_version()
{
    std::uint32_t version = 0;
    check(load_loader_functions(system_loader()).vkEnumerateInstanceVersion(&version),
          "asking for the version of Vulkan");
    return version;
}

Instance::Instance(bool validation)
{
    const LoaderFunctions loader = load_loader_functions(system_loader());
    if (validation && !layer_installed(loader)) {
        throw device_error("validation was asked for, but {} is not installed (Debian package vulkan-validationlayers)",
                           validation_layer);
    }
    const bool debug_utils = debug_utils_supported(loader);
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
    application.apiVersion = required_api_version;

    const char* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;
    VkInstanceCreateInfo info{VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO};
    info.pNext = validation ? &features : nullptr;
    info.pApplicationInfo = &application;
    info.enabledLayerCount = validation ? 1 : 0;
    info.ppEnabledLayerNames = &validation_layer;
    info.enabledExtensionCount = debug_utils ? 1 : 0;
    info.ppEnabledExtensionNames = &extension;
    VkInstance instance = VK_NULL_HANDLE;
    check(loader.vkCreateInstance(&info, nullptr, &instance), "creating a Vulkan instance");
    vk_ = load_instance_functions(loader.vkGetInstanceProcAddr, instance);

    if (validation) {
        check(vk_.vkCreateDebugUtilsMessengerEXT(instance, &messenger, nullptr, &messenger_),
              "creating the validation messenger");
    }
}

Instance::~Instance()
{
    if (messenger_ != VK_NULL_HANDLE) {
        vk_.vkDestroyDebugUtilsMessengerEXT(vk_.instance, messenger_, nullptr);
    }
    vk_.vkDestroyInstance(vk_.instance, nullptr);
}

} // namespace meltpoint::gpu
