// Buffers that shaders read as texels.
#include "gpu/commands.h"
#include "sim/wcsph.h"
#include "support/fluid_states.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

class TexelsTest : public GpuTest {};

TEST_F(TexelsTest, OnlyBuffersMadeWithAFormatHaveTexels)
{
    EXPECT_NE(gpu::make_texel_buffer(context(), 10, "texels").texels(), VK_NULL_HANDLE);
    EXPECT_EQ(gpu::make_buffer<glm::vec4>(context(), 10, "words").texels(), VK_NULL_HANDLE);
}

TEST_F(TexelsTest, ABufferTakesItsTexelsAlongWhenItMoves)
{
    gpu::Buffer buffer = gpu::make_texel_buffer(context(), 10, "texels");
    const VkBufferView texels = buffer.texels();
    const gpu::Buffer moved = std::move(buffer);
    EXPECT_EQ(moved.texels(), texels);
    EXPECT_EQ(buffer.texels(), VK_NULL_HANDLE); // NOLINT(bugprone-use-after-move): moved-from buffers are empty
}

TEST_F(TexelsTest, ABufferWithoutAFormatIsRefusedWhereAShaderReadsTexels)
{
    const ParticleSet set = lattice_state({3, 3, 3}, glm::vec3(0.4f));
    const sim::SimulationSettings settings = test_settings(shared::KERNEL_WENDLAND);
    const auto count = static_cast<std::uint32_t>(set.size());
    const shared::SphParams params = sim::complete_params(settings.params, count);
    const sim::FluidKernels kernels(context(), settings.options);
    const sim::NeighborGrid grid(context(), count, params.grid_size, false);
    const gpu::Buffer params_buffer = gpu::make_buffer<shared::SphParams>(context(), 1, "params");
    ParticleBuffers particles = make_particle_buffers(context(), count);
    particles.position = gpu::make_buffer<glm::vec4>(context(), count, "words");
    gpu::Commands commands(context());
    commands.begin();
    EXPECT_THROW(sim::record_density(commands, kernels, params_buffer, particles, grid), std::logic_error);
}

} // namespace
} // namespace meltpoint
