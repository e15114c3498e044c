#include "engine/text.h"

#include "engine/diagnostic.h"

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
    // U+FFFE and U+FFFF are no characters.
    if (text.starts_with("\xEF\xBF\xBE") || text.starts_with("\xEF\xBF\xBF")) return 0;
    return utf8_length(text);
}

}  // namespace

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
        switch (text[i]) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            case '\r':
                result += "&#13;";
                break;  // a parser would turn it into a line feed
            default:
                result.append(text, i, length);
        }
        i += length;
    }
    return result;
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

std::string json_string(std::string_view text) {
    std::string result = "\"";
    for (const char byte : text) {
        if (byte == '"' || byte == '\\') {
            result += '\\';
            result += byte;
        } else if (static_cast<unsigned char>(byte) < 0x20) {
            result += "\\u00" + to_hex(std::string_view(&byte, 1));
        } else {
            result += byte;
        }
    }
    return result + '"';
}

}  // namespace sikku
