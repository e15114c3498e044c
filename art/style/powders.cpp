#include "art/style/powders.h"

#include <algorithm>
#include <array>

namespace sikku {
namespace {

constexpr std::array sets = {
    Powders{"festival", "#f2a71b #c8324a #f6dfa6 #2f8f83 #e8743b #3d6cb0"},
    Powders{"pongal", "#f0b52e #5d8c3a #f7e6b8 #b5472a #e08a35 #2f6b57"},
    Powders{"lotus", "#f3b7c4 #c23a6b #fbe7de #7f9f63 #e5809f #8e2b55"},
    Powders{"peacock", "#2a9d9b #274b93 #9fd8c4 #c9a227 #4fb3d9 #5a3d8a"},
    Powders{"temple", "#e9b872 #5a3527 #f6e9d0 #c9743f #d9a441 #8d6b52"},
    Powders{"marigold", "#fcc52c #d9541e #ffeab0 #a8321f #f4922a #e7b96b"},
    Powders{"monsoon", "#a9c4bd #4b6f86 #e4dfcd #6f8f6b #c79a6b #39525f"},
    Powders{"distinct", "#e69f00 #0072b2 #f0e442 #009e73 #d55e00 #56b4e9 #cc79a7"},
};

}  // namespace

std::vector<std::string_view> powder_names() {
    std::vector<std::string_view> names;
    for (const Powders& each : sets) names.push_back(each.name);
    return names;
}

std::optional<std::vector<Colour>> find_powders(std::string_view name) {
    const auto* found =
        std::find_if(sets.begin(), sets.end(), [&](const Powders& each) { return each.name == name; });
    if (found == sets.end()) return std::nullopt;
    constexpr std::size_t length = std::string_view("#rrggbb").size();
    std::vector<Colour> colours;
    for (std::size_t at = 0; at < found->colours.size(); at += length + 1) {
        colours.push_back(*parse_colour(found->colours.substr(at, length)));
    }
    return colours;
}

}  // namespace sikku
