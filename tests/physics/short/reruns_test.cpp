// The same bits again: in one program, and in two programs of different numbers of threads.
#include <cstdlib>

#include <fmt/format.h>

#include "support/fluid_box.h"
#include "support/gpu_test.h"
#include "support/scratch_folder.h"

namespace meltpoint {
namespace {

class Reruns : public GpuTest {};

TEST_F(Reruns, InOneProgramGiveTheSameBits)
{
    const auto run = [] {
        sim::Simulation simulation(context(), splash_state(9), test_settings(shared::KERNEL_WENDLAND));
        simulation.advance(300);
        return simulation.download();
    };
    const ParticleSet first = run();
    const ParticleSet second = run();
    EXPECT_EQ(first.id, second.id);
    EXPECT_EQ(first.position, second.position);
    EXPECT_EQ(first.velocity, second.velocity);
    EXPECT_EQ(first.density, second.density);
    EXPECT_EQ(first.pressure, second.pressure);
}

// A ball falling into a pool, 3,300 particles, 300 steps: the particles of the last frame in order of id, computed by
// so many threads of the software driver (other drivers ignore the number).
std::string render_drop(int threads, const std::string& viscosity)
{
    const test::ScratchFolder folder;
    const std::string command =
        fmt::format("LP_NUM_THREADS={} '{}' --quiet render drop --out '{}' --frames 6 --size 64x36 --particles ply "
                    "--set particles.spacing=0.04 --set physics.viscosity={}",
                    threads, MELTPOINT_TEST_PROGRAM, (folder / "frames").string(), viscosity);
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return test::read_bytes(folder.path() / "frames" / "particles_0005.ply");
}

TEST(RerunsOfTheProgram, GiveTheSameBitsForEveryNumberOfThreads)
{
    const std::string one_thread = render_drop(1, "0.2");
    EXPECT_GT(one_thread.size(), 100'000u);
    EXPECT_TRUE(one_thread == render_drop(2, "0.2"));
    EXPECT_FALSE(one_thread == render_drop(2, "0.2001")); // the file does tell runs apart
}

} // namespace
} // namespace meltpoint
