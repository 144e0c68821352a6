#include "conformance/capillarity_comparison.h"

#include "conformance/relative_error.h"
#include "reference/capillarity.h"
#include "sim/capillarity.h"

namespace meltpoint::conformance {

namespace {

std::vector<glm::dvec3> directions(const std::vector<glm::vec4>& found)
{
    std::vector<glm::dvec3> result;
    for (const glm::vec4& v : found) {
        result.emplace_back(v.x, v.y, v.z);
    }
    return result;
}

} // namespace

std::vector<PassError> compare_capillarity(Device& device, const sim::FluidOptions& options,
                                           const reference::Settings& settings, const reference::Neighbors& neighbors)
{
    sim::Capillarity capillarity(device.context, options, device.particles.count);
    const auto fetch = [&](const gpu::Buffer& buffer) {
        return gpu::download<glm::vec4>(device.context, buffer, device.particles.count);
    };
    const reference::State before = reference::from_particle_set(download_unordered(device.context, device.particles));
    device.run([&] {
        capillarity.record_start(device.commands);
        capillarity.record_normals(device.commands, device.kernels, device.params_buffer, device.particles,
                                   device.grid);
    });
    const std::vector<glm::dvec3> gradients = directions(fetch(capillarity.gradient()));
    std::vector<glm::dvec3> normals = directions(fetch(capillarity.normal()));
    std::vector<reference::SurfaceNormal> surface(before.size());
    std::vector<double> sigma(before.size());
    RelativeError normal_error;
    for (std::size_t i = 0; i < before.size(); ++i) {
        surface[i] = reference::surface_normal(settings, before, neighbors, i);
        sigma[i] = surface[i].sigma;
        normal_error.add(glm::length(gradients[i] - surface[i].gradient), surface[i].magnitude);
        normal_error.add(glm::length(normals[i] - surface[i].normal), surface[i].magnitude);
        surface[i].gradient = gradients[i];
    }

    device.run([&] {
        capillarity.record_smoothing(device.commands, device.kernels, device.params_buffer, device.particles,
                                     device.grid);
    });
    const std::vector<glm::dvec3> smoothed = directions(fetch(capillarity.normal()));
    RelativeError smoothing_error;
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (sigma[i] > 0.0) {
            const reference::VectorSum twin = reference::smooth_normal(settings, before, neighbors, normals, sigma, i);
            smoothing_error.add(glm::length(smoothed[i] - twin.value), twin.magnitude);
        }
    }

    device.run([&] {
        capillarity.record_forces(device.commands, device.kernels, device.params_buffer, device.particles, device.grid);
    });
    const ParticleSet gpu = download_unordered(device.context, device.particles);
    RelativeError force_error;
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (sigma[i] > 0.0) {
            const reference::VectorSum twin =
                reference::capillary_acceleration(settings, before, neighbors, surface, smoothed, i);
            force_error.add(gpu.acceleration[i], before.acceleration[i] + twin.value,
                            glm::length(before.acceleration[i]) + twin.magnitude);
        }
    }
    return {{"surface normal", normal_error.value(), pass_bound},
            {"smoothed normal", smoothing_error.value(), pass_bound},
            {"surface tension", force_error.value(), pass_bound}};
}

} // namespace meltpoint::conformance
