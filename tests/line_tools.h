// tests/line_tools.h: lines as curves for tests of fields, diagrams and strands.
#pragma once

#include "art/kolam/curved_lines.h"
#include "art/style/style.h"
#include "engine/derivation/derivation.h"
#include "engine/geometry/spline.h"
#include "engine/geometry/turtle.h"
#include "tests/files.h"
#include "tests/reference.h"

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

namespace sikku::line_tools {

/// A closed curve through points at equal parameters in [0, 2 pi), as cubic Hermite pieces.
template <class Curve>
CurvedLines closed_curve(const Curve& at, int pieces = 96) {
    CurvedLines lines;
    const double step = 2 * std::numbers::pi / pieces;
    const auto slope = [&](double t) { return (at(t + 1e-5) - at(t - 1e-5)) / 2e-5; };
    for (int i = 0; i < pieces; ++i) {
        const double from = i * step;
        const double to = (i + 1) % pieces * step;
        lines.pieces.push_back(
            {{at(from), at(from) + step / 3 * slope(from), at(to) - step / 3 * slope(to), at(to)}, {}, false});
    }
    lines.lines.push_back({0, lines.pieces.size(), true, 0});
    return lines;
}

CurvedLines ring(glm::dvec2 centre, double radius);

/// All lines, each in its own orbit.
CurvedLines joined(const std::vector<CurvedLines>& parts);

struct Drawn {
    KolamExamination examination;
    CurvedLines lines;
};

Drawn drawn(const Grammar& grammar, bool is_spline);

Drawn drawn_text(const std::string& text);

/// @param name  of a bundled pattern with its folder  @param steps  derivation length, or empty
Drawn drawn_pattern(const std::string& name, const std::string& steps);

/// The curve of an outline or a stroke, as chords.
std::vector<glm::dvec2> chords(std::span<const glm::dvec2> points, int parts = 16);

/// How often a closed polygon runs around a point.
int winding(const std::vector<glm::dvec2>& polygon, glm::dvec2 at);

}  // namespace sikku::line_tools
