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

/// Half steps along the two diagonals: up right, and up left. The turtle's coordinates before they are turned by 45
/// degrees.
struct Diagonal {
    std::int64_t up_right = 0;
    std::int64_t up_left = 0;
    bool operator==(const Diagonal&) const = default;
};
Diagonal operator-(const Diagonal& a, const Diagonal& b) {
    return {a.up_right - b.up_right, a.up_left - b.up_left};
}

/// A dot spacing to the right is one step up right and one back from up left.
Diagonal diagonal(GridDot dot) {
    return {std::int64_t{dot.y} + dot.x, std::int64_t{dot.y} - dot.x};
}
Diagonal side_middle(const DotGrid& grid, std::uint32_t dot, std::uint32_t side) {
    GridDot place = grid.dots()[dot];
    // Half a spacing is one unit here, as GridDot counts in halves.
    if (side == right_side) ++place.x;
    if (side == upper_side) ++place.y;
    if (side == left_side) --place.x;
    if (side == lower_side) --place.y;
    return diagonal(place);
}

/// Symbols, broken into lines where they may be.
class WordWriter {
public:
    explicit WordWriter(std::string& text) : text_(text) {}
    void put(std::string_view symbol) {
        if (column_ + symbol.size() > 108) {
            text_ += " \\\n    ";
            column_ = 4;
        }
        text_ += symbol;
        column_ += symbol.size();
    }
    /// Quarter turns anticlockwise.
    void turn(std::uint32_t quarters) {
        switch (quarters % 4) {
            case 1:
                return put("-");
            case 2:
                return put("|");
            case 3:
                return put("+");
            default:
                return;
        }
    }
    /// Moves with heading up right, which it keeps.
    void move(const Diagonal& way) {
        length(way.up_right);
        if (way.up_left == 0) return;
        put("-");
        length(way.up_left);
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
    std::size_t column_ = 7;  // behind `axiom: `
};

constexpr std::size_t colour_count = 8;
constexpr std::size_t most_listed_gaps = 1000;

}  // namespace

KolamPattern kolam_pattern(const DotGrid& grid, const Crossings& crossings, const KolamPatternOptions& options) {
    const std::vector<ArcStep> starts = line_starts(grid, crossings, options.monitor);
    KolamPattern pattern;
    pattern.lines = starts.size();
    std::string& text = pattern.text;
    if (!options.title.empty()) text += fmt::format("title: {}\n", options.title);
    if (!options.description.empty()) text += fmt::format("description: {}\n", options.description);
    if (crossings.size() <= most_listed_gaps) {
        text += fmt::format("// crossings: {}\n", crossings_text(grid, crossings));
    }
    text += "\nderivation length: 0\nangle factor: 4\nheading: 45\naxiom: ";

    const std::size_t line_colours = options.coloured ? colour_count : 1;
    const std::string pen_up = fmt::format(";({})", line_colours);
    const Diagonal origin = side_middle(grid, starts[0].dot, starts[0].entry());
    const bool single = starts.size() == 1;
    WordWriter word(text);
    Diagonal at = origin;
    if (!single) word.put(pen_up);
    Pulse pulse(options.monitor);
    for (std::size_t i = 0; i < starts.size(); ++i) {
        const ArcStep& start = starts[i];
        const Diagonal place = side_middle(grid, start.dot, start.entry());
        word.move(place - at);
        at = place;
        if (!single) {
            word.put("[");
            word.put(fmt::format(";({})", i % line_colours));
        }
        word.turn(start.heading());
        ArcStep step = start;
        std::uint32_t heading = 0;
        do {
            pulse();
            heading = step.heading();
            const ArcStep next = next_step(grid, crossings, step);
            word.put("F");
            if (next != start) word.turn(next.heading() + 4 - heading);
            step = next;
            if (text.size() > most_pattern_bytes) {
                throw std::runtime_error(fmt::format("the pattern of a kolam on {} would be over {} MB long",
                                                     grid.text(), most_pattern_bytes >> 20U));
            }
        } while (step != start);
        if (single && options.dot_symbols) word.turn(4 - heading);
        if (!single) word.put("]");
    }
    if (options.dot_symbols) {
        if (single) {
            // The stroke has to end before the turtle leaves it.
            word.put("[]");
            word.put(pen_up);
        }
        for (const GridDot dot : grid.dots()) {
            pulse();
            word.move(diagonal(dot) - at);
            at = diagonal(dot);
            word.put("[;(0)@.]");
        }
    }
    text += '\n';

    text += "\nground: #7d3324\nline: spline\n";
    text += fmt::format("stroke: 0.16 step {}\n", rice);
    if (!single || options.dot_symbols) {
        text += fmt::format("palette: {} transparent\n", options.coloured ? kolam_colours : rice);
    }

    const double half = std::numbers::sqrt2 / 4;  // a half step, along either axis
    for (const GridDot dot : grid.dots()) {
        pulse();
        const Diagonal way = diagonal(dot) - origin;
        pattern.dots.emplace_back(half * static_cast<double>(way.up_right - way.up_left),
                                  half * static_cast<double>(way.up_right + way.up_left));
    }
    return pattern;
}

}  // namespace sikku
