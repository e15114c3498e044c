// music/melody/reader.h: the common base of the readers of words.
#pragma once

#include "music/melody/clock.h"
#include "music/melody/emitter.h"
#include "music/melody/walks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace sikku::mapping {

constexpr std::int64_t margin_units = 64;  // walked before the piece, so that its context is known
constexpr std::size_t deepest = std::size_t{1} << 20;

/// Thrown at the end of the piece, as the rest of the word does not matter.
struct Enough {};

[[noreturn]] inline void fault(std::uint64_t position, std::string_view what) {
    throw WordError(fmt::format("symbol {} of the word: {}", position, what));
}

/// States kept between '[' and ']'.
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
/// @param turned  sign of the turn before it: louder after a turn to the left
/// @param steps   its duration
/// @param depth   number of brackets around it: softer with each
int loudness(const Melody& melody, int turned, double steps, std::size_t depth, std::int64_t onset);

/// Sign of a turn: 1 to the left, -1 to the right.
int sign_of(const Angle& turn);

/// The y that sounds the tonic, doubled; unknown: that of the first note. The x is that of the turtle's start.
struct Origin {
    std::int64_t y = unknown;
};

/// Symbols without effect that mark the ends of sub-curves.
struct Marks {
    std::optional<Symbol> phrase;      ///< mark at the end of a phrase
    std::vector<std::uint8_t> levels;  ///< by symbol: the order of the sub-curves that end there; 0: no mark
    std::uint8_t whole = 0;            ///< order of the whole curve; 0 if levels are not marked
    int level(Symbol symbol) const { return symbol < levels.size() ? levels[symbol] : 0; }
};

/// Input of a reader, and the receivers of its notes. All must outlive the reader.
struct Reading {
    const Grammar& grammar;
    const Lattice& lattice;
    int first;  ///< first heading in quarter turns, on the square grid
    const Melody& melody;
    const Marks& marks;
    Emitter& emitter;
    Origin origin;
    const PlayOptions& options;
    bool has_voices;  ///< brackets are voices
    bool is_on_grid;  ///< the turtle is read in whole numbers
};

class Reader : public SymbolSink {
public:
    /// Advances time and position past a part of the word; false if the part has to be read.
    virtual bool skip(const GridStretch&) { return false; }
    virtual std::int64_t lowest_vertex() const { return 0; }
    virtual std::int64_t highest_vertex() const { return 0; }
    /// Degrees of the first and of the lowest note before the origin is subtracted; unknown without notes.
    virtual std::int64_t first_degree() const { return 0; }
    virtual std::int64_t lowest_degree() const { return 0; }
    /// Adds the symbols that were skipped to a report.
    virtual void report_skipped(PlayReport&) const {}
    bool seeks_first_note = false;  ///< throws Enough at the first note
    /// With `brackets: shares`: the duration of each branch by itself, in steps, in the order of '[' in the word. A
    /// reader that measures appends to it; others divide by it.
    std::vector<double>* spans = nullptr;
    bool measures_spans = false;

protected:
    /// Duration of a step within the next bracket, in steps of the stem; sets `opened` to the number of its '['.
    double share_of(double pace, std::size_t& opened) {
        opened = opened_++;
        if (measures_spans) {
            if (opened >= most_branches) throw ScoreError("more than 16,777,216 branches cannot share durations");
            spans->push_back(0);
            return 1;
        }
        const double span = opened < spans->size() ? (*spans)[opened] : 0;
        return span > 0 ? pace / span : 0;
    }
    /// Duration of a branch that lasts from `before` to `now` by itself: a step of its stem, or 0 if it is empty.
    double shared_span(double pace, double before, double now, std::size_t opened) {
        if (measures_spans) (*spans)[opened] = now - before;
        return (*spans)[opened] > 0 ? pace : 0;
    }

private:
    static constexpr std::size_t most_branches = std::size_t{1} << 24;
    std::size_t opened_ = 0;
};

/// The readers of words. A new one is declared here, and Mapping names it.
std::unique_ptr<Reader> read_runs(const Reading& reading);
std::unique_ptr<Reader> read_counterpoint(const Reading& reading);
std::unique_ptr<Reader> read_symbols(const Reading& reading);

/// Meaning of a symbol for a reader.
enum class Kind : std::uint8_t { nothing, draw, move, turn, open, close, mark, level, not_finite };

/// The kind of each symbol. @param moves_sound  steps that draw nothing are read as drawn: see draws_nothing()
std::vector<Kind> kinds_of(const Grammar& grammar, const Marks& marks, bool moves_sound);

/// Sound of a note, and its origin in the curve: see Note.
struct Sound {
    int velocity;
    int level;
    glm::dvec2 from, to;
    std::uint64_t symbol;
};

/// The common state of all readers. Times are counted in steps of the turtle.
template <class Walk>
class TimedReader : public Reader {
protected:
    using Number = typename Walk::Number;

    TimedReader(const Reading& reading, bool moves_sound)
        : grammar_(reading.grammar),
          marks_(reading.marks),
          melody_(reading.melody),
          emitter_(reading.emitter),
          options_(reading.options),
          kinds_(kinds_of(grammar_, marks_, moves_sound)),
          clock_(melody_),
          may_stop_(!reading.has_voices) {
        clock_.choose_rhythm(above(marks_.whole));
    }

    std::int64_t ticks(Number steps) const { return clock_.ticks(steps); }
    /// Position of the symbol in the word for Note::symbol; 0 after parts that were skipped.
    std::uint64_t counted(std::uint64_t symbol) const { return is_counted_ ? symbol : 0; }

    /// A note from one step to another, with its accent.
    Shaper::Draft draft_of(std::int64_t degree, Number onset, Number end, const Sound& sound) const {
        emitter_.level = sound.level;
        emitter_.emphasis = {clock_.stress(onset)};
        Shaper::Draft draft;
        draft.is_silent = !sounds(onset);
        draft.degree = degree;
        draft.onset = ticks(onset);
        draft.end = clock_.end_ticks(end);
        draft.velocity = sound.velocity;
        draft.from = sound.from;
        draft.to = sound.to;
        draft.symbol = sound.symbol;
        return draft;
    }

    /// False if the rhythm silences a note that begins with a step.
    bool sounds(Number onset) const { return clock_.sounds(onset, grammar_.seed(), options_.ahead); }

    /// Ends the phrases that are due in the first voices, and takes their breath.
    void end_phrases(int voices, Number now) {
        for (int voice = 0; voice < voices; ++voice) emitter_.end_phrase(voice, clock_.is_odd());
        clock_.breathe(due_, now, above(ended_));
        emitter_.begin_phrase(ticks(now));
        due_ = 0;
    }
    /// Records that a sub-curve of some order ends.
    void end_level(int order) { ended_ = std::max(ended_, order); }
    /// Sub-curves that end after further notes end without a phrase.
    void begin_note() { ended_ = 0; }

    /// Ends the word: its last phrases end like all others, with a breath. @param last  tick of the end
    void finish_at(Number end, std::int64_t last, int due) {
        if (due > 0) {
            clock_.breathe(due, end, above(ended_));
            emitter_.begin_phrase(ticks(end));
        }
        emitter_.finish(last);
    }

    const Grammar& grammar_;
    const Marks& marks_;
    const Melody& melody_;
    Emitter& emitter_;
    const PlayOptions& options_;
    const std::vector<Kind> kinds_;  // by symbol
    Clock<Walk> clock_;
    bool may_stop_;
    int due_ = 0;    // phrases that end before the next note
    int ended_ = 0;  // order of the largest sub-curve that has ended since the last note; 0: not known
    std::uint64_t position_ = 0;
    bool is_counted_ = true;  // nothing was skipped

private:
    int above(int order) const { return std::max(0, order - static_cast<int>(melody_.phrase_order)); }
};

/// The common state of readers of the curve.
template <class Walk>
class CurveReader : public TimedReader<Walk> {
public:
    std::int64_t lowest_vertex() const override { return Walk::degree(2 * lowest_); }
    std::int64_t highest_vertex() const override { return Walk::degree(2 * highest_); }
    std::int64_t lowest_degree() const override { return lowest_degree_; }

protected:
    using typename TimedReader<Walk>::Number;
    using Position = typename Walk::Position;
    using Step = typename Walk::Step;

    explicit CurveReader(const Reading& reading)
        : TimedReader<Walk>(reading, draws_nothing(reading.grammar)),
          walk_(reading.grammar, reading.lattice, reading.first) {}

    static glm::dvec2 point(const Position& at) { return {static_cast<double>(at.x), static_cast<double>(at.y)}; }
    /// Moves the turtle.
    static void advance(Position& at, const Step& step) {
        at.x += step.x;
        at.y += step.y;
    }
    /// Registers a corner of the curve.
    void note_vertex(const Position& at) {
        lowest_ = std::min(lowest_, at.y);
        highest_ = std::max(highest_, at.y);
    }
    /// Registers the height of a note.
    void note_degree(std::int64_t degree) {
        lowest_degree_ = std::min(lowest_degree_ == unknown ? farthest : lowest_degree_, degree);
    }

    Walk walk_;

private:
    Number lowest_ = 0;
    Number highest_ = 0;
    std::int64_t lowest_degree_ = unknown;
};

}  // namespace sikku::mapping
