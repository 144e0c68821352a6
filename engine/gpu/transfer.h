#pragma once

#include <cstring>
#include <span>
#include <vector>

#include "gpu/buffer.h"
#include "gpu/commands.h"

namespace meltpoint::gpu {

/// Copies host data into the start of a device buffer through a staging buffer, and waits. For load time, not for the
/// loop.
template <class T>
void upload(const Context& context, const Buffer& target, std::span<const T> data)
{
    if (data.empty()) {
        return;
    }
    const Buffer staging(context, data.size_bytes(), MemoryUse::Upload, "upload staging");
    std::memcpy(staging.mapped<std::byte>().data(), data.data(), data.size_bytes());
    Commands commands(context);
    commands.begin();
    commands.copy(staging, target, data.size_bytes());
    commands.submit();
    commands.wait();
}

/// Copies the first `count` elements of a device buffer to the host, and waits.
template <class T>
[[nodiscard]] std::vector<T> download(const Context& context, const Buffer& source, std::size_t count)
{
    std::vector<T> data(count);
    if (count == 0) {
        return data;
    }
    const Buffer staging(context, count * sizeof(T), MemoryUse::Readback, "download staging");
    Commands commands(context);
    commands.begin();
    commands.copy(source, staging, count * sizeof(T));
    commands.submit();
    commands.wait();
    std::memcpy(data.data(), staging.mapped<std::byte>().data(), count * sizeof(T));
    return data;
}

} // namespace meltpoint::gpu
