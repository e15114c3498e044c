#include "engine/map/map.h"

#include <fmt/format.h>

#include <string>

namespace sikku {

Map::Map(const MapSystem& system) : vertices_(system.axiom.size()) {
    for (std::size_t i = 0; i < vertices_; ++i) {
        const auto from = static_cast<std::uint32_t>(i);
        const auto to = static_cast<std::uint32_t>((i + 1) % vertices_);
        const MapPart& part = system.axiom[i];
        edges_.push_back({part.label, part.is_reversed ? to : from, part.is_reversed ? from : to, 0});
    }
    const auto walk = [&] {
        for (std::size_t i = 0; i < vertices_; ++i) half_edges_.emplace_back(i, system.axiom[i].is_reversed);
        ends_.push_back(half_edges_.size());
    };
    if (system.is_clockwise) walk();
    for (std::size_t i = vertices_; i > 0; --i) half_edges_.emplace_back(i - 1, !system.axiom[i - 1].is_reversed);
    ends_.push_back(half_edges_.size());
    if (!system.is_clockwise) walk();
}

void print_map(const Map& map, const MapSystem& system, const std::function<void(std::string_view)>& write) {
    constexpr std::size_t piece = std::size_t{1} << 16;
    std::string text;
    const auto end_line = [&] {
        text += '\n';
        if (text.size() < piece) return;
        write(text);
        text.clear();
    };
    for (const MapEdge& edge : map.edges()) {
        text += "edge ";
        text += system.labels[edge.label];
        for (const std::uint32_t number : {edge.tail, edge.head, edge.born}) {
            text += ' ';
            text += fmt::format_int(number).c_str();
        }
        end_line();
    }
    for (std::size_t i = 0; i <= map.cells(); ++i) {
        text += i < map.cells() ? "cell" : "outer";
        for (const HalfEdge half : map.cell(i)) {
            text += half.is_reversed() ? " -" : " +";
            text += fmt::format_int(half.edge()).c_str();
        }
        end_line();
    }
    write(text);
}

}  // namespace sikku
