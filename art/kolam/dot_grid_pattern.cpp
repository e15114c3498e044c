#include "art/kolam/dot_grid_pattern.h"

#include "art/kolam/kolam_rim.h"
#include "art/kolam/rounded_lines.h"
#include "art/kolam/turtle_walk.h"
#include "art/print/ornaments.h"
#include "engine/base/diagnostic.h"
#include "engine/base/text.h"
#include "engine/geometry/box.h"
#include "engine/language/pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string_view>

namespace sikku {
namespace {

/// Half steps of the turtle along two axes, up right and up left, at right angles.
struct HalfSteps {
    std::int64_t first = 0;
    std::int64_t second = 0;
};
HalfSteps operator-(const HalfSteps& a, const HalfSteps& b) {
    return {a.first - b.first, a.second - b.second};
}

/// From the first dot to a place that is given as the sum of two, in halves of the units of GridDot.
HalfSteps half_steps(const DotGrid& grid, GridDot a, GridDot b) {
    const GridDot from = grid.dots().front();
    const std::int64_t x = a.x + b.x - 2 * from.x, y = a.y + b.y - 2 * from.y;
    return {(y + x) / 2, (y - x) / 2};
}
HalfSteps place_of_dot(const DotGrid& grid, std::uint32_t dot) {
    return half_steps(grid, grid.dots()[dot], grid.dots()[dot]);
}
HalfSteps side_middle(const DotGrid& grid, std::uint32_t dot, std::uint32_t side) {
    return half_steps(grid, grid.dots()[dot], grid.dots()[dot] + grid.step(side));
}

/// Writes symbols, with line breaks where they are allowed.
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
    /// Turns anticlockwise, in quarters.
    void turn(std::uint32_t count) {
        static constexpr std::string_view turns[] = {"", "-", "|", "+"};
        put(turns[count % 4]);
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

/// The sum of the turns of a part of a line.
std::uint32_t turned_by(const std::vector<std::uint8_t>& turns, std::size_t count) {
    return std::accumulate(turns.begin(), turns.begin() + static_cast<std::ptrdiff_t>(count), 0U);
}

constexpr double steps_per_spacing = 2;  // of rounded lines
constexpr double stroke_steps = 0.16;

/// The box of a closed uniform cubic B-spline: of its knots and the middles between them.
Box box_of_spline(std::span<const glm::dvec2> controls) {
    Box box;
    const auto at = [&](std::size_t i) { return controls[i % controls.size()]; };
    for (std::size_t i = 0; i < controls.size(); ++i) {
        box.add((at(i) + 4.0 * at(i + 1) + at(i + 2)) / 6.0);
        box.add((at(i) + 23.0 * at(i + 1) + 23.0 * at(i + 2) + at(i + 3)) / 48.0);
    }
    return box;
}

class PatternWriter {
public:
    PatternWriter(const DotGrid& grid, const GapStates& states, const KolamPatternOptions& options)
        : grid_(grid),
          states_(states),
          options_(options),
          centres_(options.centred_dots ? crossed_cells(grid, states) : std::vector<GridDot>()),
          rim_(grid, states, options.rim),
          is_rounded_(grid.lattice() == DotLattice::triangular || rim_.shaped() > 0),
          pulse_(options.monitor),
          starts_(line_starts(grid, states, options.monitor)),
          line_colours_(options.coloured && !is_single() ? colour_count : 1),
          pen_up_(fmt::format(";({})", line_colours_)) {
        pattern_.lines = starts_.size();
        pattern_.shaped = rim_.shaped();
        pattern_.centred = centres_.size();
        write_head();
        is_rounded_ ? write_rounded() : write_on_lattice();
        pattern_.line = stroke_steps / (is_rounded_ ? steps_per_spacing : std::numbers::sqrt2);
        pattern_.size = box_.size() + pattern_.line;
        write_style();
    }

    KolamPattern pattern() { return std::move(pattern_); }

private:
    void write_head() {
        text_ += kolam_head(options_);
        if (states_.size() > most_listed_gaps) return;
        text_ += fmt::format("// grid: {}\n// gaps: {}\n", grid_.text(), gap_states_text(grid_, states_));
        if (!centres_.empty()) text_ += "// centred dots: yes\n";
        if (options_.rim != RimStyle::round) text_ += fmt::format("// rim: {}\n", rim_style_name(options_.rim));
    }
    /// Faces show where dots are, except centred ones.
    bool marks_dots() const { return options_.dot_symbols || !centres_.empty(); }
    /// A dot, transparent if it is only marked.
    std::string dot_symbol() const { return fmt::format("[;({})@.]", options_.dot_symbols ? 0 : line_colours_); }
    bool is_single() const { return starts_.size() == 1; }
    /// The class of each line, which determines its colour.
    std::vector<std::uint32_t> classes() const {
        if (options_.coloured) return line_orbits(grid_, states_, options_.monitor);
        return std::vector<std::uint32_t>(starts_.size());
    }
    void check_length() {
        pulse_();
        if (text_.size() > most_pattern_bytes) refuse_length();
    }
    [[noreturn]] void refuse_length() const {
        throw std::runtime_error(fmt::format("the pattern of a kolam on {} would be over {} MB long", grid_.text(),
                                             most_pattern_bytes >> 20U));
    }

    // --- on the lattice ---

    void write_on_lattice() {
        const ArcStep& start = starts_[0];
        origin_ = at_ = side_middle(grid_, start.dot, entry(grid_, start));
        if (is_single()) {
            write_single(start, turns_of(grid_, states_, start, pulse_));
        } else {
            write_keys(0);
            const std::vector<std::uint32_t> orbits = classes();
            WordWriter word(text_);
            word.put(pen_up_);
            for (std::size_t i = 0; i < starts_.size(); ++i) {
                write_branch(word, orbits[i], starts_[i], turns_of(grid_, states_, starts_[i], pulse_));
            }
            if (marks_dots()) write_dots(word);
            text_ += '\n';
        }
        constexpr double half = std::numbers::sqrt2 / 4;
        constexpr double reach = 1.0 / 3;  // of a line that turns back at the rim, whose control point is 1/2 away
        for (std::uint32_t dot = 0; dot < grid_.dots().size(); ++dot) {
            pulse_();
            box_.add(dot_place(grid_, dot), reach);
            const HalfSteps way = place_of_dot(grid_, dot) - origin_;
            pattern_.dots.emplace_back(half * static_cast<double>(way.first - way.second),
                                       half * static_cast<double>(way.first + way.second));
        }
    }
    void write_keys(int steps) {
        text_ += fmt::format("\nderivation length: {}\nangle factor: 4\nheading: 45\naxiom: ", steps);
    }
    /// A line with rotational symmetry repeats its first part, which becomes a production.
    void write_single(const ArcStep& start, const std::vector<std::uint8_t>& turns) {
        const std::size_t period = period_of(turns);
        const bool repeats = period < turns.size();
        write_keys(repeats ? 1 : 0);
        WordWriter word(text_);
        word.turn(heading(grid_, start));
        if (repeats) {
            for (std::size_t i = 0; i < turns.size(); i += period) word.put("A");
        } else {
            write_steps(word, turns, turns.size());
        }
        if (marks_dots()) {
            if (!repeats) word.turn(turns.back());
            word.turn(4 - heading(grid_, start));
            // The stroke has to end before the turtle leaves it.
            word.put("[]");
            word.put(pen_up_);
            write_dots(word);
        }
        text_ += '\n';
        if (!repeats) return;
        text_ += "A --> ";
        WordWriter part(text_);
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
            word.put("F");
            if (i + 1 < count) word.turn(turns[i]);
            check_length();
        }
    }
    void write_dots(WordWriter& word) {
        const std::string symbol = dot_symbol();
        const auto write = [&](GridDot dot) {
            pulse_();
            const HalfSteps place = half_steps(grid_, dot, dot);
            word.move(place - at_);
            at_ = place;
            word.put(symbol);
        };
        std::for_each(grid_.dots().begin(), grid_.dots().end(), write);
        std::for_each(centres_.begin(), centres_.end(), write);
    }

    // --- rounded ---

    std::vector<glm::dvec2> controls_of(const ArcStep& start) {
        std::vector<glm::dvec2> controls = rounded_line(grid_, states_, start, rim_, pulse_);
        const Box line = box_of_spline(controls);
        box_.add(line.low);
        box_.add(line.high);
        for (glm::dvec2& control : controls) control *= steps_per_spacing;
        return controls;
    }
    void write_rounded() {
        constexpr std::size_t least_bytes = 8;  // of a step
        if (least_bytes * grid_.sides() * grid_.dots().size() > most_pattern_bytes) refuse_length();
        const std::vector<glm::dvec2> first = controls_of(starts_[0]);
        TurtleWalk walk(text_, first[0], 0);
        if (is_single()) {
            write_rounded_single(walk, first, turns_of(grid_, states_, starts_[0], pulse_));
        } else {
            write_rounded_keys(0);
            walk.put(pen_up_);
            const std::vector<std::uint32_t> orbits = classes();
            for (std::size_t i = 0; i < starts_.size(); ++i) {
                const std::vector<glm::dvec2> controls = controls_of(starts_[i]);
                walk.move(controls[0], 'f');
                walk.put(fmt::format("[;({})", orbits[i] % line_colours_));
                TurtleWalk line = walk;
                write_along(line, controls, controls.size());
                walk.put("]");
            }
            mark_dots(walk);
        }
        for (std::uint32_t dot = 0; dot < grid_.dots().size(); ++dot) {
            pulse_();
            pattern_.dots.push_back(steps_per_spacing * dot_place(grid_, dot) - first[0]);
        }
    }
    void write_rounded_keys(int steps) {
        text_ += fmt::format("\nderivation length: {}\nheading: 0\naxiom: ", steps);
    }
    void write_along(TurtleWalk& line, const std::vector<glm::dvec2>& controls, std::size_t count) {
        for (std::size_t i = 1; i <= count; ++i) {
            line.move(controls[i % controls.size()], 'F');
            check_length();
        }
    }
    void write_rounded_single(TurtleWalk& walk, std::vector<glm::dvec2> controls,
                              const std::vector<std::uint8_t>& turns) {
        const std::size_t steps = period_of(turns), repeated = turns.size() / steps;
        // Where the rim is less symmetric than the line, nothing repeats.
        const std::size_t parts = controls.size() % repeated == 0 ? repeated : 1, period = controls.size() / parts;
        write_rounded_keys(parts > 1 ? 1 : 0);
        if (parts == 1) {
            write_along(walk, controls, controls.size());
            walk.put("[]");
            mark_dots(walk);
            return;
        }
        // Repeated parts are exact images, or the line would not close.
        const glm::dvec2 centre =
            std::accumulate(controls.begin(), controls.end(), glm::dvec2(0.0)) / static_cast<double>(controls.size());
        const glm::dvec2 turn = lattice_ray(grid_.lattice(), turned_by(turns, steps));
        const auto image = [&](glm::dvec2 place, double sign) {
            const glm::dvec2 from = place - centre;
            return centre +
                   glm::dvec2(turn.x * from.x - sign * turn.y * from.y, sign * turn.y * from.x + turn.x * from.y);
        };
        const double begun = direction_of(image(controls[period - 1], -1), controls[0]);
        walk.turn(begun);
        for (std::size_t i = 0; i < parts; ++i) walk.put("A");
        walk.put("[]");
        mark_dots(walk);
        text_ += "A --> ";
        TurtleWalk part(text_, controls[0], begun);
        controls[period] = image(controls[0], 1);
        write_along(part, controls, period);
        text_ += '\n';
    }
    /// Marks dots with a transparent pen if they are not drawn, since faces between rounded lines do not show where
    /// they are.
    void mark_dots(TurtleWalk& walk) {
        const std::string symbol = dot_symbol();
        walk.put(pen_up_);
        const auto mark = [&](GridDot dot) {
            walk.move(steps_per_spacing * lattice_point(grid_.lattice(), dot), 'f');
            walk.put(symbol);
            check_length();
        };
        std::for_each(grid_.dots().begin(), grid_.dots().end(), mark);
        std::for_each(centres_.begin(), centres_.end(), mark);
        text_ += '\n';
    }

    void write_style() {
        text_ += "\nground: #7d3324\nline: spline\n";
        text_ += fmt::format("stroke: {} step {}\n", stroke_steps, rice);
        if (is_rounded_ || !is_single() || marks_dots()) {
            text_ += fmt::format("palette: {} transparent\n", line_colours_ > 1 ? kolam_colours : rice);
        }
    }

    const DotGrid& grid_;
    const GapStates& states_;
    const KolamPatternOptions& options_;
    std::vector<GridDot> centres_;
    KolamRim rim_;
    bool is_rounded_;
    Pulse pulse_;
    std::vector<ArcStep> starts_;
    std::size_t line_colours_;
    std::string pen_up_;
    KolamPattern pattern_;
    Box box_;  // of the lines without their width, in spacings
    std::string& text_ = pattern_.text;
    HalfSteps origin_;
    HalfSteps at_;
};

}  // namespace

std::vector<GridDot> crossed_cells(const DotGrid& grid, const GapStates& states) {
    std::vector<GridDot> cells;
    if (grid.lattice() != DotLattice::square) return cells;
    const auto is_crossed = [&](std::uint32_t dot, std::uint32_t side) {
        const std::int32_t gap = grid.gap(dot, side);
        return gap >= 0 && states[static_cast<std::size_t>(gap)] == GapState::crossed;
    };
    constexpr std::uint32_t right = 0, down = 3;
    for (std::uint32_t dot = 0; dot < grid.dots().size(); ++dot) {
        if (!is_crossed(dot, right) || !is_crossed(dot, down)) continue;
        const std::uint32_t beside = *grid.dot_at(grid.dots()[dot] + grid.step(right));
        const std::uint32_t below = *grid.dot_at(grid.dots()[dot] + grid.step(down));
        if (is_crossed(beside, down) && is_crossed(below, right)) cells.push_back(grid.dots()[dot] + GridDot{1, -1});
    }
    return cells;
}

KolamPattern kolam_pattern(const DotGrid& grid, const GapStates& states, const KolamPatternOptions& options) {
    return PatternWriter(grid, states, options).pattern();
}

std::string kolam_head(const KolamPatternOptions& options) {
    std::string head;
    for (const auto& [key, value] :
         {std::pair("title", &options.title), {"source", &options.source}, {"description", &options.description}}) {
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
