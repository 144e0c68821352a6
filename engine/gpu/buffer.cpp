#include "gpu/buffer.h"

#include <algorithm>
#include <utility>

#include <volk.h>

#include "core/error.h"

namespace meltpoint::gpu {

namespace {

constexpr double mebibyte = 1024.0 * 1024.0;

VkMemoryPropertyFlags required_properties(MemoryUse use)
{
    return use == MemoryUse::Device ? 0 : VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
}

VkMemoryPropertyFlags preferred_properties(MemoryUse use)
{
    switch (use) {
    case MemoryUse::Device:
        return VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT;
    case MemoryUse::Readback:
        return VK_MEMORY_PROPERTY_HOST_CACHED_BIT;
    case MemoryUse::Upload:
        break;
    }
    return 0;
}

} // namespace

Buffer::Buffer(const Context& context, VkDeviceSize bytes, MemoryUse use, const std::string& name, VkFormat texels)
    : context_(&context), size_(std::max<VkDeviceSize>(bytes, 16)), use_(use), name_(name)
{
    if (size_ > context.limits().maxStorageBufferRange) {
        throw device_error("buffer \"{}\" needs {:.0f} MiB, but {} binds at most {:.0f} MiB", name,
                           static_cast<double>(size_) / mebibyte, context.info().name,
                           context.limits().maxStorageBufferRange / mebibyte);
    }
    try {
        VkBufferCreateInfo info{VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO};
        info.size = size_;
        info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT |
                     VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
                     VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT |
                     VK_BUFFER_USAGE_VERTEX_BUFFER_BIT; // which is for hosts: the engine's own shaders pull vertices
        info.usage |= texels != VK_FORMAT_UNDEFINED ? VK_BUFFER_USAGE_UNIFORM_TEXEL_BUFFER_BIT : 0;
        check(context.vk().vkCreateBuffer(context.device(), &info, nullptr, &buffer_), "creating a buffer");
        context.set_name(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<std::uint64_t>(buffer_), name); // NOLINT

        VkMemoryRequirements needs{};
        context.vk().vkGetBufferMemoryRequirements(context.device(), buffer_, &needs);
        VkMemoryAllocateInfo allocation{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
        allocation.allocationSize = needs.size;
        allocation.memoryTypeIndex =
            context.memory_type(needs.memoryTypeBits, required_properties(use), preferred_properties(use));
        const VkResult result = context.vk().vkAllocateMemory(context.device(), &allocation, nullptr, &memory_);
        if (result != VK_SUCCESS) {
            throw device_error("{} has no {:.1f} MiB of memory left for the buffer \"{}\"", context.info().name,
                               static_cast<double>(needs.size) / mebibyte, name);
        }
        check(context.vk().vkBindBufferMemory(context.device(), buffer_, memory_, 0), "binding a buffer to its memory");
        if (texels != VK_FORMAT_UNDEFINED) {
            VkBufferViewCreateInfo view{VK_STRUCTURE_TYPE_BUFFER_VIEW_CREATE_INFO};
            view.buffer = buffer_;
            view.format = texels;
            view.range = VK_WHOLE_SIZE;
            check(context.vk().vkCreateBufferView(context.device(), &view, nullptr, &texels_),
                  "creating a texel buffer");
        }
        if (use != MemoryUse::Device) {
            check(context.vk().vkMapMemory(context.device(), memory_, 0, VK_WHOLE_SIZE, 0, &mapped_),
                  "mapping a buffer");
        }
    } catch (...) {
        release();
        throw;
    }
}

Buffer::~Buffer()
{
    release();
}

Buffer::Buffer(Buffer&& other) noexcept
{
    *this = std::move(other);
}

Buffer& Buffer::operator=(Buffer&& other) noexcept
{
    if (this != &other) {
        release();
        context_ = std::exchange(other.context_, nullptr);
        buffer_ = std::exchange(other.buffer_, VK_NULL_HANDLE);
        memory_ = std::exchange(other.memory_, VK_NULL_HANDLE);
        texels_ = std::exchange(other.texels_, VK_NULL_HANDLE);
        size_ = std::exchange(other.size_, 0);
        use_ = other.use_;
        mapped_ = std::exchange(other.mapped_, nullptr);
        name_ = std::move(other.name_);
        access_ = std::exchange(other.access_, {});
    }
    return *this;
}

void Buffer::release() noexcept
{
    if (context_ == nullptr) {
        return;
    }
    context_->vk().vkDestroyBufferView(context_->device(), texels_, nullptr);
    context_->vk().vkDestroyBuffer(context_->device(), buffer_, nullptr);
    context_->vk().vkFreeMemory(context_->device(), memory_, nullptr);
    buffer_ = VK_NULL_HANDLE;
    memory_ = VK_NULL_HANDLE;
    texels_ = VK_NULL_HANDLE;
}

} // namespace meltpoint::gpu
