#include "run/mesh_scene.h"

#include <algorithm>
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
#include "scene/scene_file.h"

namespace meltpoint {

namespace {

constexpr double wanted_particles = 16'000.0;

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

} // namespace

Scene mesh_scene(const std::string& name)
{
    const auto [what, extent, volume] =
        std::visit([&](const auto& each) { return model_of(each, name); }, load_surface(name));
    if (!(volume > 0.0)) {
        throw input_error("{}: the {} encloses no volume that could be filled{}", name, what,
                          what == "scan" ? ": it is flat, or its normals face inward" : "");
    }
    const float largest = std::max({extent.x, extent.y, extent.z});
    if (largest < smallest_mesh || largest > largest_mesh) {
        throw input_error("{}: the {} is {:.4g} m large, but only what is {} m to {} m large can be dropped (a scene "
                          "file can scale it: fluid.size)",
                          name, what, largest, smallest_mesh, largest_mesh);
    }
    const double similarity = static_cast<double>(largest) / model_size;

    Scene scene;
    scene.name = name.starts_with("builtin:") ? name.substr(8) : std::filesystem::path(name).stem().string();
    scene.description = fmt::format("A {} filled with fluid, dropped into a box.", what);
    scene.particles.spacing = static_cast<float>(std::cbrt(volume / wanted_particles));
    scene.physics.viscosity =
        static_cast<float>(std::min(model_viscosity * std::pow(similarity, 1.5), largest_viscosity));
    scene.time.frame_rate = static_cast<float>(model_frame_rate / std::sqrt(similarity));

    const glm::vec2 side = 0.5f * glm::vec2(extent.x, extent.z) + 0.2f * largest;
    scene.domain.min = glm::vec3(-side.x, 0.0f, -side.y);
    scene.domain.max = glm::vec3(side.x, 1.5f * extent.y + 0.6f * largest, side.y);
    scene.domain.wall_viscosity = 0.5f * scene.physics.viscosity;
    scene.render.splat_radius = 0.75f;
    MeshShape shape{.mesh = name};
    shape.position = glm::vec3(0.0f, 0.5f * extent.y + 0.4f * largest, 0.0f);
    scene.fluids.push_back({.shape = shape});
    return scene;
}

Scene find_scene(const std::string& name, std::span<const std::string> overrides)
{
    const std::vector<std::string> builtin = builtin_scene_names();
    if (std::find(builtin.begin(), builtin.end(), name) != builtin.end()) {
        return builtin_scene(name, overrides); // a file of that name is ./NAME
    }
    std::error_code error; // a name that cannot be a path, because it is too long, is not the name of a file
    const std::filesystem::file_status status = std::filesystem::status(name, error);
    if (name.starts_with("builtin:") || (std::filesystem::is_regular_file(status) && !is_scene_file(name))) {
        return parse_scene(write_scene(mesh_scene(name)), name, std::filesystem::current_path(), overrides);
    }
    if (std::filesystem::exists(status) || is_scene_file(name)) {
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
