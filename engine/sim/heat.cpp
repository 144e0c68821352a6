#include "sim/heat.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "core/error.h"
#include "gpu/transfer.h"
#include "particles/sph_kernel.h"
#include "spirv/sim/conduction.comp.h"
#include "spirv/sim/temperature.comp.h"

namespace meltpoint::sim {

using gpu::read;
using gpu::read_write;
using gpu::write;

namespace {

bool conducts(const shared::HeatMaterial& its)
{
    return its.solid_conductivity > 0.0f || its.fluid_conductivity > 0.0f;
}

void check_material(const shared::SphParams& params, const shared::HeatMaterial& its, std::uint32_t attributes)
{
    const std::uint32_t material = shared::particle_material(attributes);
    if (!(std::min({its.solid_conductivity, its.fluid_conductivity, its.latent_heat}) >= 0.0f)) {
        throw input_error("material {}: conductivity and latent heat must not be negative", material);
    }
    if (conducts(its) && !(std::min(its.solid_specific_heat, its.fluid_specific_heat) > 0.0f)) {
        throw input_error("material {} conducts heat, so its specific heats must be greater than zero", material);
    }
    const bool has_mass = shared::particle_state(attributes) != shared::STATE_COLLIDER;
    if (conducts(its) && has_mass && !(params.rest_density[material] > 0.0f)) {
        throw input_error("material {} conducts heat, so its density must be greater than zero", material);
    }
}

/// m^2/s, the largest of the particles' diffusivities; each with the conductivity that it has amid the best conductor
/// that there is. Colliders hold their temperature, so they have none.
double largest_diffusivity(const shared::SphParams& params, const shared::HeatParams& heat,
                           std::span<const std::uint32_t> attributes)
{
    float best = 0.0f; // W/(m K)
    for (const std::uint32_t each : attributes) {
        const shared::HeatMaterial& its = heat.of[shared::particle_material(each)];
        check_material(params, its, each);
        best = std::max({best, its.solid_conductivity, its.fluid_conductivity});
    }
    double largest = 0.0;
    for (const std::uint32_t each : attributes) {
        const std::uint32_t material = shared::particle_material(each);
        const shared::HeatMaterial& its = heat.of[material];
        if (conducts(its) && shared::particle_state(each) != shared::STATE_COLLIDER) {
            const float solid =
                0.5f * shared::pair_conductivity(its.solid_conductivity, best) / its.solid_specific_heat;
            const float fluid =
                0.5f * shared::pair_conductivity(its.fluid_conductivity, best) / its.fluid_specific_heat;
            largest = std::max(largest, static_cast<double>(std::max(solid, fluid) / params.rest_density[material]));
        }
    }
    return largest;
}

/// degrees C: of a material that conducts, its melting point.
float common_temperature(const shared::HeatParams& heat)
{
    const auto* const found = std::find_if(std::begin(heat.of), std::end(heat.of), conducts);
    return found != std::end(heat.of) ? found->melting_point : 0.0f;
}

std::vector<glm::vec2> two_floats(std::span<const double> values)
{
    std::vector<glm::vec2> parts(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto large = static_cast<float>(values[i]);
        parts[i] = {large, static_cast<float>(values[i] - static_cast<double>(large))};
    }
    return parts;
}

} // namespace

Heat::Heat(const gpu::Context& context, const FluidOptions& options, const shared::SphParams& params,
           const shared::HeatParams& heat, std::span<const std::uint32_t> attributes, std::span<const double> enthalpy)
    : context_(&context), temperature_(context, "temperature", sim_temperature_comp),
      conduction_(context, "conduction", sim_conduction_comp, fluid_constants(context.info(), options)),
      longest_substep_(1.0 / (largest_diffusivity(params, heat, attributes) *
                              largest_conduction_eigenvalue(options.kernel, static_cast<double>(params.support_radius),
                                                            static_cast<double>(params.spacing), options.dimensions))),
      count_(enthalpy.size()), params_(gpu::make_buffer<shared::HeatParams>(context, 1, "heat params")),
      enthalpy_(gpu::make_buffer<glm::vec2>(context, count_, "enthalpy")),
      thermal_(gpu::make_texel_buffer(context, count_, "thermal")),
      warm_cells_(gpu::make_buffer<std::uint32_t>(
          context, std::size_t{shared::warm_words(params.grid_size.x)} * params.grid_size.y * params.grid_size.z,
          "warm cells")),
      common_temperature_(common_temperature(heat))
{
    if (attributes.size() != count_) {
        throw std::logic_error("Heat: enthalpy and attributes are of each particle");
    }
    gpu::upload<shared::HeatParams>(context, params_, {&heat, 1});
    gpu::upload<glm::vec2>(context, enthalpy_, two_floats(enthalpy));
}

std::uint32_t Heat::substeps(double seconds) const
{
    const double steps = std::ceil(seconds / longest_substep_);
    if (!(steps <= max_substeps)) {
        throw input_error("conduction of heat over {:.3g} s takes {:.0f} steps of at most {:.3g} s, more than {}: make "
                          "time run slower for heat (heat.time_scale), or the particles coarser (particles.spacing)",
                          seconds, steps, longest_substep_, max_substeps);
    }
    return static_cast<std::uint32_t>(steps);
}

void Heat::record_conduction(gpu::Commands& commands, const FluidKernels& kernels, const gpu::Buffer& params,
                             const ParticleBuffers& particles, const NeighborGrid& grid, double seconds) const
{
    const std::uint32_t steps = substeps(seconds);
    const gpu::Scope scope(commands, "conduction");
    for (std::uint32_t step = 0; step < steps; ++step) {
        commands.fill(warm_cells_, 0);
        commands.dispatch(temperature_, particles.count, common_temperature_,
                          {read(params), read(params_), read(particles.id), read(particles.attributes),
                           read(particles.position), read(particles.velocity), read(enthalpy_), write(thermal_),
                           gpu::read_write(warm_cells_)});
        commands.dispatch(conduction_, kernels.tiles(particles.count), static_cast<float>(seconds / steps),
                          {read(params), read(grid.cell_start), read(particles.position), read(particles.position),
                           read(thermal_), read(thermal_), read(particles.id), read_write(enthalpy_),
                           read(warm_cells_)});
    }
}

std::vector<double> Heat::download_enthalpy() const
{
    const auto parts = gpu::download<glm::vec2>(*context_, enthalpy_, count_);
    std::vector<double> values(count_);
    for (std::size_t i = 0; i < count_; ++i) {
        values[i] = static_cast<double>(parts[i].x) + static_cast<double>(parts[i].y);
    }
    return values;
}

} // namespace meltpoint::sim
