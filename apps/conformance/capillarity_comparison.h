#pragma once

#include <vector>

#include "conformance/device.h"
#include "conformance/pass_comparison.h"
#include "reference/cells.h"
#include "reference/state.h"

namespace meltpoint::conformance {

/// The passes of sim/capillarity: normals, one smoothing, and the accelerations that the smoothed normals lead to; each
/// over the sum of the absolute values of its terms. The device's particles are sorted and have densities.
[[nodiscard]] std::vector<PassError> compare_capillarity(Device& device, const sim::FluidOptions& options,
                                                         const reference::Settings& settings,
                                                         const reference::Neighbors& neighbors);

} // namespace meltpoint::conformance
