#include "art/kolam/kolam_text.h"

#include "engine/base/diagnostic.h"
#include "engine/base/json_text.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>
#include <vector>

namespace sikku {
namespace {

/// Turtle steps to a millionth of one, never -0.
double rounded(double value) {
    const double result = std::round(value * 1e6) / 1e6;
    return result == 0 ? 0.0 : result;
}
JsonText json(glm::dvec2 point) {
    return std::array{rounded(point.x), rounded(point.y)};
}

JsonText diagram_json(const KolamExamination& k) {
    if (!k.diagram) return nullptr;
    const DiagramFacts& d = *k.diagram;
    return JsonText::object("alternating", true, "crossings", d.crossings, "components", d.components, "parts",
                            d.parts, "nugatory", d.nugatory, "reduced", d.is_reduced(), "crossing_number",
                            d.crossing_number(), "writhe", d.writhe, "linked_pairs", d.linked_pairs);
}

/// The kind of knot or link that the lines make if they pass over and under alternately.
std::string diagram_text(const KolamExamination& k) {
    if (!k.diagram) return "none: " + k.no_diagram;
    const DiagramFacts& d = *k.diagram;
    const std::uint64_t number = d.crossing_number();
    std::string kind = d.components == 1 ? "knot" : fmt::format("link of {} lines", d.components);
    if (number == 0) kind = d.components == 1 ? "unknot" : fmt::format("{} unlinked loops", d.components);
    std::string text = fmt::format("alternating, {} with crossing number {}", kind, number);
    if (d.crossings == 0) text = kind + " without crossings";
    if (d.crossings > 0 && d.is_reduced()) text += "; reduced";
    if (d.nugatory == 1) text += "; 1 crossing untwists";
    if (d.nugatory > 1) text += fmt::format("; {} crossings untwist", d.nugatory);
    if (d.parts > 1) text += fmt::format("; {} separate parts", d.parts);
    if (d.components > 1 && d.linked_pairs > 0) {
        text +=
            fmt::format("; {} with a linking number other than 0",
                        d.linked_pairs == 1 ? "1 pair of lines" : fmt::format("{} pairs of lines", d.linked_pairs));
    }
    if (d.components == 1 && d.crossings > 0) text += fmt::format("; writhe {}", d.writhe);
    return text;
}

/// Places of the dots of a kolam without faults.
std::string where_dots_are(const KolamExamination& k) {
    const std::uint64_t through = k.dots_on_lines();
    if (through == 0) return "all encircled";
    if (through == k.dots.size()) return "all on the line";
    return fmt::format("{} on the line and {} encircled", through, k.dots.size() - through);
}

}  // namespace

std::string kolam_json(const std::string& title, std::int64_t n, const KolamExamination& k) {
    const auto place = [](const KolamDot& dot) { return json(dot.at); };
    return JsonText::object(
               "title", title, "n", n, "kolam", k.is_kolam(), "faults", k.faults(), "remarks", k.remarks(), "exact",
               k.is_exact, "tolerance", k.tolerance, "spline", k.is_spline, "segments", k.segments, "strokes",
               k.strokes, "lines", k.lines, "open_lines", k.open_lines, "straight_lines", k.straight_lines,
               "vertices", k.vertices, "edges", k.edges, "components", k.components, "faces", k.faces, "reused_edges",
               k.reused_edges, "meetings", k.meetings, "crossings", k.crossings, "skew", k.skew, "sixty_degrees",
               k.sixty, "mid_crossings", k.mid_crossings, "touchings", k.touchings, "multiple", k.multiple, "diagram",
               diagram_json(k), "symmetry", k.symmetry.name(), "rotations", k.symmetry.rotations, "mirrors",
               k.symmetry.mirrors, "centre", json(k.centre), "loose_dots", k.loose_dots(), "dots_on_lines",
               k.dots_on_lines(), "dots", JsonText::list(k.dots, place))
        .line();
}

std::string kolam_text(const std::string& title, std::int64_t n, const KolamExamination& k) {
    std::string text = fmt::format("{}, n = {}\n", title.empty() ? "(untitled)" : printable(title), n);
    const auto line = [&](std::string_view name, const std::string& value) {
        text += fmt::format("{:<11}{}\n", name, value);
    };
    const auto list = [](const std::vector<std::string>& texts) { return fmt::format("{}", fmt::join(texts, ", ")); };
    const auto plural = [](std::uint64_t count, std::string_view one, std::string_view many) {
        return fmt::format("{} {}", count, count == 1 ? one : many);
    };

    const std::vector<std::string> faults = k.faults();
    if (faults.empty()) {
        line("kolam", fmt::format("yes: {}, {}, {}",
                                  k.lines == 1 ? "a single line (anthathi)" : counted(k.lines, "closed line"),
                                  counted(k.dots.size(), "dot"), where_dots_are(k)));
    } else {
        line("kolam", "no: " + list(faults));
    }
    if (const auto remarks = k.remarks(); !remarks.empty()) line("remarks", list(remarks));

    std::string lines = fmt::format("{}", k.lines);
    if (k.open_lines > 0) lines += fmt::format(", {} of them open", k.open_lines);
    if (k.straight_lines != k.lines) {
        lines += fmt::format("; {} if one goes straight on where they meet", k.straight_lines);
    }
    line("lines", lines);
    line("strokes", fmt::format("{} of {}", k.strokes, plural(k.segments, "segment", "segments")));
    std::string crossings = fmt::format("{}", k.crossings);
    if (k.crossings > 0) {
        crossings += k.skew == 0              ? ", all at right angles"
                     : k.sixty == k.crossings ? ", all at 60 degrees"
                                              : fmt::format(", {} at right angles", k.crossings - k.skew);
        if (k.mid_crossings > 0) crossings += fmt::format(", {} inside segments", k.mid_crossings);
    }
    line("crossings", crossings);
    line("touching", fmt::format("{}{}", k.touchings,
                                 k.is_spline && k.touchings > 0 ? "; the spline keeps the strands apart there" : ""));
    line("diagram", diagram_text(k));
    if (k.multiple > 0) line("multiple", fmt::format("{}", k.multiple));
    line("meetings", fmt::format("{}", k.meetings));
    line("reused", plural(k.reused_edges, "edge", "edges"));
    line("faces", fmt::format("{} ({}, {}, {})", k.faces, plural(k.edges, "edge", "edges"),
                              plural(k.vertices, "vertex", "vertices"), plural(k.components, "piece", "pieces")));
    line("dots", fmt::format("{}", k.dots.size()));
    line("symmetry",
         fmt::format("{}: {}, {}, about {} {}", k.symmetry.name(),
                     k.symmetry.rotations == 1 ? "no rotation" : fmt::format("{} rotations", k.symmetry.rotations),
                     k.symmetry.mirrors == 0 ? "no mirror" : plural(k.symmetry.mirrors, "mirror", "mirrors"),
                     rounded(k.centre.x), rounded(k.centre.y)));
    line("exact",
         k.is_exact
             ? "yes"
             : fmt::format("no: the angles do not fit a lattice; points within {} steps of each other count as one",
                           k.tolerance));
    return text;
}

}  // namespace sikku
