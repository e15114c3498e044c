#include "art/style/map_style.h"

#include "art/style/values.h"
#include "engine/base/text.h"

#include <string>

namespace sikku {
namespace {

std::string value_of(const Key& key) {
    return lower_case(trimmed(key.value.view()));
}

void read_cells(const Key& key, MapStyle& style, Diagnostics& diagnostics) {
    const std::string value = value_of(key);
    if (value == "walls") {
        style.cells = CellOutlines::walls;
    } else if (value == "splines") {
        style.cells = CellOutlines::splines;
    } else if (value == "both") {
        style.cells = CellOutlines::both;
    } else {
        refuse(key, "walls, splines or both", diagnostics);
    }
}

void read_tension(const Key& key, MapStyle& style, Diagnostics& diagnostics) {
    constexpr double most = 1e6;
    const auto number = number_in(trimmed(key.value.view()), 0, most);
    if (!number) return refuse(key, "a number from 0 to 1000000", diagnostics);
    style.tension = *number;
}

void read_inset(const Key& key, MapStyle& style, Diagnostics& diagnostics) {
    const auto number = number_in(trimmed(key.value.view()), 0, 1);
    if (!number || *number == 1) return refuse(key, "a number from 0 to less than 1", diagnostics);
    style.inset = *number;
}

void read_wall_width(const Key& key, MapStyle& style, Diagnostics& diagnostics) {
    const std::string value = value_of(key);
    style.widths_by_age = value == "age";
    if (value != "age" && value != "even") refuse(key, "even or age", diagnostics);
}

void read_tissue(const Key& key, MapStyle& style, Diagnostics& diagnostics) {
    const std::string value = value_of(key);
    if (value == "none") return;
    style.tissue = parse_colour(value);
    if (!style.tissue) refuse(key, "a colour or none", diagnostics);
}

/// Young cells are light and old ones deep green.
std::vector<Colour> colours_of_ages() {
    return {{0xf3, 0xf2, 0xc0, 255}, {0xdc, 0xe8, 0xa2, 255}, {0xbb, 0xd9, 0x89, 255}, {0x94, 0xc6, 0x75, 255},
            {0x6d, 0xb0, 0x67, 255}, {0x4b, 0x97, 0x5c, 255}, {0x31, 0x7c, 0x50, 255}, {0x20, 0x60, 0x43, 255}};
}

/// Hexagons, the most frequent cells of a tissue, are the palest.
std::vector<Colour> colours_of_sides() {
    return {{0x8c, 0x4a, 0x5e, 255}, {0xc9, 0x7b, 0x63, 255}, {0xe8, 0xb8, 0x74, 255}, {0xf2, 0xe6, 0xc4, 255},
            {0xa9, 0xcb, 0xb7, 255}, {0x5f, 0x9e, 0xa0, 255}, {0x35, 0x6b, 0x7f, 255}, {0x24, 0x44, 0x5c, 255}};
}

}  // namespace

MapStyle read_map_style(const Pattern& pattern, const std::vector<Colour>& palette, Diagnostics& diagnostics) {
    MapStyle style;
    if (const Key* key = pattern.find("cells")) read_cells(*key, style, diagnostics);
    if (const Key* key = pattern.find("tension")) read_tension(*key, style, diagnostics);
    if (const Key* key = pattern.find("inset")) read_inset(*key, style, diagnostics);
    if (const Key* key = pattern.find("wall width")) read_wall_width(*key, style, diagnostics);
    if (const Key* key = pattern.find("tissue")) read_tissue(*key, style, diagnostics);
    if (const Key* key = pattern.find("fill")) {
        const std::string value = value_of(*key);
        style.fill = value == "none"    ? CellFill::none
                     : value == "age"   ? CellFill::age
                     : value == "sides" ? CellFill::sides
                                        : CellFill::colour;
    }
    if (style.fill == CellFill::age) style.classes = palette.empty() ? colours_of_ages() : palette;
    if (style.fill == CellFill::sides) style.classes = palette.empty() ? colours_of_sides() : palette;
    return style;
}

}  // namespace sikku
