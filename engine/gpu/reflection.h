#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gpu/vulkan.h"

namespace meltpoint::gpu {

/// What a shader may do with a binding, from its readonly and writeonly qualifiers.
enum class ShaderAccess { Read, Write, ReadWrite };

/// One binding of descriptor set 0.
struct ShaderBinding {
    std::uint32_t binding = 0;
    VkDescriptorType type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
    ShaderAccess access = ShaderAccess::ReadWrite;
};

/// The interface of one shader as its SPIR-V states it. Descriptor set 0 only.
struct ShaderInterface {
    std::vector<ShaderBinding> bindings; ///< by binding number
    std::uint32_t push_constant_bytes = 0;
    std::uint32_t workgroup_size = 1; ///< along x; compute shaders here are one-dimensional
};

/// Reads the interface from SPIR-V words. Throws std::logic_error when a shader uses what the engine does not (another
/// descriptor set, a gap in the binding numbers).
[[nodiscard]] ShaderInterface reflect(std::span<const std::uint32_t> spirv);

} // namespace meltpoint::gpu
