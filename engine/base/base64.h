// engine/base/base64.h: base64 (RFC 4648).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace sikku {

/// With `+`, `/` and padding, or for addresses: with `-`, `_` and without padding.
enum class Base64 : std::uint8_t { padded, url };

/// The 64 letters, in the order of their values.
std::string_view base64_letters(Base64 form);

std::string to_base64(std::string_view bytes, Base64 form);

/// Decodes base64; nullopt for texts that to_base64() does not produce.
std::optional<std::string> from_base64(std::string_view text, Base64 form);

}  // namespace sikku
