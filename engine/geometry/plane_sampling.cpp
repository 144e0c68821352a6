#include "geometry/plane_sampling.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

#include "core/error.h"

namespace meltpoint {

namespace {

constexpr double most_points = 268435456.0; // 2^28
constexpr double good_error = 1e-3;         // of N d^2 / area: half of what is promised
constexpr double range = 0.025;             // of the spacing
constexpr int trials = 400;

void check_fill(const glm::dvec2& size, double spacing)
{
    if (!std::isfinite(spacing) || spacing <= 0.0) {
        throw input_error("the particle spacing is {} m, but must be positive", spacing);
    }
    if (!(std::min(size.x, size.y) >= 0.5 * spacing)) {
        throw input_error("a shape of {:g} x {:g} m is too thin or too small to be filled at a particle spacing of "
                          "{:g} m",
                          size.x, size.y, spacing);
    }
    if (!((size.x / spacing + 2.0) * (size.y / spacing + 2.0) <= most_points)) {
        throw input_error("a shape of {:g} x {:g} m at a particle spacing of {:g} m needs about {:.2g} lattice points, "
                          "at most {:.3g} are supported",
                          size.x, size.y, spacing, size.x * size.y / (spacing * spacing), most_points);
    }
}

/// The sites in a disk about the origin of a square lattice, d and shift in spacings.
std::vector<glm::dvec2> sites_in_disk(double radius, double d, const glm::dvec2& shift)
{
    std::vector<glm::dvec2> sites;
    const auto reach = static_cast<long>(radius / d) + 2;
    for (long y = -reach; y <= reach; ++y) {
        for (long x = -reach; x <= reach; ++x) {
            const glm::dvec2 site = d * (glm::dvec2(x, y) + shift);
            if (glm::dot(site, site) < radius * radius) {
                sites.push_back(site);
            }
        }
    }
    return sites;
}

void append_line(std::vector<glm::vec3>& points, const glm::dvec2& from, const glm::dvec2& to, double spacing)
{
    const auto steps = static_cast<long>(std::max(std::ceil(glm::distance(from, to) / spacing), 1.0));
    for (long i = 0; i < steps; ++i) {
        const glm::dvec2 x = glm::mix(from, to, static_cast<double>(i) / static_cast<double>(steps));
        points.emplace_back(x.x, x.y, 0.0);
    }
}

} // namespace

VolumeSamples sample_rectangle(const glm::vec2& min, const glm::vec2& max, double spacing)
{
    const glm::dvec2 size = glm::dvec2(max) - glm::dvec2(min);
    check_fill(size, spacing);
    const glm::dvec2 count = glm::max(glm::round(size / spacing), 1.0);
    const glm::dvec2 step = size / count;
    VolumeSamples samples;
    for (long y = 0; y < std::lround(count.y); ++y) {
        for (long x = 0; x < std::lround(count.x); ++x) {
            samples.positions.emplace_back(glm::dvec3(glm::dvec2(min) + step * (glm::dvec2(x, y) + 0.5), 0.0));
        }
    }
    samples.volume = size.x * size.y;
    samples.particle_volume = step.x * step.y;
    samples.spacing = std::sqrt(samples.particle_volume);
    return samples;
}

VolumeSamples sample_disk(const glm::vec2& center, double radius, double spacing)
{
    check_fill(glm::dvec2(2.0 * radius), spacing);
    const double area = std::numbers::pi * radius * radius;
    std::vector<glm::dvec2> best;
    double best_error = std::numeric_limits<double>::infinity();
    double best_spacing = spacing;
    for (int i = 0; i < trials && best_error > good_error; ++i) {
        // Spacings and shifts that cover their ranges evenly; the first ones are centered on a site or between four.
        const double d = spacing * (1.0 + range * (2.0 * glm::fract(0.5 + i * 0.6180339887498949) - 1.0));
        const glm::dvec2 anywhere =
            glm::fract(glm::dvec2(0.5) + static_cast<double>(i) * glm::dvec2(0.7548776662466927, 0.5698402909980532));
        const glm::dvec2 shift = i % 3 == 0 ? glm::dvec2(0.0) : i % 3 == 1 ? glm::dvec2(0.5) : anywhere;
        std::vector<glm::dvec2> sites = sites_in_disk(radius, d, shift);
        const double error = std::abs(static_cast<double>(sites.size()) * d * d / area - 1.0);
        if (!sites.empty() && error < best_error) {
            best_error = error;
            best_spacing = d;
            best = std::move(sites);
        }
    }
    VolumeSamples samples;
    for (const glm::dvec2& site : best) {
        samples.positions.emplace_back(glm::dvec3(glm::dvec2(center) + site, 0.0));
    }
    samples.volume = area;
    samples.particle_volume = area / static_cast<double>(best.size());
    samples.spacing = best_spacing;
    return samples;
}

std::vector<glm::vec3> outline_rectangle(const glm::vec2& min, const glm::vec2& max, double spacing)
{
    const glm::dvec2 a(min);
    const glm::dvec2 b(max);
    std::vector<glm::vec3> points;
    if (a.x == b.x || a.y == b.y) {
        append_line(points, a, b, spacing);
        points.emplace_back(b.x, b.y, 0.0);
        return points;
    }
    append_line(points, a, {b.x, a.y}, spacing);
    append_line(points, {b.x, a.y}, b, spacing);
    append_line(points, b, {a.x, b.y}, spacing);
    append_line(points, {a.x, b.y}, a, spacing);
    return points;
}

std::vector<glm::vec3> outline_disk(const glm::vec2& center, double radius, double spacing)
{
    const double length = 2.0 * std::numbers::pi * radius;
    const auto count = static_cast<long>(std::max(std::ceil(length / spacing), 3.0));
    std::vector<glm::vec3> points;
    for (long i = 0; i < count; ++i) {
        const double angle = 2.0 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count);
        const glm::dvec2 x = glm::dvec2(center) + radius * glm::dvec2(std::cos(angle), std::sin(angle));
        points.emplace_back(x.x, x.y, 0.0);
    }
    return points;
}

} // namespace meltpoint
