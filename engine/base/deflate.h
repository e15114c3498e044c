// engine/base/deflate.h: compression by zlib at its best level.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace sikku {

/// With the header and checksum of zlib (RFC 1950), or without (RFC 1951).
enum class Deflate : std::uint8_t { zlib, raw };

/// @throws std::bad_alloc
std::string deflated(std::string_view bytes, Deflate format);

/// @param most  maximum size of the result
/// @throws std::length_error if it would be larger; std::runtime_error if `packed` is damaged or too long
std::string inflated(std::string_view packed, Deflate format, std::size_t most);

}  // namespace sikku
