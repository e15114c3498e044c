// engine/base/characters.h: characters of ASCII in any locale.
#pragma once

namespace sikku {

constexpr bool is_digit(char byte) {
    return byte >= '0' && byte <= '9';
}
constexpr bool is_letter(char byte) {
    return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z');
}
constexpr bool is_letter_or_digit(char byte) {
    return is_letter(byte) || is_digit(byte);
}
/// True for a blank and a tab.
constexpr bool is_blank(char byte) {
    return byte == ' ' || byte == '\t';
}
/// True for a byte within a character of UTF-8.
constexpr bool is_continuation(char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0) == 0x80;
}

}  // namespace sikku
