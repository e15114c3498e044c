// engine/map/map_measurement.h: measures maps: cells, edges, vertices, labels, sides.
#pragma once

#include "engine/map/map.h"

#include <cstdint>
#include <map>
#include <string>

namespace sikku {

/// Numbers of the parts of a map.
struct MapMeasurement {
    std::int64_t n = 0;
    std::size_t cells = 0;
    std::size_t edges = 0;
    std::size_t vertices = 0;
    std::size_t outer = 0;                      ///< edges of the outer wall
    std::map<std::string, std::size_t> labels;  ///< number of edges of each label that occurs
    std::map<std::size_t, std::size_t> sides;   ///< number of cells for each number of edges
    std::string remark;                         ///< see undivided_remark()
};

/// @param steps  number of derivation steps. Cost: linear in the map.
MapMeasurement measure_map(const Map& map, const MapSystem& system, std::int64_t steps);

/// A remark if no cell has ever divided, although there are branches; else empty.
std::string undivided_remark(std::size_t cells, const MapSystem& system, std::int64_t steps);

/// One line of JSON. @param title  title of the pattern
std::string measurement_json(const std::string& title, const MapMeasurement& measurement);
/// Text with one line for each quantity.
std::string measurement_text(const std::string& title, const MapMeasurement& measurement);

}  // namespace sikku
