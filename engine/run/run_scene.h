#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>

#include "gpu/context.h"
#include "scene/scene.h"

namespace meltpoint {

/// Where a run writes what.
struct RunOptions {
    std::filesystem::path out;               ///< folder of frame_NNNN.png; made when missing
    std::filesystem::path video;             ///< empty: none
    std::filesystem::path stats;             ///< empty: none
    std::filesystem::path forces;            ///< of fluid on colliders; empty: none
    bool particles = false;                  ///< particles_NNNN.ply beside the frames
    bool force = false;                      ///< replace existing output
    bool quiet = false;                      ///< no progress
    const std::atomic<bool>* stop = nullptr; ///< set by another thread or a signal: finish the frame and return
};

/// What a run has done.
struct RunSummary {
    std::uint32_t frames = 0; ///< written
    std::uint32_t particles = 0;
    std::uint64_t steps = 0;
    double time = 0.0;    ///< simulated, s
    double seconds = 0.0; ///< of wall time
    bool stopped = false; ///< by options.stop, before the last frame
};

/// Runs a scene from its initial state (frame 0) to its last frame and writes what the options ask for, each file whole
/// or not at all. Nothing is computed before it is known that the output may be written. Warns about a dt above its
/// bounds. Throws Input (scene, existing output), Device and Runtime (breakdown, disk); frames written before stay.
RunSummary run_scene(const gpu::Context& context, const Scene& scene, const RunOptions& options);

} // namespace meltpoint
