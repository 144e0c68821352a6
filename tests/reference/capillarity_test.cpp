#include "reference/capillarity.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "reference/density.h"
#include "reference/fluid_fixture.h"
#include "shared/capillarity.h"

namespace meltpoint::reference {
namespace {

constexpr double D = 0.02;
constexpr double SIGMA = 2.0;
constexpr double RADIUS = 12.0 * D;

class ReferenceCapillarity : public testing::Test {
protected:
    ReferenceCapillarity() { settings.params.tension[0] = static_cast<float>(SIGMA); }

    /// The part of a lattice that lies in `body`.
    template <class Body>
    void fill(const Body& body)
    {
        add_lattice(state, glm::dvec3(0.5 - 14.0 * D), glm::ivec3(28), D);
        State kept;
        for (std::size_t i = 0; i < state.size(); ++i) {
            if (body(state.position[i] - center)) {
                add_particle(kept, state.position[i], D);
            }
        }
        state = kept;
        find();
    }
    void find()
    {
        neighbors = find_neighbors(settings.params, state.position);
        update_density(settings, state, neighbors);
        state.acceleration.assign(state.size(), glm::dvec3(0.0));
    }
    /// Shells a spacing apart, each of points spread evenly in a spiral: a surface as smooth as particles can have.
    void fill_ball()
    {
        const double turn = std::numbers::pi * (3.0 - std::sqrt(5.0));
        for (double r = 0.5 * D; r < RADIUS; r += D) {
            const auto count = static_cast<int>(std::lround(4.0 * std::numbers::pi * (r * r + D * D / 12.0) / (D * D)));
            for (int k = 0; k < count; ++k) {
                const double y = 1.0 - (2.0 * k + 1.0) / count;
                const double across = std::sqrt(1.0 - y * y);
                const double angle = k * turn + r / D;
                add_particle(state, center + r * glm::dvec3(across * std::cos(angle), y, across * std::sin(angle)), D);
            }
        }
        find();
    }

    Settings settings = make_settings(shared::KERNEL_WENDLAND, D, 2.0);
    State state;
    Neighbors neighbors;
    glm::dvec3 center{0.5 + 0.5 * D};
};

TEST_F(ReferenceCapillarity, CurvatureOfABallsNormalsIsTwoOverItsRadius)
{
    fill_ball();
    std::vector<SurfaceNormal> surface(state.size());
    std::vector<glm::dvec3> normals(state.size());
    const double steepness =
        static_cast<double>(settings.params.first_layer_steepness / settings.params.support_radius);
    for (std::size_t i = 0; i < state.size(); ++i) {
        const glm::dvec3 x = state.position[i] - center;
        const bool outermost = glm::length(x) > RADIUS - D;
        surface[i] = {.gradient = -x / glm::length(x), .sigma = SIGMA};
        normals[i] = outermost ? steepness * surface[i].gradient : glm::dvec3(0.0);
    }
    int found = 0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        const glm::dvec3 x = state.position[i] - center;
        if (glm::length(x) < RADIUS - D) {
            continue;
        }
        const glm::dvec3 still = capillary_acceleration(settings, state, neighbors, surface, normals, i).value;
        const std::vector<glm::dvec3> flat(state.size(), normals[i]); // what the repulsion of crowded pairs alone does
        const glm::dvec3 crowding = capillary_acceleration(settings, state, neighbors, surface, flat, i).value;
        const double curvature = -glm::dot(still - crowding, x) / glm::length(x) * state.density[i] / (2.0 * SIGMA);
        EXPECT_NEAR(curvature * RADIUS / 2.0, 1.0, 0.01);
        ++found;
    }
    EXPECT_GT(found, 1000);
}

TEST_F(ReferenceCapillarity, BallIsPulledInward)
{
    fill_ball();
    add_capillarity(settings, state, neighbors);
    double pull = 0.0; // sum of F . x / |x|: pressure times area
    double turn = 0.0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        const glm::dvec3 x = state.position[i] - center;
        pull -= state.mass[i] * glm::dot(state.acceleration[i], x) / glm::length(x);
        turn += state.mass[i] * glm::length(state.acceleration[i]);
    }
    // These shells are rough: where they stand out they are more curved, and steeper, than between.
    const double exact = 2.0 * SIGMA / RADIUS * 4.0 * std::numbers::pi * RADIUS * RADIUS;
    EXPECT_GT(pull, 0.9 * exact);
    EXPECT_LT(pull, 1.2 * exact);
    EXPECT_LT(pull, turn);
}

TEST_F(ReferenceCapillarity, FlatSurfaceFeelsNothing)
{
    fill([](const glm::dvec3& x) { return x.y < 0.0; });
    add_capillarity(settings, state, neighbors);
    const double unit = SIGMA / (1000.0 * D * D);
    for (std::size_t i = 0; i < state.size(); ++i) {
        const glm::dvec3 x = state.position[i] - center;
        if (std::max(std::abs(x.x), std::abs(x.z)) < 5.0 * D && x.y > -7.0 * D) { // off the block's other faces
            EXPECT_LT(glm::length(state.acceleration[i]), 1e-9 * unit) << x.y;
        }
    }
}

TEST_F(ReferenceCapillarity, ConstantsOfALatticesLayersAreThoseOfAFlatSurface)
{
    fill([](const glm::dvec3& x) { return x.y < 0.0; });
    std::vector<glm::dvec3> normals;
    const std::vector<double> sigma(state.size(), SIGMA);
    for (std::size_t i = 0; i < state.size(); ++i) {
        normals.push_back(surface_normal(settings, state, neighbors, i).normal);
    }
    for (std::uint32_t smoothing = 0; smoothing < shared::NORMAL_SMOOTHINGS; ++smoothing) {
        const std::vector<glm::dvec3> before = normals;
        for (std::size_t i = 0; i < state.size(); ++i) {
            normals[i] = smooth_normal(settings, state, neighbors, before, sigma, i).value;
        }
    }
    int found = 0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        const glm::dvec3 x = state.position[i] - center;
        if (std::max(std::abs(x.x), std::abs(x.z)) < 3.0 * D && x.y > -2.0 * D) {
            const bool first = x.y > -D;
            const double expected = static_cast<double>(first ? settings.params.first_layer_steepness
                                                              : settings.params.second_layer_steepness);
            EXPECT_NEAR(-normals[i].y * static_cast<double>(settings.params.support_radius), expected, 1e-6);
            ++found;
        }
    }
    EXPECT_GT(found, 20);
}

TEST_F(ReferenceCapillarity, CrowdedPairsPartAndDragKeepsMomentum)
{
    fill_ball();
    Random random(3);
    for (std::size_t i = 0; i < state.size(); ++i) {
        state.velocity[i] = random_vector(random);
        state.position[i] += 0.3 * D * random_vector(random);
    }
    find();
    State still = state;
    std::ranges::fill(still.velocity, glm::dvec3(0.0));
    State moving = state;
    add_capillarity(settings, moving, neighbors);
    add_capillarity(settings, still, neighbors);
    glm::dvec3 momentum(0.0);
    double scale = 0.0;
    double power = 0.0;
    for (std::size_t i = 0; i < state.size(); ++i) {
        const glm::dvec3 drag = state.mass[i] * (moving.acceleration[i] - still.acceleration[i]);
        momentum += drag;
        scale += glm::length(drag);
        power += glm::dot(drag, state.velocity[i]);
    }
    EXPECT_GT(scale, 0.0);
    EXPECT_LT(glm::length(momentum), 1e-9 * scale);
    EXPECT_LT(power, 0.0);

    State pair;
    add_particle(pair, glm::dvec3(0.5), D);
    add_particle(pair, glm::dvec3(0.5, 0.5 + 0.4 * D, 0.5), D);
    state = pair;
    find();
    add_capillarity(settings, state, neighbors);
    EXPECT_GT(state.acceleration[1].y, 0.0);
    EXPECT_NEAR(state.acceleration[0].y, -state.acceleration[1].y, 1e-9 * state.acceleration[1].y);
}

TEST_F(ReferenceCapillarity, DoesNothingToFluidsWithoutTension)
{
    settings.params.tension[0] = 0.0f;
    fill_ball();
    add_capillarity(settings, state, neighbors);
    for (const glm::dvec3& a : state.acceleration) {
        EXPECT_EQ(a, glm::dvec3(0.0));
    }
}

} // namespace
} // namespace meltpoint::reference
