#include "run/taken_space.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/parallel_for.h"
#include "geometry/point_cells.h"

namespace meltpoint {

namespace {

// Fluids that lie side by side are as far apart as neighbors in them. Any nearer, and they overlap.
constexpr float touching = 0.97f;

// Spacings: where two fluids meet in no particular way, particles farther apart than this start without pressure: a
// particle may face the hollow between four others. Measured: from 1.1 on there is no kick.
constexpr float fluid_clearance = 1.15f;

} // namespace

TakenSpace::TakenSpace(const glm::vec3& period) : shifts_{glm::vec3(0.0f)}
{
    for (int axis = 0; axis < 3; ++axis) {
        const std::vector<glm::vec3> before = shifts_;
        for (const float sign : {-1.0f, 1.0f}) {
            for (glm::vec3 shift : before) {
                shift[axis] = sign * period[axis];
                if (period[axis] > 0.0f) {
                    shifts_.push_back(shift);
                }
            }
        }
    }
}

void TakenSpace::add(const std::string& name, const ColliderSamples& collider, float clearance)
{
    add({.name = name, .points = collider.points, .clearance = clearance, .solid = collider.inside});
}

void TakenSpace::add(const std::string& name, const std::vector<glm::vec3>& fluid, const Pitch& pitch)
{
    add({.name = name, .points = fluid, .pitch = pitch, .is_fluid = true});
}

void TakenSpace::add(Body body)
{
    for (const glm::vec3& x : body.points) {
        body.box.extend(x);
    }
    if (body.solid != nullptr) { // of which the points may be only what lies in the domain
        body.box.extend(body.solid->bounds().min);
        body.box.extend(body.solid->bounds().max);
    }
    bodies_.push_back(std::move(body));
}

std::vector<std::uint8_t> TakenSpace::find_taken(const Body& body, const std::vector<glm::vec3>& points,
                                                 float clearance) const
{
    std::vector<std::uint8_t> taken(points.size(), 0);
    for (const glm::vec3& shift : shifts_) {
        mark_taken(body, points, shift, clearance, taken);
    }
    return taken;
}

void TakenSpace::mark_taken(const Body& body, const std::vector<glm::vec3>& points, const glm::vec3& shift,
                            float clearance, std::vector<std::uint8_t>& taken)
{
    const Aabb near{body.box.min - clearance, body.box.max + clearance};
    if (std::ranges::none_of(points, [&](const glm::vec3& x) { return near.contains(x + shift); })) {
        return;
    }
    const PointCells cells(body.points, static_cast<double>(clearance));
    const auto is_near_a_point = [&](const glm::vec3& x) {
        bool found = false;
        cells.visit_near(glm::dvec3(x), [&](std::uint32_t place) {
            found = found || glm::distance(body.points[cells.order()[place]], x) < clearance;
        });
        return found;
    };
    parallel_for(points.size(), [&](std::size_t i) {
        const glm::vec3 x = points[i] + shift;
        if (taken[i] == 0 && near.contains(x)) {
            const bool inside = body.solid != nullptr && body.solid->contains(glm::dvec3(x));
            taken[i] = inside || is_near_a_point(x) ? 1 : 0;
        }
    });
}

std::vector<std::uint8_t> TakenSpace::find_taken_by_fluid(const Body& body, const std::vector<glm::vec3>& points,
                                                          const Pitch& pitch) const
{
    const auto count = [](const std::vector<std::uint8_t>& taken) {
        return std::ranges::count(taken, 1);
    };
    const float nearest = std::min(pitch.nearest, body.pitch.nearest);
    std::vector<std::uint8_t> overlapping = find_taken(body, points, touching * nearest);
    // Each on another's place: one lattice, of which the rest fits.
    const bool in_step = count(find_taken(body, points, (1.0f - touching) * nearest)) == count(overlapping);
    return in_step ? overlapping
                   : find_taken(body, points, fluid_clearance * std::max(pitch.spacing, body.pitch.spacing));
}

void TakenSpace::clear(const std::string& name, std::vector<glm::vec3>& fluid, const Pitch& pitch,
                       std::vector<std::string>& notes) const
{
    for (const Body& body : bodies_) {
        std::vector<std::uint8_t> taken;
        if (!body.is_fluid) {
            taken = find_taken(body, fluid, body.clearance);
        } else {
            taken = find_taken_by_fluid(body, fluid, pitch);
        }
        const auto count = std::count(taken.begin(), taken.end(), 1);
        if (count == 0) {
            continue;
        }
        notes.push_back(fmt::format("{} of the {} particles of {} would start {} {} and are left out", count,
                                    fluid.size(), name, body.is_fluid ? "in" : "in or against", body.name));
        std::size_t kept = 0;
        for (std::size_t i = 0; i < fluid.size(); ++i) {
            if (taken[i] == 0) {
                fluid[kept++] = fluid[i];
            }
        }
        fluid.resize(kept);
    }
}

} // namespace meltpoint
