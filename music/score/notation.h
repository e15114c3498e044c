// music/score/notation.h: arranges notes in bars: note values, tuplets, ties, rests, staves, clefs, signs, dynamics.
#pragma once

#include "music/score/bar_lines.h"
#include "music/score/instruments.h"
#include "music/score/pitch.h"
#include "music/score/repeats.h"
#include "music/score/rhythm.h"
#include "music/score/score.h"
#include "music/score/turns.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace sikku {

enum class SymbolKind {
    note,
    rest,
    bar_rest,  ///< rest of a whole bar of any length
    gap        ///< a rest that is not printed: a bar that other voices of the staff fill, or one of a third voice
};

/// Another note of a chord.
struct ChordNote {
    Pitch pitch;
    int drum = 0;   ///< as in NotatedSymbol
    int cents = 0;  ///< as in NotatedSymbol
    bool has_sign = false;
};

/// A note or a rest with a note value. (Lengths of bar rests and gaps may be those of bars.) Longer notes, and notes
/// across a bar line or the end of a tuplet, are several, tied.
struct NotatedSymbol {
    std::int64_t onset = 0;   ///< ticks
    std::int64_t length = 1;  ///< ticks, those of its value, or fewer in a tuplet
    NoteValue value;
    SymbolKind kind = SymbolKind::rest;
    bool tied_back = false;     ///< continues the symbol before
    bool tied_forward = false;  ///< continues in the next one
    bool has_sign = false;      ///< its accidental, which may be a natural, is printed
    bool is_accented = false;   ///< much louder than the notes around it
    bool is_ghost = false;      ///< much softer: printed in parentheses
    bool begins_slide = false;  ///< a line leads to the next note
    bool ends_slide = false;    ///< a line leads here from the note before
    bool has_fermata = false;   ///< set for notes and rests at the end
    bool slows_down = false;    ///< a ritardando begins here
    bool begins_slur = false;
    bool ends_slur = false;
    bool is_staccato = false;
    int leaves = 0;   ///< it slides away without a goal: 1 up, -1 down; 0: not
    int tuplet = -1;  ///< index in NotatedVoice::tuplets; -1: none
    int cents = 0;    ///< to be printed: how much higher it sounds than written
    Pitch pitch;      ///< pitch of a note; for drums the place on the staff, as in treble clef
    int drum = 0;     ///< the key of a drum: see drums.h; 0: none
    std::array<Beam, 4> beams{};
    std::string_view syllable{};       ///< under the note; static
    std::optional<ChordNote> grace{};  ///< before it
    std::vector<ChordNote> chord;      ///< notes above `pitch` that sound with it
};

/// Clefs with an octave are for instruments that are written an octave away from their sound.
enum class Clef { treble, bass, alto, tenor, treble_8, bass_8, treble_up_8, percussion };

struct ClefForm {
    char sign;    ///< G, F or C: the letter of the note on its line
    int line;     ///< from 1, the lowest
    int octaves;  ///< octaves by which notes sound higher
};

/// The form of a clef; that of percussion is as in treble.
const ClefForm& form_of(Clef clef);

/// The height of the middle line: see Pitch::height().
int middle_line(Clef clef);

/// One voice on one staff. Its symbols fill the score from the first bar to the last, bar by bar.
struct NotatedVoice {
    int voice = 0;  ///< number in the score, from 0
    std::vector<NotatedSymbol> symbols;
    std::vector<TupletSpan> tuplets;  ///< in ascending order
};

/// A clef and a line of 8va that apply from `onset` on; a symbol of every voice of the staff begins there.
struct StaffChange {
    std::int64_t onset = 0;
    Clef clef = Clef::treble;
    int octaves = 0;             ///< octaves by which notes are written lower: -1 8vb, 1 8va, 2 15ma, 3 22ma
    bool restates_clef = false;  ///< the clef is printed even if it is in force
    bool restarts_line = false;  ///< an 8va line ends, even if another one of the same octave begins
    bool operator==(const StaffChange&) const = default;
};

/// A dynamic, or the beginning of a hairpin, which the next mark ends.
struct DynamicMark {
    enum class Kind {
        level,
        crescendo,
        diminuendo,
        end  ///< end of a hairpin before a rest
    };
    std::int64_t onset = 0;  ///< onset of a note, or of the rest that ends a hairpin
    Kind kind = Kind::level;
    int level = 4;  ///< 0 ppp, 1 pp, 2 p, 3 mp, 4 mf, 5 f, 6 ff, 7 fff
    bool operator==(const DynamicMark&) const = default;
};

/// Notes of another part before an entry, printed small, so that a player who has rested for long finds the place.
struct Cue {
    std::string name;  ///< abbreviation of the other part
    std::int64_t from = 0;
    std::int64_t to = 0;  ///< bar lines; the entry follows
    NotatedVoice voice;   ///< its symbols fill these bars
};

struct Staff {
    int lines = 5;                     ///< 1 for a single drum
    std::vector<StaffChange> changes;  ///< the first is at 0
    std::vector<NotatedVoice> voices;  ///< 1 to 4
    std::vector<DynamicMark> dynamics;
    std::vector<Cue> cues{};  ///< ascending
};

/// Sign that joins the staves of a part at the left.
enum class Bracket { none, brace, bracket };

/// A chord named above the staff from a tick on.
struct ChordMark {
    std::int64_t onset = 0;
    int quality = 0;  ///< index in chord_qualities(); below 0: no chord from here on, or one without a name
    Pitch root{};
    std::optional<Pitch> bass{};  ///< another bass than the root
};

struct NotatedPart {
    Part part;                                   ///< its instrument
    std::string name;                            ///< printed name; parts with the same name are numbered
    std::string abbreviation;                    ///< abbreviation of the name
    std::vector<KeyChange> keys;                 ///< ascending, the first at 0
    std::optional<Transposition> transposition;  ///< notes and keys are written this much higher than they sound
    std::vector<Staff> staves;                   ///< at least one
    Bracket bracket = Bracket::none;
    std::vector<ChordMark> chords{};  ///< above the first staff, ascending
    bool has_pedal = false;           ///< the last staff is for the pedal, below the brace of both hands
};

/// A score as it is printed; parts in the order of ScoreHead::parts, with those that take turns as one.
struct Notation {
    std::vector<NotatedPart> parts;
    std::vector<SectionChange> changes;     ///< of tempo and meter, ascending, after the beginning
    std::vector<std::int64_t> double_bars;  ///< bar lines at which key, tempo or meter change: ticks, ascending
    std::vector<PrintedRepeat> repeats;     ///< ascending; their signs replace double bars
    bool is_held = false;                   ///< it ends with fermatas
    std::int64_t bars = 1;
    BarLines bar_lines;        ///< from the first printed bar on
    std::uint64_t moved = 0;   ///< notes that are not on the grid and were moved to the nearest point
    std::uint64_t bent = 0;    ///< notes more than a cent away from every quarter tone, and written as the nearest
    std::uint64_t merged = 0;  ///< notes left out because another voice has the same note
    std::uint64_t nameless_chords = 0;  ///< chords above the first staff that have no name
    bool is_cut = false;                ///< bars follow that are not printed
    bool is_concert = false;            ///< parts of transposing instruments are written as they sound
    bool is_extracted = false;          ///< true for the part of one player
    /// Numbers of bars of rest that are printed as one, by their first bar.
    std::map<std::int64_t, std::int64_t> gathered_rests{};
    bool is_whole_rest(const NotatedSymbol& symbol) const {
        return symbol.kind == SymbolKind::bar_rest ||
               (symbol.kind == SymbolKind::gap && symbol.length == bar_lines.written(symbol.onset));
    }
    /// The tick at which it ends.
    std::int64_t end() const { return bar_lines.onset(bars); }
    /// Bars with all repeats.
    std::int64_t played_bars() const {
        std::int64_t played = bars;
        for (const PrintedRepeat& repeat : repeats) {
            const auto times = static_cast<std::int64_t>(repeat.times);
            played += (times - 1) * (bar_lines.number(repeat.end) - bar_lines.number(repeat.begin)) -
                      (bar_lines.number(repeat.last) - bar_lines.number(repeat.end));
        }
        return played;
    }
    /// Bars that a symbol stands for: several for rests and gaps of a whole bar that are gathered.
    std::int64_t bars_of(const NotatedSymbol& symbol) const {
        return is_whole_rest(symbol) ? bars_of_rest(symbol.onset) : 1;
    }
    /// Bars of rest that are printed as one from a bar line on.
    std::int64_t bars_of_rest(std::int64_t onset) const {
        const auto found = gathered_rests.find(bar_lines.number(onset));
        return found == gathered_rests.end() ? 1 : found->second;
    }
    /// Notes beyond the range of their instrument, by program.
    struct Outside {
        std::uint64_t notes = 0;
        double lowest = 127;
        double highest = 0;
    };
    std::map<int, Outside> outside;
};

/// Thrown for scores that have too many notes or bars.
class TooLongToPrint : public ScoreError {
    using ScoreError::ScoreError;
};

/// Collects a melody and makes a Notation of it.
///
/// Bars: a note is split at bar lines, at the ends of tuplets, then into note values: see rhythm.h. Onsets and ends
/// off every grid are rounded to 64ths, but never to length 0: a note that would vanish delays the next one.
/// Staves: each voice has its own; see staves.h. Voices that never sound are left out. Parts of one instrument that
/// take turns share staves; see turns.h. Drum strokes are divided between hands and feet; see strokes.h.
/// Repeats: if the head requests repeat signs, passages that are played several times in a row are written once; see
/// repeats.h. Slurs, hairpins and 8va lines do not cross the signs, and dynamics and chords are stated again after a
/// sign that is reached from places where they differ.
/// Pitches: written as Part::spelling says; half-way between two semitones with a quarter-tone sign. Other pitches
/// have their deviation in cents.
/// Memory: O(notes + bars).
class Notator final : public NoteSink {
public:
    /// Bars that are printed, of all that are received.
    struct Bars {
        std::int64_t first = 0;
        std::int64_t count = INT64_MAX;
    };
    explicit Notator(const ScoreHead& head) : Notator(head, Bars{}) {}
    /// Staves, clefs and dynamics are those of the whole.
    Notator(const ScoreHead& head, const Bars& bars);

    /// @throws TooLongToPrint after 200,000 notes; ScoreError for a voice without a part
    void notes(std::span<const Note> notes) override;
    /// @throws TooLongToPrint if the score has more than 100,000 bars
    void finish(std::int64_t end) override;

    /// The result, after finish().
    const Notation& notation() const { return notation_; }

private:
    using ChordPlace = std::tuple<std::size_t, std::uint64_t, std::int64_t>;

    void notate_part(std::size_t index);
    std::int64_t first_tick() const { return bar_lines_.onset(printed_bars_.first); }
    std::int64_t fold_repeats(std::int64_t end);
    void cut(NotatedPart& part) const;
    void finish_staff(Staff& staff, const NotatedPart& part) const;
    void mark_ending(std::int64_t end);
    void gather_chords(std::size_t part, std::size_t first_voice);
    void gather_accompaniment(std::size_t part, std::size_t first_voice);
    void share_chords();
    void notate_drums(std::size_t index);
    NotatedPart& begin_part(const PrintedPart& printed);
    NotatedVoice fill(int number, std::vector<Note> notes, std::size_t index,
                      std::span<const std::vector<double>> chords);
    std::vector<std::vector<double>> chords_of(std::span<const Note> notes, std::size_t index) const;

    void agree_on_swing();
    void transpose_part(std::size_t index);
    void find_outside();
    void name_chords();
    std::vector<std::pair<std::int64_t, ChordSign>> changes_of_chords() const;
    ChordSign chord_at(const Note& note) const;
    int transposed_by(const Part& part) const;

    std::vector<Part> parts_;
    BarLines bar_lines_;  ///< of the whole score, not only of its printed bars
    std::vector<SectionChange> changes_;
    bool is_transposed_;
    Syllables syllables_;
    bool has_chord_signs_;
    bool has_graces_;
    std::size_t most_repeats_;
    std::int64_t ritardando_;  ///< ticks before the end; 0: none
    Bars printed_bars_;
    std::int64_t all_bars_ = 1;
    std::vector<std::size_t> part_indices_;  ///< by voice
    std::vector<std::vector<Note>> voices_;
    std::vector<PrintedPart> printed_;
    std::vector<PrintedRepeat> repeats_;  ///< in ticks as bar_lines_
    /// Other notes of chords, by the part (of parts_, later of printed_), symbol and onset of their first note.
    std::map<ChordPlace, std::vector<double>> chords_;
    /// Chords that sound, by part and onset, with their ends.
    std::map<std::pair<std::size_t, std::int64_t>, std::pair<std::int64_t, ChordSign>> chord_signs_;
    std::map<std::int64_t, std::pair<std::int64_t, ChordSign>> chords_by_onset_;  ///< those of the first part there
    std::size_t count_ = 0;
    Notation notation_;
};

/// Stated at the head of a score whose transposing instruments are written as they sound.
constexpr std::string_view concert_text = "Score in C";

/// The keys of the drums on a staff, ascending.
std::vector<int> drums_of(const Staff& staff);
/// The keys of the drums in a score, ascending.
std::vector<int> drums_of(const Notation& notation);

/// Calls `visit` with each voice of a score.
template <class Visit>
void each_voice(const Notation& notation, Visit visit) {
    for (const NotatedPart& part : notation.parts) {
        for (const Staff& staff : part.staves) {
            for (const NotatedVoice& voice : staff.voices) visit(voice);
        }
    }
}

/// Calls `visit` with each note and rest of a score.
template <class Visit>
void each_symbol(const Notation& notation, Visit visit) {
    each_voice(notation, [&](const NotatedVoice& voice) {
        for (const NotatedSymbol& symbol : voice.symbols) visit(symbol);
    });
}

/// The cents that are printed above a note, those of a chord from the highest note to the lowest.
std::vector<int> printed_cents(const NotatedSymbol& symbol);
/// Formats cents as `+14`, or `−9` with a minus sign.
std::string cents_text(int cents);

/// The height of a staff in printer's points (1/72.27 inch), 13 to 20: lower in scores of many staves.
int staff_size(const Notation& notation);

/// `lydian`, `major`, … `locrian`.
std::string_view mode_name(Mode mode);

/// The signature that a part is printed with.
std::optional<KeySignature> printed_key(const Part& part);

/// Signs that a key signature sets, in semitones for each letter from C.
std::array<int, 7> signs_of(const std::optional<KeySignature>& key);

}  // namespace sikku
