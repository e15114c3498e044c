#include "tests/line_tools.h"

namespace sikku::line_tools {

CurvedLines ring(glm::dvec2 centre, double radius) {
    return closed_curve([=](double t) { return centre + radius * glm::dvec2(std::cos(t), std::sin(t)); }, 24);
}

CurvedLines joined(const std::vector<CurvedLines>& parts) {
    CurvedLines all;
    for (const CurvedLines& part : parts) {
        for (CurvedLines::Line line : part.lines) {
            line.begin += all.pieces.size();
            line.end += all.pieces.size();
            line.orbit = static_cast<std::uint32_t>(all.lines.size());
            all.lines.push_back(line);
        }
        all.pieces.insert(all.pieces.end(), part.pieces.begin(), part.pieces.end());
    }
    return all;
}

Drawn drawn(const Grammar& grammar, bool is_spline) {
    Drawn result;
    KolamOptions options{.spline = is_spline};
    result.examination = examine_kolam(grammar, options);
    CurveReader reader([](const Pen&) { return true; }, 1'000'000);
    StrokeCensus census;
    SplineSink spline(reader, census.closed);
    derive(grammar, *Turtle::drawing(grammar, census, is_spline), {.interpreted = true});
    PathSink& sink = is_spline ? static_cast<PathSink&>(spline) : reader;
    derive(grammar, *Turtle::drawing(grammar, sink, is_spline), {.interpreted = true});
    result.lines = reader.finish(result.examination);
    return result;
}

Drawn drawn_text(const std::string& text) {
    return drawn(reference::grammar_of("angle increment: 90\n" + text),
                 text.find("line: spline") != std::string::npos);
}

Drawn drawn_pattern(const std::string& name, const std::string& steps) {
    const std::string text = contents(std::filesystem::path(SIKKU_SOURCE_DIR) / ("patterns/" + name + ".lsys"));
    std::vector<Setting> settings;
    if (!steps.empty()) settings.push_back({"-n", "derivation length", steps});
    return drawn(reference::grammar_of(text, settings), text.find("line: spline") != std::string::npos);
}

std::vector<glm::dvec2> chords(std::span<const glm::dvec2> points, int parts) {
    std::vector<glm::dvec2> result = {points[0]};
    for (std::size_t i = 0; i + 3 < points.size(); i += 3) {
        const Bezier curve = {points[i], points[i + 1], points[i + 2], points[i + 3]};
        for (int k = 1; k <= parts; ++k) result.push_back(point_of(curve, static_cast<double>(k) / parts));
    }
    return result;
}

int winding(const std::vector<glm::dvec2>& polygon, glm::dvec2 at) {
    int count = 0;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 a = polygon[i] - at;
        const glm::dvec2 b = polygon[(i + 1) % polygon.size()] - at;
        const double side = a.x * b.y - a.y * b.x;
        if (a.y <= 0 && b.y > 0 && side > 0) ++count;
        if (a.y > 0 && b.y <= 0 && side < 0) --count;
    }
    return count;
}

}  // namespace sikku::line_tools
