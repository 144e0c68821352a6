#include "bench/clock.h"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <thread>

namespace meltpoint::bench {

std::uint32_t processors()
{
    return std::max(std::thread::hardware_concurrency(), 1u);
}

double processor_milliseconds()
{
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return (1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec)) / processors();
}

double device_milliseconds(const gpu::DeviceInfo& device)
{
    return device.software()
               ? processor_milliseconds()
               : std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

} // namespace meltpoint::bench
