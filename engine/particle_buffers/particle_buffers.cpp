#include "particle_buffers/particle_buffers.h"

#include <stdexcept>

#include "gpu/transfer.h"

namespace meltpoint {

namespace {

std::vector<glm::vec4> pack(const std::vector<glm::vec3>& xyz, const std::vector<float>* w)
{
    std::vector<glm::vec4> packed(xyz.size());
    for (std::size_t i = 0; i < xyz.size(); ++i) {
        packed[i] = glm::vec4(xyz[i], w != nullptr ? (*w)[i] : 0.0f);
    }
    return packed;
}

template <class T>
void permute(std::vector<T>& values, const std::vector<std::uint32_t>& id)
{
    std::vector<T> permuted(values.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        permuted[id[i]] = values[i];
    }
    values = std::move(permuted);
}

} // namespace

ParticleBuffers make_particle_buffers(const gpu::Context& context, std::uint32_t count)
{
    ParticleBuffers particles;
    particles.count = count;
    particles.moving = count;
    particles.id = gpu::make_buffer<std::uint32_t>(context, count, "id");
    particles.attributes = gpu::make_buffer<std::uint32_t>(context, count, "attributes");
    particles.position = gpu::make_texel_buffer(context, count, "position");
    particles.velocity = gpu::make_texel_buffer(context, count, "velocity");
    particles.acceleration = gpu::make_texel_buffer(context, count, "acceleration");
    particles.density = gpu::make_buffer<float>(context, count, "density");
    particles.pressure = gpu::make_buffer<float>(context, count, "pressure");
    particles.interaction = gpu::make_texel_buffer(context, count, "interaction");
    return particles;
}

void upload(const gpu::Context& context, const ParticleSet& set, const ParticleBuffers& particles)
{
    if (set.size() != particles.count) {
        throw std::logic_error("upload: the set and the buffers differ in length");
    }
    gpu::upload<std::uint32_t>(context, particles.id, set.id);
    gpu::upload<std::uint32_t>(context, particles.attributes, set.attributes);
    gpu::upload<glm::vec4>(context, particles.position, pack(set.position, &set.weight));
    std::vector<float> responding = set.mass; // negative where no force moves it: passes need no look at the state
    for (std::size_t i = 0; i < set.size(); ++i) {
        responding[i] *= shared::is_boundary(set.attributes[i]) ? -1.0f : 1.0f;
    }
    gpu::upload<glm::vec4>(context, particles.velocity, pack(set.velocity, &responding));
    gpu::upload<glm::vec4>(context, particles.acceleration, pack(set.acceleration, nullptr));
    gpu::upload<float>(context, particles.density, set.density);
    gpu::upload<float>(context, particles.pressure, set.pressure);
}

ParticleSet download_unordered(const gpu::Context& context, const ParticleBuffers& particles)
{
    const std::size_t count = particles.count;
    ParticleSet set;
    set.resize(count);
    set.id = gpu::download<std::uint32_t>(context, particles.id, count);
    set.attributes = gpu::download<std::uint32_t>(context, particles.attributes, count);
    set.density = gpu::download<float>(context, particles.density, count);
    set.pressure = gpu::download<float>(context, particles.pressure, count);
    const std::vector<glm::vec4> position = gpu::download<glm::vec4>(context, particles.position, count);
    const std::vector<glm::vec4> velocity = gpu::download<glm::vec4>(context, particles.velocity, count);
    const std::vector<glm::vec4> acceleration = gpu::download<glm::vec4>(context, particles.acceleration, count);
    for (std::size_t i = 0; i < count; ++i) {
        set.position[i] = glm::vec3(position[i]);
        set.weight[i] = position[i].w;
        set.mass[i] = std::abs(velocity[i].w);
        set.velocity[i] = glm::vec3(velocity[i]);
        set.acceleration[i] = glm::vec3(acceleration[i]);
    }
    return set;
}

ParticleSet download(const gpu::Context& context, const ParticleBuffers& particles)
{
    ParticleSet set = download_unordered(context, particles);
    const std::vector<std::uint32_t> id = set.id;
    permute(set.attributes, id);
    permute(set.position, id);
    permute(set.velocity, id);
    permute(set.acceleration, id);
    permute(set.mass, id);
    permute(set.weight, id);
    permute(set.density, id);
    permute(set.pressure, id);
    permute(set.id, id);
    return set;
}

} // namespace meltpoint
