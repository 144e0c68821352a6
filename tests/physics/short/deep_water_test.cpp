// Water at rest stays at rest, however deep it is in particles: long steps would let its lattice buckle under the pressure.
#include "run/start_scene.h"
#include "scene/scene_file.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class DeepWaterTest : public GpuTest {};

TEST_F(DeepWaterTest, StaysCalmInDfsph)
{
    const Scene scene = parse_scene(R"(
solver = "dfsph"
domain = { min = [0, 0, 0], max = [0.16, 1.2, 0.16] }
particles = { spacing = 0.02, support_ratio = 2 }
[[fluid]]
shape = "block"
min = [0, 0, 0]
max = [0.16, 0.8, 0.16]
viscosity = 1
)",
                                    "deep", ".", {});
    StartedScene started = start_scene(context(), scene);
    sim::Simulation& simulation = *started.simulation;
    simulation.advance_by(0.1);
    while (simulation.time() < 0.5) {
        simulation.advance_by(0.02);
        for (const glm::vec3& v : simulation.download().velocity) {
            ASSERT_LT(glm::length(v), 0.03f) << simulation.time();
        }
    }
}

} // namespace
} // namespace meltpoint
