// music/score/notation.h: arranges notes in bars: printable lengths, ties, rests, staves, signs.
#pragma once

#include "music/score/score.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace sikku {

/// All times here are counted in 64th notes from the beginning of the score.
constexpr std::int64_t sixty_fourths_per_quarter = 16;
constexpr std::int64_t ticks_per_sixty_fourth = ticks_per_quarter / sixty_fourths_per_quarter;

/// A pitch as it is written. `quarters`: what its sign adds, in quarter tones, -4 (two flats) to 4 (two sharps).
struct Pitch {
    int letter = 0;  ///< 0 (C) to 6 (B)
    int octave = 4;  ///< from C to B, that of middle C is 4; -2 to 9
    int quarters = 0;

    /// The MIDI key.
    double key() const;
    bool operator==(const Pitch&) const = default;
};

enum class SymbolKind {
    note,
    rest,
    bar_rest,  ///< of a whole bar, whatever its length
    gap        ///< a rest that is not printed: a bar that other voices of the staff fill, or one of a third voice
};

/// A note or a rest of a length that has a sign of its own: a power of two from a 64th to a whole, or half as much
/// again. (Lengths of bar rests and gaps are those of bars.) Notes longer than that, and notes across a bar line,
/// are several, tied.
struct NotatedSymbol {
    std::int64_t onset = 0;
    std::int64_t length = 1;
    SymbolKind kind = SymbolKind::rest;
    bool tied_back = false;     ///< goes on from the symbol before
    bool tied_forward = false;  ///< goes on into the next one
    bool has_sign = false;      ///< its accidental (perhaps a natural) has to be printed
    Pitch pitch;                ///< of notes
};

enum class Clef { treble, bass };

/// One voice on one staff. Its symbols fill the score from the first bar to the last, bar by bar.
struct NotatedVoice {
    int voice = 0;  ///< of the score, from 0
    std::vector<NotatedSymbol> symbols;
};

struct Staff {
    Clef clef = Clef::treble;
    std::vector<NotatedVoice> voices;  ///< 1 to 4
};

struct NotatedPart {
    std::vector<Staff> staves;  ///< at least one
};

/// A score as it is printed; parts in the order of ScoreHead::parts.
struct Notation {
    std::vector<NotatedPart> parts;
    std::int64_t bars = 1;
    std::int64_t bar_length = 64;
    std::uint64_t moved = 0;  ///< notes that began or ended between two 64ths, and were moved to the nearest
    std::uint64_t bent = 0;   ///< notes more than a cent away from every quarter tone, and written as the nearest
};

/// The sign of a printable length: its note value (1 whole, 2 half, … 64) and whether it has a dot.
struct NoteValue {
    int divisor = 4;
    bool dotted = false;
};
NoteValue note_value(std::int64_t length);

/// Collects a melody and makes a Notation of it.
///
/// Bars: a note is split at bar lines, then into the largest printable lengths; one that starts off the beat crosses
/// neither the middle of the bar nor, starting on a fraction of a beat, what would hide the next larger metrical
/// place. 6/8, 9/8 and 12/8 have dotted beats. Onsets and ends are rounded to 64ths, never to nothing: a note that
/// would vanish pushes the next one on.
/// Staves: a part of up to four voices has one, or, if it reaches over two octaves and to both sides of middle C,
/// an upper one for notes from C4 and a lower one; more voices have a staff for every four. The clef is that of the
/// median key. Voices that never sound are left out.
/// Pitches: written as Part::spelling says; half-way between two semitones with a quarter-tone sign.
/// Memory: O(notes + bars).
class Notator final : public NoteSink {
public:
    explicit Notator(const ScoreHead& head);

    /// Throws ScoreError after 200,000 notes, and for a voice that belongs to no part.
    void notes(std::span<const Note> notes) override;
    /// Throws ScoreError if the score has more than 100,000 bars.
    void finish(std::int64_t end) override;

    /// After finish().
    const Notation& notation() const { return notation_; }

private:
    struct Placed {
        std::int64_t onset = 0;
        std::int64_t end = 0;
        double key = 60.0;
    };

    void notate_part(std::size_t part, std::size_t first_voice);
    Staff make_staff(const Part& part, std::size_t first_voice, std::size_t voices, double low, double high) const;
    std::vector<NotatedSymbol> fill(std::span<const Placed> notes, const Part& part) const;
    void add_rests(std::vector<NotatedSymbol>& symbols, std::int64_t from, std::int64_t to) const;
    void add_note(std::vector<NotatedSymbol>& symbols, std::int64_t from, std::int64_t to, Pitch pitch) const;

    std::vector<Part> parts_;
    Meter meter_;
    std::vector<std::vector<Placed>> voices_;
    std::size_t count_ = 0;
    Notation notation_;
};

/// The letter, octave and sign of a key, by Part::spelling.
Pitch spelled(double key, const std::array<Spelling, 12>& spelling);

/// The lengths into which a stretch within one bar is split, from the beginning. `from` counts from the bar line.
std::vector<std::int64_t> printable_lengths(std::int64_t from, std::int64_t to, const Meter& meter);

/// Signs that a key signature sets, in semitones for each letter from C.
std::array<int, 7> signs_of(const std::optional<KeySignature>& key);

}  // namespace sikku
