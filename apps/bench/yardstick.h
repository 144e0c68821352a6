#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "particles/particle_set.h"
#include "shared/sph_params.h"

namespace meltpoint::bench {

/// What a step of the simulation is measured against: the same step as a plain multithreaded C++ loop on the CPU, a
/// structure of arrays in sorted order, nine contiguous rows of candidates a particle, single precision, vectorized by
/// the compiler. Its walls are the same mirrors: each step it makes the images as ghost particles in a border of cells,
/// where a loop over neighbors finds them like any other.
class Yardstick {
public:
    /// The state of a simulation, accelerations included. `kernel`: shared::KERNEL_*; the paper's tension is not done.
    Yardstick(const ParticleSet& particles, const shared::SphParams& params, std::uint32_t kernel,
              std::uint32_t threads);
    ~Yardstick();
    Yardstick(const Yardstick&) = delete;
    Yardstick& operator=(const Yardstick&) = delete;

    /// Density and pressure of the particles where they are.
    void evaluate_density();
    void advance(std::uint32_t steps);

    /// The particles in order of id.
    [[nodiscard]] ParticleSet particles() const;

    /// A processor feature that the yardstick was compiled for and this processor lacks; empty when it can run here.
    [[nodiscard]] static std::string missing_feature();

private:
    class State;
    std::unique_ptr<State> state_;
};

} // namespace meltpoint::bench
