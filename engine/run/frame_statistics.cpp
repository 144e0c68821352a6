#include "run/frame_statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace meltpoint {

namespace {

void count_state(FrameStatistics& statistics, std::uint32_t state)
{
    switch (state) {
    case shared::STATE_SOLID:
        ++statistics.solid;
        break;
    case shared::STATE_FLUID:
        ++statistics.fluid;
        break;
    case shared::STATE_DUST:
        ++statistics.dust;
        break;
    case shared::STATE_COLLIDER:
        ++statistics.collider;
        break;
    default:
        ++statistics.dead;
        break;
    }
}

/// The corner of the domain farthest along gravity: the lowest place.
glm::dvec3 lowest_corner(const shared::SphParams& params)
{
    glm::dvec3 corner;
    for (int axis = 0; axis < 3; ++axis) {
        corner[axis] =
            static_cast<double>(params.gravity[axis] > 0.0f ? params.domain_max[axis] : params.domain_min[axis]);
    }
    return corner;
}

/// A number that reads back as itself, or nothing where it is not finite.
std::string cell(double value)
{
    return std::isfinite(value) ? fmt::format("{}", value) : "";
}

std::string cells(const glm::dvec3& value)
{
    return cell(value.x) + "," + cell(value.y) + "," + cell(value.z);
}

} // namespace

FrameStatistics measure(const ParticleSet& particles, const shared::SphParams& params)
{
    FrameStatistics statistics;
    FrameStatistics::Fluid fluid;
    fluid.min = glm::dvec3(std::numeric_limits<double>::infinity());
    fluid.max = -fluid.min;
    double fluid_mass = 0.0;
    const glm::dvec3 gravity(params.gravity);
    const glm::dvec3 lowest = lowest_corner(params);
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const std::uint32_t attributes = particles.attributes[i];
        const std::uint32_t state = shared::particle_state(attributes);
        count_state(statistics, state);
        const auto mass = static_cast<double>(particles.mass[i]);
        if (state != shared::STATE_SOLID) { // the dead, too: what a sink has taken was freed
            statistics.freed_mass[shared::cause_of(attributes)] += mass;
        }
        if (state == shared::STATE_DEAD) {
            continue;
        }
        const glm::dvec3 x(particles.position[i]);
        const glm::dvec3 v(particles.velocity[i]);
        statistics.mass += mass;
        statistics.kinetic_energy += 0.5 * mass * glm::dot(v, v);
        statistics.potential_energy -= mass * glm::dot(gravity, x - lowest);
        statistics.momentum += mass * v;
        statistics.outside += (attributes & shared::FLAG_LEFT_DOMAIN) != 0 ? 1 : 0;
        if (state == shared::STATE_SOLID) {
            statistics.solid_volume +=
                mass / static_cast<double>(params.rest_density[shared::particle_material(attributes)]);
        }
        if (state != shared::STATE_FLUID) {
            continue;
        }
        fluid_mass += mass;
        fluid.center_of_mass += mass * x;
        fluid.min = glm::min(fluid.min, x);
        fluid.max = glm::max(fluid.max, x);
        fluid.speed_max = std::max(fluid.speed_max, glm::length(v));
        const auto rest_density = static_cast<double>(params.rest_density[shared::particle_material(attributes)]);
        const double error = std::max(static_cast<double>(particles.density[i]) / rest_density - 1.0, 0.0);
        fluid.density_error_mean += error;
        fluid.density_error_max = std::max(fluid.density_error_max, error);
    }
    if (statistics.fluid > 0) {
        fluid.center_of_mass /= fluid_mass;
        fluid.density_error_mean /= static_cast<double>(statistics.fluid);
        statistics.fluid_part = fluid;
    }
    return statistics;
}

std::string_view statistics_header()
{
    return "frame,time,steps,dt,solid,fluid,dust,collider,dead,mass,kinetic_energy,potential_energy,momentum_x,"
           "momentum_y,"
           "momentum_z,com_x,com_y,com_z,min_x,min_y,min_z,max_x,max_y,max_z,density_error_mean,density_error_max,"
           "speed_max,"
           "outside,neighbors_mean,simulate_ms,draw_ms,iterations_density,iterations_divergence,iterations_viscosity,"
           "deposited,enthalpy,solid_volume,exposed_area,fragments,emitted,sunk,rate_melt,rate_hydraulic,rate_wind,"
           "rate_dissolve\n";
}

std::string statistics_row(const FrameStatistics& s)
{
    std::string row = fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}", s.frame, cell(s.time), s.steps, cell(s.dt),
                                  s.solid, s.fluid, s.dust, s.collider, s.dead, cell(s.mass), cell(s.kinetic_energy),
                                  cell(s.potential_energy), cells(s.momentum));
    if (s.fluid_part) {
        const FrameStatistics::Fluid& f = *s.fluid_part;
        row += fmt::format(",{},{},{},{},{},{}", cells(f.center_of_mass), cells(f.min), cells(f.max),
                           cell(f.density_error_mean), cell(f.density_error_max), cell(f.speed_max));
    } else {
        row += ",,,,,,,,,,,,";
    }
    const auto cell_or_empty = [](const std::optional<double>& value) {
        return value ? cell(*value) : std::string();
    };
    row += fmt::format(",{},{},{:.3f},{:.3f},{},{},{}", s.outside, cell_or_empty(s.neighbors_mean), s.simulate_ms,
                       s.draw_ms, cell_or_empty(s.iterations_density), cell_or_empty(s.iterations_divergence),
                       cell_or_empty(s.iterations_viscosity));
    row +=
        fmt::format(",{},{},{},{},{},{},{},{},{},{},{}\n", s.deposited ? fmt::format("{}", *s.deposited) : "",
                    cell_or_empty(s.enthalpy), cell(s.solid_volume), cell_or_empty(s.exposed_area),
                    s.fragments ? fmt::format("{}", *s.fragments) : "", s.emitted, s.sunk, cell_or_empty(s.rate_melt),
                    cell_or_empty(s.rate_hydraulic), cell_or_empty(s.rate_wind), cell_or_empty(s.rate_dissolve));
    return row;
}

} // namespace meltpoint
