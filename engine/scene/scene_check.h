#pragma once

#include <functional>
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

} // namespace meltpoint
