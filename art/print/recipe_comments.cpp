#include "art/print/recipe_comments.h"

#include <cstdint>

namespace sikku {
namespace {

constexpr std::string_view mark = "sikku:";
constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr std::size_t piece_bytes = 39;  // 52 characters and the mark

std::string encoded(std::string_view bytes) {
    std::string text;
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        std::uint32_t group = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            group = group << 8 | (at + i < bytes.size() ? static_cast<unsigned char>(bytes[at + i]) : 0U);
        }
        for (std::size_t i = 0; i < 4; ++i) {
            text += at + i > bytes.size() ? '=' : alphabet[group >> (18 - 6 * i) & 63U];
        }
    }
    return text;
}

/// Appends the bytes of one piece; false for letters beyond the alphabet.
bool decode(std::string_view text, std::string& bytes) {
    std::uint32_t group = 0;
    std::size_t bits = 0;
    for (const char letter : text) {
        if (letter == '=') break;
        const std::size_t value = alphabet.find(letter);
        if (value == std::string_view::npos) return false;
        group = group << 6 | static_cast<std::uint32_t>(value);
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes += static_cast<char>(group >> bits & 255U);
    }
    return true;
}

}  // namespace

std::vector<std::string> recipe_comments(std::string_view pattern, std::string_view made) {
    std::vector<std::string> pieces;
    if (pattern.empty() || pattern.size() + made.size() >= most_commented_bytes) return pieces;
    std::string bytes(made);
    bytes += '\0';
    bytes += pattern;
    bytes += '\0';
    for (std::size_t at = 0; at < bytes.size(); at += piece_bytes) {
        pieces.push_back(std::string(mark) + encoded(std::string_view(bytes).substr(at, piece_bytes)));
    }
    return pieces;
}

std::optional<std::pair<std::string, std::string>> read_recipe_comments(std::string_view text) {
    std::string bytes;
    for (std::size_t at = text.find(mark); at != std::string_view::npos; at = text.find(mark, at)) {
        at += mark.size();
        const std::size_t end = text.find_first_not_of(std::string(alphabet) + "=", at);
        if (!decode(text.substr(at, end - at), bytes)) return std::nullopt;
        if (end == std::string_view::npos) break;
        at = end;
    }
    const std::size_t middle = bytes.find('\0');
    if (middle == std::string::npos || bytes.size() < middle + 3) return std::nullopt;
    // A pattern contains no NUL.
    if (bytes.find('\0', middle + 1) != bytes.size() - 1) return std::nullopt;
    return std::pair(bytes.substr(middle + 1, bytes.size() - middle - 2), bytes.substr(0, middle));
}

}  // namespace sikku
