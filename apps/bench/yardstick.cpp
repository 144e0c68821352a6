#include "bench/yardstick.h"

#include <algorithm>
#include <barrier>
#include <cmath>
#include <cstring>
#include <thread>
#include <vector>

#include <glm/glm.hpp>

#include "bench/yardstick_kernels.h"
#include "bench/yardstick_sort.h"
#include "particles/sph_kernel.h"

namespace meltpoint::bench {

namespace {

float pressure_at(const shared::SphParams& params, float density, float rest_density)
{
    const float c2 = params.speed_of_sound * params.speed_of_sound;
    const float excess =
        params.state_equation == shared::STATE_EQUATION_TAIT
            ? c2 * rest_density / params.gamma * (std::pow(density / rest_density, params.gamma) - 1.0f)
            : c2 * (density - rest_density);
    const float p = excess + params.background_pressure;
    return params.clamp_pressure != 0 ? std::max(p, 0.0f) : p;
}

float rest_density_of(const shared::SphParams& params, std::uint32_t attributes)
{
    return params.rest_density[shared::particle_material(attributes)];
}

} // namespace

class Yardstick::State {
public:
    State(const ParticleSet& particles, const shared::SphParams& params, std::uint32_t kernel, std::uint32_t threads)
        : params_(params), kernel_(kernel), threads_(std::max(threads, 1u)),
          fluid_{params.support_radius, params.density_scale, params.viscosity[0] * params.viscosity_scale,
                 kernel == shared::KERNEL_WENDLAND},
          wall_friction_(
              params.wall_viscosity * params.viscosity_scale /
              static_cast<float>(continuum_scales(kernel, static_cast<double>(params.support_radius)).viscosity)),
          sorted_(particles, params, threads_)
    {
    }

    void run(std::uint32_t steps, bool only_density);
    [[nodiscard]] ParticleSet particles();

private:
    using Range = SortedParticles::Range;

    void work(std::uint32_t thread, std::uint32_t steps, bool only_density, std::barrier<>& barrier);
    void kick(const Range& range, bool drift);
    void state_equation(const Range& range);
    void finish_accelerations(const Range& range);
    [[nodiscard]] glm::vec3 wall_acceleration(const glm::vec3& x, const glm::vec3& v, float density) const;

    shared::SphParams params_;
    std::uint32_t kernel_;
    std::uint32_t threads_;
    kernels::Fluid fluid_;
    float wall_friction_; ///< times the viscous kernel's integral beyond a wall: acceleration per v / rho
    SortedParticles sorted_;
};

void Yardstick::State::run(std::uint32_t steps, bool only_density)
{
    std::barrier<> barrier(threads_);
    std::vector<std::jthread> threads;
    for (std::uint32_t thread = 1; thread < threads_; ++thread) {
        threads.emplace_back(
            [this, thread, steps, only_density, &barrier] { work(thread, steps, only_density, barrier); });
    }
    work(0, steps, only_density, barrier);
}

/// The steps of one thread. Between two barriers threads write to different places only.
void Yardstick::State::work(std::uint32_t thread, std::uint32_t steps, bool only_density, std::barrier<>& barrier)
{
    const auto alone = [&](const auto& body) {
        barrier.arrive_and_wait();
        if (thread == 0) {
            body();
        }
        barrier.arrive_and_wait();
    };
    for (std::uint32_t step = 0; step < steps; ++step) {
        if (!only_density) {
            kick(sorted_.part(thread), true);
        }
        sorted_.count_cells(thread);
        alone([&] { sorted_.scan_cells(); });
        sorted_.scatter(thread, only_density);
        alone([&] { sorted_.use_new_order(); });
        const Range part = sorted_.part(thread);
        kernels::density(fluid_, sorted_.grid(), sorted_.arrays(), sorted_.is_ghost(), part.begin, part.end);
        state_equation(part);
        barrier.arrive_and_wait();
        if (only_density) {
            continue;
        }
        sorted_.copy_to_ghosts(thread);
        barrier.arrive_and_wait();
        kernels::forces(fluid_, sorted_.grid(), sorted_.arrays(), sorted_.is_ghost(), part.begin, part.end);
        // The other threads still read this part's velocities.
        barrier.arrive_and_wait();
        finish_accelerations(part);
        kick(part, false);
    }
}

/// Half a kick, and the drift. Ghosts move along; the next sort drops them.
void Yardstick::State::kick(const Range& range, bool drift)
{
    const kernels::Arrays a = sorted_.arrays();
    const float half_step = 0.5f * params_.dt;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
        a.vx[i] += half_step * a.ax[i];
        a.vy[i] += half_step * a.ay[i];
        a.vz[i] += half_step * a.az[i];
    }
    if (drift) {
        for (std::uint32_t i = range.begin; i < range.end; ++i) {
            a.x[i] += params_.dt * a.vx[i];
            a.y[i] += params_.dt * a.vy[i];
            a.z[i] += params_.dt * a.vz[i];
        }
    }
}

void Yardstick::State::state_equation(const Range& range)
{
    const kernels::Arrays a = sorted_.arrays();
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
        if (sorted_.is_ghost()[i] == 0) {
            const float p = pressure_at(params_, a.density[i], rest_density_of(params_, sorted_.attributes()[i]));
            a.volume[i] = a.mass[i] / a.density[i];
            a.pressure_term[i] = params_.gradient_scale * p * a.volume[i] * a.volume[i];
        }
    }
}

/// Friction against walls at rest, and the contact spring.
glm::vec3 Yardstick::State::wall_acceleration(const glm::vec3& x, const glm::vec3& v, float density) const
{
    glm::vec3 sum(0.0f);
    for (int wall = 0; wall < 6; ++wall) {
        const int axis = wall / 2;
        const float normal = wall % 2 == 0 ? 1.0f : -1.0f;
        const float distance = normal * (x[axis] - (wall % 2 == 0 ? params_.domain_min : params_.domain_max)[axis]);
        if ((params_.wall_mask >> wall & 1u) == 0 || distance >= params_.support_radius) {
            continue;
        }
        if (distance < params_.contact_distance) {
            const float spring = params_.contact_stiffness * (params_.contact_distance - distance);
            sum[axis] += normal * std::max(spring - params_.contact_damping * v[axis] * normal, 0.0f);
        }
        if (wall_friction_ > 0.0f) {
            sum -= wall_friction_ / density *
                   static_cast<float>(wall_viscosity_integral(kernel_, static_cast<double>(distance),
                                                              static_cast<double>(params_.support_radius))) *
                   v;
        }
    }
    return sum;
}

void Yardstick::State::finish_accelerations(const Range& range)
{
    const kernels::Arrays a = sorted_.arrays();
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
        if (sorted_.is_ghost()[i] == 0) {
            const glm::vec3 more = params_.gravity + wall_acceleration({a.x[i], a.y[i], a.z[i]},
                                                                       {a.vx[i], a.vy[i], a.vz[i]}, a.density[i]);
            a.ax[i] += more.x;
            a.ay[i] += more.y;
            a.az[i] += more.z;
        }
    }
}

ParticleSet Yardstick::State::particles()
{
    const kernels::Arrays a = sorted_.arrays();
    ParticleSet set;
    set.resize(sorted_.particles());
    for (std::uint32_t i = 0; i < sorted_.slots(); ++i) {
        if (sorted_.is_ghost()[i] != 0) {
            continue;
        }
        const std::uint32_t id = sorted_.ids()[i];
        set.attributes[id] = sorted_.attributes()[i];
        set.position[id] = {a.x[i], a.y[i], a.z[i]};
        set.velocity[id] = {a.vx[i], a.vy[i], a.vz[i]};
        set.acceleration[id] = {a.ax[i], a.ay[i], a.az[i]};
        set.mass[id] = a.mass[i];
        set.density[id] = a.density[i];
        set.pressure[id] = pressure_at(params_, a.density[i], rest_density_of(params_, sorted_.attributes()[i]));
    }
    return set;
}

Yardstick::Yardstick(const ParticleSet& particles, const shared::SphParams& params, std::uint32_t kernel,
                     std::uint32_t threads)
    : state_(std::make_unique<State>(particles, params, kernel, threads))
{
}

Yardstick::~Yardstick() = default;

void Yardstick::evaluate_density()
{
    state_->run(1, true);
}

void Yardstick::advance(std::uint32_t steps)
{
    state_->run(steps, false);
}

ParticleSet Yardstick::particles() const
{
    return state_->particles();
}

std::string Yardstick::missing_feature()
{
    for (const char* const* feature = kernels::required_features; *feature != nullptr; ++feature) {
        const auto is = [feature](const char* name) {
            return std::strcmp(*feature, name) == 0;
        };
        // __builtin_cpu_supports takes literals only.
        const bool is_there =
            (is("avx512f") && __builtin_cpu_supports("avx512f")) ||
            (is("avx512vl") && __builtin_cpu_supports("avx512vl")) ||
            (is("avx512bw") && __builtin_cpu_supports("avx512bw")) ||
            (is("avx512dq") && __builtin_cpu_supports("avx512dq")) || (is("avx2") && __builtin_cpu_supports("avx2")) ||
            (is("fma") && __builtin_cpu_supports("fma")) || (is("bmi2") && __builtin_cpu_supports("bmi2")) ||
            (is("sse4.2") && __builtin_cpu_supports("sse4.2"));
        if (!is_there) {
            return *feature;
        }
    }
    return {};
}

} // namespace meltpoint::bench
