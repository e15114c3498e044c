#include "music/score/mxl.h"

#include <zlib.h>

#include <cstdint>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace sikku {
namespace {

constexpr int raw_window_bits = -15;  // deflate without header and checksum
constexpr int most_memory = 9;
constexpr int best_level = 9;

std::string little_endian(std::uint64_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xFF);
    return text;
}

std::string deflated(std::string_view bytes) {
    z_stream stream{};
    if (deflateInit2(&stream, best_level, Z_DEFLATED, raw_window_bits, most_memory, Z_DEFAULT_STRATEGY) != Z_OK) {
        throw std::bad_alloc();
    }
    std::string result;
    std::vector<char> block(std::size_t{1} << 16);
    stream.next_in = const_cast<Bytef*>(reinterpret_cast<const Bytef*>(bytes.data()));
    stream.avail_in = static_cast<uInt>(bytes.size());
    int state = Z_OK;
    while (state == Z_OK) {
        stream.next_out = reinterpret_cast<Bytef*>(block.data());
        stream.avail_out = static_cast<uInt>(block.size());
        state = deflate(&stream, Z_FINISH);
        result.append(block.data(), block.size() - stream.avail_out);
    }
    deflateEnd(&stream);
    return result;
}

/// CRC-32 of ZIP and PNG: polynomial 0xEDB88320.
std::uint32_t checksum(std::string_view bytes) {
    std::uint32_t value = ~std::uint32_t{0};
    for (const char byte : bytes) {
        value ^= static_cast<unsigned char>(byte);
        for (int i = 0; i < 8; ++i) value = (value >> 1) ^ ((value & 1) != 0 ? 0xEDB88320U : 0U);
    }
    return ~value;
}

/// Writes a ZIP archive, an entry after the other.
class Archive {
public:
    explicit Archive(Output& out) : out_(out) {}

    void add(std::string_view name, std::string_view bytes, bool is_deflated) {
        const std::string packed = is_deflated ? deflated(bytes) : std::string(bytes);
        constexpr std::uint64_t first_of_1980 = 0x0021;
        // Names are UTF-8 (bit 11).
        const std::string facts = little_endian(20, 2) + little_endian(0x0800, 2) +
                                  little_endian(is_deflated ? 8 : 0, 2) + little_endian(0, 2) +
                                  little_endian(first_of_1980, 2) + little_endian(checksum(bytes), 4) +
                                  little_endian(packed.size(), 4) + little_endian(bytes.size(), 4) +
                                  little_endian(name.size(), 2) + little_endian(0, 2);
        directory_ += "PK\x01\x02" + little_endian(20, 2) + facts + little_endian(0, 2) + little_endian(0, 2) +
                      little_endian(0, 2) + little_endian(0, 4) + little_endian(size_, 4);
        directory_ += name;
        ++entries_;
        put("PK\x03\x04" + facts);
        put(name);
        put(packed);
    }

    void finish() {
        const std::uint64_t begin = size_;
        const std::uint64_t bytes = directory_.size();
        put(directory_);
        put("PK\x05\x06" + little_endian(0, 4) + little_endian(entries_, 2) + little_endian(entries_, 2) +
            little_endian(bytes, 4) + little_endian(begin, 4) + little_endian(0, 2));
    }

private:
    void put(std::string_view bytes) {
        size_ += bytes.size();
        out_.write(bytes);
    }

    Output& out_;
    std::string directory_;
    std::uint64_t size_ = 0;
    std::uint64_t entries_ = 0;
};

}  // namespace

void write_mxl(std::string_view musicxml, Output& out) {
    if (musicxml.size() > std::numeric_limits<std::uint32_t>::max() / 2) {
        throw std::runtime_error("a score of more than 2 GB does not fit into an .mxl file");
    }
    Archive archive(out);
    archive.add("META-INF/container.xml",
                "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<container>\n<rootfiles>\n"
                "<rootfile full-path=\"score.musicxml\" media-type=\"application/vnd.recordare.musicxml+xml\"/>\n"
                "</rootfiles>\n</container>\n",
                false);
    const std::size_t begin = musicxml.find("<miscellaneous>");
    const std::size_t end = musicxml.find("</miscellaneous>");
    if (begin < end && end != std::string_view::npos) {
        archive.add("META-INF/pattern.xml",
                    musicxml.substr(begin, end - begin + std::string_view("</miscellaneous>").size()), false);
    }
    archive.add("score.musicxml", musicxml, true);
    archive.finish();
}

}  // namespace sikku
