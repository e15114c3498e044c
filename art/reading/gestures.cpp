#include "art/reading/gestures.h"

#include "art/reading/gesture_drawing.h"
#include "art/reading/kolam_lines.h"
#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

namespace sikku {
namespace {

[[noreturn]] void refuse_gestures(const std::string& what) {
    throw std::runtime_error("gestures: " + what);
}

/// Refuses gestures that a grid of gaps cannot represent.
void check_gesture(const std::string& gesture, std::size_t loop, std::size_t number) {
    const bool is_known = gesture == "c1" || gesture == "op" || gesture == "h3l" || gesture == "h3r";
    if (is_known || (gesture.size() == 2 && gesture[0] == 'o' && gesture[1] >= '1' && gesture[1] <= '4')) return;
    const std::string place = fmt::format("loop {}, gesture {}: '{}'", loop, number, printable(gesture, 20));
    if (!gesture.empty() && (gesture[0] == 'd' || gesture[0] == 't')) {
        refuse_gestures(place + " passes through the middle of four dots, where a grid of gaps has no crossing");
    }
    if (!gesture.empty() && (gesture[0] == 'c' || gesture[0] == 'h')) {
        refuse_gestures(place + " is a decoration, which a grid of gaps cannot represent");
    }
    refuse_gestures(place + " is unknown; expected O1 to O4, C1, H3L, H3R or OP");
}

void check_loop(const GestureLoop& loop, std::size_t number) {
    const GridDot start = *loop.start;
    if ((start.x % 2 != 0) == (start.y % 2 != 0)) {
        refuse_gestures(fmt::format("loop {} does not start midway between two dots", number));
    }
    if (loop.heading % 90 != 45) {
        refuse_gestures(
            fmt::format("loop {} starts with the heading {}; expected 45, 135, 225 or 315", number, loop.heading));
    }
    for (std::size_t i = 0; i < loop.gestures.size(); ++i) {
        check_gesture(loop.gestures[i], number, i + 1);
        if (loop.gestures[i] == "c1" && loop.gestures.size() != 1) {
            refuse_gestures(fmt::format("loop {}: C1 must be the only gesture of its loop", number));
        }
    }
}

constexpr std::array<GridDot, 4> four_sides = {{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};

}  // namespace

ReadKolam read_gestures(std::string_view text) {
    const std::vector<GestureLoop> loops = read_gesture_loops(text);
    std::vector<ClosedLine> lines;
    PassedDots passed(is_before);
    std::size_t decorated = 0;
    for (std::size_t i = 0; i < loops.size(); ++i) {
        check_loop(loops[i], i + 1);
        ClosedLine& line = lines.emplace_back();
        for (const auto& [at, way] : follow_gestures(loops[i], i + 1, passed, decorated)) {
            line.emplace_back(at.x + 0.5 * way.x, at.y + 0.5 * way.y);
        }
    }
    std::vector<GridDot> dots;
    for (const auto& [dot, sides_passed] : passed) dots.push_back(dot);
    ReadKolam kolam = read_gaps(place_grid(DotLattice::square, std::move(dots)), lines);
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
    PlaceBox box;
    for (const GridDot dot : grid.dots()) box.add(dot);
    std::string sequence;
    std::string x = "0";
    std::string y = "1";
    std::string headings = "90";
    std::string positions = "Ov";
    bool has_loops = false;
    bool has_rings = false;
    const auto add = [&](GridDot at, int heading) {
        x += fmt::format(" {}", at.x - box.low.x + 2);
        y += fmt::format(" {}", at.y - box.low.y + 2);
        headings += fmt::format(" {}", heading);
        positions += (at.y - box.low.y) % 2 != 0 ? " Ov" : " Oh";
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
            add(around + four_sides[side], clockwise[heading(grid, step)]);
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
