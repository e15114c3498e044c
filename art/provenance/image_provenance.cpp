// art/provenance/image_provenance.cpp: finds the texts in the heads of PNG, TIFF, JPEG and EXR files without decoding
// pixels.
#include "art/provenance/provenance_readers.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <utility>

namespace sikku {
namespace {

using namespace std::string_view_literals;

/// Maximum number of chunks, segments and attributes before the texts; the program writes fewer than 30.
constexpr int most_chunks = 10'000;

std::uint64_t number(std::string_view bytes, bool is_little_endian) {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        value = value << 8 | static_cast<unsigned char>(bytes[is_little_endian ? bytes.size() - 1 - i : i]);
    }
    return value;
}

/// Text fields end at the first NUL.
void cut_at_nul(std::string& text) {
    text.resize(std::min(text.find('\0'), text.size()));
}

// --- PNG ----------------------------------------------------------------------------------------------------------

/// True if the checksum of the chunk whose type begins at `at` is correct.
bool has_png_checksum([[maybe_unused]] const InputFile& file, [[maybe_unused]] std::uint64_t at,
                      [[maybe_unused]] std::uint64_t size) {
#ifdef FUZZING_BUILD_MODE_UNSAFE_FOR_PRODUCTION
    return true;  // a fuzzer cannot guess it
#else
    uLong sum = crc32(0, nullptr, 0);
    InputStream bytes(file, at, at + size);
    for (std::string_view block; !(block = bytes.ahead()).empty(); bytes.skip(block.size())) {
        sum = crc32(sum, reinterpret_cast<const Bytef*>(block.data()), static_cast<uInt>(block.size()));
    }
    return number(file.read(at + size, 4), false) == sum;
#endif
}

/// Decompresses a zlib stream.
std::string inflated(InputStream& packed) {
    struct Inflater : z_stream {
        Inflater() : z_stream{} {
            if (inflateInit(this) != Z_OK) throw std::bad_alloc();
        }
        ~Inflater() { inflateEnd(this); }
        Inflater(const Inflater&) = delete;
        Inflater& operator=(const Inflater&) = delete;
    } stream;
    std::string text;
    std::array<char, std::size_t{1} << 16> block;
    for (int state = Z_OK; state != Z_STREAM_END;) {
        const std::string_view bytes = packed.ahead();
        std::string input(bytes);
        stream.next_in = reinterpret_cast<Bytef*>(input.data());
        stream.avail_in = static_cast<uInt>(input.size());
        stream.next_out = reinterpret_cast<Bytef*>(block.data());
        stream.avail_out = static_cast<uInt>(block.size());
        state = inflate(&stream, Z_NO_FLUSH);
        if (state != Z_OK && state != Z_STREAM_END) refuse_damaged();
        packed.skip(input.size() - stream.avail_in);
        append_text(text, {block.data(), block.size() - stream.avail_out});
    }
    return text;
}

/// The text of the tEXt, zTXt or iTXt chunk with these contents; its keyword was read already.
std::string png_text(std::string_view type, InputStream& chunk) {
    bool is_packed = type == "zTXt";
    if (type == "iTXt") {
        const int flag = chunk.take();
        if (flag != 0 && flag != 1) refuse_damaged();
        is_packed = flag == 1;
    }
    if (type != "tEXt" && chunk.take() != 0) refuse_damaged();  // the only compression method
    if (type == "iTXt") {
        for (int i = 0; i < 2; ++i) {  // the language, and the keyword in it
            if (!chunk.skip_past("\0"sv)) refuse_damaged();
        }
    }
    if (is_packed) return inflated(chunk);
    std::string text;
    for (std::string_view bytes; !(bytes = chunk.ahead()).empty(); chunk.skip(bytes.size())) append_text(text, bytes);
    return text;
}

// --- TIFF ---------------------------------------------------------------------------------------------------------

/// A part of a file that counts its bytes from its own beginning, as TIFF does within JPEG.
struct Part {
    const InputFile& file;
    std::uint64_t begin = 0, end = 0;

    /// Reads exactly `count` bytes.
    std::string read(std::uint64_t at, std::uint64_t count) const {
        if (at > end - begin || count > end - begin - at) refuse_damaged();
        std::string bytes = file.read(begin + at, count);
        if (bytes.size() != count) refuse_damaged();
        return bytes;
    }
};

/// The texts in the first directory, of which each may be missing.
Provenance read_directory(const Part& part) {
    const std::string head = part.read(0, 8);
    const bool little = head[0] == 'I';
    const bool is_big = number(head.substr(2, 2), little) == 43;  // BigTIFF: numbers of 8 bytes
    const std::size_t width = is_big ? 8 : 4;
    const std::uint64_t directory = number(is_big ? part.read(8, 8) : head.substr(4, 4), little);
    const std::size_t count_bytes = is_big ? 8 : 2;
    const std::uint64_t count = number(part.read(directory, count_bytes), little);
    if (count > 65'535) refuse_damaged();
    const std::size_t entry_bytes = 4 + 2 * width;
    const std::string entries = part.read(directory + count_bytes, count * entry_bytes);
    Provenance found;
    bool has_pattern = false, has_made = false;
    for (std::size_t at = 0; at < entries.size(); at += entry_bytes) {
        const std::string_view entry = std::string_view(entries).substr(at, entry_bytes);
        const std::uint64_t tag = number(entry.substr(0, 2), little);
        constexpr std::uint64_t image_description = 270, software = 305, ascii = 2;
        if ((tag != image_description && tag != software) || number(entry.substr(2, 2), little) != ascii) continue;
        std::string& text = tag == software ? found.made : found.pattern;
        // Read each text only once, even if it is empty: an untrusted file may contain it 65,535 times.
        if (std::exchange(tag == software ? has_made : has_pattern, true)) continue;
        const std::uint64_t length = number(entry.substr(4, width), little);
        const std::string_view value = entry.substr(4 + width);
        require_length(length);
        text = length <= width ? std::string(value.substr(0, length)) : part.read(number(value, little), length);
        cut_at_nul(text);
    }
    return found;
}

}  // namespace

std::optional<Provenance> read_png_provenance(const InputFile& file) {
    std::optional<std::string> description, software;
    std::uint64_t at = 8;
    for (int i = 0; i < most_chunks && !(description && software); ++i) {
        const std::string head = file.read(at, 8);
        if (head.size() < 8) refuse_damaged();
        const std::uint64_t size = number(head.substr(0, 4), false);
        const std::string type = head.substr(4);
        // The writer puts texts before pixels.
        if (type == "IDAT" || type == "IEND") break;
        if (type == "tEXt" || type == "zTXt" || type == "iTXt") {
            const std::string start = file.read(at + 8, std::min<std::uint64_t>(size, 80));
            const std::string keyword = start.substr(0, start.find('\0'));
            std::optional<std::string>* text = keyword == "Description" ? &description
                                               : keyword == "Software"  ? &software
                                                                        : nullptr;
            if (text && !*text) {
                require_length(size - std::min<std::uint64_t>(size, 80));
                if (keyword.size() >= size || !has_png_checksum(file, at + 4, size + 4)) refuse_damaged();
                InputStream chunk(file, at + 8 + keyword.size() + 1, at + 8 + size);
                *text = png_text(type, chunk);
                cut_at_nul(**text);
            }
        }
        at += 12 + size;
    }
    if (!description) return std::nullopt;
    return Provenance{std::move(*description), std::move(software).value_or("")};
}

std::optional<Provenance> read_tiff_provenance(const InputFile& file) {
    return read_directory({file, 0, file.size()});
}

std::optional<Provenance> read_jpeg_provenance(const InputFile& file) {
    bool has_exif = false;
    Provenance found;
    std::string comment;
    std::uint64_t at = 2;
    for (int i = 0; i < most_chunks; ++i) {
        const std::string head = file.read(at, 4);
        if (head.size() < 4 || head[0] != '\xFF') refuse_damaged();
        const auto marker = static_cast<unsigned char>(head[1]);
        constexpr unsigned char fill = 0xFF, scan = 0xDA, end = 0xD9, application_1 = 0xE1, remark = 0xFE;
        if (marker == scan || marker == end) break;
        if (marker == fill) {
            ++at;
            continue;
        }
        const std::uint64_t size = number(head.substr(2), false);  // with its own two bytes
        if (size < 2) refuse_damaged();
        const std::uint64_t begin = at + 4;
        const Part segment{file, begin, begin + size - 2};
        at += 2 + size;
        constexpr std::string_view exif = "Exif\0\0"sv;
        if (marker == application_1 && !has_exif &&
            file.read(begin, std::min<std::uint64_t>(size - 2, exif.size())) == exif) {
            found = read_directory({file, begin + exif.size(), segment.end});
            has_exif = true;
            if (!found.pattern.empty()) break;
        } else if (marker == remark && comment.empty()) {
            comment = segment.read(0, size - 2);
            cut_at_nul(comment);
        }
    }
    if (found.pattern.empty()) found.pattern = std::move(comment);
    return found;
}

std::optional<Provenance> read_exr_provenance(const InputFile& file) {
    std::optional<std::string> comments, software;
    std::uint64_t at = 8;
    for (int i = 0; i < most_chunks && !(comments && software); ++i) {
        // Name, type, size, value; names have up to 255 bytes.
        const std::string head = file.read(at, 520);
        if (head.starts_with('\0')) break;
        const std::size_t name_end = head.find('\0');
        const std::size_t type_end = head.find('\0', name_end + 1);
        if (name_end == std::string::npos || type_end == std::string::npos || head.size() - type_end < 5) {
            refuse_damaged();
        }
        const std::string name = head.substr(0, name_end);
        const std::string type = head.substr(name_end + 1, type_end - name_end - 1);
        const std::uint64_t size = number(head.substr(type_end + 1, 4), true);
        at += type_end + 5;
        if (type == "string" && (name == "comments" || name == "Software")) {
            require_length(size);
            const Part value{file, at, file.size()};
            auto& text = name == "comments" ? comments : software;
            if (text) refuse_damaged();  // the format allows each attribute only once
            text = value.read(0, size);
            cut_at_nul(*text);
        }
        at += size;
    }
    if (!comments) return std::nullopt;
    return Provenance{std::move(*comments), std::move(software).value_or("")};
}

}  // namespace sikku
