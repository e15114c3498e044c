#include "engine/base/base64.h"

#include <algorithm>
#include <array>

namespace sikku {

std::string_view base64_letters(Base64 form) {
    return form == Base64::url ? "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"
                               : "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
}

std::string to_base64(std::string_view bytes, Base64 form) {
    const std::string_view letters = base64_letters(form);
    std::string text;
    text.reserve((bytes.size() / 3 + 1) * 4);
    for (std::size_t at = 0; at < bytes.size(); at += 3) {
        const std::size_t count = std::min<std::size_t>(bytes.size() - at, 3);
        std::uint32_t group = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            group = group << 8 | (i < count ? static_cast<unsigned char>(bytes[at + i]) : 0U);
        }
        for (std::size_t i = 0; i <= count; ++i) text += letters[group >> (18 - 6 * i) & 63U];
        if (form == Base64::padded) text.append(3 - count, '=');
    }
    return text;
}

std::optional<std::string> from_base64(std::string_view text, Base64 form) {
    constexpr std::uint8_t none = 64;
    std::array<std::uint8_t, 256> values{};
    values.fill(none);
    const std::string_view letters = base64_letters(form);
    for (std::size_t i = 0; i < letters.size(); ++i) {
        values[static_cast<unsigned char>(letters[i])] = static_cast<std::uint8_t>(i);
    }
    if (form == Base64::padded) {
        if (text.size() % 4 != 0) return std::nullopt;
        for (int i = 0; i < 2 && text.ends_with('='); ++i) text.remove_suffix(1);
    }
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3 + 3);
    std::uint32_t group = 0;
    int bits = 0;
    for (const char letter : text) {
        const std::uint8_t value = values[static_cast<unsigned char>(letter)];
        if (value == none) return std::nullopt;
        group = (group << 6 | value) & 0xFFFFFFU;
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes += static_cast<char>(group >> bits & 255U);
    }
    // Rejects a single last letter, and nonzero bits after the last byte.
    if (text.size() % 4 == 1 || (group & ((1U << bits) - 1)) != 0) return std::nullopt;
    return bytes;
}

}  // namespace sikku
