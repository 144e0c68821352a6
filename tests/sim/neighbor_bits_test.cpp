// Which candidates are neighbors is found once a step: that those and no others are found, and that what happens where
// there are no words left for them is the same.
#include <bit>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "conformance/device.h"
#include "shared/neighbor_count.h"
#include "support/fluid_states.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class NeighborBits : public GpuTest {
protected:
    static sim::SimulationSettings settings(std::uint32_t tile)
    {
        sim::SimulationSettings settings = test_settings(shared::KERNEL_WENDLAND);
        settings.options.tile = tile;
        return settings;
    }

    struct Found {
        ParticleSet particles; ///< with density, pressure and acceleration
        std::vector<std::uint32_t> words;
        std::uint64_t neighbors = 0; ///< of all particles together, themselves included
    };
    /// Of a state after the density and the force pass; `words` of memory for the bits.
    static Found find(const ParticleSet& set, const sim::SimulationSettings& settings, std::size_t words)
    {
        conformance::Device device(context(), set, settings);
        device.grid.neighbor_bits = gpu::make_buffer<std::uint32_t>(context(), words, "neighbor bits");
        const auto count = static_cast<std::uint32_t>(set.size());
        const gpu::Buffer counts = gpu::make_buffer<shared::NeighborCount>(context(), count, "neighbor counts");
        device.run([&] {
            device.commands.fill(device.grid.neighbor_bits, 0);
            sim::record_sort(device.commands, device.kernels, device.params_buffer, device.particles, device.grid);
            sim::record_boundary_weight(device.commands, device.kernels, device.params_buffer, device.particles,
                                        device.grid);
            sim::record_density(device.commands, device.kernels, device.params_buffer, device.particles, device.grid);
            sim::record_forces(device.commands, device.kernels, device.params_buffer, device.particles, device.grid);
            sim::record_count_neighbors(device.commands, device.kernels, device.params_buffer, device.particles,
                                        device.grid, counts);
        });
        Found found{.particles = download_unordered(context(), device.particles),
                    .words = gpu::download<std::uint32_t>(context(), device.grid.neighbor_bits, words),
                    .neighbors = count};
        for (const shared::NeighborCount& its : gpu::download<shared::NeighborCount>(context(), counts, count)) {
            found.neighbors += its.neighbors;
        }
        return found;
    }

    static std::uint64_t set_bits(std::span<const std::uint32_t> words)
    {
        return std::transform_reduce(words.begin(), words.end(), std::uint64_t{0}, std::plus{}, [](std::uint32_t word) {
            return static_cast<std::uint64_t>(std::popcount(word));
        });
    }
};

TEST_F(NeighborBits, AreThoseOfTheNeighborsAndNoOthers)
{
    sim::SimulationSettings open = settings(1);
    open.params.wall_mask = 0; // no images: a bit is a pair
    // Up to 400 candidates a row: chunks of every length.
    for (const int count : {1, 33, 700, 4000}) {
        const ParticleSet set = random_state(count, glm::vec3(0.3f), glm::vec3(0.7f), 11);
        const Found found = find(set, open, set.size() * 200);
        EXPECT_GE(set_bits(found.words), found.neighbors) << count << " particles";
        // Few lie so near to the support that rounding must not decide.
        EXPECT_LE(set_bits(found.words), found.neighbors + found.neighbors / 100'000) << count << " particles";
    }
}

TEST_F(NeighborBits, NothingDependsOnHowManyThereIsRoomFor)
{
    for (const std::uint32_t tile : {1u, 4u, 16u}) {
        for (const bool crowded : {false, true}) {
            SCOPED_TRACE(testing::Message() << "tile " << tile << (crowded ? ", crowded" : ""));
            ParticleSet set = random_state(3001, glm::vec3(0.0f), glm::vec3(crowded ? 0.3f : 1.0f), 7);
            add_plate(set, 1.0f, 0.2f, test_spacing, 0.1f, 3);
            const Found all = find(set, settings(tile), set.size() * 200);
            EXPECT_GT(set_bits(all.words), set.size());
            for (const std::size_t words :
                 {std::size_t{1}, set.size(), set.size() * sim::NeighborGrid::neighbor_words}) {
                const Found some = find(set, settings(tile), words);
                EXPECT_TRUE(some.particles.density == all.particles.density);
                EXPECT_TRUE(some.particles.pressure == all.particles.pressure);
                EXPECT_TRUE(some.particles.acceleration == all.particles.acceleration);
            }
        }
    }
}

} // namespace
} // namespace meltpoint
