// engine/measure/parts.h: computes the motion and the area of every part of a drawing, without deriving it.
#pragma once

#include "engine/base/numbers.h"
#include "engine/language/grammar.h"

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace sikku {

struct Lattice;

/// Drawing of a symbol with some steps still to come, in one heading; in turtle steps, relative to the turtle.
template <class Number>
struct DrawnPart {
    Number x = 0, y = 0;     ///< displacement of the turtle
    std::uint32_t turn = 0;  ///< change of its heading, in headings
    bool returns = false;    ///< ends so near its start that its chord is almost 0
    float extent = -1;       ///< the longer side of its box; below 0: it draws nothing
    glm::dvec2 low{0.0};     ///< a box that contains the drawing
    glm::dvec2 high{0.0};
    double ink = 0.0;        ///< length drawn, branches included
    glm::dvec2 centre{0.0};  ///< centre of mass of the drawing
    glm::dvec3 spread{0.0};  ///< its covariance: xx, xy, yy

    bool draws() const { return extent >= 0; }
    /// Appends the drawing of `next` where this one ends; `turn` and `returns` are unchanged.
    void append(const DrawnPart& next);
};

/// Parts of all symbols at all levels, in the headings in which they occur, for drawings with one pen: straight
/// steps, turns by fractions of 360 degrees, and brackets that close in the word in which they open. Number is
/// double, long double (whole coordinates up to 2^64) or Quad (up to 2^113). Sums are exact if headings are multiples
/// of 90 degrees and steps are whole numbers.
template <class Number>
class Parts {
public:
    /// `grammar` must outlive the parts. With `moves_draw`, steps that do not draw are drawn, too, as for a spline.
    /// Nullopt for other drawings (maps, contexts, colours, widths, polygons, discs, brackets that stay open, angles
    /// that are not fractions of a turn), for more than a million parts, and for lengths beyond the range of doubles.
    /// Cost: O(size of the tables x steps x headings).
    static std::optional<Parts> make(const Grammar& grammar, bool moves_draw = false);

    /// Number of tables that are applied to the axiom, `interpret:` included.
    int levels() const { return static_cast<int>(tables_.size()); }
    std::uint32_t headings() const { return headings_; }
    /// The part of a symbol with `level` tables still to be applied, in a heading that occurs at that level.
    const DrawnPart<Number>& part(Symbol symbol, int level, std::uint32_t heading) const {
        return parts_[index(symbol, level, heading)];
    }
    /// All parts, in no particular order.
    const std::vector<DrawnPart<Number>>& all() const { return parts_; }
    /// True if a symbol occurs in that heading with `level` tables still to be applied.
    bool occurs(int level, std::uint32_t heading) const {
        return rows_[static_cast<std::size_t>(level) * headings_ + heading] != UINT32_MAX;
    }
    /// Index of part() in all().
    std::size_t index(Symbol symbol, int level, std::uint32_t heading) const {
        const auto row = static_cast<std::size_t>(level) * headings_ + heading;
        return static_cast<std::size_t>(rows_[row]) * symbols_ + symbol;
    }
    /// Successor of a symbol with `level` tables still to be applied (one fewer for the successor); null: itself.
    const Word* successor(Symbol symbol, int level) const {
        return tables_[static_cast<std::size_t>(level) - 1]->successor(symbol);
    }
    /// The whole drawing, which starts at 0 0.
    const DrawnPart<Number>& whole() const { return whole_; }

private:
    bool find_headings(const Grammar& grammar, const std::vector<std::uint32_t>& turn);
    void place_symbols(const Grammar& grammar, const Lattice& lattice, const std::vector<char>& reached,
                       bool moves_draw);
    std::size_t symbols_ = 0;
    std::uint32_t headings_ = 0;
    std::vector<const Table*> tables_;  // by level, from 1
    std::vector<std::uint32_t> rows_;   // rows of parts_, by level and heading
    std::vector<DrawnPart<Number>> parts_;
    DrawnPart<Number> whole_;
};

}  // namespace sikku
