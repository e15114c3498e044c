// music/score/score.h: notes, and the other contents of a score; the interface between readers of melodies and
// writers of files.
#pragma once

#include "engine/base/output.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Times are counted in ticks from the beginning of the score.
constexpr std::int64_t ticks_per_quarter = 480;

/// A slide of the pitch at the end of a note.
struct Glide {
    std::int64_t ticks = 0;  ///< duration, at most that of the note; 0: the pitch stays
    float semitones = 0;     ///< from the key to the pitch at the end, evenly
    float rise = 0;          ///< turtle steps up the curve, from `to` of the note, that it comes from
};

/// Velocity added to notes that a rhythm accents, and subtracted from its ghost notes.
constexpr int accent_velocity = 16;
constexpr int ghost_velocity = 32;

/// How a rhythm stresses a note.
enum class Stress : std::int8_t { plain, accent, ghost };

/// Stress and dynamic that the pattern states for a note; they are printed.
struct Emphasis {
    Stress stress = Stress::plain;
    std::int8_t dynamic = -1;  ///< 0 ppp, 1 pp, 2 p, 3 mp, 4 mf, 5 f, 6 ff, 7 fff; -1: not stated
    bool is_accented() const { return stress == Stress::accent; }
    bool is_ghost() const { return stress == Stress::ghost; }
    /// The part of the note's velocity that comes from its stress.
    int velocity() const { return is_accented() ? accent_velocity : is_ghost() ? -ghost_velocity : 0; }
};

/// A chord as a symbol names it.
struct ChordSign {
    std::int8_t quality = no_chord;  ///< index in chord_qualities(), or one of the following
    static constexpr std::int8_t no_chord = -1;
    static constexpr std::int8_t without_name = -2;
    std::int8_t root = 0;   ///< pitch class
    std::int8_t bass = -1;  ///< pitch class of a bass that is not the root; -1: none
    bool operator==(const ChordSign&) const = default;
};

/// One note of one voice.
struct Note {
    std::int64_t onset = 0;
    std::int64_t duration = 1;   ///< above 0
    double key = 60.0;           ///< MIDI key, 60 is C4; fractions are microtones; within [0, 127]
    std::int16_t voice = 0;      ///< counted from 0
    std::uint8_t velocity = 80;  ///< 1 to 127
    glm::dvec2 from{0.0};        ///< start of its piece of the curve, in turtle steps
    glm::dvec2 to{0.0};
    std::uint64_t symbol = 0;    ///< position in the word of its first symbol, counted from 1; 0: unknown
    std::uint8_t depth = 0;      ///< brackets around it
    std::uint8_t level = 0;      ///< order of the largest sub-curve that begins with it, if a curve follows levels
    bool is_sliding = false;     ///< its pitch slides to the next note of its voice
    bool is_remainder = false;   ///< of a note that began before an excerpt
    bool begins_phrase = false;  ///< only in parts that follow no other; false if its beginning is cut off
    Glide glide{};               ///< slide of `vertical: glissando`
    bool has_fermata = false;    ///< it is held at the end
    Emphasis emphasis{};
    ChordSign chord{};       ///< chord that the note of an accompaniment belongs to
    std::int16_t grace = 0;  ///< cents from its key to the grace note that prints its gamaka; 0: none

    /// The end of the piece of the curve that the note comes from.
    glm::dvec2 end_point() const { return {to.x, to.y + static_cast<double>(glide.rise)}; }
};

struct Curves;
struct ControlPoint;

/// Receives a melody, a block of notes at a time: in each voice by onset and without overlap, the voices in any
/// order. Spans are valid only during the call.
class NoteSink {
public:
    virtual ~NoteSink() = default;
    /// Called once before the first notes, or not at all. `curves` outlives the sink. The default ignores them.
    virtual void curves(const Curves& /*curves*/) {}
    /// Points of controllers within the notes that come next, in each voice by tick: instead of curves(), for sinks
    /// that write notes as they come. The default ignores them.
    virtual void controls(std::span<const ControlPoint> /*points*/) {}
    virtual void notes(std::span<const Note> notes) = 0;
    /// Called once after the last note. @param end  end of the score, rests included
    virtual void finish(std::int64_t end) = 0;
};

/// Ignores all notes.
class NullSink : public NoteSink {
public:
    void notes(std::span<const Note>) override {}
    void finish(std::int64_t) override {}
};

/// Thrown if a melody cannot be written: for too many voices, or for a note out of range if such notes are errors.
class ScoreError : public std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct Meter {
    int beats = 4;
    int unit = 4;                           ///< a power of two, 1 to 64
    std::array<std::uint8_t, 16> groups{};  ///< in beats, as in `3+2+2/8`, then zeros; all zeros: see groups_of()
    std::int64_t bar() const { return 4 * ticks_per_quarter * beats / unit; }  ///< ticks
    bool operator==(const Meter&) const = default;
};

/// Tempo and meter.
struct TempoAndMeter {
    double tempo = 120;       ///< quarters a minute
    std::string tempo_words;  ///< printed before it: `Andante`; may be empty
    Meter meter;
    bool operator==(const TempoAndMeter&) const = default;
};

/// The tempo and meter that a section states.
struct SectionTempo {
    std::optional<double> tempo;  ///< quarters a minute
    std::string tempo_words;
    std::optional<Meter> meter;
    bool follows_curve = false;
};

/// A change of tempo or meter at the bar line where a section begins.
struct SectionChange {
    std::int64_t onset = 0;  ///< ticks
    TempoAndMeter to;
    bool operator==(const SectionChange&) const = default;
};

/// Spelling of a pitch class: letter 0 (C) to 6 (B), alteration in semitones.
struct Spelling {
    int letter = 0;
    int alteration = 0;
};

/// The modes by the position of the tonic in the chain of fifths of the scale, lowest first.
enum class Mode { lydian, major, mixolydian, dorian, minor, phrygian, locrian };

/// A key signature. `fifths`: sharps if positive, flats if negative, -7 to 7.
struct KeySignature {
    int fifths = 0;
    bool minor = false;
    Mode mode = minor ? Mode::minor : Mode::major;
    bool operator==(const KeySignature&) const = default;
};

/// A key signature from a bar line on.
struct KeyChange {
    std::int64_t onset = 0;           ///< ticks
    std::optional<KeySignature> key;  ///< nullopt: no signs
};

/// Off-beats that come late.
struct Swing {
    double share = 0.5;                         ///< of the first of two notes, 0.5 (straight) to 0.8
    std::int64_t unit = ticks_per_quarter / 2;  ///< ticks of each
    bool is_on() const { return share != 0.5; }
    /// True for binary off-beats of a bar: halves, quarters and eighths of the unit, in pairs from the bar line on. A
    /// unit without a second one is straight.
    bool moves(std::int64_t tick, std::int64_t bar) const {
        const std::int64_t place = tick % bar;
        const std::int64_t within = place % (2 * unit);
        return within != 0 && 8 * within % unit == 0 && place - within + 2 * unit <= bar;
    }
    bool operator==(const Swing&) const = default;
};

/// Names of degrees, printed under the notes.
enum class Syllables : std::uint8_t { none, sargam, degrees, solfa };

/// Share of a note within `depth` brackets that sounds, if it is less in each.
inline double sounding_by_depth(int depth) {
    return std::max(0.25, 1 - 0.15 * depth);
}

/// Articulation, printed as slurs and staccato dots.
struct Touch {
    double sounding = 1;       ///< share of each note that sounds
    bool is_by_depth = false;  ///< sounding_by_depth() instead
    bool has_phrases = false;  ///< the melody has `phrases`
    double share(int depth) const { return is_by_depth ? sounding_by_depth(depth) : sounding; }
};

/// One instrument: the voices of one pattern.
struct Part {
    std::string name;
    bool has_instrument_name = false;       ///< `name` is the General MIDI name of its instrument
    std::string scale;                      ///< scale in words, with its tonic
    int program = 0;                        ///< General MIDI, 0 to 127
    int voices = 1;                         ///< at least the number that sounds; some may stay silent
    std::optional<KeySignature> key;        ///< only for major, minor and the modes
    std::optional<KeySignature> signature;  ///< in print; other scales may have one, too
    std::array<Spelling, 12> spelling{};    ///< spelling of each pitch class from C
    bool has_chords = false;                ///< notes of one onset and symbol are a chord in print
    bool is_accompaniment = false;  ///< its voices share a staff, and notes of one onset and length are a chord
    bool is_drums = false;          ///< percussion of General MIDI: keys are those of drums.h
    Swing swing{};                  ///< to be printed: the notes are written straight
    Touch touch{};                  ///< printed as slurs and dots; notes keep their full length
    double tonic = 60;              ///< MIDI key of the tonic
};

/// Contents of a score besides its notes. Voices are numbered through all parts in order.
struct ScoreHead {
    std::string title;
    std::string composer;         ///< may be empty
    std::string source;           ///< the publication that the pattern comes from; may be empty
    std::string pattern;          ///< the text of the pattern file, so that the score can be made again
    std::string made;             ///< the recipe of the score: `sikku 0.2.0, -n 4`
    double tempo = 120.0;         ///< quarters a minute
    std::string tempo_words;      ///< printed before it: `Andante`; may be empty
    std::int64_t ritardando = 0;  ///< ticks before the end in which the tempo falls to 60 %; 0: none
    Meter meter;
    std::int64_t upbeat = 0;             ///< ticks before the first bar line, less than a bar; 0: none
    std::vector<SectionChange> changes;  ///< of tempo and meter, ascending, after the beginning
    std::vector<KeyChange> keys;  ///< in MIDI: of sections, ascending, the first at 0; empty: that of the first part
    std::int64_t first_bar = 1;   ///< number of the first bar; that of an upbeat is one less
    bool is_transposed = false;   ///< print: parts of transposing instruments are written as their players read them
    Syllables syllables = Syllables::none;  ///< print: under the notes
    bool has_chord_signs = false;           ///< print: chords are named above the first staff
    bool has_graces = false;                ///< print: gamakas are grace notes
    /// Print: the largest number of times that a passage between repeat signs is played; 1: no repeat signs.
    std::size_t most_repeats = 1;
    std::vector<Part> parts;

    /// True if a section or the ritardando changes the tempo.
    bool changes_tempo() const {
        return ritardando > 0 || std::any_of(changes.begin(), changes.end(), [this](const SectionChange& change) {
                   return change.to.tempo != tempo;
               });
    }
    /// The index of the part that contains a voice; 0 if none does.
    std::size_t part_index(int voice) const {
        for (std::size_t i = 0; i < parts.size(); ++i) {
            voice -= std::max(parts[i].voices, 0);
            if (voice < 0) return i;
        }
        return 0;
    }
    const Part& part_of(int voice) const { return parts[part_index(voice)]; }
};

}  // namespace sikku
