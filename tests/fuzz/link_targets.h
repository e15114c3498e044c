// tests/fuzz/link_targets.h: fuzz targets that read arbitrary bytes as a link and as the contents of one.
#pragma once

#include "art/link/link.h"
#include "tests/fuzz/file_targets.h"

#include <string>
#include <string_view>

namespace sikku {

inline std::string base64url(std::string_view bytes) {
    constexpr std::string_view alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_";
    std::string text;
    unsigned group = 0;
    int bits = 0;
    for (const char byte : bytes) {
        group = (group << 8 | static_cast<unsigned char>(byte)) & 0xFFFFFU;
        for (bits += 8; bits >= 6; bits -= 6) text += alphabet[group >> (bits - 6) & 63U];
    }
    if (bits > 0) text += alphabet[group << (6 - bits) & 63U];
    return text;
}

/// Reads a link, and checks that its contents make an equivalent link.
inline void try_link(std::string_view link) {
    try {
        is_link(link);
        const SharedWork work = read_link(link);
        must(shared_json(read_link(link_of(work))) == shared_json(work), "a work does not come back");
        must_be_plain(work.name, "a name");
    } catch (const LinkError& error) {
        const std::string_view what = error.what();
        must(!what.empty() && what.find('\n') == std::string_view::npos, "an error is one line");
        must_be_plain(what, "an error");
    }
}

/// Reads the bytes as the contents of a link, compressed or not yet compressed.
inline void try_contents(std::string_view bytes) {
    try_link("#sikku1." + base64url(bytes));
    // Stored blocks of deflate leave the bytes visible to the fuzzer.
    std::string stored;
    constexpr std::size_t most = 0xFFFF;
    for (std::size_t at = 0; at <= bytes.size(); at += most) {
        const std::string_view block = bytes.substr(at, most);
        const auto size = static_cast<unsigned>(block.size());
        stored += at + most > bytes.size() ? '\1' : '\0';
        for (const unsigned number : {size, ~size}) {
            stored += static_cast<char>(number & 0xFFU);
            stored += static_cast<char>(number >> 8 & 0xFFU);
        }
        stored += block;
    }
    try_link("sikku1." + base64url(stored));
}

}  // namespace sikku
