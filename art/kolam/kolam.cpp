#include "art/kolam/kolam.h"

#include "art/kolam/dots.h"
#include "art/kolam/faces.h"
#include "art/kolam/kolam_plane.h"
#include "art/kolam/lines.h"
#include "art/kolam/planar_graph.h"
#include "art/kolam/strokes.h"
#include "art/kolam/symmetry.h"
#include "engine/derivation/forecast.h"
#include "engine/geometry/lattice.h"
#include "engine/geometry/turtle.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace sikku {
namespace {

using namespace kolam_plane;

/// Runs the stages of an examination, each on the results of the previous ones.
template <class Plane>
KolamExamination examine(const Plane& plane, const Strokes& strokes, const KolamOptions& options) {
    KolamExamination result;
    result.is_exact = Plane::is_exact;
    result.tolerance = Plane::is_exact ? 0.0 : steps_are_one;
    result.is_spline = options.spline;
    result.strokes = strokes.count();
    result.segments = strokes.nodes.size() - strokes.count();

    const PlanarGraph graph = make_graph(plane, strokes, options);
    result.edges = graph.edges.size();
    result.vertices = graph.places.size();

    Lines lines = follow_strokes(graph, strokes, options);
    result.lines = lines.count;
    result.open_lines = lines.open;
    result.line_of_stroke = lines.line_of_stroke;
    result.is_open = lines.is_open;
    result.continuation = lines.continuation;
    for (const std::uint32_t times : lines.times) result.reused_edges += times > 1 ? 1 : 0;

    const Meetings meetings = count_meetings(graph, lines, options);
    if (auto diagram = make_diagram(graph, lines, options, result.no_diagram)) {
        alternate(*diagram, options.monitor);
        result.diagram = diagram_facts(*diagram, options.monitor);
    }
    lines.passes = {};
    lines.order = {};
    result.meetings = meetings.all;
    result.crossings = meetings.crossings;
    result.skew = meetings.skew;
    result.sixty = meetings.sixty;
    result.mid_crossings = meetings.mid_crossings;
    result.touchings = meetings.touchings;
    result.multiple = meetings.multiple;
    result.straight_lines = count_straight_lines(graph, options);

    const Faces faces(graph, lines.closed_times, options);
    result.components = faces.components();
    result.faces = faces.count();

    SymmetryFound symmetry = find_symmetry(plane, graph, strokes, lines, options);
    result.symmetry = symmetry.group;
    result.centre = symmetry.centre;
    result.orbit_of_line = std::move(symmetry.orbit_of_line);

    result.dots = set_dots(graph, faces, strokes, lines, options);
    result.has_own_dots = has_dots_elsewhere(strokes.discs, result.dots);
    if (result.has_own_dots) {
        result.dots = own_dots(graph, strokes, lines, options);
        if (result.open_lines == 0) enclose_in_fields(graph, faces, result.dots);
    }
    return result;
}

template <class Plane>
KolamExamination examine_in(Plane& plane, int rank, const Grammar& grammar, const KolamOptions& options) {
    StrokeReader<Plane> reader(plane, rank, options.budget / options.nodes_of_segment, options.draws);
    const auto turtle = Turtle::tracing(grammar, reader, reader, options.spline && !options.moves_lift);
    DerivationOptions derivation;
    derivation.interpreted = true;
    derivation.limit_whole_words(options.budget);
    derivation.watch = options.watch;
    derive(grammar, *turtle, derivation);
    const Strokes strokes = reader.finish();
    if (strokes.count() == 0) {
        throw std::runtime_error(
            Plane::is_exact ? std::string("there is nothing to examine: the word contains no step that draws")
                            : fmt::format("there is nothing to examine: no step that draws is longer than {} steps",
                                          steps_are_one));
    }
    return examine(plane, strokes, options);
}

template <typename Number>
std::string counted(Number count, std::string_view one, std::string_view many) {
    return count == 1 ? fmt::format("1 {}", one) : fmt::format("{} {}", count, many);
}

}  // namespace

std::string KolamSymmetry::name() const {
    return fmt::format("{}{}", mirrors > 0 ? 'D' : 'C', rotations);
}

std::uint64_t KolamExamination::dots_on_lines() const {
    return static_cast<std::uint64_t>(
        std::count_if(dots.begin(), dots.end(), [](const KolamDot& mark) { return mark.is_on_line; }));
}

std::uint64_t KolamExamination::loose_dots() const {
    return static_cast<std::uint64_t>(std::count_if(dots.begin(), dots.end(), [](const KolamDot& mark) {
        return !mark.is_on_line && !(mark.is_enclosed && mark.is_alone);
    }));
}

std::vector<std::string> KolamExamination::faults() const {
    std::vector<std::string> faults;
    if (open_lines > 0) {
        faults.push_back(
            lines == 1 ? "the line is open"
                       : fmt::format("{} of {} lines {} open", open_lines, lines, open_lines == 1 ? "is" : "are"));
    }
    if (reused_edges > 0) {
        faults.push_back(counted(reused_edges, "edge is drawn more than once", "edges are drawn more than once"));
    }
    if (dots.empty()) {
        faults.emplace_back("no closed line goes around a dot");
    } else if (const std::uint64_t loose = loose_dots(); loose > 0 && has_own_dots) {
        faults.push_back(
            fmt::format("no line runs around or through {} of {}", loose, counted(dots.size(), "dot", "dots")));
    } else if (loose > 0) {
        faults.push_back(fmt::format("{} of {} {} not encircled: the line wanders out of {} sight", loose,
                                     counted(dots.size(), "dot", "dots"), loose == 1 ? "is" : "are",
                                     loose == 1 ? "its" : "their"));
    }
    return faults;
}

std::vector<std::string> KolamExamination::remarks() const {
    std::vector<std::string> remarks;
    if (lines > 1) remarks.push_back(fmt::format("there are {} lines", lines));
    if (sixty == 0 && skew > 0) {
        remarks.push_back(counted(skew, "crossing is not at right angles", "crossings are not at right angles"));
    } else if (sixty > 0 && sixty < crossings) {
        remarks.push_back(fmt::format("{} of {} crossings are not at 60 degrees", crossings - sixty, crossings));
    }
    if (multiple > 0) {
        remarks.push_back(
            counted(multiple, "point is visited more than twice", "points are visited more than twice"));
    }
    return remarks;
}

KolamExamination examine_kolam(const Grammar& given, const KolamOptions& options) {
    if (given.is_spatial())
        throw std::runtime_error("a kolam lies in the plane: this drawing pitches, rolls, bends or has surfaces");
    DerivationOptions whole_words;
    whole_words.limit_whole_words(options.budget);
    whole_words.watch = options.watch;
    const Grammar grammar = resolve_contexts(shorten(given), whole_words);
    require_affordable(grammar, true, options.budget);
    const Lattice lattice = make_lattice(grammar);
    if (lattice.rank > 0) {
        ExactPlane plane(lattice);
        try {
            return examine_in(plane, lattice.rank, grammar, options);
        } catch (const ExactPlane::OutOfRange&) {
        }
    }
    RoughPlane plane;
    return examine_in(plane, 0, grammar, options);
}

std::vector<glm::dvec2> dot_places(const KolamExamination& examination) {
    std::vector<glm::dvec2> places;
    for (const KolamDot& mark : examination.dots) places.push_back(mark.at);
    return places;
}

}  // namespace sikku
