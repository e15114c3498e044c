// engine/language/map_system.h: a compiled map L-system: productions that replace edges, and the axiom's wall.
#pragma once

#include "engine/base/diagnostic.h"

#include <cstdint>
#include <string>
#include <vector>

namespace sikku {

class SymbolNames;
struct Pattern;

/// A label of edges, counted from 0 in the order of the file.
using Label = std::uint32_t;

/// A new edge of a production, or an edge of the axiom.
struct MapPart {
    Label label = 0;
    bool is_reversed = false;  ///< directed against the old edge, or against the walk of the axiom
};

/// A branch of a production, which may become half of a wall.
struct MapBranch {
    std::uint32_t position = 0;  ///< number of parts between the old tail and the branch
    Label label = 0;
    bool is_towards = false;  ///< points towards the edge, else away from it
};

/// The successor of a label: parts from the old tail to the old head, and branches on both sides of them.
struct MapProduction {
    std::vector<MapPart> parts;    ///< at least one
    std::vector<MapBranch> right;  ///< in the order of a walk from tail to head
    std::vector<MapBranch> left;   ///< in the order of a walk from head to tail
};

/// Placement of vertices in the plane.
enum class Placing : std::uint8_t { straight, gravity, pressure };

/// Shape on which gravity holds the vertices of the outline.
enum class MapOutline : std::uint8_t { polygon, circle };

/// A system of productions on the edges of planar maps. Edges become edges and branches; two matching branches of a
/// cell become a wall, which divides it. The number of steps and the schedule of tables belong to the grammar.
/// Source: Prusinkiewicz & Lindenmayer, The Algorithmic Beauty of Plants, 1990, chapter 7.
struct MapSystem {
    std::vector<std::string> labels;
    std::vector<MapPart> axiom;  ///< the wall of the first cell
    bool is_clockwise = true;    ///< the axiom walks with the cell on its right, else on its left
    bool divides_all = false;    ///< daughters of a cell divide in the same step as long as branches match
    std::vector<MapProduction> productions;
    /// For each table, the index of each label's production; labels without a production have one that keeps them.
    std::vector<std::vector<std::uint32_t>> tables;

    Placing placing = Placing::straight;
    MapOutline outline = MapOutline::polygon;  ///< for gravity
    double growth = 1.0;                       ///< for pressure, 0 to 1
    double stretch = 1.0;                      ///< factor of the height, above 0

    const MapProduction& production(std::uint32_t table, Label label) const {
        return productions[tables[table][label]];
    }
};

/// Compiles and checks a pattern that has the key `map`. All errors go to `diagnostics`; the system is usable only if
/// there were none. Cost: linear in the file.
MapSystem compile_map_system(const Pattern& pattern, const SymbolNames& names, Diagnostics& diagnostics);

}  // namespace sikku
