// music/score/rhythm.h: writes durations with note values: groups of a meter, tuplets, beams.
#pragma once

#include "music/score/bar_lines.h"
#include "music/score/score.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace sikku {

/// The shortest note value, a 64th, in ticks.
constexpr std::int64_t shortest_value = ticks_per_quarter / 16;

/// A note value: 1 is a whole note, 2 a half, … 64.
struct NoteValue {
    int divisor = 4;
    bool dotted = false;
    bool operator==(const NoteValue&) const = default;
    std::int64_t ticks() const { return 4 * ticks_per_quarter / divisor * (dotted ? 3 : 2) / 2; }
};

/// The note value of a number of ticks outside tuplets: a power of two from a 64th to a whole, or 3/2 of one.
NoteValue note_value(std::int64_t length);

/// A stretch of a bar that is divided into `actual` equal notes in the time of `normal` notes of the value
/// 1/`divisor`.
struct TupletSpan {
    std::int64_t from = 0;  ///< ticks from the beginning of the score
    std::int64_t to = 0;
    int actual = 3;
    int normal = 2;
    int divisor = 8;
    /// The length of its notes, rounded down.
    std::int64_t step() const { return (to - from) / actual; }
    /// The tick at which a note, counted from 0, begins; in septuplets rounded to the nearest.
    std::int64_t tick(std::int64_t note) const { return from + (2 * note * (to - from) + actual) / (2 * actual); }
    /// The note that begins nearest to a tick; of two, the later one.
    std::int64_t note_at(std::int64_t tick) const {
        return (2 * (tick - from) * actual + (to - from)) / (2 * (to - from));
    }
};

/// Groups of a bar in ticks: those of the meter; in x/8, x/16, …: threes for multiples of three, 3+3+2 for eight,
/// otherwise twos, the first a three in 5/8, 7/8, …; in other meters, beats.
std::vector<std::int64_t> groups_of(const Meter& meter);
/// Ticks of the strong beats of a bar: the beginnings of its groups if the meter has groups, otherwise its beginning
/// and, with an even number of beats, the middle.
std::vector<std::int64_t> strong_beats(const Meter& meter);
/// True if groups are unequal or set by the meter, so that they have to be printed.
bool has_groups(const Meter& meter);
/// A beat as a note value.
struct BeatUnit {
    NoteValue value;
    double quarters = 1;  ///< its length
};
/// The beat of printed tempos: a dotted one in 6/8, 9/8, …, the unit in other meters.
BeatUnit beat_unit(const Meter& meter);

/// The number of beats as printed: `7`, or groups of a pattern such as `3+2+2`.
std::string beats_text(const Meter& meter);

/// The end of the beat, or the group of x/8, in which a time lies: ticks from the beginning of the score.
std::int64_t beat_end(std::int64_t time, const BarLines& bars);

/// The times at which notes of a voice may begin and end: 64ths, and in tuplets their notes.
class Grid {
public:
    /// Chooses tuplets so that all `times` (ascending; ticks from the beginning of the score) lie on the grid if
    /// possible. A tuplet is a bar, a half of it, a group or a beat, or a part of a beat, divided into 3, 5, 6, 7, 10
    /// or 12, and the largest that fits is chosen. Cost: O(times · log bar).
    Grid(std::span<const std::int64_t> times, const BarLines& bars);

    const std::vector<TupletSpan>& tuplets() const { return tuplets_; }
    /// The point of the grid nearest to a time; of two, the later one.
    std::int64_t nearest(std::int64_t time) const;
    /// The first point of the grid after one.
    std::int64_t after(std::int64_t time) const;
    /// The first tuplet that ends after `time`; tuplets().size() if none does.
    std::size_t tuplet_from(std::int64_t time) const;

private:
    bool divide(std::int64_t from, std::int64_t length, std::span<const std::int64_t> times);
    bool divide_parts(std::int64_t from, std::int64_t length, int parts, std::span<const std::int64_t> times);
    bool add(std::int64_t from, std::int64_t length, int actual, int normal, std::span<const std::int64_t> times);

    std::vector<TupletSpan> tuplets_;
};

/// The grid of notes of one voice.
Grid grid_of(std::span<const Note> notes, const BarLines& bars);

/// A note value of a length.
struct WrittenValue {
    std::int64_t length = 0;  ///< ticks
    NoteValue value;
};

/// Splits a stretch within one bar and outside tuplets into note values. It crosses neither the middle of four and
/// more beats nor the end of a group unless it begins with one and ends with one; off the beat it does not hide the
/// next larger metrical place. A value that begins with half a beat may end with half of the next, wherever that is.
/// @param from, to  ticks from the bar line, multiples of a 64th
std::vector<WrittenValue> written_values(std::int64_t from, std::int64_t to, const Meter& meter);
/// Splits a stretch of a tuplet. @param from, to  on its grid
std::vector<WrittenValue> written_values(std::int64_t from, std::int64_t to, const TupletSpan& tuplet);

/// Splits a rest as written_values() splits notes, but so that every beat is visible: a rest begins at a multiple of
/// its own length, does not hide the middle of a bar, and has a dot only at the beginning of a beat or as a whole
/// dotted beat (Gould 2011, "Behind Bars", "Rests").
std::vector<WrittenValue> written_rests(std::int64_t from, std::int64_t to, const Meter& meter);
std::vector<WrittenValue> written_rests(std::int64_t from, std::int64_t to, const TupletSpan& tuplet);

enum class Beam : std::uint8_t { none, begin, inside, end, forward_hook, backward_hook };

/// The properties of a note or rest that beams depend on.
struct BeamedNote {
    std::int64_t onset = 0;  ///< ticks from the beginning of the score
    std::int64_t length = 0;
    NoteValue value;
    bool is_note = true;
    int tuplet = -1;  ///< index in Grid::tuplets()
    std::array<Beam, 4> beams{};
};
/// Sets beams: one for eighths, two for 16ths, up to four. Notes are beamed within beats, or the groups of x/8;
/// eighths alone within half of 4/4 and all of 2/4 and 3/4. Rests end beams. From 32nds on, only the first beam leads
/// from one eighth to the next.
void set_beams(std::span<BeamedNote> notes, std::span<const TupletSpan> tuplets, const BarLines& bars);

}  // namespace sikku
