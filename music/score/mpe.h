// music/score/mpe.h: channels of MIDI Polyphonic Expression (MPE), in which each note has a channel of its own.
#pragma once

#include <array>
#include <cstdint>

namespace sikku {

/// Semitones of a full pitch bend on the channels of notes, as the specification recommends.
constexpr int mpe_bend_range = 48;
/// The channel of messages to all notes, counted from 0. Those of notes are 1 to 15, without the drums' channel 9,
/// which synthesizers of General MIDI do not tune.
constexpr int mpe_master = 0;
/// Number of channels of notes that the configuration message announces.
constexpr int mpe_members = 15;
/// Largest number of notes that sound at the same time.
constexpr int most_mpe_notes = 14;

/// True for the channels that notes use.
constexpr bool is_mpe_member(int channel) {
    return channel > mpe_master && channel != 9 && channel < 16;
}

/// Distributes notes among the channels: each gets the one that has been silent for longest, so that the release of
/// a note is not bent with the next one.
/// Source: MIDI Manufacturers Association 2018, MIDI Polyphonic Expression, version 1.0.
class MpeChannels {
public:
    /// Takes a channel for a note. Notes come by onset.
    /// @param end    tick; INT64_MAX if unknown: see release()
    /// @param key    a channel does not get the same key again at the tick at which it ended, unless from one voice:
    ///               in files their order would be that of the tracks
    /// @param voice  voice of the note
    /// @return channel, counted from 0; -1 if all are in use
    int take(std::int64_t onset, std::int64_t end, int key, int voice);
    /// Ends the note of a channel.
    void release(int channel, std::int64_t tick) { uses_[static_cast<std::size_t>(channel)].end = tick; }

private:
    struct Use {
        std::int64_t end = INT64_MIN;
        std::int64_t onset = INT64_MIN;
        int key = -1;
        int voice = -1;
    };
    std::array<Use, 16> uses_{};
};

}  // namespace sikku
