#include "art/kolam/dot_grid_pattern.h"

#include "art/print/ornaments.h"
#include "engine/base/diagnostic.h"
#include "engine/base/text.h"
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

/// Directions in which the turtle walks a lattice, before the drawing is turned.
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

/// Writes symbols, with line breaks where they are allowed.
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
    /// Turns anticlockwise, in units of a full turn / headings.
    void turn(std::uint32_t count) {
        count %= headings_;
        if (2 * count == headings_) return put("|");
        if (2 * count < headings_) {
            for (; count > 0; --count) put("-");
        } else {
            for (; count < headings_; ++count) put("+");
        }
    }
    /// Moves; the heading is along the first axis before and after.
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
    std::size_t column_ = 7;  // after `axiom: `
};

constexpr std::size_t colour_count = 8;

/// The turns after each step of a line, the last one back into the direction of the first.
std::vector<std::uint8_t> turns_of(const DotGrid& grid, const GapStates& states, const ArcStep& start, Pulse& pulse) {
    std::vector<std::uint8_t> turns;
    ArcStep step = start;
    do {
        pulse();
        const ArcStep next = next_step(grid, states, step);
        turns.push_back(
            static_cast<std::uint8_t>((heading(grid, next) + grid.sides() - heading(grid, step)) % grid.sides()));
        step = next;
    } while (step != start);
    return turns;
}

/// The least number of steps after which the turns repeat, a divisor of their number: by the borders of prefixes
/// (Knuth, Morris & Pratt 1977).
std::size_t period_of(const std::vector<std::uint8_t>& turns) {
    std::vector<std::uint32_t> border(turns.size() + 1, 0);
    std::size_t length = 0;
    for (std::size_t i = 1; i < turns.size(); ++i) {
        while (length > 0 && turns[i] != turns[length]) length = border[length];
        if (turns[i] == turns[length]) ++length;
        border[i + 1] = static_cast<std::uint32_t>(length);
    }
    const std::size_t period = turns.size() - border[turns.size()];
    return turns.size() % period == 0 ? period : turns.size();
}

class PatternWriter {
public:
    PatternWriter(const DotGrid& grid, const GapStates& states, const KolamPatternOptions& options)
        : grid_(grid),
          options_(options),
          walk_(walk_of(grid.lattice())),
          pulse_(options.monitor),
          line_colours_(options.coloured ? colour_count : 1),
          pen_up_(fmt::format(";({})", line_colours_)) {
        const std::vector<ArcStep> starts = line_starts(grid, states, options.monitor);
        pattern_.lines = starts.size();
        is_single_ = starts.size() == 1;
        origin_ = at_ = side_middle(grid, starts[0].dot, entry(grid, starts[0]));
        write_head(states);
        if (is_single_) {
            write_single(starts[0], turns_of(grid, states, starts[0], pulse_));
        } else {
            write_keys(0);
            const std::vector<std::uint32_t> orbits = options.coloured ? line_orbits(grid, states, options.monitor)
                                                                       : std::vector<std::uint32_t>(starts.size());
            WordWriter word(text_, walk_.headings);
            word.put(pen_up_);
            for (std::size_t i = 0; i < starts.size(); ++i) {
                write_branch(word, orbits[i], starts[i], turns_of(grid, states, starts[i], pulse_));
            }
            if (options.dot_symbols) write_dots(word);
            text_ += '\n';
        }
        write_style();
    }

    KolamPattern pattern() {
        for (std::uint32_t dot = 0; dot < grid_.dots().size(); ++dot) {
            pulse_();
            const HalfSteps way = place_of_dot(grid_, dot) - origin_;
            pattern_.dots.push_back(static_cast<double>(way.first) * walk_.first +
                                    static_cast<double>(way.second) * walk_.second);
        }
        return std::move(pattern_);
    }

private:
    void write_head(const GapStates& states) {
        text_ += kolam_head(options_);
        if (states.size() > most_listed_gaps) return;
        text_ += fmt::format("// grid: {}\n// gaps: {}\n", grid_.text(), gap_states_text(grid_, states));
    }
    void write_keys(int steps) {
        text_ += fmt::format("\nderivation length: {}\nangle factor: {}\nheading: {}\naxiom: ", steps, walk_.headings,
                             walk_.heading);
    }
    /// A line with rotational symmetry repeats its first part, which becomes a production.
    void write_single(const ArcStep& start, const std::vector<std::uint8_t>& turns) {
        const std::size_t period = period_of(turns);
        const bool repeats = period < turns.size();
        write_keys(repeats ? 1 : 0);
        WordWriter word(text_, walk_.headings);
        word.turn(heading(grid_, start));
        if (repeats) {
            for (std::size_t i = 0; i < turns.size(); i += period) word.put("A");
        } else {
            write_steps(word, turns, turns.size());
        }
        if (options_.dot_symbols) {
            if (!repeats) word.turn(turns.back());
            word.turn(walk_.headings - heading(grid_, start));
            // The stroke has to end before the turtle leaves it.
            word.put("[]");
            word.put(pen_up_);
            write_dots(word);
        }
        text_ += '\n';
        if (!repeats) return;
        text_ += "A --> ";
        WordWriter part(text_, walk_.headings);
        write_steps(part, turns, period);
        part.turn(turns[period - 1]);
        text_ += '\n';
    }
    void write_branch(WordWriter& word, std::uint32_t orbit, const ArcStep& start,
                      const std::vector<std::uint8_t>& turns) {
        const HalfSteps place = side_middle(grid_, start.dot, entry(grid_, start));
        word.move(place - at_);
        at_ = place;
        word.put("[");
        word.put(fmt::format(";({})", orbit % line_colours_));
        word.turn(heading(grid_, start));
        write_steps(word, turns, turns.size());
        word.put("]");
    }
    /// Steps with the turns between them.
    void write_steps(WordWriter& word, const std::vector<std::uint8_t>& turns, std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) {
            pulse_();
            word.put("F");
            if (i + 1 < count) word.turn(turns[i]);
            if (text_.size() > most_pattern_bytes) {
                throw std::runtime_error(fmt::format("the pattern of a kolam on {} would be over {} MB long",
                                                     grid_.text(), most_pattern_bytes >> 20U));
            }
        }
    }
    void write_dots(WordWriter& word) {
        for (std::uint32_t dot = 0; dot < grid_.dots().size(); ++dot) {
            pulse_();
            const HalfSteps place = place_of_dot(grid_, dot);
            word.move(place - at_);
            at_ = place;
            word.put("[;(0)@.]");
        }
    }
    void write_style() {
        text_ += "\nground: #7d3324\nline: spline\n";
        text_ += fmt::format("stroke: 0.16 step {}\n", rice);
        if (!is_single_ || options_.dot_symbols) {
            text_ += fmt::format("palette: {} transparent\n", options_.coloured ? kolam_colours : rice);
        }
    }

    const DotGrid& grid_;
    const KolamPatternOptions& options_;
    Walk walk_;
    Pulse pulse_;
    std::size_t line_colours_;
    std::string pen_up_;
    KolamPattern pattern_;
    std::string& text_ = pattern_.text;
    bool is_single_ = false;
    HalfSteps origin_;
    HalfSteps at_;
};

}  // namespace

KolamPattern kolam_pattern(const DotGrid& grid, const GapStates& states, const KolamPatternOptions& options) {
    return PatternWriter(grid, states, options).pattern();
}

std::string kolam_head(const KolamPatternOptions& options) {
    std::string head;
    for (const auto& [key, value] : {std::pair("title", &options.title), {"description", &options.description}}) {
        const std::string line = pattern_line(*value);
        if (!line.empty()) head += fmt::format("{}: {}\n", key, line);
    }
    return head;
}

std::string_view kolam_comment(std::string_view pattern, std::string_view name) {
    const std::string mark = fmt::format("\n// {}: ", name);
    const std::size_t at = pattern.find(mark);
    if (at == std::string_view::npos) return {};
    const std::string_view rest = pattern.substr(at + mark.size());
    return trimmed(rest.substr(0, rest.find_first_of("\r\n")));
}

}  // namespace sikku
