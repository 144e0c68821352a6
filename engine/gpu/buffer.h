#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "gpu/context.h"

namespace meltpoint::gpu {

enum class MemoryUse {
    Device,   ///< for the device alone; filled and read through copies
    Upload,   ///< the host writes, the device reads
    Readback, ///< the device writes, the host reads after the fence
};

/// Who touched a buffer last, as far as it matters for the next barrier. All work goes to one queue in recording order,
/// so the state may live in the buffer and carry over from one submission to the next.
struct AccessState {
    VkPipelineStageFlags2 write_stages = 0;
    VkAccessFlags2 write_access = 0;
    VkPipelineStageFlags2 read_stages = 0;    ///< since the last write
    VkPipelineStageFlags2 visible_stages = 0; ///< to which the last write has been made visible
    VkAccessFlags2 visible_access = 0;
};

/// A buffer with memory of its own, which shaders bind as a storage buffer or, up to 16 KiB, as a uniform buffer.
/// Move-only.
class Buffer {
public:
    Buffer() = default;
    /// Allocates `bytes` (at least 16). Throws Device when the device's storage buffer range or its memory does not
    /// allow it.
    Buffer(const Context& context, VkDeviceSize bytes, MemoryUse use, const std::string& name)
        : Buffer(context, bytes, use, name, VK_FORMAT_UNDEFINED)
    {
    }
    /// With a format other than VK_FORMAT_UNDEFINED, shaders may also read it as a texel buffer of that format.
    Buffer(const Context& context, VkDeviceSize bytes, MemoryUse use, const std::string& name, VkFormat texels);
    ~Buffer();
    /// Leaves the other one empty.
    Buffer(Buffer&& other) noexcept;
    /// Frees what it held and leaves the other one empty.
    Buffer& operator=(Buffer&& other) noexcept;

    /// Owned by this object.
    [[nodiscard]] VkBuffer handle() const { return buffer_; }
    /// As a texel buffer; VK_NULL_HANDLE for buffers made without a format.
    [[nodiscard]] VkBufferView texels() const { return texels_; }
    /// Bytes.
    [[nodiscard]] VkDeviceSize size() const { return size_; }
    /// What it was made for.
    [[nodiscard]] MemoryUse use() const { return use_; }
    /// As validation messages and GPU debuggers show it.
    [[nodiscard]] const std::string& name() const { return name_; }

    /// Host view of an Upload or Readback buffer.
    template <class T>
    [[nodiscard]] std::span<T> mapped() const
    {
        return {static_cast<T*>(mapped_), static_cast<std::size_t>(size_) / sizeof(T)};
    }

    /// Bookkeeping of Commands; not part of the buffer's value.
    [[nodiscard]] AccessState& access_state() const { return access_; }

private:
    void release() noexcept;

    const Context* context_ = nullptr;
    VkBuffer buffer_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    VkBufferView texels_ = VK_NULL_HANDLE;
    VkDeviceSize size_ = 0;
    MemoryUse use_ = MemoryUse::Device;
    void* mapped_ = nullptr;
    std::string name_;
    mutable AccessState access_;
};

/// A device buffer of `count` elements of T.
template <class T>
[[nodiscard]] Buffer make_buffer(const Context& context, std::size_t count, const std::string& name)
{
    return {context, count * sizeof(T), MemoryUse::Device, name};
}

/// A device buffer of `count` vec4 that shaders may also read as a texel buffer.
[[nodiscard]] inline Buffer make_texel_buffer(const Context& context, std::size_t count, const std::string& name)
{
    return {context, count * 4 * sizeof(float), MemoryUse::Device, name, VK_FORMAT_R32G32B32A32_SFLOAT};
}

} // namespace meltpoint::gpu
