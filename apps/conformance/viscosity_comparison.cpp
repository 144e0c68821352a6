#include "conformance/viscosity_comparison.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "conformance/relative_error.h"
#include "core/random.h"
#include "reference/viscosity.h"
#include "sim/implicit_viscosity.h"

namespace meltpoint::conformance {

namespace {

using Vectors = std::vector<glm::dvec3>;

class ViscosityComparison {
public:
    ViscosityComparison(Device& device, const sim::FluidOptions& options, const reference::Settings& settings,
                        reference::State twin, const reference::Neighbors& neighbors)
        : device_(device), settings_(settings), twin_(std::move(twin)), neighbors_(neighbors),
          viscosity_(device.context, options, device.params)
    {
        stir();
        find_blocks();
    }

    std::vector<PassError> compare()
    {
        const Vectors start = set_start();
        sim::Fluid fluid = device_.fluid();
        device_.run([&] { viscosity_.record_residual(device_.commands, fluid); });
        const double residual = sum_of_residual();
        std::vector<PassError> errors{compare_residual(start), compare_blocks()};
        device_.run([&] { viscosity_.record_direction(device_.commands, fluid); });
        errors.push_back(compare_direction());
        device_.run([&] { viscosity_.record_product(device_.commands, fluid); });
        errors.push_back(compare_product());
        const Vectors change = download(viscosity_.change());
        const Vectors before = download(viscosity_.residual());
        device_.run([&] { viscosity_.record_update(device_.commands, fluid, 1); });
        errors.push_back(compare_update(residual, change, before));
        device_.run([&] { viscosity_.record_direction(device_.commands, fluid); });
        errors.push_back(compare_second_direction(residual));
        for (const PassError& error : compare_solve()) {
            errors.push_back(error);
        }
        return errors;
    }

private:
    template <class Body>
    void for_each_fluid(const Body& body) const
    {
        for (std::size_t i = 0; i < twin_.size(); ++i) {
            if (!reference::is_boundary(twin_, i)) {
                body(i);
            }
        }
    }

    /// Moves what is at rest, or there would be nothing to do.
    void stir()
    {
        Random random(11);
        velocity_ = gpu::download<glm::vec4>(device_.context, device_.particles.velocity, twin_.size());
        std::vector<glm::vec4> stirred = velocity_;
        for_each_fluid([&](std::size_t i) {
            for (int axis = 0; axis < 3; ++axis) {
                stirred[i][axis] += static_cast<float>(random.uniform()) - 0.5f;
                twin_.velocity[i][axis] = static_cast<double>(stirred[i][axis]);
            }
        });
        gpu::upload<glm::vec4>(device_.context, device_.particles.velocity, stirred);
    }

    /// Inverses of the twin's blocks.
    void find_blocks()
    {
        blocks_.assign(twin_.size(), glm::dmat3(1.0));
        for_each_fluid([&](std::size_t i) {
            blocks_[i] = glm::inverse(reference::viscosity_block(settings_, twin_, neighbors_, i));
        });
    }

    [[nodiscard]] Vectors download(const gpu::Buffer& buffer) const
    {
        Vectors vectors;
        for (const glm::vec4& v : gpu::download<glm::vec4>(device_.context, buffer, twin_.size())) {
            vectors.emplace_back(v.x, v.y, v.z);
        }
        return vectors;
    }

    /// A step before that has changed velocities by up to a tenth of a meter a second. Returns the changes.
    Vectors set_start()
    {
        const auto order = gpu::download<std::uint32_t>(device_.context, device_.grid.order, twin_.size());
        const double dt = static_cast<double>(device_.params.dt);
        Random random(12);
        std::vector<glm::vec4> before(twin_.size(), glm::vec4(0.0f));
        Vectors change(twin_.size(), glm::dvec3(0.0));
        for (std::size_t i = 0; i < device_.particles.moving; ++i) {
            const double x = random.uniform();
            const double y = random.uniform();
            const double z = random.uniform();
            glm::vec4& a = before[order[i]];
            a = glm::vec4((glm::vec3(x, y, z) - 0.5f) * 0.2f / device_.params.dt, 0.0f);
            change[i] = reference::is_boundary(twin_, i) ? glm::dvec3(0.0) : dt * glm::dvec3(a.x, a.y, a.z);
        }
        device_.run([&] { viscosity_.record_start(device_.commands); });
        gpu::upload<glm::vec4>(device_.context, viscosity_.change(), before);
        return change;
    }

    /// sum m r . z as the twin has it from the device's residual.
    [[nodiscard]] double sum_of_residual() const
    {
        const Vectors r = download(viscosity_.residual());
        double sum = 0.0;
        for_each_fluid([&](std::size_t i) { sum += twin_.mass[i] * glm::dot(r[i], blocks_[i] * r[i]); });
        return sum;
    }

    PassError compare_residual(const Vectors& start)
    {
        Vectors velocity = twin_.velocity;
        for (std::size_t i = 0; i < twin_.size(); ++i) {
            velocity[i] += start[i];
        }
        const Vectors found = download(viscosity_.residual());
        RelativeError error;
        for_each_fluid([&](std::size_t i) {
            reference::VectorSum change = reference::viscous_change(settings_, twin_, neighbors_, velocity, i);
            change.add(reference::lid_change(settings_, twin_, i));
            error.add(glm::length(found[i] - (change.value - start[i])), change.magnitude + glm::length(start[i]));
        });
        return {"viscosity solve: residual", error.value(), pass_bound};
    }

    PassError compare_blocks()
    {
        const auto found = gpu::download<shared::ViscosityBlock>(device_.context, viscosity_.blocks(), twin_.size());
        RelativeError error;
        for_each_fluid([&](std::size_t i) {
            const glm::dvec3 d(found[i].diagonal);
            const glm::dvec3 o(found[i].off_diagonal);
            const glm::dmat3 block(d.x, o.z, o.y, o.z, d.y, o.x, o.y, o.x, d.z);
            double difference = 0.0;
            for (int c = 0; c < 3; ++c) {
                difference += glm::dot(block[c] - blocks_[i][c], block[c] - blocks_[i][c]);
            }
            // Of size 1 at most: the identity is what an idle particle has.
            error.add(std::sqrt(difference), 1.0);
        });
        return {"viscosity solve: preconditioner", error.value(), pass_bound};
    }

    PassError compare_direction()
    {
        const Vectors r = download(viscosity_.residual());
        const Vectors found = download(viscosity_.direction());
        RelativeError error;
        for_each_fluid([&](std::size_t i) { error.add(glm::length(found[i] - blocks_[i] * r[i]), glm::length(r[i])); });
        return {"viscosity solve: first direction", error.value(), pass_bound};
    }

    PassError compare_product()
    {
        const Vectors p = download(viscosity_.direction());
        const Vectors found = download(viscosity_.product());
        RelativeError error;
        for_each_fluid([&](std::size_t i) {
            const reference::VectorSum change = reference::viscous_change(settings_, twin_, neighbors_, p, i);
            error.add(glm::length(found[i] - (p[i] - change.value)), glm::length(p[i]) + change.magnitude);
        });
        return {"viscosity solve: product", error.value(), pass_bound};
    }

    PassError compare_update(double residual, const Vectors& change, const Vectors& before)
    {
        const Vectors p = download(viscosity_.direction());
        const Vectors q = download(viscosity_.product());
        double curvature = 0.0;
        for_each_fluid([&](std::size_t i) { curvature += twin_.mass[i] * glm::dot(p[i], q[i]); });
        const double advance = curvature > 0.0 ? residual / curvature : 0.0;
        const Vectors found_change = download(viscosity_.change());
        const Vectors found_residual = download(viscosity_.residual());
        RelativeError error;
        for_each_fluid([&](std::size_t i) {
            error.add(glm::length(found_change[i] - (change[i] + advance * p[i])),
                      glm::length(change[i]) + advance * glm::length(p[i]));
            error.add(glm::length(found_residual[i] - (before[i] - advance * q[i])),
                      glm::length(before[i]) + advance * glm::length(q[i]));
        });
        last_direction_ = p;
        return {"viscosity solve: update", error.value(), pass_bound};
    }

    /// Nothing has moved if the first iteration was the last.
    PassError compare_second_direction(double residual)
    {
        const Vectors r = download(viscosity_.residual());
        const Vectors found = download(viscosity_.direction());
        const auto state = gpu::download<shared::ViscositySolve>(device_.context, viscosity_.state(), 1)[0];
        const bool ended = state.solve.groups.x == 0;
        const double turn = residual > 0.0 ? sum_of_residual() / residual : 0.0;
        RelativeError error;
        for_each_fluid([&](std::size_t i) {
            const glm::dvec3 kept = (ended ? 1.0 : turn) * last_direction_[i];
            const glm::dvec3 expected = kept + (ended ? glm::dvec3(0.0) : blocks_[i] * r[i]);
            error.add(glm::length(found[i] - expected), glm::length(r[i]) + glm::length(kept));
        });
        return {"viscosity solve: second direction", error.value(), pass_bound};
    }

    /// Both ends are within the error of the exact solution, and so within twice that of each other.
    std::vector<PassError> compare_solve()
    {
        const Vectors start = set_start();
        reference::State state = twin_;
        state.viscous_acceleration = start;
        for (glm::dvec3& a : state.viscous_acceleration) {
            a /= static_cast<double>(device_.params.dt);
        }
        const reference::SolveResult expected = reference::solve_viscosity(settings_, state, neighbors_);
        const gpu::Buffer& velocity = device_.particles.velocity;
        sim::Fluid fluid = device_.fluid();
        device_.run([&] { viscosity_.record_solve(device_.commands, fluid); });
        const auto found = gpu::download<shared::Solve>(device_.context, viscosity_.state(), 1)[0];
        const Vectors after = download(velocity);
        const Vectors kept = download(viscosity_.change());
        const double dt = static_cast<double>(device_.params.dt);
        RelativeError kept_error;
        double difference = 0.0;
        double change = 0.0;
        double momentum = 0.0;
        for_each_fluid([&](std::size_t i) {
            const auto squared = [&](const glm::dvec3& v) {
                return twin_.mass[i] * glm::dot(v, v);
            };
            kept_error.add(glm::length(dt * kept[i] - (after[i] - twin_.velocity[i])), glm::length(twin_.velocity[i]));
            difference += squared(after[i] - state.velocity[i]);
            change += squared(state.velocity[i] - twin_.velocity[i]);
            momentum += squared(twin_.velocity[i]);
        });
        gpu::upload<glm::vec4>(device_.context, device_.particles.velocity, velocity_);
        return {{"viscosity solve: velocities", reference::viscosity_error(difference, change, momentum),
                 2.0 * static_cast<double>(device_.params.viscosity_error) + pass_bound},
                {"viscosity solve: kept for the next step", kept_error.value(), pass_bound},
                {"viscosity solve: iterations",
                 std::abs(static_cast<double>(found.iterations) - static_cast<double>(expected.iterations)), 1.0}};
    }

    Device& device_;
    const reference::Settings& settings_;
    reference::State twin_;
    const reference::Neighbors& neighbors_;
    sim::ImplicitViscosity viscosity_;
    std::vector<glm::vec4> velocity_; ///< before
    std::vector<glm::dmat3> blocks_;
    Vectors last_direction_;
};

} // namespace

std::vector<PassError> compare_viscosity_passes(Device& device, const sim::FluidOptions& options,
                                                const reference::Settings& settings, const reference::State& twin,
                                                const reference::Neighbors& neighbors)
{
    return ViscosityComparison(device, options, settings, twin, neighbors).compare();
}

} // namespace meltpoint::conformance
