#include "art/image/image_file.h"
#include "engine/base/toml_file.h"
#include "tests/checks.h"
#include "tests/print_tools.h"

#include <zlib.h>

#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace sikku::icc_test {

using Bytes = std::vector<std::uint8_t>;

/// Big-endian numbers of a profile.
std::uint32_t number(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes.at(at + i));
    return value;
}
double fixed(const std::string& bytes, std::size_t at) {
    return static_cast<std::int32_t>(number(bytes, at)) / 65536.0;
}

/// The profile in a PNG's iCCP chunk, or nothing.
std::string png_profile(const std::string& png) {
    for (std::size_t at = 8; at + 12 <= png.size(); at += 12 + number(png, at)) {
        if (png.compare(at + 4, 4, "iCCP") != 0) continue;
        const std::size_t name_end = png.find('\0', at + 8);
        const std::size_t end = at + 8 + number(png, at);
        std::string profile(std::size_t{1} << 20, '\0');
        uLongf size = profile.size();
        EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(profile.data()), &size,
                             reinterpret_cast<const Bytef*>(png.data() + name_end + 2), end - name_end - 2),
                  Z_OK);
        profile.resize(size);
        return profile;
    }
    return "";
}

/// Offset of a tag's data in a profile.
std::size_t tag(const std::string& profile, const std::string& name) {
    const std::uint32_t tags = number(profile, 128);
    for (std::size_t i = 0; i < tags; ++i) {
        if (profile.compare(132 + 12 * i, 4, name) == 0) return number(profile, 132 + 12 * i + 4);
    }
    ADD_FAILURE() << "no tag " << name;
    return 0;
}

class Icc : public ::testing::Test {
protected:
    std::filesystem::path write(const std::string& name, ImageSpec spec, const Bytes& pixels) {
        const auto path = folder_ / name;
        const auto image = open_image(path, spec);
        image->rows(0, spec.height, pixels);
        image->close();
        return path;
    }
    static ImageSpec spec(const std::string& format, int width, int height, int channels) {
        ImageSpec made;
        made.format = format;
        made.width = width;
        made.height = height;
        made.channels = channels;
        return made;
    }
    std::string flat(const std::string& format, int channels, bool icc = true) {
        ImageSpec made = spec(format, 32, 32, channels);
        made.icc = icc;
        return contents(write("flat." + format, made, Bytes(static_cast<std::size_t>(32 * 32 * channels), 200)));
    }
    /// Ghostscript's, or nothing.
    static std::filesystem::path ink_profile() {
        for (const char* name : {"/usr/share/color/icc/ghostscript/default_cmyk.icc",
                                 "/usr/share/ghostscript/iccprofiles/default_cmyk.icc"}) {
            if (std::filesystem::exists(name)) return name;
        }
        return {};
    }
    /// What is wrong with a profile of inks.
    static std::string complaint(const std::filesystem::path& profile) {
        return error_of<FileError>([&] { check_cmyk_profile(profile); });
    }
    /// The inks of a TIFF, 4 bytes a pixel, read by another program.
    Bytes inks(const std::filesystem::path& file) {
        const auto read = [&](const std::string& channels) { return read_by_oiiotool(file, channels, true).bytes; };
        const std::string first = read("0,1,2");
        const std::string black = read("3,3,3");
        Bytes result;
        for (std::size_t i = 0; i < first.size(); i += 3) {
            for (const char byte : {first[i], first[i + 1], first[i + 2], black.at(i)}) {
                result.push_back(static_cast<std::uint8_t>(byte));
            }
        }
        return result;
    }

    ScratchFolder folder_;
};

TEST_F(Icc, TheProfileIsThatOfSrgb) {
    const std::string profile = png_profile(flat("png", 3));
    ASSERT_GT(profile.size(), 128u);
    EXPECT_LT(profile.size(), 1000u);
    EXPECT_EQ(number(profile, 0), profile.size());
    EXPECT_EQ(profile.substr(12, 12), "mntrRGB XYZ ");
    EXPECT_EQ(profile.substr(36, 4), "acsp");
    // Not the time of day: 1 January 1999.
    EXPECT_EQ(profile.substr(24, 12), std::string("\x07\xCF\0\1\0\1\0\0\0\0\0\0", 12));
    // IEC 61966-2-1 adapted to D50, as the profiles of the ICC have it.
    const std::array<std::pair<const char*, std::array<double, 3>>, 3> primaries = {{
        {"rXYZ", {0.43607, 0.22249, 0.01392}},
        {"gXYZ", {0.38515, 0.71687, 0.09708}},
        {"bXYZ", {0.14307, 0.06061, 0.71410}},
    }};
    for (const auto& [name, expected] : primaries) {
        const std::size_t at = tag(profile, name);
        for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(fixed(profile, at + 8 + 4 * i), expected[i], 3e-4) << name;
    }
}

TEST_F(Icc, TheCurveIsThatOfSrgbInColourAndInGrey) {
    const std::array<std::pair<int, const char*>, 3> cases = {{{3, "gTRC"}, {4, "rTRC"}, {1, "kTRC"}}};
    for (const auto& [channels, name] : cases) {
        const std::string profile = png_profile(flat("png", channels));
        ASSERT_GT(profile.size(), 128u);
        EXPECT_EQ(profile.substr(16, 4), channels == 1 ? "GRAY" : "RGB ");
        const std::size_t at = tag(profile, name);
        ASSERT_EQ(profile.substr(at, 4), "para");
        ASSERT_EQ(number(profile, at + 8) >> 16, 3u);  // (aX + b)^g from d on, else cX
        std::array<double, 5> p{};
        for (std::size_t i = 0; i < 5; ++i) p[i] = fixed(profile, at + 12 + 4 * i);
        for (int i = 0; i <= 255; ++i) {
            const double x = i / 255.0;
            const double curve = x >= p[4] ? std::pow(p[1] * x + p[2], p[0]) : p[3] * x;
            const double exact = x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4);
            EXPECT_NEAR(curve, exact, 1e-4) << name << ' ' << i;
        }
    }
}

TEST_F(Icc, EveryPictureHoldsItUnlessItIsToldNotTo) {
    for (const int channels : {1, 3, 4}) {
        const std::string expected = png_profile(flat("png", channels));
        for (const std::string format : {"tif", "jpg"}) {
            const bool is_rgb = channels > 1;
            const std::string file = flat(format, channels);
            EXPECT_TRUE(has(file, expected)) << format << channels;
            EXPECT_FALSE(has(file, is_rgb ? "GRAYXYZ " : "RGB XYZ "));
        }
    }
    EXPECT_EQ(png_profile(flat("png", 3, false)), "");
    for (const std::string format : {"png", "tif", "jpg", "exr"}) {
        EXPECT_FALSE(has(flat(format, 3, false), "acsp")) << format;
    }
    EXPECT_FALSE(has(flat("exr", 3), "acsp"));
    EXPECT_EQ(flat("png", 3), flat("png", 3));
    EXPECT_FALSE(has(flat("png", 3), "sRGB")) << "what the profile says is not said twice";
}

TEST_F(Icc, OthersFindNoFault) {
    NEEDS("pngcheck");
    for (const int channels : {1, 3, 4}) {
        flat("png", channels);
        const ToolOutcome outcome = run_tool("pngcheck -v '" + folder_.file("flat.png") + "'");
        EXPECT_TRUE(outcome.ok) << outcome.text;
        EXPECT_TRUE(has(outcome.text, "chunk iCCP"));
    }
    NEEDS("exiftool");
    for (const std::string format : {"png", "tif", "jpg"}) {
        flat(format, 3);
        const std::string told =
            run_tool("exiftool -ICC_Profile:ProfileDescription -s3 '" + folder_.file("flat." + format) + "'").text;
        EXPECT_EQ(told, "sRGB built-in\n") << format;
    }
}

TEST_F(Icc, WhatIsNoProfileOfInksIsRefusedByName) {
    const auto refused = [&](const std::filesystem::path& file, const std::string& why) {
        const std::string text = complaint(file);
        EXPECT_TRUE(has(text, "'" + file.string() + "'"));
        EXPECT_TRUE(has(text, why));
    };
    refused(folder_ / "none.icc", "no such file");
    refused(folder_.path(), "not a regular file");
    refused(folder_.write("empty.icc", ""), "not an ICC profile");
    refused(folder_.write("text.icc", std::string(500, 'x')), "not an ICC profile");
    const std::string srgb = png_profile(flat("png", 3));
    refused(folder_.write("srgb.icc", srgb), "not CMYK");
    refused(folder_.write("grey.icc", png_profile(flat("png", 1))), "not CMYK");
    // A monitor's that only says that it has inks, and one that ends too soon.
    std::string lie = srgb;
    lie.replace(16, 4, "CMYK");
    refused(folder_.write("lie.icc", lie), "cannot convert colours to inks");
    refused(folder_.write("short.icc", srgb.substr(0, 300)), "");
    refused("/dev/null", "not a regular file");
    if (ink_profile().empty()) GTEST_SKIP() << "no CMYK profile on this machine";
    EXPECT_EQ(complaint(ink_profile()), "");
    const std::string whole = contents(ink_profile());
    for (const std::size_t size : {std::size_t{100}, std::size_t{200}, whole.size() / 2}) {
        static_cast<void>(complaint(folder_.write("cut.icc", whole.substr(0, size))));
    }
}

TEST_F(Icc, PixelsBecomeInks) {
    NEEDS("oiiotool");
    if (ink_profile().empty()) GTEST_SKIP() << "no CMYK profile on this machine";
    ImageSpec made = spec("tif", 64, 40, 3);
    made.cmyk = ink_profile();
    // Runs of white, black, red, green and blue and, below them, a ramp.
    constexpr std::array<std::array<std::uint8_t, 3>, 5> colours = {
        {{255, 255, 255}, {0, 0, 0}, {255, 0, 0}, {0, 255, 0}, {0, 0, 255}}};
    Bytes pixels;
    for (int y = 0; y < 40; ++y) {
        for (int x = 0; x < 64; ++x) {
            const auto grey = static_cast<std::uint8_t>(4 * x);
            const std::array<std::uint8_t, 3> ramp = {grey, grey, grey};
            const auto& colour = y < 20 ? colours[static_cast<std::size_t>(x / 13)] : ramp;
            pixels.insert(pixels.end(), colour.begin(), colour.end());
        }
    }
    const auto file = write("inks.tif", made, pixels);
    EXPECT_TRUE(has(contents(file), contents(ink_profile()))) << "the profile is in the file";
    const Bytes found = inks(file);
    ASSERT_EQ(found.size(), 64u * 40 * 4);
    const auto at = [&](int x, int y) {
        const std::uint8_t* ink = &found[static_cast<std::size_t>(4 * (64 * y + x))];
        return std::array<int, 4>{ink[0], ink[1], ink[2], ink[3]};
    };
    EXPECT_EQ(at(0, 0), (std::array<int, 4>{0, 0, 0, 0})) << "paper";
    EXPECT_GT(at(20, 0)[3], 200) << "black is mostly black ink";
    const auto red = at(30, 0), green = at(45, 0), blue = at(60, 0);
    EXPECT_TRUE(red[1] > 200 && red[2] > 200 && red[0] < 60);
    EXPECT_TRUE(green[0] > 120 && green[2] > 200 && green[1] < 60);
    EXPECT_TRUE(blue[0] > 200 && blue[1] > 150 && blue[2] < 60);
    int last = 4 * 255 + 1;
    for (int x = 0; x < 64; ++x) {
        const auto ink = at(x, 30);
        const int sum = std::accumulate(ink.begin(), ink.end(), 0);
        EXPECT_LE(sum, last + 4) << x;
        last = sum;
        EXPECT_EQ(at(x, 39), ink) << "a pixel does not depend on its neighbours";
    }
    EXPECT_EQ(at(0, 30), at(20, 0));
    NEEDS("tiffinfo");
    const std::string told = run_tool("tiffinfo '" + file.string() + "'").text;
    for (const std::string part : {"Photometric Interpretation: separated", "Samples/Pixel: 4", "Bits/Sample: 8"}) {
        EXPECT_TRUE(has(told, part));
    }
    EXPECT_FALSE(has(told, "Extra Samples"));
}

TEST_F(Icc, GreyAndTranslucentPixelsBecomeTheSameInks) {
    if (ink_profile().empty()) GTEST_SKIP() << "no CMYK profile on this machine";
    Bytes grey, colour, translucent;
    for (int i = 0; i < 32 * 32; ++i) {
        const auto value = static_cast<std::uint8_t>(i % 256);
        grey.push_back(value);
        for (int k = 0; k < 3; ++k) colour.push_back(value);
        // Black through which so much paper is seen.
        for (int k = 0; k < 3; ++k) translucent.push_back(0);
        translucent.push_back(static_cast<std::uint8_t>(255 - value));
    }
    const auto converted = [&](int channels, const Bytes& pixels) {
        ImageSpec made = spec("tif", 32, 32, channels);
        made.cmyk = ink_profile();
        return contents(write("a.tif", made, pixels));
    };
    const std::string expected = converted(3, colour);
    EXPECT_EQ(converted(1, grey), expected);
    EXPECT_EQ(converted(4, translucent), expected);
}

TEST_F(Icc, OneBitIsALuminanceOfAHalf) {
    NEEDS("oiiotool");
    for (const int channels : {1, 3, 4}) {
        // Two calls, and rows that end within a byte.
        ImageSpec made = spec("tif", 259, 40, channels);
        made.bits = 1;
        Bytes pixels;
        for (int i = 0; i < 259 * 40; ++i) {
            const auto value = static_cast<std::uint8_t>(i * 7 % 256);
            for (int k = 0; k < std::min(channels, 3); ++k) pixels.push_back(value);
            if (channels == 4) pixels.push_back(255);
        }
        const auto path = folder_ / "bits.tif";
        const auto image = open_image(path, made);
        const auto split = static_cast<std::size_t>(259 * 32 * channels);
        image->rows(0, 32, std::span(pixels).first(split));
        image->rows(32, 8, std::span(pixels).subspan(split));
        image->close();
        const PixelGrid found = read_by_oiiotool(path, "0,0,0");
        ASSERT_EQ(found.width, 259);
        for (int i = 0; i < 259 * 40; ++i) {
            ASSERT_EQ(found.at(i % 259, i / 259).red, i * 7 % 256 < 128 ? 0 : 255) << channels << ' ' << i;
        }
        EXPECT_FALSE(has(contents(path), "acsp"));
    }
}

TEST_F(Icc, OtherFormatsHaveNeitherInksNorSingleBits) {
    for (const std::string format : {"png", "jpg", "exr"}) {
        ImageSpec inked = spec(format, 8, 8, 3);
        inked.cmyk = "any.icc";
        EXPECT_THROW(open_image(folder_ / "a", inked), std::runtime_error) << format;
        ImageSpec bits = spec(format, 8, 8, 1);
        bits.bits = 1;
        EXPECT_THROW(open_image(folder_ / "a", bits), std::runtime_error) << format;
    }
    for (const int bits : {0, 2, 3, 16}) {
        ImageSpec made = spec("tif", 8, 8, 1);
        made.bits = bits;
        EXPECT_THROW(open_image(folder_ / "a", made), std::runtime_error) << bits;
    }
}

}  // namespace sikku::icc_test
