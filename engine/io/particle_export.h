#pragma once

#include <filesystem>

#include "particles/particle_set.h"

namespace meltpoint {

/// Writes the particles as a binary little-endian PLY point cloud, one vertex a particle in the order of the set, dead
/// ones included: x y z (m), vx vy vz (m/s), density (kg/m^3), pressure (Pa), mass (kg) as float; id as uint; state
/// (shared::STATE_*) and material as uchar. Whole or not at all (atomic_file.h). Throws Error (Runtime) when the file
/// cannot be written or the set's arrays differ in length.
void write_ply(const std::filesystem::path& path, const ParticleSet& particles);

} // namespace meltpoint
