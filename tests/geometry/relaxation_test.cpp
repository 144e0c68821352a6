#include "geometry/relaxation.h"

#include <cmath>
#include <cstring>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "core/random.h"
#include "geometry/builtin_meshes.h"
#include "geometry/mesh_solid.h"
#include "geometry/volume_sampling.h"

namespace meltpoint {
namespace {

/// Standard deviation over mean of the density of particles farther than H from the walls of a box, by the sum over all
/// pairs. Wendland C2, H = 2.6 spacings.
double spread_inside(const std::vector<glm::vec3>& positions, const Aabb& box, double spacing)
{
    const double h = 2.6 * spacing;
    double sum = 0.0;
    double squares = 0.0;
    double count = 0.0;
    for (const glm::vec3& p : positions) {
        if (!box.contains(p - float(h)) || !box.contains(p + float(h))) {
            continue;
        }
        double density = 0.0;
        for (const glm::vec3& other : positions) {
            const double q = double(glm::distance(p, other)) / h;
            density += q < 1.0 ? std::pow(1.0 - q, 4) * (1.0 + 4.0 * q) : 0.0;
        }
        sum += density;
        squares += density * density;
        count += 1.0;
    }
    const double mean = sum / count;
    return std::sqrt(squares / count - mean * mean) / mean;
}

std::vector<glm::vec3> random_points(const Solid& solid, std::size_t count)
{
    std::vector<glm::vec3> points;
    Random random(11);
    while (points.size() < count) {
        const glm::vec3 in_box(random.uniform(), random.uniform(), random.uniform());
        const glm::vec3 point = solid.bounds().min + in_box * solid.bounds().size();
        if (solid.contains(glm::dvec3(point))) {
            points.push_back(point);
        }
    }
    return points;
}

TEST(Relaxation, MeasuresALattice)
{
    const Aabb box{{2.0f, 0.0f, 0.0f}, {3.2f, 1.0f, 0.9f}};
    const VolumeSamples lattice = sample_block(box, 0.1);
    const Evenness evenness = evenness_of(lattice.positions, BoxSolid(box));
    // At the walls too, where what is outside counts as filled; but a lattice's own sum is 1 % too high.
    EXPECT_LT(evenness.density_spread, 0.01);
    EXPECT_NEAR(evenness.relative_radius, 0.8909, 1e-4);
    const Evenness random = evenness_of(random_points(BoxSolid(box), 1080), BoxSolid(box));
    EXPECT_GT(random.density_spread, 0.15);
    EXPECT_LT(random.relative_radius, 0.3);
}

TEST(Relaxation, LeavesALatticeAlone)
{
    const Aabb box{{0.0f, 0.0f, 0.0f}, {1.0f, 1.0f, 1.0f}};
    const std::vector<glm::vec3> lattice = sample_block(box, 0.1).positions;
    std::vector<glm::vec3> relaxed = lattice;
    EXPECT_EQ(relax_particles(relaxed, BoxSolid(box)).iterations, 0u);
    EXPECT_EQ(relaxed, lattice);
}

TEST(Relaxation, EvensOutRandomPointsAndKeepsThemInside)
{
    const Aabb block{{0.0f, 0.0f, 0.0f}, {1.2f, 1.0f, 1.0f}};
    const BoxSolid box(block);
    const BallSolid ball({1.0f, 2.0f, 3.0f}, 0.5f);
    const MeshSolid torus(builtin_mesh("torus"));
    for (const Solid* solid :
         {static_cast<const Solid*>(&box), static_cast<const Solid*>(&ball), static_cast<const Solid*>(&torus)}) {
        std::vector<glm::vec3> points = random_points(*solid, 1000);
        const Relaxation done = relax_particles(points, *solid);
        EXPECT_LE(done.evenness.density_spread, relaxed_spread);
        EXPECT_GE(done.evenness.relative_radius, relaxed_radius);
        const Evenness measured = evenness_of(points, *solid);
        EXPECT_NEAR(measured.density_spread, done.evenness.density_spread, 1e-4);
        EXPECT_NEAR(measured.relative_radius, done.evenness.relative_radius, 1e-4);
        for (const glm::vec3& point : points) {
            ASSERT_TRUE(solid->contains(glm::dvec3(point)));
        }
    }
}

TEST(Relaxation, NobodyIsPushedOutOfACrowdedCorner)
{
    const BoxSolid corner({{0.0f, 0.0f, 0.0f}, {0.25f, 0.25f, 0.25f}});
    const BoxSolid box({{0.0f, 0.0f, 0.0f}, {1.0f, 1.0f, 1.0f}});
    std::vector<glm::vec3> points = random_points(corner, 300);
    relax_particles(points, box);
    for (const glm::vec3& point : points) {
        ASSERT_TRUE(box.contains(glm::dvec3(point)));
    }
}

TEST(Relaxation, TheDensityIsEvenBySumOverAllPairsAndTheWallsKeepTheirDistance)
{
    const Aabb block{{0.0f, 0.0f, 0.0f}, {1.0f, 1.0f, 1.0f}};
    const VolumeSamples samples = sample_volume(BoxSolid(block), {Lattice::BlueNoise, PointCount{4000}});
    EXPECT_LE(spread_inside(samples.positions, block, samples.spacing), relaxed_spread);
    for (const glm::vec3& p : samples.positions) {
        const glm::vec3 from_wall = glm::min(p, 1.0f - p);
        ASSERT_GT(double(std::min({from_wall.x, from_wall.y, from_wall.z})), 0.2 * samples.spacing);
    }
}

TEST(Relaxation, IsTheSameOnAnyNumberOfThreads)
{
    const BallSolid ball({0.0f, 0.0f, 0.0f}, 1.0f);
    const auto run = [&](std::size_t threads) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        std::vector<glm::vec3> points = random_points(ball, 800);
        relax_particles(points, ball);
        return points;
    };
    const std::vector<glm::vec3> one = run(1);
    for (const std::size_t threads : {2u, 7u}) {
        EXPECT_EQ(std::memcmp(run(threads).data(), one.data(), one.size() * sizeof(glm::vec3)), 0);
    }
}

} // namespace
} // namespace meltpoint
