#include "conformance/dfsph_comparison.h"

#include <cmath>
#include <string>
#include <utility>

#include "conformance/relative_error.h"
#include "core/random.h"
#include "reference/dfsph.h"
#include "reference/integrate.h"
#include "sim/dfsph.h"

namespace meltpoint::conformance {

namespace {

/// The passes of one solve, on the device and in the twin, from the same warm start.
class SolveComparison {
public:
    SolveComparison(Device& device, const sim::FluidOptions& options, const reference::Settings& settings,
                    const reference::State& twin, const reference::Neighbors& neighbors, std::uint32_t solve)
        : device_(device), settings_(settings), twin_(twin), neighbors_(neighbors), solve_(solve),
          name_(solve == shared::SOLVE_DENSITY ? "density solve" : "divergence solve"),
          dfsph_(device.context, options, device.params), scale_(static_cast<double>(device.params.gradient_scale)),
          diagonal_(twin.size(), 0.0)
    {
        for (std::size_t i = 0; i < twin.size(); ++i) {
            if (!reference::is_boundary(twin, i)) {
                diagonal_[i] = reference::jacobi_diagonal(settings, twin, neighbors, i);
            }
        }
    }

    std::vector<PassError> compare()
    {
        set_warm_start();
        std::vector<PassError> errors;
        device_.run([&] { dfsph_.record_residual(device_.commands, device_.fluid(), {solve_, 0}); });
        errors.push_back(compare_iterate(twin_.velocity, 0));
        const std::vector<shared::Solve> going_on = solves();
        device_.run([&] { dfsph_.record_correct(device_.commands, device_.fluid(), solve_); });
        errors.push_back({name_ + ": correction", compare_correction(), pass_bound});
        device_.run([&] { dfsph_.record_residual(device_.commands, device_.fluid(), {solve_, 1}); });
        errors.push_back(compare_iterate(corrected(), 1));
        errors.push_back(compare_momentum(going_on));

        set_warm_start();
        reference::State state = twin_;
        std::vector<double> warm_start = warm_start_;
        const reference::SolveResult expected = reference::solve(settings_, state, neighbors_, solve_, warm_start);
        const gpu::Buffer& velocity = device_.particles.velocity;
        const auto before = gpu::download<glm::vec4>(device_.context, velocity, twin_.size());
        device_.run([&] { dfsph_.record_solve(device_.commands, device_.fluid(), solve_); });
        const shared::Solve found = solves()[solve_];
        errors.push_back({name_ + ": iterations",
                          std::abs(static_cast<double>(found.iterations) - static_cast<double>(expected.iterations)),
                          1.0});
        gpu::upload<glm::vec4>(device_.context, device_.particles.velocity, before);
        return errors;
    }

private:
    /// Impulses of about what keeps a neighbor away, so that a first iterate has something to start from.
    void set_warm_start()
    {
        Random random(9);
        warm_start_.assign(twin_.size(), 0.0);
        std::vector<glm::vec2> on_device(twin_.size(), glm::vec2(0.0f));
        for (std::size_t i = 0; i < twin_.size(); ++i) {
            const double rest_volume = twin_.mass[i] / reference::rest_density(settings_, twin_, i);
            const double impulse = diagonal_[i] > 0.0 ? random.uniform() * diagonal_[i] * 0.1 / rest_volume : 0.0;
            on_device[i][static_cast<int>(solve_)] = static_cast<float>(scale_ * impulse);
            warm_start_[i] = static_cast<double>(on_device[i][static_cast<int>(solve_)]) / scale_;
        }
        gpu::upload<glm::vec2>(device_.context, dfsph_.warm_start(), on_device);
        device_.run([&] { device_.commands.fill(*dfsph_.solves(), 0); });
    }

    [[nodiscard]] std::vector<shared::Solve> solves() const
    {
        return gpu::download<shared::Solve>(device_.context, *dfsph_.solves(), shared::SOLVES);
    }

    [[nodiscard]] std::vector<glm::vec4> interactions() const
    {
        return gpu::download<glm::vec4>(device_.context, device_.particles.interaction, twin_.size());
    }

    [[nodiscard]] std::vector<glm::dvec3> corrected() const
    {
        std::vector<glm::dvec3> velocity;
        for (const glm::vec4& v :
             gpu::download<glm::vec4>(device_.context, device_.grid.sorted_velocity, twin_.size())) {
            velocity.emplace_back(v.x, v.y, v.z);
        }
        return velocity;
    }

    /// A third iterate, with the momentum of one that comes late in a solve.
    PassError compare_momentum(std::vector<shared::Solve> going_on)
    {
        constexpr std::uint32_t late = 6;
        going_on[solve_].unrisen = late;
        gpu::upload<shared::Solve>(device_.context, *dfsph_.solves(), going_on);
        const std::vector<double> before = jacobi_steps();
        device_.run([&] { dfsph_.record_correct(device_.commands, device_.fluid(), solve_); });
        const std::vector<glm::dvec3> velocity = corrected();
        device_.run([&] { dfsph_.record_residual(device_.commands, device_.fluid(), {solve_, 2}); });
        return compare_iterate(velocity, 2, before, static_cast<double>(shared::solve_momentum(late)));
    }

    /// The last iterate without momentum.
    [[nodiscard]] std::vector<double> jacobi_steps() const
    {
        std::vector<double> steps;
        for (const float step : gpu::download<float>(device_.context, dfsph_.jacobi_step(), twin_.size())) {
            steps.push_back(static_cast<double>(step) / scale_);
        }
        return steps;
    }

    /// The impulses that a residual pass has left, from the velocities and the iterate that it had; `before` is the
    /// iterate that its momentum goes on from.
    PassError compare_iterate(const std::vector<glm::dvec3>& velocity, std::uint32_t iteration,
                              const std::vector<double>& before = {}, double momentum = 0.0)
    {
        const std::vector<glm::vec4> found = interactions();
        RelativeError error;
        std::uint64_t excluded = 0;
        for (std::size_t i = 0; i < twin_.size(); ++i) {
            if (reference::is_boundary(twin_, i)) {
                continue;
            }
            const reference::ScalarSum excess = reference::excess(settings_, twin_, neighbors_, velocity, solve_, i);
            if (is_undecided(excess, i)) {
                ++excluded;
                continue;
            }
            const double start = iteration == 0
                                     ? reference::first_impulse(settings_, excess.value, warm_start_[i], solve_)
                                     : impulse_[i];
            const double step = reference::next_impulse(settings_, twin_, diagonal_[i], excess.value, start, i);
            const double next = before.empty() ? step : reference::with_momentum(step, before[i], momentum);
            const double magnitude =
                reference::next_impulse(settings_, twin_, diagonal_[i], excess.magnitude, start, i);
            error.add(static_cast<double>(found[i].x) / scale_ - next, magnitude);
        }
        impulse_.resize(twin_.size());
        for (std::size_t i = 0; i < twin_.size(); ++i) {
            impulse_[i] = static_cast<double>(found[i].x) / scale_;
        }
        return {name_ + (iteration == 0   ? ": first iterate"
                         : iteration == 1 ? ": second iterate"
                                          : ": momentum"),
                error.value(), pass_bound, excluded};
    }

    /// Whether rounding decides that there is nothing to take away.
    [[nodiscard]] bool is_undecided(const reference::ScalarSum& excess, std::size_t i) const
    {
        constexpr double rounding_zone = 1e-6;
        const double filled = twin_.density[i] / reference::rest_density(settings_, twin_, i) -
                              static_cast<double>(shared::DIVERGENCE_FILL);
        return std::abs(excess.value) < rounding_zone * excess.magnitude ||
               (solve_ == shared::SOLVE_DIVERGENCE && std::abs(filled) < rounding_zone);
    }

    double compare_correction()
    {
        const std::vector<glm::dvec3> found = corrected();
        RelativeError error;
        for (std::size_t i = 0; i < twin_.size(); ++i) {
            if (!reference::is_boundary(twin_, i)) {
                const reference::VectorSum change =
                    reference::velocity_correction(settings_, twin_, neighbors_, impulse_, i);
                error.add(glm::vec3(found[i]), twin_.velocity[i] + change.value,
                          glm::length(twin_.velocity[i]) + change.magnitude);
            }
        }
        return error.value();
    }

    Device& device_;
    const reference::Settings& settings_;
    const reference::State& twin_;
    const reference::Neighbors& neighbors_;
    std::uint32_t solve_;
    std::string name_;
    sim::Dfsph dfsph_;
    double scale_;
    std::vector<double> diagonal_;
    std::vector<double> warm_start_;
    std::vector<double> impulse_;
};

PassError compare_diagonal(Device& device, const reference::Settings& settings, const reference::State& twin,
                           const reference::Neighbors& neighbors)
{
    const auto found = gpu::download<glm::vec4>(device.context, device.particles.interaction, twin.size());
    RelativeError error;
    for (std::size_t i = 0; i < twin.size(); ++i) {
        if (!reference::is_boundary(twin, i)) {
            // The response itself: its inverse would be all about pairs that hardly touch.
            const double diagonal = reference::jacobi_diagonal(settings, twin, neighbors, i);
            const double expected = diagonal > 0.0 ? 1.0 / diagonal : 0.0;
            error.add((found[i].w > 0.0f
                           ? static_cast<double>(device.params.gradient_scale) / static_cast<double>(found[i].w)
                           : 0.0) -
                          expected,
                      expected);
        }
    }
    return {"diagonal", error.value(), pass_bound};
}

/// The drift, from velocities that bring some particles too near to walls.
std::vector<PassError> compare_drift(Device& device, const sim::FluidOptions& options,
                                     const reference::Settings& settings)
{
    sim::Dfsph dfsph(device.context, options, device.params);
    reference::State twin = reference::from_particle_set(download_unordered(device.context, device.particles));
    const double scale = static_cast<double>(device.params.gradient_scale);
    Random random(10);
    reference::WarmStarts warm_starts;
    std::vector<glm::vec2> on_device;
    for (std::size_t i = 0; i < twin.size(); ++i) {
        const double impulse = scale * std::pow(twin.mass[i] / reference::rest_density(settings, twin, i), 2.0);
        on_device.emplace_back(random.uniform() * impulse, random.uniform() * impulse);
        on_device.back()[static_cast<int>(shared::SOLVE_DENSITY)] *= device.params.dt; // so that both count
        for (const std::uint32_t solve : {shared::SOLVE_DIVERGENCE, shared::SOLVE_DENSITY}) {
            warm_starts[solve].push_back(static_cast<double>(on_device.back()[static_cast<int>(solve)]) / scale);
        }
    }
    gpu::upload<glm::vec2>(device.context, dfsph.warm_start(), on_device);
    device.run([&] { dfsph.record_drift(device.commands, device.fluid(), 0); });
    RelativeError pressure;
    const ParticleSet after = download_unordered(device.context, device.particles);
    for (std::size_t i = 0; i < twin.size(); ++i) {
        const double expected = reference::solved_pressure(settings, twin, warm_starts, i);
        pressure.add(static_cast<double>(after.pressure[i]) - expected, expected);
    }
    reference::hold_off_walls(settings, twin);
    reference::drift(settings, twin);
    const auto [position, velocity] = motion_error(after, twin);
    return {{"drift: position", position.value(), pass_bound},
            {"drift: velocity", velocity.value(), pass_bound},
            {"drift: pressure", pressure.value(), pass_bound}};
}

} // namespace

std::vector<PassError> compare_dfsph_passes(Device& device, const sim::FluidOptions& options,
                                            const reference::Settings& settings, const reference::State& twin,
                                            const reference::Neighbors& neighbors)
{
    std::vector<PassError> errors{compare_diagonal(device, settings, twin, neighbors)};
    for (const std::uint32_t solve : {shared::SOLVE_DIVERGENCE, shared::SOLVE_DENSITY}) {
        for (PassError& error : SolveComparison(device, options, settings, twin, neighbors, solve).compare()) {
            errors.push_back(std::move(error));
        }
    }
    const ParticleSet before = download_unordered(device.context, device.particles);
    for (PassError& error : compare_drift(device, options, settings)) {
        errors.push_back(std::move(error));
    }
    upload(device.context, before, device.particles);
    return errors;
}

} // namespace meltpoint::conformance
