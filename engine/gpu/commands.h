#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/context.h"
#include "gpu/kernel.h"

namespace meltpoint::gpu {

enum class Access { Read, Write, ReadWrite };

/// A buffer and what a dispatch does with it, in the order of the shader's binding numbers.
struct Binding {
    const Buffer* buffer = nullptr;
    Access access = Access::Read;
};

[[nodiscard]] inline Binding read(const Buffer& buffer)
{
    return {&buffer, Access::Read};
}
[[nodiscard]] inline Binding write(const Buffer& buffer)
{
    return {&buffer, Access::Write};
}
[[nodiscard]] inline Binding read_write(const Buffer& buffer)
{
    return {&buffer, Access::ReadWrite};
}

/// How shaders read what is bound as such.
[[nodiscard]] VkAccessFlags2 read_access(VkDescriptorType type);

/// For dispatches of shaders without push constants.
struct NoPush {};

/// Workgroups along x, y and z that cover `invocations` of a kernel, as dispatch chooses them: for indirect dispatches.
[[nodiscard]] std::array<std::uint32_t, 3> workgroups(const Context& context, const Kernel& kernel,
                                                      std::uint32_t invocations);

/// How long the scopes of one name took.
struct Timing {
    std::string name;
    double milliseconds = 0.0; ///< on the device's clock, summed over the scopes of this name
    std::uint32_t count = 0;   ///< how many scopes that were
};

/// Records work for the device and submits it. Barriers follow from the accesses that each call declares: none has to
/// be written by hand. Reusable: begin, record, submit, wait, begin again.
class Commands {
public:
    /// max_scopes > 0 makes every Scope take two timestamps (about 40 us each on software devices).
    explicit Commands(const Context& context, std::uint32_t max_scopes = 0);
    ~Commands();
    Commands(const Commands&) = delete;
    Commands& operator=(const Commands&) = delete;

    /// Starts recording; the previous submission must have been waited for.
    void begin();
    /// Ends recording and hands the work to the queue.
    void submit();
    /// Waits for the submitted work. Throws Device when the device is lost.
    void wait();

    /// Runs a kernel for at least `invocations` invocations (the shader drops the surplus of the last workgroup).
    /// Throws std::logic_error when bindings, their access or the push constants do not match the shader.
    template <class Push>
    void dispatch(const Kernel& kernel, std::uint32_t invocations, const Push& push,
                  std::initializer_list<Binding> bindings)
    {
        dispatch_bytes(kernel, invocations, std::as_bytes(std::span<const Push, 1>(&push, 1)),
                       {bindings.begin(), bindings.size()});
    }
    /// The same without push constants.
    void dispatch(const Kernel& kernel, std::uint32_t invocations, NoPush /*push*/,
                  std::initializer_list<Binding> bindings)
    {
        dispatch_bytes(kernel, invocations, {}, {bindings.begin(), bindings.size()});
    }

    /// Runs a kernel with the workgroup counts that lie in `arguments` (three uints) at byte `offset`.
    template <class Push>
    void dispatch_indirect(const Kernel& kernel, const Buffer& arguments, VkDeviceSize offset, const Push& push,
                           std::initializer_list<Binding> bindings)
    {
        dispatch_indirect_bytes(kernel, arguments, offset, std::as_bytes(std::span<const Push, 1>(&push, 1)),
                                {bindings.begin(), bindings.size()});
    }
    /// The same without push constants.
    void dispatch_indirect(const Kernel& kernel, const Buffer& arguments, VkDeviceSize offset, NoPush /*push*/,
                           std::initializer_list<Binding> bindings)
    {
        dispatch_indirect_bytes(kernel, arguments, offset, {}, {bindings.begin(), bindings.size()});
    }

    /// Sets every 32-bit word of `bytes` bytes (all by default) from byte `offset` on.
    void fill(const Buffer& buffer, std::uint32_t word, VkDeviceSize bytes = VK_WHOLE_SIZE, VkDeviceSize offset = 0);
    /// Copies `bytes` bytes from one buffer to another.
    void copy(const Buffer& source, const Buffer& target, VkDeviceSize bytes, VkDeviceSize source_offset = 0,
              VkDeviceSize target_offset = 0);

    /// Declares an access that the caller records itself through handle(); the barrier is inserted when needed.
    void use(const Buffer& buffer, VkPipelineStageFlags2 stages, VkAccessFlags2 access, bool writes);
    /// Adds a barrier of the caller's own (image layouts) to the next flush.
    void add_image_barrier(const VkImageMemoryBarrier2& barrier);
    /// Emits the barriers gathered so far; dispatches and copies do it themselves.
    void flush_barriers();

    /// Leaves out the barrier before the next command that needs one. Only for the test that shows that validation sees
    /// it.
    void suppress_next_barrier() { suppress_next_barrier_ = true; }

    /// Where a caller records commands of its own; use() and flush_barriers() come before them.
    [[nodiscard]] VkCommandBuffer handle() const { return buffer_; }
    /// What it was made for.
    [[nodiscard]] const Context& context() const { return *context_; }

    /// Device times of the scopes of the last finished submission, in order of first appearance; empty without
    /// timestamps.
    [[nodiscard]] std::vector<Timing> timings() const;

private:
    friend class Scope;

    void dispatch_bytes(const Kernel& kernel, std::uint32_t invocations, std::span<const std::byte> push,
                        std::span<const Binding> bindings);
    void dispatch_indirect_bytes(const Kernel& kernel, const Buffer& arguments, VkDeviceSize offset,
                                 std::span<const std::byte> push, std::span<const Binding> bindings);
    void bind(const Kernel& kernel, std::span<const std::byte> push, std::span<const Binding> bindings);
    /// In a host's device, before the first and after the last command: whatever the host has submitted or will submit
    /// to the queue comes before or after these commands (see Context).
    void order_with_host();
    std::uint32_t begin_scope(const char* name);
    void end_scope(std::uint32_t scope);

    const Context* context_;
    VkCommandPool pool_ = VK_NULL_HANDLE;
    VkCommandBuffer buffer_ = VK_NULL_HANDLE;
    VkFence fence_ = VK_NULL_HANDLE;
    VkQueryPool queries_ = VK_NULL_HANDLE;
    std::uint32_t max_scopes_ = 0;
    std::vector<std::string> scopes_;
    VkMemoryBarrier2 pending_{};
    std::vector<VkImageMemoryBarrier2> pending_images_;
    bool submitted_ = false;
    bool host_reads_ = false; ///< a readback buffer was written: make it visible to the host at the end
    bool suppress_next_barrier_ = false;
};

/// Names a stretch of commands for debuggers and, where Commands takes timestamps, measures it.
class Scope {
public:
    /// Begins here and ends with the object.
    Scope(Commands& commands, const char* name) : commands_(commands), scope_(commands.begin_scope(name)) {}
    ~Scope() { commands_.end_scope(scope_); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

private:
    Commands& commands_;
    std::uint32_t scope_;
};

} // namespace meltpoint::gpu
