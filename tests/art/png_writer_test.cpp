// tests/art/png_writer_test.cpp: PNG of our own writer, decompressed by zlib and checked by pngcheck.
#include "art/image/png_writer.h"

#include "engine/base/threads.h"
#include "tests/checks.h"
#include "tests/print_tools.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <random>
#include <stdexcept>

namespace sikku::png_writer_test {

using Bytes = std::vector<std::uint8_t>;

/// Rows of runs and noise, which compress neither to nothing nor not at all.
Bytes drawing(std::size_t size) {
    std::mt19937 random(3);
    Bytes bytes;
    while (bytes.size() < size) {
        const auto value = static_cast<std::uint8_t>(random());
        bytes.insert(bytes.end(), random() % 50 + 1, value);
    }
    bytes.resize(size);
    return bytes;
}

ImageSpec spec_of(int width, int height, int channels, int level) {
    ImageSpec spec;
    spec.format = "png";
    spec.width = width;
    spec.height = height;
    spec.channels = channels;
    spec.compression = level;
    return spec;
}

/// @param rows  rows that are passed at a time
std::string write(const ImageSpec& spec, const Bytes& pixels, int threads, int rows) {
    const ScratchFolder folder;
    on_threads(threads, [&] {
        const auto writer = open_png(folder / "x.png", spec);
        const std::size_t stride = static_cast<std::size_t>(spec.width) * spec.channels;
        for (int first = 0; first < spec.height; first += rows) {
            const int count = std::min(rows, spec.height - first);
            writer->rows(first, count, std::span(pixels).subspan(first * stride, count * stride));
        }
        writer->close();
    });
    return contents(folder / "x.png");
}

std::uint32_t number(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8U | static_cast<unsigned char>(bytes.at(at + i));
    return value;
}

/// The pixels of a PNG whose rows have no filter. zlib checks the header and the checksum of the stream.
Bytes decoded(const std::string& png, const ImageSpec& spec) {
    std::string packed;
    for (std::size_t at = 8; at < png.size(); at += 12 + number(png, at)) {
        const std::size_t size = number(png, at);
        const std::string body = png.substr(at + 4, size + 4);
        EXPECT_EQ(crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size())),
                  number(png, at + 8 + size));
        if (body.starts_with("IDAT")) packed += body.substr(4);
    }
    const std::size_t stride = static_cast<std::size_t>(spec.width) * spec.channels;
    std::string rows((stride + 1) * static_cast<std::size_t>(spec.height) + 1, 'x');
    uLongf size = rows.size();
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(rows.data()), &size, reinterpret_cast<const Bytef*>(packed.data()),
                         packed.size()),
              Z_OK);
    EXPECT_EQ(size, rows.size() - 1);
    Bytes pixels;
    for (std::size_t row = 0; row + 1 < rows.size(); row += stride + 1) {
        EXPECT_EQ(rows[row], '\0');
        pixels.insert(pixels.end(), rows.begin() + static_cast<std::ptrdiff_t>(row) + 1,
                      rows.begin() + static_cast<std::ptrdiff_t>(row + 1 + stride));
    }
    return pixels;
}

TEST(PngWriter, BlocksAreOneStreamForAnyNumberOfThreads) {
    struct Case {
        int width, height, channels, level;
    };
    // One row and one block; many blocks; rows that are longer than a block.
    for (const Case& each : {Case{1, 1, 1, 6}, Case{1, 1, 4, 1}, Case{1, 5000, 3, 6}, Case{5000, 1, 3, 6},
                             Case{300, 1, 4, 9}, Case{700, 2500, 3, 6}, Case{1024, 1023, 1, 1},
                             Case{1024, 1024, 1, 2}, Case{1024, 1024, 1, 3}, Case{400'000, 3, 3, 1}}) {
        const ImageSpec spec = spec_of(each.width, each.height, each.channels, each.level);
        const Bytes pixels = drawing(static_cast<std::size_t>(each.width) * each.height * each.channels);
        const std::string png = write(spec, pixels, 1, each.height);
        EXPECT_TRUE(decoded(png, spec) == pixels) << each.width << 'x' << each.height;
        EXPECT_TRUE(write(spec, pixels, 8, 32) == png);
        EXPECT_TRUE(write(spec, pixels, 3, 1) == png);
    }
}

TEST(PngWriter, OthersReadIt) {
    NEEDS("pngcheck");
    const ScratchFolder folder;
    for (const int channels : {1, 3, 4}) {
        for (const bool icc : {false, true}) {
            ImageSpec spec = spec_of(600, 1200, channels, 6);
            spec.icc = icc;
            spec.dpi = 254;
            spec.title = "கோலம்";
            spec.description = "axiom: F\n";
            const auto file = folder.write("x.png", write(spec, drawing(std::size_t{600} * 1200 * channels), 2, 64));
            const ToolOutcome outcome = run_tool("pngcheck -v '" + file + "'");
            EXPECT_TRUE(outcome.ok) << outcome.text;
            EXPECT_TRUE(has(outcome.text, icc ? "chunk iCCP" : "chunk sRGB"));
            EXPECT_TRUE(has(outcome.text, "10000x10000 pixels/meter"));
        }
    }
}

/// libpng, by netpbm.
TEST(PngWriter, OthersReadTheSamePixels) {
    NEEDS("pngtopnm");
    const ScratchFolder folder;
    for (const int level : {1, 6, 9}) {
        const ImageSpec spec = spec_of(611, 1200, 3, level);
        const Bytes pixels = drawing(std::size_t{611} * 1200 * 3);
        const auto file = folder.write("x.png", write(spec, pixels, 8, 64));
        ASSERT_TRUE(run_tool("pngtopnm '" + file + "' > '" + folder.file("x.ppm") + "'").ok);
        const std::string read = contents(folder / "x.ppm");
        const std::string header = "P6\n611 1200\n255\n";
        ASSERT_EQ(read.substr(0, header.size()), header);
        EXPECT_TRUE(read.substr(header.size()) == std::string(pixels.begin(), pixels.end())) << level;
    }
}

TEST(PngWriter, AFullDiskIsReported) {
    for (const int height : {1, 3000}) {
        const ImageSpec spec = spec_of(1000, height, 3, 1);
        std::mt19937 random(5);
        Bytes pixels(std::size_t{3000} * static_cast<std::size_t>(height));
        for (auto& byte : pixels) byte = static_cast<std::uint8_t>(random());
        const auto writer = open_png("/dev/full", spec);
        EXPECT_TRUE(has(error_of<std::runtime_error>([&] {
                            writer->rows(0, height, pixels);
                            writer->close();
                        }),
                        "No space left"));
    }
}

TEST(PngWriter, Errors) {
    ImageSpec spec = spec_of(8, 8, 3, 6);
    const ScratchFolder folder;
    EXPECT_TRUE(
        has(error_of<std::runtime_error>([&] { open_png(folder / "none" / "x.png", spec); }), "No such file"));
    const auto unfinished = open_png(folder / "x.png", spec);
    EXPECT_THROW(unfinished->close(), std::logic_error);
    spec.bits = 1;
    EXPECT_THROW(open_png(folder / "x.png", spec), std::runtime_error);
    spec = spec_of(400'000'000, 8, 4, 6);
    EXPECT_TRUE(has(error_of<std::runtime_error>([&] { open_png(folder / "x.png", spec); }), "a row of a PNG"));
}

}  // namespace sikku::png_writer_test
