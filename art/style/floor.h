// art/style/floor.h: the floors on which kolams are drawn.
#pragma once

#include "art/style/colour.h"

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

namespace sikku {

/// A floor as the ground of a picture: beaten red earth, earth washed with cow dung, slate, or concrete.
enum class Floor : std::uint8_t { red_earth, cow_dung, slate, concrete };

/// Mean colour of a floor, which other formats show.
Colour mean_colour(Floor floor);

/// The floor of a name in lower case, such as `red-earth`.
std::optional<Floor> find_floor(std::string_view name);

/// All names, in the order of the manual.
std::vector<std::string_view> floor_names();

}  // namespace sikku
