#include "art/reading/gestures.h"

#include "art/reading/gesture_loops.h"
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

[[noreturn]] void refuse(const std::string& what) {
    throw std::runtime_error("gestures: " + what);
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
        refuse(place + " passes through the middle of four dots, where a grid of gaps has no crossing");
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
    Hand(const GestureLoop& loop, std::size_t number)
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

    const GestureLoop& loop_;
    std::size_t number_;
    GridDot at_;
    int heading_;
};

}  // namespace

ReadKolam read_gestures(std::string_view text) {
    const std::vector<GestureLoop> loops = read_gesture_loops(text);
    std::vector<ClosedLine> lines;
    std::vector<GridDot> dots;
    std::set<std::vector<std::pair<std::int32_t, std::int32_t>>> seen;
    std::size_t decorated = 0;
    for (std::size_t i = 0; i < loops.size(); ++i) {
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
