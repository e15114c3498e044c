#include "music/score/score_formats.h"

#include "engine/base/deflate.h"

#include <zlib.h>

#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>

namespace sikku {
namespace {

std::string little_endian(std::uint64_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xFF);
    return text;
}

/// CRC-32 of ZIP and PNG.
std::uint32_t checksum(std::string_view bytes) {
    return static_cast<std::uint32_t>(
        crc32(0, reinterpret_cast<const Bytef*>(bytes.data()), static_cast<uInt>(bytes.size())));
}

/// Writes a ZIP archive, entry by entry.
class Archive {
public:
    explicit Archive(Output& out) : out_(out) {}

    void add(std::string_view name, std::string_view bytes, bool is_deflated) {
        const std::string packed = is_deflated ? deflated(bytes, Deflate::raw) : std::string(bytes);
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
