#include "art/kolam/link_diagram.h"

#include "engine/base/union_find.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

namespace sikku {
namespace {

constexpr std::uint32_t no_arc = std::numeric_limits<std::uint32_t>::max();

/// Crossings that follow each other along a line; `differ` if their upper strands have different numbers.
struct Constraint {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    bool differ = false;
};

std::vector<Constraint> constraints_of(const LinkDiagram& diagram, Pulse& pulse) {
    std::vector<Constraint> constraints;
    for (const LinkDiagram::Line& line : diagram.lines) {
        const std::size_t count = line.passes.size();
        for (std::size_t i = line.is_closed ? 0 : 1; i < count; ++i) {
            pulse();
            const LinkDiagram::Pass& before = line.passes[(i + count - 1) % count];
            const LinkDiagram::Pass& after = line.passes[i];
            constraints.push_back({before.crossing, after.crossing, before.strand == after.strand});
        }
    }
    return constraints;
}

/// The arcs of a diagram between visits to crossings. Arc 2i leaves visit i forwards, 2i + 1 backwards, where visits
/// are numbered along the lines, line after line.
class Arcs {
public:
    explicit Arcs(const LinkDiagram& diagram) : diagram_(diagram) {
        visit_of_.assign(diagram.crossings(), {no_arc, no_arc});
        for (const LinkDiagram::Line& line : diagram.lines) {
            const auto first = static_cast<std::uint32_t>(passes_.size());
            const auto count = static_cast<std::uint32_t>(line.passes.size());
            for (std::uint32_t i = 0; i < count; ++i) {
                visit_of_[line.passes[i].crossing][line.passes[i].strand] = first + i;
                passes_.push_back(line.passes[i]);
                next_.push_back(first + (i + 1) % count);
                before_.push_back(first + (i + count - 1) % count);
            }
        }
    }
    std::uint32_t count() const { return 2 * static_cast<std::uint32_t>(passes_.size()); }

    /// The arc that bounds the same face on the left behind the other end of an arc.
    std::uint32_t along_face(std::uint32_t arc) const {
        const bool is_forward = arc % 2 == 0;
        const std::uint32_t end = is_forward ? next_[arc / 2] : before_[arc / 2];
        // Around a crossing, anticlockwise: out of 0, out of 1, into 0, into 1, if strand 1 points to the left.
        const LinkDiagram::Pass& pass = passes_[end];
        const bool turns_left = diagram_.turns_left[pass.crossing];
        const std::uint32_t other = visit_of_[pass.crossing][1 - pass.strand];
        // The arc that follows clockwise after the end of this one.
        const bool other_points_left = turns_left == (pass.strand == 0);
        return 2 * other + (is_forward == other_points_left ? 0 : 1);
    }
    std::uint32_t crossing(std::uint32_t arc) const { return passes_[arc / 2].crossing; }
    /// The arcs that leave a crossing: forwards and backwards along strand 0, then along strand 1.
    std::array<std::uint32_t, 4> around(std::uint32_t crossing) const {
        const auto [first, second] = visit_of_[crossing];
        return {2 * first, 2 * first + 1, 2 * second, 2 * second + 1};
    }

private:
    const LinkDiagram& diagram_;
    std::vector<LinkDiagram::Pass> passes_;
    std::vector<std::uint32_t> next_, before_;  // visits
    std::vector<std::array<std::uint32_t, 2>> visit_of_;
};

/// Crossings of which two opposite corners lie in one face.
std::uint64_t count_nugatory(const LinkDiagram& diagram, Pulse& pulse) {
    const Arcs arcs(diagram);
    std::vector<std::uint32_t> face(arcs.count(), no_arc);
    std::uint32_t faces = 0;
    for (std::uint32_t first = 0; first < arcs.count(); ++first) {
        if (face[first] != no_arc) continue;
        std::uint32_t arc = first;
        do {
            pulse();
            face[arc] = faces;
            arc = arcs.along_face(arc);
        } while (arc != first);
        ++faces;
    }
    std::uint64_t count = 0;
    for (std::uint32_t crossing = 0; crossing < diagram.crossings(); ++crossing) {
        // The corner on the left of each arc; those of one strand are opposite corners.
        const auto [out_0, in_0, out_1, in_1] = arcs.around(crossing);
        count += face[out_0] == face[in_0] || face[out_1] == face[in_1] ? 1 : 0;
    }
    return count;
}

}  // namespace

bool alternate(LinkDiagram& diagram, const Monitor& monitor) {
    Pulse pulse(monitor);
    const std::vector<Constraint> constraints = constraints_of(diagram, pulse);
    std::vector<std::vector<std::pair<std::uint32_t, bool>>> neighbours(diagram.crossings());
    for (const Constraint& each : constraints) {
        pulse();
        neighbours[each.a].emplace_back(each.b, each.differ);
        neighbours[each.b].emplace_back(each.a, each.differ);
    }
    constexpr std::uint8_t unknown = 2;
    diagram.on_top.assign(diagram.crossings(), unknown);
    std::vector<std::uint32_t> front;
    for (const LinkDiagram::Line& line : diagram.lines) {
        for (const LinkDiagram::Pass& pass : line.passes) {
            if (diagram.on_top[pass.crossing] != unknown) continue;
            diagram.on_top[pass.crossing] = pass.strand;
            front.push_back(pass.crossing);
            while (!front.empty()) {
                pulse();
                const std::uint32_t crossing = front.back();
                front.pop_back();
                for (const auto& [other, differs] : neighbours[crossing]) {
                    if (diagram.on_top[other] != unknown) continue;
                    diagram.on_top[other] = diagram.on_top[crossing] ^ static_cast<std::uint8_t>(differs);
                    front.push_back(other);
                }
            }
        }
    }
    return std::all_of(constraints.begin(), constraints.end(), [&](const Constraint& each) {
        return (diagram.on_top[each.a] != diagram.on_top[each.b]) == each.differ;
    });
}

DiagramFacts diagram_facts(const LinkDiagram& diagram, const Monitor& monitor) {
    Pulse pulse(monitor);
    DiagramFacts facts;
    facts.crossings = diagram.crossings();
    facts.components = diagram.lines.size();
    facts.nugatory = count_nugatory(diagram, pulse);

    UnionFind joined(diagram.lines.size());
    std::vector<std::array<std::uint32_t, 2>> lines(diagram.crossings());
    for (std::uint32_t line = 0; line < diagram.lines.size(); ++line) {
        for (const LinkDiagram::Pass& pass : diagram.lines[line].passes) lines[pass.crossing][pass.strand] = line;
    }
    std::map<std::array<std::uint32_t, 2>, std::int64_t> twice_linking;
    for (std::uint32_t crossing = 0; crossing < diagram.crossings(); ++crossing) {
        pulse();
        // Positive if the lower strand points to the left of the upper one.
        const bool is_positive = diagram.turns_left[crossing] == (diagram.on_top[crossing] == 0);
        const auto [a, b] = lines[crossing];
        joined.join(a, b);
        if (a == b) facts.writhe += is_positive ? 1 : -1;
        if (a != b) twice_linking[{std::min(a, b), std::max(a, b)}] += is_positive ? 1 : -1;
    }
    facts.parts = joined.count();
    for (const auto& [pair, twice] : twice_linking) facts.linked_pairs += twice != 0 ? 1 : 0;
    return facts;
}

}  // namespace sikku
