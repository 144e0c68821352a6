#include "reference/cells.h"

#include <limits>

#include <gtest/gtest.h>

#include "reference/fluid_fixture.h"

namespace meltpoint::reference {
namespace {

shared::SphParams box(double support_radius, std::uint32_t wall_mask = 0)
{
    shared::SphParams params{};
    params.support_radius = static_cast<float>(support_radius);
    params.domain_min = glm::vec3(-0.5f);
    params.domain_max = glm::vec3(0.5f);
    params.wall_mask = wall_mask;
    return params;
}

void expect_same_as_brute_force(const std::vector<glm::dvec3>& position, const shared::SphParams& params)
{
    const Neighbors fast = find_neighbors(params, position);
    const Neighbors slow = find_neighbors_by_brute_force(params, position);
    EXPECT_EQ(fast.start, slow.start);
    EXPECT_TRUE(fast.list == slow.list);
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
    const Neighbors neighbors = find_neighbors(box(0.1), {});
    EXPECT_EQ(neighbors.start, std::vector<std::size_t>{0});
    EXPECT_TRUE(neighbors.list.empty());
}

TEST(Cells, NeighborsAreNearerThanTheSupportRadiusAndNotOneself)
{
    const std::vector<glm::dvec3> position = {{0.0, 0.0, 0.0}, {0.0999, 0.0, 0.0}, {0.2, 0.0, 0.0}, {0.0, 0.0, 0.0}};
    const Neighbors neighbors = find_neighbors(box(0.1), position);
    ASSERT_EQ(neighbors.start, (std::vector<std::size_t>{0, 2, 4, 4, 6}));
    EXPECT_TRUE(neighbors.list == (std::vector<Neighbor>{{1, 0}, {3, 0}, {0, 0}, {3, 0}, {0, 0}, {1, 0}}));
}

TEST(Cells, PeriodicBordersMatchBruteForce)
{
    for (const std::uint32_t mask : {0x03u, 0x0cu, 0x33u, 0x3fu}) {
        shared::SphParams params = box(0.2, 0x3f & ~mask);
        params.periodic_mask = mask;
        expect_same_as_brute_force(random_positions(600, 0.5), params);
    }
}

TEST(Cells, NeighborsAreSeenAcrossThePeriodicBorder)
{
    shared::SphParams params = box(0.2);
    params.periodic_mask = 0x03;
    const std::vector<glm::dvec3> position = {{0.45, 0.45, 0.0}, {-0.45, 0.45, 0.0}, {0.45, -0.45, 0.0}};
    const Neighbors neighbors = find_neighbors(params, position);
    ASSERT_EQ(neighbors.start, (std::vector<std::size_t>{0, 1, 2, 2})); // y is not periodic
    const Neighbor across = neighbors.of(0)[0];
    EXPECT_EQ(across.index, 1u);
    EXPECT_NEAR(reflect_position(params, across.reflection, position[1]).x, 0.55, 1e-12);
    EXPECT_EQ(reflect_velocity(across.reflection, glm::dvec3(1.0, 2.0, 3.0)), glm::dvec3(1.0, 2.0, 3.0));
    EXPECT_NEAR(wrap_position(params, {0.55, 0.55, 0.0}).x, -0.45, 1e-12);
    EXPECT_NEAR(wrap_position(params, {-0.55, 0.55, 0.0}).x, 0.45, 1e-12);
    EXPECT_EQ(wrap_position(params, {0.55, 0.55, 0.0}).y, 0.55);
}

TEST(Cells, RandomPositionsMatchBruteForce)
{
    expect_same_as_brute_force(random_positions(2000, 0.5), box(0.1));
    expect_same_as_brute_force(random_positions(500, 1000.0), box(100.0)); // mostly alone, far from the origin
}

TEST(Cells, AllInOneCellMatchBruteForce)
{
    expect_same_as_brute_force(random_positions(300, 0.01), box(0.1));
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
    expect_same_as_brute_force(position, box(0.05));
    expect_same_as_brute_force(position, box(0.1));
    expect_same_as_brute_force(position, box(0.15));
}

TEST(Cells, ImagesBehindWallsMatchBruteForce)
{
    for (const std::uint32_t wall_mask : {1u, 4u, 32u, 0b010101u, 63u}) {
        expect_same_as_brute_force(random_positions(1000, 0.5), box(0.15, wall_mask));
    }
}

TEST(Cells, ParticleInACornerMeetsItsSevenImages)
{
    const std::vector<glm::dvec3> position = {{-0.49, 0.49, -0.48}};
    const Neighbors neighbors = find_neighbors(box(0.1, 63), position);
    EXPECT_TRUE(neighbors.list == (std::vector<Neighbor>{{0, 1}, {0, 8}, {0, 9}, {0, 16}, {0, 17}, {0, 24}, {0, 25}}));
    EXPECT_EQ(reflect_position(box(0.1, 63), 25, position[0]), glm::dvec3(-0.51, 0.51, -0.52));
    EXPECT_EQ(reflect_velocity(25, {1.0, 2.0, 3.0}), glm::dvec3(-1.0, -2.0, -3.0));
    EXPECT_EQ(reflect_velocity(8, {1.0, 2.0, 3.0}), glm::dvec3(1.0, -2.0, 3.0));
}

TEST(Cells, WallsOfTheMaskOnly)
{
    const std::vector<glm::dvec3> position = {{-0.49, 0.0, 0.0}, {0.0, 0.0, 0.49}};
    EXPECT_TRUE(find_neighbors(box(0.1, 63 - 1 - 32), position).list.empty());
    EXPECT_TRUE(find_neighbors(box(0.1, 32), position).list == (std::vector<Neighbor>{{1, 32}}));
}

TEST(Cells, ParticlesThatAreNotFiniteOrFarAwayDoNoHarm)
{
    std::vector<glm::dvec3> position = random_positions(50, 0.1);
    position[3].x = std::numeric_limits<double>::quiet_NaN();
    position[7].y = std::numeric_limits<double>::infinity();
    position[9].z = -1e300;
    const Neighbors neighbors = find_neighbors(box(0.1), position);
    EXPECT_TRUE(neighbors.of(3).empty());
    EXPECT_TRUE(neighbors.of(7).empty());
    EXPECT_TRUE(neighbors.of(9).empty());
    expect_same_as_brute_force(position, box(0.1));
}

} // namespace
} // namespace meltpoint::reference
