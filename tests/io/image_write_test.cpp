#include "io/image_write.h"

#include <gtest/gtest.h>
#include <png.h>

#include "core/error.h"
#include "core/random.h"
#include "support/scratch_folder.h"

namespace meltpoint {
namespace {

Image read_png(const std::filesystem::path& path)
{
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    EXPECT_NE(png_image_begin_read_from_file(&png, path.c_str()), 0) << png.message;
    png.format = PNG_FORMAT_RGBA;
    Image image{png.width, png.height, std::vector<std::uint8_t>(PNG_IMAGE_SIZE(png))};
    EXPECT_NE(png_image_finish_read(&png, nullptr, image.rgba.data(), 0, nullptr), 0) << png.message;
    return image;
}

Image random_image(std::uint32_t width, std::uint32_t height)
{
    Random random(1);
    Image image{width, height, {}};
    for (std::size_t i = 0; i < std::size_t{4} * width * height; ++i) {
        image.rgba.push_back(static_cast<std::uint8_t>(random.below(256)));
    }
    return image;
}

TEST(WritePng, KeepsEveryByte)
{
    const test::ScratchFolder folder;
    // Noise does not compress: the largest file that an image of its size can make.
    for (const auto& [width, height] : {std::pair{1u, 1u}, {1u, 100u}, {333u, 1u}, {123u, 45u}, {640u, 480u}}) {
        const Image image = random_image(width, height);
        write_png(folder / "a.png", image);
        const Image read = read_png(folder / "a.png");
        EXPECT_EQ(read.width, width);
        EXPECT_EQ(read.height, height);
        EXPECT_EQ(read.rgba, image.rgba);
    }
    EXPECT_EQ(folder.file_count(), 1u);
}

TEST(WritePng, CompressesFlatPictures)
{
    const test::ScratchFolder folder;
    write_png(folder / "a.png", Image{960, 540, std::vector<std::uint8_t>(std::size_t{4} * 960 * 540, 200)});
    EXPECT_LT(std::filesystem::file_size(folder / "a.png"), 40000u);
}

TEST(WritePng, RefusesWhatIsNoImage)
{
    const test::ScratchFolder folder;
    EXPECT_THROW(write_png(folder / "a.png", Image{}), Error);
    EXPECT_THROW(write_png(folder / "a.png", Image{2, 2, std::vector<std::uint8_t>(15)}), Error);
    EXPECT_THROW(write_png(folder / "a.png", Image{1u << 31, 1u << 31, {}}), Error);
    EXPECT_THROW(write_png(folder / "none/a.png", random_image(1, 1)), Error);
    EXPECT_EQ(folder.file_count(), 0u);
}

} // namespace
} // namespace meltpoint
