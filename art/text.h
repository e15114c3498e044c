// art/text.h: what several files here do with texts.
#pragma once

#include <string>
#include <string_view>

namespace sikku {

/// ASCII letters in lower case, whatever the locale; other bytes as they are.
inline std::string lower_case(std::string_view text) {
    std::string result(text);
    for (char& byte : result) {
        if (byte >= 'A' && byte <= 'Z') byte = static_cast<char>(byte - 'A' + 'a');
    }
    return result;
}

}  // namespace sikku
