#pragma once

#include <vector>

#include "conformance/device.h"
#include "conformance/pass_comparison.h"
#include "reference/cells.h"
#include "reference/state.h"

namespace meltpoint::conformance {

/// The reactions on boundary particles: to the forces that the device's particles, sorted and with densities, exert
/// now, and to made-up impulses of a step's solves. Errors are over the sum of the absolute values of the terms.
[[nodiscard]] std::vector<PassError> compare_boundary_forces(Device& device, const sim::FluidOptions& options,
                                                             const reference::Settings& settings,
                                                             const reference::Neighbors& neighbors);

} // namespace meltpoint::conformance
