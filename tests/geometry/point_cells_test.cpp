#include "geometry/point_cells.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/random.h"

namespace meltpoint {
namespace {

TEST(PointCells, VisitsAllThatAreNearerThanTheEdgeOnce)
{
    std::vector<glm::vec3> points;
    Random random(3);
    for (int i = 0; i < 2000; ++i) {
        const float x = float(random.uniform());
        const float y = float(random.uniform());
        points.emplace_back(1000.0f + x, 0.3f * y, i % 2 == 0 ? 0.0f : float(random.uniform()));
    }
    points.push_back(points.front()); // in the same place
    for (const double edge : {0.05, 0.3, 5.0}) {
        const PointCells cells(points, edge);
        ASSERT_EQ(cells.order().size(), points.size());
        for (std::size_t place = 0; place < points.size(); place += 7) {
            const glm::vec3 point = points[cells.order()[place]];
            std::vector<std::uint32_t> expected;
            for (std::uint32_t j = 0; j < points.size(); ++j) {
                if (double(glm::distance(points[j], point)) < edge) {
                    expected.push_back(j);
                }
            }
            for (const bool by_place : {true, false}) {
                std::vector<std::uint32_t> found;
                const auto visit = [&](std::uint32_t other) {
                    const std::uint32_t j = cells.order()[other];
                    if (double(glm::distance(points[j], point)) < edge) {
                        found.push_back(j);
                    }
                };
                by_place ? cells.visit_near(place, visit) : cells.visit_near(glm::dvec3(point), visit);
                std::sort(found.begin(), found.end());
                ASSERT_EQ(found, expected);
            }
        }
        int far = 0;
        cells.visit_near(glm::dvec3(-1e9, 2.0, 1e9), [&](std::uint32_t) { ++far; });
        EXPECT_EQ(far, 0);
    }
    EXPECT_TRUE(PointCells({}, 1.0).order().empty());
}

} // namespace
} // namespace meltpoint
