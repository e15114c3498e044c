#include "art/pdf_provenance.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace sikku {
namespace {

/// A pattern is at most 64 MB long, and UTF-16 in hexadecimal digits four times as long; the title may be as long.
constexpr std::uint64_t most_dictionary_bytes = std::uint64_t{640} << 20;
/// The table has 20 bytes for each object, of which a print has a few for each layer.
constexpr std::uint64_t most_table_bytes = std::uint64_t{64} << 20;
constexpr std::size_t entry_bytes = 20;

using Texts = std::map<std::string, std::string, std::less<>>;

/// The bytes from `begin` up to `end`, or fewer where the file has no more.
std::string read_bytes(std::ifstream& stream, std::uint64_t begin, std::uint64_t end) {
    std::string bytes(static_cast<std::size_t>(end - begin), '\0');
    stream.clear();
    stream.seekg(static_cast<std::streamoff>(begin));
    stream.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(stream.gcount()));
    return bytes;
}

std::optional<std::uint64_t> number_at(std::string_view text, std::size_t at) {
    std::uint64_t number = 0;
    if (at > text.size()) return std::nullopt;
    const auto error = std::from_chars(text.data() + at, text.data() + text.size(), number).ec;
    return error == std::errc() ? std::optional(number) : std::nullopt;
}

/// The number after the last `mark`.
std::optional<std::uint64_t> number_after(std::string_view text, std::string_view mark) {
    const std::size_t at = text.rfind(mark);
    return at == std::string_view::npos ? std::nullopt : number_at(text, at + mark.size());
}

void append_utf8(std::uint32_t code, std::string& text) {
    const auto put = [&](std::uint32_t byte) { text += static_cast<char>(static_cast<unsigned char>(byte)); };
    if (code < 0x80) return put(code);
    if (code < 0x800) {
        put(0xC0 | code >> 6);
    } else {
        if (code < 0x10000) {
            put(0xE0 | code >> 12);
        } else {
            put(0xF0 | code >> 18);
            put(0x80 | (code >> 12 & 0x3F));
        }
        put(0x80 | (code >> 6 & 0x3F));
    }
    put(0x80 | (code & 0x3F));
}

/// The bytes of the string in parentheses that begins at `at`, which moves behind its end.
std::optional<std::string> read_literal(std::string_view text, std::size_t& at) {
    constexpr std::string_view names = "nrtbf";
    constexpr std::string_view meanings = "\n\r\t\b\f";
    std::string bytes;
    int depth = 1;
    for (++at; at < text.size(); ++at) {
        if (text[at] == ')' && --depth == 0) {
            ++at;
            return bytes;
        }
        if (text[at] == '(') ++depth;
        if (text[at] != '\\') {
            bytes += text[at];
            continue;
        }
        if (++at == text.size()) break;
        if (const std::size_t name = names.find(text[at]); name != std::string_view::npos) {
            bytes += meanings[name];
        } else if (text[at] >= '0' && text[at] <= '7') {
            unsigned byte = 0;
            const std::size_t end = std::min(at + 3, text.size());
            for (; at < end && text[at] >= '0' && text[at] <= '7'; ++at) {
                byte = byte * 8 + static_cast<unsigned>(text[at] - '0');
            }
            bytes += static_cast<char>(static_cast<unsigned char>(byte));
            --at;
        } else if (text[at] != '\n') {  // which continues a line
            bytes += text[at];
        }
    }
    return std::nullopt;
}

/// The bytes of the string in hexadecimal digits that begins at `at`, which moves behind its end.
std::optional<std::string> read_hexadecimal(std::string_view text, std::size_t& at) {
    const std::size_t end = text.find('>', at);
    if (text[at] != '<' || end == std::string_view::npos) return std::nullopt;
    const std::string_view digits = text.substr(at + 1, end - at - 1);
    at = end + 1;
    if (digits.size() % 2 != 0) return std::nullopt;
    std::string bytes;
    bytes.reserve(digits.size() / 2);
    for (std::size_t i = 0; i < digits.size(); i += 2) {
        unsigned byte = 0;
        const char* const stop = digits.data() + i + 2;
        const auto [stopped, error] = std::from_chars(digits.data() + i, stop, byte, 16);
        if (error != std::errc() || stopped != stop) return std::nullopt;
        bytes += static_cast<char>(static_cast<unsigned char>(byte));
    }
    return bytes;
}

/// A text string in UTF-8: it is ASCII, or UTF-16 after a byte order mark.
std::optional<std::string> decoded(std::string bytes) {
    if (!bytes.starts_with("\xFE\xFF")) {
        const bool ascii = std::all_of(bytes.begin(), bytes.end(),
                                       [](char byte) { return static_cast<unsigned char>(byte) < 0x80; });
        return ascii ? std::optional(std::move(bytes)) : std::nullopt;
    }
    if (bytes.size() % 2 != 0) return std::nullopt;
    const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(static_cast<unsigned char>(bytes[i])); };
    std::string text;
    std::uint32_t high = 0;  // the first half of a pair, while the second is awaited
    for (std::size_t i = 2; i < bytes.size(); i += 2) {
        const std::uint32_t unit = byte(i) << 8 | byte(i + 1);
        const bool is_second = unit >= 0xDC00 && unit < 0xE000;
        if (is_second != (high != 0)) return std::nullopt;
        if (unit >= 0xD800 && unit < 0xDC00) {
            high = unit;
            continue;
        }
        append_utf8(is_second ? 0x10000 + ((high - 0xD800) << 10) + (unit - 0xDC00) : unit, text);
        high = 0;
    }
    return high == 0 ? std::optional(std::move(text)) : std::nullopt;
}

/// The texts of the object in the writer's layout: a dictionary of strings.
std::optional<Texts> read_texts(std::string_view object) {
    Texts texts;
    constexpr std::string_view head = " 0 obj\n<< ";
    std::size_t at = object.find(head);
    if (at == std::string_view::npos || at > 20) return std::nullopt;
    for (at += head.size(); at < object.size() && object[at] == '/'; ++at) {
        const std::size_t blank = std::min(object.find(' ', at), object.size());
        std::string name(object.substr(at + 1, blank - at - 1));
        at = blank + 1;
        if (at >= object.size()) return std::nullopt;
        auto bytes = object[at] == '(' ? read_literal(object, at) : read_hexadecimal(object, at);
        auto text = bytes ? decoded(std::move(*bytes)) : std::nullopt;
        if (!text) return std::nullopt;
        texts.emplace(std::move(name), std::move(*text));
    }
    return object.substr(std::min(at, object.size())).starts_with(">>") ? std::optional(std::move(texts))
                                                                        : std::nullopt;
}

}  // namespace

std::optional<Provenance> pdf_provenance(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary | std::ios::ate);
    const std::streamoff length = stream ? static_cast<std::streamoff>(stream.tellg()) : -1;
    if (length <= 0) return std::nullopt;
    const auto size = static_cast<std::uint64_t>(length);
    const std::string end = read_bytes(stream, size - std::min<std::uint64_t>(size, 64), size);
    const auto table_at = number_after(end, "startxref\n");
    if (!table_at || *table_at >= size || size - *table_at > most_table_bytes) return std::nullopt;

    const std::string table = read_bytes(stream, *table_at, size);
    const auto number = number_after(table, " /Info ");
    if (!number || *number > table.size() || !table.starts_with("xref\n0 ")) return std::nullopt;
    const std::size_t entries = table.find('\n', std::string_view("xref\n").size()) + 1;
    const auto begin = number_at(table, entries + entry_bytes * static_cast<std::size_t>(*number));
    // The texts are the last object before the table.
    if (!begin || *begin >= *table_at || *table_at - *begin > most_dictionary_bytes) return std::nullopt;

    const auto texts = read_texts(read_bytes(stream, *begin, *table_at));
    if (!texts) return std::nullopt;
    const auto creator = texts->find("Creator");
    const auto pattern = texts->find("SikkuPattern");
    const auto made = texts->find("Subject");
    if (creator == texts->end() || creator->second != "Sikku" || pattern == texts->end()) return std::nullopt;
    return Provenance{pattern->second, made == texts->end() ? std::string() : made->second};
}

}  // namespace sikku
