// engine/base/bits.h: the bits of a value as another type.
#pragma once

#include <cstdint>
#include <type_traits>

namespace sikku {

/// std::bit_cast, which libc++ 13 lacks.
template <typename To, typename From>
constexpr To bit_cast(const From& value) {
    static_assert(sizeof(To) == sizeof(From));
    static_assert(std::is_trivially_copyable_v<To> && std::is_trivially_copyable_v<From>);
    return __builtin_bit_cast(To, value);
}

/// The value of a float as a double, from its bits. Where a double was just rounded to that float, this keeps the
/// rounding: g++ 12 omits it at -O2 if neighbouring values are converted to float and back.
constexpr double widened(float value) {
    const auto bits = bit_cast<std::uint32_t>(value);
    const std::uint64_t sign = bits >> 31, exponent = bits >> 23 & 0xff, fraction = bits & 0x7fffff;
    constexpr std::uint64_t special = 0xff, bias = 1023 - 127;
    if (exponent == 0) return (sign ? -0x1p-149 : 0x1p-149) * static_cast<double>(fraction);
    const std::uint64_t wide = exponent == special ? 0x7ff : exponent + bias;
    return bit_cast<double>(sign << 63 | wide << 52 | fraction << 29);
}

}  // namespace sikku
