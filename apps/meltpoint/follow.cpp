#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <variant>

#include <fmt/format.h>

#include "commands.h"
#include "conformance/device.h"
#include "core/error.h"
#include "exit_codes.h"
#include "geometry/cloud_solid.h"
#include "geometry/measure_volume.h"
#include "render/renderer.h"
#include "run/fluid_settings.h"
#include "run/frame_view.h"
#include "run/load_surface.h"
#include "run/scene_particles.h"
#include "scene_options.h"
#include "shared/neighbor_count.h"

namespace meltpoint::program {

namespace {

struct FollowOptions {
    SceneOptions scene;
    std::uint32_t particle = 0;
    std::uint32_t steps = 100;
};

/// One line of the result: `name` may stand for a pass or for what it leaves.
template <class... Args>
void print(const char* name, fmt::format_string<Args...> format, Args&&... args)
{
    fmt::print("{:<16}{}\n", name, fmt::format(format, std::forward<Args>(args)...));
}

std::string text(const glm::vec3& v)
{
    return fmt::format("{:.6g} {:.6g} {:.6g}", v.x, v.y, v.z);
}

void print_model(const std::string& name)
{
    const std::variant<TriangleMesh, PointCloud> model = load_surface(name);
    if (const auto* mesh = std::get_if<TriangleMesh>(&model)) {
        print("mesh", "{}, {} vertices, {} triangles, {:.6g} m^3", name, mesh->positions.size(), mesh->triangles.size(),
              measure_volume(*mesh));
    } else {
        const auto& cloud = std::get<PointCloud>(model);
        print("scan", "{}, {} points, {:.6g} m^3", name, cloud.size(),
              CloudSolid(make_cloud_surface(cloud, name)).volume());
    }
}

void print_start(const Scene& scene, const ParticleSet& initial, std::uint32_t particle)
{
    print("scene", "{}, {} fluid", scene.name, scene.fluids.size());
    for (const FluidBody& body : scene.fluids) {
        if (const auto* shape = std::get_if<MeshShape>(&body.shape)) {
            print_model(shape->mesh);
        }
    }
    print("sample", "{} particles, spacing {:.6g} m", initial.size(), scene.particles.spacing);
    print("particle", "{} at {} m, mass {:.6g} kg", particle, text(initial.position[particle]), initial.mass[particle]);
}

/// The particle's place among the device's buffers.
std::uint32_t slot_of(const ParticleSet& unordered, std::uint32_t particle)
{
    for (std::uint32_t slot = 0; slot < unordered.size(); ++slot) {
        if (unordered.id[slot] == particle) {
            return slot;
        }
    }
    throw std::logic_error("the sort lost the particle");
}

/// One step, pass by pass. Returns the particle after it.
ParticleSet follow_step(conformance::Device& device, std::uint32_t particle, std::uint32_t step)
{
    const auto now = [&] {
        return download_unordered(device.context, device.particles);
    };
    ParticleSet set = now(); // by id still
    print("buffers", "position {} m | velocity {} m/s | acceleration {} m/s^2", text(set.position[particle]),
          text(set.velocity[particle]), text(set.acceleration[particle]));

    device.run([&] {
        sim::record_kick_drift(device.commands, device.kernels, device.params_buffer, device.particles, device.status,
                               step);
    });
    set = now();
    print("kick, drift", "dt {:.6g} s: velocity {} m/s | position {} m", device.params.dt, text(set.velocity[particle]),
          text(set.position[particle]));

    device.run([&] {
        sim::record_sort(device.commands, device.kernels, device.params_buffer, device.particles, device.grid);
    });
    set = now();
    const std::uint32_t slot = slot_of(set, particle);
    const std::uint32_t count = device.params.pool_count;
    const std::uint32_t key = gpu::download<std::uint32_t>(device.context, device.grid.key, count)[particle];
    const auto start = gpu::download<std::uint32_t>(device.context, device.grid.cell_start, device.grid.cell_count + 1);
    const std::uint32_t from = gpu::download<std::uint32_t>(device.context, device.grid.order, count)[slot];
    const glm::uvec3& size = device.params.grid_size;
    print("cell key", "cell {} {} {} of {} x {} x {}: key {}", key % size.x, key / size.x % size.y,
          key / size.x / size.y, size.x, size.y, size.z, key);
    print("prefix scan", "{} particles lie in cells before this one, {} in it", start[key],
          start[key + 1] - start[key]);
    print("counting sort", "slot {}: number {} in its cell", slot, slot - start[key] + 1);
    print("reorder", "from place {} to place {}", from, slot);

    device.run([&] {
        sim::record_density(device.commands, device.kernels, device.params_buffer, device.particles, device.grid);
    });
    const gpu::Buffer counts = gpu::make_buffer<shared::NeighborCount>(device.context, count, "neighbor counts");
    device.run([&] {
        sim::record_count_neighbors(device.commands, device.kernels, device.params_buffer, device.particles,
                                    device.grid, counts);
    });
    set = now();
    const auto neighbors = gpu::download<shared::NeighborCount>(device.context, counts, count);
    print("density", "{} neighbors within {:.6g} m: density {:.6g} kg/m^3 | pressure {:.6g} Pa",
          neighbors[slot].neighbors, device.params.support_radius, set.density[slot], set.pressure[slot]);

    device.run([&] {
        sim::record_forces(device.commands, device.kernels, device.params_buffer, device.particles, device.grid);
    });
    print("forces", "acceleration {} m/s^2", text(now().acceleration[slot]));

    device.run([&] { sim::record_kick(device.commands, device.kernels, device.params_buffer, device.particles); });
    print("second kick", "velocity {} m/s", text(now().velocity[slot]));
    return download(device.context, device.particles);
}

bool same_bits(const glm::vec3& a, const glm::vec3& b)
{
    using Words = std::array<std::uint32_t, 3>;
    return std::bit_cast<Words>(a) == std::bit_cast<Words>(b);
}

/// Throws unless the passes one by one have done what a step of the simulation does.
void require_same(const ParticleSet& passes, const ParticleSet& step, std::uint32_t particle)
{
    if (!same_bits(passes.position[particle], step.position[particle]) ||
        !same_bits(passes.velocity[particle], step.velocity[particle]) ||
        !same_bits(passes.acceleration[particle], step.acceleration[particle])) {
        throw std::logic_error("the passes one by one differ from the simulation's step");
    }
}

/// Where a sphere lies in a picture, and how far along the view axis its surface is at the middle of a sample.
struct Splat {
    glm::vec2 pixel;
    float radius; // pixels
    glm::ivec2 sample;
    float distance; // m
};

/// As shaders/include/splat.glsl has it. size: of the picture in samples.
Splat project(const shared::SplatCamera& camera, const glm::vec3& x, float radius, const glm::vec2& size, float samples)
{
    const glm::vec3 center(camera.view * glm::vec4(x, 1.0f));
    const float scale = camera.orthographic != 0 ? 1.0f : -center.z;
    const auto place = [&](const glm::vec2& plane) {
        return 0.5f * ((plane - camera.plane_offset) / camera.plane_scale + 1.0f) * size;
    };
    Splat splat{};
    const glm::vec2 middle = place(glm::vec2(center) / scale);
    splat.pixel = middle / samples;
    splat.radius = 0.5f * radius / scale / std::abs(camera.plane_scale.y) * size.y / samples;
    splat.sample = glm::ivec2(glm::floor(middle));

    const glm::vec2 ndc = (glm::vec2(splat.sample) + 0.5f) * camera.pixel - 1.0f;
    const glm::vec2 plane = ndc * camera.plane_scale + camera.plane_offset;
    const bool parallel = camera.orthographic != 0;
    const glm::vec3 origin = parallel ? glm::vec3(plane, 0.0f) : glm::vec3(0.0f);
    const glm::vec3 ray = parallel ? glm::vec3(0.0f, 0.0f, -1.0f) : glm::normalize(glm::vec3(plane, -1.0f));
    const float along = glm::dot(center - origin, ray);
    const glm::vec3 off_axis = center - origin - along * ray;
    const float half_chord = std::sqrt(std::max(radius * radius - glm::dot(off_axis, off_axis), 0.0f));
    splat.distance = -(origin + (along - half_chord) * ray).z;
    return splat;
}

void follow_to_pixel(const gpu::Context& context, const Scene& scene, const sim::Simulation& simulation,
                     const glm::vec3& x)
{
    constexpr std::uint32_t samples = 2;
    const std::uint32_t width = scene.render.width;
    const std::uint32_t height = scene.render.height;
    render::Renderer renderer(context, width, height, samples);
    const render::FrameSettings settings = frame_settings(scene, simulation.params());
    const ParticleBuffers& p = simulation.particles();
    gpu::Commands commands(context);
    commands.begin();
    renderer.draw(commands, {.settings = settings,
                             .particles = render::ParticleView{p.position, p.velocity, p.density, p.pressure,
                                                               p.attributes, p.count}});
    commands.submit();
    commands.wait();

    const shared::SplatCamera camera = render::splat_camera(settings.camera, width * samples, height * samples);
    const Splat splat =
        project(camera, x, settings.splat_radius, glm::vec2(width * samples, height * samples), float{samples});
    print("splat vertex", "center at pixel {:.2f} {:.2f}, radius {:.2f} pixels", splat.pixel.x, splat.pixel.y,
          splat.radius);
    if (glm::any(glm::lessThan(splat.sample, glm::ivec2(0))) ||
        glm::any(glm::greaterThanEqual(splat.sample, glm::ivec2(width * samples, height * samples)))) {
        print("fragment", "outside of the picture");
        return;
    }
    const std::vector<float> distances = renderer.capture_distance();
    const auto sample = glm::uvec2(splat.sample);
    const float seen = distances[std::size_t{sample.y} * width * samples + sample.x];
    const bool is_seen = std::abs(seen - splat.distance) <= 1e-5f * splat.distance;
    print("fragment", "sample {} {}: the sphere is {:.6g} m away, {}", sample.x, sample.y, splat.distance,
          is_seen ? std::string("the nearest surface") : fmt::format("behind what is seen at {:.6g} m", seen));
    const Image image = renderer.capture();
    const std::size_t texel = 4 * (std::size_t{sample.y / samples} * width + sample.x / samples);
    print("resolve, PNG", "pixel {} {}: sRGB {} {} {}", sample.x / samples, sample.y / samples, image.rgba[texel],
          image.rgba[texel + 1], image.rgba[texel + 2]);
}

/// Throws where a step has other passes than those that follow_step takes apart.
void require_plain_step(const Scene& scene, const sim::FluidOptions& options)
{
    struct Other {
        bool is_on;
        const char* name;
        const char* without;
    };
    for (const Other& other : {
             Other{options.implicit_viscosity, "explicit viscosity", "physics.viscosity_model=explicit"},
             Other{options.capillarity, "surface tension of the paper", "physics.tension_model=paper"},
             Other{options.xsph, "steps without XSPH", "physics.xsph=0"},
             Other{options.confinement, "steps without confinement", "physics.vorticity_confinement=0"},
             Other{options.shifting, "steps without shifting", "physics.shifting=0"},
         }) {
        if (other.is_on) {
            throw input_error("{}: follow knows {} alone (--set {})", scene.name, other.name, other.without);
        }
    }
}

int follow(const FollowOptions& options)
{
    const Scene scene = load_scene(options.scene);
    if (scene.solver != Solver::Wcsph) {
        throw input_error("{}: follow knows the passes of solver \"wcsph\" alone (--set solver=wcsph)", scene.name);
    }
    const gpu::Context context(context_options(options.scene));
    const ParticleSet initial = make_particles(scene, sim::Simulation::particle_limit(context));
    if (initial.size() == 0) {
        throw input_error("{} has no particles to follow: its surfaces are drawn, not simulated", scene.name);
    }
    if (options.particle >= initial.size()) {
        throw input_error("--particle {}: {} has particles 0 to {}", options.particle, scene.name, initial.size() - 1);
    }
    const sim::SimulationSettings settings = with_fixed_steps(fluid_settings(scene, initial).simulation);
    require_plain_step(scene, settings.options);
    print_start(scene, initial, options.particle);

    sim::Simulation simulation(context, initial, settings);
    simulation.advance(options.steps - 1);
    conformance::Device device(context, simulation.download(), settings);
    fmt::print("\nstep {}, to {:.6g} s\n", options.steps, static_cast<double>(options.steps) * device.params.dt);
    const ParticleSet after = follow_step(device, options.particle, options.steps);
    simulation.advance(1);
    require_same(after, simulation.download(), options.particle);

    fmt::print("\nframe of {} x {} pixels\n", scene.render.width, scene.render.height);
    follow_to_pixel(context, scene, simulation, after.position[options.particle]);
    require_silent_validation(context);
    return exit_done;
}

} // namespace

void add_follow(CLI::App& app, const GlobalOptions& /*global*/, int& exit_code)
{
    auto options = std::make_shared<FollowOptions>();
    CLI::App* command = app.add_subcommand(
        "follow",
        "Follows one particle from its mesh through every pass of a step to its pixel, and prints its numbers");
    add_scene_options(*command, options->scene);
    command->add_option("--particle", options->particle, "Id of the particle [0]")->type_name("N");
    command->add_option("--steps", options->steps, "The step that is taken apart [100]")
        ->type_name("N")
        ->check(CLI::Range(1u, 100'000u));
    command->callback([options, &exit_code] { exit_code = follow(*options); });
}

} // namespace meltpoint::program
