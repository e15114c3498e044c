#include "tests/damaged_pictures.h"

namespace sikku {

std::string big_endian(std::uint64_t value, int bytes) {
    std::string text;
    for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) text += static_cast<char>(value >> shift & 0xFF);
    return text;
}

std::string little_endian(std::uint64_t value, int bytes) {
    const std::string text = big_endian(value, bytes);
    return {text.rbegin(), text.rend()};
}

std::string heif_box(const std::string& kind, const std::string& content) {
    return big_endian(8 + content.size(), 4) + kind + content;
}

std::string heif_full_box(const std::string& kind, unsigned version, const std::string& content) {
    return heif_box(kind, big_endian(version, 1) + big_endian(0, 3) + content);
}

std::string heif_of_overlays(const std::vector<std::vector<unsigned>>& parts, std::uint32_t side) {
    std::string data, places, references, properties, entries;
    const auto number = [](std::uint64_t value) { return big_endian(value, 2); };
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const std::string item = number(i + 1);
        const bool is_coded = parts[i].empty();
        std::string content;
        if (is_coded) {
            content = big_endian(2, 4) + "\x26\x01";  // the start of a key frame
        } else {
            content = big_endian(1, 2) + std::string(8, '\xFF') + big_endian(side, 4) + big_endian(side, 4);
            content.append(8 * parts[i].size(), '\0');  // at the origin
            std::string list = item + number(parts[i].size());
            for (const unsigned part : parts[i]) list += number(part);
            references += heif_box("dimg", list);
        }
        places +=
            item + number(1) + number(0) + number(1) + big_endian(data.size(), 4) + big_endian(content.size(), 4);
        data += content;
        // Property 1 is the size, which is harmless, 2 the parameters of the coder.
        properties += item + (is_coded ? std::string("\x02\x81\x82") : std::string("\x01\x81"));
        entries += heif_full_box("infe", 2, item + number(0) + (is_coded ? "hvc1" : "iovl") + std::string(1, '\0'));
    }
    using namespace std::string_literals;
    const std::string coder =
        "\x01\x01\x60"s + std::string(9, '\0') + "\x5A\xF0\x00\xFC\xFD\xF8\xF8\x00\x00\x0F\x00"s;
    const std::string meta =
        heif_full_box("hdlr", 0, big_endian(0, 4) + "pict" + std::string(13, '\0')) +
        heif_full_box("pitm", 0, number(1)) + heif_full_box("iinf", 0, number(parts.size()) + entries) +
        heif_full_box("iloc", 1, "\x44\x00"s + number(parts.size()) + places) + heif_full_box("iref", 0, references) +
        heif_box("iprp", heif_box("ipco", heif_full_box("ispe", 0, big_endian(64, 4) + big_endian(64, 4)) +
                                              heif_box("hvcC", coder)) +
                             heif_full_box("ipma", 0, big_endian(parts.size(), 4) + properties)) +
        heif_box("idat", data);
    return heif_box("ftyp", "mif1"s + big_endian(0, 4) + "mif1heic") + heif_full_box("meta", 0, meta);
}

std::string with_stated_size(std::string heif, std::uint32_t width, std::uint32_t height) {
    for (std::size_t at = heif.find("ispe"); at != std::string::npos; at = heif.find("ispe", at + 4)) {
        heif.replace(at + 8, 8, big_endian(width, 4) + big_endian(height, 4));
    }
    return heif;
}

std::string bmp_file(std::int32_t width, std::int32_t height, unsigned compression, const std::string& data,
                     unsigned bits) {
    const unsigned colours = bits <= 8 ? 1U << bits : 0;
    const auto number = [](std::uint64_t value) { return little_endian(value, 4); };
    std::string palette;
    for (unsigned i = 0; i < colours; ++i) palette += number(0x010101U * (i * 255 / (colours - 1)));
    const std::size_t start = 14 + 40 + palette.size();
    return "BM" + number(start + data.size()) + number(0) + number(start) + number(40) +
           number(static_cast<std::uint32_t>(width)) + number(static_cast<std::uint32_t>(height)) +
           little_endian(1, 2) + little_endian(bits, 2) + number(compression) + number(data.size()) + number(2835) +
           number(2835) + number(colours) + number(0) + palette + data;
}

std::string mutated(std::string bytes, std::mt19937& random) {
    const auto below = [&](std::size_t count) {
        return static_cast<std::size_t>(random() % std::max<std::size_t>(count, 1));
    };
    const std::size_t changes = 1 + below(6);
    for (std::size_t i = 0; i < changes && bytes.size() > 8; ++i) {
        // Headers are a small part of the file, and matter most.
        const std::size_t at = below(below(2) == 0 ? std::min<std::size_t>(bytes.size(), 600) : bytes.size());
        const std::size_t length = std::min(1 + below(16), bytes.size() - at);
        switch (below(6)) {
            case 0:
                bytes[at] = static_cast<char>(bytes[at] ^ 1 << below(8));
                break;
            case 1:
                bytes[at] = static_cast<char>(below(256));
                break;
            case 2: {
                constexpr std::uint32_t numbers[] = {0,      1,       2,          64,         0x7FFF,    0x8000,
                                                     0xFFFF, 0x10000, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF};
                const std::uint64_t number = numbers[below(std::size(numbers))];
                bytes.replace(at, std::min<std::size_t>(4, bytes.size() - at),
                              below(2) == 0 ? big_endian(number, 4) : little_endian(number, 4));
                break;
            }
            case 3:
                bytes.erase(at, length);
                break;
            case 4:
                bytes.insert(at, bytes.substr(below(bytes.size()), length));
                break;
            default:
                if (below(8) == 0) bytes.resize(at);
        }
    }
    return bytes;
}

}  // namespace sikku
