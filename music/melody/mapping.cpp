#include "music/melody/mapping.h"

#include "engine/geometry/lattice.h"
#include "music/melody/melody_fold.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace sikku {
namespace {

constexpr std::int64_t unknown = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t farthest = std::int64_t{1} << 61;  // of a coordinate, of a time in steps
constexpr std::int64_t latest = std::int64_t{1} << 62;    // of ticks
constexpr std::size_t notes_in_block = 1024;
constexpr std::int64_t margin_units = 64;  // walked before a bar, so that what leads up to it is known
constexpr std::size_t deepest = std::size_t{1} << 20;

/// The end of the piece was reached; nothing after it is of interest.
struct Enough {};

/// Degrees become keys, and notes reach the sink: cut to the piece that is wanted, counted, a block at a time.
class Emitter {
public:
    Emitter(const Melody& melody, NoteSink& sink, const PlayOptions& options)
        : melody_(melody), sink_(sink), options_(options) {
        block_.reserve(notes_in_block);
        for (auto& keys : keys_) keys.assign(2 * cached_degrees, Placed{});
    }

    /// What a voice remembers between its notes.
    struct Line {
        int voice = -1;
        std::int64_t last_degree = unknown;
        bool falling = false;
    };

    void note(Line& line, std::int64_t degree, std::int64_t onset, std::int64_t end, int velocity, glm::dvec2 from,
              glm::dvec2 to) {
        if (line.last_degree != unknown && degree != line.last_degree) line.falling = degree < line.last_degree;
        line.last_degree = degree;
        if (end <= onset) {
            ++report.lost;
            return;
        }
        // Also before the piece, so that its voices are those of the whole.
        if (line.voice < 0) line.voice = free_voice(onset);
        if (line.voice >= static_cast<int>(busy_until_.size())) busy_until_.resize(line.voice + 1U, 0);
        busy_until_[static_cast<std::size_t>(line.voice)] = end;
        if (end <= options_.from || onset >= options_.to) return;
        const Placed placed = key_of(degree, line.falling);
        if (placed.is_silent) {
            ++report.lost;
            return;
        }
        report.moved += placed.is_moved ? 1 : 0;
        ++report.notes;
        report.lowest = std::min(report.lowest, placed.key);
        report.highest = std::max(report.highest, placed.key);
        onset = std::max(onset, options_.from);
        block_.push_back({onset - options_.from, std::min(end, options_.to) - onset, placed.key,
                          static_cast<std::int16_t>(line.voice),
                          static_cast<std::uint8_t>(std::clamp(velocity, 1, 127)), from, to});
        if (block_.size() == notes_in_block) flush();
    }

    /// Lines that are there from the beginning have their voices from the beginning.
    void take(Line& line, int voice) {
        line.voice = voice;
        if (held_.size() <= static_cast<std::size_t>(voice)) held_.resize(voice + 1U, 0);
        held_[static_cast<std::size_t>(voice)] = 1;
    }

    /// A branch may take the voice of one that has ended.
    void release(const Line& line) {
        if (line.voice >= 0) held_[static_cast<std::size_t>(line.voice)] = false;
    }

    void finish(std::int64_t end) {
        flush();
        const bool past = end <= options_.from;
        end = std::max<std::int64_t>(0, std::min(end, options_.to) - options_.from);
        for (const std::int64_t busy : busy_until_) {
            end = std::max(end, std::min(busy, options_.to) - options_.from);
        }
        report.end = end;
        report.past = past;
        report.voices = static_cast<int>(busy_until_.size());
        sink_.finish(end);
    }

    PlayReport report;

private:
    struct Placed {
        double key = std::numeric_limits<double>::quiet_NaN();  // not looked up yet
        bool is_moved = false;
        bool is_silent = false;
    };

    void flush() {
        if (!block_.empty()) sink_.notes(block_);
        block_.clear();
    }

    int free_voice(std::int64_t onset) {
        for (int voice = 0;; ++voice) {
            const auto at = static_cast<std::size_t>(voice);
            if (at >= held_.size()) held_.resize(at + 1, false);
            if (held_[at] || (at < busy_until_.size() && busy_until_[at] > onset)) continue;
            if (voice >= options_.most_voices) {
                throw ScoreError(fmt::format(
                    "too many voices: more than {} branches sound at once; a smaller n has fewer", voice));
            }
            held_[at] = true;
            return voice;
        }
    }

    Placed key_of(std::int64_t degree, bool falling) {
        if (degree < -cached_degrees || degree >= cached_degrees) return look_up(degree, falling);
        Placed& known = keys_[falling ? 1 : 0][static_cast<std::size_t>(degree + cached_degrees)];
        if (std::isnan(known.key)) known = look_up(degree, falling);
        return known;
    }

    bool is_within(double key) const { return key >= melody_.lowest && key <= melody_.highest; }

    Placed look_up(std::int64_t degree, bool falling) {
        const auto raw = melody_.key(degree, falling);
        if (!raw) {
            if (melody_.range == Range::refuse) refuse(degree, "no key at all");
            return {0, false, true};
        }
        if (is_within(*raw)) return {*raw, false, false};
        switch (melody_.range) {
            case Range::refuse:
                refuse(degree, fmt::format("key {:.0f}", *raw));
            case Range::fold: {
                const double period = std::fabs(melody_.scale.period) / 100;
                double key = *raw;
                if (std::isfinite(key) && period > 0 && period <= melody_.highest - melody_.lowest) {
                    key += key > melody_.highest ? -period * std::ceil((key - melody_.highest) / period)
                                                 : period * std::ceil((melody_.lowest - key) / period);
                }
                return {std::clamp(key, melody_.lowest, melody_.highest), true, false};
            }
            case Range::clamp:
            case Range::reflect:
                break;
        }
        find_bounds();
        std::int64_t inside = std::clamp(degree, low_, high_);
        if (melody_.range == Range::reflect && high_ > low_) {
            const std::int64_t width = high_ - low_;
            std::int64_t phase = (degree - low_) % (2 * width);
            if (phase < 0) phase += 2 * width;
            inside = low_ + (phase <= width ? phase : 2 * width - phase);
        }
        return {std::clamp(melody_.key(inside, falling).value_or(60.0), melody_.lowest, melody_.highest), true,
                false};
    }

    [[noreturn]] void refuse(std::int64_t degree, const std::string& key) const {
        throw ScoreError(fmt::format(
            "degree {} of the scale would be {}, beyond the keys {:.0f} to {:.0f}: `range: fold`, another "
            "tonic or a smaller n helps",
            degree, key, melody_.lowest, melody_.highest));
    }

    /// The degrees around the tonic whose keys are within.
    void find_bounds() {
        if (low_ <= high_) return;
        const auto fits = [&](std::int64_t degree) {
            const auto up = melody_.key(degree, false);
            const auto down = melody_.key(degree, true);
            return up && down && is_within(*up) && is_within(*down);
        };
        low_ = 0;
        // The tonic may itself be beyond: go to where the keys are.
        const auto tonic = melody_.key(0, false);
        const std::int64_t towards = tonic && *tonic > melody_.highest ? -1 : 1;
        while (std::abs(low_) < 10'000 && !fits(low_)) low_ += towards;
        high_ = low_;
        while (high_ < 10'000 && fits(high_ + 1)) ++high_;
        while (low_ > -10'000 && fits(low_ - 1)) --low_;
    }

    static constexpr std::int64_t cached_degrees = 8192;
    const Melody& melody_;
    NoteSink& sink_;
    const PlayOptions& options_;
    std::vector<Note> block_;
    std::array<std::vector<Placed>, 2> keys_;
    std::int64_t low_ = 1;
    std::int64_t high_ = 0;
    std::vector<std::int64_t> busy_until_;  // of each voice
    std::vector<char> held_;                // by a branch that has not ended
};

/// Coordinates on the square grid, counted in steps, headings in quarter turns.
class GridWalk {
public:
    using Number = std::int64_t;
    struct Position {
        std::int64_t x = 0, y = 0;
        std::uint32_t heading = 0;
    };
    struct Step {
        std::int64_t x, y;
    };
    GridWalk(const Grammar&, const Lattice& lattice, int first) : lattice_(lattice) {
        start.heading = static_cast<std::uint32_t>(first);
    }
    std::int64_t steps(Symbol symbol) const { return lattice_.length[symbol]; }
    std::uint32_t quarters(Symbol symbol) const { return lattice_.turn[symbol]; }
    Step step(const Position& at, Symbol symbol) const { return ahead(at, steps(symbol)); }
    Step ahead(const Position& at, std::int64_t length) const { return along(at.heading, length); }
    void turn(Position& at, Symbol symbol) const { at.heading = (at.heading + lattice_.turn[symbol]) & 3; }
    static void skip(Position& at, const GridStretch& stretch) {
        for (std::uint32_t axis = 0; axis < 2; ++axis) {
            const Integer& by = stretch.move[axis];
            if (by >= farthest || by <= -farthest) {
                throw ScoreError("the curve is too large to be played from its middle: a smaller n is needed");
            }
            const Step step = along((at.heading + axis) & 3, by.convert_to<std::int64_t>());
            at.x += step.x;
            at.y += step.y;
        }
        at.heading = (at.heading + static_cast<std::uint32_t>(stretch.turn)) & 3;
    }
    static bool is_level(std::int64_t rise) { return rise == 0; }
    /// Both lie along an axis and neither is nothing. In doubles, as their product may be too large.
    static bool same_direction(const Step& a, const Step& b) {
        return static_cast<double>(a.x) * static_cast<double>(b.x) +
                   static_cast<double>(a.y) * static_cast<double>(b.y) >
               0;
    }
    static std::int64_t ticks(std::int64_t steps, std::int64_t unit) {
        std::int64_t product = 0;
        // A division to see whether it fits would take longer than all else that a note takes.
        return __builtin_mul_overflow(steps, unit, &product) || product > latest ? latest : product;
    }
    static std::int64_t length(const Step& step) { return std::abs(step.x) + std::abs(step.y); }
    static std::int64_t degree(std::int64_t twice) { return twice >= 0 ? (twice + 1) / 2 : -((-twice) / 2); }
    static bool in_range(const Position& at) {
        return at.x < farthest && at.x > -farthest && at.y < farthest && at.y > -farthest;
    }

    Position start;

private:
    static Step along(std::uint32_t heading, std::int64_t length) {
        switch (heading) {
            case 0:
                return {length, 0};
            case 1:
                return {0, length};
            case 2:
                return {-length, 0};
            default:
                return {0, -length};
        }
    }
    const Lattice& lattice_;
};

/// Doubles, any angle.
class PlaneWalk {
public:
    using Number = double;
    struct Position {
        double x = 0, y = 0;
        std::uint32_t heading = 0;
        double degrees = 0;
    };
    struct Step {
        double x, y;
    };
    PlaneWalk(const Grammar& grammar, const Lattice& lattice, int) : grammar_(grammar), lattice_(lattice) {}
    Step step(const Position& at, Symbol symbol) const {
        const double length = grammar_.symbols()[symbol].command.value;
        const glm::dvec2 ahead =
            lattice_.headings > 0 ? lattice_.direction[at.heading] : unit_vector(lattice_.first_heading + at.degrees);
        return {length * ahead.x, length * ahead.y};
    }
    void turn(Position& at, Symbol symbol) const {
        if (lattice_.headings > 0) {
            at.heading = (at.heading + lattice_.turn[symbol]) % lattice_.headings;
        } else {
            at.degrees = std::fmod(at.degrees + grammar_.symbols()[symbol].command.angle.degrees, 360.0);
        }
    }
    static bool is_level(double rise) { return std::fabs(rise) < 1e-9; }
    static bool same_direction(const Step& a, const Step& b) {
        const double dot = a.x * b.x + a.y * b.y;
        const double cross = a.x * b.y - a.y * b.x;
        return dot > 0 && std::fabs(cross) <= 1e-9 * dot;
    }
    static std::int64_t ticks(double steps, std::int64_t unit) {
        return std::llround(std::min(steps * static_cast<double>(unit), static_cast<double>(latest)));
    }
    static double length(const Step& step) { return std::hypot(step.x, step.y); }
    static std::int64_t degree(double twice) {
        return static_cast<std::int64_t>(std::clamp(std::floor(twice / 2 + 0.5), -1e15, 1e15));
    }
    static bool in_range(const Position& at) { return std::isfinite(at.x) && std::isfinite(at.y); }

    Position start;

private:
    const Grammar& grammar_;
    const Lattice& lattice_;
};

[[noreturn]] void fault(std::uint64_t position, std::string_view what) {
    throw WordError(fmt::format("symbol {} of the word: {}", position, what));
}

/// What is kept between '[' and ']'.
template <class State>
class Brackets {
public:
    void open(State state, std::uint64_t position) {
        if (saved_.size() >= deepest) fault(position, "brackets nest deeper than 1,048,576");
        saved_.push_back({std::move(state), position});
    }
    State close(std::uint64_t position) {
        if (saved_.empty()) fault(position, "']' without '['");
        State state = std::move(saved_.back().first);
        saved_.pop_back();
        return state;
    }
    void require_closed() const {
        if (!saved_.empty()) fault(saved_.back().second, "this '[' is not closed");
    }
    std::size_t depth() const { return saved_.size(); }

private:
    std::vector<std::pair<State, std::uint64_t>> saved_;
};

/// The velocity of a note.
/// @param turned  the sign of the turn that led into it: to the left is louder
/// @param steps   how long it is
/// @param depth   brackets around it: softer with each
int loudness(const Melody& melody, int turned, double steps, std::size_t depth, std::int64_t onset) {
    switch (melody.loudness) {
        case Loudness::fixed:
            break;
        case Loudness::by_turn:
            return 80 + 18 * turned;
        case Loudness::by_depth:
            return std::max(30, 100 - 12 * static_cast<int>(std::min<std::size_t>(depth, 10)));
        case Loudness::by_length: {
            // Long notes carry weight; a phrase of four bars swells towards its middle.
            const double weight = 8.0 * std::min(4.0, steps);
            const auto phrase = static_cast<double>(4 * melody.meter.bar());
            const double within = std::fmod(static_cast<double>(onset), phrase) / phrase;
            return static_cast<int>(std::lround(58 + weight + 40 * within * (1 - within)));
        }
    }
    return 80;
}

/// 1 to the left, -1 to the right.
int sign_of(const Angle& turn) {
    const double degrees = std::remainder(turn.degrees, 360.0);
    return degrees > 0 ? 1 : degrees < 0 ? -1 : 0;
}

/// The y that sounds the tonic, doubled; unknown: that of the first note. The x is where the turtle starts.
struct Origin {
    std::int64_t y = unknown;
};

class Reader : public SymbolSink {
public:
    /// Times and positions after a part that is passed over. Of Readers on the grid only.
    virtual bool skip(const GridStretch&) { return false; }
    virtual std::int64_t lowest_vertex() const { return 0; }
    virtual std::int64_t highest_vertex() const { return 0; }
    /// Of the first note and of the lowest, before the origin is taken off; unknown without notes.
    virtual std::int64_t first_degree() const { return 0; }
    virtual std::int64_t lowest_degree() const { return 0; }
    bool seeks_first_note = false;  ///< Enough is thrown there
};

/// What a symbol is to the reader of runs.
enum class Kind : std::uint8_t { nothing, draw, move, turn, open, close, not_finite };

Kind kind_of(const Command& command) {
    const bool is_finite = std::isfinite(command.value) && std::isfinite(command.angle.degrees);
    switch (command.action) {
        case Action::draw:
            return is_finite ? Kind::draw : Kind::not_finite;
        case Action::move:
            return is_finite ? Kind::move : Kind::not_finite;
        case Action::turn:
            return is_finite ? Kind::turn : Kind::not_finite;
        case Action::push:
            return Kind::open;
        case Action::pop:
            return Kind::close;
        default:
            return Kind::nothing;
    }
}

/// The runs of a curve, as notes.
template <class Walk>
class RunReader final : public Reader {
public:
    RunReader(const Grammar& grammar, const Lattice& lattice, int first, const Melody& melody, Emitter& emitter,
              Origin origin, const PlayOptions& options, bool has_brackets)
        : grammar_(grammar),
          melody_(melody),
          emitter_(emitter),
          origin_(origin),
          options_(options),
          walk_(grammar, lattice, first),
          may_stop_(!has_brackets) {
        for (const SymbolInfo& symbol : grammar.symbols()) kinds_.push_back(kind_of(symbol.command));
        state_.at = walk_.start;
        state_.run.from = state_.at;
        emitter_.take(state_.line, 0);
        if (melody.vertical == Vertical::voice) emitter_.take(state_.other, 1);
    }

    void symbols(const Run& run) override {
        if constexpr (std::is_same_v<Walk, GridWalk>) {
            if (run.block >= 0 && play_block(run)) return;
        }
        for (const Symbol symbol : run.symbols) {
            ++position_;
            switch (kinds_[symbol]) {
                case Kind::draw:
                    draw(walk_.step(state_.at, symbol));
                    break;
                case Kind::move:
                    move(symbol);
                    break;
                case Kind::turn:
                    walk_.turn(state_.at, symbol);
                    break;
                case Kind::open:
                    open();
                    break;
                case Kind::close:
                    close();
                    break;
                case Kind::not_finite:
                    fault(position_, "its parameter is not finite");
                case Kind::nothing:
                    break;
            }
        }
        require_in_range();
    }

    void finish() override {
        stack_.require_closed();
        end_run();
        release_held();
        emitter_.finish(ticks(std::max(state_.time, state_.other_time)));
    }

    bool skip(const GridStretch& stretch) override {
        if constexpr (std::is_same_v<Walk, GridWalk>) {
            const bool is_level = state_.at.heading % 2 == 0;
            const Integer& across = stretch.length[is_level ? 0 : 1];
            const Integer& up = stretch.length[is_level ? 1 : 0];
            const bool both = melody_.vertical == Vertical::rest || melody_.vertical == Vertical::extend ||
                              melody_.vertical == Vertical::glissando;
            Integer longest = both ? Integer(across + up) : across;
            if (melody_.vertical == Vertical::voice) longest = std::max(across, up);
            const std::int64_t room =
                options_.from / melody_.unit - margin_units - std::max(state_.time, state_.other_time);
            if (room < 0 || longest > room) return false;
            end_run();
            release_held();
            walk_.skip(state_.at, stretch);
            state_.time += (both ? Integer(across + up) : across).convert_to<std::int64_t>();
            if (melody_.vertical == Vertical::voice) state_.other_time += up.convert_to<std::int64_t>();
            state_.has_sounded = true;
            return true;
        } else {
            (void)stretch;
            return false;
        }
    }

    std::int64_t lowest_vertex() const override { return Walk::degree(2 * lowest_); }
    std::int64_t highest_vertex() const override { return Walk::degree(2 * highest_); }
    std::int64_t first_degree() const override { return first_degree_; }
    std::int64_t lowest_degree() const override { return lowest_degree_; }

private:
    using Number = typename Walk::Number;
    using Position = typename Walk::Position;
    using Step = typename Walk::Step;

    struct Pending {
        bool is_open = false;
        Step direction{};
        Position from;
        Number steps = 0;  // drawn so far: their number times their length
        int turned = 0;    // sign of the turn that led into it
    };
    struct Sounding {
        bool is_open = false;
        Number twice = 0;  // its height, doubled
        Number onset = 0, end = 0;
        int velocity = 80;
        glm::dvec2 from{0.0}, to{0.0};
    };
    struct State {
        Position at;
        Pending run;
        Emitter::Line line;
        Emitter::Line other;  // of vertical runs as a voice
        Number time = 0;      // steps
        Number other_time = 0;
        Sounding held;    // a note that the next vertical run may make longer
        Number lead = 0;  // vertical steps before the first note
        bool has_sounded = false;
    };
    std::int64_t ticks(Number steps) const { return Walk::ticks(steps, melody_.unit); }
    static glm::dvec2 point(const Position& at) { return {static_cast<double>(at.x), static_cast<double>(at.y)}; }

    /// A part of the word that recurs, as its straight runs.
    struct Block {
        struct Straight {
            std::uint32_t turn;  ///< quarters, before it
            std::int64_t length;
        };
        std::vector<Straight> runs;
        std::uint32_t turn = 0;  ///< after the last
        bool is_known = false;
        bool is_simple = false;  ///< nothing but steps drawn and turns
    };

    /// False if the block holds what has to be read symbol by symbol.
    bool play_block(const Run& run) {
        const auto number = static_cast<std::size_t>(run.block);
        if (number >= blocks_.size()) blocks_.resize(number + 1);
        Block& block = blocks_[number];
        if (!block.is_known) learn(block, run.symbols);
        if (!block.is_simple) return false;
        position_ += run.symbols.size();
        for (const auto& [turn, length] : block.runs) {
            state_.at.heading = (state_.at.heading + turn) & 3;
            draw(walk_.ahead(state_.at, length));
        }
        state_.at.heading = (state_.at.heading + block.turn) & 3;
        require_in_range();
        return true;
    }

    void require_in_range() const {
        if (Walk::in_range(state_.at) && state_.time < farthest && state_.other_time < farthest) return;
        throw WordError(fmt::format("before symbol {} of the word the turtle leaves the range of its coordinates",
                                    position_ + 1));
    }

    void learn(Block& block, std::span<const Symbol> symbols) {
        block.is_known = true;
        for (const Symbol symbol : symbols) {
            if (kinds_[symbol] == Kind::turn) {
                block.turn = (block.turn + walk_.quarters(symbol)) & 3;
            } else if (kinds_[symbol] == Kind::draw) {
                const std::int64_t length = walk_.steps(symbol);
                const bool goes_on = block.turn == 0 && !block.runs.empty() && melody_.runs == Runs::merged &&
                                     length > 0 && block.runs.back().length > 0;
                if (goes_on) {
                    block.runs.back().length += length;
                } else {
                    block.runs.push_back({block.turn, length});
                }
                block.turn = 0;
            } else if (kinds_[symbol] != Kind::nothing) {
                return;
            }
        }
        block.is_simple = true;
    }

    void draw(const Step& step) {
        if (step.x == 0 && step.y == 0) return;
        Pending& run = state_.run;
        if (!run.is_open || !Walk::same_direction(run.direction, step) || melody_.runs == Runs::each_step) {
            int turned = 0;
            if (run.is_open) {
                const double cross = static_cast<double>(run.direction.x) * static_cast<double>(step.y) -
                                     static_cast<double>(run.direction.y) * static_cast<double>(step.x);
                turned = cross > 0 ? 1 : cross < 0 ? -1 : 0;
            }
            end_run();
            run.is_open = true;
            run.direction = step;
            run.from = state_.at;
            run.turned = turned;
        }
        state_.at.x += step.x;
        state_.at.y += step.y;
    }

    void move(Symbol symbol) {
        end_run();
        const Step step = walk_.step(state_.at, symbol);
        state_.at.x += step.x;
        state_.at.y += step.y;
        note_vertex();
        const Number wide = step.x < 0 ? -step.x : step.x;
        const Number high = step.y < 0 ? -step.y : step.y;
        release_held();
        state_.time += wide;
        if (melody_.vertical != Vertical::ignore && melody_.vertical != Vertical::voice && Walk::is_level(step.x)) {
            state_.time += high;
        }
        if (melody_.vertical == Vertical::voice) state_.other_time += high;
    }

    void note_vertex() {
        lowest_ = std::min(lowest_, state_.at.y);
        highest_ = std::max(highest_, state_.at.y);
    }

    void end_run() {
        Pending& run = state_.run;
        if (!run.is_open) return;
        run.is_open = false;
        note_vertex();
        const Number wide = state_.at.x > run.from.x ? state_.at.x - run.from.x : run.from.x - state_.at.x;
        const Number high = state_.at.y > run.from.y ? state_.at.y - run.from.y : run.from.y - state_.at.y;
        const int velocity = loudness(melody_, run.turned, static_cast<double>(wide > high ? wide : high),
                                      stack_.depth(), ticks(state_.time));
        if (Walk::is_level(high)) {
            sound(run.from.y + state_.at.y, wide, velocity, run);
        } else if (Walk::is_level(wide)) {
            vertical_run(run, high, velocity);
        } else if (melody_.sloped == Sloped::project) {
            sound(run.from.y + state_.at.y, wide, velocity, run);
        } else if (melody_.sloped == Sloped::refuse) {
            throw ScoreError(fmt::format(
                "before symbol {} of the word the curve slopes, and `sloped: refuse` is asked for", position_));
        }
        if (may_stop_ && ticks(state_.time) >= options_.to &&
            (melody_.vertical != Vertical::voice || ticks(state_.other_time) >= options_.to)) {
            release_held();
            throw Enough();
        }
    }

    /// A note at the height `twice` / 2 was met: the first one sounds the tonic, if the melody says so.
    void meet(Number twice, Number end) {
        if (melody_.anchor == Anchor::piece && ticks(end) <= options_.from) return;
        if (first_degree_ == unknown) first_degree_ = Walk::degree(twice);
        if (origin_.y == unknown) origin_.y = 2 * Walk::degree(twice);
        if (seeks_first_note) throw Enough();
    }

    void emit(const Sounding& note) {
        meet(note.twice, note.end);
        if (origin_.y == unknown) return;  // before the piece
        emitter_.note(state_.line, Walk::degree(note.twice - static_cast<Number>(origin_.y)), ticks(note.onset),
                      ticks(note.end), note.velocity, note.from, note.to);
    }

    void sound(Number twice, Number steps, int velocity, const Pending& run) {
        meet(twice, state_.time + steps);
        lowest_degree_ = std::min(lowest_degree_ == unknown ? farthest : lowest_degree_, Walk::degree(twice));
        const bool is_held = melody_.vertical == Vertical::extend;
        if (is_held) {
            release_held();
            steps += state_.lead;
            state_.lead = 0;
            state_.has_sounded = true;
        }
        const Sounding note = {true,     twice,           state_.time,     state_.time + steps,
                               velocity, point(run.from), point(state_.at)};
        state_.time += steps;
        if (is_held) {
            state_.held = note;
        } else {
            emit(note);
        }
    }

    void release_held() {
        if (!state_.held.is_open) return;
        state_.held.is_open = false;
        emit(state_.held);
    }

    void vertical_run(const Pending& run, Number steps, int velocity) {
        switch (melody_.vertical) {
            case Vertical::ignore:
                break;
            case Vertical::rest:
                state_.time += steps;
                break;
            case Vertical::extend:
                if (state_.held.is_open) {
                    state_.held.end += steps;
                    state_.time += steps;
                } else if (!state_.has_sounded) {
                    state_.lead += steps;
                } else {
                    state_.time += steps;
                }
                break;
            case Vertical::glissando:
                glissando(run, velocity);
                break;
            case Vertical::voice: {
                const std::int64_t degree = Walk::degree(2 * state_.at.x);
                emitter_.note(state_.other, degree, ticks(state_.other_time), ticks(state_.other_time + steps),
                              velocity, point(run.from), point(state_.at));
                state_.other_time += steps;
                break;
            }
        }
    }

    /// A note for each height on the way, the last included.
    void glissando(const Pending& run, int velocity) {
        const Number sign = state_.at.y > run.from.y ? 1 : -1;
        Position from = run.from;
        while (from.y * sign < state_.at.y * sign) {
            Position to = from;
            to.y += sign;
            if (to.y * sign > state_.at.y * sign) to.y = state_.at.y;
            const Number steps = (to.y - from.y) * sign;
            emit({true, 2 * to.y, state_.time, state_.time + steps, velocity, point(from), point(to)});
            state_.time += steps;
            from = to;
        }
    }

    /// The branch begins where and when the stem is, which may be within a run.
    void open() {
        if (state_.run.is_open) {
            const Pending& run = state_.run;
            const Number wide = std::abs(state_.at.x - run.from.x);
            const Number high = std::abs(state_.at.y - run.from.y);
            const Number before = state_.time;
            const bool is_note = Walk::is_level(high) || (!Walk::is_level(wide) && melody_.sloped == Sloped::project);
            // What sounds already counts as met before what the branch will play.
            if (is_note) meet(run.from.y + state_.at.y, before + wide);
            stack_.open(state_, position_);
            if (is_note) {
                state_.time += wide;
            } else if (Walk::is_level(wide)) {
                if (melody_.vertical == Vertical::voice) {
                    state_.other_time += high;
                } else if (melody_.vertical != Vertical::ignore) {
                    state_.time += high;
                }
            }
        } else {
            stack_.open(state_, position_);
        }
        state_.time += state_.lead;
        state_.run.is_open = false;
        state_.held.is_open = false;
        state_.line = state_.other = {};
        state_.has_sounded = false;
        state_.lead = 0;
    }

    void close() {
        end_run();
        release_held();
        emitter_.release(state_.line);
        emitter_.release(state_.other);
        state_ = stack_.close(position_);
    }

    const Grammar& grammar_;
    const Melody& melody_;
    Emitter& emitter_;
    Origin origin_;
    const PlayOptions& options_;
    Walk walk_;
    bool may_stop_;
    std::vector<Kind> kinds_;
    State state_;
    Brackets<State> stack_;
    std::vector<Block> blocks_;
    std::uint64_t position_ = 0;
    Number lowest_ = 0;
    Number highest_ = 0;
    std::int64_t first_degree_ = unknown;
    std::int64_t lowest_degree_ = unknown;
};

/// Two voices: one sounds y for as long as it stays, the other x, an octave lower.
template <class Walk>
class CounterpointReader final : public Reader {
public:
    CounterpointReader(const Grammar& grammar, const Lattice& lattice, int first, const Melody& melody,
                       Emitter& emitter, Origin origin, const PlayOptions& options)
        : grammar_(grammar),
          melody_(melody),
          emitter_(emitter),
          options_(options),
          walk_(grammar, lattice, first),
          lower_(static_cast<std::int64_t>(melody.scale.size())),
          is_piece_(melody.anchor == Anchor::piece) {
        at_ = walk_.start;
        voices_[0].origin = origin.y == unknown ? 0 : origin.y;
        emitter_.take(voices_[0].line, 0);
        emitter_.take(voices_[1].line, 1);
    }

    void symbols(const Run& run) override {
        for (const Symbol symbol : run.symbols) {
            ++position_;
            const Command& command = grammar_.symbols()[symbol].command;
            switch (const Kind kind = kind_of(command)) {
                case Kind::draw:
                case Kind::move:
                    advance(walk_.step(at_, symbol), kind == Kind::draw);
                    break;
                case Kind::turn:
                    walk_.turn(at_, symbol);
                    turned_ = sign_of(command.angle);
                    break;
                case Kind::open:
                    stack_.open(at_, position_);
                    break;
                case Kind::close:
                    at_ = stack_.close(position_);
                    break;
                case Kind::not_finite:
                    fault(position_, "its parameter is not finite");
                case Kind::nothing:
                    break;
            }
        }
        if (!Walk::in_range(at_) || time_ >= farthest) {
            throw WordError("the turtle leaves the range of its coordinates");
        }
    }

    void finish() override {
        stack_.require_closed();
        for (Voice& voice : voices_) end_note(voice);
        emitter_.finish(ticks(time_));
    }

    bool skip(const GridStretch& stretch) override {
        if constexpr (std::is_same_v<Walk, GridWalk>) {
            const Integer length = stretch.length[0] + stretch.length[1];
            const std::int64_t room = options_.from / melody_.unit - margin_units - time_;
            if (room < 0 || length > room) return false;
            for (Voice& voice : voices_) end_note(voice);
            walk_.skip(at_, stretch);
            here_ = point();
            time_ += length.convert_to<std::int64_t>();
            return true;
        } else {
            (void)stretch;
            return false;
        }
    }

    std::int64_t lowest_vertex() const override { return Walk::degree(2 * lowest_); }
    std::int64_t highest_vertex() const override { return Walk::degree(2 * highest_); }
    std::int64_t lowest_degree() const override { return lowest_degree_; }

private:
    using Number = typename Walk::Number;
    struct Voice {
        std::int64_t origin = 0;          // doubled
        std::int64_t sounding = unknown;  // its height, in whole steps
        Number onset = 0;
        int turned = 0;
        glm::dvec2 from{0.0};
        Emitter::Line line;
    };

    std::int64_t ticks(Number steps) const { return Walk::ticks(steps, melody_.unit); }
    glm::dvec2 point() const { return {static_cast<double>(at_.x), static_cast<double>(at_.y)}; }

    /// The note that the turtle comes to sounds while it makes this step.
    void advance(const typename Walk::Step& step, bool is_drawn) {
        at_.x += step.x;
        at_.y += step.y;
        lowest_ = std::min(lowest_, at_.y);
        highest_ = std::max(highest_, at_.y);
        const Number length = Walk::length(step);
        if (is_piece_ && ticks(time_ + length) > options_.from) {
            voices_[0].origin = 2 * Walk::degree(2 * at_.y);
            voices_[1].origin = 2 * Walk::degree(2 * at_.x);
            is_piece_ = false;
        }
        for (Voice& voice : voices_) {
            const bool is_upper = &voice == &voices_[0];
            const std::int64_t height = is_drawn ? Walk::degree(2 * (is_upper ? at_.y : at_.x)) : unknown;
            if (height == voice.sounding) continue;
            end_note(voice);
            voice.sounding = height;
            voice.onset = time_;
            voice.turned = turned_;
            // The picture of a note is where its coordinate stays.
            voice.from = Walk::is_level(is_upper ? step.y : step.x) ? here_ : point();
            if (is_drawn && is_upper) {
                lowest_degree_ = std::min(lowest_degree_ == unknown ? farthest : lowest_degree_, height);
            }
        }
        time_ += length;
        here_ = point();
        if (ticks(time_) < options_.to) return;
        for (Voice& voice : voices_) end_note(voice);
        throw Enough();
    }

    void end_note(Voice& voice) {
        if (voice.sounding == unknown) return;
        const bool is_upper = &voice == &voices_[0];
        const int loud = loudness(melody_, voice.turned, static_cast<double>(time_ - voice.onset), stack_.depth(),
                                  ticks(voice.onset));
        emitter_.note(voice.line, voice.sounding - voice.origin / 2 - (is_upper ? 0 : lower_), ticks(voice.onset),
                      ticks(time_), loud + (is_upper ? 8 : -8), voice.from, here_);
        voice.sounding = unknown;
    }

    const Grammar& grammar_;
    const Melody& melody_;
    Emitter& emitter_;
    const PlayOptions& options_;
    Walk walk_;
    std::int64_t lower_;
    bool is_piece_;  ///< its tonic is still to come
    typename Walk::Position at_;
    glm::dvec2 here_{0.0};
    Brackets<typename Walk::Position> stack_;
    std::array<Voice, 2> voices_;
    Number time_ = 0;
    int turned_ = 0;
    std::uint64_t position_ = 0;
    Number lowest_ = 0;
    Number highest_ = 0;
    std::int64_t lowest_degree_ = unknown;
};

/// The word itself, symbol by symbol.
class SymbolReader final : public Reader {
public:
    SymbolReader(const Grammar& grammar, const Melody& melody, Emitter& emitter, const PlayOptions& options,
                 bool has_brackets)
        : grammar_(grammar),
          melody_(melody),
          emitter_(emitter),
          options_(options),
          may_stop_(!has_brackets),
          origin_(melody.anchor == Anchor::piece ? unknown : 0) {
        emitter_.take(state_.line, 0);
    }

    void symbols(const Run& run) override {
        for (const Symbol symbol : run.symbols) {
            ++position_;
            const SymbolInfo& info = grammar_.symbols()[symbol];
            const Command& command = info.command;
            switch (kind_of(command)) {
                case Kind::draw:
                    sound(std::fabs(command.value));
                    break;
                case Kind::move:
                    end_note();
                    state_.time += std::fabs(command.value);
                    stop_if_done();
                    break;
                case Kind::turn:
                    if (info.letter == "+") ++state_.degree;
                    if (info.letter == "-") --state_.degree;
                    state_.turned = sign_of(command.angle);
                    break;
                case Kind::open:
                    // The stem's note goes on through its branches.
                    stack_.open(state_, position_);
                    state_.sounding = unknown;
                    state_.line = {};
                    break;
                case Kind::close:
                    end_note();
                    emitter_.release(state_.line);
                    state_ = stack_.close(position_);
                    break;
                case Kind::not_finite:
                    fault(position_, "its parameter is not finite");
                case Kind::nothing:
                    break;
            }
        }
    }

    void finish() override {
        stack_.require_closed();
        end_note();
        emitter_.finish(ticks(state_.time));
    }

    bool skip(const GridStretch& stretch) override {
        const Integer length = stretch.length[0] + stretch.length[1];
        const double room = static_cast<double>(options_.from / melody_.unit - margin_units) - state_.time;
        if (room < 0 || length > Integer(room) || abs(stretch.rise) >= farthest) return false;
        end_note();
        state_.time += length.convert_to<double>();
        state_.degree += stretch.rise.convert_to<std::int64_t>();
        return true;
    }

private:
    struct State {
        double time = 0;
        double onset = 0;
        std::int64_t degree = 0;
        std::int64_t sounding = unknown;
        int turned = 0;
        Emitter::Line line;
    };

    std::int64_t ticks(double steps) const { return PlaneWalk::ticks(steps, melody_.unit); }

    /// Equal symbols side by side are one long note, unless each step is to be heard.
    void sound(double length) {
        if (state_.sounding != state_.degree || melody_.runs == Runs::each_step) {
            end_note();
            state_.sounding = state_.degree;
            state_.onset = state_.time;
        }
        state_.time += length;
        if (may_stop_ && ticks(state_.time) >= options_.to) end_note();
        stop_if_done();
    }

    void end_note() {
        if (state_.sounding == unknown) return;
        if (origin_ == unknown && ticks(state_.time) > options_.from) origin_ = state_.sounding;
        if (origin_ != unknown) {
            const auto height = static_cast<double>(state_.sounding);
            const int velocity =
                loudness(melody_, state_.turned, state_.time - state_.onset, stack_.depth(), ticks(state_.onset));
            emitter_.note(state_.line, state_.sounding - origin_, ticks(state_.onset), ticks(state_.time), velocity,
                          {state_.onset, height}, {state_.time, height});
        }
        state_.sounding = unknown;
    }

    void stop_if_done() const {
        if (may_stop_ && ticks(state_.time) >= options_.to) throw Enough();
    }

    const Grammar& grammar_;
    const Melody& melody_;
    Emitter& emitter_;
    const PlayOptions& options_;
    bool may_stop_;
    std::int64_t origin_;
    State state_;
    Brackets<State> stack_;
    std::uint64_t position_ = 0;
};

/// Passes over what lies before the piece.
class Seeker final : public Pruner {
public:
    Seeker(const MelodyFold& fold, Reader& reader) : fold_(fold), reader_(reader) {}
    bool passes_over(Symbol symbol, std::int64_t level) override {
        const GridStretch* stretch = fold_.stretch(symbol, level);
        if (stretch && reader_.skip(*stretch)) return true;
        // What is that short is walked: the piece is near.
        if (level == 0 || (stretch && stretch->length[0] + stretch->length[1] < 4096)) active = false;
        return false;
    }

private:
    const MelodyFold& fold_;
    Reader& reader_;
};

/// Everything a reader needs, made ready once.
class Player {
public:
    Player(const Grammar& grammar, const Melody& melody, const PlayOptions& options)
        : grammar_(grammar), melody_(melody), options_(options), lattice_(make_lattice(grammar)) {
        is_grid_ = is_on_grid(lattice_, first_);
        const std::vector<char> reached = grammar.reachable();
        for (Symbol symbol = 0; symbol < reached.size(); ++symbol) {
            if (reached[symbol] && grammar.is_push(symbol)) has_brackets_ = true;
        }
        const bool has_anchor = melody.anchor != Anchor::first_note && melody.anchor != Anchor::piece;
        const bool is_anchored = melody.mapping == Mapping::runs && has_anchor;
        if (options.from > 0 || is_anchored) fold_ = MelodyFold::make(grammar);
    }

    PlayReport play(NoteSink& sink) {
        const Origin origin = find_origin();
        Emitter emitter(melody_, sink, options_);
        const auto reader = make_reader(melody_, emitter, origin, options_);
        DerivationOptions derivation = derivation_options();
        std::optional<Seeker> seeker;
        if (fold_ && options_.from > 0) {
            seeker.emplace(*fold_, *reader);
            derivation.pruner = &*seeker;
        }
        // A piece may be short where the whole is beyond all measure.
        const bool is_piece = !has_brackets_ && options_.to < INT64_MAX;
        const bool is_long =
            static_cast<double>(options_.to - options_.from) > options_.budget * static_cast<double>(melody_.unit);
        if (!is_piece || is_long) require_affordable(grammar_, true, options_.budget);
        try {
            derive(grammar_, *reader, derivation);
        } catch (const Enough&) {
            emitter.finish(options_.to);
        }
        return emitter.report;
    }

private:
    DerivationOptions derivation_options() const {
        DerivationOptions derivation;
        derivation.interpreted = true;
        derivation.watch = [this, visited = 0.0](std::uint64_t symbols) mutable {
            // Where nothing is handed over, watches come every 2^16 nodes.
            visited += symbols > 0 ? static_cast<double>(symbols) : 65536.0;
            if (visited > 2 * options_.budget) {
                throw BudgetError(fmt::format(
                    "the piece lies too far inside: more than {:.0f} nodes would be visited to reach its end",
                    options_.budget));
            }
            if (options_.watch) options_.watch(symbols);
        };
        return derivation;
    }

    std::unique_ptr<Reader> make_reader(const Melody& melody, Emitter& emitter, Origin origin,
                                        const PlayOptions& options) const {
        if (melody.mapping == Mapping::symbols) {
            return std::make_unique<SymbolReader>(grammar_, melody, emitter, options, has_brackets_);
        }
        const auto make = [&]<class Walk>() -> std::unique_ptr<Reader> {
            if (melody.mapping == Mapping::counterpoint) {
                return std::make_unique<CounterpointReader<Walk>>(grammar_, lattice_, first_, melody, emitter, origin,
                                                                  options);
            }
            return std::make_unique<RunReader<Walk>>(grammar_, lattice_, first_, melody, emitter, origin, options,
                                                     has_brackets_);
        };
        return is_grid_ ? make.template operator()<GridWalk>() : make.template operator()<PlaneWalk>();
    }

    /// The y that sounds the tonic. The first note is met on the way; but a piece from the middle has to know it.
    Origin find_origin() const {
        if (melody_.mapping == Mapping::symbols || melody_.anchor == Anchor::piece) return {};
        if (melody_.anchor == Anchor::first_note) {
            if (options_.from == 0 || melody_.mapping == Mapping::counterpoint) return {};
            return {first_note()};
        }
        if (fold_ && melody_.mapping == Mapping::runs) {
            const GridStretch& whole = fold_->whole();
            const auto number = [](const Integer& value) {
                if (value >= farthest / 2 || value <= -farthest / 2) {
                    throw ScoreError("the curve is too large for its anchor: a smaller n is needed");
                }
                return value.convert_to<std::int64_t>();
            };
            if (melody_.anchor == Anchor::lowest_note) {
                return {whole.crossings[0] ? 2 * number(whole.crossings[0]->low) : 0};
            }
            if (melody_.anchor == Anchor::lowest_vertex) return {2 * number(whole.box[1].low)};
            return {2 * number((whole.box[1].low + whole.box[1].high) >> 1)};
        }
        return survey();
    }

    /// The sink of a pass that only looks.
    class Nobody : public NoteSink {
    public:
        void notes(std::span<const Note>) override {}
        void finish(std::int64_t) override {}
    };

    Origin survey() const {
        require_affordable(grammar_, true, options_.budget);
        PlayOptions all = options_;
        all.from = 0;
        all.to = INT64_MAX;
        all.most_voices = std::numeric_limits<int>::max();
        Melody silent = melody_;
        silent.range = Range::clamp;
        Nobody nobody;
        Emitter emitter(silent, nobody, all);
        const auto reader = make_reader(silent, emitter, {0}, all);
        derive(grammar_, *reader, derivation_options());
        switch (melody_.anchor) {
            case Anchor::lowest_note:
                return {reader->lowest_degree() == unknown ? 0 : 2 * reader->lowest_degree()};
            case Anchor::lowest_vertex:
                return {2 * reader->lowest_vertex()};
            default: {
                const std::int64_t sum = reader->lowest_vertex() + reader->highest_vertex();
                return {2 * (sum >= 0 ? sum / 2 : -((1 - sum) / 2))};
            }
        }
    }

    std::int64_t first_note() const {
        PlayOptions beginning = options_;
        beginning.from = 0;
        beginning.to = INT64_MAX;
        Melody silent = melody_;
        silent.range = Range::clamp;
        Nobody nobody;
        Emitter emitter(silent, nobody, beginning);
        const auto reader = make_reader(silent, emitter, {0}, beginning);
        reader->seeks_first_note = true;
        try {
            derive(grammar_, *reader, derivation_options());
        } catch (const Enough&) {
        }
        return reader->first_degree() == unknown ? 0 : 2 * reader->first_degree();
    }

    const Grammar& grammar_;
    const Melody& melody_;
    const PlayOptions& options_;
    Lattice lattice_;
    bool is_grid_ = false;
    int first_ = 0;
    bool has_brackets_ = false;
    std::optional<MelodyFold> fold_;
};

}  // namespace

PlayReport play(const Grammar& given, const Melody& melody, NoteSink& sink, const PlayOptions& options) {
    DerivationOptions whole_words;
    whole_words.limit_whole_words(options.budget);
    whole_words.watch = options.watch;
    Grammar grammar = resolve_contexts(shorten(given), whole_words);
    if (!grammar.is_plain()) grammar = write_out(grammar, whole_words);
    return Player(grammar, melody, options).play(sink);
}

std::optional<MelodyCensus> census(const Grammar& given, const Melody& melody) {
    if (melody.mapping != Mapping::runs || !given.is_plain() || given.whole_word_steps() > 0) return std::nullopt;
    const Grammar grammar = shorten(given);
    const auto fold = MelodyFold::make(grammar);
    if (!fold) return std::nullopt;
    const GridStretch& whole = fold->whole();
    MelodyCensus result;
    const auto notes_along = [&](std::size_t axis) {
        return melody.runs == Runs::each_step ? whole.steps[axis] : whole.runs[axis];
    };
    result.notes = notes_along(0);
    Integer steps = whole.length[0];
    if (melody.vertical == Vertical::glissando) result.notes += whole.drawn[1];
    if (melody.vertical == Vertical::voice) {
        result.notes += notes_along(1);
        steps = std::max(steps, whole.length[1]);
    } else if (melody.vertical != Vertical::ignore) {
        steps += whole.length[1];
    }
    result.ticks = steps * melody.unit;
    if (whole.crossings[0]) {
        result.height = whole.crossings[0]->high - whole.crossings[0]->low;
    }
    return result;
}

}  // namespace sikku
