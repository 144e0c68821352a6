#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "gpu/commands.h"
#include "particle_buffers/particle_buffers.h"
#include "particles/particle_set.h"
#include "shared/sph_params.h"
#include "sim/dust.h"
#include "sim/emission.h"
#include "sim/erosion.h"
#include "sim/exposure.h"
#include "sim/fluid_kernels.h"
#include "sim/fragments.h"
#include "sim/hydraulic.h"
#include "sim/implicit_viscosity.h"
#include "sim/melting.h"
#include "sim/neighbor_grid.h"
#include "sim/solver.h"
#include "sim/volume_relaxation.h"
#include "sim/wind.h"

namespace meltpoint::sim {

/// What a Simulation is made with besides its particles.
struct SimulationSettings {
    shared::SphParams params{}; ///< moving_count, pool_count and grid_size are filled in
    FluidOptions options;
    std::optional<shared::DustParams> dust; ///< where some of the solids crumble
    EmissionSettings emission;
    std::optional<MeltingSettings> melting;     ///< where heat is followed
    std::optional<HydraulicSettings> hydraulic; ///< where flow erodes solids
    std::optional<WindSettings> wind;           ///< where there is sand
    std::optional<FragmentSettings> fragments;  ///< where pieces of solids may come loose
};

/// The params with the numbers of particles and the grid size filled in: all of them move.
[[nodiscard]] shared::SphParams complete_params(shared::SphParams params, std::size_t particle_count);
/// The same: boundary particles are still where options.still says so.
[[nodiscard]] shared::SphParams complete_params(const shared::SphParams& params, const FluidOptions& options,
                                                const ParticleSet& particles);

/// Neighbor statistics of the present state, of all particles but boundary particles.
struct NeighborStatistics {
    double mean = 0.0;            ///< neighbors per particle within the support radius, itself not counted
    std::uint64_t coincident = 0; ///< ordered pairs closer than COINCIDENT_RATIO support radii: they have no gradient
};

/// A fluid on the device and its time. Buffers are of fixed size; nothing is read back while stepping but one status
/// word after the fence.
class Simulation {
public:
    /// Uploads the particles and evaluates their accelerations, so that density and pressure are those of the initial
    /// state. Throws Input when there are no particles or more than the device holds (the sentence names the limit).
    Simulation(const gpu::Context& context, const ParticleSet& particles, const SimulationSettings& settings);

    /// Runs `steps` time steps, several a submission, and waits for them. Throws Runtime naming step, particle and
    /// reason when a particle is not finite, has left the domain or is faster than the speed limit.
    void advance(std::uint32_t steps);
    /// Runs until `seconds` from now, and waits: with as many steps as it takes where the device chooses their length
    /// (params.adaptive_dt), else to within half a step of the sum of all calls. Throws as advance does.
    void advance_by(double seconds);

    /// The present state. advance() moves particles and swaps buffers: ask again after it.
    [[nodiscard]] const ParticleBuffers& particles() const { return particles_; }
    /// As the passes have them.
    [[nodiscard]] const shared::SphParams& params() const { return params_; }
    /// When fronts or heat have freed who is solid no more, or fronts will: float by id, s. Null where nothing does.
    [[nodiscard]] const gpu::Buffer* release_time() const { return erosion_ ? &erosion_->release_time() : nullptr; }
    /// For passes of others over the particles as they lie: shared::SphParams, and the grid's cell starts.
    [[nodiscard]] const gpu::Buffer& params_buffer() const { return params_buffer_; }
    [[nodiscard]] const gpu::Buffer& cell_start() const { return grid_.cell_start; }
    /// vec2 by id, two-floats: J/kg, and how far hydraulic erosion has come. Null where nobody follows them.
    [[nodiscard]] const gpu::Buffer* enthalpy_buffer() const
    {
        return melting_ ? &melting_->heat().enthalpy() : nullptr;
    }
    [[nodiscard]] const gpu::Buffer* damage_buffer() const { return hydraulic_ ? &hydraulic_->damage() : nullptr; }
    /// Steps since the start.
    [[nodiscard]] std::uint64_t step() const { return step_; }
    /// s since the start.
    [[nodiscard]] double time() const { return seconds_; }

    /// Until the next look at the solids: 0 where it comes before the next step, very many where there are none to look
    /// at.
    [[nodiscard]] std::uint32_t steps_until_erosion() const;

    /// Particles an invocation.
    [[nodiscard]] std::uint32_t tile() const { return kernels_.tile; }
    /// Device memory of the particles, their grid and the sort.
    [[nodiscard]] std::uint64_t device_bytes() const;

    /// The particles on the host, in order of id.
    [[nodiscard]] ParticleSet download() const;
    /// Counts neighbors on the device, and waits.
    [[nodiscard]] NeighborStatistics neighbor_statistics();

    /// What heat has come to, where it is followed.
    struct HeatStatistics {
        double enthalpy = 0.0;     ///< J, of all fluid and solid: 0 of solid at the melting point
        double exposed_area = 0.0; ///< m^2, of solids, as it was last looked at
    };
    /// Of particles as download() has them. Waits.
    [[nodiscard]] std::optional<HeatStatistics> heat_statistics(const ParticleSet& particles) const;
    /// J/kg, by id; empty where heat is not followed. Waits.
    [[nodiscard]] std::vector<double> enthalpy() const;

    /// kg of sand that the wind has taken since the start.
    [[nodiscard]] double picked_up() const { return picked_up_; }
    /// Where there is sand.
    [[nodiscard]] const Wind* wind() const { return wind_ ? &*wind_ : nullptr; }
    /// How far hydraulic erosion has come, 0 to 1, by id; empty where nothing erodes. Waits.
    [[nodiscard]] std::vector<double> damage() const;
    /// Particles of sediment and sand that have become solid again since the start.
    [[nodiscard]] std::uint64_t deposited() const { return deposited_; }

    /// Pieces of solids that nothing holds; null where none can come loose.
    [[nodiscard]] const Fragments* fragments() const { return fragments_ ? &*fragments_ : nullptr; }

    /// Particles that have come and gone since the start. Waits.
    [[nodiscard]] shared::Ledger ledger() const;
    /// Births for which an emitter had no particle left, of each, since the start.
    [[nodiscard]] std::vector<std::uint64_t> missed_births() const;

    /// What the solves of one kind took since the last call, or the start.
    struct SolveStatistics {
        double mean_iterations = 0.0;  ///< a step
        double worst_error = 0.0;      ///< that a solve ended with
        std::uint32_t unconverged = 0; ///< solves that ended at the maximum of iterations
        double farthest_move = 0.0;    ///< m, of a particle in a solve that moves particles
        std::uint32_t capped = 0;      ///< particles that the speed cap slowed down, counted in each step
    };
    /// By shared::SOLVE_*; empty where nothing is solved for. Waits, and starts to count anew.
    [[nodiscard]] std::optional<std::array<SolveStatistics, shared::SOLVES>> take_solve_statistics();
    /// The same of viscosity; empty where it is not solved for.
    [[nodiscard]] std::optional<SolveStatistics> take_viscosity_statistics();

    /// The mean forces of fluid on boundary particles over a time: the reactions to theirs on it.
    struct BoundaryForceMeans {
        std::uint32_t first_id = 0;       ///< of boundary particles
        std::vector<glm::dvec3> pressure; ///< N, by id from first_id on
        std::vector<glm::dvec3> friction; ///< N, likewise
    };
    /// Sums up from now on what fluid does to boundary particles: another pass a step, or two, around them.
    void measure_boundary_forces();
    /// Their means since the last call, or since they are measured; zero where no time has passed. Waits. Throws
    /// std::logic_error where they are not measured.
    [[nodiscard]] BoundaryForceMeans take_boundary_forces();

    /// Takes timestamps of every pass from now on (about 40 us each on software devices).
    void enable_timings();
    /// Device times of the passes of the last advance(), summed over its last submission.
    [[nodiscard]] std::vector<gpu::Timing> timings() const { return commands_->timings(); }

    /// The most particles that the device's memory and binding limits allow.
    [[nodiscard]] static std::uint64_t particle_limit(const gpu::DeviceInfo& device);
    /// The same for a context's device.
    [[nodiscard]] static std::uint64_t particle_limit(const gpu::Context& context)
    {
        return particle_limit(context.info());
    }

private:
    /// What the host learns after every submission.
    struct Readback {
        shared::Status status;
        shared::TimeStep time;
    };
    /// start: s since the start when TimeStep::elapsed is 0; where steps are fixed, when the first of these begins.
    Readback submit_steps(std::uint32_t steps, double start);
    /// Where a look at the solids and the dead is due: those that are due to turn into fluid or dust do, those that are
    /// to be born soon are called up, and the pool is parted anew. `time` in s since the start.
    void erode(double time);
    void note_picked_up(const shared::PoolChanges& found);
    /// The pool is parted anew: others move than before.
    void part_pool();
    /// Pieces that nothing holds come loose, at `time` in s since the start: whenever others are solid.
    void loosen_pieces(double time);
    /// Where solids are exposed and what of them is seen: whenever others are solid.
    void record_surface(gpu::Commands& commands);
    /// Throws where there is a fault; `time` of it in s since the start.
    static void check_status(const shared::Status& status, double time);
    /// Steps from this look to the next.
    [[nodiscard]] std::uint32_t look_interval() const;
    /// s, the longest that so many steps may take from now on.
    [[nodiscard]] double longest_time(std::uint32_t steps) const;
    [[nodiscard]] std::uint32_t steps_a_submission() const;
    [[nodiscard]] Fluid fluid()
    {
        return {kernels_,
                params_buffer_,
                particles_,
                grid_,
                status_,
                time_,
                vorticity_,
                boundary_forces_.get(),
                fragments_ ? fragments_->forces() : nullptr,
                viscosity_ ? &*viscosity_ : nullptr,
                shifting_ ? &*shifting_ : nullptr,
                capillarity_ ? &*capillarity_ : nullptr};
    }
    /// Of shared::Solve at a buffer's start, over the steps since `taken_at`, which is set to the present one.
    std::vector<SolveStatistics> take_statistics(const gpu::Buffer& solves, std::size_t count, std::uint64_t& taken_at);

    const gpu::Context* context_;
    shared::SphParams params_;
    FluidOptions options_;
    FluidKernels kernels_;
    std::unique_ptr<Solver> solver_;
    std::optional<ImplicitViscosity> viscosity_;
    std::optional<Shifting> shifting_;
    std::optional<Capillarity> capillarity_;
    std::optional<Erosion> erosion_;
    std::optional<Dust> dust_;
    std::optional<Emission> emission_;
    std::optional<Exposure> exposure_; ///< where a driver asks for it
    std::optional<Melting> melting_;
    std::optional<Wind> wind_;
    std::optional<Hydraulic> hydraulic_;
    std::optional<Fragments> fragments_;
    std::optional<VolumeRelaxation> volume_relaxation_; ///< where solids have another volume than their fluid
    ParticleBuffers particles_;
    NeighborGrid grid_;
    gpu::Buffer params_buffer_;
    gpu::Buffer status_;
    gpu::Buffer readback_; ///< Readback
    TimeControl time_;
    Vorticity vorticity_;
    std::unique_ptr<BoundaryForces> boundary_forces_;
    std::unique_ptr<gpu::Commands> commands_;
    std::unique_ptr<gpu::Commands> erosion_commands_; ///< apart, so that timings() are those of steps
    double picked_up_ = 0.0;                          ///< kg
    std::uint64_t step_ = 0;
    std::uint64_t next_erosion_ = 0;    ///< the step before which solids are looked at
    double looked_at_ = 0.0;            ///< s, when that was done last
    bool pieces_change_ = false;        ///< others are solid since pieces were found
    double next_pieces_ = 0.0;          ///< s, before which no pieces are looked for that are not loose already
    std::uint64_t deposited_ = 0;       ///< particles, since the start
    std::uint32_t gone_ = 0;            ///< particles that are dead and lie behind all others
    float dt_limit_ = 0.0f;             ///< s, how long the last step might have been
    double seconds_ = 0.0;              ///< since the start
    double wanted_seconds_ = 0.0;       ///< of all calls of advance_by
    std::uint64_t solves_taken_at_ = 0; ///< step of the last take_solve_statistics
    double forces_taken_at_ = 0.0;      ///< s, of the last take_boundary_forces
    std::uint64_t viscosity_taken_at_ = 0;
};

} // namespace meltpoint::sim
