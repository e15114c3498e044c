#include "engine/map/map_measurement.h"

#include "engine/base/diagnostic.h"
#include "engine/base/json_text.h"

#include <fmt/format.h>

#include <algorithm>

#include <vector>

namespace sikku {

MapMeasurement measure_map(const Map& map, const MapSystem& system, std::int64_t steps) {
    MapMeasurement result;
    result.n = steps;
    result.cells = map.cells();
    result.edges = map.edges().size();
    result.vertices = map.vertices();
    result.outer = map.outer().size();
    std::vector<std::size_t> labels(system.labels.size(), 0);
    for (const MapEdge& edge : map.edges()) ++labels[edge.label];
    for (Label label = 0; label < labels.size(); ++label) {
        if (labels[label] > 0) result.labels.emplace(system.labels[label], labels[label]);
    }
    for (std::size_t i = 0; i < map.cells(); ++i) ++result.sides[map.cell(i).size()];
    result.remark = undivided_remark(result.cells, system, steps);
    return result;
}

std::string measurement_json(const std::string& title, const MapMeasurement& m) {
    return JsonText::object("title", title, "n", m.n, "cells", m.cells, "edges", m.edges, "vertices", m.vertices,
                            "outer", m.outer, "labels", JsonText::object_of(m.labels), "sides",
                            JsonText::object_of(m.sides))
        .line();
}

std::string undivided_remark(std::size_t cells, const MapSystem& system, std::int64_t steps) {
    const bool has_branches =
        std::any_of(system.productions.begin(), system.productions.end(),
                    [](const MapProduction& rule) { return !rule.left.empty() || !rule.right.empty(); });
    if (cells != 1 || steps == 0 || !has_branches) return "";
    return fmt::format(
        "no cell has divided, because no two branches match; does the axiom run the other way? (map: {})",
        system.is_clockwise ? "anticlockwise" : "clockwise");
}

std::string measurement_text(const std::string& title, const MapMeasurement& m) {
    std::string labels;
    for (const auto& [label, count] : m.labels) {
        labels += fmt::format("{}{} {}", labels.empty() ? "" : "   ", printable(label), count);
    }
    std::string sides;
    for (const auto& [number, count] : m.sides) {
        sides += fmt::format("{}{} with {}", sides.empty() ? "" : "   ", count, number);
    }
    return fmt::format("{}, n = {}\n{:<9}{}\n{:<9}{}\n{:<9}{}\n{:<9}{}\n{:<9}{}\n{:<9}{}\n",
                       title.empty() ? "(untitled)" : printable(title), m.n, "cells", m.cells, "edges", m.edges,
                       "vertices", m.vertices, "outer", m.outer, "labels", labels, "sides", sides) +
           (m.remark.empty() ? "" : fmt::format("{:<9}{}\n", "remark", m.remark));
}

}  // namespace sikku
