// Feeds the readers of meshes and points: a file is read, or refused by an Error of kind Input. One program a format.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "core/error.h"
#include "io/mesh_import.h"
#include "io/point_cloud_import.h"

namespace {

template <class Parse>
void expect_input_errors_only(const Parse& parse)
{
    try {
        (void)parse();
    } catch (const meltpoint::Error& error) {
        if (error.kind() != meltpoint::ErrorKind::Input) {
            std::abort();
        }
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::span bytes(data, size);
    // MELTPOINT_FUZZ_FILE: a name with the format's ending, in a folder that does not exist.
#ifdef MELTPOINT_FUZZ_POINTS
    expect_input_errors_only([&] { return meltpoint::parse_point_cloud(bytes, MELTPOINT_FUZZ_FILE); });
#else
    expect_input_errors_only([&] { return meltpoint::parse_mesh(bytes, MELTPOINT_FUZZ_FILE); });
#endif
    return 0;
}
