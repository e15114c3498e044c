// engine/base/numbers.h: portable names for the 128-bit number types of compilers.
#pragma once

#ifndef __SIZEOF_FLOAT128__
#include <boost/multiprecision/cpp_bin_float.hpp>
#endif
#ifndef __SIZEOF_INT128__
#include <boost/multiprecision/cpp_int.hpp>
#endif

namespace sikku {

/// A number with a mantissa of 113 bits: 34 decimal digits, whole numbers to 2^113.
#ifdef __SIZEOF_FLOAT128__
__extension__ using Quad = __float128;
#else
using Quad = boost::multiprecision::cpp_bin_float_quad;
#endif

#ifdef __SIZEOF_INT128__
__extension__ using Int128 = __int128;
__extension__ using Unsigned128 = unsigned __int128;
#else
using Int128 = boost::multiprecision::int128_t;
using Unsigned128 = boost::multiprecision::uint128_t;
#endif

}  // namespace sikku
