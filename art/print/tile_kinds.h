// art/print/tile_kinds.h: kinds of tiles, and their names as layers.
#pragma once

#include "art/style/colour.h"
#include "engine/geometry/polygon_classes.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace sikku {

struct TileKind {
    std::uint32_t shape = 0;  ///< number from 1; 0: all kinds beyond the first TileKinds::most - 1
    bool is_reflected = false;
    Colour colour;

    /// Label such as `shape 2 reflected #efe0c0`.
    std::string label() const {
        if (shape == 0) return "other tiles";
        return fmt::format("shape {}{} {}", shape, is_reflected ? " reflected" : "", colour_name(colour));
    }
    /// Layer name such as `SHAPE-2-REFLECTED-EFE0C0`: at most 31 capitals, digits and hyphens, as DXF of release 12
    /// allows.
    std::string layer() const {
        if (shape == 0) return "OTHER-TILES";
        return fmt::format("SHAPE-{}{}-{:02X}{:02X}{:02X}{}", shape, is_reflected ? "-REFLECTED" : "", colour.red,
                           colour.green, colour.blue, colour.alpha == 255 ? "" : fmt::format("{:02X}", colour.alpha));
    }
};

/// Numbers the shapes, hands and colours of polygons in the order of their appearance.
class TileKinds {
public:
    /// Maximum number of kinds; further kinds share the last number, since many layers make programs slow.
    static constexpr std::size_t most = 200;

    /// Returns the number of a polygon's kind, at most one more than those before.
    std::size_t kind_of(std::span<const glm::dvec2> vertices, Colour colour) {
        const PolygonClass found = classes_.classify(vertices);
        const std::tuple key(found.shape, found.is_reflected, colour.red, colour.green, colour.blue, colour.alpha);
        if (const auto known = numbers_.find(key); known != numbers_.end()) return known->second;
        if (kinds_.size() + 1 == most) {
            kinds_.push_back({});
        } else if (kinds_.size() < most) {
            numbers_.emplace(key, kinds_.size());
            kinds_.push_back({found.shape + 1, found.is_reflected, colour});
        }
        return kinds_.size() - 1;
    }
    /// All kinds, by number.
    const std::vector<TileKind>& kinds() const { return kinds_; }

private:
    using Key = std::tuple<std::uint32_t, bool, std::uint8_t, std::uint8_t, std::uint8_t, std::uint8_t>;

    PolygonClasses classes_;
    std::map<Key, std::size_t> numbers_;
    std::vector<TileKind> kinds_;
};

}  // namespace sikku
