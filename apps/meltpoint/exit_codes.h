#pragma once

namespace meltpoint::program {

inline constexpr int exit_done = 0;
inline constexpr int exit_failed = 1;    ///< at run time: device, disk, breakdown, beyond a bound
inline constexpr int exit_bad_input = 2; ///< or wrong usage
inline constexpr int exit_interrupted = 130;

} // namespace meltpoint::program
