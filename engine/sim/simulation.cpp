#include "sim/simulation.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string_view>

#include "core/error.h"
#include "gpu/transfer.h"
#include "shared/neighbor_count.h"
#include "sim/wcsph.h"

namespace meltpoint::sim {

namespace {

// Enough steps to hide the cost of a submission, few enough to keep it well under a second on a slow device.
constexpr std::uint32_t max_steps_per_submission = 16;
constexpr std::uint32_t particle_steps_per_submission = 1'000'000;

/// Particles and the grid's copies of them, per particle, with the sort's keys, order and scratch, and the neighbors'
/// bits.
constexpr std::uint64_t bytes_per_particle =
    particle_buffer_bytes + 2 * sizeof(glm::vec4) + (8 + NeighborGrid::neighbor_words) * sizeof(std::uint32_t);

std::string_view describe_fault(std::uint32_t fault)
{
    switch (fault) {
    case shared::FAULT_NOT_FINITE:
        return "its position or velocity is not a finite number";
    case shared::FAULT_ESCAPED:
        return "it left the domain";
    case shared::FAULT_TOO_FAST:
        return "it is faster than the time step allows (CFL bound)";
    default:
        return "unknown fault";
    }
}

/// s, that a piece which has broken off may stay where it is before anybody notices: in which it falls by half of a
/// spacing. To find pieces at every look would often take longer than the steps between.
double piece_delay(const shared::SphParams& params)
{
    const double gravity = glm::length(glm::dvec3(params.gravity));
    return gravity > 0.0 ? std::sqrt(static_cast<double>(params.spacing) / gravity) : 0.0;
}

const ParticleSet& checked(const gpu::Context& context, const ParticleSet& particles)
{
    if (particles.size() == 0) {
        throw input_error("there are no particles to simulate");
    }
    const std::uint64_t limit = Simulation::particle_limit(context);
    if (particles.size() > limit) {
        throw input_error("{} particles are more than {} can hold: at most {}", particles.size(), context.info().name,
                          limit);
    }
    return particles;
}

} // namespace

shared::SphParams complete_params(shared::SphParams params, std::size_t particle_count)
{
    params.pool_count = static_cast<std::uint32_t>(particle_count);
    params.moving_count = params.pool_count;
    params.grid_size = grid_size(params.domain_min, params.domain_max, params.support_radius);
    return params;
}

shared::SphParams complete_params(const shared::SphParams& params, const FluidOptions& options,
                                  const ParticleSet& particles)
{
    shared::SphParams complete = complete_params(params, particles.size());
    if (options.still) {
        complete.moving_count -=
            static_cast<std::uint32_t>(std::ranges::count_if(particles.attributes, shared::is_still));
    }
    return complete;
}

std::uint64_t Simulation::particle_limit(const gpu::DeviceInfo& device)
{
    const std::uint64_t by_binding = device.limits.maxStorageBufferRange / sizeof(glm::vec4);
    const std::uint64_t by_texels = device.limits.maxTexelBufferElements;
    const std::uint64_t by_memory = device.memory_bytes / bytes_per_particle;
    constexpr std::uint64_t by_id = 1u << 30; // an id shares a word with its fault (pack_offender)
    return std::min({by_binding, by_texels, by_memory, by_id});
}

Simulation::Simulation(const gpu::Context& context, const ParticleSet& particles, const SimulationSettings& settings)
    : context_(&context), params_(complete_params(settings.params, settings.options, checked(context, particles))),
      options_(settings.options), kernels_(context, options_), solver_(make_solver(context, settings.options, params_)),
      particles_(make_particle_buffers(context, params_.pool_count)),
      grid_(context, params_.pool_count, params_.grid_size, settings.options.still),
      params_buffer_(gpu::make_buffer<shared::SphParams>(context, 1, "params")),
      status_(gpu::make_buffer<shared::Status>(context, 1, "status")),
      readback_(context, sizeof(Readback), gpu::MemoryUse::Readback, "readback"), time_(context, params_),
      vorticity_(context, settings.options, params_.pool_count), commands_(std::make_unique<gpu::Commands>(context))
{
    dt_limit_ = params_.dt;
    particles_.moving = params_.moving_count;
    upload(context, particles, particles_);
    gpu::upload<shared::SphParams>(context, params_buffer_, {&params_, 1});
    commands_->begin();
    commands_->fill(status_, shared::NO_STEP);
    if (settings.options.implicit_viscosity) {
        viscosity_.emplace(context, settings.options, params_);
        viscosity_->record_start(*commands_);
    }
    if (settings.options.shifting) {
        shifting_.emplace(context, settings.options);
    }
    if (settings.options.capillarity) {
        capillarity_.emplace(context, settings.options, params_.pool_count);
    }
    if (VolumeRelaxation::is_needed(particles)) {
        volume_relaxation_.emplace(context);
    }
    if (particles.release_time.empty() &&
        (settings.melting || settings.hydraulic || settings.fragments || !settings.emission.empty())) {
        throw std::logic_error("Simulation: where particles may come or change, they have release times");
    }
    if (!particles.release_time.empty()) {
        if (particles.release_time.size() != particles.size() || !options_.still) {
            throw std::logic_error("Simulation: release times are for each particle, and for still ones");
        }
        erosion_.emplace(context, particles.release_time);
        erosion_commands_ = std::make_unique<gpu::Commands>(context);
        if (settings.melting) {
            melting_.emplace(context, options_, params_, *settings.melting, particles.attributes);
        }
        if (settings.wind) {
            wind_.emplace(context, params_, *settings.wind);
            wind_->record_start(*commands_);
        }
        if (settings.hydraulic) {
            hydraulic_.emplace(context, options_, *settings.hydraulic, params_.pool_count);
            hydraulic_->record_start(*commands_);
        }
        if (settings.fragments) {
            fragments_.emplace(context, options_, params_, *settings.fragments);
        }
        if (settings.melting || settings.hydraulic || settings.wind) {
            exposure_.emplace(context, options_, params_.pool_count,
                              params_.grid_size.x * params_.grid_size.y * params_.grid_size.z);
            exposure_->record_start(*commands_);
        }
        gone_ = static_cast<std::uint32_t>(std::ranges::count_if(particles.attributes, shared::is_gone));
        if (settings.dust) {
            dust_.emplace(context, *settings.dust);
        }
        if (settings.dust || settings.wind || !settings.emission.empty()) { // the ledger is that of dust, too
            emission_.emplace(context, settings.emission);
        }
    }
    solver_->record_start(*commands_, fluid());
    commands_->submit();
    commands_->wait();
    loosen_pieces(0.0);
    commands_->begin();
    record_surface(*commands_);
    commands_->submit();
    commands_->wait();
    if (wind_) {
        wind_->spread_start(context, *exposure_);
    }
}

std::uint32_t Simulation::steps_a_submission() const
{
    return std::clamp(particle_steps_per_submission / std::max(params_.moving_count, 1u), 1u, max_steps_per_submission);
}

double Simulation::longest_time(std::uint32_t steps) const
{
    double sum = 0.0;
    float limit = dt_limit_;
    for (std::uint32_t i = 0; i < steps; ++i) {
        limit = time_.adaptive() ? std::min(params_.longest_dt, limit * shared::TIME_STEP_GROWTH) : params_.dt;
        sum += static_cast<double>(limit * (1.0f + shared::LANDING_TOLERANCE));
    }
    return sum;
}

std::uint32_t Simulation::steps_until_erosion() const
{
    return erosion_ ? static_cast<std::uint32_t>(next_erosion_ - step_) : ~0u;
}

std::uint32_t Simulation::look_interval() const
{
    const std::uint32_t interval = Erosion::interval(params_.pool_count, params_.moving_count);
    double longest = erosion_->longest_look(looked_at_);
    longest = melting_ ? std::min(longest, melting_->longest_look()) : longest;
    longest = hydraulic_ ? std::min(longest, hydraulic_->longest_look()) : longest;
    longest = wind_ ? std::min(longest, wind_->longest_look()) : longest;
    const double longest_dt = static_cast<double>(time_.adaptive() ? params_.longest_dt : params_.dt);
    return static_cast<std::uint32_t>(std::clamp(longest / longest_dt, 1.0, static_cast<double>(interval)));
}

void Simulation::record_surface(gpu::Commands& commands)
{
    if (exposure_) {
        exposure_->record_changes(commands, params_buffer_, particles_, grid_, fragments_ && fragments_->bodies() > 0);
    }
    if (melting_) {
        melting_->record_surface(commands, params_buffer_, particles_, *exposure_);
    }
    if (wind_) {
        wind_->record_surface(commands, params_buffer_, particles_, *exposure_);
    }
}

void Simulation::erode(double time)
{
    if (!erosion_ || step_ < next_erosion_) {
        return;
    }
    gpu::Commands& commands = *erosion_commands_;
    const bool has_loose = fragments_ && fragments_->bodies() > 0;
    const double seconds = time - looked_at_;
    looked_at_ = time;
    commands.begin();
    if (hydraulic_) { // how fast it works says when to look again
        hydraulic_->record_scour(commands, params_buffer_, particles_, grid_, *exposure_, seconds);
        commands.submit();
        commands.wait();
        commands.begin();
    }
    const std::uint32_t interval = look_interval();
    next_erosion_ = step_ + interval;
    const double next_seconds = longest_time(interval);
    if (melting_) {
        melting_->record_heat(commands, kernels_, params_buffer_, particles_, grid_, *exposure_, seconds);
    }
    erosion_->record_look(commands, params_buffer_, particles_, static_cast<float>(time));
    if (melting_) {
        const double ahead = seconds > 0.0 ? 0.5 * next_seconds / seconds : 0.0;
        melting_->record_changes(commands, params_buffer_, particles_, grid_, erosion_->release_time(),
                                 erosion_->changes(),
                                 {.time = static_cast<float>(time), .ahead = static_cast<float>(ahead)},
                                 has_loose ? &fragments_->body_of() : nullptr);
    }
    if (hydraulic_) {
        hydraulic_->record_changes(commands, params_buffer_, particles_, grid_, erosion_->release_time(),
                                   erosion_->changes(), time, seconds, next_seconds);
    }
    if (wind_) {
        wind_->record_changes(commands, params_buffer_, particles_, grid_, *exposure_, erosion_->changes(), seconds,
                              next_seconds);
    }
    if (emission_) {
        emission_->record_calls(commands, params_buffer_, particles_, erosion_->release_time(), erosion_->changes(),
                                gone_, time, time + next_seconds);
    }
    erosion_->record_readback(commands);
    commands.submit();
    commands.wait();
    const shared::PoolChanges found = erosion_->found();
    const std::uint32_t called = std::accumulate(std::begin(found.called), std::end(found.called), 0u);
    if (emission_) {
        emission_->note_called(found);
    }
    note_picked_up(found);
    deposited_ += found.deposited;
    params_.moving_count += found.freed + called - found.died - found.frozen - found.deposited;
    particles_.moving = params_.moving_count;
    gone_ += found.died - called;
    const bool solids_change =
        found.freed + found.freed_loose + found.frozen + found.frozen_loose + found.deposited + found.slid > 0;
    const bool surface_moves = has_loose && exposure_;
    pieces_change_ = pieces_change_ || solids_change;
    const bool pieces_due = pieces_change_ && (found.freed_loose + found.frozen_loose > 0 || time >= next_pieces_);
    if (!solids_change && !surface_moves && !pieces_due && found.died + called == 0) {
        return;
    }
    part_pool();
    if (pieces_due) {
        loosen_pieces(time);
    }
    commands.begin();
    record_surface(commands);
    commands.submit();
    commands.wait();
}

void Simulation::loosen_pieces(double time)
{
    if (!fragments_) {
        return;
    }
    pieces_change_ = false;
    next_pieces_ = time + piece_delay(params_);
    const shared::PieceChanges found = fragments_->find_pieces(*erosion_commands_, params_buffer_, particles_, grid_,
                                                               erosion_->release_time(), static_cast<float>(time));
    params_.moving_count += found.loosened + found.crumbled;
    particles_.moving = params_.moving_count;
    if (found.loosened + found.crumbled + found.crumbled_loose > 0) {
        part_pool();
    }
    fragments_->make_bodies(particles_);
}

void Simulation::part_pool()
{
    gpu::Commands& commands = *erosion_commands_;
    commands.begin();
    commands.fill(params_buffer_, params_.moving_count, sizeof(std::uint32_t),
                  offsetof(shared::SphParams, moving_count));
    record_partition(commands, kernels_, params_buffer_, particles_, grid_);
    record_settle(commands, kernels_, params_buffer_, particles_, grid_);
    solver_->record_carry(commands, fluid());
    vorticity_.record_start(commands);
    if (viscosity_) {
        viscosity_->record_carry(commands, fluid());
    }
    if (capillarity_) {
        capillarity_->record_start(commands);
    }
    commands.submit();
    commands.wait();
}

void Simulation::note_picked_up(const shared::PoolChanges& found)
{
    for (std::uint32_t material = 0; material < shared::MAX_MATERIALS; ++material) {
        picked_up_ += found.picked_up[material] * static_cast<double>(params_.rest_density[material]) *
                      static_cast<double>(params_.lattice_volume);
    }
}

Simulation::Readback Simulation::submit_steps(std::uint32_t steps, double start)
{
    const double fixed_dt = time_.adaptive() ? 0.0 : static_cast<double>(params_.dt);
    for (std::uint32_t i = 0; i < steps; ++i) {
        solver_->record_step(*commands_, fluid(), static_cast<std::uint32_t>(step_ + i));
        if (fragments_) {
            fragments_->record_step(*commands_, fluid(), static_cast<std::uint32_t>(step_ + i));
        }
        if (volume_relaxation_) {
            volume_relaxation_->record(*commands_, fluid());
        }
        const auto at = static_cast<float>(start + (i + 1) * fixed_dt);
        if (dust_) {
            dust_->record(*commands_, fluid(), erosion_->release_time(), emission_->ledger(), at);
        }
        if (wind_) {
            wind_->record_step(*commands_, fluid(), emission_->ledger());
        }
        if (emission_) {
            emission_->record_step(*commands_, fluid(), erosion_->release_time(), at);
        }
    }
    commands_->copy(status_, readback_, sizeof(shared::Status), 0, offsetof(Readback, status));
    commands_->copy(time_.state(), readback_, sizeof(shared::TimeStep), 0, offsetof(Readback, time));
    commands_->submit();
    commands_->wait();
    const Readback seen = readback_.mapped<Readback>()[0];
    dt_limit_ = seen.time.limit;
    // A time that the device chose is that of the last of these steps.
    const double after = time_.adaptive() ? static_cast<double>(seen.time.elapsed)
                                          : static_cast<double>(seen.status.first_faulty_step - step_) * fixed_dt;
    check_status(seen.status, start + after);
    step_ += steps;
    return seen;
}

void Simulation::advance(std::uint32_t steps)
{
    while (steps > 0) {
        erode(seconds_);
        const std::uint32_t batch = std::min({steps, steps_a_submission(), steps_until_erosion()});
        commands_->begin();
        time_.set_remaining(*commands_, std::numeric_limits<float>::infinity());
        const Readback seen = submit_steps(batch, seconds_);
        seconds_ = time_.adaptive() ? seconds_ + static_cast<double>(seen.time.elapsed)
                                    : static_cast<double>(step_) * static_cast<double>(params_.dt); // in any portions
        steps -= batch;
    }
    wanted_seconds_ = seconds_;
}

void Simulation::advance_by(double seconds)
{
    wanted_seconds_ += seconds;
    if (!time_.adaptive()) {
        const double dt = static_cast<double>(params_.dt);
        const double wanted = wanted_seconds_;
        advance(static_cast<std::uint32_t>(std::max(std::llround((wanted - seconds_) / dt), 0LL)));
        wanted_seconds_ = wanted;
        return;
    }
    shared::TimeStep state = gpu::download<shared::TimeStep>(*context_, time_.state(), 1)[0];
    state.remaining = static_cast<float>(seconds);
    for (bool first = true; state.remaining > 0.0f; first = false) {
        erode(wanted_seconds_ - static_cast<double>(state.remaining));
        commands_->begin();
        if (first) {
            time_.set_remaining(*commands_, state.remaining);
        }
        state = submit_steps(TimeControl::least_steps(state, params_.longest_dt,
                                                      std::min(steps_a_submission(), steps_until_erosion())),
                             wanted_seconds_ - seconds)
                    .time;
    }
    seconds_ = wanted_seconds_;
}

void Simulation::check_status(const shared::Status& status, double time)
{
    if (status.first_faulty_step == shared::NO_STEP) {
        return;
    }
    throw runtime_error("the simulation broke down in step {} (after {:.6g} s) at particle {}: {}",
                        status.first_faulty_step, time, shared::offender_id(status.offender),
                        describe_fault(shared::offender_fault(status.offender)));
}

std::uint64_t Simulation::device_bytes() const
{
    std::uint64_t sum =
        solver_->device_bytes() + vorticity_.device_bytes() + (viscosity_ ? viscosity_->device_bytes() : 0);
    sum += capillarity_ ? capillarity_->device_bytes() : 0;
    sum += erosion_ ? erosion_->device_bytes() : 0;
    sum += emission_ ? emission_->device_bytes() : 0;
    sum += melting_ ? melting_->device_bytes() : 0;
    sum += wind_ ? wind_->device_bytes() : 0;
    sum += hydraulic_ ? hydraulic_->device_bytes() : 0;
    sum += exposure_ ? exposure_->device_bytes() : 0;
    sum += fragments_ ? fragments_->device_bytes() : 0;
    sum += boundary_forces_ != nullptr ? boundary_forces_->reactions().size() : 0;
    for (const gpu::Buffer* buffer : {&particles_.id,
                                      &particles_.attributes,
                                      &particles_.position,
                                      &particles_.velocity,
                                      &particles_.acceleration,
                                      &particles_.density,
                                      &particles_.pressure,
                                      &particles_.interaction,
                                      &grid_.key,
                                      &grid_.order,
                                      &grid_.cell_start,
                                      &grid_.sorted_id,
                                      &grid_.sorted_attributes,
                                      &grid_.sorted_position,
                                      &grid_.sorted_velocity,
                                      &grid_.spare,
                                      &grid_.neighbor_bits,
                                      &grid_.scratch.counts,
                                      &grid_.scratch.unordered,
                                      &grid_.scratch.slot_ids,
                                      &grid_.scratch.crowded,
                                      &grid_.scratch.scan}) {
        sum += buffer->size();
    }
    return sum;
}

ParticleSet Simulation::download() const
{
    return meltpoint::download(*context_, particles_);
}

std::vector<double> Simulation::enthalpy() const
{
    return melting_ ? melting_->heat().download_enthalpy() : std::vector<double>{};
}

std::optional<Simulation::HeatStatistics> Simulation::heat_statistics(const ParticleSet& particles) const
{
    if (!melting_) {
        return std::nullopt;
    }
    const std::vector<double> enthalpy = melting_->heat().download_enthalpy();
    const std::vector<glm::vec4> exposure = exposure_->download();
    HeatStatistics statistics;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const std::uint32_t state = shared::particle_state(particles.attributes[i]);
        if (state == shared::STATE_FLUID || state == shared::STATE_SOLID) {
            statistics.enthalpy += static_cast<double>(particles.mass[i]) * enthalpy[i];
        }
        statistics.exposed_area += state == shared::STATE_SOLID ? static_cast<double>(exposure[i].w) : 0.0;
    }
    return statistics;
}

std::vector<double> Simulation::damage() const
{
    return hydraulic_ ? hydraulic_->download_damage() : std::vector<double>{};
}

shared::Ledger Simulation::ledger() const
{
    return emission_ ? gpu::download<shared::Ledger>(*context_, emission_->ledger(), 1)[0] : shared::Ledger{};
}

std::vector<std::uint64_t> Simulation::missed_births() const
{
    return emission_ ? emission_->missed() : std::vector<std::uint64_t>{};
}

NeighborStatistics Simulation::neighbor_statistics()
{
    const std::uint32_t count = params_.moving_count;
    const gpu::Buffer counts =
        gpu::make_buffer<shared::NeighborCount>(*context_, std::max(count, 1u), "neighbor counts");
    commands_->begin();
    record_count_neighbors(*commands_, kernels_, params_buffer_, particles_, grid_, counts);
    commands_->submit();
    commands_->wait();

    NeighborStatistics statistics;
    std::uint64_t sum = 0;
    std::uint64_t movers = 0;
    const auto attributes = gpu::download<std::uint32_t>(*context_, particles_.attributes, count);
    const auto found = gpu::download<shared::NeighborCount>(*context_, counts, count);
    for (std::size_t i = 0; i < count; ++i) {
        if (!shared::is_boundary(attributes[i])) {
            sum += found[i].neighbors;
            statistics.coincident += found[i].coincident;
            ++movers;
        }
    }
    statistics.mean = movers > 0 ? static_cast<double>(sum) / static_cast<double>(movers) : 0.0;
    return statistics;
}

std::vector<Simulation::SolveStatistics> Simulation::take_statistics(const gpu::Buffer& solves, std::size_t count,
                                                                     std::uint64_t& taken_at)
{
    const auto found = gpu::download<shared::Solve>(*context_, solves, count);
    commands_->begin();
    commands_->fill(solves, 0, count * sizeof(shared::Solve));
    commands_->submit();
    commands_->wait();
    const auto steps = static_cast<double>(std::max(step_ - taken_at, std::uint64_t{1}));
    taken_at = step_;
    std::vector<SolveStatistics> statistics;
    for (const shared::Solve& solve : found) {
        statistics.push_back({.mean_iterations = solve.total_iterations / steps,
                              .worst_error = static_cast<double>(solve.worst_error),
                              .unconverged = solve.unconverged,
                              .farthest_move = std::sqrt(static_cast<double>(std::bit_cast<float>(solve.farthest))),
                              .capped = solve.capped});
    }
    return statistics;
}

std::optional<std::array<Simulation::SolveStatistics, shared::SOLVES>> Simulation::take_solve_statistics()
{
    if (solver_->solves() == nullptr) {
        return std::nullopt;
    }
    const auto found = take_statistics(*solver_->solves(), shared::SOLVES, solves_taken_at_);
    std::array<SolveStatistics, shared::SOLVES> statistics;
    std::ranges::copy(found, statistics.begin());
    return statistics;
}

std::optional<Simulation::SolveStatistics> Simulation::take_viscosity_statistics()
{
    return viscosity_ ? std::optional(take_statistics(viscosity_->state(), 1, viscosity_taken_at_)[0]) : std::nullopt;
}

void Simulation::measure_boundary_forces()
{
    const auto attributes = download().attributes;
    boundary_forces_ = std::make_unique<BoundaryForces>(*context_, options_, attributes);
    commands_->begin();
    boundary_forces_->record_reset(*commands_);
    commands_->submit();
    commands_->wait();
    forces_taken_at_ = seconds_;
}

Simulation::BoundaryForceMeans Simulation::take_boundary_forces()
{
    if (boundary_forces_ == nullptr) {
        throw std::logic_error("take_boundary_forces: nothing measures them");
    }
    const auto count = boundary_forces_->count();
    const auto sums = gpu::download<shared::Reaction>(*context_, boundary_forces_->reactions(), count);
    commands_->begin();
    boundary_forces_->record_reset(*commands_);
    commands_->submit();
    commands_->wait();
    const double seconds = seconds_ - forces_taken_at_;
    forces_taken_at_ = seconds_;
    BoundaryForceMeans means{.first_id = boundary_forces_->first_id(),
                             .pressure = std::vector<glm::dvec3>(count, glm::dvec3(0.0)),
                             .friction = std::vector<glm::dvec3>(count, glm::dvec3(0.0))};
    for (std::size_t i = 0; i < count && seconds > 0.0; ++i) {
        means.pressure[i] = glm::dvec3(sums[i].pressure) / seconds;
        means.friction[i] = glm::dvec3(sums[i].friction) / seconds;
    }
    return means;
}

void Simulation::enable_timings()
{
    const std::uint32_t scopes =
        solver_->scopes() + vorticity_.scopes() + (viscosity_ ? 1 : 0) + (shifting_ ? 1 : 0) + (capillarity_ ? 1 : 0) +
        (dust_ ? 1 : 0) + (wind_ ? Wind::scopes() : 0) + (fragments_ ? Fragments::scopes() : 0) +
        (volume_relaxation_ ? VolumeRelaxation::scopes() : 0) + (emission_ ? emission_->scopes() : 0);
    commands_ = std::make_unique<gpu::Commands>(*context_, max_steps_per_submission * scopes);
}

} // namespace meltpoint::sim
