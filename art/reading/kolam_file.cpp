#include "art/reading/kolam_file.h"

#include "art/analysis.h"
#include "art/kolam/dot_grid_pattern.h"
#include "art/reading/gesture_loops.h"
#include "art/reading/gestures.h"
#include "art/reading/kolam_csv.h"
#include "art/reading/kolam_json.h"
#include "art/reading/kolam_lines.h"
#include "art/reading/kolam_svg.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <stdexcept>
#include <utility>
#include <variant>

namespace sikku {
namespace {

/// Joins strokes that meet end to end; open lines are counted.
std::vector<ClosedLine> closed_lines(const Polylines<glm::dvec2>& strokes, std::size_t& open) {
    using Key = std::pair<std::int64_t, std::int64_t>;
    const auto key = [](glm::dvec2 point) { return Key{std::llround(point.x * 1e5), std::llround(point.y * 1e5)}; };
    std::vector<ClosedLine> lines;
    std::vector<ClosedLine> pieces;
    for (std::size_t i = 0; i + 1 < strokes.begins.size(); ++i) {
        ClosedLine line(strokes.points.begin() + strokes.begins[i], strokes.points.begin() + strokes.begins[i + 1]);
        if (line.size() < 2) continue;
        if (key(line.front()) == key(line.back())) {
            line.pop_back();
            lines.push_back(std::move(line));
        } else {
            pieces.push_back(std::move(line));
        }
    }
    std::multimap<Key, std::size_t> ends;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        ends.emplace(key(pieces[i].front()), i);
        ends.emplace(key(pieces[i].back()), i);
    }
    std::vector<char> is_used(pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        if (is_used[i] != 0) continue;
        is_used[i] = 1;
        ClosedLine line = pieces[i];
        for (bool grows = true; grows && key(line.front()) != key(line.back());) {
            grows = false;
            const auto [begin, end] = ends.equal_range(key(line.back()));
            for (auto each = begin; each != end && !grows; ++each) {
                if (is_used[each->second] != 0) continue;
                is_used[each->second] = 1;
                const ClosedLine& next = pieces[each->second];
                const bool is_forwards = key(next.front()) == key(line.back());
                for (std::size_t k = 1; k < next.size(); ++k) {
                    line.push_back(is_forwards ? next[k] : next[next.size() - 1 - k]);
                }
                grows = true;
            }
        }
        if (key(line.front()) != key(line.back())) {
            ++open;
            continue;
        }
        line.pop_back();
        lines.push_back(std::move(line));
    }
    return lines;
}

/// A list of objects.
bool is_json_list(std::string_view text, std::size_t first) {
    const std::size_t next = text.find_first_not_of(" \t\r\n", first + 1);
    return text[first] == '[' && next != std::string_view::npos && (text[next] == '{' || text[next] == ']');
}

/// The kolam that the comments of a pattern state, if its lines agree.
std::optional<ReadKolam> stated_kolam(const Document& document, const std::vector<ClosedLine>& lines,
                                      const Monitor& monitor) {
    const std::string_view text = document.source().text();
    const std::string_view grid_text = kolam_comment(text, "grid");
    const std::string_view gaps_text = kolam_comment(text, "gaps");
    if (grid_text.empty()) return std::nullopt;
    try {
        const DotGrid grid = parse_dot_grid(grid_text);
        const GapStates states = parse_gap_states(grid, gaps_text);
        const KolamPattern pattern = kolam_pattern(grid, states, {.monitor = monitor});
        std::vector<glm::dvec2> places;
        for (const GridDot dot : grid.dots()) places.push_back(lattice_point(grid.lattice(), dot));
        std::vector<glm::dvec2> dots = pattern.dots;
        // The lattice has its rows horizontal in the drawing, while the turtle may start with another heading.
        if (dots.size() < 3) return std::nullopt;
        const auto to_lattice = Homography::fit(dots, places);
        if (!to_lattice) return std::nullopt;
        ReadKolam kolam = read_gaps(grid, *to_lattice, lines, monitor);
        if (kolam.states != states || !kolam.certainty.empty() || !kolam.notes.empty()) return std::nullopt;
        return kolam;
    } catch (const std::runtime_error&) {
        return std::nullopt;
    }
}

/// Adds the rim and the centred dots that the comments of a pattern state, if its lines agree with their gaps.
void add_stated_look(std::string_view text, ReadKolam& kolam) {
    const std::string_view rim = kolam_comment(text, "rim");
    const bool has_centred_dots = kolam_comment(text, "centred dots") == "yes";
    if (rim.empty() && !has_centred_dots) return;
    try {
        const DotGrid grid = parse_dot_grid(kolam_comment(text, "grid"));
        if (grid.text() != kolam.grid.text()) return;
        if (parse_gap_states(grid, kolam_comment(text, "gaps")) != kolam.states) return;
        kolam.has_centred_dots = has_centred_dots;
        if (!rim.empty()) kolam.rim = parse_rim_style(rim);
    } catch (const std::runtime_error&) {
        return;  // the comments are not those of a kolam
    }
}

}  // namespace

std::optional<ReadKolam> read_kolam_text(const std::string& text, const KolamFileOptions& options,
                                         const Monitor& monitor) {
    const std::size_t first = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    if (first == std::string::npos) throw std::runtime_error("the file is empty");
    if (text[first] == '{' || is_json_list(text, first)) return read_kolam_json(text, options.number);
    if (text[first] == '<') {
        if (text.find("<svg") == std::string::npos && text.find(":svg") == std::string::npos) {
            throw std::runtime_error("XML, but not an SVG");
        }
        return read_kolam_svg(text, options.lattice, monitor);
    }
    if (is_kolam_csv(text)) return read_kolam_csv(text, options.number, monitor);
    if (is_gestures(text)) return read_gestures(text);
    return std::nullopt;
}

std::optional<GestureDrawing> read_gesture_drawing(const std::string& text) {
    const std::size_t first = text.find_first_not_of(" \t\r\n\xEF\xBB\xBF");
    if (first == std::string::npos || std::string_view("{[<").find(text[first]) != std::string_view::npos) return {};
    if (is_kolam_csv(text) || !is_gestures(text) || !meets_between_four(text)) return std::nullopt;
    return draw_gestures(text);
}

ReadKolam read_kolam_document(const Document& document, double budget, const Monitor& monitor) {
    const DrawnLines drawn = drawn_lines(document, budget, monitor);
    const auto* strokes = std::get_if<Polylines<glm::dvec2>>(&drawn);
    if (!strokes)
        throw std::runtime_error("a kolam lies in the plane: this drawing pitches, rolls, bends or has surfaces");
    std::size_t open = 0;
    const std::vector<ClosedLine> lines = closed_lines(*strokes, open);
    if (lines.empty()) {
        throw std::runtime_error(open > 0 ? "a kolam has closed lines; all lines of this drawing are open"
                                          : "the drawing has no lines");
    }
    auto stated = open == 0 ? stated_kolam(document, lines, monitor) : std::nullopt;
    ReadKolam kolam = stated ? std::move(*stated) : kolam_of_lines(lines, {}, false, std::nullopt, monitor);
    if (open > 0) kolam.notes.push_back(fmt::format("{} left out", counted(open, "open line")));
    kolam.title = document.pattern().text("title");
    add_stated_look(document.source().text(), kolam);
    return kolam;
}

std::optional<std::string> kolam_file_text(std::string_view extension, const DotGrid& grid, const GapStates& states,
                                           const Monitor& monitor) {
    if (extension == "json") return kolam_json_file(grid, states);
    if (extension == "csv") return kolam_csv_file(grid, states, monitor);
    if (extension == "yaml" || extension == "yml") return gestures_file(grid, states);
    return std::nullopt;
}

}  // namespace sikku
