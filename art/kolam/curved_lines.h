// art/kolam/curved_lines.h: the lines of a drawing as Béziers.
#pragma once

#include "art/kolam/kolam.h"
#include "engine/geometry/bezier.h"
#include "engine/geometry/path.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace sikku {

struct CurvePiece {
    Bezier curve;
    Pen pen;
    bool is_straight = false;
};

/// A place on a line: the piece, counted from the line's first one, and the parameter in it.
struct LinePlace {
    std::uint32_t piece = 0;
    double t = 0.0;
    double position() const { return piece + t; }
};

/// Lines that consist of pieces, each of which begins where the one before ends. Strokes that meet end to end are one
/// line, in the direction of its first stroke.
struct CurvedLines {
    struct Line {
        std::size_t begin = 0;  ///< pieces [begin, end)
        std::size_t end = 0;
        bool is_closed = false;
        std::uint32_t orbit = 0;  ///< lines that are images of each other share a number
        std::uint32_t count() const { return static_cast<std::uint32_t>(end - begin); }
    };
    std::vector<CurvePiece> pieces;
    std::vector<Line> lines;

    const CurvePiece& piece(const Line& line, std::uint32_t number) const { return pieces[line.begin + number]; }
    /// The place at a position, which may lie up to one round before or after a closed line's pieces.
    LinePlace place(const Line& line, double position) const;
    glm::dvec2 at(const Line& line, double position) const;
    glm::dvec2 derivative(const Line& line, double position) const;
    /// Calls `visit(curve, piece)` for the parts of pieces between two positions, from < to, with less than one round
    /// of a closed line between them.
    template <class Visit>
    void visit_between(const Line& line, double from, double to, Visit&& visit) const {
        constexpr double least = 1e-9;
        for (double position = from; to - position > least;) {
            LinePlace begin = place(line, position);
            if (1 - begin.t < least) begin = place(line, position = std::round(position));
            const double end = std::min(to, position - begin.t + 1);
            const CurvePiece& whole = piece(line, begin.piece);
            visit(part_of(whole.curve, begin.t, begin.t + (end - position)), whole);
            position = end;
        }
    }
};

/// Collects the visible strokes of a drawing; everything else is ignored.
class CurveReader : public PathSink {
public:
    /// @param draws  true for visible pens  @param most  maximum number of pieces; more throw BudgetError
    CurveReader(std::function<bool(const Pen&)> draws, std::size_t most) : draws_(std::move(draws)), most_(most) {}

    void begin_stroke(glm::dvec2 start, const Pen& pen) override;
    void lines(std::span<const glm::dvec2> ends) override;
    void curves(std::span<const glm::dvec2> controls) override;
    void change_pen(const Pen& pen) override;
    void end_stroke(bool closed) override;
    void polygon(std::span<const glm::dvec2>, const Pen&) override {}
    void area(std::span<const glm::dvec2>, const Pen&) override {}
    void disc(glm::dvec2, double, const Pen&) override {}
    void label(std::string_view, glm::dvec2, double, const Pen&) override {}

    /// Returns the lines in the order of the examination of the same drawing, which contains the continuations of
    /// strokes.
    CurvedLines finish(const KolamExamination& examination);

private:
    struct Stroke {
        std::size_t begin = 0;
        std::size_t end = 0;
    };
    void add(const Bezier& curve, bool is_straight);
    void end_seen();
    void append(CurvedLines& result, const Stroke& stroke, bool is_reversed) const;

    std::function<bool(const Pen&)> draws_;
    std::size_t most_;
    std::vector<CurvePiece> pieces_;
    std::vector<Stroke> strokes_;
    glm::dvec2 at_{0.0};
    Pen pen_;
    bool is_seen_ = false;
};

}  // namespace sikku
