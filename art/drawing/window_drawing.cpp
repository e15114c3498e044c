#include "art/drawing/window_drawing.h"

#include "art/drawing/composition.h"
#include "art/drawing/extent_sink.h"
#include "art/drawing/framed_drawing.h"
#include "art/drawing/ink_shape.h"
#include "engine/base/chance.h"
#include "engine/base/numbers.h"
#include "engine/derivation/derivation.h"
#include "engine/derivation/forecast.h"
#include "engine/geometry/lattice.h"
#include "engine/geometry/moved_path.h"
#include "engine/geometry/recorded_path.h"
#include "engine/geometry/turtle.h"

#include <fmt/format.h>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>
#include <vector>

namespace sikku {
namespace {

/// Words up to this length are read whole and clipped, so that their strokes stay whole.
constexpr double most_clipped_symbols = 1e5;
constexpr std::size_t most_pieces = 1'000'000;
constexpr std::size_t most_levels = 2'000;
constexpr std::size_t largest_template = 10'000;  // symbols
constexpr std::uint64_t watched_nodes = 1 << 12;
// Boxes are sums of rounded numbers.
constexpr double box_slack = 1e-12;

struct Vector {
    Quad x = 0, y = 0;
    Vector& operator+=(const Vector& other) {
        x += other.x;
        y += other.y;
        return *this;
    }
    glm::dvec2 rounded() const { return {static_cast<double>(x), static_cast<double>(y)}; }
};

/// A unit step in a heading, in 113 bits: Taylor's series up to 45 degrees has the same bits on every machine.
Vector direction(double first, std::uint32_t heading, std::uint32_t headings) {
    const Quad degrees = static_cast<Quad>(first) + static_cast<Quad>(360) * heading / headings;
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
    return by_quarters(((quarter % 4) + 4) % 4, Vector{1 - cosine, angle - angle * sine});
}

/// A symbol with some tables still to come, in one heading: where it leads, and the box of what it draws.
struct Piece {
    Vector way;
    std::uint32_t turn = 0;
    Box box;  ///< from where it starts
    bool is_ready = false;
};

/// How a symbol with some tables still to come is drawn.
enum class Kind : std::uint8_t {
    unknown,
    composed,    ///< from its children, each of which is a drawing by itself
    recorded,    ///< as a whole: its children are no drawings by themselves, as parts of a polygon
    incomplete,  ///< as a part of a larger one
};

/// True if the action of a symbol has the same effect wherever it stands: it opens nothing and changes no pen.
bool is_independent(Action action) {
    return action == Action::pass || action == Action::draw || action == Action::move || action == Action::turn ||
           action == Action::disc;
}

bool is_in_the_plane(Action action) {
    return action != Action::pitch && action != Action::roll && action != Action::level && action != Action::surface;
}

bool changes_pen(Action action) {
    return action == Action::width_factor || action == Action::width_set || action == Action::colour_step ||
           action == Action::colour_set;
}

}  // namespace

/// The pieces of a drawing, composed from the smallest up.
class Patches {
public:
    /// Nullptr, with the reason in `why`, where a WindowDrawing cannot be made.
    static std::unique_ptr<Patches> make(const Grammar& grammar, const Style& style, std::string& why) {
        const Lattice lattice = make_lattice(grammar);
        if (!grammar.is_plain() || grammar.whole_word_steps() > 0 || lattice.headings == 0) {
            why = "a window needs a pattern without parameters and chance that turns by parts of 360 degrees";
            return nullptr;
        }
        std::unique_ptr<Patches> patches(new Patches(grammar, lattice, style));
        if (!patches->compose(why)) return nullptr;
        return patches;
    }

    /// The widest pen, in the unit of the style's stroke.
    double widest() const { return widest_; }

    /// Box of the whole drawing.
    const Box& box() const { return whole_.box; }
    /// The centre of a recorded piece, chosen at random with larger parts more often.
    Vector random_place(std::uint64_t seed) const;
    /// Draws all pieces that meet `box`, both from `origin`. Returns whether there were any.
    bool read(Vector origin, const Box& box, PathSink& sink, const DrawOptions& options) const;

private:
    Patches(const Grammar& grammar, const Lattice& lattice, const Style& style)
        : grammar_(grammar),
          lattice_(lattice),
          style_(style),
          symbols_(grammar.symbols().size()),
          start_heading_(unit_vector(lattice.first_heading)) {
        if (grammar.interpretation()) tables_.push_back(grammar.interpretation());
    }

    std::size_t levels() const { return tables_.size(); }
    const Word* successor(Symbol symbol, std::size_t level) const {
        return level > 0 ? tables_[level - 1]->successor(symbol) : nullptr;
    }
    std::size_t index(Symbol symbol, std::size_t level, std::uint32_t heading) const {
        return (level * symbols_ + symbol) * lattice_.headings + heading;
    }
    const Command& command(Symbol symbol) const { return grammar_.symbols()[symbol].command; }

    bool compose(std::string& why);
    Kind kind(Symbol symbol, std::size_t level);
    Kind kind_of_word(const Word& word, std::size_t level);
    bool flatten(Symbol symbol, std::size_t level, Word& word) const;
    static bool is_complete(const Grammar& grammar, const Word& word);
    void record(Symbol symbol, std::size_t level, const Word& word);
    const Piece& piece(Symbol symbol, std::size_t level, std::uint32_t heading);
    void add(const Word& word, std::size_t level, std::uint32_t heading, Piece& whole);
    glm::dmat3x2 moved(glm::dvec2 to, std::uint32_t heading) const;

    const Grammar& grammar_;
    Lattice lattice_;
    Style style_;
    std::size_t symbols_;
    glm::dvec2 start_heading_;
    std::vector<const Table*> tables_;  // by level, from 1
    std::vector<Vector> directions_;
    std::vector<Kind> kinds_;
    std::vector<Piece> pieces_;
    std::map<std::pair<Symbol, std::size_t>, RecordedPath> recorded_;  // in the first heading
    Piece whole_;
    double widest_ = 0;
};

bool Patches::compose(std::string& why) {
    why = "a window needs fewer than a million different parts";
    for (std::size_t i = grammar_.schedule().size(); i > 0; --i) {
        const ScheduleRun& run = grammar_.schedule()[i - 1];
        if (static_cast<std::uint64_t>(run.steps) > most_levels - std::min(most_levels, levels())) return false;
        tables_.insert(tables_.end(), static_cast<std::size_t>(run.steps), &grammar_.tables()[run.table]);
    }
    if (lattice_.headings > most_pieces / (levels() + 1) / symbols_) return false;
    const std::vector<char> reached = grammar_.reachable();
    for (Symbol symbol = 0; symbol < symbols_; ++symbol) {
        if (!reached[symbol]) continue;
        const Command& is = command(symbol);
        why = "a window needs a drawing in the plane with finite lengths";
        if (!is_in_the_plane(is.action) || !std::isfinite(is.value)) return false;
        why = "a window needs brackets without productions";
        const bool is_bracket = grammar_.is_push(symbol) || grammar_.is_pop(symbol);
        for (const Table* table : tables_) {
            if (is_bracket && table->successor(symbol)) return false;
        }
    }
    for (std::uint32_t heading = 0; heading < lattice_.headings; ++heading) {
        directions_.push_back(direction(lattice_.first_heading, heading, lattice_.headings));
    }
    kinds_.assign((levels() + 1) * symbols_, Kind::unknown);
    pieces_.resize((levels() + 1) * symbols_ * lattice_.headings);
    why =
        "a window needs brackets, polygons and changes of the pen that end in the word in which they begin, or "
        "within "
        "10,000 symbols";
    if (kind_of_word(grammar_.axiom(), levels()) != Kind::composed) return false;
    add(grammar_.axiom(), levels(), 0, whole_);
    return true;
}

/// Composed if all children are drawings by themselves and brackets balance.
Kind Patches::kind_of_word(const Word& word, std::size_t level) {
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

Kind Patches::kind(Symbol symbol, std::size_t level) {
    const std::size_t at = level * symbols_ + symbol;
    if (kinds_[at] != Kind::unknown) return kinds_[at];
    const Word* word = successor(symbol, level);
    Kind found;
    if (word) {
        found = kind_of_word(*word, level - 1);
    } else if (level > 0) {
        found = kind(symbol, level - 1);
        // What is recorded stays so; the record is that of the lowest level.
        if (found == Kind::recorded) found = Kind::composed;
    } else {
        found = !is_independent(command(symbol).action)  ? Kind::incomplete
                : command(symbol).action == Action::disc ? Kind::recorded
                                                         : Kind::composed;
        if (found == Kind::recorded) record(symbol, level, {symbol});
    }
    Word whole;
    if (found == Kind::incomplete && level > 0 && flatten(symbol, level, whole) && is_complete(grammar_, whole)) {
        record(symbol, level, whole);
        found = Kind::recorded;
    }
    return kinds_[at] = found;
}

/// The word of a symbol after all its tables; false if it is too long.
bool Patches::flatten(Symbol symbol, std::size_t level, Word& word) const {
    while (level > 0 && !successor(symbol, level)) --level;
    if (level == 0) {
        word.push_back(symbol);
        return word.size() <= largest_template;
    }
    for (const Symbol child : *successor(symbol, level)) {
        if (!flatten(child, level - 1, word)) return false;
    }
    return true;
}

/// True if brackets and polygons of a word balance and it leaves the pen as it was.
bool Patches::is_complete(const Grammar& grammar, const Word& word) {
    std::vector<bool> open{false};  // for each bracket, whether the pen was changed in it
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

void Patches::record(Symbol symbol, std::size_t level, const Word& word) {
    RecordedPath& path = recorded_[{symbol, level}];
    const auto turtle = Turtle::drawing(grammar_, path, false);
    turtle->symbols(Run{word});
    turtle->finish();
}

/// Adds what a word draws, in that heading.
void Patches::add(const Word& word, std::size_t level, std::uint32_t heading, Piece& whole) {
    const std::uint32_t first = heading;
    std::vector<std::pair<Vector, std::uint32_t>> saved;
    for (const Symbol child : word) {
        if (grammar_.is_push(child)) {
            saved.emplace_back(whole.way, heading);
            continue;
        }
        if (grammar_.is_pop(child)) {
            std::tie(whole.way, heading) = saved.back();
            saved.pop_back();
            continue;
        }
        const Piece& next = piece(child, level, heading);
        if (!next.box.empty()) {
            const glm::dvec2 at = whole.way.rounded();
            const glm::dvec2 slack = box_slack * (glm::dvec2(1.0) + glm::dvec2(std::fabs(at.x), std::fabs(at.y)));
            whole.box.add(at + next.box.low - slack);
            whole.box.add(at + next.box.high + slack);
        }
        whole.way += next.way;
        heading = (heading + next.turn) % lattice_.headings;
    }
    whole.turn = (heading + lattice_.headings - first) % lattice_.headings;
}

glm::dmat3x2 Patches::moved(glm::dvec2 to, std::uint32_t heading) const {
    // Records begin in the first heading.
    const glm::dvec2 is = lattice_.direction[heading];
    const glm::dvec2 turn(is.x * start_heading_.x + is.y * start_heading_.y,
                          is.y * start_heading_.x - is.x * start_heading_.y);
    return {turn, glm::dvec2(-turn.y, turn.x), to};
}

const Piece& Patches::piece(Symbol symbol, std::size_t level, std::uint32_t heading) {
    Piece& found = pieces_[index(symbol, level, heading)];
    if (found.is_ready) return found;
    Piece made;
    if (const Word* word = successor(symbol, level)) {
        add(*word, level - 1, heading, made);
    } else if (level > 0) {
        made = piece(symbol, level - 1, heading);
    } else {
        const Command& is = command(symbol);
        if (is.action == Action::turn) made.turn = lattice_.turn[symbol];
        if (is.action == Action::draw || is.action == Action::move) {
            const Quad length = lattice_.step_length<Quad>(symbol, is.value, directions_);
            made.way = {length * directions_[heading].x, length * directions_[heading].y};
        }
        if (is.action == Action::draw) {
            made.box.add({0, 0});
            made.box.add(made.way.rounded());
            widest_ = std::max(widest_, style_.pen_width({}));
        }
    }
    if (const auto path = recorded_.find({symbol, level}); path != recorded_.end()) {
        ExtentSink extent(style_, moved({0, 0}, heading));
        path->second.draw(extent);
        made.box = extent.box;
        widest_ = std::max(widest_, extent.widest);
    }
    made.is_ready = true;
    return found = made;
}

Vector Patches::random_place(std::uint64_t seed) const {
    struct Choice {
        Symbol symbol;
        Vector at;
        std::uint32_t heading;
        double area;  ///< of its box, added to those before it
    };
    Vector at;
    std::uint32_t heading = 0;
    const Word* word = &grammar_.axiom();
    std::vector<Choice> choices;
    std::vector<std::pair<Vector, std::uint32_t>> saved;
    for (std::size_t level = levels();; --level) {
        choices.clear();
        saved.clear();
        for (const Symbol child : *word) {
            if (grammar_.is_push(child)) {
                saved.emplace_back(at, heading);
                continue;
            }
            if (grammar_.is_pop(child)) {
                std::tie(at, heading) = saved.back();
                saved.pop_back();
                continue;
            }
            const Piece& is = pieces_[index(child, level, heading)];
            const glm::dvec2 size = is.box.high - is.box.low;
            if (!is.box.empty() && size.x * size.y > 0) {
                choices.push_back(
                    {child, at, heading, size.x * size.y + (choices.empty() ? 0 : choices.back().area)});
            }
            at += is.way;
            heading = (heading + is.turn) % lattice_.headings;
        }
        if (choices.empty()) return at;
        seed = scrambled(seed + 1);
        const double drawn = static_cast<double>(seed >> 11) * 0x1p-53 * choices.back().area;
        const auto chosen = std::find_if(choices.begin(), choices.end() - 1,
                                         [&](const Choice& choice) { return choice.area > drawn; });
        at = chosen->at;
        heading = chosen->heading;
        std::size_t below = level;
        while (below > 0 && !successor(chosen->symbol, below)) --below;
        if (below == 0 || kinds_[below * symbols_ + chosen->symbol] != Kind::composed) {
            const Box& box = pieces_[index(chosen->symbol, level, heading)].box;
            const glm::dvec2 centre = (box.low + box.high) / 2.0;
            at += {static_cast<Quad>(centre.x), static_cast<Quad>(centre.y)};
            return at;
        }
        word = successor(chosen->symbol, below);
        level = below;
    }
}

bool Patches::read(Vector origin, const Box& box, PathSink& sink, const DrawOptions& options) const {
    struct Frame {
        const Symbol* next;
        const Symbol* end;
        std::size_t level;
    };
    struct State {
        Vector at;
        std::uint32_t heading = 0;
    };
    State here{{-origin.x, -origin.y}};
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
            if (static_cast<double>(visited) > options.budget) throw too_much(options.budget);
            if (options.watch) options.watch(watched_nodes);
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
        const Piece& is = pieces_[index(symbol, level, here.heading)];
        const glm::dvec2 at = here.at.rounded();
        const bool is_seen = !is.box.empty() && at.x + is.box.low.x <= box.high.x &&
                             at.x + is.box.high.x >= box.low.x && at.y + is.box.low.y <= box.high.y &&
                             at.y + is.box.high.y >= box.low.y;
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
        } else if (is_seen) {
            if (!is_down) sink.begin_stroke(at, Pen{});
            is_down = true;
            has_drawn = has_drawn || style_.draws(Pen{});
            Vector end = here.at;
            const glm::dvec2 point = (end += is.way).rounded();
            sink.lines(std::span(&point, 1));
        } else if (is.way.x != 0 || is.way.y != 0) {
            lift();
        }
        here.at += is.way;
        here.heading = (here.heading + is.turn) % lattice_.headings;
    }
    lift();
    return has_drawn;
}

WindowDrawing::WindowDrawing(std::shared_ptr<const Grammar> grammar, std::unique_ptr<Patches> patches,
                             const Style& style, const DrawOptions& options)
    : Drawing(options), grammar_(std::move(grammar)), patches_(std::move(patches)), style_(style) {
    const ViewWindow& window = *options.window;
    extent_ = window_extent({0, 0, window.x1 - window.x0, window.y1 - window.y0}, orientation(options.placement));
    extent_.around = patches_->widest();
}

WindowDrawing::~WindowDrawing() = default;

std::unique_ptr<WindowDrawing> WindowDrawing::make(std::shared_ptr<const Grammar> grammar, const Style& style,
                                                   const DrawOptions& options, std::string& why) {
    // A frame is in the coordinates of the whole drawing.
    if (!options.window || options.frame || grammar->is_spatial() || grammar->map()) return nullptr;
    const auto cost = estimate(*grammar, true);
    if (cost && cost->nodes <= most_clipped_symbols) return nullptr;
    if (style.line == Line::spline || has_ornaments(style, options) || style.hand > 0 || options.lesson_step ||
        has_frame(style, options) || options.repeat || options.plot || is_for_plotters(options.format) ||
        options.tiles) {
        why =
            "splines with polygons, dots, fields, weaves, parallel lines, borders, lines of text, repeats, colours "
            "by "
            "strand, hand-drawn lines and plots need the whole drawing";
        return nullptr;
    }
    auto patches = Patches::make(*grammar, style, why);
    if (!patches) return nullptr;
    return std::unique_ptr<WindowDrawing>(new WindowDrawing(std::move(grammar), std::move(patches), style, options));
}

double WindowDrawing::scale() const {
    return options_.placement.scale * (grammar_->scale_percent() / 100);
}

void WindowDrawing::read(const Print& print, const Window& window, PathSink& sink) const {
    const double width = extent_.around * (style_.stroke.in_steps ? print.placement.step : 1.0);
    const Box box = seen_box(print, window, width + print.press.bleed);
    if (patches_->read({options_.window->x0, options_.window->y0}, box, sink, options_)) is_empty_ = false;
}

void WindowDrawing::report(DrawReport& report) const {
    report.is_empty = is_empty_;
}

namespace {

/// Adds up the area that polygons cover within a box.
class CoverSink : public PathSink {
public:
    explicit CoverSink(const Box& box) : box_(box) {}
    void begin_stroke(glm::dvec2, const Pen&) override {}
    void lines(std::span<const glm::dvec2>) override {}
    void curves(std::span<const glm::dvec2>) override {}
    void change_pen(const Pen&) override {}
    void end_stroke(bool) override {}
    void disc(glm::dvec2, double, const Pen&) override {}
    /// Cut at each side of the box. Source: Sutherland & Hodgman, CACM 17, 1974.
    void polygon(std::span<const glm::dvec2> vertices, const Pen&) override {
        corners_.assign(vertices.begin(), vertices.end());
        for (int side = 0; side < 4 && !corners_.empty(); ++side) {
            const int axis = side % 2;
            const auto depth = [&](glm::dvec2 at) {
                return side < 2 ? at[axis] - box_.low[axis] : box_.high[axis] - at[axis];
            };
            kept_.clear();
            for (std::size_t i = 0; i < corners_.size(); ++i) {
                const glm::dvec2 a = corners_[i], b = corners_[(i + 1) % corners_.size()];
                const double from = depth(a), to = depth(b);
                if (from >= 0) kept_.push_back(a);
                if ((from >= 0) != (to >= 0)) kept_.push_back(a + (b - a) * (from / (from - to)));
            }
            std::swap(corners_, kept_);
        }
        if (corners_.size() > 2) area += std::fabs(polygon_area(corners_));
    }

    double area = 0;

private:
    Box box_;
    std::vector<glm::dvec2> corners_, kept_;
};

double area_of(const Box& box) {
    return (box.high.x - box.low.x) * (box.high.y - box.low.y);
}

}  // namespace

std::optional<FilledPage> find_filled_page(const Grammar& grammar, const Style& style, glm::dvec2 size, double around,
                                           const DrawOptions& options, std::string& why) {
    constexpr std::int64_t longest = 500, tried_one_by_one = 20;
    constexpr std::uint64_t tries = 40;
    constexpr double rounding = 1e-7, largest_page = 1e6, spot_size = 0.01;
    Box page;
    page.add(glm::dvec2(-around));
    page.add(size + around);
    const double area = area_of(page);
    if (!(area <= largest_page)) {
        why = fmt::format("the page has more than {:.0f} square steps", largest_page);
        return std::nullopt;
    }
    for (std::int64_t steps = 1; steps <= longest; steps += steps < tried_one_by_one ? 1 : 1 + steps / 10) {
        options.monitor.check();
        const auto deeper = grammar.with_steps(steps);
        if (!deeper) continue;
        const auto patches = Patches::make(*deeper, style, why);
        if (!patches) return std::nullopt;
        const glm::dvec2 whole = patches->box().high - patches->box().low;
        if (patches->box().empty() || whole.x * whole.y < area) continue;
        for (std::uint64_t i = 0; i < tries; ++i) {
            const Vector centre = patches->random_place(scrambled(grammar.seed()) + i);
            // Whole numbers can be given again as a window.
            const auto corner = [](Quad middle, double side) {
                const double low = std::floor(static_cast<double>(middle) - side / 2);
                return static_cast<Quad>(low);
            };
            const Vector low{corner(centre.x, size.x), corner(centre.y, size.y)};
            const auto is_covered = [&](const Box& box) {
                CoverSink cover(box);
                patches->read(low, box, cover, options);
                return cover.area >= area_of(box) * (1 - rounding);
            };
            // Most places fail at the edge of the page.
            bool may_fit = true;
            for (int k = 0; k < 16 && may_fit; ++k) {
                if (k == 5 || k == 6 || k == 9 || k == 10) continue;
                const glm::dvec2 at = page.low + (page.high - page.low) * (glm::dvec2(k % 4, k / 4) / 3.0);
                Box spot;
                spot.add(at - spot_size);
                spot.add(at + spot_size);
                may_fit = is_covered(spot);
            }
            if (!may_fit || !is_covered(page)) continue;
            return FilledPage{steps,
                              {low.x, low.y, low.x + static_cast<Quad>(size.x), low.y + static_cast<Quad>(size.y)}};
        }
    }
    why = "its polygons cover no place of this size up to a derivation length of 500";
    return std::nullopt;
}

}  // namespace sikku
