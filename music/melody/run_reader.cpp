#include "music/melody/reader.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <type_traits>

namespace sikku::mapping {
namespace {

/// Reads the straight runs of a curve as notes.
template <class Walk>
class RunReader final : public CurveReader<Walk> {
    using Base = CurveReader<Walk>;
    using Base::clock_, Base::due_, Base::emitter_, Base::grammar_, Base::is_counted_, Base::kinds_, Base::marks_;
    using Base::may_stop_, Base::melody_, Base::options_, Base::position_, Base::walk_;
    using Base::ticks, Base::point, Base::advance, Base::note_vertex, Base::note_degree;
    using typename Base::Number, typename Base::Position, typename Base::Step;

public:
    explicit RunReader(const Reading& reading)
        : Base(reading), origin_(reading.origin), levels_{marks_.whole, marks_.whole}, ahead_(options_.ahead) {
        state_.at = walk_.start;
        state_.run.from = state_.at;
        emitter_.take(state_.line, 0);
        if (melody_.vertical == Vertical::voice) emitter_.take(state_.other, 1);
    }

    void symbols(const Run& run) override {
        if constexpr (std::is_same_v<Walk, GridWalk>) {
            if (run.block >= 0 && play_block(run)) return;
        }
        for (const Symbol symbol : run.symbols) {
            ++position_;
            switch (kinds_[symbol]) {
                case Kind::draw:
                    draw(walk_.step(state_.at, symbol), position_);
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
                case Kind::mark:
                    --position_;
                    mark();
                    break;
                case Kind::level:
                    --position_;
                    mark_level(marks_.level(symbol));
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
        const Number end = std::max(state_.time, state_.other_time);
        const std::int64_t last = ticks(end);
        this->finish_at(end, last, due_);
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
            const Integer phrases = stretch.marks + due_ + state_.run.marks;
            if (!has_room(longest, phrases)) return false;
            end_run();
            release_held();
            end_phrases();
            is_counted_ = false;
            levels_ = {};  // known from the mark after the stretch
            walk_.skip(state_.at, stretch);
            emitter_.skip();
            state_.time = clock_.skip(state_.time, both ? Integer(across + up) : across, stretch.marks, ahead_);
            if (melody_.vertical == Vertical::voice) state_.other_time += up.convert_to<std::int64_t>();
            state_.has_sounded = true;
            return true;
        } else {
            (void)stretch;
            return false;
        }
    }

    std::int64_t first_degree() const override { return first_degree_; }

private:
    static constexpr std::int64_t counted_in_skips = std::int64_t{1} << 48;  // ticks, far before the piece

    struct Pending {
        bool is_open = false;
        Step direction{};
        Position from;
        Number steps = 0;  // drawn so far: their number times their length
        int turned = 0;    // sign of the turn that led into it
        int marks = 0;     // phrases that end with it
        int level = 0;     // order of the largest sub-curve that ends with it
        std::uint64_t symbol = 0;
    };
    struct Sounding {
        bool is_open = false;
        Number twice = 0;  // its height, doubled
        Number onset = 0, end = 0;
        int velocity = 80;
        glm::dvec2 from{0.0}, to{0.0};
        std::uint64_t symbol = 0;
        int level = 0;
        Number glide = 0;       // steps at its end in which it slides
        Number goal_twice = 0;  // to this height, doubled
        Number rise = 0;
    };
    struct State {
        Position at;
        Pending run;
        Emitter::Line line;
        Emitter::Line other;  // voice of vertical runs
        Number time = 0;      // steps
        Number other_time = 0;
        Sounding held;    // a note that the next run may make longer
        Number lead = 0;  // vertical steps before the first note
        bool has_sounded = false;
        double pace = 1;         // duration of a step, with `brackets: shares`
        std::size_t opened = 0;  // number of the bracket around it, likewise
    };
    /// Length of a run in steps: its width; with a rhythm off the square grid its actual length, so that each step
    /// takes a note of the template at any angle.
    Number steps_of(Number wide, Number high) const {
        if constexpr (std::is_floating_point_v<Number>) {
            if (!melody_.rhythm.empty() && step_length_ > 0) return std::hypot(wide, high) / step_length_;
        }
        return Walk::is_level(wide) ? high : wide;
    }
    /// Duration of `steps`, in steps of the stem.
    Number lasting(Number steps) const {
        if constexpr (std::is_floating_point_v<Number>) {
            return steps * state_.pace;
        } else {
            return steps;
        }
    }

    /// True if a part lies before the piece, with some margin; it may reach a little beyond `ahead_`.
    bool has_room(const Integer& steps, const Integer& phrases) const {
        if (ahead_ > 0) return clock_.longest(steps, phrases) <= ahead_ + counted_in_skips;
        const std::int64_t room =
            clock_.steps_before(options_.from, phrases) - margin_units - std::max(state_.time, state_.other_time);
        return room >= 0 && steps <= room;
    }

    /// A recurring part of the word as straight runs.
    struct Block {
        struct Straight {
            std::uint32_t turn;  ///< quarter turns before it
            std::int64_t length;
            std::uint64_t symbol;  ///< symbol of the block that begins it, counted from 1
            int marks;             ///< phrases that end with it
            int level;             ///< order of the largest sub-curve that ends with it
        };
        std::vector<Straight> runs;
        std::uint32_t turn = 0;     ///< quarter turns after the last
        int marks = 0;              ///< phrases that end before the first
        int level = 0;              ///< order of the largest sub-curve that ends before the first
        std::uint64_t symbols = 0;  ///< number of symbols without marks
        bool is_known = false;
        bool is_simple = false;  ///< contains only drawn steps and turns
    };

    /// Plays a block; false if it must be read symbol by symbol.
    bool play_block(const Run& run) {
        const auto number = static_cast<std::size_t>(run.block);
        if (number >= blocks_.size()) blocks_.resize(number + 1);
        Block& block = blocks_[number];
        if (!block.is_known) learn(block, run.symbols);
        if (!block.is_simple) return false;
        for (int i = 0; i < block.marks; ++i) mark();
        mark_level(block.level);
        for (const auto& [turn, length, symbol, marks, level] : block.runs) {
            state_.at.heading = (state_.at.heading + turn) & 3;
            draw(walk_.ahead(state_.at, length), position_ + symbol);
            for (int i = 0; i < marks; ++i) mark();
            mark_level(level);
        }
        position_ += block.symbols;
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
        std::uint64_t position = 0;
        for (const Symbol symbol : symbols) {
            if (kinds_[symbol] == Kind::mark) {
                ++(block.runs.empty() ? block.marks : block.runs.back().marks);
                continue;
            }
            if (kinds_[symbol] == Kind::level) {
                int& level = block.runs.empty() ? block.level : block.runs.back().level;
                level = std::max(level, marks_.level(symbol));
                continue;
            }
            ++position;
            if (kinds_[symbol] == Kind::turn) {
                block.turn = (block.turn + walk_.quarters(symbol)) & 3;
            } else if (kinds_[symbol] == Kind::draw) {
                const std::int64_t length = walk_.steps(symbol);
                const bool goes_on = block.turn == 0 && !block.runs.empty() && melody_.runs == Runs::merged &&
                                     length > 0 && block.runs.back().length > 0;
                if (goes_on) {
                    block.runs.back().length += length;
                } else {
                    block.runs.push_back({block.turn, length, position, 0, 0});
                }
                block.turn = 0;
            } else if (kinds_[symbol] != Kind::nothing) {
                return;
            }
        }
        block.symbols = position;
        block.is_simple = true;
    }

    /// @param symbol  position in the word
    void draw(const Step& step, std::uint64_t symbol) {
        if (step.x == 0 && step.y == 0) return;
        if (step_length_ == 0) step_length_ = Walk::length(step);
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
            run.marks = 0;
            run.level = 0;
            run.symbol = this->counted(symbol);
        }
        advance(state_.at, step);
    }

    void move(Symbol symbol) {
        end_run();
        const Step step = walk_.step(state_.at, symbol);
        advance(state_.at, step);
        note_vertex(state_.at);
        const Number wide = step.x < 0 ? -step.x : step.x;
        const Number high = step.y < 0 ? -step.y : step.y;
        const bool lasts =
            !Walk::is_level(step.x) || (melody_.vertical != Vertical::ignore && melody_.vertical != Vertical::voice);
        release_held();
        if (lasts) state_.time += lasting(steps_of(wide, high));
        if (melody_.vertical == Vertical::voice) state_.other_time += lasting(high);
    }

    /// Ends a sub-curve: the phrase ends with the current run, or with the last note.
    void mark() { ++(state_.run.is_open ? state_.run.marks : due_); }

    /// Ends a sub-curve of that order: the next note begins one of the same order.
    void mark_level(int order) {
        if (state_.run.is_open) {
            state_.run.level = std::max(state_.run.level, order);
            return;
        }
        this->end_level(order);
        for (int& level : levels_) level = std::max(level, order);
    }

    void end_phrases() {
        if (due_ == 0) return;
        const Number now = std::max(state_.time, state_.other_time);
        Base::end_phrases(melody_.vertical == Vertical::voice ? 2 : 1, now);
        // Two voices begin together.
        if (melody_.restarts_rhythm()) state_.time = state_.other_time = now;
    }

    /// True if no note of the piece is held back.
    bool is_past_piece() const {
        const bool is_held = state_.held.is_open && ticks(state_.held.onset) < options_.to;
        // The next note determines where the last one slides.
        if (!emitter_.is_shaped()) return !is_held || melody_.vertical != Vertical::glissando;
        return !is_held && emitter_.may_stop(ticks(state_.time));
    }

    void end_run() {
        Pending& run = state_.run;
        if (!run.is_open) return;
        run.is_open = false;
        note_vertex(state_.at);
        const Number wide = state_.at.x > run.from.x ? state_.at.x - run.from.x : run.from.x - state_.at.x;
        const Number high = state_.at.y > run.from.y ? state_.at.y - run.from.y : run.from.y - state_.at.y;
        const int velocity = loudness(melody_, run.turned, static_cast<double>(wide > high ? wide : high),
                                      stack_.depth(), ticks(state_.time));
        if (Walk::is_level(high)) {
            sound(run.from.y + state_.at.y, steps_of(wide, high), velocity, run);
        } else if (Walk::is_level(wide)) {
            vertical_run(run, steps_of(wide, high), velocity);
        } else if (melody_.sloped == Sloped::project) {
            sound(run.from.y + state_.at.y, steps_of(wide, high), velocity, run);
        } else if (melody_.sloped == Sloped::refuse) {
            throw ScoreError(fmt::format(
                "before symbol {} of the word the curve slopes, and `sloped: refuse` is asked for", position_));
        }
        due_ += run.marks;
        run.marks = 0;
        mark_level(std::exchange(run.level, 0));
        if (may_stop_ && ticks(state_.time) >= options_.to && is_past_piece() &&
            (melody_.vertical != Vertical::voice || ticks(state_.other_time) >= options_.to)) {
            release_held();
            throw Enough();
        }
    }

    /// Registers a note at the height `twice` / 2: the first one sounds the tonic, depending on the anchor.
    void meet(Number twice, Number end) {
        if (melody_.anchor == Anchor::piece && clock_.end_ticks(end) <= options_.from) return;
        if (first_degree_ == unknown) first_degree_ = Walk::degree(twice);
        if (origin_.y == unknown) origin_.y = 2 * Walk::degree(twice);
        if (this->seeks_first_note) throw Enough();
    }

    void emit(const Sounding& note) {
        meet(note.twice, note.end);
        if (origin_.y == unknown) return;  // before the piece
        if (melody_.branches == Branches::voices) emitter_.depth = static_cast<int>(stack_.depth());
        const auto origin = static_cast<Number>(origin_.y);
        Shaper::Draft draft = this->draft_of(Walk::degree(note.twice - origin), note.onset, note.end,
                                             {note.velocity, note.level, note.from, note.to, note.symbol});
        if (note.glide <= 0) return emitter_.note(state_.line, draft);
        draft.goal = Walk::degree(note.goal_twice - origin);
        draft.glide = std::max<std::int64_t>(0, draft.end - ticks(note.end - note.glide));
        draft.rise = static_cast<float>(note.rise);
        emitter_.gliding_note(state_.line, draft);
    }

    void sound(Number twice, Number steps, int velocity, const Pending& run) {
        if (due_ > 0) {
            release_held();
            end_phrases();
        }
        this->begin_note();
        steps = lasting(steps);
        const bool may_slide = melody_.vertical == Vertical::glissando;
        if (may_slide) release_held();
        meet(twice, state_.time + steps);
        note_degree(Walk::degree(twice));
        const bool is_held = melody_.vertical == Vertical::extend || may_slide;
        if (is_held) {
            release_held();
            steps += state_.lead;
            state_.lead = 0;
            state_.has_sounded = true;
        }
        Sounding note;
        note.is_open = true;
        note.twice = twice;
        note.onset = state_.time;
        note.end = state_.time + steps;
        note.velocity = velocity;
        note.from = point(run.from);
        note.to = point(state_.at);
        note.symbol = run.symbol;
        note.level = std::exchange(levels_[0], 0);
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
                state_.time += lasting(steps);
                break;
            case Vertical::extend:
                steps = lasting(steps);
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
                glissando(run, lasting(steps), velocity);
                break;
            case Vertical::voice: {
                steps = lasting(steps);
                const std::int64_t degree = Walk::degree(2 * state_.at.x);
                end_phrases();
                this->begin_note();
                const Sound sound{velocity, std::exchange(levels_[1], 0), point(run.from), point(state_.at),
                                  run.symbol};
                emitter_.note(state_.other,
                              this->draft_of(degree, state_.other_time, state_.other_time + steps, sound));
                state_.other_time += steps;
                break;
            }
        }
    }

    /// Extends the note before a vertical run, and slides it to the end of the run. A run without a note before
    /// it, or one that turns back, is a note of its own.
    void glissando(const Pending& run, Number steps, int velocity) {
        Sounding& held = state_.held;
        const Number rise = state_.at.y - run.from.y;
        const bool goes_on = held.is_open && due_ == 0 && held.end == state_.time && held.rise * rise >= 0;
        if (!goes_on) {
            release_held();
            end_phrases();
            this->begin_note();
            held = {};
            held.is_open = true;
            held.twice = 2 * run.from.y;
            held.onset = held.end = state_.time;
            held.velocity = velocity;
            held.from = held.to = point(run.from);
            held.symbol = run.symbol;
            held.level = std::exchange(levels_[0], 0);
        }
        held.end += steps;
        held.glide += steps;
        held.goal_twice = 2 * state_.at.y;
        held.rise += rise;
        state_.time = held.end;
    }

    /// Opens a branch at the position and time of the stem, which may be within a run.
    void open() {
        if (melody_.branches != Branches::voices) return open_in_line();
        if (state_.run.is_open) {
            const Pending& run = state_.run;
            const Number wide = std::abs(state_.at.x - run.from.x);
            const Number high = std::abs(state_.at.y - run.from.y);
            const Number before = state_.time;
            const bool is_note = Walk::is_level(high) || (!Walk::is_level(wide) && melody_.sloped == Sloped::project);
            // The sounding note is registered before those of the branch.
            const Number steps = steps_of(wide, high);
            if (is_note) meet(run.from.y + state_.at.y, before + steps);
            stack_.open(state_, position_);
            if (is_note) {
                state_.time += steps;
            } else if (Walk::is_level(wide)) {
                if (melody_.vertical == Vertical::voice) {
                    state_.other_time += steps;
                } else if (melody_.vertical != Vertical::ignore) {
                    state_.time += steps;
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

    /// Opens a branch that follows in the same line: the note ends, and time continues.
    void open_in_line() {
        end_run();
        release_held();
        stack_.open(state_, position_);
        emitter_.depth = static_cast<int>(stack_.depth());
        if constexpr (std::is_floating_point_v<Number>) {
            if (this->spans) state_.pace = this->share_of(state_.pace, state_.opened);
        }
    }

    void close_in_line() {
        end_run();
        release_held();
        const State branch = state_;
        state_ = stack_.close(position_);
        emitter_.depth = static_cast<int>(stack_.depth());
        state_.line = branch.line;
        state_.other = branch.other;
        state_.has_sounded = state_.has_sounded || branch.has_sounded;
        state_.lead = branch.lead;
        if constexpr (std::is_floating_point_v<Number>) {
            if (this->spans) {
                const double span = this->shared_span(state_.pace, std::max(state_.time, state_.other_time),
                                                      std::max(branch.time, branch.other_time), branch.opened);
                state_.time += span;
                state_.other_time += span;
                return;
            }
        }
        state_.time = branch.time;
        state_.other_time = branch.other_time;
    }

    void close() {
        if (melody_.branches != Branches::voices) return close_in_line();
        end_run();
        release_held();
        emitter_.release(state_.line);
        emitter_.release(state_.other);
        state_ = stack_.close(position_);
    }

    Origin origin_;
    std::array<int, 2> levels_;  // level of the next note of each voice
    Integer ahead_;              // ticks before tick 0 that are still to be skipped
    State state_;
    Brackets<State> stack_;
    std::vector<Block> blocks_;
    Number step_length_ = 0;  // length of the first step drawn
    std::int64_t first_degree_ = unknown;
};

}  // namespace

std::unique_ptr<Reader> read_runs(const Reading& reading) {
    if (reading.is_on_grid) return std::make_unique<RunReader<GridWalk>>(reading);
    return std::make_unique<RunReader<PlaneWalk>>(reading);
}

}  // namespace sikku::mapping
