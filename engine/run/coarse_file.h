#pragma once

#include <span>
#include <string>

#include <glm/glm.hpp>

namespace meltpoint {

/// Warns of a file whose shape lies so far from the origin that its positions (m), which are floats, are good to no
/// more than a ten thousandth of its extent: as scans in the coordinates of a map do.
void warn_of_coarse_file(std::span<const glm::vec3> positions, const std::string& name);

} // namespace meltpoint
