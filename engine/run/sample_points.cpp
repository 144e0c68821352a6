#include "run/sample_points.h"

#include <chrono>
#include <cmath>
#include <cstddef>
#include <utility>
#include <variant>

#include "geometry/cloud_solid.h"
#include "geometry/mesh_solid.h"
#include "run/load_surface.h"

namespace meltpoint {

namespace {

using Clock = std::chrono::steady_clock;

/// Notes how long each stage takes.
class StageTimer {
public:
    StageTimer(const SampleRequest& request, SampledPoints& result) : request_(&request), result_(&result) {}

    void done(std::string_view stage)
    {
        const Clock::time_point now = Clock::now();
        result_->seconds.emplace_back(stage, std::chrono::duration<double>(now - start_).count());
        start_ = now;
        if (request_->on_stage) {
            request_->on_stage(stage);
        }
    }

private:
    const SampleRequest* request_;
    SampledPoints* result_;
    Clock::time_point start_ = Clock::now();
};

constexpr std::size_t default_count = 100'000;

void sample_inside(const SampleRequest& request, const Solid& solid, SampledPoints& result)
{
    VolumeSamples samples = sample_volume(solid, {.lattice = request.lattice,
                                                  .amount = request.amount.value_or(PointCount{default_count}),
                                                  .seed = request.seed});
    result.cloud.positions = std::move(samples.positions);
    result.spacing = samples.spacing;
}

template <class Surface>
void sample_on(const SampleRequest& request, const Surface& surface, std::size_t count, SampledPoints& result)
{
    SurfaceSamples samples = sample_surface(surface, {.method = request.method.value_or(SurfaceMethod::Random),
                                                      .amount = request.amount.value_or(PointCount{count}),
                                                      .seed = request.seed});
    result.cloud = std::move(samples.cloud);
    result.spacing = samples.spacing;
}

/// The volume, where there is a solid, and what follows from it.
void measure(const SampleRequest& request, const Solid* solid, SampledPoints& result)
{
    if (solid != nullptr) {
        result.volume = solid->volume();
        result.particle_mass = request.rest_density * *result.volume / static_cast<double>(result.cloud.size());
    }
}

void sample_mesh(const SampleRequest& request, const TriangleMesh& mesh, StageTimer& timer, SampledPoints& result)
{
    std::optional<MeshSolid> solid;
    if (request.volume) {
        sample_inside(request, solid.emplace(mesh), result);
    } else {
        sample_on(request, mesh, default_count, result);
    }
    timer.done("sample");
    result.facts = mesh_facts(mesh);
    if (request.measure && !solid) {
        solid.emplace(mesh);
    }
    measure(request, solid ? &*solid : nullptr, result);
    timer.done("measure");
}

void sample_cloud(const SampleRequest& request, PointCloud cloud, StageTimer& timer, SampledPoints& result)
{
    CloudSurface surface = make_cloud_surface(std::move(cloud), request.source);
    timer.done("normals");
    result.cloud_facts = surface.facts;
    result.facts.area = surface.area;
    std::optional<CloudSolid> solid;
    if (request.volume) {
        sample_inside(request, solid.emplace(surface), result);
    } else if (request.measure) {
        solid.emplace(surface);
    }
    if (!request.volume && (request.amount || request.method)) {
        sample_on(request, surface, surface.cloud.size(), result);
    } else if (!request.volume) {
        result.spacing = std::sqrt(surface.area / static_cast<double>(surface.cloud.size()));
        result.cloud = std::move(surface.cloud);
    }
    timer.done("sample");
    measure(request, solid ? &*solid : nullptr, result);
    timer.done("measure");
}

} // namespace

SampledPoints sample_points(const SampleRequest& request)
{
    SampledPoints result;
    StageTimer timer(request, result);
    std::variant<TriangleMesh, PointCloud> source = load_surface(request.source);
    timer.done("load");
    if (const auto* mesh = std::get_if<TriangleMesh>(&source)) {
        sample_mesh(request, *mesh, timer, result);
    } else {
        sample_cloud(request, std::move(std::get<PointCloud>(source)), timer, result);
    }
    return result;
}

} // namespace meltpoint
