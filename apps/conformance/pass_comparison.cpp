#include "conformance/pass_comparison.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "conformance/boundary_comparison.h"
#include "conformance/capillarity_comparison.h"
#include "conformance/device.h"
#include "conformance/dfsph_comparison.h"
#include "conformance/pbf_comparison.h"
#include "conformance/relative_error.h"
#include "conformance/viscosity_comparison.h"
#include "gpu/transfer.h"
#include "reference/boundary.h"
#include "reference/cells.h"
#include "reference/density.h"
#include "reference/dfsph.h"
#include "reference/erosion.h"
#include "reference/forces.h"
#include "reference/integrate.h"
#include "reference/measure.h"
#include "reference/pbf.h"
#include "reference/shifting.h"
#include "reference/state.h"
#include "reference/step.h"
#include "reference/vorticity.h"
#include "shared/neighbor_count.h"
#include "sim/shifting.h"
#include "sim/wcsph.h"

namespace meltpoint::conformance {

namespace {

constexpr double rounding_zone = 1e-6;

// --- the passes ---

std::vector<PassError> compare_kick_drift(Device& device, const reference::Settings& settings)
{
    reference::State twin = reference::from_particle_set(download_unordered(device.context, device.particles));
    device.run([&] {
        sim::record_kick_drift(device.commands, device.kernels, device.params_buffer, device.particles, device.status,
                               0);
    });
    reference::kick(twin, 0.5 * static_cast<double>(device.params.dt));
    reference::drift(settings, twin);

    const auto [position, velocity] = motion_error(download_unordered(device.context, device.particles), twin);
    return {{"drift: position", position.value(), pass_bound},
            {"kick: half-step velocity", velocity.value(), pass_bound}};
}

/// Whether a coordinate is so near a cell's border that float and double may disagree about the cell.
bool near_cell_border(const shared::SphParams& params, const glm::vec3& x)
{
    const glm::dvec3 cell(params.support_radius / static_cast<float>(shared::CELLS_PER_SUPPORT_X),
                          params.support_radius, params.support_radius);
    const glm::dvec3 place = (glm::dvec3(x) - glm::dvec3(params.domain_min)) / cell;
    const glm::dvec3 distance = glm::abs(place - glm::round(place));
    // A float of this size is only so fine: the border zone is the coordinate's own rounding error, at least 1e-6
    // cells.
    const glm::dvec3 zone = glm::max(glm::dvec3(rounding_zone), 4e-7 * glm::abs(glm::dvec3(x)) / cell);
    return glm::any(glm::lessThan(distance, zone));
}

std::uint32_t cell_of(const shared::SphParams& params, const glm::vec3& x)
{
    const glm::dvec3 cell(params.support_radius / static_cast<float>(shared::CELLS_PER_SUPPORT_X),
                          params.support_radius, params.support_radius);
    const glm::dvec3 place = (glm::dvec3(x) - glm::dvec3(params.domain_min)) / cell;
    const glm::uvec3 c(glm::clamp(place, glm::dvec3(0.0), glm::dvec3(params.grid_size - 1u)));
    return (c.z * params.grid_size.y + c.y) * params.grid_size.x + c.x;
}

/// Every particle once, in the slots of its cell, those of still particles behind all others, the dead last, ids
/// ascending within a cell, all attributes moved along. before: by id.
PassError sort_error(Device& device, const ParticleSet& before, const std::string& name)
{
    const ParticleSet after = download_unordered(device.context, device.particles);
    const std::uint32_t cells = device.grid.cell_count;
    const std::uint32_t keys = device.grid.still ? 2 * cells + 1 : cells;
    const auto start = gpu::download<std::uint32_t>(device.context, device.grid.cell_start, keys + 1);

    PassError result{name, 0.0, 0.0};
    std::vector<bool> seen(after.size(), false);
    for (std::uint32_t key = 0; key < keys; ++key) {
        const std::uint32_t cell = key % cells;
        for (std::uint32_t slot = start[key]; slot < start[key + 1]; ++slot) {
            const std::uint32_t id = slot < after.size() ? after.id[slot] : ~0u;
            if (id >= before.size() || seen[id] ||
                (device.grid.still && shared::is_still(after.attributes[slot]) != (key >= cells))) {
                return {name, 1.0, 0.0};
            }
            seen[id] = true;
            const bool moved_whole =
                after.position[slot] == before.position[id] && after.mass[slot] == before.mass[id] &&
                after.velocity[slot] == before.velocity[id] && after.attributes[slot] == before.attributes[id];
            const bool ascending = slot == start[key] || after.id[slot - 1] < id;
            const bool dead = shared::particle_state(after.attributes[slot]) == shared::STATE_DEAD;
            bool right_cell =
                dead && device.grid.still ? key == 2 * cells : cell_of(device.params, after.position[slot]) == cell;
            if (!right_cell && !dead && near_cell_border(device.params, after.position[slot])) {
                ++result.excluded;
                right_cell = true;
            }
            if (!moved_whole || !ascending || !right_cell) {
                return {name, 1.0, 0.0};
            }
        }
    }
    const bool complete = start[0] == 0 && start.back() == after.size() &&
                          std::count(seen.begin(), seen.end(), true) == static_cast<std::ptrdiff_t>(seen.size());
    result.error = complete ? 0.0 : 1.0;
    return result;
}

PassError compare_sort(Device& device)
{
    const ParticleSet before = download(device.context, device.particles);
    device.run([&] {
        sim::record_sort(device.commands, device.kernels, device.params_buffer, device.particles, device.grid);
    });
    return sort_error(device, before, "sort");
}

PassError compare_partition(Device& device)
{
    ParticleSet before = download(device.context, device.particles);
    for (std::size_t i = 0; i < before.size(); ++i) { // what a step has left
        const float value = static_cast<float>(i) + 1.0f;
        before.acceleration[i] = glm::vec3(value, -value, 0.5f * value);
        before.density[i] = before.pressure[i] = value;
    }
    upload(device.context, before, device.particles);
    device.run([&] {
        sim::record_partition(device.commands, device.kernels, device.params_buffer, device.particles, device.grid);
    });
    PassError error = sort_error(device, before, "partition");
    const ParticleSet after = download(device.context, device.particles);
    for (std::size_t i = 0; i < after.size(); ++i) {
        const bool carried = after.acceleration[i] == before.acceleration[i] && after.density[i] == before.density[i] &&
                             after.pressure[i] == before.pressure[i];
        error.error += carried || shared::is_boundary(after.attributes[i]) ? 0.0 : 1.0;
    }
    device.run([&] {
        sim::record_settle(device.commands, device.kernels, device.params_buffer, device.particles, device.grid);
    });
    return error;
}

/// What is read of still particles, exactly: it is copied, or two products.
PassError compare_settle(Device& device, const reference::Settings& settings, const reference::State& twin)
{
    device.run([&] {
        sim::record_settle(device.commands, device.kernels, device.params_buffer, device.particles, device.grid);
        device.vorticity.record_start(device.commands);
    });
    const std::size_t count = twin.size();
    const auto interaction = gpu::download<glm::vec4>(device.context, device.particles.interaction, count);
    const auto spare = gpu::download<glm::vec4>(device.context, device.grid.sorted_position, count);
    const auto position = gpu::download<glm::vec4>(device.context, device.particles.position, count);
    RelativeError error;
    for (std::size_t i = device.particles.moving; i < count; ++i) {
        const double volume = twin.weight[i] * static_cast<double>(settings.params.lattice_volume);
        const double friction =
            static_cast<double>(settings.params.friction[shared::particle_material(twin.attributes[i])]);
        const double viscous = static_cast<double>(settings.params.viscosity_scale) * friction * volume;
        error.add(static_cast<double>(interaction[i].y) - volume, volume);
        error.add(static_cast<double>(interaction[i].z) - viscous, viscous);
        error.add(static_cast<double>(interaction[i].x) + (spare[i] == position[i] ? 0.0 : 1.0), 1.0);
    }
    return {"settle", error.value(), pass_bound};
}

/// How many of these the device finds, and the sum of their ids: a pool that was parted has the dead in no cell.
std::pair<std::uint32_t, std::uint32_t> count_found(const Device& device, const reference::State& twin,
                                                    std::span<const reference::Neighbor> neighbors)
{
    std::uint32_t count = 0;
    std::uint32_t id_sum = 0;
    for (const reference::Neighbor& neighbor : neighbors) {
        const std::uint32_t state = shared::particle_state(twin.attributes[neighbor.index]);
        if (!device.grid.still || state != shared::STATE_DEAD) {
            ++count;
            id_sum += twin.id[neighbor.index];
        }
    }
    return {count, id_sum};
}

/// The sets of neighbors, by their size and the sum of their ids.
PassError compare_neighbors(Device& device, const reference::State& twin)
{
    const std::uint32_t count = device.particles.moving;
    const gpu::Buffer counts = gpu::make_buffer<shared::NeighborCount>(device.context, count, "neighbor counts");
    device.run([&] {
        sim::record_count_neighbors(device.commands, device.kernels, device.params_buffer, device.particles,
                                    device.grid, counts);
    });
    const auto gpu = gpu::download<shared::NeighborCount>(device.context, counts, count);

    // Sets of a slightly smaller and a slightly larger support radius bracket what rounding may decide.
    const auto neighbors_within = [&](float factor) {
        shared::SphParams params = device.params;
        params.wall_mask = 0;
        params.support_radius *= factor;
        return reference::find_neighbors(params, twin.position);
    };
    const reference::Neighbors fewest = neighbors_within(1.0f - static_cast<float>(rounding_zone));
    const reference::Neighbors most = neighbors_within(1.0f + static_cast<float>(rounding_zone));
    PassError result{"neighbors", 0.0, 0.0};
    std::uint64_t wrong = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const auto [least, id_sum] = count_found(device, twin, fewest.of(i));
        const auto [greatest, other_sum] = count_found(device, twin, most.of(i));
        result.excluded += greatest - least;
        const bool right = greatest == least ? gpu[i].neighbors == least && gpu[i].id_sum == id_sum
                                             : gpu[i].neighbors >= least && gpu[i].neighbors <= greatest;
        wrong += right ? 0 : 1;
    }
    result.error = static_cast<double>(wrong) / std::max(count, 1u);
    return result;
}

std::vector<PassError> compare_density(Device& device, const reference::Settings& settings, reference::State& twin,
                                       const reference::Neighbors& neighbors)
{
    device.run([&] {
        sim::record_density(device.commands, device.kernels, device.params_buffer, device.particles, device.grid);
    });
    reference::update_density(settings, twin, neighbors);

    const ParticleSet gpu = download_unordered(device.context, device.particles);
    const double c2 = std::pow(static_cast<double>(device.params.speed_of_sound), 2);
    RelativeError density;
    RelativeError pressure;
    std::uint64_t clamp_flips = 0;
    for (std::size_t i = 0; i < gpu.size(); ++i) {
        const double rho0 = reference::rest_density(settings, twin, i);
        density.add(static_cast<double>(gpu.density[i]) - twin.density[i], twin.density[i]);
        if (std::abs(twin.density[i] - rho0) < rounding_zone * rho0 && device.params.clamp_pressure != 0) {
            ++clamp_flips;
            continue;
        }
        pressure.add(static_cast<double>(gpu.pressure[i]) - twin.pressure[i],
                     std::max(c2 * rho0, std::abs(twin.pressure[i])));
    }
    std::vector<PassError> errors{{"density", density.value(), pass_bound}};
    if (settings.solver == shared::SOLVER_WCSPH) { // solved pressure is none of this pass, which leaves the old one
        errors.push_back({"pressure", pressure.value(), pass_bound, clamp_flips});
    }
    return errors;
}

PassError compare_boundary_weight(Device& device, const reference::Settings& settings, reference::State& twin,
                                  const reference::Neighbors& neighbors)
{
    device.run([&] {
        sim::record_boundary_weight(device.commands, device.kernels, device.params_buffer, device.particles,
                                    device.grid);
    });
    reference::update_boundary_weights(settings, twin, neighbors);
    const ParticleSet gpu = download_unordered(device.context, device.particles);
    RelativeError error;
    for (std::size_t i = 0; i < gpu.size(); ++i) {
        error.add(static_cast<double>(gpu.weight[i]) - twin.weight[i], twin.weight[i]);
    }
    return {"boundary weight", error.value(), pass_bound};
}

PassError compare_forces(Device& device, const reference::Settings& settings, const reference::Neighbors& neighbors)
{
    device.run([&] {
        sim::record_forces(device.commands, device.kernels, device.params_buffer, device.particles, device.grid);
    });
    const ParticleSet gpu = download_unordered(device.context, device.particles);
    const reference::State input = reference::from_particle_set(gpu); // with the device's density and pressure
    const reference::Accelerations twin = reference::accelerations(settings, input, neighbors);
    RelativeError error;
    for (std::size_t i = 0; i < gpu.size(); ++i) {
        error.add(gpu.acceleration[i], twin.total[i].value, twin.total[i].magnitude);
    }
    return {"forces", error.value(), pass_bound};
}

/// The vorticity, and what confinement makes of the device's, over the sum of the absolute values of the vorticity's
/// terms.
PassError compare_confinement(Device& device, const reference::Settings& settings,
                              const reference::Neighbors& neighbors)
{
    const reference::State before = reference::from_particle_set(download_unordered(device.context, device.particles));
    device.run([&] {
        device.vorticity.record_confinement(device.commands, device.kernels, device.params_buffer, device.particles,
                                            device.grid);
    });
    const ParticleSet gpu = download_unordered(device.context, device.particles);
    const auto found = gpu::download<glm::vec4>(device.context, *device.vorticity.vorticity(), gpu.size());
    std::vector<glm::dvec3> vorticities;
    for (const glm::vec4& v : found) {
        vorticities.emplace_back(v.x, v.y, v.z);
    }
    RelativeError error;
    for (std::size_t i = 0; i < gpu.size(); ++i) {
        if (!reference::is_boundary(before, i)) {
            const reference::VectorSum vorticity = reference::vorticity(settings, before, neighbors, i);
            error.add(glm::length(vorticities[i] - vorticity.value), vorticity.magnitude);
            const glm::dvec3 change = reference::confinement(settings, before, neighbors, vorticities, i);
            const double scale = static_cast<double>(device.params.vorticity_confinement) * vorticity.magnitude;
            error.add(gpu.acceleration[i], before.acceleration[i] + change,
                      glm::length(before.acceleration[i]) + scale);
        }
    }
    return {"confinement", error.value(), pass_bound};
}

PassError compare_xsph(Device& device, const reference::Settings& settings, const reference::Neighbors& neighbors)
{
    const reference::State before = reference::from_particle_set(download_unordered(device.context, device.particles));
    device.run([&] {
        device.vorticity.record_xsph(device.commands, device.kernels, device.params_buffer, device.particles,
                                     device.grid);
    });
    const ParticleSet gpu = download_unordered(device.context, device.particles);
    RelativeError error;
    for (std::size_t i = 0; i < gpu.size(); ++i) {
        reference::VectorSum change;
        if (!reference::is_boundary(before, i)) {
            change = reference::smoothing(settings, before, neighbors, i);
        }
        error.add(gpu.velocity[i], before.velocity[i] + change.value,
                  glm::length(before.velocity[i]) + change.magnitude);
    }
    return {"xsph", error.value(), pass_bound};
}

PassError compare_shift(Device& device, const sim::FluidOptions& options, const reference::Settings& settings,
                        const reference::Neighbors& neighbors)
{
    const sim::Shifting shifting(device.context, options);
    const reference::State before = reference::from_particle_set(download_unordered(device.context, device.particles));
    device.run(
        [&] { shifting.record(device.commands, device.kernels, device.params_buffer, device.particles, device.grid); });
    const ParticleSet gpu = download_unordered(device.context, device.particles);
    const double cap = static_cast<double>(shared::SHIFT_CAP) * static_cast<double>(device.params.spacing);
    RelativeError error;
    for (std::size_t i = 0; i < gpu.size(); ++i) {
        glm::dvec3 shift(0.0);
        double magnitude = 0.0;
        if (!reference::is_boundary(before, i)) {
            shift = reference::shift(settings, before, neighbors, i);
            magnitude = std::min(reference::wanted_shift(settings, before, neighbors, i).magnitude, cap);
        }
        // A shift is small against the position that it is added to, whose rounding is no error of the pass.
        const glm::dvec3 expected = reference::wrap_position(device.params, before.position[i] + shift);
        const glm::dvec3 rounding = 4.0 * static_cast<double>(std::numeric_limits<float>::epsilon()) *
                                    glm::max(glm::abs(before.position[i]), glm::abs(expected));
        const glm::dvec3 difference = glm::abs(glm::dvec3(gpu.position[i]) - expected) - rounding;
        error.add(glm::length(glm::max(difference, glm::dvec3(0.0))), magnitude);
    }
    return {"shift", error.value(), pass_bound};
}

PassError compare_kick(Device& device)
{
    reference::State twin = reference::from_particle_set(download_unordered(device.context, device.particles));
    device.run([&] { sim::record_kick(device.commands, device.kernels, device.params_buffer, device.particles); });
    reference::kick(twin, 0.5 * static_cast<double>(device.params.dt));
    const ParticleSet gpu = download_unordered(device.context, device.particles);
    RelativeError error;
    for (std::size_t i = 0; i < gpu.size(); ++i) {
        error.add(gpu.velocity[i], twin.velocity[i], glm::length(twin.velocity[i]));
    }
    return {"kick: velocity", error.value(), pass_bound};
}

} // namespace

std::vector<PassError> compare_passes(const gpu::Context& context, const ParticleSet& particles,
                                      const sim::SimulationSettings& settings)
{
    Device device(context, particles, settings);
    const reference::Settings twin_settings = reference_settings(device.params, settings);

    std::vector<PassError> errors;
    if (device.grid.still) {
        errors.push_back(compare_partition(device));
    }
    for (PassError& error : compare_kick_drift(device, twin_settings)) {
        errors.push_back(std::move(error));
    }
    errors.push_back(compare_sort(device));
    reference::State twin = reference::from_particle_set(download_unordered(context, device.particles));
    const reference::Neighbors neighbors = reference::find_neighbors(device.params, twin.position);
    errors.push_back(compare_neighbors(device, twin));
    errors.push_back(compare_boundary_weight(device, twin_settings, twin, neighbors));
    if (device.grid.still) {
        errors.push_back(compare_settle(device, twin_settings, twin));
    }
    for (PassError& error : compare_density(device, twin_settings, twin, neighbors)) {
        errors.push_back(std::move(error));
    }
    if (settings.options.solver == shared::SOLVER_DFSPH) {
        for (PassError& error : compare_dfsph_passes(device, settings.options, twin_settings, twin, neighbors)) {
            errors.push_back(std::move(error));
        }
    }
    if (settings.options.implicit_viscosity) {
        for (PassError& error : compare_viscosity_passes(device, settings.options, twin_settings, twin, neighbors)) {
            errors.push_back(std::move(error));
        }
    }
    if (settings.options.solver == shared::SOLVER_PBF) {
        for (PassError& error : compare_pbf_passes(device, settings.options, twin_settings, twin, neighbors)) {
            errors.push_back(std::move(error));
        }
    }
    errors.push_back(compare_forces(device, twin_settings, neighbors));
    for (PassError& error : compare_boundary_forces(device, settings.options, twin_settings, neighbors)) {
        errors.push_back(std::move(error));
    }
    if (settings.options.confinement) {
        errors.push_back(compare_confinement(device, twin_settings, neighbors));
    }
    if (settings.options.capillarity) {
        for (PassError& error : compare_capillarity(device, settings.options, twin_settings, neighbors)) {
            errors.push_back(std::move(error));
        }
    }
    if (settings.options.xsph) {
        errors.push_back(compare_xsph(device, twin_settings, neighbors));
    }
    errors.push_back(compare_kick(device));
    if (settings.options.shifting) { // last: neighbors are those of before
        errors.push_back(compare_shift(device, settings.options, twin_settings, neighbors));
    }
    return errors;
}

std::vector<PassError> compare_steps(const gpu::Context& context, const ParticleSet& particles,
                                     const sim::SimulationSettings& settings, std::uint32_t steps)
{
    sim::Simulation simulation(context, particles, settings);
    const reference::Settings twin_settings = reference_settings(simulation.params(), settings);
    reference::State twin = reference::from_particle_set(particles);
    reference::evaluate(twin_settings, twin);
    reference::WarmStarts warm_starts;
    const auto twin_step = [&] {
        if (settings.options.solver == shared::SOLVER_DFSPH) {
            (void)reference::dfsph_step(twin_settings, twin, warm_starts);
        } else if (settings.options.solver == shared::SOLVER_PBF) {
            (void)reference::pbf_step(twin_settings, twin);
        } else {
            reference::step(twin_settings, twin);
        }
    };
    const double start_energy = reference::kinetic_energy(twin) + reference::potential_energy(twin_settings, twin);

    simulation.advance(steps);
    std::uint32_t next_look = 0;
    for (std::uint32_t i = 0; i < steps; ++i) {
        if (!particles.release_time.empty() && i == next_look) {
            (void)reference::release(twin, particles.release_time, i * static_cast<double>(settings.params.dt));
            const auto moving = std::ranges::count_if(
                twin.attributes, [](std::uint32_t attributes) { return !shared::is_still(attributes); });
            next_look =
                i + sim::Erosion::interval(static_cast<std::uint32_t>(twin.size()), static_cast<std::uint32_t>(moving));
        }
        twin_step();
    }
    const reference::State gpu = reference::from_particle_set(simulation.download());

    if (steps == 1) {
        const reference::Neighbors neighbors = reference::find_neighbors(simulation.params(), twin.position);
        const reference::Accelerations terms = reference::accelerations(twin_settings, twin, neighbors);
        // Near rest the terms vanish with the pressure, which itself is right to within rounding of c0^2 rho0.
        const double c0 = static_cast<double>(simulation.params().speed_of_sound);
        const double pressure_scale = c0 * c0 / static_cast<double>(simulation.params().support_radius);
        const double dt = static_cast<double>(simulation.params().dt);
        RelativeError position;
        RelativeError velocity;
        for (std::size_t i = 0; i < twin.size(); ++i) {
            position.add(glm::length(gpu.position[i] - twin.position[i]), glm::length(twin.position[i]));
            velocity.add(glm::length(gpu.velocity[i] - twin.velocity[i]),
                         glm::length(twin.velocity[i]) + dt * (terms.total[i].magnitude + pressure_scale));
        }
        return {{"1 step: position", position.value(), pass_bound}, {"1 step: velocity", velocity.value(), pass_bound}};
    }

    // Where nothing moves and nothing can fall, only what pressures right to within pass_bound stir up is left.
    const double c0 = static_cast<double>(simulation.params().speed_of_sound);
    const double seconds = steps * static_cast<double>(simulation.params().dt);
    const double stir = pass_bound * seconds * c0 * c0 / static_cast<double>(simulation.params().support_radius);
    const double energy_scale =
        std::max({std::abs(start_energy),
                  reference::kinetic_energy(twin) + std::abs(reference::potential_energy(twin_settings, twin)),
                  0.5 * reference::total_mass(twin) * stir * stir});
    const double energy_error =
        std::abs(reference::kinetic_energy(gpu) - reference::kinetic_energy(twin)) +
        std::abs(reference::potential_energy(twin_settings, gpu) - reference::potential_energy(twin_settings, twin));
    const double center_error = glm::length(reference::center_of_mass(gpu) - reference::center_of_mass(twin));
    const glm::dvec3 extent = glm::dvec3(simulation.params().domain_max) - glm::dvec3(simulation.params().domain_min);
    return {{fmt::format("{} steps: energy", steps), energy_error / energy_scale, run_bound},
            {fmt::format("{} steps: center of mass", steps), center_error / glm::length(extent), run_bound}};
}

} // namespace meltpoint::conformance
