#include "geometry/mesh_facts.h"

#include <algorithm>

#include <tbb/parallel_sort.h>

namespace meltpoint {

MeshFacts mesh_facts(const TriangleMesh& mesh)
{
    std::vector<std::uint64_t> edges;
    edges.reserve(3 * mesh.triangles.size());
    for (const glm::uvec3& corners : mesh.triangles) {
        for (int i = 0; i < 3; ++i) {
            const std::uint64_t a = corners[i];
            const std::uint64_t b = corners[(i + 1) % 3];
            edges.push_back(std::min(a, b) << 32 | std::max(a, b));
        }
    }
    tbb::parallel_sort(edges);
    MeshFacts facts;
    for (auto run = edges.begin(); run != edges.end();) {
        const auto next = std::find_if(run, edges.end(), [&](std::uint64_t edge) { return edge != *run; });
        facts.boundary_edges += next - run == 1 ? 1 : 0;
        facts.nonmanifold_edges += next - run > 2 ? 1 : 0;
        run = next;
    }
    facts.triangles = mesh.triangles.size();
    facts.area = surface_area(mesh);
    return facts;
}

} // namespace meltpoint
