#include "run/load_mesh.h"

#include <string_view>

#include "geometry/builtin_meshes.h"
#include "io/mesh_import.h"

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
    return is_builtin(name) ? builtin_mesh(std::string_view(name).substr(builtin.size())) : import_mesh(name);
}

} // namespace meltpoint
