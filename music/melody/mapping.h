// music/melody/mapping.h: turns the symbols of a word into notes.
#pragma once

#include "engine/base/integer.h"
#include "engine/derivation/derivation.h"
#include "music/melody/melody.h"
#include "music/score/score.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sikku {

struct PlayOptions {
    Integer ahead = 0;            ///< ticks of the melody before tick 0, a multiple of period(); `from` is above 2^49
    std::int64_t from = 0;        ///< ticks: the score begins here, without earlier notes
    std::int64_t to = INT64_MAX;  ///< ticks: the score ends here; notes at either end are cut
    int most_voices = 15;         ///< maximum number of voices at the same time; more are a ScoreError
    double budget = 200e6;        ///< maximum number of derivation nodes visited
    int chords_from = 0;          ///< first voice of drone or chords; 0: the one after the voices of the melody
    int drums_from = 0;           ///< added to the voices of drums, so that they belong to a part of their own
    static constexpr std::int64_t no_degree = INT64_MIN;
    std::vector<std::int64_t>* degrees = nullptr;      ///< receives the degree of each note, or no_degree
    std::vector<std::int64_t>* phrase_ends = nullptr;  ///< receives the ticks after `from` at which phrases end
    std::function<void(std::uint64_t symbols)> watch;  ///< as in DerivationOptions

    /// True if only a part of the score is played.
    bool is_excerpt() const { return ahead != 0 || from > 0 || to < INT64_MAX; }
};

/// Report about a performance.
struct PlayReport {
    std::uint64_t notes = 0;
    std::uint64_t moved = 0;  ///< notes that were beyond the keys of MIDI
    std::uint64_t lost = 0;   ///< notes shorter than a tick, or whose degree a key map leaves out
    int voices = 0;
    std::int64_t end = 0;         ///< ticks
    std::int64_t melody_end = 0;  ///< ticks, without chords that last longer
    bool past = false;            ///< the score ended before the piece began
    double lowest = 127.0;        ///< keys, without drums; above `highest` if there are only drums
    double highest = 0.0;
    std::map<std::string, std::uint64_t> skipped;  ///< symbols that neither the table nor the mapping reads
    std::vector<std::string> unused;               ///< symbols of the table that the grammar does not contain
};

/// Reads the word of `grammar` as a melody and passes its notes to `sink`, in one pass, or in two if the anchor must
/// be found and the fold does not determine it. The part before options.from is skipped without deriving it if the
/// curve lies on the square grid and has neither brackets nor contexts; otherwise it is walked. A branch begins at
/// the position and time of the turtle.
/// Memory: O(steps), and the state of open brackets. Cost: O(symbols between from and to).
/// @throws BudgetError, WordError, ScoreError, and exceptions of `sink`
/// Source: Prusinkiewicz & Hanan 1989, section 6.3; the choices it leaves open are those of Melody.
PlayReport play(const Grammar& grammar, const Melody& melody, NoteSink& sink, const PlayOptions& options);

/// The word of a melody, prepared to be played many times: shortened, with marks at the ends of phrases and
/// sub-curves, contexts resolved, and written out if it has parameters or chance.
class PlayableMelody {
public:
    /// @param melody  determines the marks, by its phrases, form, table and curves of expression
    PlayableMelody(std::shared_ptr<const Grammar> grammar, const Melody& melody);
    ~PlayableMelody();

    /// Plays the word like the function play(). @param melody  the melody given before; other keys than those that
    /// determine the marks may have changed
    PlayReport play(const Melody& melody, NoteSink& sink, const PlayOptions& options);

private:
    struct Word;
    std::shared_ptr<const Word> word(const PlayOptions& options);

    std::shared_ptr<const Grammar> grammar_;
    Melody marked_for_;
    std::shared_ptr<const Word> word_;  // the last one, unless it is large
};

/// True if the word may contain brackets.
bool has_brackets(const Grammar& grammar);

/// Explains why phrases, forms, cadences or levels of a melody cannot be played from this grammar; empty if they can.
std::string problem_of(const Grammar& grammar, const Melody& melody);

/// Number of ticks after which the bars, beats, chords and rhythm slots of a melody repeat.
Integer period(const Melody& melody);

/// Properties of a melody computed without playing it.
struct MelodyCensus {
    Integer notes = 0;        ///< number of notes, for `mapping: runs`, including those that chance silences
    bool has_chance = false;  ///< the rhythm silences notes by chance
    Integer ticks = 0;
    Integer height = 0;  ///< degrees between the lowest and the highest note of the horizontal runs
};

/// Computes them by composition, for any derivation length. Nullopt for other mappings than runs, curves off the
/// square grid, brackets and contexts, and phrases that depend on those before them.
std::optional<MelodyCensus> census(const Grammar& grammar, const Melody& melody);

/// Ranges of the runs of a curve that are notes, in turtle steps.
struct NoteBox {
    SourceRange x;
    SourceRange y;
};

/// Computes it by composition, for any derivation length. Nullopt if census() returns it, for curves with steps that
/// are not drawn, and without notes.
std::optional<NoteBox> note_box(const Grammar& grammar, const Melody& melody);

/// The smallest derivation length above that of the grammar, by at most 24, at which the melody has `phrases`
/// phrases. Nullopt if there is none or if phrases cannot be counted by composition. Cost: 24 times that of census().
std::optional<std::int64_t> smallest_steps(const Grammar& grammar, const Melody& melody, std::int64_t phrases);

}  // namespace sikku
