#include "reference/cells.h"

#include <limits>

#include <gtest/gtest.h>

#include "reference/fluid_fixture.h"

namespace meltpoint::reference {
namespace {

void expect_same_as_brute_force(const std::vector<glm::dvec3>& position, double support_radius)
{
    const Neighbors fast = find_neighbors(position, support_radius);
    const Neighbors slow = find_neighbors_by_brute_force(position, support_radius);
    EXPECT_EQ(fast.start, slow.start);
    EXPECT_EQ(fast.index, slow.index);
}

std::vector<glm::dvec3> random_positions(int count, double extent)
{
    Random random(11);
    std::vector<glm::dvec3> position;
    for (int i = 0; i < count; ++i) {
        position.push_back(extent * random_vector(random));
    }
    return position;
}

TEST(Cells, NoParticles)
{
    const Neighbors neighbors = find_neighbors({}, 0.1);
    EXPECT_EQ(neighbors.start, std::vector<std::size_t>{0});
    EXPECT_TRUE(neighbors.index.empty());
}

TEST(Cells, NeighborsAreNearerThanTheSupportRadiusAndNotOneself)
{
    const std::vector<glm::dvec3> position = {{0.0, 0.0, 0.0}, {0.0999, 0.0, 0.0}, {0.2, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    const Neighbors neighbors = find_neighbors(position, 0.1);
    ASSERT_EQ(neighbors.start, (std::vector<std::size_t>{0, 2, 4, 4, 6}));
    EXPECT_EQ(neighbors.index, (std::vector<std::uint32_t>{1, 3, 0, 3, 0, 1}));
}

TEST(Cells, RandomPositionsMatchBruteForce)
{
    expect_same_as_brute_force(random_positions(2000, 0.5), 0.1);
    expect_same_as_brute_force(random_positions(500, 1000.0), 100.0); // mostly alone, far from the origin
}

TEST(Cells, AllInOneCellMatchBruteForce)
{
    expect_same_as_brute_force(random_positions(300, 0.01), 0.1);
}

TEST(Cells, ParticlesOnCellBordersMatchBruteForce)
{
    std::vector<glm::dvec3> position;
    for (int x = -4; x <= 4; ++x) {
        for (int y = -4; y <= 4; ++y) {
            for (int z = -4; z <= 4; ++z) {
                position.push_back(0.05 * glm::dvec3(x, y, z));
            }
        }
    }
    expect_same_as_brute_force(position, 0.05);
    expect_same_as_brute_force(position, 0.1);
    expect_same_as_brute_force(position, 0.15);
}

TEST(Cells, ParticlesThatAreNotFiniteOrFarAwayDoNoHarm)
{
    std::vector<glm::dvec3> position = random_positions(50, 0.1);
    position[3].x = std::numeric_limits<double>::quiet_NaN();
    position[7].y = std::numeric_limits<double>::infinity();
    position[9].z = -1e300;
    const Neighbors neighbors = find_neighbors(position, 0.1);
    EXPECT_TRUE(neighbors.of(3).empty());
    EXPECT_TRUE(neighbors.of(7).empty());
    EXPECT_TRUE(neighbors.of(9).empty());
    expect_same_as_brute_force(position, 0.1);
}

} // namespace
} // namespace meltpoint::reference
