#include "art/image/bare_picture.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace sikku {
namespace {

[[noreturn]] void refuse(const char* reason) {
    throw std::runtime_error(reason);
}

/// Numbers in a file; reading past its end refuses it.
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

void check_size(std::uint64_t width, std::uint64_t height, std::uint64_t most_pixels) {
    if (width == 0 || height == 0) refuse("the picture is damaged: it has no pixels");
    if (width <= most_pixels && height <= most_pixels / width) return;
    throw std::runtime_error("the picture has " + std::to_string(width) + " x " + std::to_string(height) +
                             " pixels; at most " + std::to_string(most_pixels / 1'000'000) + " million are read");
}

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
            if (file.number(at + 9, 1) > 4) refuse("not a picture in colours or grey");
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

BarePicture bare_png(const std::string& bytes, std::uint64_t most_pixels) {
    BarePicture bare{"png", bytes.substr(0, 8), 1};
    const Bytes file(bytes, true);
    for (std::size_t at = 8; at < bytes.size();) {
        const std::size_t length = 12 + file.number(at, 4);
        file.number(at, length);
        const std::string_view name = std::string_view(bytes).substr(at + 4, 4);
        if (name == "IHDR") check_size(file.number(at + 8, 4), file.number(at + 12, 4), most_pixels);
        if (name == "IHDR" || name == "PLTE" || name == "tRNS" || name == "IDAT" || name == "IEND") {
            bare.bytes.append(bytes, at, length);
        }
        at += length;
        if (name == "IEND") break;
    }
    return bare;
}

BarePicture bare_webp(const std::string& bytes, std::uint64_t most_pixels) {
    BarePicture bare{"webp", bytes.substr(0, 12), 1};
    const Bytes file(bytes, false);
    for (std::size_t at = 12; at < bytes.size();) {
        const std::size_t length = 8 + file.number(at + 4, 4) + file.number(at + 4, 4) % 2;
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
        }
        at += length;
    }
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

/// The sizes that a HEIF file states (`ispe` boxes).
void check_heif(const std::string& bytes, std::uint64_t most_pixels) {
    const Bytes file(bytes, true);
    for (std::size_t at = bytes.find("ispe"); at != std::string::npos; at = bytes.find("ispe", at + 4)) {
        if (at + 16 > bytes.size()) return;
        check_size(std::max<std::uint64_t>(file.number(at + 8, 4), 1), file.number(at + 12, 4), most_pixels);
        if (at > 1'000'000) return;  // boxes come before pixels
    }
}

}  // namespace

BarePicture bare_picture(std::string bytes, std::uint64_t most_pixels) {
    if (bytes.starts_with("\xFF\xD8\xFF")) return bare_jpeg(bytes, most_pixels);
    if (bytes.starts_with("\x89PNG\r\n\x1A\n")) return bare_png(bytes, most_pixels);
    if (bytes.starts_with("II") || bytes.starts_with("MM")) return bare_tiff(std::move(bytes), most_pixels);
    if (bytes.starts_with("RIFF")) return bare_webp(bytes, most_pixels);
    if (bytes.starts_with("BM")) return {"bmp", std::move(bytes), 1};
    if (bytes.size() >= 8 && bytes.compare(4, 4, "ftyp") == 0) {
        check_heif(bytes, most_pixels);
        return {"heif", std::move(bytes), 1};
    }
    refuse("not a picture: expected JPEG, PNG, TIFF, WebP, HEIF or BMP");
}

}  // namespace sikku
