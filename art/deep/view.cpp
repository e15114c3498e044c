#include "art/deep/view.h"

#include "engine/derivation/derivation.h"
#include "engine/measure/clumps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace sikku {
namespace {

constexpr std::uint64_t watched_nodes = 1 << 16;

/// The properties of a symbol in a walk, looked up once.
struct BracketTable {
    explicit BracketTable(const Grammar& grammar) {
        for (Symbol symbol = 0; symbol < grammar.symbols().size(); ++symbol) {
            is_push.push_back(grammar.is_push(symbol));
            is_pop.push_back(grammar.is_pop(symbol));
        }
    }
    std::vector<char> is_push, is_pop;
};

template <class Number>
struct ViewPlace {
    Number x = 0, y = 0;
    std::uint32_t heading = 0;

    glm::dvec2 point() const { return {static_cast<double>(x), static_cast<double>(y)}; }
    void pass(const DrawnPart<Number>& part, std::uint32_t headings) {
        x += part.x;
        y += part.y;
        heading += part.turn;
        if (heading >= headings) heading -= headings;
    }
};

struct Frame {
    const Symbol* next;
    const Symbol* end;
    int level;
};

/// The successor of a symbol with `level` remaining tables, one level below, or the symbol itself. @param self  the
/// symbol
template <class Number>
Frame frame_below(const Parts<Number>& parts, const Symbol* self, int level) {
    const Word* successor = parts.successor(*self, level);
    if (!successor) return {self, self + 1, level - 1};
    return {successor->data(), successor->data() + successor->size(), level - 1};
}

template <class Number>
bool misses(const Box& box, glm::dvec2 at, const DrawnPart<Number>& part) {
    return at.x + part.low.x > box.high.x || at.x + part.high.x < box.low.x || at.y + part.low.y > box.high.y ||
           at.y + part.high.y < box.low.y;
}

/// Draws parts, in doubles.
class Drawer {
public:
    Drawer(const Parts<double>& parts, const Clumps& clumps, const BracketTable& brackets, bool moves_draw,
           const Sight& sight, BlotSink& sink, double budget, const std::function<void(std::uint64_t)>& watch)
        : parts_(parts),
          clumps_(clumps),
          brackets_(brackets),
          moves_draw_(moves_draw),
          sight_(sight),
          sink_(sink),
          budget_(budget),
          watch_(watch) {
        points_.reserve(most_points);
        if (sight.blot >= 0) {
            blots_.assign(parts_.all().size(), not_prepared);
            blots_of_clumps_.assign(clumps_.all().size(), not_prepared);
        }
    }

    void draw(Symbol symbol, int level, glm::dvec2 point, std::uint32_t heading) {
        at_ = {point.x, point.y, heading};
        look(symbol, level);
        while (!frames_.empty()) {
            Frame& frame = frames_.back();
            if (frame.next != frame.end) {
                look(*frame.next++, frame.level);
            } else if (frame.clump == frame.last_clump) {
                frames_.pop_back();
            } else {
                const Clump& clump = *frame.clump++;
                // A clump of a single symbol is examined as that symbol.
                if (clump.end - clump.begin > 1 && take(clump.part, frame.level, blots_of_clumps_,
                                                        static_cast<std::size_t>(&clump - clumps_.all().data()))) {
                    continue;
                }
                frame.next = clump.begin;
                frame.end = clump.end;
            }
        }
    }

    void lift() {
        if (!is_down_) return;
        if (left_out_ > 0) add(at_.point());
        flush();
        sink_.end_stroke(false);
        is_down_ = false;
    }

    /// Ends one line and begins another.
    void next_line(glm::dvec2 end, glm::dvec2 start) {
        lift();
        sink_.end_line(end);
        sink_.begin_line(start);
    }

    /// Counts nodes, here and elsewhere.
    void count() {
        if (++report.visited % watched_nodes != 0) return;
        if (static_cast<double>(report.visited) > budget_) throw too_much(budget_);
        if (watch_) watch_(watched_nodes);
    }

    ViewReport report;

private:
    /// The rest of a successor that is to be drawn: first some symbols, then clumps.
    struct Frame {
        const Symbol* next;
        const Symbol* end;
        const Clump* clump;
        const Clump* last_clump;
        int level;
    };

    void look(Symbol symbol, int level) {
        if (brackets_.is_push[symbol]) {
            count();
            if (moves_draw_) next_line(at_.point(), at_.point());
            stack_.push_back(at_);
            return;
        }
        if (brackets_.is_pop[symbol]) {
            count();
            const ViewPlace<double>& from = stack_.back();
            next_line(at_.point(), from.point());
            at_ = from;
            stack_.pop_back();
            return;
        }
        const std::size_t index = parts_.index(symbol, level, at_.heading);
        if (take(parts_.all()[index], level, blots_, index)) return;
        const auto below = clumps_.below(index);
        frames_.push_back({nullptr, nullptr, below.data(), below.data() + below.size(), level - 1});
    }

    /// Skips or draws a part; returns false if it must be examined more closely.
    bool take(const DrawnPart<double>& part, int level, std::vector<std::size_t>& blots, std::size_t index) {
        count();
        if (!part.draws()) {
            if (part.x != 0 || part.y != 0) lift();
            at_.pass(part, parts_.headings());
            return true;
        }
        const glm::dvec2 here = at_.point();
        if (misses(sight_.box, here, part)) {
            lift();
            at_.pass(part, parts_.headings());
            return true;
        }
        const double extent = static_cast<double>(part.extent);
        if (is_little(part.ink)) {
            at_.pass(part, parts_.headings());
            return true;
        }
        const bool is_step = level == 0 && &blots == &blots_;
        if (extent <= sight_.blot) {
            lift();
            std::size_t& blot = blots[index];
            if (blot == not_prepared)
                blot = sink_.prepare({part.spread, part.high - part.low, part.ink * sight_.ink}, {});
            sink_.blot(blot, here + part.centre);
            if (!is_step) ++report.blots;
            at_.pass(part, parts_.headings());
            return true;
        }
        if (!is_step && extent > sight_.chord) return false;
        if (!is_down_) {
            sink_.begin_stroke(here, Pen{});
            is_down_ = true;
        }
        if (!is_step) {
            if (part.returns) add(here + part.centre);
            ++report.chords;
        }
        at_.pass(part, parts_.headings());
        add(at_.point());
        ++report.lines;
        return true;
    }

    /// True if a part with this ink can be left out: all omissions up to the line's next corner are invisible.
    bool is_little(double ink) {
        if (ink >= sight_.least || (sight_.blot < 0 && !is_down_)) return false;
        if (sight_.blot >= 0) return true;
        left_out_ += ink;
        return left_out_ < sight_.least;
    }

    void add(glm::dvec2 point) {
        left_out_ = 0;
        points_.push_back(point);
        if (points_.size() == most_points) flush();
    }
    void flush() {
        if (!points_.empty()) sink_.lines(points_);
        points_.clear();
    }

    static constexpr std::size_t most_points = 256;
    static constexpr std::size_t not_prepared = SIZE_MAX;
    const Parts<double>& parts_;
    const Clumps& clumps_;
    const BracketTable& brackets_;
    bool moves_draw_;
    const Sight sight_;
    BlotSink& sink_;
    double budget_;
    const std::function<void(std::uint64_t)>& watch_;
    ViewPlace<double> at_;
    std::vector<Frame> frames_;
    std::vector<ViewPlace<double>> stack_;
    std::vector<glm::dvec2> points_;
    std::vector<std::size_t> blots_;  // their numbers in the sink, by part
    std::vector<std::size_t> blots_of_clumps_;
    double left_out_ = 0;  // ink of the line left out since its last corner
    bool is_down_ = false;
};

/// Walks in as many bits as necessary to the parts that a Drawer can draw in doubles.
template <class Number>
class NumberView final : public View {
public:
    NumberView(const Grammar& grammar, Parts<Number> parts, Parts<double> rough, bool moves_draw, Number x, Number y)
        : grammar_(grammar),
          parts_(std::move(parts)),
          rough_(std::move(rough)),
          clumps_(grammar, rough_),
          brackets_(grammar),
          moves_draw_(moves_draw),
          x_(x),
          y_(y) {}

    const Parts<double>& parts() const override { return rough_; }

    ViewReport read(const Sight& sight, BlotSink& sink, double budget,
                    const std::function<void(std::uint64_t)>& watch) const override {
        Drawer drawer(rough_, clumps_, brackets_, moves_draw_, sight, sink, budget, watch);
        // Doubles place parts of that size within a millionth of a millionth of the window.
        const double largest =
            0x1p12 * std::max(sight.box.high.x - sight.box.low.x, sight.box.high.y - sight.box.low.y);
        ViewPlace<Number> at{-x_, -y_, 0};
        std::vector<ViewPlace<Number>> stack;
        sink.begin_line(at.point());
        const Word& axiom = grammar_.axiom();
        std::vector<Frame> frames{{axiom.data(), axiom.data() + axiom.size(), parts_.levels()}};
        while (!frames.empty()) {
            Frame& frame = frames.back();
            if (frame.next == frame.end) {
                frames.pop_back();
                continue;
            }
            const Symbol* symbol = frame.next++;
            const int level = frame.level;
            drawer.count();
            if (brackets_.is_push[*symbol]) {
                if (moves_draw_) drawer.next_line(at.point(), at.point());
                stack.push_back(at);
                continue;
            }
            if (brackets_.is_pop[*symbol]) {
                drawer.next_line(at.point(), stack.back().point());
                at = stack.back();
                stack.pop_back();
                continue;
            }
            const DrawnPart<Number>& part = parts_.part(*symbol, level, at.heading);
            const glm::dvec2 here = at.point();
            if (!part.draws()) {
                if (part.x != 0 || part.y != 0) drawer.lift();
            } else if (misses(sight.box, here, part)) {
                drawer.lift();
            } else if (level == 0 || static_cast<double>(part.extent) <= largest) {
                drawer.draw(*symbol, level, here, at.heading);
            } else {
                frames.push_back(frame_below(parts_, symbol, level));
                continue;
            }
            at.pass(part, parts_.headings());
        }
        drawer.lift();
        sink.end_line(at.point());
        return drawer.report;
    }

private:
    const Grammar& grammar_;
    Parts<Number> parts_;
    Parts<double> rough_;
    Clumps clumps_;
    BracketTable brackets_;
    bool moves_draw_;
    Number x_, y_;  // coordinates of the origin
};

template <class Number>
std::unique_ptr<View> make_view(const Grammar& grammar, Parts<double> rough, bool moves_draw,
                                const ViewWindow& origin) {
    auto parts = Parts<Number>::make(grammar, moves_draw);
    if (!parts) return nullptr;
    return std::make_unique<NumberView<Number>>(grammar, std::move(*parts), std::move(rough), moves_draw,
                                                static_cast<Number>(origin.x0), static_cast<Number>(origin.y0));
}

/// A decimal number without an exponent.
std::optional<Quad> parse_decimal(std::string_view text) {
    const bool is_negative = text.starts_with('-');
    if (is_negative || text.starts_with('+')) text.remove_prefix(1);
    Quad value = 0;
    Quad scale = 1;
    bool has_digits = false;
    bool has_point = false;
    for (const char byte : text) {
        if (byte == '.' && !has_point) {
            has_point = true;
            continue;
        }
        if (byte < '0' || byte > '9') return std::nullopt;
        has_digits = true;
        value = 10 * value + (byte - '0');
        if (has_point) scale *= 10;
    }
    if (!has_digits || text.size() > 4000) return std::nullopt;
    value /= scale;
    return is_negative ? -value : value;
}

}  // namespace

BudgetError too_much(double budget) {
    return BudgetError(fmt::format(
        "more than {:.0f} parts of the drawing are visible; use fewer pixels, a smaller window or a larger budget",
        budget));
}

std::optional<ViewWindow> parse_window(std::string_view text) {
    std::array<Quad, 4> numbers{};
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t comma = text.find(',');
        if ((comma == std::string_view::npos) != (i == 3)) return std::nullopt;
        std::string_view part = text.substr(0, comma);
        while (part.starts_with(' ')) part.remove_prefix(1);
        while (part.ends_with(' ')) part.remove_suffix(1);
        const auto number = parse_decimal(part);
        // Drawings do not extend beyond that.
        if (!number || !(*number > -1e300 && *number < 1e300)) return std::nullopt;
        numbers[i] = *number;
        text.remove_prefix(i == 3 ? text.size() : comma + 1);
    }
    const ViewWindow window{numbers[0], numbers[1], numbers[2], numbers[3]};
    if (!(window.x0 < window.x1 && window.y0 < window.y1)) return std::nullopt;
    return window;
}

std::unique_ptr<View> View::make(const Grammar& grammar, const std::optional<ViewWindow>& window, bool moves_draw) {
    auto parts = Parts<double>::make(grammar, moves_draw);
    return parts ? make(grammar, std::move(*parts), window, moves_draw) : nullptr;
}

std::unique_ptr<View> View::make(const Grammar& grammar, Parts<double> parts, const std::optional<ViewWindow>& window,
                                 bool moves_draw) {
    if (!window) {
        Parts<double> places = parts;
        return std::make_unique<NumberView<double>>(grammar, std::move(places), std::move(parts), moves_draw, 0.0,
                                                    0.0);
    }
    // Sums of whole numbers are exact as long as the whole drawing is within the bits of a place.
    const auto largest = [](const glm::dvec2& corner) { return std::max(std::fabs(corner.x), std::fabs(corner.y)); };
    const double reach = std::max(largest(parts.whole().low), largest(parts.whole().high));
    return reach < 0x1p60 ? make_view<long double>(grammar, std::move(parts), moves_draw, *window)
                          : make_view<Quad>(grammar, std::move(parts), moves_draw, *window);
}

}  // namespace sikku
