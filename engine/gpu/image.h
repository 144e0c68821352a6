#pragma once

#include <cstdint>
#include <string>

#include "gpu/commands.h"
#include "gpu/context.h"

namespace meltpoint::gpu {

/// What a command does with an image; layout, pipeline stages and accesses follow from it.
enum class ImageUse {
    ColorTarget, ///< written as a color attachment
    DepthTarget, ///< tested and written as the depth attachment
    Sampled,     ///< read by fragment or compute shaders
    CopySource,
};

/// Layout and last accesses of an image, as AccessState of buffers: what the next barrier needs.
struct ImageState {
    VkImageLayout layout = VK_IMAGE_LAYOUT_UNDEFINED;
    VkPipelineStageFlags2 stages = 0; ///< of the last use
    VkAccessFlags2 writes = 0;        ///< of the last use; 0 when it read
};

/// A two-dimensional image on the device with memory and a view of its own. Move-only.
class Image {
public:
    Image() = default;
    /// `usage` is a set of VK_IMAGE_USAGE_*. Throws Device when the size is 0, beyond the device's limit, or when there
    /// is no memory left.
    Image(const Context& context, std::uint32_t width, std::uint32_t height, VkFormat format, VkImageUsageFlags usage,
          const std::string& name);
    ~Image();
    /// Leaves the other one empty.
    Image(Image&& other) noexcept;
    /// Frees what it held and leaves the other one empty.
    Image& operator=(Image&& other) noexcept;

    /// Owned by this object.
    [[nodiscard]] VkImage handle() const { return image_; }
    /// Of the whole image.
    [[nodiscard]] VkImageView view() const { return view_; }
    /// Of a texel.
    [[nodiscard]] VkFormat format() const { return format_; }
    /// Width and height in texels.
    [[nodiscard]] VkExtent2D extent() const { return extent_; }
    /// Depth or color, as the format has it.
    [[nodiscard]] VkImageAspectFlags aspect() const;
    /// As validation messages and GPU debuggers show it.
    [[nodiscard]] const std::string& name() const { return name_; }

    /// Bookkeeping of use_image; not part of the image's value.
    [[nodiscard]] ImageState& state() const { return state_; }

private:
    void release() noexcept;

    const Context* context_ = nullptr;
    VkImage image_ = VK_NULL_HANDLE;
    VkDeviceMemory memory_ = VK_NULL_HANDLE;
    VkImageView view_ = VK_NULL_HANDLE;
    VkFormat format_ = VK_FORMAT_UNDEFINED;
    VkExtent2D extent_{};
    std::string name_;
    mutable ImageState state_;
};

/// Largest width and height of an image that can be drawn to.
[[nodiscard]] std::uint32_t max_target_size(const Context& context);

/// Declares what the next command does with the image: adds the barrier and layout change that this needs to the next
/// flush. With `discard` the old contents are dropped.
void use_image(Commands& commands, const Image& image, ImageUse use, bool discard = false);

/// The layout in which an image is during a use.
[[nodiscard]] VkImageLayout layout_of(ImageUse use);

/// Copies all texels into the start of a buffer, rows tightly packed.
void copy_to_buffer(Commands& commands, const Image& image, const Buffer& target);

} // namespace meltpoint::gpu
