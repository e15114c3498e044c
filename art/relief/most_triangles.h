// art/relief/most_triangles.h: the limit of a relief.
#pragma once

#include <cstddef>

namespace sikku {

/// Maximum number of triangles of a relief: an STL of 400 MB.
constexpr std::size_t most_relief_triangles = 8'000'000;

}  // namespace sikku
