// The front of a collapsing column against the experiment of J. C. Martin & W. J. Moyce, "An experimental study of the
// collapse of liquid columns on a rigid horizontal plane", Phil. Trans. R. Soc. A 244 (1952).
#include <array>
#include <functional>
#include <limits>

#include "support/fluid_box.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class DamBreak : public GpuTest {};

/// T = t sqrt(2 g/a) and Z = x/a, a the width of the column.
struct FrontPoint {
    double time;
    double position;
};

/// Columns twice as high as wide, 2.25 and 1.125 inches wide, up to Z = 5; digitized from the published diagrams.
constexpr std::array<FrontPoint, 11> measured = {{
    {0.832, 1.217},
    {1.219, 1.474},
    {1.997, 2.292},
    {2.547, 2.995},
    {3.345, 4.134},
    {4.034, 4.944},
    {0.849, 1.245},
    {1.602, 1.884},
    {2.283, 2.689},
    {2.950, 3.728},
    {3.598, 4.528},
}};

double position_at(const std::vector<FrontPoint>& front, double time)
{
    const auto after =
        std::find_if(front.begin() + 1, front.end() - 1, [&](const FrontPoint& point) { return point.time >= time; });
    const FrontPoint& a = *(after - 1);
    const FrontPoint& b = *after;
    return a.position + (b.position - a.position) * (time - a.time) / (b.time - a.time);
}

/// The largest error relative to Z if the experiment's clock was started `delay` before ours.
double largest_error(const std::vector<FrontPoint>& front, double delay)
{
    double error = 0.0;
    for (const FrontPoint& point : measured) {
        error = std::max(error, std::abs(position_at(front, point.time - delay) / point.position - 1.0));
    }
    return error;
}

TEST_F(DamBreak, FrontIsMartinAndMoyces)
{
    const std::uint32_t columns = 20;
    const double width = columns * static_cast<double>(test_spacing);
    const sim::SimulationSettings settings =
        box_settings(shared::KERNEL_WENDLAND, 3.0, {6 * columns, 2 * columns + 6, 6},
                     std::sqrt(2.0 * test_gravity * 2.0 * width), 0.001);
    const double unit = std::sqrt(width / (2.0 * test_gravity));
    sim::Simulation simulation(context(), fluid_in_corner({columns, 2 * columns, 6}), settings);
    const double energy = mechanical_energy(simulation.download(), settings);

    std::vector<FrontPoint> front{{0.0, 1.0}};
    while (front.back().time < 4.1) {
        simulation.advance(steps_for(0.1 * unit, settings));
        const ParticleSet set = simulation.download();
        // The farthest layer of particles, across the box.
        std::vector<float> x(set.size());
        std::transform(set.position.begin(), set.position.end(), x.begin(), [](const glm::vec3& p) { return p.x; });
        std::nth_element(x.begin(), x.begin() + 5, x.end(), std::greater<>());
        front.push_back({simulation.time() / unit, static_cast<double>(x[5] + 0.5f * test_spacing) / width});
        // Without it a front that is too slow could pass: the measured one, over a rough floor and out from behind a
        // gate, is slower than that of a fluid without friction.
        EXPECT_NEAR(mechanical_energy(set, settings), energy, 0.01 * energy) << "T = " << front.back().time;
        EXPECT_EQ(count_outside(set, settings), 0u);
    }
    // Neither clock started exactly when the column was free: T may be shifted by up to 0.2.
    double error = std::numeric_limits<double>::infinity();
    for (int i = -10; i <= 10; ++i) {
        error = std::min(error, largest_error(front, 0.02 * i));
    }
    EXPECT_LE(error, 0.1);
}

} // namespace
} // namespace meltpoint
