#include "geometry/relaxation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/parallel_for.h"
#include "geometry/outside_points.h"
#include "geometry/point_cells.h"

namespace meltpoint {

namespace {

constexpr float step = 0.4f;          // c: of x += -c d^2 sum V grad W
constexpr float core = 0.9f;          // d: neighbors nearer than this
constexpr float push = 0.3f;          // are pushed away by this part of what is missing
constexpr float longest_step = 0.2f;  // d
constexpr float skin = 0.4f;          // d: neighbors are looked for this much further away than they count
constexpr float outside_core = 0.76f; // d: the same for the pieces of what is outside
constexpr float outside_edge = 0.7f;  // d: of the pieces of what is outside
constexpr float may_leave = 1.0f;     // d: particles with such a piece nearer than this are watched
constexpr std::size_t most_iterations = 400;

/// Of W d^3, Wendland C2 in 3D.
float kernel_factor(float support)
{
    return static_cast<float>(21.0 / (2.0 * std::numbers::pi * std::pow(double{support}, 3)));
}

enum class Kind { Particle, Outside, Image };

/// Particles, pieces of what is outside and images behind mirrors, in a unit system with d = 1.
class Neighborhood {
public:
    Neighborhood(const std::vector<glm::vec3>& positions, const Solid& solid, const RelaxationSettings& settings)
        : spacing_(std::cbrt(solid.volume() / static_cast<double>(positions.size()))), origin_(solid.bounds().center()),
          support_(static_cast<float>(settings.support_ratio)), particles_(positions.size())
    {
        for (const glm::vec3& position : positions) {
            points_.push_back(to_units(position));
        }
        volumes_.assign(particles_, 1.0f);
        const OutsidePoints outside =
            points_outside(solid, double{outside_edge} * spacing_, settings.support_ratio * spacing_);
        for (std::size_t i = 0; i < outside.positions.size(); ++i) {
            if (!settings.mirrors || settings.mirrors->contains(outside.positions[i])) {
                points_.push_back(to_units(outside.positions[i]));
                volumes_.push_back(static_cast<float>(outside.volumes[i] / std::pow(spacing_, 3)));
            }
        }
        images_begin_ = points_.size();
        if (settings.mirrors) {
            mirrors_ = Aabb{to_units(settings.mirrors->min), to_units(settings.mirrors->max)};
        }
        find_neighbors();
    }

    [[nodiscard]] std::size_t size() const { return particles_; }
    [[nodiscard]] float support() const { return support_; }
    [[nodiscard]] glm::vec3 from_units(const glm::vec3& x) const
    {
        return glm::vec3(glm::dvec3(x) * spacing_ + origin_);
    }
    [[nodiscard]] const glm::vec3& operator[](std::size_t i) const { return points_[i]; }

    /// Calls visit(x, squared length of x, volume, kind) for x from each neighbor to particle i.
    template <class Visit>
    void visit_neighbors(std::size_t i, const Visit& visit) const
    {
        for (const std::uint32_t j : neighbors_[i]) {
            const glm::vec3 x = points_[i] - points_[j];
            const float r2 = glm::dot(x, x);
            if (r2 < support_ * support_) {
                visit(x, r2, volumes_[j],
                      j < particles_      ? Kind::Particle
                      : j < images_begin_ ? Kind::Outside
                                          : Kind::Image);
            }
        }
    }

    void move(const std::vector<glm::vec3>& moved)
    {
        std::copy(moved.begin(), moved.end(), points_.begin());
        for (std::size_t k = 0; k < images_.size(); ++k) {
            points_[images_begin_ + k] = images_[k].of(points_[images_[k].particle]);
        }
        float farthest2 = 0.0f;
        for (std::size_t i = 0; i < particles_; ++i) {
            const glm::vec3 way = points_[i] - found_at_[i];
            farthest2 = std::max(farthest2, glm::dot(way, way));
        }
        if (farthest2 > 0.25f * skin * skin) {
            find_neighbors();
        }
    }

private:
    struct Image {
        std::uint32_t particle;
        glm::vec3 sign;
        glm::vec3 shift;

        [[nodiscard]] glm::vec3 of(const glm::vec3& x) const { return sign * x + shift; }
    };

    [[nodiscard]] glm::vec3 to_units(const glm::vec3& position) const
    {
        return glm::vec3((glm::dvec3(position) - origin_) / spacing_);
    }

    /// Of particles near the mirrors: behind one, and behind two and three at edges and corners.
    void find_images()
    {
        images_.clear();
        points_.resize(images_begin_);
        for (std::uint32_t i = 0; mirrors_ && i < particles_; ++i) {
            std::vector<Image> found{{.particle = i, .sign = glm::vec3(1.0f), .shift = glm::vec3(0.0f)}};
            for (int axis = 0; axis < 3; ++axis) {
                const std::size_t count = found.size();
                for (const float mirror : {mirrors_->min[axis], mirrors_->max[axis]}) {
                    if (std::abs(points_[i][axis] - mirror) < support_ + skin) {
                        for (std::size_t k = 0; k < count; ++k) {
                            found.push_back(found[k]);
                            found.back().sign[axis] = -1.0f;
                            found.back().shift[axis] = 2.0f * mirror;
                        }
                    }
                }
            }
            images_.insert(images_.end(), found.begin() + 1, found.end()); // the first is no image
        }
        for (const Image& image : images_) {
            points_.push_back(image.of(points_[image.particle]));
        }
        volumes_.resize(points_.size(), 1.0f);
    }

    void find_neighbors()
    {
        find_images();
        found_at_.assign(points_.begin(), points_.begin() + static_cast<std::ptrdiff_t>(particles_));
        const PointCells cells(points_, double{support_ + skin});
        neighbors_.resize(particles_);
        parallel_for(points_.size(), [&](std::size_t place) {
            const std::uint32_t i = cells.order()[place];
            if (i >= particles_) {
                return;
            }
            neighbors_[i].clear();
            cells.visit_near(place, [&](std::uint32_t other) {
                const std::uint32_t j = cells.order()[other];
                const glm::vec3 x = points_[i] - points_[j];
                if (i != j && glm::dot(x, x) < (support_ + skin) * (support_ + skin)) {
                    neighbors_[i].push_back(j);
                }
            });
        });
    }

    double spacing_; ///< m
    glm::dvec3 origin_;
    float support_;
    std::size_t particles_;
    std::size_t images_begin_ = 0;
    std::optional<Aabb> mirrors_;
    std::vector<Image> images_;
    std::vector<glm::vec3> points_; ///< particles, pieces of what is outside, images
    std::vector<float> volumes_;
    std::vector<glm::vec3> found_at_;
    std::vector<std::vector<std::uint32_t>> neighbors_;
};

/// What the neighbors of a particle come to.
struct Surroundings {
    float density = 1.0f;   ///< over kernel_factor; a particle sees itself
    glm::vec3 way{0.0f};    ///< to go, d
    glm::vec3 inward{0.0f}; ///< away from what is outside
    float nearest2 = 0.0f;  ///< d^2, the support radius's square if there is none
    float nearest_outside2 = 0.0f;
};

Surroundings surroundings(const Neighborhood& all, std::size_t i)
{
    Surroundings result;
    const float support = all.support();
    result.nearest2 = result.nearest_outside2 = support * support;
    glm::vec3 gradient(0.0f);
    glm::vec3 away(0.0f);
    all.visit_neighbors(i, [&](const glm::vec3& x, float r2, float volume, Kind kind) {
        // Wendland C2 in 3D without its factor: (1 - q)^4 (1 + 4 q), gradient -20 (1 - q)^3 x / H^2.
        const float r = std::sqrt(r2);
        const float left = 1.0f - r / support;
        const float cubed = left * left * left;
        result.density += volume * cubed * left * (5.0f - 4.0f * left);
        gradient -= volume * 20.0f / (support * support) * cubed * x;
        if (kind != Kind::Particle) {
            result.nearest_outside2 = std::min(result.nearest_outside2, r2);
            result.inward += volume * cubed * x;
        } else {
            result.nearest2 = std::min(result.nearest2, r2);
        }
        const float reach = kind == Kind::Outside ? outside_core : core;
        away += r < reach && r > 0.0f ? push * (reach - r) / r * x : glm::vec3(0.0f);
    });
    result.way = away - step * kernel_factor(support) * gradient;
    const float length = glm::length(result.way);
    result.way *= length > longest_step ? longest_step / length : 1.0f;
    return result;
}

Evenness evenness_of(const std::vector<Surroundings>& all)
{
    const auto count = static_cast<double>(all.size());
    double sum = 0.0;
    float nearest2 = std::numeric_limits<float>::max();
    for (const Surroundings& one : all) {
        sum += static_cast<double>(one.density);
        nearest2 = std::min(nearest2, one.nearest2);
    }
    const double mean = sum / count;
    double squares = 0.0;
    for (const Surroundings& one : all) {
        squares += (static_cast<double>(one.density) - mean) * (static_cast<double>(one.density) - mean);
    }
    return {std::sqrt(squares / count) / mean, std::sqrt(double{nearest2}) / densest_packing};
}

std::vector<Surroundings> all_surroundings(const Neighborhood& all)
{
    std::vector<Surroundings> result(all.size());
    parallel_for(all.size(), [&](std::size_t i) { result[i] = surroundings(all, i); });
    return result;
}

} // namespace

Evenness evenness_of(const std::vector<glm::vec3>& positions, const Solid& solid, const RelaxationSettings& settings)
{
    return positions.empty() ? Evenness{} : evenness_of(all_surroundings(Neighborhood(positions, solid, settings)));
}

Relaxation relax_particles(std::vector<glm::vec3>& positions, const Solid& solid, const RelaxationSettings& settings)
{
    Relaxation result;
    if (positions.empty()) {
        return result;
    }
    Neighborhood all(positions, solid, settings);
    std::vector<glm::vec3> moved(all.size());
    for (;; ++result.iterations) {
        const std::vector<Surroundings> around = all_surroundings(all);
        result.evenness = evenness_of(around);
        if ((result.evenness.density_spread <= relaxed_spread && result.evenness.relative_radius >= relaxed_radius) ||
            result.iterations == most_iterations) {
            break;
        }
        parallel_for(all.size(), [&](std::size_t i) {
            moved[i] = all[i] + around[i].way;
            if (around[i].nearest_outside2 >= may_leave * may_leave) {
                return;
            }
            const auto is_inside = [&] {
                return solid.contains(glm::dvec3(all.from_units(moved[i])));
            };
            if (!is_inside()) { // then along the surface, and else not at all
                const glm::vec3 inward = glm::normalize(around[i].inward);
                moved[i] = all[i] + around[i].way - std::min(glm::dot(around[i].way, inward), 0.0f) * inward;
                moved[i] = is_inside() ? moved[i] : all[i];
            }
        });
        all.move(moved);
    }
    if (result.iterations > 0) { // else not even rounding moves them
        parallel_for(all.size(), [&](std::size_t i) { positions[i] = all.from_units(all[i]); });
    }
    return result;
}

} // namespace meltpoint
