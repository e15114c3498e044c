// tests/art/gif_writer_test.cpp: animated GIF, decoded again by OpenImageIO.
#include "art/image/gif_writer.h"
#include "tests/files.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
#include <vector>

namespace sikku::gif_writer_test {

using Picture = std::vector<std::uint8_t>;

/// The pictures of an animation as they are shown one after the other.
std::vector<Picture> decoded(const std::string& bytes, int width, int height) {
    const ScratchFolder folder;
    const std::string file = folder.write("decoded.gif", bytes);
    const auto input = OIIO::ImageInput::open(file);
    std::vector<Picture> pictures;
    for (int i = 0; input && input->seek_subimage(i, 0); ++i) {
        const OIIO::ImageSpec spec = input->spec();
        EXPECT_EQ(spec.width, width);
        EXPECT_EQ(spec.height, height);
        Picture all(std::size_t(width) * std::size_t(height) * std::size_t(spec.nchannels));
        EXPECT_TRUE(input->read_image(i, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, all.data()));
        Picture picture;
        for (std::size_t at = 0; at < all.size(); at += std::size_t(spec.nchannels)) {
            for (std::size_t channel = 0; channel < 3; ++channel) picture.push_back(all[at + channel]);
        }
        pictures.push_back(std::move(picture));
    }
    return pictures;
}

std::string written(const std::vector<Picture>& pictures, int width, int height) {
    MemoryOutput output;
    GifWriter writer(output, width, height);
    for (const Picture& picture : pictures) writer.frame(picture, 0.1);
    writer.close();
    return output.bytes();
}

std::vector<Picture> random_pictures(unsigned seed, int width, int height, int colours, int count) {
    std::mt19937 random(seed);
    const auto below = [&](int most) { return static_cast<int>(random() % static_cast<unsigned>(most)); };
    std::vector<std::array<std::uint8_t, 3>> palette(static_cast<std::size_t>(colours));
    for (auto& colour : palette) {
        for (auto& channel : colour) channel = static_cast<std::uint8_t>(random());
    }
    std::vector<Picture> pictures(1, Picture(std::size_t(width) * std::size_t(height) * 3));
    while (static_cast<int>(pictures.size()) <= count) {
        Picture next = pictures.back();
        const int left = below(width), right = left + 1 + below(width - left);
        const int top = below(height), bottom = top + 1 + below(height - top);
        for (int y = top; y < bottom; ++y) {
            for (int x = left; x < right; ++x) {
                if (below(3) == 0) continue;
                const auto& colour = palette[static_cast<std::size_t>(below(colours))];
                std::copy(colour.begin(), colour.end(),
                          next.begin() + 3 * (static_cast<std::ptrdiff_t>(y) * width + x));
            }
        }
        pictures.push_back(next);
    }
    return pictures;
}

TEST(GifWriter, PicturesOfFewColoursAreExact) {
    for (const int colours : {1, 2, 3, 4, 17, 255}) {
        for (const auto& [width, height] :
             {std::pair(1, 1), std::pair(7, 5), std::pair(80, 61), std::pair(300, 200)}) {
            const auto pictures = random_pictures(static_cast<unsigned>(colours + width), width, height, colours, 6);
            const auto shown = decoded(written(pictures, width, height), width, height);
            ASSERT_EQ(shown.size(), pictures.size());
            for (std::size_t i = 0; i < shown.size(); ++i) {
                EXPECT_EQ(shown[i], pictures[i]) << colours << ' ' << width << ' ' << i;
            }
        }
    }
}

TEST(GifWriter, ManyColoursAreReducedButTheirMeansRemain) {
    constexpr int side = 96;
    std::vector<Picture> pictures;
    for (int shift : {0, 40}) {
        Picture picture;
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                picture.push_back(static_cast<std::uint8_t>(2 * x + shift / 2));
                picture.push_back(static_cast<std::uint8_t>(2 * y));
                picture.push_back(static_cast<std::uint8_t>(x + y + shift / 4));
            }
        }
        pictures.push_back(std::move(picture));
    }
    const auto shown = decoded(written(pictures, side, side), side, side);
    ASSERT_EQ(shown.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
        double sum = 0, blocks = 0;
        for (std::size_t at = 0; at < shown[i].size(); ++at) sum += std::abs(shown[i][at] - pictures[i][at]);
        EXPECT_LT(sum / static_cast<double>(shown[i].size()), 6);
        // Errors are diffused: the means of squares of 8 x 8 pixels are right.
        for (int y = 0; y < side; y += 8) {
            for (int x = 0; x < side; x += 8) {
                int difference = 0;
                for (int v = y; v < y + 8; ++v) {
                    for (int u = x; u < x + 8; ++u) {
                        const auto at = static_cast<std::size_t>(3 * (v * side + u));
                        difference += shown[i][at] - pictures[i][at];
                    }
                }
                blocks = std::max(blocks, std::abs(difference) / 64.0);
            }
        }
        EXPECT_LT(blocks, 3);
    }
}

TEST(GifWriter, OnlyWhatChangesIsWritten) {
    constexpr int side = 400;
    auto pictures = random_pictures(1, side, side, 200, 1);
    Picture next = pictures.back();
    for (std::size_t at = 3 * 90'000; at < 3 * 90'020; ++at) next[at] = static_cast<std::uint8_t>(next[at] ^ 0x55);
    const std::size_t before = written(pictures, side, side).size();
    pictures.push_back(next);
    pictures.push_back(next);
    const std::string bytes = written(pictures, side, side);
    EXPECT_LT(bytes.size(), before + 300);
    const auto shown = decoded(bytes, side, side);
    ASSERT_EQ(shown.size(), pictures.size()) << "a picture that does not change is shown, too";
    EXPECT_EQ(shown.back(), next);
}

TEST(GifWriter, PicturesThatAreTooLargeAreRefused) {
    MemoryOutput output;
    EXPECT_THROW(GifWriter(output, 65'536, 1), std::runtime_error);
    EXPECT_THROW(GifWriter(output, 20'000, 20'000), std::runtime_error);
}

}  // namespace sikku::gif_writer_test
