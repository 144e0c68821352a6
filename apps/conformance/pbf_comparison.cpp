#include "conformance/pbf_comparison.h"

#include <cmath>
#include <string>
#include <utility>

#include "conformance/relative_error.h"
#include "reference/pbf.h"
#include "sim/pbf.h"

namespace meltpoint::conformance {

namespace {

/// The passes of one step, on the device and in the twin, each of which starts from what the device has.
class PbfComparison {
public:
    PbfComparison(Device& device, const sim::FluidOptions& options, const reference::Settings& settings,
                  reference::State twin, const reference::Neighbors& neighbors)
        : device_(device), settings_(settings), twin_(std::move(twin)), neighbors_(neighbors),
          pbf_(device.context, options, device.params), scale_(static_cast<double>(device.params.gradient_scale))
    {
    }

    std::vector<PassError> compare()
    {
        device_.run([&] {
            device_.commands.fill(*pbf_.solves(), 0);
            pbf_.record_still(device_.commands, device_.fluid());
            sim::record_forces(device_.commands, device_.kernels, device_.params_buffer, device_.particles,
                               device_.grid);
        });
        twin_.acceleration =
            reference::from_particle_set(download_unordered(device_.context, device_.particles)).acceleration;

        std::vector<PassError> errors{compare_first_move()};
        device_.run([&] { pbf_.record_residual(device_.commands, device_.fluid(), 0); });
        for (const PassError& error : compare_constraints(0)) {
            errors.push_back(error);
        }
        errors.push_back(compare_correction());
        device_.run([&] {
            pbf_.record_move(device_.commands, device_.fluid(), 1);
            pbf_.record_residual(device_.commands, device_.fluid(), 1);
        });
        for (const PassError& error : compare_constraints(1)) {
            errors.push_back(error);
        }
        errors.push_back(compare_iterations());
        for (const PassError& error : compare_finish()) {
            errors.push_back(error);
        }
        for (const PassError& error : compare_predict()) {
            errors.push_back(error);
        }
        return errors;
    }

private:
    [[nodiscard]] std::vector<glm::dvec3> downloaded(const gpu::Buffer& buffer) const
    {
        std::vector<glm::dvec3> vectors;
        for (const glm::vec4& v : gpu::download<glm::vec4>(device_.context, buffer, twin_.size())) {
            vectors.emplace_back(v.x, v.y, v.z);
        }
        return vectors;
    }

    PassError compare_first_move()
    {
        device_.run([&] { pbf_.record_move(device_.commands, device_.fluid(), 0); });
        const double dt = static_cast<double>(device_.params.dt);
        std::vector<glm::dvec3> moves;
        for (const glm::dvec3& a : twin_.acceleration) {
            moves.push_back(dt * dt * a);
        }
        reference::hold_moves_off_walls(settings_, twin_, moves);
        const std::vector<glm::dvec3> expected = reference::moved_positions(twin_, moves);
        const std::vector<glm::dvec3> found = downloaded(pbf_.moved());
        const std::vector<glm::dvec3> found_moves = downloaded(pbf_.move());
        RelativeError error;
        for (std::size_t i = 0; i < twin_.size(); ++i) {
            error.add(glm::length(found[i] - expected[i]), glm::length(expected[i]));
            error.add(glm::length(found_moves[i] - moves[i]), glm::length(moves[i]));
        }
        return {"solve: first move", error.value(), pass_bound};
    }

    /// Density, X and A that a residual pass has left, from the positions that it had.
    std::vector<PassError> compare_constraints(std::uint32_t iteration)
    {
        const std::vector<glm::dvec3> moved = downloaded(pbf_.moved());
        const auto found = gpu::download<glm::vec4>(device_.context, device_.particles.interaction, twin_.size());
        const auto density = gpu::download<float>(device_.context, device_.particles.density, twin_.size());
        RelativeError density_error;
        RelativeError impulse_error;
        constraints_.assign(twin_.size(), {});
        for (std::size_t i = 0; i < twin_.size(); ++i) {
            if (reference::is_boundary(twin_, i)) {
                continue;
            }
            const reference::Constraint expected = reference::constraint(settings_, twin_, neighbors_, moved, i);
            const double impulse = static_cast<double>(found[i].x) / scale_;
            const double artificial = static_cast<double>(found[i].w) / scale_;
            density_error.add(static_cast<double>(density[i]) - expected.density, expected.density);
            const double unit = expected.impulse_per_excess;
            impulse_error.add(impulse - expected.impulse, unit * (expected.excess + 2.0));
            impulse_error.add(artificial - expected.artificial, unit);
            constraints_[i] = expected;
            constraints_[i].impulse = impulse;
            constraints_[i].artificial = artificial;
        }
        const std::string name = iteration == 0 ? "solve: first " : "solve: second ";
        return {{name + "density", density_error.value(), pass_bound},
                {name + "constraint", impulse_error.value(), pass_bound}};
    }

    PassError compare_correction()
    {
        const std::vector<glm::dvec3> moved = downloaded(pbf_.moved());
        const std::vector<glm::dvec3> before = downloaded(pbf_.move());
        device_.run([&] { pbf_.record_correct(device_.commands, device_.fluid()); });
        const std::vector<glm::dvec3> after = downloaded(pbf_.move());
        RelativeError error;
        for (std::size_t i = 0; i < twin_.size(); ++i) {
            if (!reference::is_boundary(twin_, i)) {
                const reference::VectorSum change =
                    reference::position_correction(settings_, twin_, neighbors_, moved, constraints_, i);
                error.add(glm::length(after[i] - before[i] - change.value), glm::length(before[i]) + change.magnitude);
            }
        }
        return {"solve: correction", error.value(), pass_bound};
    }

    PassError compare_iterations()
    {
        reference::State state = twin_;
        std::vector<glm::dvec3> moves;
        const reference::SolveResult expected = reference::solve_positions(settings_, state, neighbors_, moves);
        device_.run([&] {
            device_.commands.fill(*pbf_.solves(), 0);
            pbf_.record_solve(device_.commands, device_.fluid());
        });
        const shared::Solve found =
            gpu::download<shared::Solve>(device_.context, *pbf_.solves(), shared::SOLVES)[shared::SOLVE_DENSITY];
        return {"solve: iterations",
                std::abs(static_cast<double>(found.iterations) - static_cast<double>(expected.iterations)), 1.0};
    }

    std::vector<PassError> compare_finish()
    {
        reference::State state = reference::from_particle_set(download_unordered(device_.context, device_.particles));
        const double dt = static_cast<double>(device_.params.dt);
        for (double& pressure : state.pressure) {
            pressure /= scale_; // until the end it is a sum of dt^2 p V^2, as the device scales it
        }
        const std::vector<glm::dvec3> moves = downloaded(pbf_.move());
        device_.run([&] {
            device_.commands.fill(*pbf_.solves(), 0);
            pbf_.record_finish(device_.commands, device_.fluid(), 0);
        });
        const std::uint32_t capped = reference::finish(settings_, state, moves);
        const ParticleSet found = download_unordered(device_.context, device_.particles);
        const shared::Solve solve =
            gpu::download<shared::Solve>(device_.context, *pbf_.solves(), shared::SOLVES)[shared::SOLVE_DENSITY];
        RelativeError position;
        RelativeError velocity;
        RelativeError pressure;
        for (std::size_t i = 0; i < found.size(); ++i) {
            position.add(found.position[i], state.position[i], glm::length(state.position[i]));
            velocity.add(found.velocity[i], state.velocity[i],
                         glm::length(state.velocity[i]) + glm::length(moves[i]) / dt);
            pressure.add(static_cast<double>(found.pressure[i]) - state.pressure[i], state.pressure[i]);
        }
        const double counted = std::abs(static_cast<double>(solve.capped) - static_cast<double>(capped));
        return {{"finish: position", position.value(), pass_bound},
                {"finish: velocity", velocity.value(), pass_bound},
                {"finish: pressure", pressure.value(), pass_bound},
                {"finish: particles at the speed cap", counted, 0.001 * static_cast<double>(found.size())}};
    }

    /// Of the next step, from velocities that bring some particles too near to walls.
    std::vector<PassError> compare_predict()
    {
        reference::State state = reference::from_particle_set(download_unordered(device_.context, device_.particles));
        device_.run([&] { pbf_.record_predict(device_.commands, device_.fluid()); });
        reference::predict(settings_, state);
        const ParticleSet found = download_unordered(device_.context, device_.particles);
        const MotionError error = motion_error(found, state);
        return {{"predict: position", error.position.value(), pass_bound},
                {"predict: velocity", error.velocity.value(), pass_bound}};
    }

    Device& device_;
    const reference::Settings& settings_;
    reference::State twin_;
    const reference::Neighbors& neighbors_;
    sim::Pbf pbf_;
    double scale_;
    std::vector<reference::Constraint> constraints_;
};

} // namespace

std::vector<PassError> compare_pbf_passes(Device& device, const sim::FluidOptions& options,
                                          const reference::Settings& settings, const reference::State& twin,
                                          const reference::Neighbors& neighbors)
{
    const ParticleSet before = download_unordered(device.context, device.particles);
    std::vector<PassError> errors = PbfComparison(device, options, settings, twin, neighbors).compare();
    upload(device.context, before, device.particles);
    device.run([&] {
        sim::record_density(device.commands, device.kernels, device.params_buffer, device.particles, device.grid);
    });
    return errors;
}

} // namespace meltpoint::conformance
