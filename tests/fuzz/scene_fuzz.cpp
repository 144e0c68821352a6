// Feeds the scene reader: the text before the first zero byte is a scene file, what follows an override of --set. A
// scene that is read is written out again, and must come back.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "scene/scene_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view all(reinterpret_cast<const char*>(data), size);
    const std::string_view text = all.substr(0, all.find('\0'));
    std::vector<std::string> overrides;
    if (text.size() < all.size()) {
        overrides.emplace_back(all.substr(text.size() + 1));
    }
    std::string written;
    try {
        written = meltpoint::write_scene(meltpoint::parse_scene(text, "scene.toml", "/nowhere", overrides));
    } catch (const meltpoint::Error& error) {
        if (error.kind() != meltpoint::ErrorKind::Input) {
            std::abort();
        }
        return 0;
    }
    if (meltpoint::write_scene(meltpoint::parse_scene(written, "written.toml", "/nowhere")) != written) {
        std::abort();
    }
    return 0;
}
