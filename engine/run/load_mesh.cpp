#include "run/load_mesh.h"

#include <string_view>

#include "geometry/builtin_meshes.h"
#include "io/mesh_import.h"
#include "run/coarse_file.h"

namespace meltpoint {

namespace {

constexpr std::string_view builtin = "builtin:";

} // namespace

bool is_builtin(const std::string& name)
{
    return name.starts_with(builtin);
}

TriangleMesh load_mesh(const std::string& name)
{
    if (is_builtin(name)) {
        return builtin_mesh(std::string_view(name).substr(builtin.size()));
    }
    TriangleMesh mesh = import_mesh(name);
    warn_of_coarse_file(mesh.positions, name);
    return mesh;
}

} // namespace meltpoint
