#include "geometry/measure_volume.h"

#include <array>
#include <cmath>
#include <vector>

#include "geometry/mesh_solid.h"

namespace meltpoint {

namespace {

/// About so many equal cells, as near to cubes as long thin boxes allow.
CellGrid cells_of_box(const Aabb& box, double cells)
{
    const glm::dvec3 size(box.size());
    const double edge = std::cbrt(size.x * size.y * size.z / cells);
    const double most = std::ceil(4.0 * std::cbrt(cells));
    CellGrid grid;
    grid.origin = glm::dvec3(box.min);
    grid.count = glm::uvec3(glm::clamp(glm::ceil(size / edge), 1.0, most));
    grid.cell_size = size / glm::dvec3(grid.count);
    return grid;
}

/// Number of points inside in each row of the grid and its mirror image. Together they see nothing of the slope of a
/// surface, to first order (antithetic variates, Hammersley & Morton 1956).
std::vector<double> row_counts(const Solid& solid, CellGrid grid)
{
    std::vector<double> counts(grid.rows(), 0.0);
    for (const bool mirrored : {false, true}) {
        grid.mirrored = mirrored;
        const CellMask mask = solid.mask(grid);
        auto next = mask.begin();
        for (double& count : counts) {
            for (std::uint32_t i = 0; i < grid.count.x; ++i) {
                count += *next++;
            }
        }
    }
    return counts;
}

} // namespace

double measure_volume(const Solid& solid, const VolumeAccuracy& accuracy)
{
    constexpr std::array<double, 5> cell_counts = {40e3, 320e3, 0x1p20, 0x1p22, 0x1p24};
    const Aabb box = solid.bounds();
    const glm::dvec3 size(box.size());
    const double box_volume = size.x * size.y * size.z;
    if (!(box_volume > 0.0)) {
        return 0.0;
    }
    double inside = 0.0; // share of the box
    std::uint64_t seed = 0;
    for (const double cells : cell_counts) {
        if (cells < accuracy.first_cells || cells > accuracy.most_cells) {
            continue;
        }
        CellGrid grid = cells_of_box(box, cells);
        grid.jitter_seed = ++seed;
        const std::vector<double> one = row_counts(solid, grid);
        grid.jitter_seed = ++seed;
        const std::vector<double> other = row_counts(solid, grid);
        double points = 0.0;
        double squares = 0.0;
        for (std::size_t row = 0; row < grid.rows(); ++row) {
            points += one[row] + other[row];
            squares += (one[row] - other[row]) * (one[row] - other[row]);
        }
        // Two samples x, y of a row have a sum whose variance (x - y)^2 estimates; rows are independent.
        inside = points / (4.0 * static_cast<double>(grid.size()));
        if (std::sqrt(squares) <= accuracy.error * points) { // also where nothing is inside
            break;
        }
    }
    return inside * box_volume;
}

double measure_volume(const TriangleMesh& mesh)
{
    return measure_volume(MeshSolid(weld(mesh)));
}

} // namespace meltpoint
