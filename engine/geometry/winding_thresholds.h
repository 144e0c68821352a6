#pragma once

#include <cstdint>
#include <vector>

#include "geometry/cell_grid.h"
#include "geometry/winding_number.h"

namespace meltpoint {

constexpr std::int8_t no_threshold = INT8_MIN;

/// For every cell of a grid the whole number n for which k - w >= 1/2 exactly where k >= n, k whole, w the winding
/// number anywhere in the cell; no_threshold where it is not the same everywhere, or w is not known to change slowly
/// enough to tell. Away from triangles w is harmonic, so large blocks of cells need a few queries.
[[nodiscard]] std::vector<std::int8_t> winding_thresholds(const WindingNumber& winding, const CellGrid& grid);

} // namespace meltpoint
