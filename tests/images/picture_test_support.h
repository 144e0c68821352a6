#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "gpu/transfer.h"
#include "render/disc_buffers.h"
#include "render/renderer.h"
#include "shared/colormap.h"
#include "shared/particle_state.h"
#include "support/gpu_test.h"

namespace meltpoint {

/// Particles or discs in device buffers of their own, for pictures of known scenes.
struct TestParticles {
    std::vector<glm::vec4> position;
    std::vector<glm::vec4> velocity;
    std::vector<float> density;
    std::vector<float> pressure;
    std::vector<std::uint32_t> attributes;
    std::vector<float> freed_at; ///< by id, if not empty
    float time = 0.0f;

    void add(const glm::vec3& at, std::uint32_t material = 0, std::uint32_t state = shared::STATE_FLUID)
    {
        position.emplace_back(at, 1.0f);
        velocity.emplace_back(0.0f);
        density.push_back(1000.0f);
        pressure.push_back(0.0f);
        attributes.push_back(shared::pack_attributes(state, material));
    }
};

struct Disc {
    glm::vec3 center{0.0f};
    glm::vec3 normal{0.0f, 0.0f, 1.0f};
    float radius = 1.0f;
    glm::vec3 color{1.0f};
};

/// A picture and the distance of its samples along the view axis.
struct Drawn {
    Image picture;
    std::vector<float> distance;

    [[nodiscard]] glm::ivec3 pixel(std::uint32_t x, std::uint32_t y) const
    {
        const std::uint8_t* p = &picture.rgba[4 * (std::size_t{y} * picture.width + x)];
        return {p[0], p[1], p[2]};
    }
};

template <class T>
[[nodiscard]] gpu::Buffer to_device(const gpu::Context& context, const std::vector<T>& data, const std::string& name)
{
    gpu::Buffer buffer = gpu::make_buffer<T>(context, data.size(), name);
    gpu::upload<T>(context, buffer, data);
    return buffer;
}

/// 8-bit sRGB of a linear value and back (IEC 61966-2-1).
[[nodiscard]] inline int encode_srgb(float linear)
{
    const float c = linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1.0f / 2.4f) - 0.055f;
    return static_cast<int>(std::lround(255.0f * c));
}
[[nodiscard]] inline float decode_srgb(int value)
{
    const float c = static_cast<float>(value) / 255.0f;
    return c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
}

class PictureTest : public GpuTest {
protected:
    /// One sample a pixel unless told otherwise, so that samples can be compared with rays.
    static Drawn draw(std::uint32_t width, std::uint32_t height, const render::FrameSettings& settings,
                      const TestParticles* particles = nullptr, const std::vector<Disc>* discs = nullptr,
                      std::uint32_t samples = 1)
    {
        const TestParticles none;
        const TestParticles& p = particles != nullptr ? *particles : none;
        const gpu::Buffer position = to_device(context(), p.position, "position");
        const gpu::Buffer velocity = to_device(context(), p.velocity, "velocity");
        const gpu::Buffer density = to_device(context(), p.density, "density");
        const gpu::Buffer pressure = to_device(context(), p.pressure, "pressure");
        const gpu::Buffer attributes = to_device(context(), p.attributes, "attributes");
        std::vector<std::uint32_t> ids(p.position.size());
        std::iota(ids.rbegin(), ids.rend(), 0u); // they need not lie in order
        const gpu::Buffer id = to_device(context(), ids, "id");
        const gpu::Buffer freed_at = to_device(context(), p.freed_at, "freed at");

        std::vector<glm::vec4> disc_position;
        std::vector<glm::vec4> disc_normal;
        std::vector<glm::vec4> disc_color;
        for (const Disc& disc : discs != nullptr ? *discs : std::vector<Disc>{}) {
            disc_position.emplace_back(disc.center, disc.radius);
            disc_normal.emplace_back(disc.normal, 0.0f);
            disc_color.emplace_back(disc.color, 1.0f);
        }
        const render::DiscBuffers disc_buffers(context(), disc_position, disc_normal, disc_color);

        render::Renderer& renderer = renderer_of(width, height, samples);
        gpu::Commands commands(context());
        commands.begin();
        renderer.draw(commands, {settings,
                                 render::ParticleView{position, velocity, density, pressure, attributes,
                                                      static_cast<std::uint32_t>(p.position.size()),
                                                      p.freed_at.empty() ? nullptr : &freed_at, &id, p.time},
                                 disc_buffers.view()});
        commands.submit();
        commands.wait();
        return {renderer.capture(), renderer.capture_distance()};
    }

private:
    /// Renderers are kept from test to test: many small pictures are drawn.
    static render::Renderer& renderer_of(std::uint32_t width, std::uint32_t height, std::uint32_t samples)
    {
        gpu::Context& device = context(); // first, so that it outlives the renderers
        static std::map<std::array<std::uint32_t, 3>, std::unique_ptr<render::Renderer>> renderers;
        std::unique_ptr<render::Renderer>& renderer = renderers[{width, height, samples}];
        if (!renderer) {
            renderer = std::make_unique<render::Renderer>(device, width, height, samples);
        }
        return *renderer;
    }
};

} // namespace meltpoint
