#include "sim/fragments.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "gpu/transfer.h"
#include "spirv/sim/piece_census.comp.h"
#include "spirv/sim/piece_hook.comp.h"
#include "spirv/sim/piece_jump.comp.h"
#include "spirv/sim/piece_loosen.comp.h"
#include "spirv/sim/piece_start.comp.h"
#include "spirv/sim/rigid_step.comp.h"
#include "spirv/sim/rigid_touch.comp.h"

namespace meltpoint::sim {

using gpu::read;
using gpu::read_write;
using gpu::write;

namespace {

constexpr std::uint32_t rounds_per_submission = 4;

/// Of passes that look for the forces of moving fluid alone. Pressure of position based fluids is found like a force.
FluidOptions of_moving(FluidOptions options)
{
    options.still = false;
    options.solver = options.solver == shared::SOLVER_PBF ? shared::SOLVER_WCSPH : options.solver;
    return options;
}

/// Anyone may be a solid once.
std::vector<std::uint32_t> all_solid(std::uint32_t pool)
{
    return std::vector<std::uint32_t>(pool, shared::pack_attributes(shared::STATE_SOLID, 0));
}

/// A loose particle as it is found.
struct Loose {
    std::uint32_t piece;
    std::uint32_t id;
    glm::dvec3 x; // m
    glm::dvec3 v; // m/s
    double mass;  // kg
};

/// The loose ones among the moving particles, piece after piece, in order of id.
std::vector<Loose> find_loose(const gpu::Context& context, const ParticleBuffers& particles, const gpu::Buffer& label,
                              std::uint32_t pool)
{
    const std::uint32_t moving = particles.moving;
    const auto attributes = gpu::download<std::uint32_t>(context, particles.attributes, moving);
    if (std::ranges::none_of(attributes, shared::is_loose)) {
        return {};
    }
    const auto id = gpu::download<std::uint32_t>(context, particles.id, moving);
    const auto position = gpu::download<glm::vec4>(context, particles.position, moving);
    const auto velocity = gpu::download<glm::vec4>(context, particles.velocity, moving);
    const auto piece = gpu::download<std::uint32_t>(context, label, pool);
    std::vector<Loose> found;
    for (std::uint32_t i = 0; i < moving; ++i) {
        if (shared::is_loose(attributes[i])) {
            found.push_back({.piece = piece[id[i]],
                             .id = id[i],
                             .x = glm::dvec3(position[i]),
                             .v = glm::dvec3(velocity[i]),
                             .mass = std::abs(static_cast<double>(velocity[i].w))});
        }
    }
    std::ranges::sort(
        found, [](const Loose& a, const Loose& b) { return a.piece != b.piece ? a.piece < b.piece : a.id < b.id; });
    return found;
}

/// The same places, all on the first one's side of periodic borders: no body is as long as half the domain there.
void unwrap(const shared::SphParams& params, std::span<Loose> members)
{
    const glm::dvec3 extent = glm::dvec3(params.domain_max) - glm::dvec3(params.domain_min);
    for (Loose& each : members) {
        for (int axis = 0; axis < 3; ++axis) {
            if ((params.periodic_mask >> (2 * axis) & 1u) != 0u) {
                const double offset = each.x[axis] - members.front().x[axis];
                each.x[axis] -= extent[axis] * std::round(offset / extent[axis]);
            }
        }
    }
}

/// m^2, added to the inertia of unit mass: a straight row of particles has none around itself.
double least_inertia(const shared::SphParams& params)
{
    return 1e-5 * static_cast<double>(params.spacing) * static_cast<double>(params.spacing);
}

/// Of inertia around the center. In the plane bodies turn around z alone.
glm::dmat3 inverse_inertia(const glm::dmat3& inertia, std::uint32_t dimensions)
{
    glm::dmat3 inverse(0.0);
    inverse[2][2] = 1.0 / inertia[2][2];
    return dimensions == 2 ? inverse : glm::inverse(inertia);
}

shared::Body make_body(const shared::SphParams& params, std::uint32_t dimensions, std::span<const Loose> members)
{
    double mass = 0.0;
    glm::dvec3 center(0.0);
    glm::dvec3 momentum(0.0);
    for (const Loose& each : members) {
        mass += each.mass;
        center += each.mass * each.x;
        momentum += each.mass * each.v;
    }
    center /= mass;
    glm::dvec3 angular_momentum(0.0);
    glm::dmat3 inertia(mass * least_inertia(params));
    for (const Loose& each : members) {
        const glm::dvec3 arm = each.x - center;
        angular_momentum += each.mass * glm::cross(arm, each.v);
        inertia += each.mass * (glm::dmat3(glm::dot(arm, arm)) - glm::outerProduct(arm, arm));
    }
    shared::Body body{.center = center,
                      .mass = static_cast<float>(mass),
                      .orientation = {0.0f, 0.0f, 0.0f, 1.0f},
                      .velocity = momentum / mass,
                      .angular_momentum = angular_momentum,
                      .count = static_cast<std::uint32_t>(members.size())};
    const glm::dmat3 inverse = inverse_inertia(inertia, dimensions);
    for (int column = 0; column < 3; ++column) {
        body.inverse_inertia[column] = inverse[column];
    }
    return body;
}

} // namespace

Fragments::Fragments(const gpu::Context& context, const FluidOptions& options, const shared::SphParams& params,
                     const FragmentSettings& settings)
    : context_(&context), params_(params), dimensions_(options.dimensions), pool_(params.pool_count),
      start_(context, "piece_start", sim_piece_start_comp),
      hook_(context, "piece_hook", sim_piece_hook_comp, fluid_constants(context.info(), options)),
      jump_(context, "piece_jump", sim_piece_jump_comp),
      census_(context, "piece_census", sim_piece_census_comp, fluid_constants(context.info(), options)),
      loosen_(context, "piece_loosen", sim_piece_loosen_comp),
      touch_(context, "rigid_touch", sim_rigid_touch_comp, fluid_constants(context.info(), options)),
      step_(context, "rigid_step", sim_rigid_step_comp),
      forces_(context, of_moving(options), all_solid(pool_), BoundaryForces::Reach::Moving),
      rigid_(gpu::make_buffer<shared::RigidParams>(context, 1, "rigid params")),
      label_(gpu::make_buffer<std::uint32_t>(context, pool_, "piece label")),
      pieces_(gpu::make_buffer<shared::Piece>(context, pool_, "pieces")),
      body_of_(gpu::make_buffer<std::uint32_t>(context, pool_, "body of a particle")),
      place_(gpu::make_buffer<std::uint32_t>(context, pool_, "place of a particle")),
      touches_(gpu::make_buffer<shared::Touch>(context, pool_, "touches")),
      changes_(gpu::make_buffer<shared::PieceChanges>(context, 1, "piece changes")),
      readback_(context, sizeof(shared::PieceChanges), gpu::MemoryUse::Readback, "piece changes")
{
    gpu::upload<shared::RigidParams>(context, rigid_, {&settings.params, 1});
    gpu::Commands commands(context);
    commands.begin();
    commands.fill(body_of_, shared::NO_BODY);
    forces_.record_reset(commands);
    commands.submit();
    commands.wait();
}

void Fragments::record_round(gpu::Commands& commands, const gpu::Buffer& params, const ParticleBuffers& particles,
                             const NeighborGrid& grid) const
{
    commands.fill(changes_, 0);
    commands.dispatch(hook_, particles.count, gpu::NoPush{},
                      {read(params), read(grid.cell_start), read(particles.id), read(particles.attributes),
                       read(particles.position), read(particles.position), read(particles.velocity),
                       read(particles.velocity), read(body_of_), read_write(label_), read_write(changes_)});
    commands.dispatch(jump_, particles.count, gpu::NoPush{}, {read(params), read_write(label_)});
}

shared::PieceChanges Fragments::find_pieces(gpu::Commands& commands, const gpu::Buffer& params,
                                            const ParticleBuffers& particles, const NeighborGrid& grid,
                                            const gpu::Buffer& release_time, float time)
{
    const auto run = [&](const char* name, const auto& record) {
        commands.begin();
        {
            const gpu::Scope scope(commands, name);
            record();
        }
        commands.copy(changes_, readback_, sizeof(shared::PieceChanges));
        commands.submit();
        commands.wait();
        return readback_.mapped<shared::PieceChanges>()[0];
    };
    bool is_first = true;
    while (is_first || readback_.mapped<shared::PieceChanges>()[0].unsettled > 0) { // each round makes a label smaller
        run("pieces", [&] {
            if (is_first) {
                commands.dispatch(
                    start_, particles.count, gpu::NoPush{},
                    {read(params), read(particles.id), read(particles.attributes), write(label_), write(pieces_)});
            }
            for (std::uint32_t round = 0; round < rounds_per_submission; ++round) {
                record_round(commands, params, particles, grid);
            }
        });
        is_first = false;
    }
    return run("loosen pieces", [&] {
        commands.dispatch(census_, particles.count, gpu::NoPush{},
                          {read(params), read(grid.cell_start), read(rigid_), read(particles.id),
                           read(particles.attributes), read(particles.position), read(particles.position),
                           read(particles.velocity), read(particles.velocity), read(label_), read_write(pieces_)});
        commands.dispatch(loosen_, particles.count, time,
                          {read(params), read(particles.id), read(label_), read(pieces_),
                           read_write(particles.attributes), read_write(particles.position),
                           read_write(particles.velocity), write(release_time), read_write(changes_)});
    });
}

void Fragments::make_bodies(const ParticleBuffers& particles)
{
    std::vector<Loose> loose = find_loose(*context_, particles, label_, pool_);
    if (loose.empty() && body_count_ == 0) {
        return;
    }
    std::vector<shared::Body> bodies;
    std::vector<shared::BodyMember> members;
    std::vector<std::uint32_t> body_of(pool_, shared::NO_BODY);
    for (auto first = loose.begin(); first != loose.end();) {
        const auto end =
            std::find_if(first, loose.end(), [&](const Loose& each) { return each.piece != first->piece; });
        unwrap(params_, {first, end});
        shared::Body body = make_body(params_, dimensions_, {first, end});
        body.first = static_cast<std::uint32_t>(members.size());
        for (auto each = first; each != end; ++each) {
            body_of[each->id] = static_cast<std::uint32_t>(bodies.size());
            members.push_back({.id = each->id, .arm = each->x - glm::dvec3(body.center)});
        }
        bodies.push_back(body);
        first = end;
    }
    gpu::upload<std::uint32_t>(*context_, body_of_, body_of);
    body_count_ = static_cast<std::uint32_t>(bodies.size());
    if (bodies.empty()) {
        return;
    }
    const std::size_t contacts = shared::CONTACTS_A_MEMBER * members.size();
    const std::size_t listed = contacts + shared::CONTACTS_A_MEMBER * shared::MEMBERS_AT_A_TIME * bodies.size();
    bodies_ = gpu::make_buffer<shared::Body>(*context_, bodies.size(), "bodies");
    members_ = gpu::make_buffer<shared::BodyMember>(*context_, members.size(), "body members");
    contacts_ = gpu::make_buffer<shared::Contact>(*context_, contacts, "contacts");
    touching_ = gpu::make_buffer<std::uint32_t>(*context_, listed, "touching");
    gpu::upload<shared::Body>(*context_, bodies_, bodies);
    gpu::upload<shared::BodyMember>(*context_, members_, members);
    gpu::Commands commands(*context_);
    commands.begin();
    commands.fill(contacts_, 0);
    commands.submit();
    commands.wait();
}

void Fragments::record_step(gpu::Commands& commands, const Fluid& fluid, std::uint32_t step)
{
    if (body_count_ == 0) {
        return;
    }
    const gpu::Scope scope(commands, "rigid bodies");
    const ParticleBuffers& particles = fluid.particles;
    commands.dispatch(touch_, particles.moving, body_count_,
                      {read(fluid.params), read(fluid.grid.cell_start), read(particles.id), read(particles.attributes),
                       read(particles.position), read(particles.position), read(particles.velocity),
                       read(particles.velocity), read(body_of_), read(bodies_), write(place_), write(touches_)});
    commands.dispatch(step_, body_count_ * shared::MEMBERS_AT_A_TIME,
                      shared::RigidStepPush{.bodies = body_count_, .step = step},
                      {read(fluid.params), read(rigid_), read(members_), read(place_), read(touches_),
                       read(particles.id), read_write(forces_.reactions()), read_write(bodies_), read_write(contacts_),
                       read_write(touching_), read_write(particles.attributes), read_write(particles.position),
                       read_write(particles.velocity), read_write(fluid.status)});
}

std::vector<shared::Body> Fragments::download_bodies() const
{
    return gpu::download<shared::Body>(*context_, bodies_, body_count_);
}

std::vector<std::uint32_t> Fragments::download_labels() const
{
    return gpu::download<std::uint32_t>(*context_, label_, pool_);
}

std::uint64_t Fragments::device_bytes() const
{
    std::uint64_t sum = 0;
    for (const gpu::Buffer* buffer : {&rigid_, &label_, &pieces_, &body_of_, &place_, &touches_, &bodies_, &members_,
                                      &contacts_, &touching_, &forces_.reactions()}) {
        sum += buffer->size();
    }
    return sum;
}

} // namespace meltpoint::sim
