#include "art/decoder/bare_picture.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdlib>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

namespace sikku {
namespace {

[[noreturn]] void refuse(const char* reason) {
    throw std::runtime_error(reason);
}

/// Numbers in a file; reading past its end rejects the file.
class Bytes {
public:
    Bytes(std::string_view bytes, bool is_big_endian) : bytes_(bytes), is_big_(is_big_endian) {}

    std::uint64_t number(std::size_t at, std::size_t size) const {
        if (at > bytes_.size() || size > bytes_.size() - at) refuse("the picture is damaged: it ends too early");
        std::uint64_t value = 0;
        for (std::size_t i = 0; i < size; ++i) {
            value = value << 8U | static_cast<unsigned char>(bytes_[at + (is_big_ ? i : size - 1 - i)]);
        }
        return value;
    }

private:
    std::string_view bytes_;
    bool is_big_;
};

/// The orientation in the EXIF segment of a JPEG, `Exif\0\0` and a TIFF header. Source: Exif 2.32, tag 274.
int orientation_of(std::string_view exif) {
    if (!exif.starts_with(std::string_view("Exif\0\0", 6))) return 1;
    exif.remove_prefix(6);
    try {
        const Bytes tiff(exif, exif.starts_with("MM"));
        const std::size_t directory = tiff.number(4, 4);
        const std::uint64_t entries = tiff.number(directory, 2);
        for (std::uint64_t i = 0; i < entries; ++i) {
            const std::size_t entry = directory + 2 + 12 * i;
            if (tiff.number(entry, 2) != 274) continue;
            const std::uint64_t value = tiff.number(entry + 8, 2);
            return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
        }
    } catch (const std::runtime_error&) {
        return 1;  // damaged metadata do not matter
    }
    return 1;
}

BarePicture bare_jpeg(const std::string& bytes, std::uint64_t most_pixels) {
    BarePicture bare{"jpeg", bytes.substr(0, 2), 1};
    const Bytes file(bytes, true);
    std::uint64_t pixels = 0;
    for (std::size_t at = 2;;) {
        if (file.number(at, 1) != 0xFF) refuse("the picture is damaged: no JPEG marker");
        const auto marker = static_cast<unsigned>(file.number(at + 1, 1));
        if (marker == 0xFF) {  // padding
            ++at;
            continue;
        }
        if (marker == 0xD9) refuse("the picture is damaged: it has no pixels");
        const std::size_t length = 2 + file.number(at + 2, 2);
        file.number(at, length);
        const std::string_view segment = std::string_view(bytes).substr(at, length);
        const bool is_frame = marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
        if (is_frame) {
            check_size(file.number(at + 7, 2), file.number(at + 5, 2), most_pixels);
            pixels = file.number(at + 7, 2) * file.number(at + 5, 2);
            if (file.number(at + 9, 1) > 4) refuse("not a picture in colour or grey");
        }
        if (marker == 0xE1 && bare.orientation == 1) bare.orientation = orientation_of(segment.substr(4));
        const bool is_metadata = (marker >= 0xE1 && marker <= 0xEF && marker != 0xEE) || marker == 0xFE;
        if (!is_metadata) bare.bytes += segment;
        at += length;
        if (marker != 0xDA) continue;
        if (pixels == 0) refuse("the picture is damaged: it has no size");
        if (bytes.find("\xFF\xD9", at) == std::string::npos) refuse("the picture is damaged: it ends too early");
        std::uint64_t scans = 1;
        for (std::size_t next = bytes.find("\xFF\xDA", at); next != std::string::npos;
             next = bytes.find("\xFF\xDA", next + 2)) {
            ++scans;
        }
        constexpr std::uint64_t most_passes = 3'000'000'000;  // over pixels
        if (scans > 100 || scans * pixels > most_passes) refuse("the picture has too many scans");
        bare.bytes.append(bytes, at, std::string::npos);
        return bare;
    }
}

// --- PNG: libpng prints what it finds wrong, so that only sound files may reach it ---------------------------------
// Source: Portable Network Graphics, 2nd edition, 2003.

#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
constexpr bool checks_sums = false;  // a fuzzer cannot guess them
#else
constexpr bool checks_sums = true;
#endif

struct PngHeader {
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    unsigned depth = 0;
    unsigned colour = 0;  ///< 0 grey, 2 RGB, 3 palette, 4 grey and alpha, 6 RGB and alpha
    bool interlaced = false;

    PngHeader() = default;
    /// @param at  position of the data of IHDR
    PngHeader(const Bytes& file, std::size_t at, std::uint64_t most_pixels) {
        check_size(file.number(at, 4), file.number(at + 4, 4), most_pixels);
        width = static_cast<std::uint32_t>(file.number(at, 4));
        height = static_cast<std::uint32_t>(file.number(at + 4, 4));
        depth = static_cast<unsigned>(file.number(at + 8, 1));
        colour = static_cast<unsigned>(file.number(at + 9, 1));
        interlaced = file.number(at + 12, 1) == 1;
        const bool is_deep = depth == 8 || depth == 16;
        const bool is_known = colour == 0   ? depth == 1 || depth == 2 || depth == 4 || is_deep
                              : colour == 3 ? depth == 1 || depth == 2 || depth == 4 || depth == 8
                                            : is_deep && (colour == 2 || colour == 4 || colour == 6);
        constexpr std::uint32_t most_side = 1'000'000;  // limit of libpng
        if (!is_known || file.number(at + 10, 2) != 0 || file.number(at + 12, 1) > 1 || width > most_side ||
            height > most_side) {
            refuse("the picture is damaged: its header is wrong");
        }
    }
    std::uint64_t row_bytes(std::uint64_t columns) const {
        const unsigned channels = colour == 2 ? 3 : colour == 4 ? 2 : colour == 6 ? 4 : 1;
        return (columns * channels * depth + 7) / 8;
    }
};

/// Follows the rows of a PNG, each a filter and its bytes.
class PngRows {
public:
    explicit PngRows(const PngHeader& header) {
        if (!header.interlaced) {
            add(header.row_bytes(header.width), header.height);
            return;
        }
        constexpr std::array<std::array<std::uint32_t, 4>, 7> passes = {
            {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4}, {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}}};
        for (const auto& [x, y, across, down] : passes) {
            if (header.width <= x || header.height <= y) continue;
            add(header.row_bytes((header.width - x + across - 1) / across), (header.height - y + down - 1) / down);
        }
    }
    bool is_complete() const { return passes_.empty(); }
    /// @throws std::runtime_error for a filter that does not exist, and for bytes after the last row
    void take(std::string_view bytes) {
        while (!bytes.empty()) {
            if (passes_.empty()) refuse("the picture is damaged: it has more pixels than its size says");
            if (left_ == 0) {
                if (static_cast<unsigned char>(bytes[0]) > 4)
                    refuse("the picture is damaged: a row of pixels is wrong");
                left_ = passes_.front().row_bytes + 1;
            }
            const std::size_t taken = std::min<std::uint64_t>(left_, bytes.size());
            bytes.remove_prefix(taken);
            left_ -= taken;
            if (left_ == 0 && --passes_.front().rows == 0) passes_.erase(passes_.begin());
        }
    }

private:
    struct Pass {
        std::uint64_t row_bytes;
        std::uint32_t rows;
    };
    void add(std::uint64_t row_bytes, std::uint32_t rows) { passes_.push_back({row_bytes, rows}); }
    std::vector<Pass> passes_;
    std::uint64_t left_ = 0;  // bytes left in the current row
};

/// Inflates the pixels of a PNG piece by piece. @throws std::runtime_error if they are damaged
void check_png_pixels(const std::vector<std::string_view>& parts, const PngHeader& header) {
    z_stream stream{};
    // The window that the stream states, as in libpng.
    if (inflateInit2(&stream, 0) != Z_OK) refuse("there is no memory for the picture");
    const std::unique_ptr<z_stream, int (*)(z_stream*)> end(&stream, inflateEnd);
    PngRows rows(header);
    std::vector<char> buffer(std::size_t{1} << 16U);
    int status = Z_OK;
    for (const std::string_view part : parts) {
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(part.data()));
        stream.avail_in = static_cast<uInt>(part.size());
        while (stream.avail_in > 0) {
            if (status == Z_STREAM_END) refuse("the picture is damaged: it has more pixels than its size says");
            stream.next_out = reinterpret_cast<Bytef*>(buffer.data());
            stream.avail_out = static_cast<uInt>(buffer.size());
            status = inflate(&stream, Z_NO_FLUSH);
            if (status != Z_OK && status != Z_STREAM_END) refuse("the picture is damaged: its pixels are wrong");
            rows.take({buffer.data(), buffer.size() - stream.avail_out});
        }
    }
    if (status != Z_STREAM_END || !rows.is_complete()) refuse("the picture is damaged: it ends too early");
}

void append_png_chunk(std::string& bytes, const std::string& name, std::string_view data) {
    const auto number = [&](std::uint64_t value) {
        for (int shift = 24; shift >= 0; shift -= 8)
            bytes += static_cast<char>(value >> static_cast<unsigned>(shift));
    };
    number(data.size());
    const std::size_t begin = bytes.size();
    bytes.append(name).append(data);
    number(crc32_z(0, reinterpret_cast<const Bytef*>(&bytes[begin]), bytes.size() - begin));
}

/// The parts of a PNG that are needed for its pixels.
struct PngParts {
    std::optional<PngHeader> header;
    std::string_view header_bytes, palette, transparency;
    std::vector<std::string_view> pixels;

    PngParts(std::string_view bytes, std::uint64_t most_pixels) {
        const Bytes file(bytes, true);
        for (std::size_t at = 8;;) {
            const std::size_t length = file.number(at, 4);
            file.number(at, 12 + length);
            const std::string_view name = bytes.substr(at + 4, 4);
            const std::string_view data = bytes.substr(at + 8, length);
            if (!header && (name != "IHDR" || length != 13)) refuse("the picture is damaged: its header is wrong");
            if (name == "IEND") break;
            if (name == "IHDR" || name == "PLTE" || name == "tRNS" || name == "IDAT") {
                const auto sum = crc32_z(0, reinterpret_cast<const Bytef*>(&bytes[at + 4]), length + 4);
                const bool is_right = sum == file.number(at + 8 + length, 4);
                if (checks_sums && !is_right) refuse("the picture is damaged: a checksum is wrong");
            }
            if (name == "IHDR" && !header) {
                header = PngHeader(file, at + 8, most_pixels);
                header_bytes = data;
            } else if (name == "PLTE") {
                palette = data;
            } else if (name == "tRNS") {
                transparency = data;
            } else if (name == "IDAT") {
                pixels.push_back(data);
            }
            at += 12 + length;
        }
    }
};

BarePicture bare_png(const std::string& bytes, std::uint64_t most_pixels) {
    const PngParts parts(bytes, most_pixels);
    const PngHeader& header = *parts.header;
    BarePicture bare{"png", bytes.substr(0, 8), 1};
    append_png_chunk(bare.bytes, "IHDR", parts.header_bytes);
    const std::size_t entries = parts.palette.size() / 3;
    if (header.colour == 3) {
        const std::size_t most = std::size_t{1} << header.depth;
        if (parts.palette.size() % 3 != 0 || entries == 0 || entries > most) {
            refuse("the picture is damaged: its palette is wrong");
        }
        // Pixels may refer to colours that the palette does not contain.
        std::string palette(parts.palette);
        palette.resize(3 * most);
        append_png_chunk(bare.bytes, "PLTE", palette);
    }
    const std::size_t size = parts.transparency.size();
    const bool is_transparent = header.colour == 0   ? size == 2
                                : header.colour == 2 ? size == 6
                                                     : header.colour == 3 && size > 0 && size <= entries;
    if (is_transparent) append_png_chunk(bare.bytes, "tRNS", parts.transparency);
    check_png_pixels(parts.pixels, header);
    for (const std::string_view part : parts.pixels) append_png_chunk(bare.bytes, "IDAT", part);
    append_png_chunk(bare.bytes, "IEND", {});
    return bare;
}

BarePicture bare_webp(const std::string& bytes, std::uint64_t most_pixels) {
    BarePicture bare{"webp", bytes.substr(0, 12), 1};
    const Bytes file(bytes, false);
    if (file.number(8, 4) != 0x50424557) refuse("not a picture, or a damaged one: a RIFF file that is not a WebP");
    bool has_pixels = false;
    for (std::size_t at = 12; at < bytes.size();) {
        const std::uint64_t size = file.number(at + 4, 4);
        if (size > bytes.size() - at - 8) refuse("the picture is damaged: it ends too early");
        const std::size_t length = 8 + size + size % 2;
        const std::string_view name = std::string_view(bytes).substr(at, 4);
        const std::size_t held = std::min(length, bytes.size() - at);
        if (name == "VP8X") {
            check_size(1 + file.number(at + 12, 3), 1 + file.number(at + 15, 3), most_pixels);
            if ((file.number(at + 8, 1) & 2U) != 0) refuse("animations are not read");
            std::string header(bytes, at, held);
            header[8] = static_cast<char>(header[8] & ~0x2C);  // no profile, EXIF or XMP
            bare.bytes += header;
        } else if (name != "ICCP" && name != "EXIF" && name != "XMP ") {
            bare.bytes.append(bytes, at, held);
            has_pixels = has_pixels || name == "VP8 " || name == "VP8L";
        }
        at += length;
    }
    if (!has_pixels) refuse("the picture is damaged: it has no pixels");
    const std::uint64_t size = bare.bytes.size() - 8;
    for (std::size_t i = 0; i < 4; ++i) bare.bytes[4 + i] = static_cast<char>(size >> (8 * i));
    return bare;
}

/// Renames the tags of metadata in the first directory, so that no reader looks into them.
BarePicture bare_tiff(std::string bytes, std::uint64_t most_pixels) {
    const bool is_big_endian = bytes.starts_with("MM");
    BarePicture bare{"tiff", std::move(bytes), 1};
    const Bytes file(bare.bytes, is_big_endian);
    const bool is_bigtiff = file.number(2, 2) == 43;
    const std::size_t directory = is_bigtiff ? file.number(8, 8) : file.number(4, 4);
    const std::size_t count_size = is_bigtiff ? 8 : 2;
    const std::size_t entry_size = is_bigtiff ? 20 : 12;
    const std::uint64_t entries = file.number(directory, count_size);
    if (entries > 4096) refuse("the picture is damaged: too many tags");
    constexpr std::array<std::uint64_t, 12> kept = {254, 256, 257, 258, 259, 262, 266, 273, 274, 277, 278, 279};
    std::optional<std::uint64_t> width, height;
    std::uint64_t renamed = 65000;
    for (std::uint64_t i = 0; i < entries; ++i) {
        const std::size_t entry = directory + count_size + entry_size * i;
        const std::uint64_t tag = file.number(entry, 2);
        const std::uint64_t type = file.number(entry + 2, 2);
        const std::uint64_t value = file.number(entry + entry_size - (is_bigtiff ? 8 : 4), type == 3 ? 2 : 4);
        if (tag == 256) width = value;
        if (tag == 257) height = value;
        if (tag == 274 && value >= 1 && value <= 8) bare.orientation = static_cast<int>(value);
        const bool is_of_pixels = std::find(kept.begin(), kept.end(), tag) != kept.end() ||
                                  (tag >= 284 && tag <= 347) || tag == 530 || tag == 531 || tag == 532;
        if (is_of_pixels) continue;
        const std::uint64_t name = renamed++;
        bare.bytes[entry] = static_cast<char>(is_big_endian ? name >> 8U : name);
        bare.bytes[entry + 1] = static_cast<char>(is_big_endian ? name : name >> 8U);
    }
    if (!width || !height) refuse("the picture is damaged: it has no size");
    check_size(*width, *height, most_pixels);
    return bare;
}

/// Checks the header of a BMP: the library decompresses pixels before it reports their number.
/// Source: Windows, BITMAPFILEHEADER, BITMAPCOREHEADER, BITMAPINFOHEADER and BITMAPV5HEADER.
void check_bmp(const std::string& bytes, std::uint64_t most_pixels) {
    const Bytes file(bytes, false);
    const std::uint64_t header = file.number(14, 4);
    const bool is_core = header == 12;
    // Rows of a negative height go from top to bottom.
    const auto side = [&](std::size_t at) { return std::int64_t{static_cast<std::int32_t>(file.number(at, 4))}; };
    const std::uint64_t width =
        is_core ? file.number(18, 2) : static_cast<std::uint64_t>(std::max<std::int64_t>(side(18), 0));
    const std::uint64_t height = is_core ? file.number(20, 2) : static_cast<std::uint64_t>(std::abs(side(22)));
    constexpr std::array<std::uint64_t, 7> headers = {12, 40, 52, 56, 64, 108, 124};
    const std::uint64_t bits = file.number(is_core ? 24 : 28, 2);
    const std::uint64_t compression = is_core ? 0 : file.number(30, 4);
    constexpr std::array<std::uint64_t, 6> depths = {1, 4, 8, 16, 24, 32};
    if (std::find(headers.begin(), headers.end(), header) == headers.end() ||
        std::find(depths.begin(), depths.end(), bits) == depths.end()) {
        refuse("the picture is damaged: its header is wrong");
    }
    if (compression > 3) refuse("this kind of BMP is not supported");
    check_size(width, height, most_pixels);
}

}  // namespace

void check_size(std::uint64_t width, std::uint64_t height, std::uint64_t most_pixels) {
    if (width == 0 || height == 0) refuse("the picture is damaged: it has no pixels");
    if (width <= most_pixels && height <= most_pixels / width) return;
    throw std::runtime_error("the picture has " + std::to_string(width) + " x " + std::to_string(height) +
                             " pixels; at most " +
                             (most_pixels < 1'000'000 ? std::to_string(most_pixels)
                                                      : std::to_string(most_pixels / 1'000'000) + " million") +
                             " are read");
}

BarePicture bare_picture(std::string bytes, std::uint64_t most_pixels) {
    if (bytes.starts_with("\xFF\xD8\xFF")) return bare_jpeg(bytes, most_pixels);
    if (bytes.starts_with("\x89PNG\r\n\x1A\n")) return bare_png(bytes, most_pixels);
    if (bytes.starts_with("II") || bytes.starts_with("MM")) return bare_tiff(std::move(bytes), most_pixels);
    if (bytes.starts_with("RIFF")) return bare_webp(bytes, most_pixels);
    if (bytes.starts_with("BM")) {
        check_bmp(bytes, most_pixels);
        return {"bmp", std::move(bytes), 1};
    }
    if (bytes.size() >= 8 && bytes.compare(4, 4, "ftyp") == 0) return {"heif", std::move(bytes), 1};
    refuse("not a picture: expected JPEG, PNG, TIFF, WebP, HEIF or BMP");
}

}  // namespace sikku
