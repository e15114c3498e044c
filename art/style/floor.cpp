#include "art/style/floor.h"

#include <array>

namespace sikku {
namespace {

struct FloorRow {
    std::string_view name;
    Colour mean;
};

/// In the order of the enumeration.
constexpr std::array<FloorRow, 4> floors = {{{"red-earth", {0x7e, 0x3c, 0x2c, 255}},
                                             {"cow-dung", {0x58, 0x58, 0x3c, 255}},
                                             {"slate", {0x40, 0x43, 0x46, 255}},
                                             {"concrete", {0x80, 0x7b, 0x74, 255}}}};

}  // namespace

Colour mean_colour(Floor floor) {
    return floors[static_cast<std::size_t>(floor)].mean;
}

std::optional<Floor> find_floor(std::string_view name) {
    for (std::size_t i = 0; i < floors.size(); ++i) {
        if (floors[i].name == name) return static_cast<Floor>(i);
    }
    return std::nullopt;
}

std::vector<std::string_view> floor_names() {
    std::vector<std::string_view> names;
    for (const FloorRow& row : floors) names.push_back(row.name);
    return names;
}

}  // namespace sikku
