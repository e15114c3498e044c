#include "art/kolam/dot_grid_pattern.h"

#include "art/print/ornaments.h"
#include "engine/language/pattern.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <stdexcept>
#include <string_view>

namespace sikku {
namespace {

/// Half steps of the turtle along two axes: up right and up left in the square lattice, right and up right (60
/// degrees) in the triangular one.
struct HalfSteps {
    std::int64_t first = 0;
    std::int64_t second = 0;
    bool operator==(const HalfSteps&) const = default;
};
HalfSteps operator-(const HalfSteps& a, const HalfSteps& b) {
    return {a.first - b.first, a.second - b.second};
}

/// How a lattice is walked, as the turtle is before the drawing is turned.
struct Walk {
    std::uint32_t headings;  ///< per full turn
    glm::dvec2 first;        ///< half a step along the axes
    glm::dvec2 second;
    int heading;  ///< degrees of the first axis in the drawing
};
Walk walk_of(DotLattice lattice) {
    if (lattice == DotLattice::triangular) return {6, {0.5, 0.0}, {0.25, std::numbers::sqrt3 / 4}, 0};
    constexpr double half = std::numbers::sqrt2 / 4;
    return {4, {half, half}, {-half, half}, 45};
}

/// Twice the place, so that the middles of gaps are whole, in halves of the units of GridDot.
HalfSteps place_of(const DotGrid& grid, GridDot doubled) {
    const std::int64_t x = doubled.x;
    const std::int64_t y = doubled.y;
    // A spacing is 4 units of x; it is one step along each axis of the square lattice, forwards and backwards, and
    // two along the first axis of the triangular one.
    if (grid.lattice() == DotLattice::square) return {(y + x) / 2, (y - x) / 2};
    return {x - y / 2, y};
}
HalfSteps place_of_dot(const DotGrid& grid, std::uint32_t dot) {
    const GridDot from = grid.dots().front();
    const GridDot at = grid.dots()[dot];
    return place_of(grid, {2 * (at.x - from.x), 2 * (at.y - from.y)});
}
HalfSteps side_middle(const DotGrid& grid, std::uint32_t dot, std::uint32_t side) {
    const GridDot from = grid.dots().front();
    const GridDot at = grid.dots()[dot];
    const GridDot way = grid.step(side);
    return place_of(grid, {2 * (at.x - from.x) + way.x, 2 * (at.y - from.y) + way.y});
}

/// Symbols, broken into lines where they may be.
class WordWriter {
public:
    WordWriter(std::string& text, std::uint32_t headings) : text_(text), headings_(headings) {}
    void put(std::string_view symbol) {
        if (column_ + symbol.size() > 108) {
            text_ += " \\\n    ";
            column_ = 4;
        }
        text_ += symbol;
        column_ += symbol.size();
    }
    /// Anticlockwise, in full turns / headings.
    void turn(std::uint32_t count) {
        count %= headings_;
        if (2 * count == headings_) return put("|");
        if (2 * count < headings_) {
            for (; count > 0; --count) put("-");
        } else {
            for (; count < headings_; ++count) put("+");
        }
    }
    /// Moves with heading along the first axis, which it keeps.
    void move(const HalfSteps& way) {
        length(way.first);
        if (way.second == 0) return;
        put("-");
        length(way.second);
        put("+");
    }

private:
    void length(std::int64_t halves) {
        if (halves == 2) {
            put("f");
        } else if (halves != 0) {
            put(fmt::format("f({}{}{})", halves < 0 ? "-" : "", std::abs(halves) / 2, halves % 2 != 0 ? ".5" : ""));
        }
    }

    std::string& text_;
    std::uint32_t headings_;
    std::size_t column_ = 7;  // behind `axiom: `
};

constexpr std::size_t colour_count = 8;
constexpr std::size_t most_listed_gaps = 1000;

}  // namespace

KolamPattern kolam_pattern(const DotGrid& grid, const GapStates& states, const KolamPatternOptions& options) {
    const std::vector<ArcStep> starts = line_starts(grid, states, options.monitor);
    KolamPattern pattern;
    pattern.lines = starts.size();
    std::string& text = pattern.text;
    if (!options.title.empty()) text += fmt::format("title: {}\n", options.title);
    if (!options.description.empty()) text += fmt::format("description: {}\n", options.description);
    if (states.size() <= most_listed_gaps) {
        text += fmt::format("// grid: {}\n// gaps: {}\n", grid.text(), gap_states_text(grid, states));
    }
    const Walk walk = walk_of(grid.lattice());
    text +=
        fmt::format("\nderivation length: 0\nangle factor: {}\nheading: {}\naxiom: ", walk.headings, walk.heading);

    const std::size_t line_colours = options.coloured ? colour_count : 1;
    const std::string pen_up = fmt::format(";({})", line_colours);
    const HalfSteps origin = side_middle(grid, starts[0].dot, entry(grid, starts[0]));
    const bool single = starts.size() == 1;
    WordWriter word(text, walk.headings);
    HalfSteps at = origin;
    if (!single) word.put(pen_up);
    Pulse pulse(options.monitor);
    for (std::size_t i = 0; i < starts.size(); ++i) {
        const ArcStep& start = starts[i];
        const HalfSteps place = side_middle(grid, start.dot, entry(grid, start));
        word.move(place - at);
        at = place;
        if (!single) {
            word.put("[");
            word.put(fmt::format(";({})", i % line_colours));
        }
        word.turn(heading(grid, start));
        ArcStep step = start;
        std::uint32_t last_heading = 0;
        do {
            pulse();
            last_heading = heading(grid, step);
            const ArcStep next = next_step(grid, states, step);
            word.put("F");
            if (next != start) word.turn(heading(grid, next) + walk.headings - last_heading);
            step = next;
            if (text.size() > most_pattern_bytes) {
                throw std::runtime_error(fmt::format("the pattern of a kolam on {} would be over {} MB long",
                                                     grid.text(), most_pattern_bytes >> 20U));
            }
        } while (step != start);
        if (single && options.dot_symbols) word.turn(walk.headings - last_heading);
        if (!single) word.put("]");
    }
    if (options.dot_symbols) {
        if (single) {
            // The stroke has to end before the turtle leaves it.
            word.put("[]");
            word.put(pen_up);
        }
        for (std::uint32_t dot = 0; dot < grid.dots().size(); ++dot) {
            pulse();
            const HalfSteps place = place_of_dot(grid, dot);
            word.move(place - at);
            at = place;
            word.put("[;(0)@.]");
        }
    }
    text += '\n';

    text += "\nground: #7d3324\nline: spline\n";
    text += fmt::format("stroke: 0.16 step {}\n", rice);
    if (!single || options.dot_symbols) {
        text += fmt::format("palette: {} transparent\n", options.coloured ? kolam_colours : rice);
    }

    for (std::uint32_t dot = 0; dot < grid.dots().size(); ++dot) {
        pulse();
        const HalfSteps way = place_of_dot(grid, dot) - origin;
        pattern.dots.push_back(static_cast<double>(way.first) * walk.first +
                               static_cast<double>(way.second) * walk.second);
    }
    return pattern;
}

}  // namespace sikku
