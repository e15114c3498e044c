// engine/base/edit_distance.h: how similar two words are.
#pragma once

#include <cstddef>
#include <string_view>

namespace sikku {

/// Edit distance in bytes: the fewest substitutions, deletions, insertions and exchanges of neighbours that turn `a`
/// into `b` (optimal string alignment). Cost: product of the lengths.
std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace sikku
