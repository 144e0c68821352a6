#include "run/collider_forces.h"

#include <fmt/format.h>

namespace meltpoint {

std::vector<ColliderForce> collider_forces(const sim::Simulation::BoundaryForceMeans& means,
                                           std::span<const ColliderParticles> colliders)
{
    std::vector<ColliderForce> forces;
    for (const ColliderParticles& collider : colliders) {
        ColliderForce force;
        for (std::size_t i = 0; i < collider.points.size(); ++i) {
            const std::size_t at = collider.first_id - means.first_id + i;
            force.pressure += means.pressure[at];
            force.friction += means.friction[at];
            force.torque +=
                glm::cross(glm::dvec3(collider.points[i]) - collider.center, means.pressure[at] + means.friction[at]);
        }
        forces.push_back(force);
    }
    return forces;
}

std::string_view forces_header()
{
    return "frame,time,collider,force_x,force_y,force_z,pressure_x,pressure_y,pressure_z,friction_x,friction_y,"
           "friction_z,torque_x,torque_y,torque_z\n";
}

std::string forces_rows(std::uint32_t frame, double time, std::span<const ColliderForce> forces)
{
    std::string rows;
    for (std::size_t c = 0; c < forces.size(); ++c) {
        rows += fmt::format("{},{},{}", frame, time, c);
        const ColliderForce& force = forces[c];
        for (const glm::dvec3& each : {force.total(), force.pressure, force.friction, force.torque}) {
            rows += frame > 0 ? fmt::format(",{},{},{}", each.x, each.y, each.z) : ",,,";
        }
        rows += "\n";
    }
    return rows;
}

} // namespace meltpoint
