#include "gpu/functions.h"

#include <dlfcn.h>

#include "core/error.h"

namespace meltpoint::gpu {

namespace {

template <class Function>
void assign(Function& function, PFN_vkVoidFunction loaded)
{
    function = reinterpret_cast<Function>(loaded); // NOLINT: Vulkan hands out every function by this one type
}

template <class Function>
void assign_required(Function& function, PFN_vkVoidFunction loaded, const char* name)
{
    if (loaded == nullptr) {
        throw device_error("the Vulkan function {} is missing", name);
    }
    assign(function, loaded);
}

} // namespace

PFN_vkGetInstanceProcAddr system_loader()
{
    void* library = dlopen("libvulkan.so.1", RTLD_NOW | RTLD_LOCAL); // opened once however often it is asked for
    void* entry = library != nullptr ? dlsym(library, "vkGetInstanceProcAddr") : nullptr;
    if (entry == nullptr) {
        throw device_error("no Vulkan loader was found (libvulkan.so.1; Debian package libvulkan1)");
    }
    return reinterpret_cast<PFN_vkGetInstanceProcAddr>(entry); // NOLINT: as POSIX intends
}

LoaderFunctions load_loader_functions(PFN_vkGetInstanceProcAddr get_instance_proc_addr)
{
    LoaderFunctions vk;
    vk.vkGetInstanceProcAddr = get_instance_proc_addr;
#define LOAD(name) assign_required(vk.name, get_instance_proc_addr(nullptr, #name), #name);
    MELTPOINT_LOADER_FUNCTIONS(LOAD)
#undef LOAD
    return vk;
}

InstanceFunctions load_instance_functions(PFN_vkGetInstanceProcAddr get_instance_proc_addr, VkInstance instance)
{
    InstanceFunctions vk;
    vk.instance = instance;
#define LOAD(name) assign_required(vk.name, get_instance_proc_addr(instance, #name), #name);
    MELTPOINT_INSTANCE_FUNCTIONS(LOAD)
#undef LOAD
#define LOAD(name) assign(vk.name, get_instance_proc_addr(instance, #name));
    MELTPOINT_DEBUG_FUNCTIONS(LOAD)
#undef LOAD
    return vk;
}

DeviceFunctions load_device_functions(const InstanceFunctions& vk, VkDevice device)
{
    DeviceFunctions functions;
#define LOAD(name) assign_required(functions.name, vk.vkGetDeviceProcAddr(device, #name), #name);
    MELTPOINT_DEVICE_FUNCTIONS(LOAD)
#undef LOAD
    return functions;
}

} // namespace meltpoint::gpu
