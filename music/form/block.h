// music/form/block.h: a part as a block of notes that can be reversed, put in another order, and repeated.
#pragma once

#include "music/melody/layout.h"
#include "music/melody/mapping.h"
#include "music/melody/melody.h"
#include "music/score/score.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace sikku {

/// A note with its degree above the tonic; notes of drones and chords have none.
struct FormNote {
    Note note;
    std::int64_t degree = 0;
    bool has_degree = false;
};

/// Notes of one part from its first tick, that of its upbeat if it has one.
struct Block {
    std::vector<FormNote> notes;     ///< by onset, then by voice
    std::vector<std::int64_t> ends;  ///< ticks at which sub-curves end and the next ones begin, if they are marked
    std::int64_t length = 0;         ///< ticks, rests included
    std::int64_t melody_end = 0;     ///< ticks, rests included, without chords that last longer
    int chords_from = 0;             ///< first voice of drone or chords, if there are any
    std::int64_t next = 0;           ///< tick at which more would begin, after the breath of the last sub-curve
};

/// Largest number of notes in all blocks of a score.
constexpr std::size_t most_block_notes = 4'000'000;

/// Plays a melody into a block. @throws as PlayableMelody::play(); ScoreError for too many notes
Block play_block(PlayableMelody& playable, const Melody& melody, const PlayOptions& options, PlayReport& report);

/// The tick at which the last sub-curve ends. Chords fill the last bar, in which more can begin with its upbeat.
std::int64_t end_of_sections(const Block& block, const Melody& melody);

/// Adjusts slides to the present keys of the notes that follow.
void link_glides(std::vector<FormNote>& notes);

/// Reverses time.
void reverse(Block& block);

/// Puts sub-curves in the order of the form: A is the first of the curve, B the second. In retrograde, each
/// sub-curve and their order are reversed; cadences and breaths stay at the ends of the sections. Sections begin at
/// bar lines, or with the upbeat before them, after a rest if necessary.
/// @param grammar  grammar of the block, to suggest a derivation length if sub-curves are missing
/// @param ends  ticks at which sections end, taken from another part; empty: those of the curve
/// @throws ScoreError if the curve has too few sub-curves
Block in_form(const Block& block, const Grammar& grammar, const Melody& melody, const std::vector<FormSection>& form,
              std::span<const std::int64_t> ends = {});

/// Removes notes towards the end of each phrase or section: those off the beat, and near the end those off the strong
/// beats. The note before a removed note is extended over it. Keeps the last note of each phrase, chords, and notes
/// without a degree.
/// @param share  of each phrase, at its end, above 0, at most 1; in its second half only notes on strong beats remain
void thin_out(Block& block, const Melody& melody, double share);

/// Moves phrases or sections up by degrees, so that one near a place has the highest note: that one by as little as
/// it takes, at most two periods of the scale, the others by up to half of it, the less the farther away they are.
/// @param share  of the block before that place, 0 to 1; up to a twentieth more or less
/// @throws ScoreError if the range of the melody leaves no room
void raise_to_climax(Block& block, const Melody& melody, double share);

/// Adds the drone of a melody bar by bar, and extends the block to the end of a bar.
/// @param first_voice  voice of the drone; 0: the one after the voices of the melody
void add_drone(Block& block, const Melody& melody, int first_voice);

/// Leads up to three last notes of the first voice by step to the fifth or the tonic.
void end_on(Block& block, const Melody& melody, Ending ending);

/// Multiplies all times.
void scale_times(Note& note, Ratio by);
void scale_times(Block& block, Ratio by);

/// The MIDI key of a degree, moved by periods of the scale into the range of the melody.
double key_within(const Melody& melody, std::int64_t degree, bool falling);

}  // namespace sikku
