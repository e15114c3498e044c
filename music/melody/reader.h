// music/melody/reader.h: the common base of the readers of words.
#pragma once

#include "music/melody/clock.h"
#include "music/melody/emitter.h"
#include "music/melody/walks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string_view>
#include <type_traits>
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
inline int loudness(const Melody& melody, int turned, double steps, std::size_t depth, std::int64_t onset) {
    switch (melody.loudness) {
        case Loudness::fixed:
            break;
        case Loudness::by_turn:
            return 80 + 18 * turned;
        case Loudness::by_depth:
            return std::max(30, 100 - 12 * static_cast<int>(std::min<std::size_t>(depth, 10)));
        case Loudness::by_length: {
            // Long notes are louder, and a phrase of four bars swells towards its middle.
            const double weight = 8.0 * std::min(4.0, steps);
            const auto phrase = static_cast<double>(4 * melody.meter.bar());
            const double within = std::fmod(static_cast<double>(onset), phrase) / phrase;
            return static_cast<int>(std::lround(58 + weight + 40 * within * (1 - within)));
        }
    }
    return 80;
}

/// Sign of a turn: 1 to the left, -1 to the right.
inline int sign_of(const Angle& turn) {
    const double degrees = std::remainder(turn.degrees, 360.0);
    return degrees > 0 ? 1 : degrees < 0 ? -1 : 0;
}

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

/// Ends the last phrases of the word like all others, with a breath.
/// @param due  number of phrases
/// @param end  end of the word, in steps
template <class Walk>
void end_last_phrases(Clock<Walk>& clock, const Emitter& emitter, int due, typename Walk::Number end) {
    if (due == 0) return;
    clock.breathe(due, end);
    emitter.begin_phrase(clock.ticks(end));
}

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

/// Meaning of a symbol for the reader of runs.
enum class Kind : std::uint8_t { nothing, draw, move, turn, open, close, mark, level, not_finite };

/// @param moves_sound  steps that draw nothing are read as drawn: see draws_nothing()
inline Kind kind_of(const Command& command, bool moves_sound) {
    const bool is_finite = std::isfinite(command.value) && std::isfinite(command.angle.degrees);
    switch (command.action) {
        case Action::draw:
            return is_finite ? Kind::draw : Kind::not_finite;
        case Action::move:
            return !is_finite ? Kind::not_finite : moves_sound ? Kind::draw : Kind::move;
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

}  // namespace sikku::mapping
