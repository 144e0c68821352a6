// Tonge, Benevolenski & Voroshilov, "Mass splitting for jitter-free parallel rigid body simulation", SIGGRAPH 2012, for
// the contacts; Adamson & Alexa, "Approximating and Intersecting Surfaces from Points", SGP 2003, for what is touched.
#include "reference/fragments.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>

#include "reference/cells.h"
#include "reference/walls.h"

namespace meltpoint::reference {

namespace {

bool is_solid(const State& state, std::size_t i)
{
    return shared::particle_state(state.attributes[i]) == shared::STATE_SOLID;
}

bool is_collider(const State& state, std::size_t i)
{
    return shared::particle_state(state.attributes[i]) == shared::STATE_COLLIDER;
}

/// Calls body(j, offset) for every particle j nearer to i than `reach` spacings, across periodic borders but not in
/// mirrors; the offset leads from j to i.
template <class Body>
void for_each_near(const shared::SphParams& params, const State& state, const Neighbors& neighbors, std::size_t i,
                   const Body& body)
{
    for (const Neighbor& neighbor : neighbors.of(i)) {
        bool is_mirrored = false;
        for (int axis = 0; axis < 3; ++axis) {
            const bool is_beyond = (neighbor.reflection >> (2 * axis) & 3u) != 0u;
            is_mirrored = is_mirrored || (is_beyond && !is_shifted(neighbor.reflection, axis));
        }
        if (!is_mirrored) {
            body(std::size_t{neighbor.index},
                 state.position[i] - reflect_position(params, neighbor.reflection, state.position[neighbor.index]));
        }
    }
}

/// All pairs within so many spacings.
Neighbors neighbors_within(const Settings& settings, const State& state, double spacings)
{
    shared::SphParams params = settings.params;
    params.support_radius = static_cast<float>(spacings * static_cast<double>(params.spacing));
    return find_neighbors(params, state.position);
}

/// Disjoint sets of particles; the one of smallest id stands for its set.
class Sets {
public:
    explicit Sets(const State& state) : state_(&state), parent_(state.size())
    {
        std::iota(parent_.begin(), parent_.end(), std::size_t{0});
    }

    std::size_t find(std::size_t i)
    {
        while (parent_[i] != i) {
            parent_[i] = parent_[parent_[i]];
            i = parent_[i];
        }
        return i;
    }

    void unite(std::size_t a, std::size_t b)
    {
        a = find(a);
        b = find(b);
        if (state_->id[b] < state_->id[a]) {
            std::swap(a, b);
        }
        parent_[b] = a;
    }

private:
    const State* state_;
    std::vector<std::size_t> parent_;
};

bool touches_wall(const shared::SphParams& params, const glm::dvec3& x)
{
    const double reach = static_cast<double>(shared::BOND_DISTANCE) * static_cast<double>(params.spacing);
    bool found = false;
    for_each_wall(params, x, [&](double distance, const glm::dvec3&) { found = found || distance < reach; });
    return found;
}

} // namespace

std::vector<std::uint32_t> find_pieces(const Settings& settings, const State& state,
                                       std::span<const std::uint32_t> body_of)
{
    const auto are_connected = [&](std::size_t i, std::size_t j) {
        const bool loose = shared::is_loose(state.attributes[i]);
        const std::uint32_t a = body_of[state.id[i]];
        const std::uint32_t b = body_of[state.id[j]];
        return is_solid(state, i) && is_solid(state, j) && loose == shared::is_loose(state.attributes[j]) &&
               (a == b || a == shared::NO_BODY || b == shared::NO_BODY);
    };
    const Neighbors neighbors = neighbors_within(settings, state, static_cast<double>(shared::BOND_DISTANCE));
    Sets sets(state);
    for (std::size_t i = 0; i < state.size(); ++i) {
        for_each_near(settings.params, state, neighbors, i, [&](std::size_t j, const glm::dvec3&) {
            if (are_connected(i, j)) {
                sets.unite(i, j);
            }
        });
    }
    std::vector<std::uint32_t> piece(state.size(), shared::NO_PIECE);
    for (std::size_t i = 0; i < state.size(); ++i) {
        piece[i] = is_solid(state, i) ? state.id[sets.find(i)] : shared::NO_PIECE;
    }
    return piece;
}

shared::PieceChanges loosen_pieces(const Settings& settings, const shared::RigidParams& rigid, State& state,
                                   std::span<const std::uint32_t> piece)
{
    const Neighbors neighbors = neighbors_within(settings, state, static_cast<double>(shared::BOND_DISTANCE));
    std::map<std::uint32_t, shared::Piece> pieces;
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (!is_solid(state, i)) {
            continue;
        }
        shared::Piece& its = pieces[piece[i]];
        ++its.size;
        const std::uint32_t anchor = rigid.anchor[shared::particle_material(state.attributes[i])];
        bool touches = touches_wall(settings.params, state.position[i]);
        for_each_near(settings.params, state, neighbors, i,
                      [&](std::size_t j, const glm::dvec3&) { touches = touches || is_collider(state, j); });
        const bool is_anchor = anchor == shared::ANCHOR_ALL || (anchor == shared::ANCHOR_GROUND && touches);
        its.held |= is_anchor && !shared::is_loose(state.attributes[i]) ? 1u : 0u;
    }
    shared::PieceChanges changes{};
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (!is_solid(state, i) || pieces[piece[i]].held != 0) {
            continue;
        }
        const bool was_loose = shared::is_loose(state.attributes[i]);
        if (pieces[piece[i]].size < shared::LEAST_PIECE) {
            const bool crumbles = (state.attributes[i] & shared::FLAG_CRUMBLES) != 0;
            state.attributes[i] = shared::freed_as(
                state.attributes[i], crumbles ? shared::STATE_DUST : shared::STATE_FLUID, shared::CAUSE_FRAGMENT);
            state.weight[i] = crumbles ? 0.0 : state.weight[i];
            ++(was_loose ? changes.crumbled_loose : changes.crumbled);
        } else if (!was_loose) {
            state.attributes[i] |= shared::FLAG_LOOSE;
            ++changes.loosened;
        }
    }
    return changes;
}

std::vector<RigidBody> make_bodies(const Settings& settings, const State& state, std::span<const std::uint32_t> piece)
{
    std::map<std::uint32_t, RigidBody> bodies; // by the piece's name
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (shared::is_loose(state.attributes[i])) {
            bodies[piece[i]].members.push_back(i);
        }
    }
    std::vector<RigidBody> made;
    for (auto& [name, body] : bodies) {
        for (const std::size_t i : body.members) {
            body.mass += state.mass[i];
            body.center += state.mass[i] * state.position[i];
            body.velocity += state.mass[i] * state.velocity[i];
        }
        body.center /= body.mass;
        body.velocity /= body.mass;
        const double spacing = static_cast<double>(settings.params.spacing);
        glm::dmat3 inertia(body.mass * 1e-5 * spacing * spacing);
        for (const std::size_t i : body.members) {
            const glm::dvec3 arm = state.position[i] - body.center;
            body.arms.push_back(arm);
            body.angular_momentum += state.mass[i] * glm::cross(arm, state.velocity[i]);
            inertia += state.mass[i] * (glm::dmat3(glm::dot(arm, arm)) - glm::outerProduct(arm, arm));
        }
        if (settings.dimensions == 2) {
            body.inverse_inertia[2][2] = 1.0 / inertia[2][2];
        } else {
            body.inverse_inertia = glm::inverse(inertia);
        }
        made.push_back(std::move(body));
    }
    return made;
}

namespace {

/// What a particle touches that is not of its body: a plane.
struct Plane {
    glm::dvec3 normal{0.0};
    double gap = std::numeric_limits<double>::infinity(); ///< m
    glm::dvec3 velocity{0.0};                             ///< m/s
    double share = 0.0;                                   ///< shared::Touch::share
};

class Stepper {
public:
    Stepper(const Settings& settings, const shared::RigidParams& rigid, State& state, std::vector<RigidBody>& bodies)
        : params_(settings.params), rigid_(rigid), state_(state), bodies_(bodies), dt_(params_.dt),
          spacing_(params_.spacing),
          neighbors_(neighbors_within(settings, state, static_cast<double>(shared::TOUCH_REACH))),
          body_of_(state.size(), shared::NO_BODY)
    {
        for (std::size_t b = 0; b < bodies.size(); ++b) {
            for (const std::size_t i : bodies[b].members) {
                body_of_[i] = static_cast<std::uint32_t>(b);
            }
        }
    }

    void step(std::span<glm::dvec3> owed)
    {
        std::vector<std::vector<Plane>> planes; // where all are before anyone moves
        for (const RigidBody& body : bodies_) {
            std::vector<Plane>& its = planes.emplace_back();
            for (const std::size_t i : body.members) {
                its.push_back(plane_at(i));
            }
        }
        for (std::size_t b = 0; b < bodies_.size(); ++b) {
            step_body(bodies_[b], planes[b], owed);
        }
    }

private:
    [[nodiscard]] Plane plane_at(std::size_t i) const
    {
        const double reach = static_cast<double>(shared::TOUCH_REACH) * spacing_;
        glm::dvec3 offset(0.0);
        glm::dvec3 velocity(0.0);
        double contact = 0.0; // the distance at which contact begins
        double weights = 0.0;
        double fixed = 0.0;
        double moved = 0.0;
        double mass = 0.0;
        for_each_near(params_, state_, neighbors_, i, [&](std::size_t j, const glm::dvec3& to_i) {
            const bool is_fixed = is_collider(state_, j) || (is_solid(state_, j) && body_of_[j] == shared::NO_BODY);
            const bool is_other = body_of_[j] != shared::NO_BODY && body_of_[j] != body_of_[i];
            if (!is_fixed && !is_other) {
                return;
            }
            const double nearness = std::pow(1.0 - glm::dot(to_i, to_i) / (reach * reach), 2.0);
            const double weight = state_.weight[j] * nearness;
            offset += weight * to_i;
            velocity += is_fixed ? glm::dvec3(0.0) : weight * state_.velocity[j];
            contact +=
                weight * static_cast<double>(is_collider(state_, j) ? shared::COLLIDER_CONTACT : shared::SOLID_CONTACT);
            mass += is_other ? weight * bodies_[body_of_[j]].mass : 0.0;
            (is_fixed ? fixed : moved) += weight;
            weights += weight;
        });
        if (weights == 0.0 || glm::length(offset) == 0.0) {
            return {};
        }
        const double own = bodies_[body_of_[i]].mass;
        const double other = moved > 0.0 ? mass / moved : 0.0;
        return {.normal = glm::normalize(offset),
                .gap = (glm::length(offset) - contact * spacing_) / weights,
                .velocity = velocity / weights,
                .share = glm::mix(other / (own + other), 1.0, fixed / weights)};
    }

    [[nodiscard]] static glm::dmat3 inverse_inertia(const RigidBody& body)
    {
        const glm::dmat3 turn = glm::mat3_cast(body.orientation);
        return turn * body.inverse_inertia * glm::transpose(turn);
    }

    [[nodiscard]] static glm::dvec3 angular_velocity(const RigidBody& body)
    {
        return inverse_inertia(body) * body.angular_momentum;
    }

    [[nodiscard]] static glm::dvec3 arm_of(const RigidBody& body, std::size_t member)
    {
        return body.orientation * body.arms[member];
    }

    [[nodiscard]] static glm::dvec3 velocity_of(const RigidBody& body, std::size_t member)
    {
        return body.velocity + glm::cross(angular_velocity(body), arm_of(body, member));
    }

    [[nodiscard]] double least_speed(double gap) const
    {
        const double overlap = std::max(-gap - static_cast<double>(shared::TOUCH_SLOP) * spacing_, 0.0);
        return gap > 0.0 ? -gap / dt_
                         : std::min(static_cast<double>(shared::PUSH_OUT_SHARE) * overlap / dt_,
                                    static_cast<double>(shared::PUSH_OUT_RATE) * spacing_);
    }

    [[nodiscard]] std::vector<BodyContact> find_contacts(const RigidBody& body, const std::vector<Plane>& planes) const
    {
        std::vector<BodyContact> contacts;
        const auto add = [&](std::size_t member, std::uint32_t slot, const glm::dvec3& normal, double gap,
                             const glm::dvec3& other) {
            const double approach = glm::dot(velocity_of(body, member) - other, normal);
            if (!(gap + dt_ * approach < static_cast<double>(shared::TOUCH_SLOP) * spacing_)) {
                return;
            }
            glm::dvec3 before(0.0);
            for (const BodyContact& contact : body.contacts) {
                before = contact.member == member && contact.slot == slot ? contact.impulse : before;
            }
            contacts.push_back({.member = static_cast<std::uint32_t>(member),
                                .slot = slot,
                                .normal = normal,
                                .velocity = other,
                                .target = least_speed(gap),
                                .impulse = glm::dot(before, normal) > 0.0 ? before : glm::dvec3(0.0)});
        };
        for (std::size_t m = 0; m < body.members.size(); ++m) {
            const Plane& plane = planes[m];
            if (plane.share > 0.0) {
                add(m, 0, plane.normal, plane.gap, glm::mix(velocity_of(body, m), plane.velocity, plane.share));
            }
            // Of the two walls across an axis the nearer one.
            double nearest[3] = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
                                 std::numeric_limits<double>::infinity()};
            glm::dvec3 inward[3] = {glm::dvec3(0.0), glm::dvec3(0.0), glm::dvec3(0.0)};
            for_each_wall(params_, state_.position[body.members[m]], [&](double distance, const glm::dvec3& normal) {
                const int axis = normal.x != 0.0 ? 0 : (normal.y != 0.0 ? 1 : 2);
                if (distance < nearest[axis]) {
                    nearest[axis] = distance;
                    inward[axis] = normal;
                }
            });
            for (std::uint32_t axis = 0; axis < 3; ++axis) {
                if (std::isfinite(nearest[axis])) {
                    add(m, 1 + axis, inward[axis], nearest[axis] - static_cast<double>(shared::WALL_CONTACT) * spacing_,
                        glm::dvec3(0.0));
                }
            }
        }
        return contacts;
    }

    static void push(RigidBody& body, const glm::dvec3& impulse, const glm::dvec3& moment)
    {
        body.velocity += impulse / body.mass;
        body.angular_momentum += moment;
    }

    /// One iteration: every contact as if it had its share of the body for itself.
    static void iterate(RigidBody& body, double friction)
    {
        const glm::dmat3 inverse = inverse_inertia(body);
        const auto count = static_cast<double>(body.contacts.size());
        glm::dvec3 impulse(0.0);
        glm::dvec3 moment(0.0);
        for (BodyContact& contact : body.contacts) {
            const glm::dvec3 arm = arm_of(body, contact.member);
            const auto mobility = [&](const glm::dvec3& along) {
                return 1.0 / body.mass + glm::dot(glm::cross(arm, along), inverse * glm::cross(arm, along));
            };
            const glm::dvec3 relative = velocity_of(body, contact.member) - contact.velocity;
            const double away = glm::dot(relative, contact.normal);
            const glm::dvec3 slip = relative - away * contact.normal;
            const double before = glm::dot(contact.impulse, contact.normal);
            const double now = std::max(before + (contact.target - away) / (count * mobility(contact.normal)), 0.0);
            glm::dvec3 across = contact.impulse - before * contact.normal;
            if (glm::length(slip) > 0.0) {
                across -= slip / (count * mobility(glm::normalize(slip)));
            }
            if (glm::length(across) > friction * now) {
                across *= friction * now / glm::length(across);
            }
            const glm::dvec3 change = now * contact.normal + across - contact.impulse;
            contact.impulse += change;
            impulse += change;
            moment += glm::cross(arm, change);
        }
        push(body, impulse, moment);
    }

    static glm::dquat turned(const glm::dquat& orientation, const glm::dvec3& w, double seconds)
    {
        const double angle = glm::length(w) * seconds;
        const glm::dquat turn = angle > 0.0 ? glm::angleAxis(angle, glm::normalize(w)) : glm::dquat(1.0, 0.0, 0.0, 0.0);
        return glm::normalize(turn * orientation);
    }

    void step_body(RigidBody& body, const std::vector<Plane>& planes, std::span<glm::dvec3> owed)
    {
        body.velocity += dt_ * glm::dvec3(params_.gravity);
        const double displaced = static_cast<double>(rigid_.fluid_density) *
                                 static_cast<double>(params_.lattice_volume) * static_cast<double>(body.members.size());
        for (std::size_t m = 0; m < body.members.size(); ++m) {
            glm::dvec3& left = owed[body.members[m]];
            const glm::dvec3 its = body.mass / (body.mass + displaced) * left;
            left -= its;
            push(body, its, glm::cross(arm_of(body, m), its));
        }
        body.contacts = find_contacts(body, planes);
        for (const BodyContact& contact : body.contacts) {
            push(body, contact.impulse, glm::cross(arm_of(body, contact.member), contact.impulse));
        }
        const std::uint32_t material = shared::particle_material(state_.attributes[body.members.front()]);
        for (std::uint32_t k = 0; k < shared::CONTACT_ITERATIONS; ++k) {
            iterate(body, static_cast<double>(rigid_.sliding_friction[material]));
        }
        const glm::dquat before = body.orientation;
        body.orientation = turned(before, angular_velocity(body), 0.5 * dt_);
        body.orientation = turned(before, angular_velocity(body), dt_);
        body.center += dt_ * body.velocity;
        for (std::size_t m = 0; m < body.members.size(); ++m) {
            state_.position[body.members[m]] = wrap_position(params_, body.center + arm_of(body, m));
            state_.velocity[body.members[m]] = velocity_of(body, m);
        }
    }

    const shared::SphParams& params_;
    const shared::RigidParams& rigid_;
    State& state_;
    std::vector<RigidBody>& bodies_;
    double dt_;      // s
    double spacing_; // m
    Neighbors neighbors_;
    std::vector<std::uint32_t> body_of_; // by place
};

} // namespace

void step_bodies(const Settings& settings, const shared::RigidParams& rigid, State& state,
                 std::vector<RigidBody>& bodies, std::span<glm::dvec3> owed)
{
    Stepper(settings, rigid, state, bodies).step(owed);
}

} // namespace meltpoint::reference
