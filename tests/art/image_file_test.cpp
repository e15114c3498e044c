// tests/art/image_file_test.cpp: picture files: their texts, pixels, resolution and errors.
#include "art/image/image_file.h"

#include "art/image/image_module.h"
#include "art/raster/raster.h"
#include "tests/checks.h"
#include "tests/print_tools.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <random>
#include <thread>
#include <vector>

namespace sikku::image_file_test {

using Bytes = std::vector<std::uint8_t>;

/// A drawing as an image file.
ImageSpec image_spec(const std::string& format, int width, int height, int channels) {
    return {format, width, height, channels, 254.0, 2, "A test", "axiom: F\nF --> F-F # கோலம்\n", "sikku 0.1.0", 6};
}

Bytes noise(std::size_t size) {
    std::mt19937 random(8);
    Bytes bytes(size);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    return bytes;
}

void write_image(const std::filesystem::path& path, const ImageSpec& spec, const Bytes& pixels) {
    const std::unique_ptr<ImageWriter> writer = open_image(path, spec);
    const std::size_t row = static_cast<std::size_t>(spec.width) * spec.channels;
    for (int first = 0; first < spec.height; first += 64) {
        const int rows = std::min(64, spec.height - first);
        writer->rows(first, rows, std::span(pixels).subspan(row * first, row * rows));
    }
    writer->close();
}

TEST(ImageFile, EveryFormatKeepsItsTextAndResolution) {
    const ScratchFolder folder;
    std::string files;
    std::vector<std::string> lines;
    for (const std::string format : {"png", "tif", "jpg", "exr"}) {
        for (const int channels : {1, 3, 4}) {
            const auto path = folder / ("picture" + std::to_string(channels) + "." + format + ".tmp");
            const ImageSpec spec = image_spec(format, 60, 150, channels);
            write_image(path, spec, noise(60 * 150 * channels));
            const auto found = provenance_of(path);
            ASSERT_TRUE(found) << path;
            EXPECT_EQ(found->pattern, spec.description) << path;
            EXPECT_EQ(found->made, spec.software) << path;
            files += " '" + path.string() + "'";
            const int kept = format == "jpg" && channels == 4 ? 3 : channels;  // JPEG has no alpha
            lines.push_back(path.string() + " :   60 x  150, " + std::to_string(kept) + " channel");
        }
    }
    if (has_program("oiiotool")) {
        const ToolOutcome info = run_tool("oiiotool --info -v" + files);
        EXPECT_TRUE(info.ok) << info.text;
        for (const std::string& line : lines) EXPECT_TRUE(has(info.text, line)) << line;
        std::size_t resolutions = 0;
        const std::string resolution = "XResolution: 254\n";
        for (std::size_t at = 0; (at = info.text.find(resolution, at)) != std::string::npos; ++at) ++resolutions;
        EXPECT_EQ(resolutions, lines.size()) << info.text;
        EXPECT_FALSE(has(info.text, "DateTime"));
    }
    if (has_program("pngcheck")) {
        const ToolOutcome check = run_tool("pngcheck -v '" + (folder / "picture3.png.tmp").string() + "'");
        EXPECT_TRUE(check.ok) << check.text;
        EXPECT_TRUE(has(check.text, "10000x10000 pixels/meter"));
    }
}

TEST(ImageFile, ThePixelsComeBack) {
    if (!has_program("oiiotool")) GTEST_SKIP() << "no oiiotool";
    const ScratchFolder folder;
    const Bytes pixels = noise(70 * 200 * 3);
    for (const std::string format : {"png", "tif"}) {
        const auto path = folder / ("picture." + format);
        write_image(path, image_spec(format, 70, 200, 3), pixels);
        const PixelGrid back = read_by_oiiotool(path);
        EXPECT_EQ(back.width, 70);
        EXPECT_EQ(back.height, 200);
        EXPECT_TRUE(std::equal(pixels.begin(), pixels.end(), back.bytes.begin(), back.bytes.end(),
                               [](std::uint8_t a, char b) { return a == static_cast<std::uint8_t>(b); }));
    }
}

TEST(ImageFile, AlphaIsStraightInPngAssociatedAndLinearInExrAndPaperInJpeg) {
    if (!has_program("oiiotool")) GTEST_SKIP() << "no oiiotool";
    const ScratchFolder folder;
    Bytes pixels;
    for (int i = 0; i < 16 * 16; ++i) pixels.insert(pixels.end(), {188, 0, 255, 102});
    const auto dump = [&](const std::string& format) {
        const auto path = folder / ("picture." + format);
        write_image(path, image_spec(format, 16, 16, 4), pixels);
        return run_tool("oiiotool " + std::string(format == "png" ? "--iconfig oiio:UnassociatedAlpha 1 " : "") +
                        "--dumpdata '" + path.string() + "'")
            .text;
    };
    EXPECT_TRUE(has(dump("png"), "188 0 255 102"));
    // 188 of sRGB is 0.5029 of linear light.
    EXPECT_TRUE(has(dump("exr"), "0.20117"));
    EXPECT_TRUE(has(dump("exr"), "0.39990"));
    EXPECT_FALSE(has(dump("jpg"), "0.737"));
}

TEST(ImageFile, TheSameImageIsTheSameFile) {
    const ScratchFolder folder;
    const Bytes pixels = noise(200 * 300 * 3);
    const std::vector<std::string> formats{"png", "tif", "jpg", "exr"};
    for (const std::string& format : formats)
        write_image(folder / ("one." + format), image_spec(format, 200, 300, 3), pixels);
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // the time of day is not in it
    for (const std::string& format : formats) {
        ImageSpec spec = image_spec(format, 200, 300, 3);
        spec.threads = 4;
        write_image(folder / ("two." + format), spec, pixels);
        EXPECT_TRUE(contents(folder / ("one." + format)) == contents(folder / ("two." + format))) << format;
    }
}

TEST(ImageFile, AFullDiskIsAnError) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
    // Too small to be written before the end, and large.
    for (const int size : {8, 400}) {
        for (const std::string format : {"png", "tif", "jpg", "exr"}) {
            EXPECT_TRUE(has(error_of<std::runtime_error>([&] {
                                write_image("/dev/full", image_spec(format, size, size, 3), noise(3 * size * size));
                            }),
                            "No space left"));
        }
    }
}

TEST(ImageFile, APictureThatIsGivenUpReportsNothing) {
    const ScratchFolder folder;
    testing::internal::CaptureStderr();
    for (const char* format : {"png", "tif", "jpg", "exr"}) {
        for (const int rows : {0, 32}) {
            const auto writer = open_image(folder / "x", image_spec(format, 64, 64, 3));
            if (rows > 0) writer->rows(0, rows, std::vector<std::uint8_t>(std::size_t{3} * 64 * 32, 0));
        }
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

TEST(ImageFile, WhatCannotBeWrittenIsAnError) {
    const ScratchFolder folder;
    EXPECT_THROW(open_image(folder / "none" / "x.png", image_spec("png", 8, 8, 1)), std::runtime_error);
    EXPECT_THROW(open_image(folder / "x.gif", image_spec("gif", 8, 8, 1)), std::runtime_error);
    EXPECT_THROW(open_image(folder / "x.jpg", image_spec("jpg", 70'000, 8, 1)), std::runtime_error);
}

TEST(ImageFile, ALongTextIsKeptWholeOrNotAtAll) {
    const ScratchFolder folder;
    for (const std::string format : {"png", "tif", "jpg", "exr"}) {
        ImageSpec spec = image_spec(format, 64, 64, 1);
        spec.description = std::string(300'000, 'x');
        write_image(folder / "picture", spec, noise(64 * 64));
        const auto found = provenance_of(folder / "picture");
        ASSERT_EQ(found.has_value(), format != "jpg" && format != "tif") << format;
        if (found) {
            EXPECT_TRUE(found->pattern == spec.description) << format << ' ' << found->pattern.size();
            EXPECT_EQ(found->made, spec.software);
        }
        // The longest that every format keeps, with whatever else there is to say.
        spec.description = std::string(longest_short_text, 'x');
        for (const std::size_t length : {20, 5'300, 20'000}) {
            spec.software = std::string(length, 's');
            write_image(folder / "picture", spec, noise(64 * 64));
            const auto kept = provenance_of(folder / "picture");
            ASSERT_TRUE(kept) << format << ' ' << length;
            EXPECT_TRUE(kept->pattern == spec.description) << format << ' ' << length;
            EXPECT_TRUE(kept->made == spec.software || (format == "jpg" && kept->made.empty())) << length;
        }
    }
}

TEST(ImageFile, AModuleOfAnotherVersionIsRefused) {
    EXPECT_NE(image_module_version("0.1.0"), image_module_version("0.1.1"));
    const ScratchFolder folder;
    const std::filesystem::path program = SIKKU_PROGRAM;
    const std::string said = run_tool("'" + program.string() + "' --version").text;
    ASSERT_TRUE(said.starts_with("sikku ") && said.ends_with("\n")) << said;
    const std::string version = said.substr(6, said.find_first_of(" \n", 6) - 6);
    // The program and its module, with another number in it.
    const auto built = program.parent_path().parent_path();
    std::filesystem::path module;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(built / "lib")) {
        if (entry.path().filename() == "sikku_image.so") module = entry.path();
    }
    ASSERT_FALSE(module.empty());
    const auto copied_program = folder / "bin" / "sikku";
    const auto copied_module = folder.path() / module.lexically_relative(built);
    std::filesystem::create_directories(copied_program.parent_path());
    std::filesystem::create_directories(copied_module.parent_path());
    std::filesystem::copy_file(program, copied_program);
    const auto pattern = folder / "x.lsys";
    std::ofstream(pattern) << "axiom: F\n";
    const std::string draw = "'" + copied_program.string() + "' draw '" + pattern.string() + "' --dpi 10 -o '" +
                             (folder / "x.tif").string() + "'";
    std::string bytes = contents(module);
    const std::uint64_t number = image_module_version(version);
    const std::string_view sought(reinterpret_cast<const char*>(&number), sizeof number);
    const std::size_t at = bytes.find(sought);
    ASSERT_NE(at, std::string::npos);
    const auto save = [&] { std::ofstream(copied_module, std::ios::binary) << bytes; };
    save();
    const auto same = run_tool(draw);
    EXPECT_TRUE(same.ok) << same.text;
    bytes[at] ^= 1;
    save();
    const auto other = run_tool(draw);
    // Where sikku is installed as well, its module serves.
    if (other.ok) GTEST_SKIP() << "an installed module was found";
    EXPECT_TRUE(has(other.text, "made for another version of sikku"));
    std::filesystem::remove(copied_module);
    const auto none = run_tool(draw);
    EXPECT_TRUE(has(none.text, "PNG does not need it")) << none.text;
    const auto png = run_tool(draw.substr(0, draw.size() - 4) + "png'");
    EXPECT_TRUE(png.ok) << png.text;

    // If a library of the decoder is missing, the dynamic loader exits with 127.
    const auto decoder = copied_module.parent_path() / "sikku_decoder";
    std::ofstream(decoder) << "#!/bin/sh\nexit 127\n";
    std::filesystem::permissions(decoder, std::filesystem::perms::owner_all);
    const auto read = run_tool("'" + copied_program.string() + "' kolam --read '" + (folder / "x.png").string() +
                               "' -o '" + (folder / "y.lsys").string() + "'");
    EXPECT_FALSE(read.ok);
    EXPECT_TRUE(has(read.text, "OpenImageIO is not installed")) << read.text;
}

}  // namespace sikku::image_file_test
