#include "art/print/recipe_comments.h"

#include "engine/base/base64.h"

namespace sikku {
namespace {

constexpr std::string_view mark = "sikku:";
constexpr std::size_t piece_bytes = 39;  // 52 characters and the mark

}  // namespace

std::vector<std::string> recipe_comments(std::string_view pattern, std::string_view made) {
    std::vector<std::string> pieces;
    if (pattern.empty() || pattern.size() + made.size() >= most_commented_bytes) return pieces;
    std::string bytes(made);
    bytes += '\0';
    bytes += pattern;
    bytes += '\0';
    for (std::size_t at = 0; at < bytes.size(); at += piece_bytes) {
        pieces.push_back(std::string(mark) +
                         to_base64(std::string_view(bytes).substr(at, piece_bytes), Base64::padded));
    }
    return pieces;
}

std::optional<std::pair<std::string, std::string>> read_recipe_comments(std::string_view text) {
    const std::string letters = std::string(base64_letters(Base64::padded)) + "=";
    std::string bytes;
    for (std::size_t at = text.find(mark); at != std::string_view::npos; at = text.find(mark, at)) {
        at += mark.size();
        const std::size_t end = text.find_first_not_of(letters, at);
        const auto piece = from_base64(text.substr(at, end - at), Base64::padded);
        if (!piece) return std::nullopt;
        bytes += *piece;
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
