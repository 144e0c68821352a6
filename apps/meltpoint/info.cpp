#include <memory>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "core/error.h"
#include "exit_codes.h"
#include "gpu/device_info.h"
#include "gpu/instance.h"
#include "scene/scene_file.h"
#include "sim/fluid_kernels.h"
#include "sim/simulation.h"

namespace meltpoint::program {

namespace {

struct InfoOptions {
    std::string device;
    bool json = false;
};

std::string version_text(std::uint32_t version)
{
    return fmt::format("{}.{}.{}", VK_API_VERSION_MAJOR(version), VK_API_VERSION_MINOR(version),
                       VK_API_VERSION_PATCH(version));
}

const char* type_text(VkPhysicalDeviceType type)
{
    switch (type) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return "discrete GPU";
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return "integrated GPU";
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return "virtual GPU";
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return "software";
    default:
        return "other";
    }
}

nlohmann::ordered_json describe(const gpu::DeviceInfo& device, bool chosen)
{
    return {{"index", device.index},
            {"name", device.name},
            {"type", type_text(device.type)},
            {"driver", device.driver},
            {"vulkan", version_text(device.api_version)},
            {"usable", device.usable()},
            {"missing", device.missing},
            {"chosen", chosen},
            {"memory_bytes", device.memory_bytes},
            {"storage_buffer_bytes", device.limits.maxStorageBufferRange},
            {"shared_memory_bytes", device.limits.maxComputeSharedMemorySize},
            {"push_constant_bytes", device.limits.maxPushConstantsSize},
            {"workgroups_x", device.limits.maxComputeWorkGroupCount[0]},
            {"subgroup_size", device.subgroup_size},
            {"timestamps", device.timestamp_bits > 0},
            {"tile", sim::default_tile(device)},
            {"particle_limit", sim::Simulation::particle_limit(device)}};
}

void print_device(const nlohmann::ordered_json& device)
{
    constexpr double mebibyte = 1024.0 * 1024.0;
    fmt::print("{} device {}: {} ({})\n", device["chosen"].get<bool>() ? "*" : " ", device["index"].get<int>(),
               device["name"].get<std::string>(), device["type"].get<std::string>());
    fmt::print("    driver              {}\n", device["driver"].get<std::string>());
    fmt::print("    Vulkan              {}\n", device["vulkan"].get<std::string>());
    fmt::print("    memory              {:.0f} MiB, {:.0f} MiB a storage buffer, {:.0f} KiB shared\n",
               device["memory_bytes"].get<double>() / mebibyte, device["storage_buffer_bytes"].get<double>() / mebibyte,
               device["shared_memory_bytes"].get<double>() / 1024.0);
    fmt::print("    limits              {} bytes of push constants, {} workgroups along x, subgroups of {}\n",
               device["push_constant_bytes"].get<std::uint32_t>(), device["workgroups_x"].get<std::uint32_t>(),
               device["subgroup_size"].get<std::uint32_t>());
    fmt::print("    timestamps          {}\n", device["timestamps"].get<bool>() ? "yes" : "no");
    fmt::print("    particles           at most {}, tiles of {}\n", device["particle_limit"].get<std::uint64_t>(),
               device["tile"].get<std::uint32_t>());
    const auto missing = device["missing"].get<std::vector<std::string>>();
    fmt::print("    lacks               {}\n",
               missing.empty() ? "nothing" : fmt::format("{}", fmt::join(missing, ", ")));
}

int info(const InfoOptions& options)
{
    const gpu::Instance instance(false);
    const std::vector<gpu::DeviceInfo> devices = gpu::list_devices(instance.functions());
    std::string refusal;
    std::uint32_t chosen = ~0u;
    try {
        chosen = gpu::choose_device(devices, options.device).index;
    } catch (const Error& error) {
        if (error.kind() == ErrorKind::Input) {
            throw;
        }
        refusal = error.what(); // the list below shows why, and the exit code says it
    }

    nlohmann::ordered_json document{{"meltpoint", MELTPOINT_VERSION},
                                    {"vulkan_loader", version_text(gpu::Instance::loader_version())},
                                    {"vulkan_headers", version_text(VK_HEADER_VERSION_COMPLETE)},
                                    {"validation_layer", gpu::Instance::validation_layer_installed()},
                                    {"builtin_scenes", builtin_scene_names()},
                                    {"devices", nlohmann::ordered_json::array()}};
    for (const gpu::DeviceInfo& device : devices) {
        document["devices"].push_back(describe(device, device.index == chosen));
    }
    if (options.json) {
        fmt::print("{}\n", document.dump(2));
    } else {
        fmt::print("meltpoint {}\nVulkan loader {}, headers {}; validation layer {}\nbuilt-in scenes: {}\n",
                   MELTPOINT_VERSION, document["vulkan_loader"].get<std::string>(),
                   document["vulkan_headers"].get<std::string>(),
                   document["validation_layer"].get<bool>() ? "installed" : "not installed",
                   fmt::join(builtin_scene_names(), ", "));
        for (const auto& device : document["devices"]) {
            print_device(device);
        }
    }
    if (!refusal.empty()) {
        throw device_error("{}", refusal);
    }
    return exit_done;
}

} // namespace

void add_info(CLI::App& app, const GlobalOptions& /*global*/, int& exit_code)
{
    auto options = std::make_shared<InfoOptions>();
    CLI::App* command = app.add_subcommand(
        "info", "Lists the Vulkan devices, their limits, what each lacks, and (*) which one would be chosen; versions");
    command->add_option("--device", options->device, "The wish to choose by, as in the other subcommands")
        ->type_name("NAME|INDEX");
    command->add_flag("--json", options->json, "Prints the result as JSON");
    command->callback([options, &exit_code] { exit_code = info(*options); });
}

} // namespace meltpoint::program
