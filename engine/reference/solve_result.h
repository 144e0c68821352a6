#pragma once

#include <cstdint>

namespace meltpoint::reference {

/// What an iterative solve took.
struct SolveResult {
    std::uint32_t iterations = 0;
    double error = 0.0; ///< that it ended with, as its solve measures it
};

} // namespace meltpoint::reference
