#include "io/image_write.h"

#include <cstddef>
#include <span>
#include <vector>

#include <png.h>

#include "core/error.h"
#include "io/atomic_file.h"

namespace meltpoint {

void write_png(const std::filesystem::path& path, const Image& image)
{
    constexpr std::uint32_t LONGEST_SIDE = 32768;
    const std::size_t expected_bytes = std::size_t{4} * image.width * image.height;
    if (expected_bytes == 0 || image.width > LONGEST_SIDE || image.height > LONGEST_SIDE ||
        image.rgba.size() != expected_bytes) {
        throw runtime_error("cannot write {}: an image of {} x {} pixels with {} bytes is no image", path.string(),
                            image.width, image.height, image.rgba.size());
    }

    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = image.width;
    png.height = image.height;
    png.format = PNG_FORMAT_RGBA;
    png.flags = PNG_IMAGE_FLAG_FAST;
    std::vector<std::byte> encoded(PNG_IMAGE_PNG_SIZE_MAX(png));
    png_alloc_size_t size = encoded.size();
    if (png_image_write_to_memory(&png, encoded.data(), &size, 0, image.rgba.data(), 0, nullptr) == 0) {
        throw runtime_error("cannot write {}: {}", path.string(), std::string_view(png.message));
    }
    write_file_atomically(path, std::span(encoded).first(size));
}

} // namespace meltpoint
