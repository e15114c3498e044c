#include "engine/base/text.h"

#include "engine/base/characters.h"
#include "engine/base/diagnostic.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sikku {

std::string lower_case(std::string_view text) {
    std::string result(text);
    for (char& byte : result) {
        if (byte >= 'A' && byte <= 'Z') byte = static_cast<char>(byte - 'A' + 'a');
    }
    return result;
}

namespace {

/// The length of the character at the front of `text` (not empty) if XML 1.0 can hold it, else 0.
std::size_t xml_character(std::string_view text) {
    const auto byte = static_cast<unsigned char>(text.front());
    if (byte < 0x20 && byte != '\t' && byte != '\n' && byte != '\r') return 0;
    // U+FFFE and U+FFFF are not characters.
    if (text.starts_with("\xEF\xBF\xBE") || text.starts_with("\xEF\xBF\xBF")) return 0;
    return utf8_length(text);
}

}  // namespace

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return text;
}

std::string_view take_line(std::string_view& text) {
    const std::string_view line = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(line.size() + 1, text.size()));
    return line;
}

std::string_view take_word(std::string_view& text, std::string_view separators) {
    text.remove_prefix(std::min(text.find_first_not_of(separators), text.size()));
    const std::string_view word = text.substr(0, text.find_first_of(separators));
    text.remove_prefix(word.size());
    return word;
}

std::vector<std::string_view> split_words(std::string_view text, std::string_view separators) {
    std::vector<std::string_view> words;
    while (!text.empty()) {
        if (const std::string_view word = take_word(text, separators); !word.empty()) words.push_back(word);
    }
    return words;
}

bool fits_xml(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = xml_character(text.substr(i));
        if (length == 0) return false;
        i += length;
    }
    return true;
}

std::string xml_escaped(std::string_view text) {
    std::string result;
    result.reserve(text.size());
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = xml_character(text.substr(i));
        if (length == 0) {
            result += "\xEF\xBF\xBD";
            ++i;
            continue;
        }
        // A parser would turn a carriage return into a line feed.
        constexpr std::string_view special = "&<>\"\r";
        constexpr std::array<std::string_view, 5> escapes = {"&amp;", "&lt;", "&gt;", "&quot;", "&#13;"};
        const std::size_t escape = special.find(text[i]);
        result += escape < escapes.size() ? escapes[escape] : text.substr(i, length);
        i += length;
    }
    return result;
}

std::string time_text(double seconds) {
    if (!std::isfinite(seconds)) return "forever";
    if (seconds > 1e10) return fmt::format("{:.3g} years", seconds / 31'556'952);
    if (seconds < 0.9995) return fmt::format("{:.0f} ms", seconds * 1000);
    if (seconds < 59.95) return fmt::format("{:.1f} s", seconds);
    if (seconds < 3599.5) {
        const auto whole = static_cast<long>(std::lround(seconds));
        return fmt::format("{} min {} s", whole / 60, whole % 60);
    }
    return fmt::format("{:.1f} h", seconds / 3600);
}

std::string bytes_text(double bytes) {
    if (bytes < 999.5) return fmt::format("{:.0f} B", bytes);
    if (bytes < 999.5e3) return fmt::format("{:.0f} kB", bytes / 1e3);
    if (bytes < 999.95e6) return fmt::format("{:.1f} MB", bytes / 1e6);
    return fmt::format("{:.1f} GB", bytes / 1e9);
}

std::string to_hex(std::string_view bytes) {
    std::string result;
    result.reserve(2 * bytes.size());
    for (const char byte : bytes) {
        result += "0123456789abcdef"[static_cast<unsigned char>(byte) >> 4];
        result += "0123456789abcdef"[static_cast<unsigned char>(byte) & 15];
    }
    return result;
}

void append_utf8(std::uint32_t code, std::string& text) {
    const unsigned tail = code < 0x80 ? 0 : code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;  // bytes after the first
    constexpr std::array<std::uint32_t, 4> leads = {0, 0xC0, 0xE0, 0xF0};
    text += static_cast<char>(leads[tail] | code >> (6 * tail));
    for (unsigned i = tail; i-- > 0;) text += static_cast<char>(0x80 | (code >> (6 * i) & 0x3F));
}

std::uint32_t code_point(std::string_view character) {
    const auto lead = static_cast<unsigned char>(character.front());
    std::uint32_t code = character.size() == 1 ? lead : lead & (0x7FU >> character.size());
    for (const char byte : character.substr(1)) code = code << 6 | (static_cast<unsigned char>(byte) & 0x3FU);
    return code;
}

std::string plain_json(std::string_view json) {
    std::string result;
    result.reserve(json.size());
    for (std::size_t i = 0; i < json.size(); ++i) {
        const auto code = static_cast<unsigned char>(json[i]);
        const std::string_view rest = json.substr(i);
        const bool is_c1 = rest.size() > 1 && code == 0xC2 && static_cast<unsigned char>(rest[1]) >= 0x80 &&
                           static_cast<unsigned char>(rest[1]) < 0xA0;
        if (code < 0x20 || code == 0x7F) {
            result += "\\u00" + to_hex(rest.substr(0, 1));
        } else if (is_c1) {
            result += "\\u00" + to_hex(rest.substr(1, 1));
            i += 1;
        } else if (rest.starts_with("\xE2\x80\xA8") || rest.starts_with("\xE2\x80\xA9")) {
            result += rest[2] == '\xA8' ? "\\u2028" : "\\u2029";
            i += 2;
        } else {
            result += json[i];
        }
    }
    return result;
}

std::string json_string(std::string_view text) {
    std::string result = "\"";
    for (const char byte : text) {
        if (byte == '"' || byte == '\\') result += '\\';
        result += byte;
    }
    return plain_json(result + '"');
}

std::string counted(std::string_view digits, std::string_view what) {
    return fmt::format("{} {}{}", digits, what, digits == "1" ? "" : "s");
}

std::string readable(std::string digits) {
    constexpr std::size_t most = 40;
    if (digits.size() > most) digits = "about 10^" + std::to_string(digits.size() - 1);
    return digits;
}

std::string did_you_mean(std::span<const std::string_view> names) {
    if (names.empty()) return {};
    std::vector<std::string> quoted;
    for (const std::string_view name : names) quoted.push_back(fmt::format("'{}'", name));
    return fmt::format("; did you mean {}?",
                       alternatives(std::vector<std::string_view>(quoted.begin(), quoted.end())));
}

std::string did_you_mean(std::string_view near) {
    return near.empty() ? std::string() : did_you_mean(std::span(&near, 1));
}

std::string alternatives(std::span<const std::string_view> words) {
    std::string list;
    for (std::size_t i = 0; i < words.size(); ++i) {
        list += i == 0 ? "" : i + 1 < words.size() ? ", " : " or ";
        list += words[i];
    }
    return list;
}

std::string counted(std::uint64_t count, std::string_view what) {
    return counted(std::to_string(count), what);
}

std::string shell_word(const std::string& word) {
    const bool plain = !word.empty() && std::all_of(word.begin(), word.end(), [](char letter) {
        return std::isalnum(static_cast<unsigned char>(letter)) != 0 ||
               std::string_view("/._-+=:,@%").find(letter) != std::string_view::npos;
    });
    if (plain) return word;
    const auto is_control = [](char letter) { return (letter >= 0 && letter < ' ') || letter == 0x7F; };
    if (std::any_of(word.begin(), word.end(), is_control)) {
        std::string text = "$'";
        for (const char letter : word) {
            if (is_control(letter)) {
                text += letter == '\n' ? "\\n" : fmt::format("\\x{:02x}", static_cast<unsigned>(letter));
            } else {
                if (letter == '\'' || letter == '\\') text += '\\';
                text += letter;
            }
        }
        return text + "'";
    }
    std::string text = "'";
    for (const char letter : word) text += letter == '\'' ? std::string("'\\''") : std::string(1, letter);
    return text + "'";
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> earlier(b.size() + 1);
    std::vector<std::size_t> above(b.size() + 1);
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j < row.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        earlier.swap(above);
        above.swap(row);
        row[0] = i;
        for (std::size_t j = 1; j < row.size(); ++j) {
            row[j] = std::min({above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1), above[j] + 1, row[j - 1] + 1});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                row[j] = std::min(row[j], earlier[j - 2] + 1);
            }
        }
    }
    return row.back();
}

}  // namespace sikku
