// music/score/midi.h: writes scores as Standard MIDI Files.
#pragma once

#include "music/score/score.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace sikku {

/// Tuning of keys with a fraction: by pitch bend of the voice's channel, which every synthesizer supports; by single
/// note tuning changes of the MIDI Tuning Standard, which leave the bend wheel alone; or by MPE (music/score/mpe.h),
/// in which each note, with a fraction or not, has a channel and a pitch bend of its own.
enum class Tuning { bend, mts, mpe };

struct MidiOptions {
    int format = 1;           ///< 1: a track for each voice; 0: all in one track
    bool microtonal = false;  ///< keys with a fraction may occur; each voice then prepares its channel
    Tuning tuning = Tuning::bend;
    int bend_range = 2;  ///< semitones of a full bend, 1 to 24; with MPE it is 48
    /// Voices of a part share its channel, so there may be more than 15; with more than 15 parts, some of those of an
    /// instrument share one: see channel_slots(). Only without microtones; notes on one key of a channel must not
    /// overlap: see UnisonMerger.
    bool share_channels = false;
};

/// Channel slot of each part, counted from 0, if voices share channels: each part has its own or, with more than 15
/// parts, the last ones share that of the first part of their instrument. Slots of drums are unused.
/// @throws ScoreError for more than 15 instruments
std::vector<int> channel_slots(const ScoreHead& head);

/// Writes a Standard MIDI File of 480 ticks a quarter; the same notes give the same bytes.
///
/// The first track contains title, pattern (first text), `made` (second text), tempo, meter and key; then comes a
/// track for each voice that has notes, by number. Tracks are named as in print (labels.h), so those of one part are
/// numbered. Every track ends with the score, except that the first ends by tick 2^28 - 1. At one tick the order is:
/// meta, controllers, program, note-offs, tuning, note-ons. Running status is not used, and note-offs are written as
/// such. In format 0 the names of voices are instrument names. Drums share channel 10. Other voices keep channels of
/// their own: by number if the head counts at most 15 voices, else as they come. Fractions of a key up to half a cent
/// are ignored. With MPE the first track contains the configuration, and a program comes before a note where that of
/// its channel differs.
///
/// Pan, controllers and bends of NoteSink::curves() and controls() are messages on the channel of their voice, with
/// MPE on that of the sounding note.
///
/// A glide is a series of bends of its note (see glide_points()); it needs `microtonal` with Tuning::bend, or MPE. A
/// glide that leaves the bend range restrikes the key it has reached.
///
/// Cost: in format 1 voice 0 goes to the sink in blocks, and the bytes of others stay in memory until finish(); in
/// format 0 those of all voices do, with MPE all notes. @throws ScoreError, here for a tempo, meter, key, program or
/// bend range that a file cannot contain, and later from notes() and finish(): for more than 15 voices other than
/// drums (or instruments, if channels are shared), or with MPE more than 14 notes at the same time, a voice without a
/// part, notes that overlap or lack a length, key or velocity, a fraction without `microtonal`, a rest or note above
/// 2^28 - 1 ticks, a track above 4 GB, an end before the last note's. `head` and `sink` have to outlive the writer.
std::unique_ptr<NoteSink> write_midi(const ScoreHead& head, Output& sink, const MidiOptions& options = {});

}  // namespace sikku
