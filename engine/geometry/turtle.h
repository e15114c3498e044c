// engine/geometry/turtle.h: turns the symbols of a word into strokes, polygons and discs in the plane.
#pragma once

#include "engine/derivation/derivation.h"
#include "engine/geometry/path.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

namespace sikku {

/// An axis-parallel box, in turtle steps.
struct Bounds {
    glm::dvec2 low{0.0};
    glm::dvec2 high{0.0};
};

/// Measurements of a word that a turtle walks through, starting at 0 0; one step is 1.
struct Survey {
    std::uint64_t drawn = 0;     ///< segments drawn
    std::uint64_t moves = 0;     ///< steps, drawn or not
    double length = 0.0;         ///< drawn, in steps
    std::uint64_t polygons = 0;  ///< closed by `}` or an inserted edge
    Bounds box;                  ///< contains all positions, including the start
    std::optional<Bounds> ink;   ///< contains the segments drawn and the labels
    glm::dvec2 end{0.0};
    double heading = 0.0;    ///< degrees in [0, 360)
    bool closed = false;     ///< ended where it began
    std::int64_t depth = 0;  ///< deepest nesting of brackets
};

/// Receives the points of a turtle's lines, in whole coordinates of its grammar's lattice.
class PlaceSink {
public:
    virtual ~PlaceSink() = default;
    /// Receives Lattice::rank coordinates for each point of the PathSink's next call of begin_stroke() or lines();
    /// empty if the rank is 0. The span is valid until that call returns.
    virtual void places(std::span<const std::int64_t> /*coordinates*/) {}
    /// The same for the vertices of the next polygon between `{` and `}` that the PathSink receives.
    /// @param position  of the `}` in the word, from 1
    /// @param is_closed  true if the outline ended where it began; marked vertices always close
    virtual void vertices(std::span<const std::int64_t> /*coordinates*/, std::uint64_t /*position*/,
                          bool /*is_closed*/) {}
};

/// The state of a turtle on a lattice between two runs of symbols.
struct TurtleStand {
    std::array<std::int64_t, 8> coordinates{};  ///< in its lattice; only the first Lattice::rank are used
    std::uint32_t heading = 0;
    Pen pen{};
    std::int64_t depth = 0;      ///< open brackets
    std::uint64_t position = 0;  ///< symbols read or skipped
};

/// A turtle in the plane. Symbols of the third dimension are skipped. Labels are reported when the pen is lifted,
/// because they do not interrupt lines. Unbalanced brackets or braces in the word, steps that are not finite, and
/// nesting over 2^20 are a WordError that names the symbol's position. Source: Prusinkiewicz & Hanan 1989,
/// sections 2.1 and 3.1.
class Turtle : public SymbolSink {
public:
    /// Draws into `sink`. With `moves_draw`, steps that do not draw belong to the stroke, too, as control points of a
    /// spline; then only brackets lift the pen.
    static std::unique_ptr<Turtle> drawing(const Grammar& grammar, PathSink& sink, bool moves_draw);
    /// As above, but polygons go to `outlines`.
    static std::unique_ptr<Turtle> outlining(const Grammar& grammar, PathSink& sink, OutlineSink& outlines,
                                             bool moves_draw);
    /// As drawing(), but also passes the exact coordinates of each point to `places`.
    static std::unique_ptr<Turtle> tracing(const Grammar& grammar, PathSink& sink, PlaceSink& places,
                                           bool moves_draw);
    /// Measures the word without drawing.
    static std::unique_ptr<Turtle> surveying(const Grammar& grammar);

    /// Valid after finish() of a surveying turtle.
    virtual Survey survey() const = 0;

    /// The current state. Nullopt without a lattice, within a polygon, and if the pattern has inserted edges.
    virtual std::optional<TurtleStand> stand() const = 0;
    /// The least number of open brackets since the last call.
    virtual std::int64_t lowest_depth() = 0;
    /// Lifts the pen and skips a part of the word whose effect is known and that closes the brackets that it opens:
    /// continues from `stand`, whose depth is ignored.
    virtual void skip_to(const TurtleStand& stand) = 0;
};

}  // namespace sikku
