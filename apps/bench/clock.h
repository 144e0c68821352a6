#pragma once

#include <cstdint>

#include "gpu/device_info.h"

namespace meltpoint::bench {

/// Of this machine, at least 1.
[[nodiscard]] std::uint32_t processors();

/// CPU time of all threads of this program over the number of processors, ms: what the wall clock shows when nothing
/// else runs, and what a busy neighbor changes less.
[[nodiscard]] double processor_milliseconds();

/// What a device's work is timed with: processor_milliseconds() of software devices, the wall clock of GPUs.
[[nodiscard]] double device_milliseconds(const gpu::DeviceInfo& device);

} // namespace meltpoint::bench
