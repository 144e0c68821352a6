#include "gpu/functions.h"

#include <mutex>

#include <volk.h>

#include "core/error.h"

// Of volk.c, as cmake/volk.cmake names them.
extern "C" {
// NOLINTBEGIN(readability-identifier-naming): volk's names behind a prefix
extern PFN_vkGetInstanceProcAddr meltpoint_vkGetInstanceProcAddr;
VkResult meltpoint_volkInitialize();
void meltpoint_volkInitializeCustom(PFN_vkGetInstanceProcAddr handler);
void meltpoint_volkLoadInstanceOnly(VkInstance instance);
void meltpoint_volkLoadDeviceTable(VolkDeviceTable* table, VkDevice device);
// NOLINTEND(readability-identifier-naming)
}

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

/// volk's own variables are the process's: each use sets what it needs anew.
std::mutex volk_mutex;

} // namespace

PFN_vkGetInstanceProcAddr system_loader()
{
    const std::scoped_lock lock(volk_mutex);
    if (meltpoint_volkInitialize() != VK_SUCCESS) { // opens the library once however often it is asked to
        throw device_error("no Vulkan loader was found (libvulkan.so.1; Debian package libvulkan1)");
    }
    return meltpoint_vkGetInstanceProcAddr;
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
    vk.vkGetInstanceProcAddr = get_instance_proc_addr;
#define LOAD(name) assign_required(vk.name, get_instance_proc_addr(instance, #name), #name);
    MELTPOINT_INSTANCE_FUNCTIONS(LOAD)
#undef LOAD
#define LOAD(name) assign(vk.name, get_instance_proc_addr(instance, #name));
    MELTPOINT_DEBUG_FUNCTIONS(LOAD)
#undef LOAD
    return vk;
}

std::unique_ptr<const VolkDeviceTable> load_device_functions(const InstanceFunctions& vk, VkDevice device)
{
    auto table = std::make_unique<VolkDeviceTable>();
    const std::scoped_lock lock(volk_mutex);
    meltpoint_volkInitializeCustom(vk.vkGetInstanceProcAddr);
    meltpoint_volkLoadInstanceOnly(vk.instance);
    meltpoint_volkLoadDeviceTable(table.get(), device);
    return table;
}

} // namespace meltpoint::gpu
