// The barriers that Commands places between accesses: without any of them synchronization validation speaks up, and
// that fails the test. The scan stands for any dispatch.
#include "gpu/commands.h"

#include "gpu/buffer.h"
#include "primitives/prefix_scan.h"
#include "support/gpu_test.h"

namespace meltpoint {
namespace {

constexpr std::uint32_t count = 1000;

class BarrierTest : public GpuTest {
protected:
    [[nodiscard]] static gpu::Buffer words(const char* name)
    {
        return gpu::make_buffer<std::uint32_t>(context(), count + 1, name);
    }

    template <class Record>
    void run(const Record& record)
    {
        commands_.begin();
        record(commands_);
        commands_.submit();
        commands_.wait();
    }

    void scan(gpu::Commands& commands) const { scan_.record(commands, counts_, starts_, count, scratch_); }

    primitives::PrefixScan scan_{context()};
    gpu::Buffer counts_ = words("counts");
    gpu::Buffer starts_ = words("starts");
    gpu::Buffer scratch_ = words("scratch");
    gpu::Buffer copy_ = words("copy");
    gpu::Commands commands_{context()};
};

TEST_F(BarrierTest, ACopyReadsAndAFillWritesWhatNobodyHasWrittenYet)
{
    run([&](gpu::Commands& commands) {
        commands.copy(counts_, copy_, counts_.size());
        commands.fill(counts_, 1);
    });
}

TEST_F(BarrierTest, ADispatchReadsAndAFillWrites)
{
    run([&](gpu::Commands& commands) {
        scan(commands);
        commands.fill(counts_, 1);
    });
}

TEST_F(BarrierTest, ADispatchAndACopyBothReadWhatAFillWrote)
{
    run([&](gpu::Commands& commands) {
        commands.fill(counts_, 1);
        scan(commands);
        commands.copy(counts_, copy_, counts_.size());
    });
}

TEST_F(BarrierTest, ACopyAndADispatchBothReadWhatAFillWrote)
{
    run([&](gpu::Commands& commands) {
        commands.fill(counts_, 1);
        commands.copy(counts_, copy_, counts_.size());
        scan(commands);
    });
}

TEST_F(BarrierTest, TwoFillsWriteOneAfterTheOther)
{
    run([&](gpu::Commands& commands) {
        commands.fill(counts_, 1);
        commands.fill(counts_, 2);
    });
}

TEST_F(BarrierTest, AFillWritesAfterADispatchHasWrittenAndACopyHasRead)
{
    run([&](gpu::Commands& commands) {
        scan(commands);
        commands.copy(starts_, copy_, starts_.size());
        commands.fill(starts_, 0);
        commands.fill(copy_, 0);
    });
}

} // namespace
} // namespace meltpoint
