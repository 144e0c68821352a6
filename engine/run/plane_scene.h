#pragma once

#include "scene/scene.h"

namespace meltpoint {

/// A scene of two dimensions as a slice of space: everything lies at z = 0, where a block is its rectangle, a sphere a
/// disk of its radius, and the domain is one support radius thick. Other scenes stay as they are.
[[nodiscard]] Scene in_its_dimensions(const Scene& scene);

} // namespace meltpoint
