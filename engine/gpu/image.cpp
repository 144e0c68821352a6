#include "gpu/image.h"

#include <algorithm>
#include <utility>

#include <volk.h>

#include "core/error.h"

namespace meltpoint::gpu {

namespace {

struct UseTraits {
    VkImageLayout layout;
    VkPipelineStageFlags2 stages;
    VkAccessFlags2 reads;
    VkAccessFlags2 writes;
};

UseTraits traits(ImageUse use)
{
    switch (use) {
    case ImageUse::ColorTarget:
        return {VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL, VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT, VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT};
    case ImageUse::DepthTarget:
        return {VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL,
                VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT,
                VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT, VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT};
    case ImageUse::Sampled:
        return {VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL,
                VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT | VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                VK_ACCESS_2_SHADER_SAMPLED_READ_BIT, 0};
    case ImageUse::CopySource:
        break;
    }
    return {VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, VK_PIPELINE_STAGE_2_COPY_BIT, VK_ACCESS_2_TRANSFER_READ_BIT, 0};
}

} // namespace

Image::Image(const Context& context, std::uint32_t width, std::uint32_t height, VkFormat format,
             VkImageUsageFlags usage, const std::string& name)
    : context_(&context), format_(format), extent_{width, height}, name_(name)
{
    const std::uint32_t limit = max_target_size(context);
    if (width == 0 || height == 0 || width > limit || height > limit) {
        throw device_error("an image \"{}\" of {} x {} pixels was asked for; {} allows 1 to {} along each side", name,
                           width, height, context.info().name, limit);
    }
    try {
        VkImageCreateInfo info{VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO};
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = format;
        info.extent = {width, height, 1};
        info.mipLevels = 1;
        info.arrayLayers = 1;
        info.samples = VK_SAMPLE_COUNT_1_BIT;
        info.tiling = VK_IMAGE_TILING_OPTIMAL;
        info.usage = usage;
        check(context.vk().vkCreateImage(context.device(), &info, nullptr, &image_), "creating an image");
        context.set_name(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<std::uint64_t>(image_), name); // NOLINT

        VkMemoryRequirements needs{};
        context.vk().vkGetImageMemoryRequirements(context.device(), image_, &needs);
        VkMemoryAllocateInfo allocation{VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO};
        allocation.allocationSize = needs.size;
        allocation.memoryTypeIndex = context.memory_type(needs.memoryTypeBits, 0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT);
        if (context.vk().vkAllocateMemory(context.device(), &allocation, nullptr, &memory_) != VK_SUCCESS) {
            throw device_error("{} has no {:.1f} MiB of memory left for the image \"{}\"", context.info().name,
                               static_cast<double>(needs.size) / (1024.0 * 1024.0), name);
        }
        check(context.vk().vkBindImageMemory(context.device(), image_, memory_, 0), "binding an image to its memory");

        VkImageViewCreateInfo view{VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO};
        view.image = image_;
        view.viewType = VK_IMAGE_VIEW_TYPE_2D;
        view.format = format;
        view.subresourceRange = {aspect(), 0, 1, 0, 1};
        check(context.vk().vkCreateImageView(context.device(), &view, nullptr, &view_), "creating an image view");
    } catch (...) {
        release();
        throw;
    }
}

Image::~Image()
{
    release();
}

Image::Image(Image&& other) noexcept
{
    *this = std::move(other);
}

Image& Image::operator=(Image&& other) noexcept
{
    if (this != &other) {
        release();
        context_ = std::exchange(other.context_, nullptr);
        image_ = std::exchange(other.image_, VK_NULL_HANDLE);
        memory_ = std::exchange(other.memory_, VK_NULL_HANDLE);
        view_ = std::exchange(other.view_, VK_NULL_HANDLE);
        format_ = other.format_;
        extent_ = other.extent_;
        name_ = std::move(other.name_);
        state_ = std::exchange(other.state_, {});
    }
    return *this;
}

VkImageAspectFlags Image::aspect() const
{
    return format_ == VK_FORMAT_D32_SFLOAT ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
}

void Image::release() noexcept
{
    if (context_ == nullptr) {
        return;
    }
    context_->vk().vkDestroyImageView(context_->device(), view_, nullptr);
    context_->vk().vkDestroyImage(context_->device(), image_, nullptr);
    context_->vk().vkFreeMemory(context_->device(), memory_, nullptr);
    view_ = VK_NULL_HANDLE;
    image_ = VK_NULL_HANDLE;
    memory_ = VK_NULL_HANDLE;
}

std::uint32_t max_target_size(const Context& context)
{
    const VkPhysicalDeviceLimits& limits = context.limits();
    return std::min({limits.maxImageDimension2D, limits.maxFramebufferWidth, limits.maxFramebufferHeight,
                     limits.maxViewportDimensions[0], limits.maxViewportDimensions[1]});
}

VkImageLayout layout_of(ImageUse use)
{
    return traits(use).layout;
}

void use_image(Commands& commands, const Image& image, ImageUse use, bool discard)
{
    const UseTraits next = traits(use);
    ImageState& state = image.state();
    const bool read_after_read = next.writes == 0 && state.writes == 0 && state.stages == next.stages;
    if (state.layout != next.layout || !read_after_read) {
        VkImageMemoryBarrier2 barrier{VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2};
        barrier.srcStageMask = state.stages;
        barrier.srcAccessMask = state.writes;
        barrier.dstStageMask = next.stages;
        barrier.dstAccessMask = next.reads | next.writes;
        barrier.oldLayout = discard ? VK_IMAGE_LAYOUT_UNDEFINED : state.layout;
        barrier.newLayout = next.layout;
        barrier.srcQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.image = image.handle();
        barrier.subresourceRange = {image.aspect(), 0, 1, 0, 1};
        commands.add_image_barrier(barrier);
    }
    state = {next.layout, next.stages, next.writes};
}

void copy_to_buffer(Commands& commands, const Image& image, const Buffer& target)
{
    use_image(commands, image, ImageUse::CopySource);
    commands.use(target, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT, VK_ACCESS_2_TRANSFER_WRITE_BIT, true);
    commands.flush_barriers();
    VkBufferImageCopy region{};
    region.imageSubresource = {image.aspect(), 0, 0, 1};
    region.imageExtent = {image.extent().width, image.extent().height, 1};
    commands.context().vk().vkCmdCopyImageToBuffer(commands.handle(), image.handle(), layout_of(ImageUse::CopySource),
                                                   target.handle(), 1, &region);
}

} // namespace meltpoint::gpu
