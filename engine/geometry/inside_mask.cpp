// Away from the surface the winding number is harmonic and hardly changes, so whole blocks of cells are decided at once
// and only those near the surface are halved down to their points: the work grows with the area, not with the volume.

#include "geometry/inside_mask.h"

#include <algorithm>
#include <cmath>

#include "core/parallel_for.h"
#include "core/random.h"

namespace meltpoint {

namespace {

constexpr double threshold = 0.5;
constexpr std::uint32_t task_edge = 16;     // cells along the edge of a block that one task fills
constexpr std::uint32_t smallest_block = 8; // cells: fewer are decided one by one

struct Block {
    glm::uvec3 begin;
    glm::uvec3 end;

    [[nodiscard]] std::size_t size() const
    {
        const glm::uvec3 edge = end - begin;
        return std::size_t{edge.x} * edge.y * edge.z;
    }
};

template <class Visit>
void for_each_cell(const Block& block, const Visit& visit)
{
    for (std::uint32_t z = block.begin.z; z < block.end.z; ++z) {
        for (std::uint32_t y = block.begin.y; y < block.end.y; ++y) {
            for (std::uint32_t x = block.begin.x; x < block.end.x; ++x) {
                visit(glm::uvec3(x, y, z));
            }
        }
    }
}

class MaskFiller {
public:
    MaskFiller(const WindingNumber& winding, const CellGrid& grid, std::vector<std::uint8_t>& mask)
        : winding_(winding), grid_(grid), mask_(mask)
    {
    }

    void fill(const Block& block) const
    {
        if (block.size() < smallest_block) {
            for_each_cell(block, [&](const glm::uvec3& cell) {
                mask_[grid_.index(cell)] = winding_.at(grid_.point(cell)) >= threshold ? 1 : 0;
            });
            return;
        }
        const glm::dvec3 half_size = 0.5 * grid_.cell_size * glm::dvec3(block.end - block.begin);
        const glm::dvec3 center = grid_.origin + grid_.cell_size * glm::dvec3(block.begin) + half_size;
        const double half_diagonal = glm::length(half_size);
        // With no surface, hence no hole's rim, within two half diagonals, w is harmonic there. The steepest that it
        // then gets is in the middle of a round hole of radius 2 h: it changes by 1/2 (1/2) / sqrt(1 + 1/4) = 0.22
        // over the half diagonal h. So a block 1/4 away from the threshold does not cross it.
        if (!winding_.surface_may_be_within(2.0 * half_diagonal, center)) {
            const double w = winding_.at(center);
            if (std::abs(w - threshold) >= 0.25) {
                for_each_cell(block,
                              [&](const glm::uvec3& cell) { mask_[grid_.index(cell)] = w >= threshold ? 1 : 0; });
                return;
            }
        }
        const glm::uvec3 edge = block.end - block.begin;
        const int axis = edge.x >= edge.y && edge.x >= edge.z ? 0 : edge.y >= edge.z ? 1 : 2;
        Block low = block;
        Block high = block;
        low.end[axis] = high.begin[axis] = block.begin[axis] + edge[axis] / 2;
        fill(low);
        fill(high);
    }

private:
    const WindingNumber& winding_;
    const CellGrid& grid_;
    std::vector<std::uint8_t>& mask_;
};

} // namespace

glm::dvec3 CellGrid::point(const glm::uvec3& cell) const
{
    glm::dvec3 within(0.5);
    if (jitter_seed) {
        Random random(*jitter_seed, index(cell));
        within.x = random.uniform();
        within.y = random.uniform();
        within.z = random.uniform();
    }
    return origin + cell_size * (glm::dvec3(cell) + within);
}

std::vector<std::uint8_t> inside_mask(const WindingNumber& winding, const CellGrid& grid)
{
    std::vector<std::uint8_t> mask(grid.size());
    const MaskFiller filler(winding, grid, mask);
    const glm::uvec3 tasks = (grid.count + (task_edge - 1)) / task_edge;
    parallel_for(std::size_t{tasks.x} * tasks.y * tasks.z, [&](std::size_t task) {
        const glm::uvec3 begin =
            task_edge * glm::uvec3(task % tasks.x, task / tasks.x % tasks.y, task / (std::size_t{tasks.x} * tasks.y));
        filler.fill({begin, glm::min(begin + task_edge, grid.count)});
    });
    return mask;
}

} // namespace meltpoint
