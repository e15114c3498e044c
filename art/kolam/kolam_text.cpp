#include "art/kolam/kolam_text.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <vector>

namespace sikku {
namespace {

/// Formats turtle steps, to a millionth of one.
std::string number(double value) {
    const double rounded = std::round(value * 1e6) / 1e6;
    return fmt::format("{}", rounded == 0 ? 0.0 : rounded);  // never -0
}
std::string json(glm::dvec2 point) {
    return fmt::format("[{}, {}]", number(point.x), number(point.y));
}
std::string json(bool value) {
    return value ? "true" : "false";
}
std::string json(const std::vector<std::string>& texts) {
    std::string list = "[";
    for (const std::string& text : texts) list += (list.size() > 1 ? ", " : "") + json_string(text);
    return list + "]";
}

std::string diagram_json(const KolamExamination& k) {
    if (!k.diagram) return "null";
    const DiagramFacts& d = *k.diagram;
    return fmt::format(
        "{{\"alternating\": true, \"crossings\": {}, \"components\": {}, \"parts\": {}, \"nugatory\": {}, "
        "\"reduced\": {}, \"crossing_number\": {}, \"writhe\": {}, \"linked_pairs\": {}}}",
        d.crossings, d.components, d.parts, d.nugatory, json(d.is_reduced()), d.crossing_number(), d.writhe,
        d.linked_pairs);
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
    std::string dots;
    for (const KolamDot& dot : k.dots) dots += (dots.empty() ? "" : ", ") + json(dot.at);
    std::string text = fmt::format("{{\"title\": {}, \"n\": {}, \"kolam\": {}, \"faults\": {}, \"remarks\": {}, ",
                                   json_string(title), n, json(k.is_kolam()), json(k.faults()), json(k.remarks()));
    text += fmt::format("\"exact\": {}, \"tolerance\": {}, \"spline\": {}, \"segments\": {}, \"strokes\": {}, ",
                        json(k.is_exact), k.tolerance, json(k.is_spline), k.segments, k.strokes);
    text += fmt::format("\"lines\": {}, \"open_lines\": {}, \"straight_lines\": {}, ", k.lines, k.open_lines,
                        k.straight_lines);
    text += fmt::format("\"vertices\": {}, \"edges\": {}, \"components\": {}, \"faces\": {}, \"reused_edges\": {}, ",
                        k.vertices, k.edges, k.components, k.faces, k.reused_edges);
    text += fmt::format(
        "\"meetings\": {}, \"crossings\": {}, \"skew\": {}, \"sixty_degrees\": {}, \"mid_crossings\": {}, ",
        k.meetings, k.crossings, k.skew, k.sixty, k.mid_crossings);
    text += fmt::format("\"touchings\": {}, \"multiple\": {}, ", k.touchings, k.multiple);
    text += "\"diagram\": " + diagram_json(k) + ", ";
    text += fmt::format("\"symmetry\": \"{}\", \"rotations\": {}, \"mirrors\": {}, \"centre\": {}, ",
                        k.symmetry.name(), k.symmetry.rotations, k.symmetry.mirrors, json(k.centre));
    return text + fmt::format("\"loose_dots\": {}, \"dots_on_lines\": {}, \"dots\": [{}]}}\n", k.loose_dots(),
                              k.dots_on_lines(), dots);
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
                     number(k.centre.x), number(k.centre.y)));
    line("exact",
         k.is_exact
             ? "yes"
             : fmt::format("no: the angles do not fit a lattice; points within {} steps of each other count as one",
                           k.tolerance));
    return text;
}

}  // namespace sikku
