#include "run/solid_splats.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "core/overloaded.h"
#include "core/parallel_for.h"
#include "geometry/point_cells.h"
#include "geometry/surface_sampling.h"
#include "run/placed_mesh.h"
#include "scene/materials.h"

namespace meltpoint {

namespace {

constexpr double host_reach = 2.5;    // spacings, of a splat's hosts
constexpr double support = 1.25;      // spacings: a splat farther from all particles lies on what is too thin for any
constexpr double covered_depth = 2.0; // spacings: a splat covers the particles less deep below it,
constexpr double covered_width = 1.0; // and as near to the line along its normal
constexpr double least_width = 0.5;   // of their triangle: its height in spacings
constexpr double cover_width = 0.72; // spacings: a splat is covered by a particle so near to the line along its normal,
constexpr double cover_height = 0.25;   // so far above it
constexpr float ice_wet_albedo = 0.93f; // what melts hardly looks darker when it is wet
constexpr float wet_albedo = 0.6f;

struct Candidate {
    double distance2;
    std::uint32_t id;
};

/// The solid particles of the start, to look up those around a place.
class SolidParticles {
public:
    SolidParticles(const ParticleSet& particles, double spacing)
        : particles_(particles), spacing_(spacing), ids_(solid_ids(particles)), positions_(positions(particles, ids_)),
          cells_(positions_, host_reach * spacing)
    {
    }

    /// Those nearer to x than host_reach, nearest first.
    [[nodiscard]] std::vector<Candidate> around(const glm::dvec3& x) const
    {
        std::vector<Candidate> found;
        cells_.visit_near(x, [&](std::uint32_t place) {
            const std::uint32_t index = cells_.order()[place];
            const glm::dvec3 way = glm::dvec3(positions_[index]) - x;
            if (glm::dot(way, way) < std::pow(host_reach * spacing_, 2)) {
                found.push_back({glm::dot(way, way), ids_[index]});
            }
        });
        std::ranges::sort(found, [](const Candidate& a, const Candidate& b) {
            return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.id < b.id;
        });
        return found;
    }

    [[nodiscard]] glm::dvec3 position(std::uint32_t id) const { return glm::dvec3(particles_.position[id]); }

private:
    static std::vector<std::uint32_t> solid_ids(const ParticleSet& particles)
    {
        std::vector<std::uint32_t> ids;
        for (std::uint32_t i = 0; i < particles.size(); ++i) {
            if (shared::particle_state(particles.attributes[i]) == shared::STATE_SOLID) {
                ids.push_back(i);
            }
        }
        return ids;
    }
    static std::vector<glm::vec3> positions(const ParticleSet& particles, const std::vector<std::uint32_t>& ids)
    {
        std::vector<glm::vec3> positions;
        for (const std::uint32_t id : ids) {
            positions.push_back(particles.position[id]);
        }
        return positions;
    }

    const ParticleSet& particles_;
    double spacing_;
    std::vector<std::uint32_t> ids_;
    std::vector<glm::vec3> positions_;
    PointCells cells_;
};

/// The nearest three that span a triangle.
std::optional<std::array<std::uint32_t, 3>> choose_hosts(const SolidParticles& solids, double spacing,
                                                         const std::vector<Candidate>& near)
{
    if (near.size() < 3) {
        return std::nullopt;
    }
    const glm::dvec3 a = solids.position(near[0].id);
    const glm::dvec3 first = solids.position(near[1].id) - a;
    for (std::size_t k = 2; k < near.size(); ++k) {
        const glm::dvec3 second = solids.position(near[k].id) - a;
        if (glm::length(glm::cross(first, second)) > least_width * spacing * glm::length(first)) {
            return std::array{near[0].id, near[1].id, near[k].id};
        }
    }
    return std::nullopt;
}

bool is_covered(const SolidParticles& solids, double spacing, const std::vector<Candidate>& near, const glm::dvec3& x,
                const glm::dvec3& normal)
{
    return std::ranges::any_of(near, [&](const Candidate& each) {
        const double height = glm::dot(solids.position(each.id) - x, normal) / spacing;
        const double aside2 = each.distance2 / (spacing * spacing) - height * height;
        return height > cover_height && height < 1.0 - cover_height && aside2 < cover_width * cover_width;
    });
}

/// The next sharp edge of a solid that a splat lies at.
struct Edge {
    glm::dvec3 way{0.0};                                       ///< along the surface, of length 1
    double distance = std::numeric_limits<double>::infinity(); ///< m
    double corner = std::numeric_limits<double>::infinity();   ///< m, to the next edge across that one
};

/// Of each splat the nearest edge, at most `reach` off: where the face of another splat cuts its own.
std::vector<Edge> find_edges(const PointCloud& cloud, double reach)
{
    constexpr double sharp = 0.8;  // cosine of the angle between faces at an edge
    constexpr double square = 0.2; // and at a corner
    const PointCells cells(cloud.positions, reach);
    std::vector<Edge> edges(cloud.size());
    parallel_for(cloud.size(), [&](std::size_t place) {
        const std::uint32_t i = cells.order()[place];
        const glm::dvec3 normal(cloud.normals[i]);
        const auto visit_edges = [&](double most_alike, const auto& visit) {
            cells.visit_near(place, [&](std::uint32_t other) {
                const std::uint32_t j = cells.order()[other];
                const glm::dvec3 its_normal(cloud.normals[j]);
                const glm::dvec3 along = its_normal - glm::dot(its_normal, normal) * normal;
                const double below =
                    glm::dot(glm::dvec3(cloud.positions[j]) - glm::dvec3(cloud.positions[i]), its_normal);
                const double distance = below / glm::length(along);
                if (glm::dot(its_normal, normal) < most_alike && below > 0.0 && distance < reach) {
                    visit(glm::normalize(along), distance);
                }
            });
        };
        visit_edges(sharp, [&](const glm::dvec3& way, double distance) {
            if (distance < edges[i].distance) {
                edges[i] = {.way = way, .distance = distance};
            }
        });
        visit_edges(square, [&](const glm::dvec3& way, double distance) {
            if (glm::dot(way, edges[i].way) < square) {
                edges[i].corner = std::min(edges[i].corner, distance);
            }
        });
    });
    return edges;
}

/// None where there are no hosts near below, or others above.
std::optional<shared::HostedSplat> host(const SolidParticles& solids, double spacing, const glm::dvec3& x,
                                        const glm::dvec3& normal, const Edge& edge)
{
    const std::vector<Candidate> near = solids.around(x);
    const auto hosts = choose_hosts(solids, spacing, near);
    if (!hosts || near[0].distance2 > std::pow(support * spacing, 2) || is_covered(solids, spacing, near, x, normal)) {
        return std::nullopt;
    }
    const glm::dvec3 a = solids.position((*hosts)[0]);
    const glm::dvec3 first = solids.position((*hosts)[1]) - a;
    const glm::dvec3 second = solids.position((*hosts)[2]) - a;
    const glm::dmat3 to_frame = glm::inverse(glm::dmat3(first, second, glm::cross(first, second) / spacing));
    glm::dvec3 weight;
    for (int k = 0; k < 3; ++k) {
        const glm::dvec3 way = solids.position((*hosts)[k]) - x;
        weight[k] = 1.0 / (glm::dot(way, way) + 0.01 * spacing * spacing);
    }
    return shared::HostedSplat{
        .host = {(*hosts)[0], (*hosts)[1], (*hosts)[2]},
        .weight = weight / (weight.x + weight.y + weight.z),
        .offset = to_frame * (x - a),
        .normal = to_frame * normal,
        .edge = to_frame * edge.way,
        .edge_distance = std::isfinite(edge.distance) ? static_cast<float>(edge.distance) : shared::NO_EDGE,
        .color = {},
        .radius = 0.0f,
        .wet_albedo = 1.0f,
        .span = static_cast<float>(std::max({glm::length(first), glm::length(second), glm::length(second - first)}))};
}

/// Splat number `splat` covers the particles below it that no nearer one covers. nearest: m^2, by id.
void cover_particles(const SolidParticles& solids, double spacing, const glm::dvec3& x, const glm::dvec3& normal,
                     std::uint32_t splat, std::vector<double>& nearest, std::vector<std::uint32_t>& cover)
{
    for (const Candidate& each : solids.around(x)) {
        const double depth = glm::dot(x - solids.position(each.id), normal);
        const double aside2 = each.distance2 - depth * depth;
        if (each.distance2 < nearest[each.id] && depth > 0.0 && aside2 < std::pow(covered_width * spacing, 2)) {
            nearest[each.id] = each.distance2;
            cover[each.id] = splat;
        }
    }
}

float wet_albedo_of(const Material& material)
{
    return material.melts ? ice_wet_albedo : wet_albedo;
}

} // namespace

bool has_solid_splats(const Scene& scene)
{
    return !scene.solids.empty() && scene.domain.dimensions == 3;
}

shared::SolidSplatParams solid_splat_params(const Scene& scene)
{
    shared::SolidSplatParams params{.blend_time = scene.render.blend_time};
    const SceneMaterials materials = scene_materials(scene);
    for (std::size_t i = 0; i < materials.materials.size(); ++i) {
        const Material& material = materials.materials[i];
        params.latent_heat[i] = material.melts ? material.thermal.latent_heat : 0.0f;
        params.color[i] = material.solid_color;
        params.is_sand[i] = material.wind_erodes ? 1 : 0;
        params.wet_albedo[i] = wet_albedo_of(material);
        params.progress |= material.melts ? shared::PROGRESS_MELTING : 0u;
        params.progress |= material.erosion.erodes ? shared::PROGRESS_DAMAGE : 0u;
    }
    for (std::size_t s = 0; s < scene.solids.size(); ++s) {
        const DissolveFront& front = scene.solids[s].dissolve;
        if (front.speed > 0.0f) {
            params.front_time[materials.of_solid[s]] = scene.particles.spacing / front.speed;
            params.progress |= shared::PROGRESS_FRONT;
        }
    }
    return params;
}

SolidSurface make_solid_surface(const Scene& scene, const ParticleSet& particles, std::uint64_t limit)
{
    const auto spacing = static_cast<double>(scene.particles.spacing);
    std::vector<std::variant<TriangleMesh, CloudSurface>> surfaces;
    double area = 0.0;
    for (const SolidBody& body : scene.solids) {
        surfaces.push_back(placed_surface(body.shape));
        area += std::visit(Overloaded{[](const TriangleMesh& mesh) { return surface_area(mesh); },
                                      [](const CloudSurface& cloud) {
                                          return cloud.area;
                                      }},
                           surfaces.back());
    }
    const double apart = std::max(static_cast<double>(shared::SURFACE_SPLAT_SPACING) * spacing,
                                  std::sqrt(area / (0.9 * static_cast<double>(std::max(limit, std::uint64_t{1})))));
    const SolidParticles solids(particles, spacing);
    const SceneMaterials materials = scene_materials(scene);
    SolidSurface result{.splats = {}, .cover = std::vector<std::uint32_t>(particles.size(), shared::NO_COVER)};
    std::vector<double> nearest(particles.size(), std::pow(covered_depth * spacing, 2));
    for (std::size_t s = 0; s < surfaces.size(); ++s) {
        const SurfaceRequest request{
            .method = SurfaceMethod::BlueNoise, .amount = PointSpacing{apart}, .seed = scene.seed + s};
        const SurfaceSamples samples =
            std::visit([&](const auto& each) { return sample_surface(each, request); }, surfaces[s]);
        std::vector<std::optional<shared::HostedSplat>> hosted(samples.cloud.size());
        const float radius = shared::SURFACE_SPLAT_RADIUS * static_cast<float>(samples.spacing);
        const std::vector<Edge> edges =
            find_edges(samples.cloud, static_cast<double>(radius) + static_cast<double>(shared::RECESSION) * spacing);
        parallel_for(hosted.size(), [&](std::size_t i) {
            hosted[i] = host(solids, spacing, glm::dvec3(samples.cloud.positions[i]),
                             glm::dvec3(samples.cloud.normals[i]), edges[i]);
        });
        // Those near one another together: what a device does at a time either changes or does not.
        const PointCells cells(samples.cloud.positions, host_reach * spacing);
        for (const std::uint32_t i : cells.order()) {
            if (hosted[i] && result.splats.size() < limit) {
                hosted[i]->color = scene.solids[s].solid_color;
                hosted[i]->radius = std::min(radius, static_cast<float>(edges[i].corner));
                hosted[i]->wet_albedo = wet_albedo_of(materials.materials[materials.of_solid[s]]);
                cover_particles(solids, spacing, glm::dvec3(samples.cloud.positions[i]),
                                glm::dvec3(samples.cloud.normals[i]), static_cast<std::uint32_t>(result.splats.size()),
                                nearest, result.cover);
                result.splats.push_back(*hosted[i]);
            }
        }
    }
    return result;
}

} // namespace meltpoint
