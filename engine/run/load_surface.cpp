#include "run/load_surface.h"

#include <cstdint>
#include <vector>

#include "io/input_file.h"
#include "io/mesh_import.h"
#include "io/point_cloud_import.h"
#include "run/coarse_file.h"
#include "run/load_mesh.h"

namespace meltpoint {

std::variant<TriangleMesh, PointCloud> load_surface(const std::string& name)
{
    if (is_builtin(name)) {
        return load_mesh(name);
    }
    const std::vector<std::uint8_t> bytes = read_input_file(name);
    std::variant<TriangleMesh, PointCloud> surface;
    if (holds_points(bytes, name)) {
        surface = parse_point_cloud(bytes, name);
    } else {
        surface = parse_mesh(bytes, name);
    }
    std::visit([&](const auto& each) { warn_of_coarse_file(each.positions, name); }, surface);
    return surface;
}

} // namespace meltpoint
