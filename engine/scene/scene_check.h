#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "scene/scene.h"

namespace meltpoint {

/// Where a key was set, as the opening of a sentence: "drop.toml:7". Given a dotted key, as in "fluid.0.radius".
using KeyLocator = std::function<std::string(std::string_view key)>;

/// Throws Error (Input) with one sentence that names the key, what was found and what is allowed, when a value is out
/// of its range, or when values contradict each other: an empty domain, a fluid outside it, a camera without a
/// direction. Whether meshes can be read, and whether all of it fits a device, is found out by the run. Without a
/// locator the sentence opens with the scene's name.
void validate_scene(const Scene& scene, const KeyLocator& locate = {});

/// An axis along which the domain is narrower than two support radii. Walls are mirrors; a particle between two of
/// them, or between two images of itself, would need images of images without end.
struct NarrowAxis {
    bool periodic = false; ///< else between walls
    std::string complaint; ///< "is 1 m wide along x, between walls, where it must be ..."
};
[[nodiscard]] std::optional<NarrowAxis> find_narrow_axis(const Scene& scene);

/// The axis along which the rectangle of an inflow is flat; none where it is no rectangle. In the plane z does not
/// count.
[[nodiscard]] std::optional<int> flat_axis(const InflowShape& inflow, bool is_in_plane);

} // namespace meltpoint
