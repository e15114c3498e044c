// engine/base/hash.h: a hash that is the same on every machine.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace sikku {

/// Fowler, Noll and Vo's hash of 128 bits (FNV-1a), to be fed piece by piece.
class TextHash {
public:
    void add(std::string_view bytes);
    /// Adds the bytes with their number, so that successive pieces remain distinct.
    void add_piece(std::string_view bytes);
    std::string digits() const;

private:
    std::uint64_t high_ = 0x6c62272e07bb0142;
    std::uint64_t low_ = 0x62b821756295c58d;
};

}  // namespace sikku
