// Kernels and their lattice moments.
// Müller, Charypar & Gross, "Particle-Based Fluid Simulation for Interactive Applications", SCA 2003 (poly6, spiky,
// viscosity). Dehnen & Aly, "Improving convergence in SPH simulations without pairing instability", MNRAS 425, 2012
// (Wendland C2).
#include "particles/sph_kernel.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include <glm/glm.hpp>

#include "core/error.h"
#include "shared/capillarity.h"
#include "shared/exposure.h"
#include "shared/pbf.h"

namespace meltpoint {
namespace {

constexpr double PI = std::numbers::pi;

// Calls body(place in spacings, distance in spacings) for each site of the cubic, in the plane square, lattice nearer
// than the support radius, the origin included.
template <class Body>
void for_each_lattice_site(double support_ratio, std::uint32_t dimensions, const Body& body)
{
    const int reach = static_cast<int>(support_ratio);
    const int reach_z = dimensions == 3 ? reach : 0;
    for (int x = -reach; x <= reach; ++x) {
        for (int y = -reach; y <= reach; ++y) {
            for (int z = -reach_z; z <= reach_z; ++z) {
                const double r = std::sqrt(static_cast<double>(x * x + y * y + z * z));
                if (r < support_ratio) {
                    body(glm::dvec3(x, y, z), r);
                }
            }
        }
    }
}

// Calls body(wave vector, 1/spacing) for waves along a cell's edges and diagonals, up to the shortest of a lattice:
// among them are those that a sum over a lattice answers most strongly.
template <class Body>
void for_each_lattice_wave(std::uint32_t dimensions, const Body& body)
{
    constexpr double finest = 0.02; // of the wave numbers, over 1/d
    for (const glm::dvec3& direction : {glm::dvec3(1, 0, 0), glm::dvec3(1, 1, 0), glm::dvec3(1, 1, 1)}) {
        if (dimensions == 2 && direction.z > 0.0) {
            continue;
        }
        const int wave_numbers = static_cast<int>(PI * glm::length(direction) / finest);
        for (int i = 1; i <= wave_numbers; ++i) {
            body(i * finest * glm::normalize(direction));
        }
    }
}

double checked_support_ratio(double support_radius, double spacing)
{
    const double ratio = support_radius / spacing;
    // A float ratio of exactly 8 spacings may come out a hair above 8.
    const double slack = 1e-6;
    if (!(spacing > 0.0) || !(ratio >= MIN_SUPPORT_RATIO - slack) || !(ratio <= MAX_SUPPORT_RATIO + slack)) {
        throw input_error("The support radius must be {} to {} particle spacings, but {} m is {} spacings of {} m",
                          MIN_SUPPORT_RATIO, MAX_SUPPORT_RATIO, support_radius, ratio, spacing);
    }
    return ratio;
}

} // namespace

double density_shape(std::uint32_t kernel, double q)
{
    if (q >= 1.0) {
        return 0.0;
    }
    if (kernel == shared::KERNEL_PAPER) {
        const double u = 1.0 - q * q;
        return u * u * u;
    }
    const double u = 1.0 - q;
    return u * u * u * u * (1.0 + 4.0 * q);
}

double gradient_shape(std::uint32_t kernel, double q)
{
    if (q >= 1.0) {
        return 0.0;
    }
    const double u = 1.0 - q;
    return kernel == shared::KERNEL_PAPER ? u * u : q * u * u * u;
}

double viscosity_shape(std::uint32_t kernel, double q)
{
    if (q >= 1.0) {
        return 0.0;
    }
    const double u = 1.0 - q;
    return kernel == shared::KERNEL_PAPER ? u : u * u * u;
}

double pair_viscosity_shape(double taper, double q)
{
    const double u = std::max(1.0 - q, 0.0);
    return u * (1.0 + taper * u);
}

double color_gradient_shape(std::uint32_t kernel, double q)
{
    if (q >= 1.0) {
        return 0.0;
    }
    if (kernel == shared::KERNEL_PAPER) {
        const double u = 1.0 - q * q;
        return q * u * u;
    }
    return gradient_shape(kernel, q);
}

double color_laplacian_shape(std::uint32_t kernel, double q, std::uint32_t dimensions)
{
    if (q >= 1.0) {
        return 0.0;
    }
    if (kernel == shared::KERNEL_PAPER) {
        return (1.0 - q * q) * (dimensions == 3 ? 3.0 - 7.0 * q * q : 1.0 - 3.0 * q * q);
    }
    const double u = 1.0 - q;
    return u * u * (1.0 - (dimensions == 3 ? 2.0 : 2.5) * q);
}

KernelScales continuum_scales(std::uint32_t kernel, double support_radius, std::uint32_t dimensions)
{
    const double h = support_radius;
    const double h2 = h * h;
    const double h3 = h2 * h;
    const double h4 = h3 * h;
    const double h5 = h4 * h;
    if (dimensions == 2 && kernel == shared::KERNEL_PAPER) {
        return {.density = 4.0 / (PI * h2),
                .gradient = 30.0 / (PI * h3),
                .viscosity = 40.0 / (PI * h4),
                .color_gradient = 24.0 / (PI * h3),
                .color_laplacian = 48.0 / (PI * h4)};
    }
    if (dimensions == 2) {
        return {.density = 7.0 / (PI * h2),
                .gradient = 140.0 / (PI * h3),
                .viscosity = 280.0 / (PI * h4),
                .color_gradient = 140.0 / (PI * h3),
                .color_laplacian = 280.0 / (PI * h4)};
    }
    if (kernel == shared::KERNEL_PAPER) {
        return {.density = 315.0 / (64.0 * PI * h3),
                .gradient = 45.0 / (PI * h4),
                .viscosity = 45.0 / (PI * h5),
                .color_gradient = 945.0 / (32.0 * PI * h4),
                .color_laplacian = 945.0 / (32.0 * PI * h5)};
    }
    return {.density = 21.0 / (2.0 * PI * h3),
            .gradient = 210.0 / (PI * h4),
            .viscosity = 420.0 / (PI * h5),
            .color_gradient = 210.0 / (PI * h4),
            .color_laplacian = 630.0 / (PI * h5)};
}

LatticeMoments lattice_moments(std::uint32_t kernel, double support_radius, double spacing, std::uint32_t dimensions)
{
    const double ratio = checked_support_ratio(support_radius, spacing);
    const KernelScales scale = continuum_scales(kernel, ratio, dimensions); // in units of the spacing: d = 1
    LatticeMoments moments{};
    for_each_lattice_site(ratio, dimensions, [&](const glm::dvec3& site, double r) {
        const double q = r / ratio;
        const double xx = site.x * site.x;
        moments.density += scale.density * density_shape(kernel, q);
        moments.viscosity += 0.5 * xx * scale.viscosity * viscosity_shape(kernel, q);
        moments.color_laplacian -= 0.5 * xx * scale.color_laplacian * color_laplacian_shape(kernel, q, dimensions);
        if (site.x != 0.0) {
            moments.gradient += xx / r * scale.gradient * gradient_shape(kernel, q);
            moments.color_gradient += xx / r * scale.color_gradient * color_gradient_shape(kernel, q);
        }
    });
    return moments;
}

double lattice_response(std::uint32_t kernel, double support_radius, double spacing, std::uint32_t dimensions)
{
    const double ratio = checked_support_ratio(support_radius, spacing);
    double sum = 0.0;
    for_each_lattice_site(ratio, dimensions, [&](const glm::dvec3&, double r) {
        sum += r > 0.0 ? std::pow(gradient_shape(kernel, r / ratio), 2) : 0.0;
    });
    return sum;
}

double largest_jacobi_eigenvalue(std::uint32_t kernel, double support_radius, double spacing, std::uint32_t dimensions)
{
    const double ratio = checked_support_ratio(support_radius, spacing);
    double largest = 0.0;
    for_each_lattice_wave(dimensions, [&](const glm::dvec3& k) {
        glm::dvec3 sum(0.0);
        double squares = 0.0;
        for_each_lattice_site(ratio, dimensions, [&](const glm::dvec3& x, double r) {
            if (r > 0.0) {
                const glm::dvec3 g = gradient_shape(kernel, r / ratio) / r * x;
                sum += std::sin(glm::dot(k, x)) * g;
                squares += glm::dot(g, g);
            }
        });
        largest = std::max(largest, glm::dot(sum, sum) / squares);
    });
    return largest;
}

double largest_conduction_eigenvalue(std::uint32_t kernel, double support_radius, double spacing,
                                     std::uint32_t dimensions)
{
    const double ratio = checked_support_ratio(support_radius, spacing);
    double moment = 0.0;
    for_each_lattice_site(ratio, dimensions, [&](const glm::dvec3& x, double r) {
        moment += r > 0.0 ? x.x * x.x * gradient_shape(kernel, r / ratio) / r : 0.0;
    });
    double largest = 0.0;
    for_each_lattice_wave(dimensions, [&](const glm::dvec3& k) {
        double sum = 0.0;
        for_each_lattice_site(ratio, dimensions, [&](const glm::dvec3& x, double r) {
            sum += r > 0.0 ? 2.0 * gradient_shape(kernel, r / ratio) / r * (1.0 - std::cos(glm::dot(k, x))) : 0.0;
        });
        largest = std::max(largest, sum / moment);
    });
    return largest / (spacing * spacing);
}

PairViscosity pair_viscosity(double support_radius, double spacing, std::uint32_t dimensions)
{
    const double ratio = checked_support_ratio(support_radius, spacing);
    const auto n = static_cast<double>(dimensions);
    // Of the shapes u and u^2: 1/(2n) sum r^2 L in n dimensions, and (n + 2)/2 sum x^2 y^2 / r^2 L, which a shear along
    // the axes feels. In the continuum they are equal.
    glm::dvec2 mean(0.0);
    glm::dvec2 shear(0.0);
    for_each_lattice_site(ratio, dimensions, [&](const glm::dvec3& x, double r) {
        if (r > 0.0) {
            const double u = 1.0 - r / ratio;
            mean += r * r / (2.0 * n) * glm::dvec2(u, u * u);
            shear += 0.5 * (n + 2.0) * std::pow(x.x * x.y / r, 2) * glm::dvec2(u, u * u);
        }
    });
    constexpr double least_taper = -0.5; // then the pull still falls with the distance
    constexpr double most_taper = 2.0;
    const double taper = std::clamp((mean.x - shear.x) / (shear.y - mean.y), least_taper, most_taper);
    return {.scale = (n + 2.0) / (std::pow(spacing, n + 2.0) * (mean.x + taper * mean.y)), .taper = taper};
}

double exposed_area_scale(std::uint32_t dimensions)
{
    // Of a particle with so many layers of the lattice above it, |sum_j q (1-q)^3 x_ij / r_ij|: a whole ball of
    // neighbors has none of it, so what it has are those that the layers farther up would have had.
    const auto ratio = static_cast<double>(shared::EXPOSURE_SUPPORT);
    std::vector<double> layers(static_cast<std::size_t>(ratio) + 1, 0.0);
    for_each_lattice_site(ratio, dimensions, [&](const glm::dvec3& site, double r) {
        for (std::size_t above = 0; static_cast<double>(above) < site.y; ++above) {
            layers[above] += gradient_shape(shared::KERNEL_WENDLAND, r / ratio) * site.y / r;
        }
    });
    const double all = std::accumulate(layers.begin(), layers.end(), 0.0);
    double exposed = 0.0;
    for (const double layer : layers) {
        exposed += layer > static_cast<double>(shared::LEAST_EXPOSURE) * all ? layer : 0.0;
    }
    return 1.0 / exposed;
}

double solid_filling_scale(std::uint32_t dimensions)
{
    const auto ratio = static_cast<double>(shared::EXPOSURE_SUPPORT);
    double sum = density_shape(shared::KERNEL_WENDLAND, 0.0);
    for_each_lattice_site(ratio, dimensions, [&](const glm::dvec3& /*site*/, double r) {
        sum += r > 0.0 ? density_shape(shared::KERNEL_WENDLAND, r / ratio) : 0.0;
    });
    return 1.0 / sum;
}

double wall_viscosity_integral(std::uint32_t kernel, double distance, double support_radius, std::uint32_t dimensions)
{
    if (distance < 0.0) {
        return 2.0 * wall_viscosity_integral(kernel, 0.0, support_radius, dimensions) -
               wall_viscosity_integral(kernel, -distance, support_radius, dimensions);
    }
    const double q = distance / support_radius;
    if (q >= 1.0) {
        return 0.0;
    }
    const double u = 1.0 - q;
    const double per_area = 1.0 / (support_radius * support_radius);
    if (dimensions == 2) { // integrals of 2 t acos(q/t) L(t) from q to 1, term by term
        const double s = std::sqrt(1.0 - q * q);
        const double tail = q > 0.0 ? q * q * q * std::log((1.0 + s) / q) : 0.0;
        if (kernel == shared::KERNEL_PAPER) {
            return 40.0 / PI * per_area * (std::acos(q) - 2.0 * q * s + tail) / 3.0;
        }
        return 280.0 / PI * per_area *
               (0.1 * std::acos(q) - 0.4 * q * s - 0.85 * q * q * q * s + tail * (1.0 + 0.15 * q * q));
    }
    if (kernel == shared::KERNEL_PAPER) {
        return 7.5 * per_area * u * u * u * (1.0 + q);
    }
    return 14.0 * per_area * u * u * u * u * u * (1.0 + 2.0 * q);
}

LayerSteepness surface_layers(std::uint32_t kernel, double support_radius, double spacing, std::uint32_t dimensions)
{
    const double ratio = checked_support_ratio(support_radius, spacing);
    const double scale = continuum_scales(kernel, ratio, dimensions).gradient /
                         lattice_moments(kernel, support_radius, spacing, dimensions).gradient;
    const int reach = static_cast<int>(std::ceil(ratio));
    // What is smoothed once more reaches one support radius less deep, so start with enough layers.
    std::vector<double> steepness(static_cast<std::size_t>((shared::NORMAL_SMOOTHINGS + 1) * reach + 2), 0.0);
    const auto sum_over = [&](std::size_t layer, const auto& add) {
        for_each_lattice_site(ratio, dimensions, [&](const glm::dvec3& site, double r) {
            const double other = static_cast<double>(layer) + site.x;
            if (other >= 0.0 && other < static_cast<double>(steepness.size())) {
                add(site, r, static_cast<std::size_t>(std::lround(other)));
            }
        });
    };
    for (std::size_t layer = 0; layer + static_cast<std::size_t>(reach) < steepness.size(); ++layer) {
        sum_over(layer, [&](const glm::dvec3& site, double r, std::size_t) {
            steepness[layer] += r > 0.0 ? ratio * scale * gradient_shape(kernel, r / ratio) * site.x / r : 0.0;
        });
    }
    for (std::uint32_t smoothing = 0; smoothing < shared::NORMAL_SMOOTHINGS; ++smoothing) {
        std::vector<double> smoothed(steepness.size(), 0.0);
        for (std::size_t layer = 0; layer < steepness.size(); ++layer) {
            double weight = 0.0;
            sum_over(layer, [&](const glm::dvec3&, double r, std::size_t other) {
                smoothed[layer] += density_shape(kernel, r / ratio) * steepness[other];
                weight += density_shape(kernel, r / ratio);
            });
            smoothed[layer] /= weight;
        }
        steepness = smoothed;
    }
    double beyond = 0.0;
    double whole = 0.0;
    for_each_lattice_site(ratio, dimensions, [&](const glm::dvec3& site, double r) {
        const double along = site.x > 0.0 ? gradient_shape(kernel, r / ratio) * site.x / r : 0.0;
        beyond += site.y < 0.0 ? along : 0.0;
        whole += along;
    });
    return {.first = steepness[0], .second = steepness[1], .beyond = beyond / whole};
}

void set_kernel_scales(shared::SphParams& params, std::uint32_t kernel, double spacing, std::uint32_t dimensions)
{
    const double support_radius = static_cast<double>(params.support_radius);
    const LatticeMoments moments = lattice_moments(kernel, support_radius, spacing, dimensions);
    const KernelScales scale = continuum_scales(kernel, support_radius, dimensions);
    params.density_scale = static_cast<float>(scale.density / moments.density);
    params.gradient_scale = static_cast<float>(scale.gradient / moments.gradient);
    params.viscosity_scale = static_cast<float>(scale.viscosity / moments.viscosity);
    const PairViscosity pairs = pair_viscosity(support_radius, spacing, dimensions);
    params.pair_viscosity_scale = static_cast<float>(pairs.scale);
    params.pair_viscosity_taper = static_cast<float>(pairs.taper);
    params.color_gradient_scale = static_cast<float>(scale.color_gradient / moments.color_gradient);
    params.color_laplacian_scale = static_cast<float>(scale.color_laplacian / moments.color_laplacian);

    // Below 2 over the eigenvalue, and with something left for particles that lie less evenly.
    constexpr double relaxation = 1.3;
    const double eigenvalue = largest_jacobi_eigenvalue(kernel, support_radius, spacing, dimensions);
    params.solve_relaxation = static_cast<float>(std::min(0.5, relaxation / eigenvalue));

    const double near = static_cast<double>(shared::ARTIFICIAL_PRESSURE_DISTANCE) * spacing / support_radius;
    params.artificial_pressure_scale = static_cast<float>(1.0 / density_shape(kernel, near));

    const LayerSteepness layers = surface_layers(kernel, support_radius, spacing, dimensions);
    params.first_layer_steepness = static_cast<float>(layers.first);
    params.second_layer_steepness = static_cast<float>(layers.second);
    params.share_beyond_solid = static_cast<float>(layers.beyond);

    params.spacing = static_cast<float>(spacing);
    params.shifting_scale = static_cast<float>(1.0 / density_shape(kernel, spacing / support_radius));
    params.lattice_volume = static_cast<float>(std::pow(spacing, dimensions));
    const double rate = static_cast<double>(params.speed_of_sound) / spacing; // sound crosses a spacing in 1/rate
    params.contact_distance = static_cast<float>(0.25 * spacing);
    params.contact_stiffness = static_cast<float>(rate * rate);
    params.contact_damping = static_cast<float>(rate);
}

} // namespace meltpoint
