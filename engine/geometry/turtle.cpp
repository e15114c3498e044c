#include "engine/geometry/turtle.h"

#include "engine/geometry/lattice.h"
#include "engine/geometry/lettering.h"
#include "engine/geometry/turtle_state.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr std::size_t points_in_block = 1024;
constexpr std::size_t labels_in_block = 1024;
constexpr std::size_t most_waiting_labels = std::size_t{1} << 24;

/// Positions in Z[zeta], headings modulo k.
template <int Rank>
class ExactWalker {
public:
    struct State {
        std::array<std::int64_t, Rank> at{};
        std::uint32_t heading = 0;
        bool same_place(const State& other) const { return at == other.at; }
    };

    explicit ExactWalker(const Lattice& lattice) : lattice_(lattice) {
        for (int i = 0; i < Rank; ++i) basis_[static_cast<std::size_t>(i)] = lattice.basis(i) * lattice.unit;
        for (const auto& power : lattice.power) std::copy_n(power.begin(), Rank, steps_.emplace_back().begin());
        for (const auto& edge : lattice.edges) {
            for (std::uint32_t heading = 0; heading < lattice.headings; ++heading) {
                auto& turned = steps_.emplace_back();
                for (std::size_t i = 0; i < Rank; ++i) {
                    const auto& power = lattice.power[(heading + i) % lattice.headings];
                    for (std::size_t j = 0; j < Rank; ++j) turned[j] += edge[i] * power[j];
                }
            }
        }
    }
    void step(State& state, Symbol symbol) const {
        const std::int64_t length = lattice_.length[symbol];
        const auto& step = steps_[lattice_.edge[symbol] * lattice_.headings + state.heading];
        for (std::size_t i = 0; i < Rank; ++i) state.at[i] += step[i] * length;
    }
    // Modules with variable steps or angles do not lie on a lattice.
    void step_by(State&, double) const {}
    void turn_by(State&, double) const {}
    void turn(State& state, Symbol symbol) const {
        state.heading += lattice_.turn[symbol];
        if (state.heading >= lattice_.headings) state.heading -= lattice_.headings;
    }
    glm::dvec2 point(const State& state) const {
        glm::dvec2 sum(0.0);
        for (std::size_t i = 0; i < Rank; ++i) sum += static_cast<double>(state.at[i]) * basis_[i];
        return sum;
    }
    double heading(const State& state) const {
        return lattice_.first_heading + 360.0 * state.heading / lattice_.headings;
    }
    /// True if the coordinates leave enough of 64 bits for another run of symbols.
    bool in_range(const State& state) const {
        return std::all_of(state.at.begin(), state.at.end(), [](std::int64_t coordinate) {
            return coordinate < (std::int64_t{1} << 62) && coordinate > -(std::int64_t{1} << 62);
        });
    }

private:
    const Lattice& lattice_;
    std::array<glm::dvec2, Rank> basis_;
    std::vector<std::array<std::int64_t, Rank>> steps_;  // by Lattice::edge and heading
};

/// Positions in doubles; headings modulo k, or in degrees if there is no k.
class PlaneWalker {
public:
    struct State {
        glm::dvec2 at{0.0};
        std::uint32_t heading = 0;
        double degrees = 0.0;
        bool same_place(const State& other) const {
            const glm::dvec2 gap = at - other.at;
            return std::hypot(gap.x, gap.y) <= 1e-9 * std::max(1.0, std::hypot(at.x, at.y));
        }
    };

    PlaneWalker(const Lattice& lattice, const Grammar& grammar) : lattice_(lattice), grammar_(grammar) {}
    void step(State& state, Symbol symbol) const { step_by(state, grammar_.symbols()[symbol].command.value); }
    void step_by(State& state, double length) const {
        const glm::dvec2 direction = lattice_.headings > 0 ? lattice_.direction[state.heading]
                                                           : unit_vector(lattice_.first_heading + state.degrees);
        state.at += length * direction;
    }
    void turn(State& state, Symbol symbol) const {
        if (lattice_.headings > 0) {
            state.heading += lattice_.turn[symbol];
            if (state.heading >= lattice_.headings) state.heading -= lattice_.headings;
        } else {
            turn_by(state, grammar_.symbols()[symbol].command.angle.degrees);
        }
    }
    void turn_by(State& state, double degrees) const { state.degrees = std::fmod(state.degrees + degrees, 360.0); }
    glm::dvec2 point(const State& state) const { return state.at; }
    double heading(const State& state) const {
        return lattice_.first_heading +
               (lattice_.headings > 0 ? 360.0 * state.heading / lattice_.headings : state.degrees);
    }
    bool in_range(const State& state) const { return std::isfinite(state.at.x) && std::isfinite(state.at.y); }

private:
    const Lattice& lattice_;
    const Grammar& grammar_;
};

/// Receivers of a turtle's output; each may be null.
struct Sinks {
    PathSink* path = nullptr;
    PlaceSink* places = nullptr;
    OutlineSink* outlines = nullptr;
};

/// A turtle for one kind of walker, which surveys if `Surveying`, and draws otherwise.
template <class Walker, bool Surveying>
class WalkingTurtle final : public Turtle {
public:
    WalkingTurtle(std::unique_ptr<Lattice> lattice, Walker walker, const Grammar& grammar, const Sinks& sinks,
                  bool moves_draw)
        : lattice_(std::move(lattice)),
          walker_(std::move(walker)),
          sink_(sinks.path),
          places_(sinks.places),
          outlines_(sinks.outlines),
          moves_draw_(moves_draw),
          edges_(grammar),
          letter_height_(grammar.letter_height()) {
        edges_.start(state_.place);
        for (const SymbolInfo& symbol : grammar.symbols()) {
            if (symbol.command.action == Action::label) {
                labels_.try_emplace(static_cast<Symbol>(commands_.size()), grammar.labels()[symbol.command.label],
                                    symbol.arguments);
            }
            commands_.push_back({symbol.command.action, symbol.command.value,
                                 std::isfinite(symbol.command.value) && std::isfinite(symbol.command.angle.degrees),
                                 symbol.command.takes_argument, symbol.command.is_vertex, symbol.arity});
        }
        points_.reserve(points_in_block);
    }

    void symbols(const Run& run) override {
        const std::uint64_t first = position_;
        arguments_ = {};
        if (run.arguments.empty()) {
            for (const Symbol symbol : run.symbols) obey<false>(symbol, commands_[symbol]);
        } else {
            const double* next = run.arguments.data();
            for (const Symbol symbol : run.symbols) {
                const Instruction& command = commands_[symbol];
                arguments_ = {next, command.arity};
                if (command.takes_argument) {
                    Instruction own = command;
                    own.value *= *next;
                    own.finite = std::isfinite(own.value);
                    obey<true>(symbol, own);
                } else {
                    obey<false>(symbol, command);
                }
                next += command.arity;
            }
        }
        check_range(first);
    }

    void finish() override {
        stack_.finish();
        polygons_.finish();
        edges_.finish();
        lift();
        survey_.end = walker_.point(state_.place);
        survey_.closed = State().place.same_place(state_.place);
        survey_.heading = std::fmod(walker_.heading(state_.place), 360.0);
        if (survey_.heading < 0) survey_.heading += 360.0;
        if (survey_.heading >= 360.0) survey_.heading = 0;
    }

    Survey survey() const override { return survey_; }

    std::optional<TurtleStand> stand() const override {
        const auto coordinates = coordinates_of(state_.place);
        if (coordinates.empty() || !polygons_.empty() || edges_.in_use()) return std::nullopt;
        TurtleStand stand{{}, state_.place.heading, state_.pen, stack_.depth(), position_};
        std::copy(coordinates.begin(), coordinates.end(), stand.coordinates.begin());
        return stand;
    }
    std::int64_t lowest_depth() override { return std::exchange(lowest_depth_, stack_.depth()); }
    void skip_to(const TurtleStand& stand) override {
        const std::uint64_t first = position_;
        lift();
        if constexpr (requires { state_.place.at.begin(); }) {
            std::copy_n(stand.coordinates.begin(), state_.place.at.size(), state_.place.at.begin());
        }
        state_.place.heading = stand.heading;
        state_.pen = stand.pen;
        position_ = stand.position;
        check_range(first);
    }

private:
    /// @param first  position in the word from which on the place has not been checked
    void check_range(std::uint64_t first) const {
        if (walker_.in_range(state_.place)) return;
        throw WordError(
            fmt::format("between symbols {} and {} of the word the turtle leaves the range of its coordinates",
                        first + 1, position_));
    }

    using Place = typename Walker::State;
    struct State {
        Place place;
        Pen pen;
        std::size_t node = 0;    ///< of the inserted edges' tree
        std::size_t places = 0;  ///< in it, when the branch began
    };
    struct Instruction {
        Action action;
        double value;
        bool finite;
        bool takes_argument;
        bool is_vertex;
        std::uint32_t arity;
    };

    /// A label that waits until the pen is lifted.
    struct Waiting {
        std::string text;
        glm::dvec2 at;
        Pen pen;
    };

    /// Executes a command; with `Own`, its value is the module's argument.
    template <bool Own>
    void obey(Symbol symbol, const Instruction& command) {
        ++position_;
        switch (command.action) {
            case Action::pass:
                break;
            case Action::draw:
                step<Own>(symbol, command, true);
                break;
            case Action::move:
                step<Own>(symbol, command, false);
                break;
            case Action::turn:
                require_finite(command);
                if constexpr (Own) {
                    walker_.turn_by(state_.place, command.value);
                } else {
                    walker_.turn(state_.place, symbol);
                }
                break;
            case Action::label:
                write_label(symbol);
                break;
            default:
                rare(command);
        }
    }

    template <bool Own>
    void walk(Symbol symbol, const Instruction& command) {
        if constexpr (Own) {
            walker_.step_by(state_.place, command.value);
        } else {
            walker_.step(state_.place, symbol);
        }
    }

    void require_finite(const Instruction& command) const {
        if (!command.finite) throw_at(position_, "its parameter is not finite");
    }

    template <bool Own>
    void step(Symbol symbol, const Instruction& command, bool drawn) {
        require_finite(command);
        if constexpr (Surveying) {
            if (drawn) note_ink(walker_.point(state_.place));
            walk<Own>(symbol, command);
            const glm::dvec2 point = walker_.point(state_.place);
            widen(survey_.box, point);
            ++survey_.moves;
            if (drawn) {
                ++survey_.drawn;
                survey_.length += std::fabs(command.value);
                widen(*survey_.ink, point);
            }
        } else {
            if (drawn || moves_draw_) {
                lower();
                walk<Own>(symbol, command);
                points_.push_back(walker_.point(state_.place));
                if (places_) note_place();
                if (points_.size() == points_in_block) flush();
            } else {
                lift();
                walk<Own>(symbol, command);
                if (outlines_ && is_outlining_ && !polygons_.empty())
                    outlines_->outline_vertex(walker_.point(state_.place));
            }
            if (command.is_vertex) add_vertex();
            edges_.step(state_.place, state_.node, position_);
        }
    }

    void add_vertex() {
        if (polygons_.empty()) return;
        polygons_.add(state_.place, [this](const Place& place) {
            if (places_) note_place(place, vertices_);
            return walker_.point(place);
        });
    }

    static void widen(Bounds& bounds, glm::dvec2 point) {
        bounds.low = {std::min(bounds.low.x, point.x), std::min(bounds.low.y, point.y)};
        bounds.high = {std::max(bounds.high.x, point.x), std::max(bounds.high.y, point.y)};
    }
    void note_ink(glm::dvec2 point) {
        if (!survey_.ink) survey_.ink = Bounds{point, point};
        widen(*survey_.ink, point);
    }

    void rare(const Instruction& command) {
        switch (command.action) {
            case Action::push:
                if (moves_draw_) lift();
                state_.places = edges_.size();
                stack_.push(state_, position_);
                survey_.depth = std::max(survey_.depth, stack_.depth());
                break;
            case Action::pop: {
                State popped = stack_.pop(position_);
                lowest_depth_ = std::min(lowest_depth_, stack_.depth());
                lift();
                state_ = popped;
                edges_.pop(state_.places);
                break;
            }
            case Action::polygon_begin:
                refuse_cylinder(position_, command.value);
                is_outlining_ = command.is_vertex;
                polygons_.begin(state_.place, is_outlining_, position_);
                if (places_) vertices_begin_.push_back(vertices_.size());
                if (outlines_ && is_outlining_) {
                    flush();
                    outlines_->begin_outline(walker_.point(state_.place));
                }
                break;
            case Action::polygon_end:
                end_polygon();
                break;
            case Action::polygon_vertex:
                if constexpr (!Surveying) add_vertex();
                break;
            case Action::edge_begin:
                edges_.open(state_.node, position_);
                break;
            case Action::edge_end:
                end_edge();
                break;
            case Action::width_factor:
            case Action::width_set:
            case Action::colour_step:
            case Action::colour_set:
                require_finite(command);
                change_pen(state_.pen, command.action, command.value);
                break;
            case Action::disc:
                require_finite(command);
                if (sink_) {
                    flush();
                    sink_->disc(walker_.point(state_.place), std::fabs(command.value), state_.pen);
                }
                break;
            case Action::mark:
                if (sink_) sink_->mark();
                break;
            default:
                break;
        }
    }

    void write_label(Symbol symbol) {
        const auto& [label, own] = labels_.at(symbol);
        const std::span<const double> arguments = arguments_.empty() ? std::span(own) : arguments_;
        Waiting waiting{text_at(label, arguments, position_), walker_.point(state_.place), state_.pen};
        if constexpr (Surveying) {
            const glm::dvec2 half(text_width(waiting.text, letter_height_) / 2, letter_height_ / 2);
            note_ink(waiting.at - half);
            widen(*survey_.ink, waiting.at + half);
        } else if (sink_) {
            waiting_.push_back(std::move(waiting));
            if (!down_) return write_labels();
            if (!moves_draw_ && waiting_.size() >= labels_in_block) lift();
            if (waiting_.size() > most_waiting_labels)
                throw_at(position_, "more than 16,777,216 labels along one line");
        }
    }

    void write_labels() {
        for (const Waiting& label : waiting_) sink_->label(label.text, label.at, letter_height_, label.pen);
        waiting_.clear();
    }

    void end_polygon() {
        const std::vector<glm::dvec2> vertices = polygons_.end(position_);
        ++survey_.polygons;
        if (outlines_ && is_outlining_) {
            flush();
            outlines_->end_outline(state_.pen, vertices.size() >= 3);
        } else if (sink_ && vertices.size() >= 3) {
            flush();
            if (places_) tell_vertices(vertices.size());
            sink_->polygon(vertices, state_.pen);
        }
        if (!places_) return;
        vertices_.resize(vertices_begin_.back());
        vertices_begin_.pop_back();
    }

    /// Passes on the places of the polygon's `count` vertices.
    void tell_vertices(std::size_t count) {
        std::span<const std::int64_t> all = std::span(vertices_).subspan(vertices_begin_.back());
        if (!all.empty()) all = all.first(count * std::tuple_size_v<decltype(coordinates_of(state_.place))>);
        places_->vertices(all, position_, polygons_.was_closed());
    }

    void end_edge() {
        const std::vector<Place> cycle = edges_.close(state_.node, position_);
        ++survey_.polygons;
        if (!sink_) return;
        if (outlines_ && is_outlining_ && !polygons_.empty()) {
            throw_at(position_, "an inserted edge within the outline of a polygon, which follows a spline");
        }
        lift();
        if (cycle.size() >= 3) {
            std::vector<glm::dvec2> vertices;
            for (const Place& place : cycle) vertices.push_back(walker_.point(place));
            sink_->polygon(vertices, state_.pen);
        }
        if (cycle.size() < 2) return;
        for (const Place& place : {cycle.front(), cycle.back()}) {
            note_place(place, coordinates_);
            if (places_) places_->places(coordinates_);
            coordinates_.clear();
            const glm::dvec2 point = walker_.point(place);
            down_ ? sink_->lines({&point, 1}) : sink_->begin_stroke(point, state_.pen);
            down_ = true;
        }
        sink_->end_stroke(false);
        down_ = false;
    }

    /// Lowers the pen, or changes it, before a segment is drawn.
    void lower() {
        if (!down_) {
            down_ = true;
            pen_ = state_.pen;
            start_ = state_.place;
            if (places_) {
                note_place();
                places_->places(coordinates_);
            }
            sink_->begin_stroke(walker_.point(state_.place), pen_);
            coordinates_.clear();
        } else if (pen_ != state_.pen) {
            flush();
            pen_ = state_.pen;
            sink_->change_pen(pen_);
        }
    }

    void lift() {
        if (!down_) return;
        flush();
        sink_->end_stroke(start_.same_place(state_.place));
        down_ = false;
        write_labels();
    }

    void flush() {
        if (points_.empty()) return;
        if (places_) places_->places(coordinates_);
        sink_->lines(points_);
        points_.clear();
        coordinates_.clear();
    }

    /// Whole coordinates of a place; none if places are doubles.
    static auto coordinates_of(const Place& place) {
        if constexpr (requires { place.at.begin(); }) {
            return place.at;
        } else {
            return std::array<std::int64_t, 0>{};
        }
    }
    void note_place() { note_place(state_.place, coordinates_); }
    void note_place(const Place& place, std::vector<std::int64_t>& list) {
        const auto coordinates = coordinates_of(place);
        list.insert(list.end(), coordinates.begin(), coordinates.end());
    }

    std::unique_ptr<Lattice> lattice_;
    Walker walker_;
    PathSink* sink_;
    PlaceSink* places_;
    OutlineSink* outlines_;
    bool moves_draw_;
    std::vector<Instruction> commands_;
    State state_;
    BracketStack<State> stack_;
    std::int64_t lowest_depth_ = 0;
    PolygonStack<Place, glm::dvec2> polygons_;
    InsertedEdges<Place> edges_;
    bool is_outlining_ = false;  ///< the pattern's polygons are outlines
    std::uint64_t position_ = 0;
    bool down_ = false;
    Pen pen_;
    Place start_;
    std::vector<glm::dvec2> points_;
    std::vector<std::int64_t> coordinates_;  // of points_
    std::vector<std::int64_t> vertices_;     // coordinates of the vertices of open polygons, for places_
    std::vector<std::size_t> vertices_begin_;
    std::span<const double> arguments_;  // of the module, if it states them
    std::unordered_map<Symbol, std::pair<LabelText, std::vector<double>>> labels_;  // with constant parameters
    std::vector<Waiting> waiting_;
    double letter_height_;
    Survey survey_;
};

template <bool Surveying>
std::unique_ptr<Turtle> make_turtle(const Grammar& grammar, const Sinks& sinks, bool moves_draw) {
    auto lattice = std::make_unique<Lattice>(make_lattice(grammar));
    const Lattice& fixed = *lattice;
    const auto make = [&]<class Walker>(Walker walker) -> std::unique_ptr<Turtle> {
        return std::make_unique<WalkingTurtle<Walker, Surveying>>(std::move(lattice), std::move(walker), grammar,
                                                                  sinks, moves_draw);
    };
    if (fixed.rank == 2) return make(ExactWalker<2>(fixed));
    if (fixed.rank == 4) return make(ExactWalker<4>(fixed));
    if (fixed.rank == 6) return make(ExactWalker<6>(fixed));
    if (fixed.rank == 8) return make(ExactWalker<8>(fixed));
    return make(PlaneWalker(fixed, grammar));
}

}  // namespace

void throw_at(std::uint64_t position, std::string_view what) {
    throw WordError(fmt::format("symbol {} of the word: {}", position, what));
}

std::unique_ptr<Turtle> Turtle::drawing(const Grammar& grammar, PathSink& sink, bool moves_draw) {
    return make_turtle<false>(grammar, {.path = &sink}, moves_draw);
}
std::unique_ptr<Turtle> Turtle::outlining(const Grammar& grammar, PathSink& sink, OutlineSink& outlines,
                                          bool moves_draw) {
    return make_turtle<false>(grammar, {.path = &sink, .outlines = &outlines}, moves_draw);
}
std::unique_ptr<Turtle> Turtle::tracing(const Grammar& grammar, PathSink& sink, PlaceSink& places, bool moves_draw) {
    return make_turtle<false>(grammar, {.path = &sink, .places = &places}, moves_draw);
}
std::unique_ptr<Turtle> Turtle::surveying(const Grammar& grammar) {
    return make_turtle<true>(grammar, {}, false);
}

}  // namespace sikku
