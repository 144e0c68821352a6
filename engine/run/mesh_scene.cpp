#include "run/mesh_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string_view>
#include <variant>

#include <fmt/ranges.h>

#include "core/aabb.h"
#include "core/error.h"
#include "core/nearest_name.h"
#include "geometry/builtin_meshes.h"
#include "geometry/cloud_solid.h"
#include "geometry/measure_volume.h"
#include "run/load_surface.h"
#include "scene/key_table.h"
#include "scene/liquids.h"
#include "scene/scene_file.h"
#include "sim/wind.h"

namespace meltpoint {

namespace {

constexpr double wanted_particles = 16'000.0;
constexpr double wanted_solid_particles = 10'000.0; // heat is work, too

// The size at which the viscosity and the frame rate below look right: that of the default scene's teapot.
constexpr double model_size = 0.9;        // m
constexpr double model_viscosity = 4.0;   // Pa s
constexpr double model_frame_rate = 60.0; // 1/s

// What the ranges of a scene's keys leave room for.
constexpr float smallest_mesh = 0.001f;   // m
constexpr float largest_mesh = 2000.0f;   // m
constexpr double largest_viscosity = 1e4; // Pa s

bool is_scene_file(const std::filesystem::path& path)
{
    return path.extension() == ".toml";
}

/// What a scene is made to fit.
struct Model {
    std::string_view what; ///< for a person
    glm::vec3 extent;      ///< m
    double volume;         ///< m^3
};

Model model_of(const TriangleMesh& mesh, const std::string& /*name*/)
{
    return {.what = "mesh", .extent = bounds(mesh).size(), .volume = measure_volume(mesh)};
}

Model model_of(const PointCloud& cloud, const std::string& name)
{
    Aabb box;
    for (const glm::vec3& x : cloud.positions) {
        box.extend(x);
    }
    return {.what = "scan", .extent = box.size(), .volume = CloudSolid(make_cloud_surface(cloud, name)).volume()};
}

float largest_of(const Model& model)
{
    return std::max({model.extent.x, model.extent.y, model.extent.z});
}

/// A box with its floor at y = 0, with so much room beside the model and above it.
void set_box(Scene& scene, const Model& model, float beside, float above)
{
    const glm::vec2 side = 0.5f * glm::vec2(model.extent.x, model.extent.z) + beside;
    scene.domain.min = glm::vec3(-side.x, 0.0f, -side.y);
    scene.domain.max = glm::vec3(side.x, model.extent.y + above, side.y);
}

/// Fluid that drops into a box.
void set_drop(Scene& scene, const MeshShape& mesh, const Model& model, double similarity)
{
    const float largest = largest_of(model);
    scene.description = fmt::format("A {} filled with fluid, dropped into a box.", model.what);
    scene.particles.spacing = static_cast<float>(std::cbrt(model.volume / wanted_particles));
    scene.physics.viscosity =
        static_cast<float>(std::min(model_viscosity * std::pow(similarity, 1.5), largest_viscosity));
    scene.time.frame_rate = static_cast<float>(model_frame_rate / std::sqrt(similarity));
    set_box(scene, model, 0.2f * largest, 0.5f * model.extent.y + 0.6f * largest);
    scene.domain.wall_viscosity = 0.5f * scene.physics.viscosity;
    scene.fluids.push_back({.shape = mesh});
    std::get<MeshShape>(scene.fluids[0].shape).position.y = 0.5f * model.extent.y + 0.4f * largest;
}

/// Ice that melts in the sun, whose heat works so fast that frame after frame as much of any size is gone.
void set_melt(Scene& scene, const MeshShape& mesh, const Model& model, double similarity)
{
    const float largest = largest_of(model);
    scene.description = fmt::format("A {} of ice melts in the sun.", model.what);
    scene.solver = Solver::Dfsph;
    scene.particles.spacing = static_cast<float>(std::cbrt(model.volume / wanted_solid_particles));
    scene.time.frame_rate = static_cast<float>(30.0 / std::sqrt(similarity));
    scene.heat.time_scale = static_cast<float>(20'000.0 * std::sqrt(similarity));
    scene.heat.air_temperature = 25.0f;
    set_box(scene, model, 0.4f * largest, 0.3f * largest);
    SolidBody ice;
    set_liquid(ice, *find_liquid("water"));
    ice.viscosity = static_cast<float>(std::min(0.04 * std::pow(similarity, 1.5), largest_viscosity));
    ice.friction = 2.0f * *ice.viscosity;
    scene.domain.wall_viscosity = *ice.viscosity;
    ice.shape = mesh;
    std::get<MeshShape>(ice.shape).position.y = 0.5f * model.extent.y + 0.25f * scene.particles.spacing;
    ice.lattice = BodyLattice::BlueNoise; // no rows melt at once
    ice.melts = true;
    ice.solid_color = {0.72f, 0.83f, 0.90f};
    scene.solids.push_back(ice);
}

/// A solid that crumbles into dust, from its right side on.
void set_vanish(Scene& scene, const MeshShape& mesh, const Model& model, double similarity)
{
    const float largest = largest_of(model);
    const auto size = static_cast<float>(similarity);
    const float speed = std::sqrt(size); // Froude's similarity: times are as long as this, too
    scene.description = fmt::format("A {} crumbles into dust that the wind carries off.", model.what);
    scene.solver = Solver::Dfsph;
    scene.particles.spacing = static_cast<float>(std::cbrt(model.volume / wanted_solid_particles));
    scene.time.frame_rate = 24.0f / speed;
    set_box(scene, model, 0.8f * largest, 0.8f * largest);
    scene.dust = {.wind = speed * glm::vec3(0.55f, 0.3f, 0.0f),
                  .turbulence = 0.5f * speed,
                  .eddy_size = 0.7f * size,
                  .response_time = 0.25f * speed,
                  .life = 2.2f * speed};
    SolidBody solid;
    solid.shape = mesh;
    std::get<MeshShape>(solid.shape).position.y = 0.5f * model.extent.y + 0.25f * scene.particles.spacing;
    solid.lattice = BodyLattice::BlueNoise;
    solid.becomes = SolidBecomes::Dust;
    solid.anchor = SolidAnchor::All; // what hangs in the air crumbles there
    solid.solid_color = {0.55f, 0.42f, 0.34f};
    solid.dissolve = {.speed = 0.4f * speed,
                      .start = 0.3f * speed,
                      .direction = glm::vec3(-1.0f, -0.25f, 0.0f),
                      .roughness = 0.12f * size,
                      .grain = 0.2f * size};
    scene.solids.push_back(solid);
}

/// Soft stone that a jet of water wears away.
void set_wash(Scene& scene, const MeshShape& mesh, const Model& model, double similarity)
{
    const float largest = largest_of(model);
    const auto size = static_cast<float>(similarity);
    const float speed = std::sqrt(size); // Froude's similarity
    scene.description = fmt::format("A jet of water wears a {} away.", model.what);
    scene.solver = Solver::Dfsph;
    scene.particles.spacing = static_cast<float>(std::cbrt(model.volume / wanted_solid_particles));
    scene.physics.viscosity = static_cast<float>(std::min(0.1 * std::pow(similarity, 1.5), 0.2 * largest_viscosity));
    scene.time.frame_rate = 30.0f / speed;
    set_box(scene, model, 0.45f * largest, 0.4f * largest);
    const glm::vec3 low = scene.domain.min;
    const glm::vec3 high = scene.domain.max;
    scene.domain.wall_viscosity = 5.0f * scene.physics.viscosity;

    const float jet_speed = 3.2f * speed;
    EmitterBody jet;
    jet.shape = JetShape{.center = {low.x + 0.05f * largest, 0.6f * model.extent.y, 0.0f},
                         .radius = std::max(0.08f * largest, scene.particles.spacing)};
    jet.velocity = jet_speed * glm::vec3(1.0f, 0.1f, 0.0f);
    jet.particles = 6000;
    scene.emitters.push_back(jet);
    const float drain = 0.1f * largest; // along the floor's borders
    scene.sinks.push_back({BlockShape{low, {low.x + drain, drain, high.z}}});
    scene.sinks.push_back({BlockShape{{high.x - drain, 0.0f, low.z}, {high.x, drain, high.z}}});

    SolidBody stone;
    stone.shape = mesh;
    std::get<MeshShape>(stone.shape).position.y = 0.5f * model.extent.y + 0.25f * scene.particles.spacing;
    stone.rest_density = 1800.0f;
    stone.viscosity = 4.0f * scene.physics.viscosity;
    stone.friction = scene.physics.viscosity;
    stone.solid_color = {0.80f, 0.66f, 0.45f};
    stone.color = {0.66f, 0.52f, 0.34f};
    // The jet shears at its speed over a spacing: of any size it does so with 10 Pa, and wears as much away in a frame.
    stone.erosion = {.erodes = true,
                     .threshold = 3.0f,
                     .rate = 60.0f * speed,
                     .strength_contrast = 2.0f,
                     .strength_grain = 0.15f * largest};
    scene.hydraulic.exponent = 0.5f;
    scene.hydraulic.consistency = 10.0f / std::sqrt(jet_speed / scene.particles.spacing);
    scene.solids.push_back(stone);
}

/// Sand in the wind, which slides down to its angle of repose where the model is steeper.
void set_dune(Scene& scene, const MeshShape& mesh, const Model& model, double similarity)
{
    const float largest = largest_of(model);
    const auto size = static_cast<float>(similarity);
    const float speed = std::sqrt(size); // Froude's similarity
    scene.description = fmt::format("A {} of sand in the wind.", model.what);
    scene.solver = Solver::Dfsph;
    scene.particles.spacing = static_cast<float>(std::cbrt(model.volume / wanted_solid_particles));
    scene.time.frame_rate = 24.0f / speed;
    set_box(scene, model, 0.7f * largest, 0.5f * largest);
    scene.domain.max.x += 1.2f * largest; // where the sand is blown to
    scene.domain.walls = false;           // and beyond
    scene.camera.eye = largest * glm::vec3(1.9f, 0.9f, 2.2f);
    scene.camera.target = glm::vec3(0.4f * largest, 0.3f * model.extent.y, 0.0f);
    scene.camera.field_of_view = 38.0f;
    scene.render.light = {-0.9f, 0.6f, 0.3f}; // low above the windward side

    SolidBody sand;
    sand.shape = mesh;
    std::get<MeshShape>(sand.shape).position.y = 0.5f * model.extent.y + 0.25f * scene.particles.spacing;
    sand.rest_density = 1600.0f;
    sand.wind_erodes = true;
    sand.solid_color = {0.79f, 0.60f, 0.34f};
    // What is far larger than life is of gravel in a storm: grains of sand would not fly as far.
    sand.erosion.grain_size = 250e-6f * std::max(1.0f, size / 5.0f);
    scene.wind.friction_velocity = 0.5f * std::max(1.0f, speed / 3.0f);
    scene.wind.roughness_length = std::min(1e-3f * size, 1.0f);
    scene.wind.hop_length = std::max(0.3f * size, 5.0f * scene.particles.spacing);
    // Of flat ground as much is gone in a frame at any size.
    const double flux = sim::bagnold_flux({.friction_velocity = static_cast<double>(scene.wind.friction_velocity)},
                                          {.grain_size = static_cast<double>(*sand.erosion.grain_size)}, 9.81);
    const double lost = flux / (static_cast<double>(scene.wind.hop_length) * 1600.0); // m/s
    scene.wind.time_scale = static_cast<float>(0.02 * std::sqrt(similarity) / lost);
    scene.solids.push_back(sand);
}

} // namespace

std::span<const LookName> look_names()
{
    static constexpr std::array<LookName, 5> names{{{"drop", Look::Drop},
                                                    {"melt", Look::Melt},
                                                    {"dune", Look::Dune},
                                                    {"vanish", Look::Vanish},
                                                    {"wash", Look::Wash}}};
    return names;
}

Scene mesh_scene(const std::string& name, Look look)
{
    const Model model = std::visit([&](const auto& each) { return model_of(each, name); }, load_surface(name));
    if (!(model.volume > 0.0)) {
        throw input_error("{}: the {} encloses no volume that could be filled{}", name, model.what,
                          model.what == "scan" ? ": it is flat, or its normals face inward" : "");
    }
    const float largest = largest_of(model);
    if (largest < smallest_mesh || largest > largest_mesh) {
        throw input_error("{}: the {} is {:.4g} m large, but only what is {} m to {} m large can be dropped (a scene "
                          "file can scale it: fluid.size)",
                          name, model.what, largest, smallest_mesh, largest_mesh);
    }
    const double similarity = static_cast<double>(largest) / model_size;
    Scene scene;
    scene.name = name.starts_with("builtin:") ? name.substr(8) : std::filesystem::path(name).stem().string();
    scene.render.splat_radius = 0.75f;
    const MeshShape mesh{.mesh = name};
    switch (look) {
    case Look::Drop:
        set_drop(scene, mesh, model, similarity);
        break;
    case Look::Melt:
        set_melt(scene, mesh, model, similarity);
        break;
    case Look::Dune:
        set_dune(scene, mesh, model, similarity);
        break;
    case Look::Vanish:
        set_vanish(scene, mesh, model, similarity);
        break;
    case Look::Wash:
        set_wash(scene, mesh, model, similarity);
        break;
    }
    return scene;
}

Scene find_scene(const std::string& name, std::span<const std::string> overrides, std::optional<Look> look)
{
    const auto refuse_look = [&] {
        if (look) {
            throw input_error("--look: {} is a scene, which has a look of its own: looks are for meshes and scans",
                              name);
        }
    };
    const std::vector<std::string> builtin = builtin_scene_names();
    if (std::find(builtin.begin(), builtin.end(), name) != builtin.end()) {
        refuse_look();
        return builtin_scene(name, overrides); // a file of that name is ./NAME
    }
    std::error_code error; // a name that cannot be a path, because it is too long, is not the name of a file
    const std::filesystem::file_status status = std::filesystem::status(name, error);
    if (name.starts_with("builtin:") || (std::filesystem::is_regular_file(status) && !is_scene_file(name))) {
        return parse_scene(write_scene(mesh_scene(name, look.value_or(Look::Drop))), name,
                           std::filesystem::current_path(), overrides);
    }
    if (std::filesystem::exists(status) || is_scene_file(name)) {
        refuse_look();
        return read_scene_file(name, overrides);
    }
    const std::span<const std::string_view> meshes = builtin_mesh_names();
    const auto nearest = std::ranges::find(meshes, name) != meshes.end() ? std::optional("builtin:" + name)
                                                                         : nearest_name(name, builtin);
    throw input_error("there is no scene or mesh \"{}\": neither a file nor a built-in scene ({}){}", name,
                      fmt::join(builtin, ", "), nearest ? fmt::format("; did you mean \"{}\"?", *nearest) : "");
}

std::size_t replace_meshes(Scene& scene, const std::string& mesh)
{
    std::size_t replaced = 0;
    for_each_body_list(scene, [&](std::string_view, auto& bodies, const auto&) {
        for (auto& body : bodies) {
            if constexpr (std::is_same_v<decltype(body.shape), BodyShape>) {
                if (auto* shape = std::get_if<MeshShape>(&body.shape)) {
                    shape->mesh = mesh;
                    ++replaced;
                }
            }
        }
    });
    return replaced;
}

} // namespace meltpoint
