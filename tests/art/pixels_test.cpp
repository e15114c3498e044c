#include "art/prints.h"
#include "tests/print_tools.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <fstream>

namespace sikku::pixels_test {

/// The pixels of the same print as a PNG file, with an alpha channel added where there is none.
std::vector<std::uint8_t> pixels_of_png(const Document& document, const OptionValues& values) {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / "pixels_test.png";
    std::ofstream(file, std::ios::binary) << draw(document, "png", values);
    // Not associated with alpha, as the file is.
    OIIO::ImageSpec config;
    config["oiio:UnassociatedAlpha"] = 1;
    const auto input = OIIO::ImageInput::open(file.string(), &config);
    const OIIO::ImageSpec& spec = input->spec();
    const auto channels = static_cast<std::size_t>(spec.nchannels);
    std::vector<std::uint8_t> raw(channels * static_cast<std::size_t>(spec.width) *
                                  static_cast<std::size_t>(spec.height));
    EXPECT_TRUE(input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, raw.data()));
    std::vector<std::uint8_t> bytes;
    for (std::size_t i = 0; i < raw.size(); i += channels) {
        for (std::size_t channel = 0; channel < 3; ++channel) bytes.push_back(raw[i + (channels < 3 ? 0 : channel)]);
        bytes.push_back(channels == 4 ? raw[i + 3] : 255);
    }
    return bytes;
}

TEST(PixelsInMemory, AreThoseOfAFile) {
    const OptionValues small = {{"size", "60x40mm"}, {"margin", "2mm"}, {"dpi", "90"}};
    for (const char* name : {"snake-kolam", "hilbert", "hexagonal-tiling", "bush-3d", "plant-d"}) {
        for (const char* ground : {"none", "white", "#123456"}) {
            OptionValues values = small;
            values.push_back({"ground", ground});
            const Document document = load(name);
            const DrawnPixels pixels = draw_pixels(document, values);
            EXPECT_EQ(pixels.width, 213);
            EXPECT_EQ(pixels.height, 142);
            EXPECT_EQ(pixels.bytes, pixels_of_png(document, values)) << name << " on " << ground;
        }
    }
}

TEST(PixelsInMemory, ShowWindowsOfAnyDepth) {
    const Document document = load("hilbert", {"", {{"test", "derivation length", "60"}}});
    const DrawnPixels pixels = draw_pixels(
        document,
        {{"size", "40x58mm"}, {"margin", "0mm"}, {"dpi", "100"}, {"window", "-40,0,0,58"}, {"ground", "white"}});
    const auto inked =
        std::count_if(pixels.bytes.begin(), pixels.bytes.end(), [](std::uint8_t byte) { return byte < 250; });
    EXPECT_GT(inked, 1000);
}

TEST(PixelsInMemory, RefuseSeveralPictures) {
    EXPECT_THROW(draw_pixels(load("hilbert"), {{"generations", "1:3"}}), SettingError);
    EXPECT_THROW(draw_pixels(load("hilbert"), {{"tile", "A5"}}), SettingError);
    EXPECT_THROW(draw_pixels(load("hilbert"), {{"size", "0x0mm"}}), SettingError);
}

TEST(PixelsInMemory, StopOnRequest) {
    const Monitor stopped([](void*) { return true; });
    EXPECT_THROW(draw_pixels(load("hilbert"), {}, stopped), Stopped);
}

}  // namespace sikku::pixels_test
