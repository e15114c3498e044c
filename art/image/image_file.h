// art/image/image_file.h: writes and reads picture files: PNG by png_writer.h, others with OpenImageIO, which is
// loaded on first use.
#pragma once

#include "engine/base/monitor.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

struct ImageSpec {
    std::string format;  ///< `png`, `tif`, `jpg` or `exr`
    int width = 0, height = 0;
    int channels = 3;  ///< 1, 3 or 4
    double dpi = 300.0;
    int threads = 1;
    std::string title;             ///< Title where the format has one
    std::string description;       ///< ImageDescription
    std::string software;          ///< Software
    int compression = 6;           ///< level for PNG: 1, quick and large, to 9
    bool icc = true;               ///< PNG, TIFF and JPEG contain the profile of their colours
    std::filesystem::path cmyk{};  ///< ICC profile of inks, to which pixels are converted; empty: none; only TIFF
    int bits = 8;                  ///< bits per channel; 1: pixels become black or white; only TIFF
};

/// JPEG stores texts in one EXIF block of 64 kB; other TIFF readers accept as much. Longer patterns are left out
/// rather than cut.
constexpr std::size_t longest_short_text = 60'000;
/// True if a file of that format (as in ImageSpec) can contain that text.
inline bool keeps_text(std::string_view format, std::string_view text) {
    return (format != "jpg" && format != "tif") || text.size() <= longest_short_text;
}

/// One raster file being written; rows from top to bottom, 8 bits a channel, sRGB with straight alpha. Failures throw
/// std::runtime_error, a full disk at the latest when the file is closed. The same rows give the same bytes.
///
/// PNG and TIFF keep the pixels; JPEG (quality 95), CMYK and one bit have no alpha and lie on white; EXR is 16-bit
/// linear light with associated alpha. CMYK is relative colorimetric with black point compensation; with one bit,
/// pixels of at least half the luminance are white. JPEG and TIFF leave out texts that they cannot store: see
/// keeps_text().
class ImageWriter {
public:
    virtual ~ImageWriter() = default;
    /// Writes rows. TIFF compresses in parallel if all calls except the last have a multiple of 32 rows.
    virtual void rows(int first_row, int rows, std::span<const std::uint8_t> pixels) = 0;
    /// Completes the file. Without it the file is useless.
    virtual void close() = 0;
};

/// Loads the module with OpenImageIO, which every picture but PNG needs, and checks that it can start its threads,
/// for pictures using this many (0: one for each core). Call before long work: under a low `ulimit -u` or `-v` the
/// libraries of the module would abort the program.
/// @throws std::runtime_error if it cannot be loaded, or needs more threads or memory than the limits allow
void prepare_images(int threads);

/// Opens `path`, whatever its extension, for writing. Loads the module unless the format is PNG (about 0.2 s, once).
/// @throws std::runtime_error also for options that the format does not support, and if `cmyk` is not a profile of
/// inks
std::unique_ptr<ImageWriter> open_image(const std::filesystem::path& path, const ImageSpec& spec);

/// The inks of a CMYK profile for output devices.
class InkProfile {
public:
    virtual ~InkProfile() = default;
    /// The bytes of the file.
    virtual const std::vector<std::uint8_t>& bytes() const = 0;
    /// Its description in ASCII; `CMYK` if it has none.
    virtual std::string name() const = 0;
    /// Cyan, magenta, yellow and black of an sRGB colour, 0 to 1: relative colorimetric with black point
    /// compensation.
    virtual std::array<double, 4> convert(std::array<std::uint8_t, 3> colour) const = 0;
};
/// Opens a profile; loads the module, too. @throws FileError, which names the file, as check_cmyk_profile(), and if
/// the profile is not one of an output device
std::unique_ptr<InkProfile> open_inks(const std::filesystem::path& file);

/// @throws FileError, which names the file, if it is not an ICC profile that converts colours to CMYK;
/// std::runtime_error if the module, which it loads, is missing
void check_cmyk_profile(const std::filesystem::path& file);

/// A picture that was read: upright, rows from top to bottom, 3 bytes a pixel.
struct DecodedPicture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> pixels = {};
    int file_width = 0, file_height = 0;  ///< before reduction, in the picture's orientation
};

/// True if a file begins as JPEG, PNG, TIFF, WebP, HEIF or BMP, which read_picture() reads.
bool is_picture(std::string_view first_bytes);

/// Reads the first picture of a file: upright, as its EXIF orientation says, transparent parts on white, averaged
/// over squares of pixels until no side is longer than `longest_side`. Safe for untrusted files: sizes are checked
/// before pixels are decoded. Loads the module, too. Time: about 25 ms for a million pixels of JPEG.
/// @throws std::runtime_error, without the name of the file, if it is not a picture, is damaged, or has more than
/// `most_pixels`; Stopped
DecodedPicture read_picture(const std::filesystem::path& path, int longest_side, std::uint64_t most_pixels,
                            const Monitor& monitor = {});

}  // namespace sikku
