#include "art/reading/gesture_drawing.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"
#include "engine/language/pattern.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace sikku {
namespace {

/// Eight directions, anticlockwise from the right.
constexpr std::array<GridDot, 8> ways = {{{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};

/// The direction of a heading in degrees clockwise from the top, a multiple of 45.
unsigned way_of(int heading) {
    return static_cast<unsigned>((450 - heading) / 45) % 8;
}

bool is_middle(GridDot at) {
    return at.x % 2 != 0 && at.y % 2 != 0;
}

struct Gesture {
    char kind = 'o';  ///< o, d, t or c
    unsigned quarters = 1;
    char side = ' ';  ///< l or r; blank: as the place requires
    bool is_decorated = false;
};

/// Follows the gestures of a loop.
class Hand {
public:
    Hand(const GestureLoop& loop, std::size_t number, PassedDots& dots, std::size_t& decorated)
        : loop_(loop),
          number_(number),
          dots_(dots),
          decorated_(decorated),
          at_(*loop.start),
          heading_(loop.heading) {}

    std::vector<HandPoint> draw() {
        const GridDot start = at_;
        const int start_heading = heading_;
        if (at_.x % 2 == 0 && at_.y % 2 == 0) refuse("starts on a dot");
        for (gesture_ = 0; gesture_ < loop_.gestures.size(); ++gesture_) {
            const Gesture gesture = parse(loop_.gestures[gesture_]);
            decorated_ += gesture.is_decorated ? 1 : 0;
            if (heading_ % 90 != (is_middle(at_) ? 0 : 45)) refuse(fmt::format("has the heading {} here", heading_));
            if (gesture.kind == 'c') return ring();
            if (gesture.kind == 'd' && gesture.quarters == 1 && gesture.side == ' ' && is_middle(at_)) {
                line_.push_back({at_, {}});
                const unsigned way = way_of(heading_);
                for (const unsigned side : {1U, 7U}) ++dots_[at_ + ways[(way + side) % 8]];
                at_ = at_ + ways[way] + ways[way];
            } else {
                turn_around(gesture);
            }
        }
        if (!(at_ == start) || heading_ != start_heading) {
            throw std::runtime_error(
                fmt::format("gestures: loop {} does not close: it starts at {:g},{:g} and ends at {:g},{:g}", number_,
                            0.5 * start.x, 0.5 * start.y, 0.5 * at_.x, 0.5 * at_.y));
        }
        return line_;
    }

private:
    [[noreturn]] void refuse(const std::string& what) const {
        const std::string text =
            gesture_ < loop_.gestures.size() ? printable(loop_.gestures[gesture_], 20) : std::string();
        throw std::runtime_error(
            fmt::format("gestures: loop {}, gesture {}: '{}' {}", number_, gesture_ + 1, text, what));
    }

    Gesture parse(const std::string& text) const {
        if (text == "c1") return {'c', 4, ' ', false};
        if (text == "op") return {'o', 4, ' ', true};
        if (text == "h3l" || text == "h3r") return {'o', 3, ' ', true};
        const bool is_known = (text.size() == 2 || (text.size() == 3 && (text[2] == 'l' || text[2] == 'r'))) &&
                              (text[0] == 'o' || text[0] == 'd' || text[0] == 't') && text[1] >= '1' &&
                              text[1] <= '4';
        if (!is_known) refuse("is unknown; expected O1 to O4, D1 to D4, T1 to T4, C1, H3L, H3R or OP");
        return {text[0], static_cast<unsigned>(text[1] - '0'), text.size() == 3 ? text[2] : ' ', false};
    }

    void add_dot(GridDot dot) { dots_[dot] += 2; }

    /// The dot ahead of a gap, and whether the line leads anticlockwise around it.
    std::pair<GridDot, bool> ahead_of_gap() const {
        const bool to_right = heading_ == 45 || heading_ == 135, up = heading_ == 45 || heading_ == 315;
        const bool is_between_rows = at_.y % 2 != 0;
        if (is_between_rows) return {at_ + ways[up ? 2 : 6], to_right == up};
        return {at_ + ways[to_right ? 0 : 4], up != to_right};
    }

    std::vector<HandPoint> ring() {
        if (loop_.gestures.size() != 1) refuse("must be the only gesture of its loop");
        if (is_middle(at_)) refuse("starts in the middle of four dots");
        const GridDot dot = ahead_of_gap().first;
        add_dot(dot);
        return {{dot, ways[0]}, {dot, ways[2]}, {dot, ways[4]}, {dot, ways[6]}};
    }

    void turn_around(const Gesture& gesture) {
        GridDot dot;
        bool anticlockwise = true;
        if (is_middle(at_)) {
            if (gesture.kind == 'o') refuse("starts between two dots, but the hand is in the middle of four");
            if (gesture.side == ' ') refuse("needs a side, L or R, in the middle of four dots");
            anticlockwise = gesture.side == 'l';
            dot = at_ + ways[(way_of(heading_) + (anticlockwise ? 1 : 7)) % 8];
        } else {
            if (gesture.kind == 'd') refuse("starts in the middle of four dots, but the hand is between two");
            std::tie(dot, anticlockwise) = ahead_of_gap();
        }
        add_dot(dot);
        line_.push_back({at_, {}});
        const GridDot from = at_ - dot;
        const auto entry = static_cast<unsigned>(std::find(ways.begin(), ways.end(), from) - ways.begin());
        const unsigned eighths = 2 * gesture.quarters + (gesture.kind == 't' ? 1 : 0);
        const unsigned turn = anticlockwise ? 1 : 7;
        for (unsigned k = 1; k < eighths; ++k) {
            const unsigned place = (entry + k * turn) % 8;
            if (place % 2 == 0) line_.push_back({dot, ways[place]});
        }
        at_ = dot + ways[(entry + eighths * turn) % 8];
        const int turned = 90 * static_cast<int>(gesture.quarters - 1) + (gesture.kind == 't' ? 45 : 0);
        heading_ = (heading_ + (anticlockwise ? 360 - turned : turned)) % 360;
    }

    const GestureLoop& loop_;
    std::size_t number_;
    PassedDots& dots_;
    std::size_t& decorated_;
    GridDot at_;
    int heading_;
    std::size_t gesture_ = 0;
    std::vector<HandPoint> line_;
};

/// Turns to a direction: `+` is an eighth anticlockwise.
std::string turn(unsigned& way, unsigned next) {
    const unsigned eighths = (next + 8 - way) % 8;
    way = next;
    if (eighths == 4) return "|";
    return eighths < 4 ? std::string(eighths, '+') : std::string(8 - eighths, '-');
}

/// A step between two control points: F along the rows and columns, G diagonally.
std::string step(GridDot from, GridDot to, unsigned& way) {
    const GridDot by = to - from;
    const int length = std::max(std::abs(by.x), std::abs(by.y));
    const GridDot unit{by.x / length, by.y / length};
    const auto next = static_cast<unsigned>(std::find(ways.begin(), ways.end(), unit) - ways.begin());
    return turn(way, next) + std::string(static_cast<std::size_t>(length), next % 2 == 0 ? 'F' : 'G');
}

}  // namespace

bool meets_between_four(std::string_view text) {
    for (const GestureLoop& loop : read_gesture_loops(text)) {
        for (const std::string& gesture : loop.gestures) {
            if (gesture.size() > 1 && (gesture[0] == 'd' || gesture[0] == 't')) return true;
        }
    }
    return false;
}

std::vector<HandPoint> follow_gestures(const GestureLoop& loop, std::size_t number, PassedDots& dots,
                                       std::size_t& decorated) {
    return Hand(loop, number, dots, decorated).draw();
}

GestureDrawing draw_gestures(std::string_view text) {
    GestureDrawing drawing;
    PassedDots dots(is_before);
    const std::vector<GestureLoop> loops = read_gesture_loops(text);
    for (std::size_t i = 0; i < loops.size(); ++i) {
        std::vector<GridDot>& line = drawing.lines.emplace_back();
        for (const auto& [at, way] : follow_gestures(loops[i], i + 1, dots, drawing.decorated)) {
            line.push_back(at + way);
        }
    }
    for (const auto& [dot, sides] : dots) {
        if (sides > 1) drawing.dots.push_back(dot);
    }
    return drawing;
}

std::string gesture_pattern(const GestureDrawing& drawing, const std::string& head) {
    std::string text = head;
    text += "\nderivation length: 0\nangle factor: 8\nheading: 0\naxiom: ";
    constexpr std::size_t columns = 100;
    std::size_t begin = text.size();
    const auto put = [&](const std::string& symbols) {
        if (text.size() - begin + symbols.size() > columns) {
            text += " \\\n    ";
            begin = text.size();
        }
        text += symbols;
    };
    const GridDot origin = drawing.lines.front().front();
    const auto place = [&](GridDot at) {
        const GridDot by = at - origin;
        return fmt::format("[;(1)f({})++f({})--", by.x, by.y);
    };
    for (const std::vector<GridDot>& line : drawing.lines) {
        if (text.size() > most_pattern_bytes) throw std::runtime_error("the pattern would be too long");
        put(place(line.front()) + ";(0)");
        unsigned way = 0;
        for (std::size_t i = 0; i < line.size(); ++i) put(step(line[i], line[(i + 1) % line.size()], way));
        put("]");
    }
    for (const GridDot dot : drawing.dots) put(place(dot) + ";(0)@.]");
    text +=
        "\nedge G: -f++f-\n\nground: #7d3324\nline: spline\nstroke: 0.22 step #fffaf0\n"
        "palette: #fffaf0 transparent\n";
    return text;
}

}  // namespace sikku
