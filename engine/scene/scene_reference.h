#pragma once

#include <string>

namespace meltpoint {

/// The text of apps/scenes/README.md: how a scene file is built up, and every key with its unit, default and range.
std::string scene_reference_markdown();

} // namespace meltpoint
