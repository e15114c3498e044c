// art/print/micrometres.h: points of a print in whole micrometres, and fast writing of whole numbers, for the vector
// writers.
#pragma once

#include "art/print/page.h"
#include "engine/base/bits.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

namespace sikku {

/// A point, measured from the top left corner of the page, y down.
struct Micrometres {
    std::int32_t x = 0, y = 0;
    bool operator==(const Micrometres&) const = default;
};

/// Returns the nearest whole number, halves to even, clamped to ±10^9 (a kilometre in micrometres), so that the
/// difference of two fits into 32 bits; 0 for NaN. Adding 1.5 * 2^52 leaves the rounded number in the lowest bits of
/// the mantissa.
inline std::int32_t to_whole(double value) {
    constexpr double most = 1e9;
    constexpr double magic = 6755399441055744.0;
    value = value > -most ? value : (value <= -most ? -most : 0.0);
    value = value < most ? value : most;
    return static_cast<std::int32_t>(bit_cast<std::int64_t>(value + magic) - bit_cast<std::int64_t>(magic));
}

/// The placement of a print in micrometres.
class MicrometrePlacement {
public:
    explicit MicrometrePlacement(const Placement& placement) : matrix_(placement.to_page * 1000.0) {}

    Micrometres operator()(glm::dvec2 point) const {
        return {to_whole(matrix_[0].x * point.x + matrix_[1].x * point.y + matrix_[2].x),
                to_whole(matrix_[0].y * point.x + matrix_[1].y * point.y + matrix_[2].y)};
    }

private:
    glm::dmat3x2 matrix_;
};

/// The digits of 0 to 999 and their number, loaded at once: with leading zeros, and without.
struct DigitTables {
    struct Entry {
        std::array<char, 3> digits;
        std::uint8_t count;
    };
    std::array<Entry, 1000> padded{};
    std::array<Entry, 1000> plain{};

    constexpr DigitTables() {
        for (std::size_t i = 0; i < 1000; ++i) {
            const std::array<char, 3> digits = {static_cast<char>('0' + i / 100),
                                                static_cast<char>('0' + i / 10 % 10),
                                                static_cast<char>('0' + i % 10)};
            const std::size_t skipped = i < 10 ? 2 : i < 100 ? 1 : 0;
            padded[i] = {digits, 3};
            plain[i] = {{}, static_cast<std::uint8_t>(3 - skipped)};
            for (std::size_t k = skipped; k < 3; ++k) plain[i].digits[k - skipped] = digits[k];
        }
    }
};
inline constexpr DigitTables digit_tables;

/// Maximum number of bytes that put_number() writes, some of them beyond the end of the number.
inline constexpr std::size_t number_room = 16;

/// Writes `value` at `out` and returns the end of its digits.
inline char* put_number(char* out, std::int32_t value) {
    std::uint32_t rest = static_cast<std::uint32_t>(value);
    if (value < 0) {
        *out++ = '-';
        rest = 0u - rest;
    }
    const auto put = [&out](const DigitTables::Entry& entry) {
        std::memcpy(out, &entry, 4);
        out += entry.count;
    };
    if (rest < 1000) {
        put(digit_tables.plain[rest]);
    } else if (rest < 1000000) {
        put(digit_tables.plain[rest / 1000]);
        put(digit_tables.padded[rest % 1000]);
    } else {
        const std::uint32_t millions = rest / 1000000;
        if (millions < 1000) {
            put(digit_tables.plain[millions]);
        } else {
            put(digit_tables.plain[millions / 1000]);
            put(digit_tables.padded[millions % 1000]);
        }
        put(digit_tables.padded[rest / 1000 % 1000]);
        put(digit_tables.padded[rest % 1000]);
    }
    return out;
}

/// Formats `value` with at most `digits` (1 to 16) decimals, without trailing zeros and without an exponent.
inline std::string decimal(double value, int digits) {
    std::string text = fmt::format("{:.{}f}", value, digits);
    while (text.ends_with('0')) text.pop_back();
    if (text.ends_with('.')) text.pop_back();
    return text == "-0" ? "0" : text;
}

/// Text that grows by whole blocks of points: the writer requests room once and fills it through a pointer.
class TextBuffer {
public:
    char* room(std::size_t bytes) {
        if (size_ + bytes > capacity_) grow(bytes);
        return text_.get() + size_;
    }
    /// Adds everything before `end`, a pointer into the last room(), to the text.
    void filled_to(const char* end) { size_ = static_cast<std::size_t>(end - text_.get()); }
    void append(std::string_view text) {
        char* out = room(text.size());
        std::copy(text.begin(), text.end(), out);
        filled_to(out + text.size());
    }
    std::string_view view() const { return {text_.get(), size_}; }
    std::size_t size() const { return size_; }
    void clear() { size_ = 0; }

private:
    void grow(std::size_t bytes) {
        const std::size_t wanted = std::max(size_ + bytes, std::max<std::size_t>(1024, 2 * capacity_));
        std::unique_ptr<char[]> larger(new char[wanted]);  // not cleared
        std::copy_n(text_.get(), size_, larger.get());
        text_ = std::move(larger);
        capacity_ = wanted;
    }

    std::unique_ptr<char[]> text_;
    std::size_t size_ = 0;
    std::size_t capacity_ = 0;
};

}  // namespace sikku
