// engine/base/bits.h: the bits of a value as another type.
#pragma once

#include <type_traits>

namespace sikku {

/// std::bit_cast, which libc++ 13 does not have.
template <typename To, typename From>
constexpr To bit_cast(const From& value) {
    static_assert(sizeof(To) == sizeof(From));
    static_assert(std::is_trivially_copyable_v<To> && std::is_trivially_copyable_v<From>);
    return __builtin_bit_cast(To, value);
}

}  // namespace sikku
