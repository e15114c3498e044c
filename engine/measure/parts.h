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

/// What a symbol with some steps still to come draws, from where the turtle is; in turtle steps, in its heading.
template <class Number>
struct DrawnPart {
    Number x = 0, y = 0;     ///< where the turtle goes
    std::uint32_t turn = 0;  ///< of its heading, in headings
    bool returns = false;    ///< it ends near where it began: its chord would be next to nothing
    float extent = -1;       ///< the longer side of its box; below 0: it draws nothing
    glm::dvec2 low{0.0};     ///< box of what is drawn, never too small
    glm::dvec2 high{0.0};
    double ink = 0.0;        ///< length of all that is drawn, branches included
    glm::dvec2 centre{0.0};  ///< its centre of mass,
    glm::dvec3 spread{0.0};  ///< and its covariance: xx, xy, yy

    bool draws() const { return extent >= 0; }
    /// Goes on with what `next` draws, from where this has led; `turn` and `returns` are left alone.
    void append(const DrawnPart& next);
};

/// The parts of all symbols at all levels, in the headings in which they occur, of a drawing with one pen: straight
/// steps and turns by parts of 360 degrees, with brackets that close in the word in which they open. Number: double;
/// long double, which holds whole coordinates up to 2^64; Quad, up to 2^113. Where headings are multiples of 90
/// degrees and steps whole numbers, sums of these are exact.
template <class Number>
class Parts {
public:
    /// `grammar` must outlive them. With `moves_draw`, steps that do not draw are drawn all the same, as of a spline.
    /// Nullopt for other drawings (maps, contexts, colours, widths, polygons, discs, brackets that stay open, angles
    /// that are no parts of a turn), for more than a million parts, and for lengths that doubles do not hold. Cost:
    /// O(size of the tables x steps x headings).
    static std::optional<Parts> make(const Grammar& grammar, bool moves_draw = false);

    /// Tables that are applied to the axiom, `interpret:` included.
    int levels() const { return static_cast<int>(tables_.size()); }
    std::uint32_t headings() const { return headings_; }
    /// The part of a symbol with `level` tables still to come, in a heading in which it occurs there.
    const DrawnPart<Number>& part(Symbol symbol, int level, std::uint32_t heading) const {
        return parts_[index(symbol, level, heading)];
    }
    /// In no order.
    const std::vector<DrawnPart<Number>>& all() const { return parts_; }
    /// Whether anything occurs in that heading with so many tables still to come.
    bool occurs(int level, std::uint32_t heading) const {
        return rows_[static_cast<std::size_t>(level) * headings_ + heading] != UINT32_MAX;
    }
    /// Index of part() in all().
    std::size_t index(Symbol symbol, int level, std::uint32_t heading) const {
        const auto row = static_cast<std::size_t>(level) * headings_ + heading;
        return static_cast<std::size_t>(rows_[row]) * symbols_ + symbol;
    }
    /// What a symbol becomes when `level` tables are still to come: one less for what it becomes. Null: itself.
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
    std::vector<std::uint32_t> rows_;   // of parts_, by level and heading
    std::vector<DrawnPart<Number>> parts_;
    DrawnPart<Number> whole_;
};

}  // namespace sikku
