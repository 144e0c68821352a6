#include "gpu/reflection.h"

#include <algorithm>
#include <stdexcept>

#include <spirv_cross/spirv_cross.hpp>

namespace meltpoint::gpu {

namespace {

ShaderAccess buffer_access(const spirv_cross::Compiler& compiler, spirv_cross::ID buffer)
{
    const spirv_cross::Bitset flags = compiler.get_buffer_block_flags(buffer);
    if (flags.get(spv::DecorationNonWritable)) {
        return ShaderAccess::Read;
    }
    return flags.get(spv::DecorationNonReadable) ? ShaderAccess::Write : ShaderAccess::ReadWrite;
}

ShaderAccess image_access(const spirv_cross::Compiler& compiler, spirv_cross::ID image)
{
    if (compiler.has_decoration(image, spv::DecorationNonWritable)) {
        return ShaderAccess::Read;
    }
    return compiler.has_decoration(image, spv::DecorationNonReadable) ? ShaderAccess::Write : ShaderAccess::ReadWrite;
}

} // namespace

ShaderInterface reflect(std::span<const std::uint32_t> spirv)
{
    const spirv_cross::Compiler compiler(spirv.data(), spirv.size());
    const spirv_cross::ShaderResources resources = compiler.get_shader_resources();

    ShaderInterface shader;
    const auto add = [&](const spirv_cross::Resource& resource, VkDescriptorType type, ShaderAccess access) {
        if (compiler.get_decoration(resource.id, spv::DecorationDescriptorSet) != 0) {
            throw std::logic_error("a shader uses a descriptor set other than 0: " + resource.name);
        }
        shader.bindings.push_back({compiler.get_decoration(resource.id, spv::DecorationBinding), type, access});
    };
    for (const auto& resource : resources.storage_buffers) {
        add(resource, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, buffer_access(compiler, resource.id));
    }
    for (const auto& resource : resources.uniform_buffers) {
        add(resource, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, ShaderAccess::Read);
    }
    for (const auto& resource : resources.storage_images) {
        add(resource, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, image_access(compiler, resource.id));
    }
    for (const auto& resource : resources.sampled_images) {
        add(resource, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, ShaderAccess::Read);
    }
    for (const auto& resource : resources.separate_images) {
        if (compiler.get_type(resource.base_type_id).image.dim != spv::DimBuffer) {
            throw std::logic_error("a shader reads an image without a sampler: " + resource.name);
        }
        add(resource, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER, ShaderAccess::Read);
    }
    std::sort(shader.bindings.begin(), shader.bindings.end(),
              [](const ShaderBinding& a, const ShaderBinding& b) { return a.binding < b.binding; });

    for (const auto& resource : resources.push_constant_buffers) {
        shader.push_constant_bytes =
            static_cast<std::uint32_t>(compiler.get_declared_struct_size(compiler.get_type(resource.base_type_id)));
    }

    spirv_cross::SpecializationConstant x;
    spirv_cross::SpecializationConstant y;
    spirv_cross::SpecializationConstant z;
    const std::uint32_t size_id = compiler.get_work_group_size_specialization_constants(x, y, z);
    shader.workgroup_size = std::max(compiler.get_execution_mode_argument(spv::ExecutionModeLocalSize, 0), 1u);
    if (size_id != 0 && x.id != 0) {
        shader.workgroup_size = compiler.get_constant(x.id).scalar();
    }
    return shader;
}

} // namespace meltpoint::gpu
