// A bed that is black on the left and white on the right: the flow wears the black half faster, as the law has it.
#include <cmath>
#include <fstream>

#include <fmt/format.h>

#include "run/start_scene.h"
#include "scene/scene_file.h"
#include "support/gpu_test.h"
#include "support/mesh_files.h"
#include "support/scratch_folder.h"
#include "support/two_colors.h"

namespace meltpoint {
namespace {

class ColoredBedTest : public GpuTest {};

TEST_F(ColoredBedTest, WearsByTheStrengthOfItsColors)
{
    const test::ScratchFolder folder;
    const std::string file = (folder / "bed.ply").string();
    std::ofstream(file) << test::ascii_ply_of(test::black_and_white_box({1.0f, 0.2f, 0.4f}));
    const double contrast = 1.3;
    const Scene scene = parse_scene(fmt::format(R"(
domain = {{ min = [-0.5, 0, -0.2], max = [0.5, 1, 0.2] }}
particles.spacing = 0.05
physics.gravity = [0, 0, 0]
time.dt = 1e-5
[[fluid]]
shape = "block"
min = [-0.5, 0.2, -0.2]
max = [0.5, 0.5, 0.2]
velocity = [0, 0, 1] # along the border between the colors
[[solid]]
shape = "mesh"
mesh = "{}"
position = [0, 0.1, 0]
anchor = "all"
erodes = true
erosion_threshold = 0
strength_from = "color"
strength_contrast = {}
)",
                                                file, contrast),
                                    "bed", ".", {});
    StartedScene started = start_scene(context(), scene);
    started.simulation->advance(64);
    const ParticleSet particles = started.simulation->download();
    const std::vector<double> damage = started.simulation->damage();
    double black = 0.0;
    double white = 0.0;
    for (std::size_t i = 0; i < particles.size(); ++i) {
        const float x = particles.position[i].x;
        if (shared::particle_state(particles.attributes[i]) == shared::STATE_SOLID && std::abs(x) > 0.15f) {
            (x < 0.0f ? black : white) += damage[i];
        }
    }
    EXPECT_GT(white, 0.0);
    // Without a threshold the rate is as the stress over the square of the strength, 1 / contrast and contrast.
    EXPECT_NEAR(black / white, std::pow(contrast, 4.0), 0.03 * std::pow(contrast, 4.0));
}

} // namespace
} // namespace meltpoint
