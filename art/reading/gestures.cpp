#include "art/reading/gestures.h"

#include "art/reading/kolam_lines.h"
#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>
#include <vector>

namespace sikku {
namespace {

constexpr std::size_t most_gestures = 4 * DotGrid::most_dots;

/// A loop as it is drawn. Places in half spacings of dots, dots at even places, y up.
struct Loop {
    std::vector<std::string> gestures;
    std::optional<GridDot> start;
    int heading = 45;  ///< degrees clockwise from the top: 45, 135, 225 or 315
};

[[noreturn]] void refuse(const std::string& what) {
    throw std::runtime_error("gestures: " + what);
}

bool is_blank(char byte) {
    return byte == ' ' || byte == '\t' || byte == '\r' || byte == '\n';
}

std::vector<std::string_view> words_of(std::string_view text) {
    std::vector<std::string_view> words;
    for (std::size_t at = 0; at < text.size();) {
        if (is_blank(text[at]) || text[at] == ',') {
            ++at;
            continue;
        }
        std::size_t end = at;
        while (end < text.size() && !is_blank(text[end]) && text[end] != ',') ++end;
        words.push_back(text.substr(at, end - at));
        at = end;
    }
    return words;
}

/// The loops of `[["O1" "O2"] ["C1"]]`.
std::vector<Loop> parse_sequence(std::string_view text) {
    std::vector<Loop> loops;
    std::size_t count = 0;
    int depth = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text[at] == '[') {
            if (++depth > 2) refuse("the brackets of a loop contain brackets");
            if (depth == 2) loops.emplace_back();
        } else if (text[at] == ']') {
            if (--depth == 0) return loops;
        } else if (text[at] == '"') {
            const std::size_t end = text.find('"', at + 1);
            if (end == std::string_view::npos || depth != 2) refuse("'sequence' is damaged");
            if (++count > most_gestures) refuse("too many");
            loops.back().gestures.push_back(lower_case(text.substr(at + 1, end - at - 1)));
            at = end;
        } else if (depth > 0 && !is_blank(text[at]) && text[at] != ',') {
            refuse("'sequence' is damaged");
        }
    }
    refuse("'sequence' has no end");
}

/// The numbers of `[NAME 0 1.5 …]`.
std::vector<double> parse_history(std::string_view text, std::string_view name) {
    const std::size_t at = text.find(fmt::format("[{} ", name));
    const std::size_t end = text.find(']', at == std::string_view::npos ? text.size() : at);
    if (at == std::string_view::npos || end == std::string_view::npos)
        refuse(fmt::format("'history' lacks {}", name));
    std::vector<double> numbers;
    for (const std::string_view word : words_of(text.substr(at + name.size() + 2, end - at - name.size() - 2))) {
        double number = 0;
        if (!read_number(word, number)) refuse(fmt::format("{}: '{}' is not a number", name, printable(word, 40)));
        numbers.push_back(number);
    }
    return numbers;
}

std::int32_t half_spacings(double value, std::string_view what) {
    const double halves = std::round(2 * value);
    if (!(std::fabs(halves) < 1e6) || std::fabs(2 * value - halves) > 0.25) {
        refuse(fmt::format("{} is not midway between two dots", what));
    }
    return static_cast<std::int32_t>(halves);
}

int right_heading(double heading) {
    const double turned = heading - 360 * std::floor(heading / 360);
    const double rounded = std::round(turned);
    return static_cast<int>(rounded) % 360;
}

/// The transcription of a study: the history has the place and heading before each gesture, after one row more.
std::vector<Loop> parse_transcription(std::string_view text) {
    const auto value_after = [&](std::string_view key) {
        const std::size_t at = text.find(key);
        return at == std::string_view::npos ? std::string_view() : text.substr(at + key.size());
    };
    std::vector<Loop> loops = parse_sequence(value_after("sequence:"));
    const std::string_view size_text = value_after("matrix_size:");
    const std::string_view history = value_after("history:");
    if (history.empty()) return loops;
    double size = 0;
    if (!read_number(trimmed(size_text.substr(0, size_text.find_first_of("\r\n"))), size) || !(size > 0)) {
        refuse("'matrix_size' is not a number above 0");
    }
    const auto x = parse_history(history, "Oldx");
    const auto y = parse_history(history, "Oldy");
    const auto headings = parse_history(history, "Oldh");
    std::size_t row = 1;
    for (Loop& loop : loops) {
        if (row >= x.size() || row >= y.size() || row >= headings.size()) refuse("'history' is too short");
        // Diagonal gestures start elsewhere; they are refused where they are read.
        const bool is_orthogonal = !loop.gestures.empty() && loop.gestures[0][0] != 'd';
        if (is_orthogonal) {
            loop.start = GridDot{half_spacings(x[row] / size, "a start"), half_spacings(y[row] / size, "a start")};
        }
        loop.heading = right_heading(headings[row]);
        row += loop.gestures.size();
    }
    return loops;
}

std::vector<Loop> parse_rows(std::string_view text) {
    std::vector<Loop> loops;
    std::size_t count = 0;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        std::string_view row = trimmed(text.substr(at, end - at));
        at = end + 1;
        if (row.empty() || row == "\r") continue;
        Loop loop;
        if (const std::size_t colon = row.find(':'); colon != std::string_view::npos) {
            const auto numbers = words_of(row.substr(0, colon));
            std::array<double, 3> start{};
            bool is_good = numbers.size() == 3;
            for (std::size_t i = 0; i < 3 && is_good; ++i) is_good = read_number(numbers[i], start[i]);
            if (!is_good) refuse(fmt::format("loop {}: expected X,Y,HEADING before the colon", loops.size() + 1));
            loop.start = GridDot{half_spacings(start[0], "a start"), half_spacings(start[1], "a start")};
            loop.heading = right_heading(start[2]);
            row.remove_prefix(colon + 1);
        } else if (loops.empty()) {
            loop.start = GridDot{0, 1};
        }
        for (const std::string_view word : words_of(row)) {
            if (++count > most_gestures) refuse("too many");
            loop.gestures.push_back(lower_case(word));
        }
        loops.push_back(std::move(loop));
    }
    return loops;
}

/// Quarters that a gesture leads around a dot; 0 for a ring.
std::uint32_t quarters(const std::string& gesture, std::size_t loop, std::size_t number) {
    if (gesture == "c1") return 0;
    if (gesture == "op") return 4;
    if (gesture == "h3l" || gesture == "h3r") return 3;
    if (gesture.size() == 2 && gesture[0] == 'o' && gesture[1] >= '1' && gesture[1] <= '4') {
        return static_cast<std::uint32_t>(gesture[1] - '0');
    }
    const std::string place = fmt::format("loop {}, gesture {}: '{}'", loop, number, printable(gesture, 20));
    if (!gesture.empty() && (gesture[0] == 'd' || gesture[0] == 't')) {
        refuse(place + " passes between four dots; only gestures that cross between two dots can be read as gaps");
    }
    if (!gesture.empty() && (gesture[0] == 'c' || gesture[0] == 'h')) {
        refuse(place + " is a decoration, which a grid of gaps cannot represent");
    }
    refuse(place + " is unknown; expected O1 to O4, C1, H3L, H3R or OP");
}

constexpr std::array<GridDot, 4> sides = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

/// Follows the gestures of a loop.
class Hand {
public:
    Hand(const Loop& loop, std::size_t number)
        : loop_(loop), number_(number), at_(*loop.start), heading_(loop.heading) {
        check_start();
    }

    ClosedLine draw(std::vector<GridDot>& dots, std::size_t& decorated) {
        const GridDot start = at_;
        const int start_heading = heading_;
        ClosedLine line;
        for (std::size_t i = 0; i < loop_.gestures.size(); ++i) {
            const std::uint32_t count = quarters(loop_.gestures[i], number_, i + 1);
            decorated += loop_.gestures[i][0] == 'h' || loop_.gestures[i] == "op";
            const bool between_rows = at_.y % 2 != 0;  // above each other
            // The dot ahead, along the gap.
            const std::uint32_t ahead = between_rows ? (heading_ == 45 || heading_ == 315 ? 1U : 3U)
                                                     : (heading_ == 45 || heading_ == 135 ? 0U : 2U);
            const GridDot dot{at_.x + sides[ahead].x, at_.y + sides[ahead].y};
            dots.push_back(dot);
            const bool to_right = heading_ == 45 || heading_ == 135;
            const bool up = heading_ == 45 || heading_ == 315;
            // Anticlockwise around a dot above that is passed on its right, and so on.
            const bool anticlockwise = between_rows ? to_right == (ahead == 1) : up != (ahead == 0);
            const std::uint32_t entry = (ahead + 2) % 4;
            if (count == 0) {
                if (loop_.gestures.size() != 1)
                    refuse(fmt::format("loop {}: C1 must be the only gesture of its loop", number_));
                for (const GridDot side : sides) line.emplace_back(dot.x + 0.5 * side.x, dot.y + 0.5 * side.y);
                return line;
            }
            line.emplace_back(at_.x, at_.y);
            const std::uint32_t turn = anticlockwise ? 1 : 3;
            for (std::uint32_t k = 1; k < count; ++k) {
                const GridDot side = sides[(entry + k * turn) % 4];
                line.emplace_back(dot.x + 0.5 * side.x, dot.y + 0.5 * side.y);
            }
            const GridDot exit = sides[(entry + count * turn) % 4];
            at_ = {dot.x + exit.x, dot.y + exit.y};
            const int turned = 90 * static_cast<int>(count - 1);
            heading_ = (heading_ + (anticlockwise ? 360 - turned : turned)) % 360;
        }
        if (!(at_ == start) || heading_ != start_heading) {
            refuse(fmt::format("loop {} does not close: it starts at {:g},{:g} and ends at {:g},{:g}", number_,
                               0.5 * start.x, 0.5 * start.y, 0.5 * at_.x, 0.5 * at_.y));
        }
        return line;
    }

private:
    void check_start() const {
        if ((at_.x % 2 != 0) == (at_.y % 2 != 0)) {
            refuse(fmt::format("loop {} does not start midway between two dots", number_));
        }
        if (heading_ % 90 != 45) {
            refuse(
                fmt::format("loop {} starts with the heading {}; expected 45, 135, 225 or 315", number_, heading_));
        }
    }

    const Loop& loop_;
    std::size_t number_;
    GridDot at_;
    int heading_;
};

}  // namespace

bool is_gestures(std::string_view text) {
    text = text.substr(0, 4096);
    if (text.find("sequence:") != std::string_view::npos) return true;
    const std::string_view row = text.substr(0, text.find('\n'));
    const auto words = words_of(row.substr(row.find(':') == std::string_view::npos ? 0 : row.find(':') + 1));
    return !words.empty() && std::all_of(words.begin(), words.end(), [](std::string_view word) {
        const std::string name = lower_case(word);
        return name.size() <= 3 && name.size() >= 2 &&
               std::string_view("odtch").find(name[0]) != std::string_view::npos &&
               ((name[1] >= '1' && name[1] <= '4') || name == "op");
    });
}

ReadKolam read_gestures(std::string_view text) {
    const bool is_transcription = text.find("sequence:") != std::string_view::npos;
    const std::vector<Loop> loops = is_transcription ? parse_transcription(text) : parse_rows(text);
    if (loops.empty()) refuse("there are none");
    std::vector<ClosedLine> lines;
    std::vector<GridDot> dots;
    std::set<std::vector<std::pair<std::int32_t, std::int32_t>>> seen;
    std::size_t decorated = 0;
    for (std::size_t i = 0; i < loops.size(); ++i) {
        if (loops[i].gestures.empty()) refuse(fmt::format("loop {} is empty", i + 1));
        if (!loops[i].start) {
            quarters(loops[i].gestures[0], i + 1, 1);
            refuse(fmt::format("loop {} has no start; expected X,Y,HEADING: before its gestures", i + 1));
        }
        lines.push_back(Hand(loops[i], i + 1).draw(dots, decorated));
    }
    const PlacedGrid placed = place_grid(DotLattice::square, std::move(dots));
    std::vector<glm::dvec2> from;
    std::vector<glm::dvec2> to;
    for (const glm::dvec2 corner : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1), glm::dvec2(1, 1)}) {
        from.push_back(2.0 * corner + glm::dvec2(placed.origin.x, placed.origin.y));
        to.push_back(corner);
    }
    ReadKolam kolam = read_gaps(placed.grid, *Homography::fit(from, to), lines);
    if (decorated > 0) {
        kolam.notes.push_back(fmt::format("the decoration of {} was left out", counted(decorated, "gesture")));
    }
    return kolam;
}

std::string gestures_file(const DotGrid& grid, const GapStates& states) {
    if (grid.lattice() != DotLattice::square) {
        throw std::runtime_error("gestures can describe only straight grids; this one is interlaced");
    }
    const auto joined = std::find(states.begin(), states.end(), GapState::joined);
    if (joined != states.end()) {
        const auto gap = static_cast<std::size_t>(joined - states.begin());
        const GapPlace place = gap_places(grid)[gap];
        throw std::runtime_error(fmt::format("gestures cannot describe joined gaps, as in row {}, gap {} ({} in all)",
                                             place.row, place.number,
                                             std::count(states.begin(), states.end(), GapState::joined)));
    }
    std::int32_t left = INT32_MAX;
    std::int32_t bottom = INT32_MAX;
    for (const GridDot dot : grid.dots()) {
        left = std::min(left, dot.x);
        bottom = std::min(bottom, dot.y);
    }
    std::string sequence;
    std::string x = "0";
    std::string y = "1";
    std::string headings = "90";
    std::string positions = "Ov";
    bool has_loops = false;
    bool has_rings = false;
    const auto add = [&](GridDot at, int heading) {
        x += fmt::format(" {}", at.x - left + 2);
        y += fmt::format(" {}", at.y - bottom + 2);
        headings += fmt::format(" {}", heading);
        positions += (at.y - bottom) % 2 != 0 ? " Ov" : " Oh";
    };
    const std::vector<ArcStep> starts = line_starts(grid, states);
    for (const ArcStep& start : starts) {
        sequence += sequence.empty() ? "[" : " [";
        const auto is_crossing = [&](const ArcStep& step) {
            const std::int32_t gap = grid.gap(step.dot, entry(grid, step));
            return gap >= 0 && states[static_cast<std::size_t>(gap)] == GapState::crossed;
        };
        // The first crossing of the line; a ring has none.
        ArcStep first = start;
        bool is_ring = false;
        while (!is_crossing(first) && !is_ring) {
            first = next_step(grid, states, first);
            is_ring = first == start;
        }
        const GridDot dot = grid.dots()[first.dot];
        if (is_ring) {
            add({dot.x, dot.y - 1}, 45);
            sequence += "\"C1\"]";
            has_rings = true;
            continue;
        }
        has_loops = true;
        ArcStep step = first;
        do {
            const GridDot around = grid.dots()[step.dot];
            const std::uint32_t side = entry(grid, step);
            // Steps head up right, up left, down left, down right.
            constexpr std::array<int, 4> clockwise = {45, 315, 225, 135};
            add({around.x + sides[side].x, around.y + sides[side].y}, clockwise[heading(grid, step)]);
            std::uint32_t count = 0;
            do {
                ++count;
                step = next_step(grid, states, step);
            } while (!is_crossing(step));
            sequence += fmt::format("{}\"O{}\"", sequence.back() == '[' ? "" : " ", count);
        } while (step != first);
        sequence += ']';
    }
    const std::vector<std::uint32_t> rows = grid.rows();
    return fmt::format(
        "matrix_size: 2\npulli: {}\nloops: {}\nktype: \"{}__{}__\"\nsequence: '\n [{}]'\n\nhistory: "
        "\"[[history-array] [Oldx {}] [Oldy {}] [Oldh {}] [Oldpos {}]]\"\n",
        std::max<std::size_t>(rows.size(), *std::max_element(rows.begin(), rows.end())), starts.size(),
        has_loops ? 'O' : '_', has_rings ? 'C' : '_', sequence, x, y, headings, positions);
}

}  // namespace sikku
