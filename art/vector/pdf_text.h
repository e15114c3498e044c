// art/vector/pdf_text.h: texts and names as objects of PDF. Source: ISO 32000-1, sections 7.3.4, 7.3.5 and 7.9.2.
#pragma once

#include "engine/base/diagnostic.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>

namespace sikku {

/// Returns a text string: unchanged if it is printable ASCII, else in UTF-16 with a byte order mark.
inline std::string text_string(std::string_view text) {
    const bool plain = std::all_of(text.begin(), text.end(), [](char byte) {
        return (byte >= 0x20 && byte < 0x7F) || byte == '\n' || byte == '\t';
    });
    if (plain) {
        std::string result = "(";
        for (const char byte : text) {
            if (byte == '(' || byte == ')' || byte == '\\') result += '\\';
            result += byte;
        }
        return result + ')';
    }
    std::string result = "<FEFF";
    const auto put = [&result](std::uint32_t unit) { fmt::format_to(std::back_inserter(result), "{:04X}", unit); };
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = utf8_length(text.substr(i));
        const auto byte = [&](std::size_t k) {
            return static_cast<std::uint32_t>(static_cast<unsigned char>(text[k]));
        };
        std::uint32_t code = 0xFFFD;
        if (length > 0) {
            // The first byte begins with as many ones as there are bytes, if there are several.
            code = length == 1 ? byte(i) : byte(i) & (0x7Fu >> length);
            for (std::size_t k = 1; k < length; ++k) code = code << 6 | (byte(i + k) & 0x3F);
        }
        i += std::max<std::size_t>(length, 1);
        if (code >= 0x10000) {
            put(0xD800 + ((code - 0x10000) >> 10));
            put(0xDC00 + ((code - 0x10000) & 0x3FF));
        } else {
            put(code);
        }
    }
    return result + '>';
}

/// Returns a name, with bytes that would end or escape it as #xx.
inline std::string name_object(std::string_view name) {
    std::string result = "/";
    for (const char byte : name) {
        const auto code = static_cast<unsigned char>(byte);
        if (code > 0x20 && code < 0x7F && std::string_view("()<>[]{}/%#").find(byte) == std::string_view::npos) {
            result += byte;
        } else {
            fmt::format_to(std::back_inserter(result), "#{:02X}", code);
        }
    }
    return result;
}

}  // namespace sikku
