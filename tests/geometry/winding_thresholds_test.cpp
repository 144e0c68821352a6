#include "geometry/winding_thresholds.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "core/random.h"

namespace meltpoint {
namespace {

TEST(WindingThresholds, AreWhatEveryPointOfTheirCellsSays)
{
    TriangleMesh mesh; // one triangle, twelve times: the winding number passes every half from -5.5 to 5.5
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles.assign(12, {0, 1, 2});
    CellGrid grid;
    grid.count = {60, 50, 70};
    grid.origin = glm::dvec3(-1.6, -1.3, -1.8);
    grid.cell_size = glm::dvec3(0.06);
    const std::vector<std::int8_t> thresholds = winding_thresholds(WindingNumber(mesh), grid);
    std::size_t known = 0;
    std::set<std::int8_t> found;
    glm::uvec3 cell(0);
    for (cell.z = 0; cell.z < grid.count.z; ++cell.z) {
        for (cell.y = 0; cell.y < grid.count.y; ++cell.y) {
            for (cell.x = 0; cell.x < grid.count.x; ++cell.x) {
                const std::int8_t threshold = thresholds[grid.index(cell)];
                if (threshold == no_threshold) {
                    continue;
                }
                ++known;
                found.insert(threshold);
                Random random(9, grid.index(cell));
                grid.points[0] = {random.uniform(), random.uniform(), random.uniform()};
                const double w = winding_number_exact(mesh, grid.point(cell));
                ASSERT_EQ(threshold, std::ceil(0.5 + w)) << w;
            }
        }
    }
    EXPECT_GT(double(known), 0.6 * double(grid.size()));
    EXPECT_EQ(found.count(0), 1u);
    EXPECT_EQ(found.count(1), 1u);
    EXPECT_EQ(found.count(2), 1u);
}

TEST(WindingThresholds, WithoutTrianglesAPointIsInsideFromOneOn)
{
    CellGrid grid;
    grid.count = {5, 40, 3};
    EXPECT_EQ(winding_thresholds(WindingNumber(TriangleMesh{}), grid), std::vector<std::int8_t>(grid.size(), 1));
}

} // namespace
} // namespace meltpoint
