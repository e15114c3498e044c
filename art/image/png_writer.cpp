#include "art/image/png_writer.h"

#include "art/image/profiles.h"
#include "art/image/row_deflate.h"
#include "engine/base/threads.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace sikku {
namespace {

// Blocks do not refer to each other, so that they can be compressed at once; larger ones save less than 1 %.
constexpr std::size_t block_bytes = std::size_t{1} << 20U;
constexpr std::uint32_t adler_modulus = 65521;

[[noreturn]] void fail() {
    throw std::runtime_error(std::generic_category().message(errno));
}

const Bytef* bytes_of(std::string_view text) {
    return reinterpret_cast<const Bytef*>(text.data());
}

void append_number(std::string& bytes, std::uint32_t number) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> static_cast<unsigned>(shift));
}

/// A chunk with its length and checksum.
std::string chunk(std::string_view type, std::string_view content) {
    std::string bytes;
    bytes.reserve(content.size() + 12);
    append_number(bytes, static_cast<std::uint32_t>(content.size()));
    bytes += type;
    bytes += content;
    const std::string_view body = std::string_view(bytes).substr(4);
    append_number(bytes, static_cast<std::uint32_t>(crc32(0, bytes_of(body), static_cast<uInt>(body.size()))));
    return bytes;
}

/// Text in ASCII, or as an iTXt chunk in UTF-8; neither is compressed.
std::string text_chunk(std::string_view keyword, const std::string& text) {
    if (text.empty()) return {};
    const bool is_ascii =
        std::all_of(text.begin(), text.end(), [](char byte) { return static_cast<unsigned char>(byte) < 0x80; });
    return chunk(is_ascii ? "tEXt" : "iTXt", std::string(keyword) + std::string(is_ascii ? 1 : 5, '\0') + text);
}

/// The checksum of two texts, of which the second has that checksum and length (RFC 1950, section 9).
std::uint32_t adler_of_both(std::uint32_t first, std::uint32_t second, std::size_t length) {
    const std::uint64_t rest = length % adler_modulus;
    const std::uint64_t low = (first & 0xFFFFU) + (second & 0xFFFFU) + adler_modulus - 1;
    const std::uint64_t high = rest * (first & 0xFFFFU) + (first >> 16U) + (second >> 16U) + adler_modulus - rest;
    return static_cast<std::uint32_t>(low % adler_modulus | (high % adler_modulus) << 16U);
}

/// The first bytes of a zlib stream (RFC 1950): deflate with a window of 32 kB, and the level.
std::string stream_header(int level) {
    return {'\x78', level < 2 ? '\x01' : level < 6 ? '\x5E' : level == 6 ? '\x9C' : '\xDA'};
}

/// A complete zlib stream.
std::string zlib_stream(std::string_view bytes) {
    constexpr int best_level = 9;
    std::string packed = stream_header(best_level);
    RowDeflater(best_level, 1).compress(bytes, true, packed);
    append_number(packed, adler32_of(1, bytes));
    return packed;
}

/// Rows in the form in which they are compressed, and the result. Blocks are reused.
struct Block {
    explicit Block(int level, std::size_t pixel_bytes) : deflater(level, pixel_bytes) {}

    std::string
        rows;  ///< each after the number of its filter, 0: drawings repeat pixels, and filters make them larger
    bool is_last = false;
    std::string packed;          ///< an IDAT chunk, without the checksum of all blocks
    std::uint32_t checksum = 1;  ///< of the rows
    RowDeflater deflater;

    void compress() {
        deflater.compress(rows, is_last, packed);
        checksum = adler32_of(1, rows);
    }
};

class PngWriter final : public ImageWriter {
public:
    PngWriter(const std::filesystem::path& path, const ImageSpec& spec)
        : file_(std::fopen(path.c_str(), "wb"), &std::fclose),
          stride_(static_cast<std::size_t>(spec.width) * static_cast<std::size_t>(spec.channels)),
          rows_left_(static_cast<std::size_t>(spec.height)),
          pixel_bytes_(static_cast<std::size_t>(spec.channels)),
          level_(spec.compression) {
        if (!file_) fail();
        write("\x89PNG\r\n\x1A\n");
        std::string header;
        append_number(header, static_cast<std::uint32_t>(spec.width));
        append_number(header, static_cast<std::uint32_t>(spec.height));
        constexpr std::array<char, 5> colour_types = {0, 0, 0, 2, 6};
        header += {8, colour_types[static_cast<std::size_t>(spec.channels)], 0, 0, 0};
        write(chunk("IHDR", header));
        if (spec.icc) {
            const std::string_view profile = spec.channels < 3 ? grey_profile() : srgb_profile();
            write(chunk("iCCP", std::string("ICC profile") + std::string(2, '\0') + zlib_stream(profile)));
        } else {
            write(chunk("sRGB", std::string(1, '\0')));
        }
        std::string density;
        const auto per_metre = static_cast<std::uint32_t>(std::lround(spec.dpi / 0.0254));
        append_number(density, per_metre);
        append_number(density, per_metre);
        write(chunk("pHYs", density + '\1'));
        write(text_chunk("Title", spec.title));
        write(text_chunk("Description", spec.description));
        write(text_chunk("Software", spec.software));
    }

    void rows(int /*first_row*/, int rows, std::span<const std::uint8_t> pixels) override {
        for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row) {
            if (used_ == 0 || blocks_[used_ - 1].rows.size() + stride_ >= block_bytes) begin_block();
            std::string& text = blocks_[used_ - 1].rows;
            text += '\0';
            text.append(reinterpret_cast<const char*>(pixels.data()) + row * stride_, stride_);
            --rows_left_;
        }
    }

    void close() override {
        if (rows_left_ > 0) throw std::logic_error("rows of the picture are missing");
        if (used_ > 0) blocks_[used_ - 1].is_last = true;
        write_blocks();
        std::string checksum;
        append_number(checksum, checksum_);
        write(chunk("IDAT", checksum));
        write(chunk("IEND", {}));
        if (std::fclose(file_.release()) != 0) fail();
    }

private:
    void write(std::string_view bytes) {
        if (std::fwrite(bytes.data(), 1, bytes.size(), file_.get()) != bytes.size()) fail();
    }

    /// Keeps two blocks for each of several threads.
    void begin_block() {
        const auto threads = static_cast<std::size_t>(available_threads());
        if (used_ >= (threads > 1 ? 2 * threads : 1)) write_blocks();
        if (used_ == blocks_.size()) blocks_.emplace_back(level_, pixel_bytes_);
        Block& block = blocks_[used_++];
        block.rows.clear();
        block.rows.reserve(std::max(std::min(block_bytes, rows_left_ * (stride_ + 1)), stride_ + 1));
        block.packed = std::exchange(is_first_, false) ? stream_header(level_) : std::string();
    }

    void write_blocks() {
        for_each_index(used_, [&](std::size_t i) { blocks_[i].compress(); });
        for (std::size_t i = 0; i < used_; ++i) {
            const Block& block = blocks_[i];
            write(chunk("IDAT", block.packed));
            checksum_ = adler_of_both(checksum_, block.checksum, block.rows.size());
        }
        used_ = 0;
    }

    std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
    std::size_t stride_;     ///< bytes of a row
    std::size_t rows_left_;  ///< rows that have not come yet
    std::size_t pixel_bytes_;
    int level_;
    bool is_first_ = true;
    std::uint32_t checksum_ = 1;  ///< of the blocks that were written
    std::vector<Block> blocks_;
    std::size_t used_ = 0;  ///< blocks with rows
};

}  // namespace

std::unique_ptr<ImageWriter> open_png(const std::filesystem::path& path, const ImageSpec& spec) {
    if (!spec.cmyk.empty() || spec.bits != 8) {
        throw std::runtime_error("only TIFF supports CMYK and one bit per channel");
    }
    if (spec.width < 1 || spec.height < 1) throw std::runtime_error("a picture has at least one pixel");
    constexpr std::uint64_t most_row = std::numeric_limits<std::int32_t>::max() / 2;
    if (static_cast<std::uint64_t>(spec.width) * static_cast<std::uint64_t>(spec.channels) > most_row) {
        throw std::runtime_error("a row of a PNG has at most a thousand million bytes");
    }
    return std::make_unique<PngWriter>(path, spec);
}

}  // namespace sikku
