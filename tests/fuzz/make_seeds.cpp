// make_seeds FOLDER: writes small good files of every format for the fuzzers to begin with, one folder a fuzzer.

#include <cstdio>
#include <filesystem>
#include <string>

#include "geometry/triangle_mesh.h"
#include "scene/scene_file.h"
#include "support/mesh_files.h"
#include "support/scratch_folder.h"

namespace {

namespace fs = std::filesystem;
using namespace meltpoint; // NOLINT(google-build-using-namespace): this file is the program

void write(const fs::path& folder, const std::string& name, const std::string& bytes)
{
    fs::create_directories(folder);
    test::write_bytes(folder / name, bytes);
}

void write_all(const fs::path& folder, const std::string& name, const TriangleMesh& mesh)
{
    const std::string nodes = R"({"children": [1], "translation": [1, 2, 3], "rotation": [0, 0, 0, 1]}, {"mesh": 0})";
    write(folder / "obj", name, test::obj_of(mesh));
    write(folder / "ply", name + "_ascii", test::ascii_ply_of(mesh));
    write(folder / "ply", name + "_little", test::binary_ply_of(mesh, test::ByteOrder::Little));
    write(folder / "ply", name + "_big", test::binary_ply_of(mesh, test::ByteOrder::Big));
    write(folder / "stl", name + "_ascii", test::ascii_stl_of(mesh));
    write(folder / "stl", name + "_binary", test::binary_stl_of(mesh));
    write(folder / "off", name, test::off_of(mesh));
    write(folder / "gltf", name, test::gltf_of(mesh, nodes));
    write(folder / "glb", name, test::glb_of(mesh, nodes));
    write(folder / "points_ply", name, test::ascii_ply_of(mesh));
}

} // namespace

int main(int argc, char** argv)
{
    if (argc != 2) {
        std::fputs("make_seeds FOLDER\n", stderr);
        return 2;
    }
    const fs::path folder = argv[1];
    TriangleMesh tetrahedron;
    tetrahedron.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    tetrahedron.triangles = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
    write_all(folder, "plain", tetrahedron);
    tetrahedron.normals = {{-1, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    write_all(folder, "normals", tetrahedron);
    tetrahedron.colors = {{255, 0, 0}, {0, 128, 255}, {10, 20, 30}, {255, 255, 255}};
    write_all(folder, "colors", tetrahedron);
    write(folder / "xyz", "plain", "# points\n0 0 0\n1.5e0 -2 3\n");
    write(folder / "xyz", "named", "//X Y Z I\nx,y,z,i\n2\n0 0 0 0.5\n1 2 3 7 // the last\n");
    write(folder / "xyz", "full", "0 0 0 0 0 1 255 0 0\n1,2,3,1,0,0,1,2,3\n");
    for (const std::string& name : builtin_scene_names()) {
        write(folder / "scene", name, write_scene(builtin_scene(name)));
    }
    const std::string with_override =
        write_scene(builtin_scene("drop")) + std::string(1, '\0') + "physics.viscosity=0.1";
    write(folder / "scene", "override", with_override);
    return 0;
}
