#include "art/deep/patches.h"

#include "art/deep/view.h"
#include "art/drawing/extent_sink.h"
#include "engine/base/chance.h"
#include "engine/geometry/lattice.h"
#include "engine/geometry/moved_path.h"
#include "engine/geometry/recorded_path.h"
#include "engine/geometry/turtle.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr std::size_t most_pieces = 1'000'000;
constexpr std::size_t most_levels = 2'000;
constexpr std::size_t largest_template = 10'000;  // symbols
constexpr std::uint64_t watched_nodes = 1 << 12;
// Bounds are sums of rounded numbers.
constexpr double slack = 1e-12;

/// A unit step in a heading, in 113 bits: Taylor's series up to 45 degrees has the same bits on every machine.
QuadVector direction(Quad degrees) {
    const auto quarter = static_cast<int>(std::lround(static_cast<double>(degrees) / 90));
    const Quad pi = static_cast<Quad>(3.141592653589793116) + static_cast<Quad>(1.2246467991473531772e-16) -
                    static_cast<Quad>(2.9947698097183396659e-33);
    const Quad angle = (degrees - 90 * quarter) * pi / 180;
    const Quad square = angle * angle;
    Quad cosine = 0, sine = 0;
    for (int power = 36; power > 0; power -= 2) {
        cosine = square / ((power - 1) * power) * (1 - cosine);
        sine = square / (power * (power + 1)) * (1 - sine);
    }
    return by_quarters(((quarter % 4) + 4) % 4, QuadVector{1 - cosine, angle - angle * sine});
}

/// The product of complex numbers: `vector`, turned by a unit vector.
template <class Vector>
Vector turned(const Vector& vector, const Vector& by) {
    return {vector.x * by.x - vector.y * by.y, vector.x * by.y + vector.y * by.x};
}

double slack_at(glm::dvec2 at) {
    return slack * (1 + std::fabs(at.x) + std::fabs(at.y));
}

/// Headings in whole fractions of a turn. Parts are composed for each heading.
class EvenHeadings {
public:
    using Heading = std::uint32_t;
    using Bound = Box;

    EvenHeadings(const Grammar&, const Lattice& lattice) : lattice_(lattice) {
        for (Heading heading = 0; heading < lattice.headings; ++heading) {
            directions_.push_back(direction(static_cast<Quad>(lattice.first_heading) +
                                            static_cast<Quad>(360) * heading / lattice.headings));
        }
    }

    Heading first() const { return 0; }
    /// Number of headings for which parts are composed; the index of a heading; and the heading with an index.
    std::size_t count() const { return lattice_.headings; }
    std::size_t number(Heading heading) const { return heading; }
    Heading composed(std::size_t number) const { return static_cast<Heading>(number); }

    Heading turned_by(Heading heading, Heading turn) const { return (heading + turn) % lattice_.headings; }
    Heading turn_between(Heading from, Heading to) const {
        return (to + lattice_.headings - from) % lattice_.headings;
    }
    Heading turn_of(Symbol symbol, const Command&) const { return lattice_.turn[symbol]; }
    Heading no_turn() const { return 0; }

    QuadVector step(Symbol symbol, double value, Heading heading) const {
        const Quad length = lattice_.step_length<Quad>(symbol, value, directions_);
        return {length * directions_[heading].x, length * directions_[heading].y};
    }
    /// Converts from the frame in which a part was composed.
    QuadVector way(const QuadVector& way, Heading) const { return way; }
    Box box(const Box& bound, Heading) const { return bound; }
    glm::dvec2 unit(Heading heading) const { return lattice_.direction[heading]; }

    /// The bound of a part from boxes.
    static Box bound_of(const Box& box) { return box; }
    static bool is_empty(const Box& bound) { return bound.empty(); }
    /// Collects the bounds of children.
    class Collector {
    public:
        explicit Collector(const EvenHeadings&) {}
        void add(glm::dvec2 at, const Box& child, Heading) {
            const glm::dvec2 around(slack_at(at));
            box_.add(at + child.low - around);
            box_.add(at + child.high + around);
        }
        Box bound() const { return box_; }

    private:
        Box box_;
    };

private:
    const Lattice& lattice_;
    std::vector<QuadVector> directions_;
};

/// Arbitrary headings, as unit vectors. Parts are composed once, heading along the x axis.
class FreeHeadings {
public:
    using Heading = QuadVector;
    struct Bound {
        glm::dvec2 centre{0.0};
        double radius = -1;  ///< below 0: empty
    };

    FreeHeadings(const Grammar& grammar, const Lattice&)
        : first_(direction(static_cast<Quad>(grammar.heading().degrees))) {}

    Heading first() const { return first_; }
    std::size_t count() const { return 1; }
    std::size_t number(const Heading&) const { return 0; }
    Heading composed(std::size_t) const { return {1, 0}; }

    Heading turned_by(const Heading& heading, const Heading& turn) const { return turned(heading, turn); }
    Heading turn_between(const Heading& from, const Heading& to) const { return turned(to, {from.x, -from.y}); }
    Heading turn_of(Symbol, const Command& command) const {
        const auto& exact = command.angle.exact;
        return direction(exact ? static_cast<Quad>(360) * exact->numerator / exact->denominator
                               : static_cast<Quad>(command.angle.degrees));
    }
    Heading no_turn() const { return {1, 0}; }

    QuadVector step(Symbol, double value, const Heading& heading) const {
        return {heading.x * value, heading.y * value};
    }
    QuadVector way(const QuadVector& way, const Heading& heading) const { return turned(way, heading); }
    Box box(const Bound& bound, const Heading& heading) const {
        Box box;
        if (is_empty(bound)) return box;
        const glm::dvec2 centre = turned(bound.centre, heading.rounded());
        box.add(centre - bound.radius);
        box.add(centre + bound.radius);
        return box;
    }
    glm::dvec2 unit(const Heading& heading) const { return heading.rounded(); }

    static Bound bound_of(const Box& box) {
        if (box.empty()) return {};
        return {(box.low + box.high) / 2.0, glm::distance(box.low, box.high) / 2};
    }
    static bool is_empty(const Bound& bound) { return bound.radius < 0; }
    class Collector {
    public:
        explicit Collector(const FreeHeadings&) {}
        void add(glm::dvec2 at, const Bound& child, const Heading& heading) {
            discs_.push_back({at + turned(child.centre, heading.rounded()), child.radius + slack_at(at)});
        }
        /// The disc around the middle of their box.
        Bound bound() const {
            Box box;
            for (const Bound& disc : discs_) {
                box.add(disc.centre - disc.radius);
                box.add(disc.centre + disc.radius);
            }
            Bound all;
            if (box.empty()) return all;
            all.centre = (box.low + box.high) / 2.0;
            for (const Bound& disc : discs_) {
                all.radius = std::max(all.radius, glm::distance(all.centre, disc.centre) + disc.radius);
            }
            return all;
        }

    private:
        std::vector<Bound> discs_;
    };

private:
    Heading first_;
};

/// Method of drawing a symbol with a number of remaining tables.
enum class Kind : std::uint8_t {
    unknown,
    composed,    ///< from its children, each of which is a complete drawing
    recorded,    ///< as a whole, because its children are not complete drawings, as parts of a polygon
    incomplete,  ///< as a part of a larger one
};

/// True if the action of a symbol has the same effect in every place: it does not open or close anything, or change
/// the pen.
bool is_independent(Action action) {
    return action == Action::pass || action == Action::draw || action == Action::move || action == Action::turn ||
           action == Action::disc || action == Action::mark;
}

bool is_in_the_plane(Action action) {
    return action != Action::pitch && action != Action::roll && action != Action::level && action != Action::surface;
}

bool changes_pen(Action action) {
    return action == Action::width_factor || action == Action::width_set || action == Action::colour_step ||
           action == Action::colour_set;
}

template <class Headings>
class PatchesOf : public Patches {
public:
    using Heading = typename Headings::Heading;

    PatchesOf(const Grammar& grammar, Lattice lattice, const Style& style)
        : grammar_(grammar),
          lattice_(std::move(lattice)),
          headings_(grammar, lattice_),
          style_(style),
          symbols_(grammar.symbols().size()),
          start_heading_(headings_.unit(headings_.first())) {
        if (grammar.interpretation()) tables_.push_back(grammar.interpretation());
    }

    bool compose(std::string& why);

    double widest() const override { return widest_; }
    const Box& box() const override { return whole_; }
    std::size_t levels() const override { return tables_.size(); }
    QuadVector random_place(std::uint64_t seed) const override;
    bool read(QuadVector origin, const Box& box, PathSink& sink, const ReadingLimits& limits) const override;
    void read_samples(PathSink& sink) const override;

private:
    /// A symbol with a number of remaining tables, in one heading: its displacement, and the bound of its drawing,
    /// relative to its start.
    struct Piece {
        QuadVector way;
        Heading turn{};
        typename Headings::Bound bound;
        bool is_ready = false;
    };
    struct State {
        QuadVector at;
        Heading heading{};
    };

    /// Saves or restores the state at a bracket. @return false for other symbols
    bool follows_bracket(Symbol symbol, State& here, std::vector<State>& saved) const {
        if (grammar_.is_push(symbol)) {
            saved.push_back(here);
            return true;
        }
        if (!grammar_.is_pop(symbol)) return false;
        here = saved.back();
        saved.pop_back();
        return true;
    }

    const Word* successor(Symbol symbol, std::size_t level) const {
        return level > 0 ? tables_[level - 1]->successor(symbol) : nullptr;
    }
    std::size_t index(Symbol symbol, std::size_t level, const Heading& heading) const {
        return (level * symbols_ + symbol) * headings_.count() + headings_.number(heading);
    }
    const Command& command(Symbol symbol) const { return grammar_.symbols()[symbol].command; }

    Kind kind(Symbol symbol, std::size_t level);
    Kind kind_of_word(const Word& word, std::size_t level);
    bool flatten(Symbol symbol, std::size_t level, Word& word, std::size_t& visits) const;
    static bool is_complete(const Grammar& grammar, const Word& word);
    void record(Symbol symbol, std::size_t level, const Word& word);
    const Piece& piece(Symbol symbol, std::size_t level, const Heading& heading);
    Piece composed(const Word& word, std::size_t level, const Heading& heading);
    Box box(const Piece& piece, const Heading& heading) const { return headings_.box(piece.bound, heading); }
    void pass(const Piece& piece, State& here) const {
        here.at += headings_.way(piece.way, here.heading);
        here.heading = headings_.turned_by(here.heading, piece.turn);
    }
    glm::dmat3x2 moved(glm::dvec2 to, const Heading& heading) const;

    const Grammar& grammar_;
    Lattice lattice_;
    Headings headings_;
    Style style_;
    std::size_t symbols_;
    glm::dvec2 start_heading_;
    std::vector<const Table*> tables_;  // by level, from 1
    std::vector<Kind> kinds_;
    std::vector<Piece> pieces_;
    std::map<std::pair<Symbol, std::size_t>, RecordedPath> recorded_;  // in the first heading
    Box whole_;
    double widest_ = 0;
};

template <class Headings>
bool PatchesOf<Headings>::compose(std::string& why) {
    why = "a window needs fewer than a million different parts";
    for (std::size_t i = grammar_.schedule().size(); i > 0; --i) {
        const ScheduleRun& run = grammar_.schedule()[i - 1];
        if (static_cast<std::uint64_t>(run.steps) > most_levels - std::min(most_levels, levels())) return false;
        tables_.insert(tables_.end(), static_cast<std::size_t>(run.steps), &grammar_.tables()[run.table]);
    }
    if (headings_.count() > most_pieces / (levels() + 1) / symbols_) return false;
    const std::vector<char> reached = grammar_.reachable();
    for (Symbol symbol = 0; symbol < symbols_; ++symbol) {
        if (!reached[symbol]) continue;
        const Command& is = command(symbol);
        why = "a window needs a drawing in the plane with finite lengths";
        if (!is_in_the_plane(is.action) || !std::isfinite(is.value) || !std::isfinite(is.angle.degrees)) return false;
        why = "a window needs a drawing without labels";
        if (is.action == Action::label) return false;
        why = "a window needs brackets without productions";
        const bool is_bracket = grammar_.is_push(symbol) || grammar_.is_pop(symbol);
        for (const Table* table : tables_) {
            if (is_bracket && table->successor(symbol)) return false;
        }
    }
    kinds_.assign((levels() + 1) * symbols_, Kind::unknown);
    pieces_.resize((levels() + 1) * symbols_ * headings_.count());
    why =
        "a window needs brackets that balance in each successor, and polygons and changes of the pen within symbols "
        "whose words have at most 10,000 symbols, such as T --> {F+F+F}";
    if (kind_of_word(grammar_.axiom(), levels()) != Kind::composed) return false;
    const Heading first = headings_.composed(headings_.number(headings_.first()));
    whole_ = headings_.box(composed(grammar_.axiom(), levels(), first).bound, headings_.first());
    return true;
}

/// Composed if all children are complete drawings and brackets balance.
template <class Headings>
Kind PatchesOf<Headings>::kind_of_word(const Word& word, std::size_t level) {
    int open = 0;
    for (const Symbol child : word) {
        if (grammar_.is_push(child)) {
            ++open;
        } else if (grammar_.is_pop(child)) {
            if (--open < 0) return Kind::incomplete;
        } else if (kind(child, level) == Kind::incomplete) {
            return Kind::incomplete;
        }
    }
    return open == 0 ? Kind::composed : Kind::incomplete;
}

template <class Headings>
Kind PatchesOf<Headings>::kind(Symbol symbol, std::size_t level) {
    const std::size_t at = level * symbols_ + symbol;
    if (kinds_[at] != Kind::unknown) return kinds_[at];
    const Word* word = successor(symbol, level);
    Kind found;
    if (word) {
        found = kind_of_word(*word, level - 1);
    } else if (level > 0) {
        found = kind(symbol, level - 1);
        // Recorded symbols stay recorded, with the record of the lowest level.
        if (found == Kind::recorded) found = Kind::composed;
    } else {
        found = !is_independent(command(symbol).action)  ? Kind::incomplete
                : command(symbol).action == Action::disc ? Kind::recorded
                                                         : Kind::composed;
        if (found == Kind::recorded) record(symbol, level, {symbol});
    }
    Word whole;
    std::size_t visits = 16 * largest_template;
    if (found == Kind::incomplete && level > 0 && flatten(symbol, level, whole, visits) &&
        is_complete(grammar_, whole)) {
        record(symbol, level, whole);
        found = Kind::recorded;
    }
    return kinds_[at] = found;
}

/// The word of a symbol after all its tables; false if it is too long or takes more than `visits` symbols of all
/// levels, which also count those that vanish.
template <class Headings>
bool PatchesOf<Headings>::flatten(Symbol symbol, std::size_t level, Word& word, std::size_t& visits) const {
    if (visits-- == 0) return false;
    while (level > 0 && !successor(symbol, level)) --level;
    if (level == 0) {
        word.push_back(symbol);
        return word.size() <= largest_template;
    }
    for (const Symbol child : *successor(symbol, level)) {
        if (!flatten(child, level - 1, word, visits)) return false;
    }
    return true;
}

/// True if brackets and polygons of a word balance and it leaves the pen as it was.
template <class Headings>
bool PatchesOf<Headings>::is_complete(const Grammar& grammar, const Word& word) {
    std::vector<bool> open{false};  // for each open bracket, whether the pen was changed in it
    int polygons = 0;
    for (const Symbol symbol : word) {
        const Action action = grammar.symbols()[symbol].command.action;
        if (action == Action::push) open.push_back(false);
        if (action == Action::pop) {
            if (open.size() == 1) return false;
            open.pop_back();
        }
        if (action == Action::polygon_begin || action == Action::edge_begin) ++polygons;
        if (action == Action::polygon_end || action == Action::edge_end) --polygons;
        if (polygons < 0 || (polygons == 0 && action == Action::polygon_vertex)) return false;
        if (changes_pen(action)) open.back() = true;
    }
    return polygons == 0 && open.size() == 1 && !open.front();
}

template <class Headings>
void PatchesOf<Headings>::record(Symbol symbol, std::size_t level, const Word& word) {
    RecordedPath& path = recorded_[{symbol, level}];
    const auto turtle = Turtle::drawing(grammar_, path, false);
    turtle->symbols(Run{word});
    turtle->finish();
}

/// The drawing of a word in a heading.
template <class Headings>
typename PatchesOf<Headings>::Piece PatchesOf<Headings>::composed(const Word& word, std::size_t level,
                                                                  const Heading& heading) {
    State here{{}, heading};
    std::vector<State> saved;
    typename Headings::Collector bounds(headings_);
    for (const Symbol child : word) {
        if (follows_bracket(child, here, saved)) continue;
        const Piece& next = piece(child, level, here.heading);
        if (!Headings::is_empty(next.bound)) bounds.add(here.at.rounded(), next.bound, here.heading);
        pass(next, here);
    }
    return {here.at, headings_.turn_between(heading, here.heading), bounds.bound(), false};
}

template <class Headings>
glm::dmat3x2 PatchesOf<Headings>::moved(glm::dvec2 to, const Heading& heading) const {
    // Records begin in the first heading.
    const glm::dvec2 is = headings_.unit(heading);
    const glm::dvec2 turn(is.x * start_heading_.x + is.y * start_heading_.y,
                          is.y * start_heading_.x - is.x * start_heading_.y);
    return {turn, glm::dvec2(-turn.y, turn.x), to};
}

template <class Headings>
const typename PatchesOf<Headings>::Piece& PatchesOf<Headings>::piece(Symbol symbol, std::size_t level,
                                                                      const Heading& given) {
    Piece& found = pieces_[index(symbol, level, given)];
    if (found.is_ready) return found;
    const Heading heading = headings_.composed(headings_.number(given));
    Piece made;
    made.turn = headings_.no_turn();
    if (const Word* word = successor(symbol, level)) {
        made = composed(*word, level - 1, heading);
    } else if (level > 0) {
        made = piece(symbol, level - 1, heading);
    } else {
        const Command& is = command(symbol);
        if (is.action == Action::turn) made.turn = headings_.turn_of(symbol, is);
        if (is.action == Action::draw || is.action == Action::move) {
            made.way = headings_.step(symbol, is.value, heading);
        }
        if (is.action == Action::draw) {
            Box line;
            line.add({0, 0});
            line.add(made.way.rounded());
            made.bound = Headings::bound_of(line);
            widest_ = std::max(widest_, style_.pen_width({}));
        }
    }
    if (const auto path = recorded_.find({symbol, level}); path != recorded_.end()) {
        ExtentSink extent(style_, moved({0, 0}, heading));
        path->second.draw(extent);
        made.bound = Headings::bound_of(extent.box);
        widest_ = std::max(widest_, extent.widest);
    }
    made.is_ready = true;
    return found = made;
}

template <class Headings>
QuadVector PatchesOf<Headings>::random_place(std::uint64_t seed) const {
    struct Choice {
        Symbol symbol;
        State state;
        double area;  ///< cumulative area of the boxes up to this one
    };
    State here{{}, headings_.first()};
    const Word* word = &grammar_.axiom();
    std::vector<Choice> choices;
    std::vector<State> saved;
    for (std::size_t level = levels();; --level) {
        choices.clear();
        saved.clear();
        for (const Symbol child : *word) {
            if (follows_bracket(child, here, saved)) continue;
            const Piece& is = pieces_[index(child, level, here.heading)];
            const Box own = box(is, here.heading);
            const glm::dvec2 size = own.high - own.low;
            if (!own.empty() && size.x * size.y > 0) {
                choices.push_back({child, here, size.x * size.y + (choices.empty() ? 0 : choices.back().area)});
            }
            pass(is, here);
        }
        if (choices.empty()) return here.at;
        seed = scrambled(seed + 1);
        const double drawn = static_cast<double>(seed >> 11) * 0x1p-53 * choices.back().area;
        const auto chosen = std::find_if(choices.begin(), choices.end() - 1,
                                         [&](const Choice& choice) { return choice.area > drawn; });
        here = chosen->state;
        std::size_t below = level;
        while (below > 0 && !successor(chosen->symbol, below)) --below;
        if (below == 0 || kinds_[below * symbols_ + chosen->symbol] != Kind::composed) {
            const Box own = box(pieces_[index(chosen->symbol, level, here.heading)], here.heading);
            const glm::dvec2 centre = (own.low + own.high) / 2.0;
            here.at += {static_cast<Quad>(centre.x), static_cast<Quad>(centre.y)};
            return here.at;
        }
        word = successor(chosen->symbol, below);
        level = below;
    }
}

template <class Headings>
bool PatchesOf<Headings>::read(QuadVector origin, const Box& seen, PathSink& sink,
                               const ReadingLimits& limits) const {
    struct Frame {
        const Symbol* next;
        const Symbol* end;
        std::size_t level;
    };
    State here{{-origin.x, -origin.y}, headings_.first()};
    std::vector<State> stack;
    std::vector<Frame> frames{{grammar_.axiom().data(), grammar_.axiom().data() + grammar_.axiom().size(), levels()}};
    bool is_down = false, has_drawn = false;
    const auto lift = [&] {
        if (is_down) sink.end_stroke(false);
        is_down = false;
    };
    std::uint64_t visited = 0;
    while (!frames.empty()) {
        Frame& frame = frames.back();
        if (frame.next == frame.end) {
            frames.pop_back();
            continue;
        }
        const Symbol* const self = frame.next++;
        const Symbol symbol = *self;
        const std::size_t level = frame.level;
        if (++visited % watched_nodes == 0) {
            if (static_cast<double>(visited) > limits.budget) throw too_much(limits.budget);
            if (limits.watch) limits.watch(watched_nodes);
        }
        if (grammar_.is_push(symbol)) {
            stack.push_back(here);
            continue;
        }
        if (grammar_.is_pop(symbol)) {
            lift();
            here = stack.back();
            stack.pop_back();
            continue;
        }
        if (command(symbol).action == Action::mark) {
            sink.mark();
            continue;
        }
        const Piece& is = pieces_[index(symbol, level, here.heading)];
        const glm::dvec2 at = here.at.rounded();
        const Box own = box(is, here.heading);
        const bool is_seen = !own.empty() && at.x + own.low.x <= seen.high.x && at.x + own.high.x >= seen.low.x &&
                             at.y + own.low.y <= seen.high.y && at.y + own.high.y >= seen.low.y;
        const Kind how = kinds_[level * symbols_ + symbol];
        if (is_seen && how == Kind::composed && level > 0) {
            if (const Word* word = successor(symbol, level)) {
                frames.push_back({word->data(), word->data() + word->size(), level - 1});
            } else {
                frames.push_back({self, self + 1, level - 1});
            }
            continue;
        }
        if (is_seen && how == Kind::recorded) {
            lift();
            MovedPath path(sink, moved(at, here.heading));
            recorded_.at({symbol, level}).draw(path);
            has_drawn = true;
            pass(is, here);
        } else if (is_seen) {
            if (!is_down) sink.begin_stroke(at, Pen{});
            is_down = true;
            has_drawn = has_drawn || style_.draws(Pen{});
            pass(is, here);
            const glm::dvec2 point = here.at.rounded();
            sink.lines(std::span(&point, 1));
        } else {
            if (is.way.x != 0 || is.way.y != 0) lift();
            pass(is, here);
        }
    }
    lift();
    return has_drawn;
}

template <class Headings>
void PatchesOf<Headings>::read_samples(PathSink& sink) const {
    for (const auto& [at, path] : recorded_) {
        for (std::size_t number = 0; number < headings_.count(); ++number) {
            const Heading heading = headings_.composed(number);
            if (!pieces_[index(at.first, at.second, heading)].is_ready) continue;
            MovedPath turned(sink, moved({0, 0}, heading));
            path.draw(turned);
        }
    }
}

template <class Headings>
std::unique_ptr<Patches> made(const Grammar& grammar, Lattice lattice, const Style& style, std::string& why) {
    auto patches = std::make_unique<PatchesOf<Headings>>(grammar, std::move(lattice), style);
    if (!patches->compose(why)) return nullptr;
    return patches;
}

}  // namespace

std::unique_ptr<Patches> Patches::make(const Grammar& grammar, const Style& style, std::string& why) {
    if (!grammar.is_plain() || grammar.whole_word_steps() > 0) {
        why = "a window needs a pattern without chance and contexts";
        return nullptr;
    }
    Lattice lattice = make_lattice(grammar);
    return lattice.headings > 0 ? made<EvenHeadings>(grammar, std::move(lattice), style, why)
                                : made<FreeHeadings>(grammar, std::move(lattice), style, why);
}

}  // namespace sikku
