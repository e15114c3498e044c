// art/vector/tile_kinds.h: kinds of tiles, as layers name them.
#pragma once

#include "art/style/colour.h"
#include "engine/geometry/polygon_classes.h"

#include <fmt/format.h>

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace sikku {

/// Numbers the shapes, hands and colours of polygons as they come.
class TileKinds {
public:
    /// Readers list all layers, and slow down: further kinds are one, the last.
    static constexpr std::size_t most = 200;

    /// The number of the kind of a polygon, at most one more than those before.
    std::size_t kind_of(std::span<const glm::dvec2> vertices, Colour colour) {
        const PolygonClass found = classes_.classify(vertices);
        std::string label = fmt::format("shape {}{} {}", found.shape + 1, found.is_reflected ? " reflected" : "",
                                        colour_name(colour));
        if (const auto known = numbers_.find(label); known != numbers_.end()) return known->second;
        if (labels_.size() + 1 == most) {
            labels_.emplace_back("other tiles");
        } else if (labels_.size() < most) {
            numbers_.emplace(label, labels_.size());
            labels_.push_back(std::move(label));
        }
        return labels_.size() - 1;
    }
    /// `shape 2 reflected #efe0c0`, by number.
    const std::vector<std::string>& labels() const { return labels_; }

private:
    PolygonClasses classes_;
    std::map<std::string, std::size_t> numbers_;
    std::vector<std::string> labels_;
};

}  // namespace sikku
