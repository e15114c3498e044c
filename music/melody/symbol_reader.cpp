#include "music/melody/melody_fold.h"
#include "music/melody/reader.h"
#include "music/melody/symbol_table.h"
#include "music/score/dynamics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sikku::mapping {
namespace {

/// Reads the word itself, symbol by symbol.
class SymbolReader final : public TimedReader<PlaneWalk> {
public:
    SymbolReader(const Reading& reading, std::vector<SymbolEntry> entries)
        : TimedReader(reading, entries.empty() && draws_nothing(reading.grammar)),
          level_(marks_.whole),
          entries_(std::move(entries)),
          origin_(melody_.anchor == Anchor::piece && entries_.empty() ? unknown : 0) {
        skipped_.assign(grammar_.symbols().size(), 0);
        emitter_.take(state_.line, 0);
    }

    void symbols(const Run& run) override {
        for (const Symbol symbol : run.symbols) {
            const Kind kind = kinds_[symbol];
            const bool is_mark = kind == Kind::mark || kind == Kind::level;
            if (!is_mark) ++position_;
            if (!is_mark && !entries_.empty() && entries_[symbol].has_row) {
                read_entry(entries_[symbol]);
                continue;
            }
            const SymbolInfo& info = grammar_.symbols()[symbol];
            const Command& command = info.command;
            switch (kind) {
                case Kind::mark:
                    ++due_;
                    break;
                case Kind::level:
                    level_ = std::max(level_, marks_.level(symbol));
                    end_level(marks_.level(symbol));
                    break;
                case Kind::draw:
                    sound(std::fabs(command.value));
                    break;
                case Kind::move:
                    end_note();
                    end_phrases();
                    state_.time += std::fabs(command.value) * state_.pace;
                    end_ = 0;
                    stop_if_done();
                    break;
                case Kind::turn:
                    state_.degree += rise_of(info);
                    if ((!info.arguments.empty() && !counts_degrees(info)) || info.arity > 0) ++skipped_[symbol];
                    state_.turned = sign_of(command.angle);
                    break;
                case Kind::open:
                    if (melody_.branches != Branches::voices) {
                        open_in_line();
                        break;
                    }
                    // The stem's note continues through its branches.
                    stack_.open(state_, position_);
                    state_.sounding = unknown;
                    state_.line = {};
                    break;
                case Kind::close:
                    end_note();
                    if (melody_.branches != Branches::voices) {
                        close_in_line();
                        break;
                    }
                    emitter_.release(state_.line);
                    state_ = stack_.close(position_);
                    break;
                case Kind::not_finite:
                    fault(position_, "its parameter is not finite");
                case Kind::nothing:
                    ++skipped_[symbol];
                    break;
            }
        }
    }

    void report_skipped(PlayReport& report) const override {
        for (std::size_t symbol = 0; symbol < skipped_.size(); ++symbol) {
            if (skipped_[symbol] == 0) continue;
            const SymbolInfo& info = grammar_.symbols()[symbol];
            const bool is_turn = kinds_[symbol] == Kind::turn;
            report.skipped[is_turn ? "parameter of " + info.letter : info.letter] += skipped_[symbol];
        }
        if (!entries_.empty()) report.unused = unused_rows(grammar_, melody_.table);
    }

    void finish() override {
        stack_.require_closed();
        const int due = std::exchange(due_, 0);  // the end closes the last phrase
        end_note();
        const std::int64_t last = end_ > 0 ? end_ : ticks(state_.time);
        finish_at(state_.time, last, due);
    }

    bool skip(const GridStretch& stretch) override {
        const Integer length = stretch.length[0] + stretch.length[1];
        const std::int64_t units = clock_.steps_before(options_.from, stretch.marks + due_) - margin_units;
        const double room = static_cast<double>(units) - state_.time;
        if (room < 0 || length > Integer(room) || abs(stretch.rise) >= farthest) return false;
        end_note();
        end_phrases();
        clock_.breathe(stretch.marks, state_.time);
        is_counted_ = false;
        emitter_.skip();
        level_ = 0;  // known from the mark after the stretch
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
        std::uint64_t symbol = 0;
        int begun = 0;  // level of the sounding note
        Emitter::Line line;
        int louder = 0;           // added to velocities
        int level = 0;            // velocity of notes that state none; 0: that of the melody
        bool is_dynamic = false;  // the level is stated as a dynamic
        std::int64_t octave = 0;
        double pace = 1;         // duration of a step, with `brackets: shares`
        std::size_t opened = 0;  // number of the bracket around it, likewise
    };

    /// Reads a symbol of the table.
    void read_entry(const SymbolEntry& entry) {
        if (!entry.problem.empty()) fault(position_, fmt::format("{}, of '{}'", entry.problem, entry.row.symbol));
        const SymbolRow& row = entry.row;
        if (row.kind == SymbolRow::Kind::change) return change(row);
        end_note();
        end_phrases();
        const double onset = state_.time;
        state_.time += row.steps * state_.pace;
        end_ = 0;
        if (row.is_sounding()) sound_row(row, onset);
        stop_if_done();
    }

    void change(const SymbolRow& row) {
        const auto amount = std::llround(row.amount);
        switch (row.change) {
            case SoundChange::velocity:
                state_.louder = static_cast<int>(std::clamp<std::int64_t>(state_.louder + amount, -127, 127));
                break;
            case SoundChange::level:
                state_.level = static_cast<int>(amount);
                state_.is_dynamic = row.is_dynamic;
                break;
            case SoundChange::octave:
                state_.octave += amount;
                break;
            case SoundChange::degree:
                state_.degree += amount;
                break;
        }
    }

    /// Plays the notes of a row: the first in the voice of the branch, others in free voices.
    void sound_row(const SymbolRow& row, double onset) {
        begin_note();
        const double steps = state_.time - onset;
        int velocity = row.velocity > 0   ? row.velocity
                       : state_.level > 0 ? state_.level
                                          : loudness(melody_, state_.turned, steps, stack_.depth(), ticks(onset));
        velocity += state_.louder;
        emitter_.emphasis = {clock_.stress(onset), stated_dynamic(row, velocity)};
        emitter_.depth = static_cast<int>(stack_.depth());
        emitter_.level = std::exchange(level_, 0);
        std::vector<Emitter::Line> others(row.pitches.size() - 1);
        for (std::size_t i = 0; i < row.pitches.size(); ++i) {
            Shaper::Draft draft = row.is_drum() ? drum(row.pitches[i]) : pitched(row.pitches[i]);
            draft.is_silent = !sounds(onset);
            const double height = row.is_drum() ? (*row.pitches[i].key - 60) / 2 : static_cast<double>(draft.degree);
            draft.onset = ticks(onset);
            draft.end = clock_.end_ticks(state_.time);
            draft.velocity = velocity;
            draft.from = {onset, height};
            draft.to = {state_.time, height};
            draft.symbol = counted(position_);
            draft.chord = sign_of_row(row);
            emitter_.table_note(i == 0 ? state_.line : others[i - 1], draft);
        }
        for (const Emitter::Line& line : others) emitter_.release(line);
    }

    /// The dynamic that the row or the last change states, moved by changes after it.
    std::int8_t stated_dynamic(const SymbolRow& row, int velocity) const {
        const bool is_stated = row.velocity > 0 ? row.is_dynamic : state_.level > 0 && state_.is_dynamic;
        return static_cast<std::int8_t>(is_stated ? dynamic_level(velocity) : -1);
    }

    /// The sign of a chord, with a name if it sounds as it is named.
    ChordSign sign_of_row(const SymbolRow& row) const {
        const bool is_moved = state_.degree != 0 || melody_.shift != 0 || melody_.answer != 0 || melody_.is_inverted;
        if (row.kind != SymbolRow::Kind::chord) return {};
        if (!row.named || is_moved) return {ChordSign::without_name, 0, -1};
        return sign_of(*row.named, melody_.tonic + melody_.transpose);
    }

    static Shaper::Draft drum(const TablePitch& pitch) {
        Shaper::Draft draft;
        draft.key = *pitch.key;
        draft.is_drum = true;
        return draft;
    }

    /// The draft of a pitch: degrees are moved like notes, keys by as many semitones as the degree nearest to them.
    Shaper::Draft pitched(const TablePitch& pitch) const {
        const auto period = static_cast<std::int64_t>(melody_.scale.size());
        const auto rise = [&](std::int64_t from, std::int64_t to) {
            const auto low = melody_.key(from, false);
            const auto high = melody_.key(to, false);
            return low && high ? *high - *low : 0.0;
        };
        const std::int64_t sounding = pitch.degree + state_.degree;
        const std::int64_t upright = sounding + state_.octave * period;
        const std::int64_t turned = melody_.is_inverted ? -upright : upright;
        Shaper::Draft draft;
        draft.degree = turned + melody_.shift;
        if (!pitch.key) return draft;
        double key = *pitch.key + melody_.transpose + rise(pitch.degree, sounding) +
                     static_cast<double>(state_.octave) * melody_.scale.period / 100;
        if (melody_.is_inverted) key = 2 * (melody_.tonic + melody_.transpose) - key;
        draft.key = key + rise(turned, draft.degree + melody_.answer);
        return draft;
    }

    /// Opens a branch that follows in the same line: the note ends, and time continues.
    void open_in_line() {
        end_note();
        stack_.open(state_, position_);
        emitter_.depth = static_cast<int>(stack_.depth());
        if (spans) state_.pace = share_of(state_.pace, state_.opened);
    }

    void close_in_line() {
        const State branch = state_;
        state_ = stack_.close(position_);
        emitter_.depth = static_cast<int>(stack_.depth());
        state_.line = branch.line;
        state_.time =
            spans ? state_.time + shared_span(state_.pace, state_.time, branch.time, branch.opened) : branch.time;
    }

    void end_phrases() {
        if (due_ == 0) return;
        end_ = ticks(state_.time);
        TimedReader::end_phrases(1, state_.time);
    }

    /// Sounds a step. Adjacent steps of one degree form a long note, unless each step is to be heard.
    void sound(double length) {
        if (state_.sounding != state_.degree || melody_.runs == Runs::each_step) {
            end_note();
            end_phrases();
            begin_note();
            state_.sounding = state_.degree;
            state_.onset = state_.time;
            state_.symbol = counted(position_);
            state_.begun = std::exchange(level_, 0);
        }
        state_.time += length * state_.pace;
        end_ = 0;
        if (may_stop_ && !emitter_.is_shaped() && ticks(state_.time) >= options_.to) end_note();
        stop_if_done();
    }

    void end_note() {
        if (state_.sounding == unknown) return;
        if (origin_ == unknown && ticks(state_.time) > options_.from) origin_ = state_.sounding;
        if (origin_ != unknown) {
            const auto height = static_cast<double>(state_.sounding);
            const int velocity =
                loudness(melody_, state_.turned, state_.time - state_.onset, stack_.depth(), ticks(state_.onset));
            if (melody_.branches == Branches::voices) emitter_.depth = static_cast<int>(stack_.depth());
            const Sound sound{velocity, state_.begun, {state_.onset, height}, {state_.time, height}, state_.symbol};
            emitter_.note(state_.line, draft_of(state_.sounding - origin_, state_.onset, state_.time, sound));
        }
        state_.sounding = unknown;
        end_phrases();
    }

    void stop_if_done() const {
        if (!may_stop_ || ticks(state_.time) < options_.to) return;
        const bool is_held = state_.sounding != unknown && ticks(state_.onset) < options_.to;
        if (emitter_.is_shaped() && (is_held || !emitter_.may_stop(ticks(state_.time)))) return;
        throw Enough();
    }

    std::int64_t end_ = 0;                // end of the phrase that has just ended
    int level_;                           // level of the next note
    std::vector<SymbolEntry> entries_;    // by symbol; empty without a table
    std::vector<std::uint64_t> skipped_;  // by symbol; turns count if their parameter has no effect
    std::int64_t origin_;
    State state_;
    Brackets<State> stack_;
};

}  // namespace

std::unique_ptr<Reader> read_symbols(const Reading& reading) {
    return std::make_unique<SymbolReader>(reading, entries_of(reading.grammar, reading.melody));
}

}  // namespace sikku::mapping
