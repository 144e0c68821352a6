#include "gpu/commands.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/format.h>
#include <volk.h>

#include "core/error.h"

namespace meltpoint::gpu {

namespace {

constexpr std::uint32_t no_scope = ~0u;
constexpr std::size_t max_bindings = 16;

bool allows(ShaderAccess shader, Access declared)
{
    switch (shader) {
    case ShaderAccess::Read:
        return declared == Access::Read;
    case ShaderAccess::Write:
        return declared == Access::Write;
    case ShaderAccess::ReadWrite:
        return declared != Access::Read;
    }
    return false;
}

} // namespace

VkAccessFlags2 read_access(VkDescriptorType type)
{
    switch (type) {
    case VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER:
        return VK_ACCESS_2_UNIFORM_READ_BIT;
    case VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER:
        return VK_ACCESS_2_SHADER_SAMPLED_READ_BIT;
    default:
        return VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
    }
}

std::array<std::uint32_t, 3> workgroups(const Context& context, const Kernel& kernel, std::uint32_t invocations)
{
    const std::uint32_t size = kernel.shader().workgroup_size;
    const std::uint32_t groups = (invocations + size - 1) / size;
    const std::uint32_t widest = context.limits().maxComputeWorkGroupCount[0];
    if (groups <= widest) {
        return {groups, 1, 1};
    }
    // Shaders flatten them again (include/invocation.glsl).
    const std::uint32_t rows = (groups + widest - 1) / widest;
    return {(groups + rows - 1) / rows, rows, 1};
}

Commands::Commands(const Context& context, std::uint32_t max_scopes)
    : context_(&context), max_scopes_(context.info().timestamp_bits > 0 ? max_scopes : 0)
{
    const VolkDeviceTable& vk = context.vk();
    VkCommandPoolCreateInfo pool{VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO};
    pool.queueFamilyIndex = context.info().queue_family;
    check(vk.vkCreateCommandPool(context.device(), &pool, nullptr, &pool_), "creating a command pool");
    VkCommandBufferAllocateInfo allocation{VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO};
    allocation.commandPool = pool_;
    allocation.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
    allocation.commandBufferCount = 1;
    check(vk.vkAllocateCommandBuffers(context.device(), &allocation, &buffer_), "allocating a command buffer");
    const VkFenceCreateInfo fence{VK_STRUCTURE_TYPE_FENCE_CREATE_INFO};
    check(vk.vkCreateFence(context.device(), &fence, nullptr, &fence_), "creating a fence");
    if (max_scopes_ > 0) {
        VkQueryPoolCreateInfo queries{VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO};
        queries.queryType = VK_QUERY_TYPE_TIMESTAMP;
        queries.queryCount = 2 * max_scopes_;
        check(vk.vkCreateQueryPool(context.device(), &queries, nullptr, &queries_), "creating a query pool");
    }
}

Commands::~Commands()
{
    const VolkDeviceTable& vk = context_->vk();
    if (submitted_) {
        vk.vkWaitForFences(context_->device(), 1, &fence_, VK_TRUE, UINT64_MAX); // a lost device returns at once
    }
    vk.vkDestroyQueryPool(context_->device(), queries_, nullptr);
    vk.vkDestroyFence(context_->device(), fence_, nullptr);
    vk.vkDestroyCommandPool(context_->device(), pool_, nullptr);
}

void Commands::begin()
{
    const VolkDeviceTable& vk = context_->vk();
    check(vk.vkResetCommandPool(context_->device(), pool_, 0), "resetting a command pool");
    VkCommandBufferBeginInfo info{VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO};
    info.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
    check(vk.vkBeginCommandBuffer(buffer_, &info), "beginning a command buffer");
    scopes_.clear();
    if (context_->adopted()) {
        order_with_host();
    }
    if (max_scopes_ > 0) {
        vk.vkCmdResetQueryPool(buffer_, queries_, 0, 2 * max_scopes_);
    }
}

void Commands::submit()
{
    const VolkDeviceTable& vk = context_->vk();
    if (host_reads_) {
        pending_.srcStageMask |= VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
        pending_.srcAccessMask |= VK_ACCESS_2_MEMORY_WRITE_BIT;
        pending_.dstStageMask |= VK_PIPELINE_STAGE_2_HOST_BIT;
        pending_.dstAccessMask |= VK_ACCESS_2_HOST_READ_BIT;
        host_reads_ = false;
    }
    flush_barriers();
    if (context_->adopted()) {
        order_with_host();
    }
    check(vk.vkEndCommandBuffer(buffer_), "ending a command buffer");

    VkCommandBufferSubmitInfo command{VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO};
    command.commandBuffer = buffer_;
    VkSubmitInfo2 info{VK_STRUCTURE_TYPE_SUBMIT_INFO_2};
    info.commandBufferInfoCount = 1;
    info.pCommandBufferInfos = &command;
    check(context_->submit(info, fence_), "submitting work to the device");
    submitted_ = true;
}

void Commands::wait()
{
    const VolkDeviceTable& vk = context_->vk();
    check(vk.vkWaitForFences(context_->device(), 1, &fence_, VK_TRUE, UINT64_MAX), "waiting for the device");
    check(vk.vkResetFences(context_->device(), 1, &fence_), "resetting a fence");
    submitted_ = false;
}

void Commands::order_with_host()
{
    VkMemoryBarrier2 all{VK_STRUCTURE_TYPE_MEMORY_BARRIER_2};
    all.srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    all.srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT;
    all.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
    all.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
    VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
    info.memoryBarrierCount = 1;
    info.pMemoryBarriers = &all;
    context_->vk().vkCmdPipelineBarrier2(buffer_, &info);
}

void Commands::use(const Buffer& buffer, VkPipelineStageFlags2 stages, VkAccessFlags2 access, bool writes)
{
    AccessState& state = buffer.access_state();
    const bool written = state.write_stages != 0;
    const bool visible = (state.visible_stages & stages) == stages && (state.visible_access & access) == access;
    if (writes ? written || state.read_stages != 0 : written && !visible) {
        pending_.srcStageMask |= state.write_stages | (writes ? state.read_stages : 0);
        pending_.srcAccessMask |= state.write_access;
        pending_.dstStageMask |= stages;
        pending_.dstAccessMask |= access;
    }
    if (writes) {
        state = {stages, access & (VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT)};
        host_reads_ = host_reads_ || buffer.use() == MemoryUse::Readback;
    } else {
        state.read_stages |= stages;
        state.visible_stages |= stages;
        state.visible_access |= access;
    }
}

void Commands::add_image_barrier(const VkImageMemoryBarrier2& barrier)
{
    pending_images_.push_back(barrier);
}

void Commands::flush_barriers()
{
    if (pending_.srcStageMask == 0 && pending_images_.empty()) {
        return;
    }
    if (!suppress_next_barrier_) {
        pending_.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2;
        VkDependencyInfo info{VK_STRUCTURE_TYPE_DEPENDENCY_INFO};
        info.memoryBarrierCount = pending_.srcStageMask != 0 ? 1 : 0;
        info.pMemoryBarriers = &pending_;
        info.imageMemoryBarrierCount = static_cast<std::uint32_t>(pending_images_.size());
        info.pImageMemoryBarriers = pending_images_.data();
        context_->vk().vkCmdPipelineBarrier2(buffer_, &info);
    }
    suppress_next_barrier_ = false;
    pending_ = {};
    pending_images_.clear();
}

void Commands::bind(const Kernel& kernel, std::span<const std::byte> push, std::span<const Binding> bindings)
{
    const ShaderInterface& shader = kernel.shader();
    if (bindings.size() != shader.bindings.size() || bindings.size() > max_bindings) {
        throw std::logic_error(fmt::format("kernel {} has {} bindings, but {} were given", kernel.name(),
                                           shader.bindings.size(), bindings.size()));
    }
    if (push.size() != shader.push_constant_bytes) {
        throw std::logic_error(fmt::format("kernel {} takes {} bytes of push constants, but {} were given",
                                           kernel.name(), shader.push_constant_bytes, push.size()));
    }

    std::array<VkDescriptorBufferInfo, max_bindings> buffers{};
    std::array<VkBufferView, max_bindings> views{};
    std::array<VkWriteDescriptorSet, max_bindings> writes{};
    std::array<VkAccessFlags2, max_bindings> write_access{};
    for (std::size_t i = 0; i < bindings.size(); ++i) {
        const Binding& binding = bindings[i];
        if (!allows(shader.bindings[i].access, binding.access)) {
            throw std::logic_error(
                fmt::format("kernel {}: the access declared for binding {} (buffer {}) is not the shader's",
                            kernel.name(), shader.bindings[i].binding, binding.buffer->name()));
        }
        const VkDescriptorType type = shader.bindings[i].type;
        const bool as_texels = type == VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER;
        if (as_texels && binding.buffer->texels() == VK_NULL_HANDLE) {
            throw std::logic_error(fmt::format("kernel {} reads buffer {} as texels, but it was made without a format",
                                               kernel.name(), binding.buffer->name()));
        }
        VkAccessFlags2 access = 0;
        access |= binding.access != Access::Write ? read_access(type) : 0;
        access |= binding.access != Access::Read ? VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT : 0;
        if (binding.access == Access::Read) {
            use(*binding.buffer, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, access, false);
        } else {
            write_access[i] = access;
        }

        buffers[i] = {binding.buffer->handle(), 0, VK_WHOLE_SIZE};
        writes[i] = {VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET};
        writes[i].dstBinding = shader.bindings[i].binding;
        writes[i].descriptorCount = 1;
        writes[i].descriptorType = type;
        writes[i].pBufferInfo = &buffers[i];
        views[i] = binding.buffer->texels();
        writes[i].pTexelBufferView = &views[i];
    }
    // Writes after reads: what the same dispatch has read of a buffer does not see what it writes there.
    for (std::size_t i = 0; i < bindings.size(); ++i) {
        if (bindings[i].access != Access::Read) {
            use(*bindings[i].buffer, VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, write_access[i], true);
        }
    }
    const VolkDeviceTable& vk = context_->vk();
    vk.vkCmdBindPipeline(buffer_, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.pipeline());
    vk.vkCmdPushDescriptorSetKHR(buffer_, VK_PIPELINE_BIND_POINT_COMPUTE, kernel.layout(), 0,
                                 static_cast<std::uint32_t>(bindings.size()), writes.data());
    if (!push.empty()) {
        vk.vkCmdPushConstants(buffer_, kernel.layout(), VK_SHADER_STAGE_COMPUTE_BIT, 0,
                              static_cast<std::uint32_t>(push.size()), push.data());
    }
}

void Commands::dispatch_bytes(const Kernel& kernel, std::uint32_t invocations, std::span<const std::byte> push,
                              std::span<const Binding> bindings)
{
    if (invocations == 0) {
        return;
    }
    bind(kernel, push, bindings);
    flush_barriers();
    const auto [x, y, z] = workgroups(*context_, kernel, invocations);
    context_->vk().vkCmdDispatch(buffer_, x, y, z);
}

void Commands::dispatch_indirect_bytes(const Kernel& kernel, const Buffer& arguments, VkDeviceSize offset,
                                       std::span<const std::byte> push, std::span<const Binding> bindings)
{
    use(arguments, VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT, VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT, false);
    bind(kernel, push, bindings);
    flush_barriers();
    context_->vk().vkCmdDispatchIndirect(buffer_, arguments.handle(), offset);
}

void Commands::fill(const Buffer& buffer, std::uint32_t word, VkDeviceSize bytes, VkDeviceSize offset)
{
    use(buffer, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, true);
    flush_barriers();
    context_->vk().vkCmdFillBuffer(buffer_, buffer.handle(), offset, bytes, word);
}

void Commands::copy(const Buffer& source, const Buffer& target, VkDeviceSize bytes, VkDeviceSize source_offset,
                    VkDeviceSize target_offset)
{
    if (bytes == 0) {
        return;
    }
    use(source, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_READ_BIT, false);
    use(target, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, true);
    flush_barriers();
    const VkBufferCopy region{source_offset, target_offset, bytes};
    context_->vk().vkCmdCopyBuffer(buffer_, source.handle(), target.handle(), 1, &region);
}

std::uint32_t Commands::begin_scope(const char* name)
{
    if (const auto begin_label = context_->instance_functions().vkCmdBeginDebugUtilsLabelEXT) {
        VkDebugUtilsLabelEXT label{VK_STRUCTURE_TYPE_DEBUG_UTILS_LABEL_EXT};
        label.pLabelName = name;
        begin_label(buffer_, &label);
    }
    if (scopes_.size() >= max_scopes_) {
        return no_scope;
    }
    const auto scope = static_cast<std::uint32_t>(scopes_.size());
    scopes_.emplace_back(name);
    context_->vk().vkCmdWriteTimestamp2(buffer_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, 2 * scope);
    return scope;
}

void Commands::end_scope(std::uint32_t scope)
{
    if (scope != no_scope) {
        context_->vk().vkCmdWriteTimestamp2(buffer_, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT, queries_, 2 * scope + 1);
    }
    if (const auto end_label = context_->instance_functions().vkCmdEndDebugUtilsLabelEXT) {
        end_label(buffer_);
    }
}

std::vector<Timing> Commands::timings() const
{
    if (scopes_.empty()) {
        return {};
    }
    std::vector<std::uint64_t> ticks(2 * scopes_.size());
    check(
        context_->vk().vkGetQueryPoolResults(context_->device(), queries_, 0, static_cast<std::uint32_t>(ticks.size()),
                                             ticks.size() * sizeof(std::uint64_t), ticks.data(), sizeof(std::uint64_t),
                                             VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
        "reading the timestamps");
    std::vector<Timing> timings;
    for (std::size_t i = 0; i < scopes_.size(); ++i) {
        auto timing = std::find_if(timings.begin(), timings.end(),
                                   [&](const Timing& candidate) { return candidate.name == scopes_[i]; });
        if (timing == timings.end()) {
            timing = timings.insert(timings.end(), {scopes_[i]});
        }
        const auto elapsed = static_cast<double>(ticks[2 * i + 1] - ticks[2 * i]);
        timing->milliseconds += elapsed * context_->limits().timestampPeriod * 1e-6;
        ++timing->count;
    }
    return timings;
}

} // namespace meltpoint::gpu
