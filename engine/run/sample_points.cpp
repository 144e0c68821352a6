#include "run/sample_points.h"

#include <chrono>

#include "geometry/mesh_solid.h"
#include "run/load_mesh.h"

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

} // namespace

SampledPoints sample_points(const SampleRequest& request)
{
    SampledPoints result;
    StageTimer timer(request, result);
    const TriangleMesh mesh = load_mesh(request.source);
    timer.done("load");

    if (request.volume) {
        const MeshSolid solid(mesh);
        VolumeSamples samples =
            sample_volume(solid, {.lattice = request.lattice, .amount = request.amount, .seed = request.seed});
        result.cloud.positions = std::move(samples.positions);
        result.spacing = samples.spacing;
        result.volume = samples.volume;
        timer.done("sample");
    } else {
        SurfaceSamples samples =
            sample_surface(mesh, {.method = request.method, .amount = request.amount, .seed = request.seed});
        result.cloud = std::move(samples.cloud);
        result.spacing = samples.spacing;
        timer.done("sample");
    }

    result.facts = mesh_facts(mesh);
    if (request.measure && !result.volume) {
        result.volume = MeshSolid(mesh).volume();
    }
    if (result.volume) {
        result.particle_mass = request.rest_density * *result.volume / static_cast<double>(result.cloud.size());
    }
    timer.done("measure");
    return result;
}

} // namespace meltpoint
