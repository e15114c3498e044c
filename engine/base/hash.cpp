#include "engine/base/hash.h"

#include "engine/base/numbers.h"

#include <fmt/format.h>

namespace sikku {

void TextHash::add(std::string_view bytes) {
    constexpr Unsigned128 prime = (Unsigned128{1} << 88) + 0x13b;
    Unsigned128 state = (Unsigned128{high_} << 64) | low_;
    for (const char byte : bytes) state = (state ^ static_cast<unsigned char>(byte)) * prime;
    high_ = static_cast<std::uint64_t>(state >> 64);
    low_ = static_cast<std::uint64_t>(state);
}

void TextHash::add_piece(std::string_view bytes) {
    add(fmt::format("{}:", bytes.size()));
    add(bytes);
}

std::string TextHash::digits() const {
    return fmt::format("{:016x}{:016x}", high_, low_);
}

}  // namespace sikku
