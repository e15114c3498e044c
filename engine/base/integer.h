// engine/base/integer.h: whole numbers of any size. Public headers leave it out: it takes half a second to compile.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>

namespace sikku {

using Integer = boost::multiprecision::cpp_int;

}  // namespace sikku
