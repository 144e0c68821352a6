#include "gpu/draw_pass.h"

#include <stdexcept>

#include <fmt/format.h>
#include <volk.h>

namespace meltpoint::gpu {

namespace {

void check_interface(const Draw& draw)
{
    const ShaderInterface& shader = draw.pipeline->shader();
    if (draw.bindings.size() != shader.bindings.size()) {
        throw std::logic_error(fmt::format("pipeline {} has {} bindings, but {} were given", draw.pipeline->name(),
                                           shader.bindings.size(), draw.bindings.size()));
    }
    if (draw.push.size() != shader.push_constant_bytes) {
        throw std::logic_error(fmt::format("pipeline {} takes {} bytes of push constants, but {} were given",
                                           draw.pipeline->name(), shader.push_constant_bytes, draw.push.size()));
    }
    for (std::size_t i = 0; i < draw.bindings.size(); ++i) {
        const bool wants_image = shader.bindings[i].type == VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER;
        const bool lacks_texels = shader.bindings[i].type == VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER &&
                                  draw.bindings[i].buffer != nullptr &&
                                  draw.bindings[i].buffer->texels() == VK_NULL_HANDLE;
        if (wants_image != (draw.bindings[i].image != nullptr) || lacks_texels ||
            shader.bindings[i].access != ShaderAccess::Read) {
            throw std::logic_error(fmt::format("pipeline {}: binding {} is not what the shader reads",
                                               draw.pipeline->name(), shader.bindings[i].binding));
        }
    }
}

void declare_uses(Commands& commands, const Draw& draw)
{
    if (draw.arguments != nullptr) {
        commands.use(*draw.arguments, VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT,
                     false);
    }
    for (std::size_t i = 0; i < draw.bindings.size(); ++i) {
        const DrawBinding& binding = draw.bindings[i];
        if (binding.image != nullptr) {
            use_image(commands, *binding.image, ImageUse::Sampled);
        } else {
            commands.use(*binding.buffer,
                         VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT | VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT,
                         read_access(draw.pipeline->shader().bindings[i].type), false);
        }
    }
}

VkRenderingAttachmentInfo attachment(const Image& image, ImageUse use)
{
    VkRenderingAttachmentInfo info{VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO};
    info.imageView = image.view();
    info.imageLayout = layout_of(use);
    info.loadOp = VK_ATTACHMENT_LOAD_OP_CLEAR;
    info.storeOp = VK_ATTACHMENT_STORE_OP_STORE;
    return info;
}

void begin_rendering(Commands& commands, const Targets& targets)
{
    std::vector<VkRenderingAttachmentInfo> colors;
    VkRenderingAttachmentInfo depth{};
    VkRenderingInfo info{VK_STRUCTURE_TYPE_RENDERING_INFO};
    info.layerCount = 1;
    for (const ColorTarget& target : targets.colors) {
        colors.push_back(attachment(*target.image, ImageUse::ColorTarget));
        colors.back().clearValue.color = target.clear;
        info.renderArea.extent = target.image->extent();
    }
    if (targets.depth) {
        depth = attachment(*targets.depth->image, ImageUse::DepthTarget);
        depth.clearValue.depthStencil.depth = targets.depth->clear;
        info.pDepthAttachment = &depth;
        info.renderArea.extent = targets.depth->image->extent();
    }
    info.colorAttachmentCount = static_cast<std::uint32_t>(colors.size());
    info.pColorAttachments = colors.data();

    const VolkDeviceTable& vk = commands.context().vk();
    vk.vkCmdBeginRendering(commands.handle(), &info);
    const VkExtent2D extent = info.renderArea.extent;
    const VkViewport viewport{0.0f, 0.0f, static_cast<float>(extent.width), static_cast<float>(extent.height),
                              0.0f, 1.0f};
    vk.vkCmdSetViewport(commands.handle(), 0, 1, &viewport);
    vk.vkCmdSetScissor(commands.handle(), 0, 1, &info.renderArea);
}

void record_draw(Commands& commands, const Draw& draw)
{
    const ShaderInterface& shader = draw.pipeline->shader();
    std::vector<VkDescriptorBufferInfo> buffers(draw.bindings.size());
    std::vector<VkDescriptorImageInfo> images(draw.bindings.size());
    std::vector<VkBufferView> texels(draw.bindings.size());
    std::vector<VkWriteDescriptorSet> writes(draw.bindings.size());
    for (std::size_t i = 0; i < draw.bindings.size(); ++i) {
        writes[i] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
        writes[i].dstBinding = shader.bindings[i].binding;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = shader.bindings[i].type;
        if (const Image* image = draw.bindings[i].image) {
            images[i] = {draw.pipeline->sampler(), image->view(), layout_of(ImageUse::Sampled)};
            writes[i].pImageInfo = &images[i];
        } else {
            buffers[i] = {draw.bindings[i].buffer->handle(), 0, VK_WHOLE_SIZE};
            texels[i] = draw.bindings[i].buffer->texels();
            writes[i].pBufferInfo = &buffers[i];
            writes[i].pTexelBufferView = &texels[i];
        }
    }
    const VolkDeviceTable& vk = commands.context().vk();
    vk.vkCmdBindPipeline(commands.handle(), VK_PIPELINE_BIND_POINT_GRAPHICS, draw.pipeline->pipeline());
    vk.vkCmdPushDescriptorSetKHR(commands.handle(), VK_PIPELINE_BIND_POINT_GRAPHICS, draw.pipeline->layout(), 0,
                                 static_cast<std::uint32_t>(writes.size()), writes.data());
    if (!draw.push.empty()) {
        vk.vkCmdPushConstants(commands.handle(), draw.pipeline->layout(),
                              VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT, 0,
                              static_cast<std::uint32_t>(draw.push.size()), draw.push.data());
    }
    if (draw.arguments != nullptr) {
        vk.vkCmdDrawIndirect(commands.handle(), draw.arguments->handle(), 0, 1, 0);
    } else {
        vk.vkCmdDraw(commands.handle(), draw.vertices, 1, 0, 0);
    }
}

} // namespace

void record_draw_pass(Commands& commands, const Targets& targets, std::span<const Draw> draws)
{
    // Barriers are not allowed while rendering, so all uses are declared first.
    for (const Draw& draw : draws) {
        check_interface(draw);
        declare_uses(commands, draw);
    }
    for (const ColorTarget& target : targets.colors) {
        use_image(commands, *target.image, ImageUse::ColorTarget, true);
    }
    if (targets.depth) {
        use_image(commands, *targets.depth->image, ImageUse::DepthTarget, true);
    }
    commands.flush_barriers();

    begin_rendering(commands, targets);
    for (const Draw& draw : draws) {
        if (draw.vertices > 0 || draw.arguments != nullptr) {
            record_draw(commands, draw);
        }
    }
    commands.context().vk().vkCmdEndRendering(commands.handle());
}

} // namespace meltpoint::gpu
