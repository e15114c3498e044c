// music/melody/melody.h: the settings of a melody, from the keys scale, tonic, anchor, unit, vertical, … of a
// pattern.
#pragma once

#include "engine/language/pattern.h"
#include "music/melody/expression.h"
#include "music/melody/figure.h"
#include "music/melody/harmony.h"
#include "music/melody/layout.h"
#include "music/melody/rhythm_template.h"
#include "music/melody/symbol_table.h"
#include "music/scale/scale.h"
#include "music/score/score.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Reading of the curve as a melody.
enum class Mapping {
    runs,          ///< a horizontal run is a note: pitch from y, duration from its length
    counterpoint,  ///< y and x are two voices; a note lasts while its coordinate stays the same
    symbols,       ///< the word itself: F a note, + and - a degree up and down, f a rest
};
/// Effect of brackets on time: a branch is a voice that begins at the time of the turtle; or all notes follow one
/// another, as `]` restores pitch and depth but not time; or the notes of a branch share one step of its stem.
/// Source: Worth & Stepney 2005, sequential and hierarchical rendering, for the latter two.
enum class Branches { voices, sequence, shares };
/// The y that sounds the tonic; `piece`: that of the first note played.
enum class Anchor { first_note, piece, lowest_note, lowest_vertex, centre };
/// Meaning of a vertical run: none, a rest of its length, an extension of the note before it (or, at the beginning,
/// after it), a slide of the note before it, or a note in a voice of its own, with its pitch from x: the starting
/// point of the turtle sounds the tonic.
enum class Vertical { ignore, rest, extend, glissando, voice };
/// One note for a straight run, or for each step of it.
enum class Runs { merged, each_step };
/// Meaning of a run that is neither horizontal nor vertical: a note as long as the run is wide, at the height of its
/// middle; none; an error.
enum class Sloped { project, skip, refuse };
/// Treatment of a note beyond the lowest or highest key: moved by whole periods; mirrored at the last degree within;
/// replaced by that degree; an error.
enum class Range { fold, reflect, clamp, refuse };
/// Property that determines the velocity of a note.
enum class Loudness { fixed, by_turn, by_depth, by_length };

/// The share of a note that sounds: all; a part; less in each branch.
enum class Articulation { legato, detached, by_depth };
/// Goal of the last notes of a phrase, approached by step: none; the tonic; the fifth and the tonic in turn.
enum class Cadence { none, tonic, alternate };

/// Ends of a score: none; the last two bars slow down; in addition, the last notes are held.
enum class Close { none, ritardando, fermata };

/// Settings of a melody.
struct Melody {
    Mapping mapping = Mapping::runs;
    Branches branches = Branches::voices;
    SymbolTable table;           ///< sounds of symbols, for Mapping::symbols
    Scale scale;                 ///< C major if the file names none
    std::optional<KeyMap> keys;  ///< a Scala key map, which then determines all pitches
    double tonic = 60.0;         ///< MIDI key of degree 0, possibly fractional
    Spelling tonic_spelling;     ///< spelling of the tonic
    Anchor anchor = Anchor::first_note;
    std::int64_t unit = ticks_per_quarter / 2;  ///< ticks of a step: above 0
    Vertical vertical = Vertical::ignore;
    Runs runs = Runs::merged;
    Sloped sloped = Sloped::project;
    Range range = Range::fold;
    double lowest = 0.0;     ///< MIDI keys between which `range` keeps the melody
    double highest = 127.0;  ///< not below `lowest`
    Loudness loudness = Loudness::fixed;
    int leaps = 0;  ///< largest leap within a phrase, in semitones; farther notes move by periods; 0: no limit
    RhythmTemplate rhythm;  ///< rhythm of the steps, in slots of `unit`; empty: each step lasts `unit`
    std::vector<RhythmTemplate>
        rhythms;  ///< rhythms of successive phrases, cyclically; empty if there is only `rhythm`
    bool has_rhythms_by_level = false;  ///< instead by how much larger the sub-curve is that begins with the phrase
    double swing = 0.5;                 ///< share of the first of two notes of `swing_unit`, 0.5 to 0.8
    std::int64_t swing_unit = ticks_per_quarter / 2;
    std::int64_t phrase_order = 0;   ///< order of the sub-curves that are phrases; 0: none
    std::int64_t breath = 0;         ///< ticks of rest after a phrase, or their minimum
    bool breathes_to_bar = false;    ///< the rest lasts until a bar line
    bool breathes_by_level = false;  ///< times 1 plus the orders by which the sub-curve is larger that ends with it
    Articulation articulation = Articulation::legato;
    double sounding = 0.6;  ///< share of a note that sounds, if detached
    Cadence cadence = Cadence::none;
    Harmony harmony = Harmony::none;
    std::vector<Chord> progression;  ///< one for each bar, repeated
    Figure figure;                   ///< how chords are played
    std::optional<int> accompanist;  ///< General MIDI program of the chords; absent: strings
    std::int64_t bass_order = 2;     ///< orders by which the bass is coarser
    Close close = Close::none;
    double tempo = 120.0;     ///< quarters a minute
    std::string tempo_words;  ///< printed before it; may be empty
    Meter meter;
    int program = 0;             ///< General MIDI, 0 to 127
    double transpose = 0;        ///< semitones, added to every key
    bool is_inverted = false;    ///< mirrored around the tonic
    std::int64_t shift = 0;      ///< degrees of the scale, added to every degree
    std::int64_t answer = 0;     ///< interval of a canon in degrees, added once notes are shaped and within the range
    bool is_accompanied = true;  ///< true if its drone or its chords sound
    Layout layout;               ///< its place in the score
    MelodicExpression expression;  ///< how velocity, tempo, pan and pitch follow the curve

    /// Ticks of the melody before its first note: the part of the first bar that its upbeat leaves out.
    std::int64_t lead() const { return layout.upbeat > 0 ? meter.bar() - layout.upbeat : 0; }
    /// The tick of the melody at which the part begins.
    std::int64_t begin() const { return layout.opening() > 0 ? lead() : 0; }
    /// The number of the bar in which a tick of the melody lies, from 0; that of an upbeat is -1.
    std::int64_t bar_number(std::int64_t tick) const { return tick / meter.bar() - (layout.upbeat > 0 ? 1 : 0); }
    /// True if a phrase begins with its rhythm, perhaps at a bar line.
    bool restarts_rhythm() const { return breathes_to_bar || !rhythms.empty(); }
    /// True if a phrase depends on all phrases before it.
    bool is_sequential() const { return restarts_rhythm() || breathes_by_level || leaps > 0; }
    /// True if it depends on the ends of all sub-curves.
    bool follows_levels() const {
        return has_rhythms_by_level || breathes_by_level || expression.uses(ExpressionSource::level);
    }
    /// True if notes are changed between the curve and the scale.
    bool is_shaped() const {
        return swing != 0.5 || cadence != Cadence::none || articulation != Articulation::legato || has_chords();
    }
    /// True if strong beats fall on tones of chords.
    bool has_chords() const { return harmony == Harmony::triads || harmony == Harmony::progression; }
    /// Number of voices of drone or chords.
    int accompanying_voices() const {
        return !is_accompanied || (has_chords() && figure.is_silent) ? 0
               : has_chords()                                        ? 3
               : harmony == Harmony::drone                           ? 2
                                                                     : 0;
    }
    /// Number of voices of the melody itself, without those of branches.
    int own_voices() const {
        if (mapping == Mapping::symbols) return table.most_notes();
        return mapping == Mapping::counterpoint || (mapping == Mapping::runs && vertical == Vertical::voice) ? 2 : 1;
    }
    /// The MIDI key of a degree; may lie beyond 0 to 127. Nullopt for a degree that a key map leaves out.
    std::optional<double> key(std::int64_t degree, bool falling) const;
    /// True with a key map, or if a pitch of the melody lies between two keys.
    bool is_microtonal() const;
};

/// Returns the text of a file named by `scale:` or `keyboard:`, or throws.
using FileReader = std::function<std::string(const std::string& path)>;

/// Reads and checks the keys that KeyOwner::music owns; an absent key keeps its default. Without `read_file`, scale
/// files are not read.
Melody read_melody(const Pattern& pattern, const FileReader& read_file, Diagnostics& diagnostics);

/// Raises every note by `semitones`. Whole numbers also move the tonic's name, and so key signature and spelling.
void transpose(Melody& melody, double semitones);

/// Names of the General MIDI programs, 0 to 127.
const std::vector<std::string_view>& instrument_names();

}  // namespace sikku
