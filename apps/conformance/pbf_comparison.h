#pragma once

#include <vector>

#include "conformance/device.h"
#include "conformance/pass_comparison.h"
#include "reference/cells.h"
#include "reference/state.h"

namespace meltpoint::conformance {

/// The passes of sim/pbf: the solve by one iteration and as a whole, what it ends in, and the prediction of the next
/// step. The device's particles are sorted and have densities; `twin` is their state in that order. Leaves the device
/// where it was.
[[nodiscard]] std::vector<PassError> compare_pbf_passes(Device& device, const sim::FluidOptions& options,
                                                        const reference::Settings& settings,
                                                        const reference::State& twin,
                                                        const reference::Neighbors& neighbors);

} // namespace meltpoint::conformance
