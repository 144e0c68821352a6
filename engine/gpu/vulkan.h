#pragma once

#include <string_view>

#include <vulkan/vulkan.h>

namespace meltpoint::gpu {

/// Throws a Device error naming the call and the result unless result is VK_SUCCESS.
void check(VkResult result, std::string_view what);

} // namespace meltpoint::gpu
