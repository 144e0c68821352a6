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

struct Frames {
    std::string first;
    std::string last;
};

// A ball falling into a pool, 13,700 particles (few enough would all be done by one thread), 270 steps: the particles
// in order of id, computed by so many threads of the software driver (other drivers ignore the number).
Frames render_drop(int threads)
{
    const test::ScratchFolder folder;
    const std::filesystem::path out = folder / "frames";
    const std::string command =
        fmt::format("LP_NUM_THREADS={} '{}' --quiet render drop --out '{}' --frames 4 --size 64x36 --particles ply",
                    threads, MELTPOINT_TEST_PROGRAM, out.string());
    EXPECT_EQ(std::system(command.c_str()), 0) << command;
    return {test::read_bytes(out / "particles_0000.ply"), test::read_bytes(out / "particles_0003.ply")};
}

TEST(RerunsOfTheProgram, GiveTheSameBitsForEveryNumberOfThreads)
{
    const Frames one_thread = render_drop(1);
    const Frames two_threads = render_drop(2);
    EXPECT_GT(one_thread.last.size(), 500'000u);
    EXPECT_FALSE(one_thread.first == one_thread.last);
    EXPECT_TRUE(one_thread.first == two_threads.first);
    EXPECT_TRUE(one_thread.last == two_threads.last);
}

} // namespace
} // namespace meltpoint
