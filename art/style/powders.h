// art/style/powders.h: named sets of the powders with which rangoli fields are filled.
#pragma once

#include "art/style/colour.h"

#include <optional>
#include <string_view>
#include <vector>

namespace sikku {

/// A set of powders. Neighbours in the list contrast, since fields of different parity alternate between them.
struct Powders {
    std::string_view name;
    std::string_view colours;  ///< separated by blanks
};

/// Names of all sets, in the order of the manual. Colour-blind readers, too, can distinguish the colours of
/// `distinct` (Okabe and Ito 2008).
std::vector<std::string_view> powder_names();

/// The colours of a set; nullopt for an unknown name.
std::optional<std::vector<Colour>> find_powders(std::string_view name);

}  // namespace sikku
