// art/reading/polygon_limits.h: limits of files of polygons, and places in them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace sikku::polygon_files {

constexpr std::size_t most_points = 50'000'000;
constexpr double most_coordinate = 1e9;

/// Returns `line 3, column 7` for a byte of a text. Cost: linear.
std::string line_and_column(std::string_view text, std::size_t at);

}  // namespace sikku::polygon_files
