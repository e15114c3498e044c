// music/live/voices.h: notes of a score as MIDI messages, in the order of time.
#pragma once

#include "music/live/message.h"
#include "music/score/curves.h"
#include "music/score/midi.h"
#include "music/score/mpe.h"
#include "music/score/score.h"

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace sikku::live {

/// Tracks which notes sound on which channels. Each voice has one note at a time. Messages are the same as in MIDI
/// files: see write_midi().
class Voices {
public:
    /// @param head  has to outlive this object
    Voices(const ScoreHead& head, const MidiOptions& midi);

    /// Prepares channels before the first note: programs, bend ranges, MPE.
    void prepare(std::vector<Message>& messages) const;
    /// Begins a note; ends the one that still sounds in its voice.
    void begin(const Note& note, std::int64_t tick, std::vector<Message>& messages);
    /// Changes a controller, or bends the sounding note of the voice, as files do. With MPE, controllers apply to the
    /// channel of the note, and then to those of the notes after it.
    void control(const ControlPoint& point, std::vector<Message>& messages);
    /// Bends the sounding note of the voice to a key, as files do.
    void slide(int voice, double key, std::int64_t tick, std::vector<Message>& messages);
    /// Ends the note of a voice, if one sounds.
    void end(int voice, std::int64_t tick, std::vector<Message>& messages);
    /// Ends all notes, and repeats this with the message for all notes of a channel; centres bends.
    void silence(std::int64_t tick, std::vector<Message>& messages);

    /// Number of sounding notes.
    std::size_t sounding() const { return order_.size(); }

private:
    struct Sounding {
        int channel = -1;
        int key = 0;
        double fraction = 0;
        std::uint8_t velocity = 80;
    };
    int channel_of(int voice) const;
    bool bends_notes() const { return is_mpe_ || (midi_.microtonal && midi_.tuning == Tuning::bend); }
    void tune(int channel, int key, double fraction, std::vector<Message>& messages);
    void set_controllers(int voice, int channel, std::vector<Message>& messages);

    const ScoreHead& head_;
    MidiOptions midi_;
    bool is_mpe_;
    int bend_range_;
    std::vector<int> channels_;  // by voice
    int voice_count_ = 0;
    std::vector<Sounding> sounding_;           // by voice
    std::vector<std::map<int, int>> values_;   // controllers by voice, with MPE
    std::array<std::map<int, int>, 16> sent_;  // the same by channel
    std::vector<int> order_;                   // sounding voices, the oldest first
    struct Key {
        int notes = 0;
        std::int64_t since = -1;
    };
    std::array<std::array<Key, 128>, 16> keys_{};
    MpeChannels mpe_;
    std::array<int, 16> programs_{};
    std::array<int, 16> bends_{};
    std::array<bool, 16> is_used_{};
    std::vector<std::array<std::uint32_t, 128>> tuned_;  // by channel
};

}  // namespace sikku::live
