#include "bench/yardstick_sort.h"

#include <algorithm>
#include <array>
#include <utility>

namespace meltpoint::bench {

namespace {

// The domain's cells lie inside a border of cells for the ghosts: as far as a support radius reaches, and as far again
// as the loops over the cells of a ghost's neighbor would look.
constexpr std::uint32_t border_x = 2 * shared::CELLS_PER_SUPPORT_X;
constexpr std::uint32_t border = 2;

constexpr std::size_t float_arrays = sizeof(kernels::Arrays) / sizeof(float*);

} // namespace

void SortedParticles::Storage::resize(std::size_t count)
{
    if (count > capacity) {
        capacity = count + count / 8;
        floats.resize(float_arrays * capacity);
        ids.resize(capacity);
        attributes.resize(capacity);
        is_ghost.resize(capacity);
        cells.resize(capacity);
    }
}

kernels::Arrays SortedParticles::Storage::arrays()
{
    std::array<float*, float_arrays> a{};
    for (std::size_t i = 0; i < a.size(); ++i) {
        a[i] = floats.data() + i * capacity;
    }
    return {a[0], a[1], a[2], a[3], a[4], a[5], a[6], a[7], a[8], a[9], a[10], a[11], a[12]};
}

SortedParticles::SortedParticles(const ParticleSet& particles, const shared::SphParams& params, std::uint32_t threads)
    : params_(params), threads_(threads), particles_(static_cast<std::uint32_t>(particles.size())), slots_(particles_),
      size_(params.grid_size + glm::uvec3(2 * border_x, 2 * border, 2 * border)),
      cell_start_(std::size_t{size_.x} * size_.y * size_.z + 1), cell_counts_(threads), ghosts_(threads)
{
    for (std::vector<std::uint32_t>& counts : cell_counts_) {
        counts.resize(cell_start_.size());
    }
    now_.resize(particles_);
    const kernels::Arrays a = now_.arrays();
    for (std::uint32_t i = 0; i < particles_; ++i) {
        now_.ids[i] = particles.id[i];
        now_.attributes[i] = particles.attributes[i];
        now_.is_ghost[i] = 0;
        a.x[i] = particles.position[i].x;
        a.y[i] = particles.position[i].y;
        a.z[i] = particles.position[i].z;
        a.vx[i] = particles.velocity[i].x;
        a.vy[i] = particles.velocity[i].y;
        a.vz[i] = particles.velocity[i].z;
        a.ax[i] = particles.acceleration[i].x;
        a.ay[i] = particles.acceleration[i].y;
        a.az[i] = particles.acceleration[i].z;
        a.mass[i] = particles.mass[i];
    }
}

std::uint32_t SortedParticles::cell_of(const glm::vec3& x) const
{
    const glm::vec3 cells_per_meter = glm::vec3(shared::CELLS_PER_SUPPORT_X, 1.0f, 1.0f) / params_.support_radius;
    const glm::vec3 place = (x - params_.domain_min) * cells_per_meter + glm::vec3(border_x, border, border);
    const glm::vec3 least(2.0f, 1.0f, 1.0f); // keeps the loops over neighbors inside the grid
    const glm::uvec3 c(glm::clamp(place, least, glm::vec3(size_) - least - 1.0f));
    return (c.z * size_.y + c.y) * size_.x + c.x;
}

void SortedParticles::count_cells(std::uint32_t thread)
{
    const Range range = part(thread);
    const kernels::Arrays a = now_.arrays();
    std::vector<std::uint32_t>& counts = cell_counts_[thread];
    std::fill(counts.begin(), counts.end(), 0u);
    ghosts_[thread].clear();
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
        if (now_.is_ghost[i] == 0) {
            now_.cells[i] = cell_of({a.x[i], a.y[i], a.z[i]});
            ++counts[now_.cells[i]];
            add_ghosts(thread, i);
        }
    }
}

void SortedParticles::add_ghosts(std::uint32_t thread, std::uint32_t source)
{
    const kernels::Arrays a = now_.arrays();
    const glm::vec3 x(a.x[source], a.y[source], a.z[source]);
    const float h = params_.support_radius;
    const glm::bvec3 low = glm::lessThan(x - params_.domain_min, glm::vec3(h));
    const glm::bvec3 high = glm::lessThan(params_.domain_max - x, glm::vec3(h));
    if (!glm::any(low) && !glm::any(high)) {
        return;
    }
    const glm::vec3 v(a.vx[source], a.vy[source], a.vz[source]);
    const std::size_t begin = ghosts_[thread].size();
    const auto reflect = [&](const glm::vec3& position, const glm::vec3& velocity, int axis, float plane) {
        Ghost ghost{source, 0, 0, position, velocity};
        ghost.position[axis] = 2.0f * plane - ghost.position[axis];
        ghost.velocity[axis] = -ghost.velocity[axis];
        ghosts_[thread].push_back(ghost);
    };
    for (int axis = 0; axis < 3; ++axis) {
        for (const bool upper : {false, true}) {
            const bool near = upper ? high[axis] : low[axis];
            if (!near || (params_.wall_mask & (1u << (2 * axis + (upper ? 1 : 0)))) == 0) {
                continue;
            }
            const float plane = upper ? params_.domain_max[axis] : params_.domain_min[axis];
            const std::size_t end = ghosts_[thread].size();
            for (std::size_t k = begin; k < end; ++k) {
                reflect(ghosts_[thread][k].position, ghosts_[thread][k].velocity, axis, plane);
            }
            reflect(x, v, axis, plane);
        }
    }
    for (std::size_t k = begin; k < ghosts_[thread].size(); ++k) {
        ghosts_[thread][k].cell = cell_of(ghosts_[thread][k].position);
        ++cell_counts_[thread][ghosts_[thread][k].cell];
    }
}

/// Where each thread's share of each cell begins.
void SortedParticles::scan_cells()
{
    std::uint32_t running = 0;
    const std::size_t cells = cell_start_.size() - 1;
    for (std::size_t cell = 0; cell < cells; ++cell) {
        cell_start_[cell] = running;
        for (std::vector<std::uint32_t>& counts : cell_counts_) {
            const std::uint32_t count = counts[cell];
            counts[cell] = running;
            running += count;
        }
    }
    cell_start_[cells] = running;
    next_.resize(running);
    new_slot_.resize(std::max<std::size_t>(new_slot_.size(), slots_));
}

void SortedParticles::scatter(std::uint32_t thread, bool with_accelerations)
{
    const Range range = part(thread);
    const kernels::Arrays from = now_.arrays();
    const kernels::Arrays to = next_.arrays();
    std::vector<std::uint32_t>& places = cell_counts_[thread];
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
        if (now_.is_ghost[i] != 0) {
            continue;
        }
        const std::uint32_t slot = places[now_.cells[i]]++;
        new_slot_[i] = slot;
        to.x[slot] = from.x[i];
        to.y[slot] = from.y[i];
        to.z[slot] = from.z[i];
        to.vx[slot] = from.vx[i];
        to.vy[slot] = from.vy[i];
        to.vz[slot] = from.vz[i];
        to.mass[slot] = from.mass[i];
        next_.ids[slot] = now_.ids[i];
        next_.attributes[slot] = now_.attributes[i];
        next_.cells[slot] = now_.cells[i];
        next_.is_ghost[slot] = 0;
        if (with_accelerations) {
            to.ax[slot] = from.ax[i];
            to.ay[slot] = from.ay[i];
            to.az[slot] = from.az[i];
        }
    }
    for (Ghost& ghost : ghosts_[thread]) {
        ghost.slot = places[ghost.cell]++;
        ghost.source = new_slot_[ghost.source]; // of this thread's range
        to.x[ghost.slot] = ghost.position.x;
        to.y[ghost.slot] = ghost.position.y;
        to.z[ghost.slot] = ghost.position.z;
        to.vx[ghost.slot] = ghost.velocity.x;
        to.vy[ghost.slot] = ghost.velocity.y;
        to.vz[ghost.slot] = ghost.velocity.z;
        next_.is_ghost[ghost.slot] = 1;
    }
}

void SortedParticles::use_new_order()
{
    std::swap(now_, next_);
    slots_ = cell_start_.back();
}

void SortedParticles::copy_to_ghosts(std::uint32_t thread)
{
    const kernels::Arrays a = now_.arrays();
    for (const Ghost& ghost : ghosts_[thread]) {
        a.pressure_term[ghost.slot] = a.pressure_term[ghost.source];
        a.volume[ghost.slot] = a.volume[ghost.source];
    }
}

} // namespace meltpoint::bench
