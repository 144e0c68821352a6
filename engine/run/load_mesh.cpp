#include "run/load_mesh.h"

#include <string_view>

#include "geometry/builtin_meshes.h"
#include "io/mesh_import.h"

namespace meltpoint {

TriangleMesh load_mesh(const std::string& name)
{
    constexpr std::string_view builtin = "builtin:";
    return name.starts_with(builtin) ? builtin_mesh(std::string_view(name).substr(builtin.size())) : import_mesh(name);
}

} // namespace meltpoint
