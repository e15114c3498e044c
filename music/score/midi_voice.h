// music/score/midi_voice.h: the track of one voice of a MIDI file, while it is written.
#pragma once

#include "music/score/curves.h"
#include "music/score/midi_bytes.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sikku::midi {

constexpr std::size_t block_bytes = std::size_t{1} << 16;
/// Bytes that a note may need, including a tuning before it.
constexpr std::size_t note_room = 14 + 14;

/// The melody of one channel as the bytes of a track.
struct Voice {
    int number = 0;
    int channel = 0;
    bool is_drums = false;
    int program = 0;
    std::int64_t now = 0;  ///< the tick of the last event
    int bend = centre;
    bool has_new_program = false;            ///< with MPE: the program is to be sent before the next note
    std::span<const ControlPoint> controls;  ///< controls still to come
    std::vector<ControlPoint> own_controls;  ///< those of NoteSink::controls()
    std::map<int, int> values;               ///< present values of controllers, with MPE
    std::vector<std::uint32_t> tuned;        ///< pitch of each key, with MTS, in 1/2^14 semitones
    std::vector<std::string> full;           ///< filled blocks that are not in the sink
    std::uint64_t full_bytes = 0;            ///< size of all of them
    std::unique_ptr<char[]> block = std::make_unique<char[]>(block_bytes);
    char* out = block.get();

    const char* last_start() const { return block.get() + block_bytes - note_room; }
    std::string_view open_block() const { return {block.get(), static_cast<std::size_t>(out - block.get())}; }
    std::uint64_t bytes() const { return full_bytes + open_block().size(); }
};

/// True for a note whose pitch slides.
inline bool has_glide(const Note& note) {
    return note.glide.semitones != 0;
}

/// Reports the fault of a note. @param now  tick at which the note before it ends. @throws ScoreError always
[[noreturn]] void refuse_note(const Voice& voice, std::int64_t now, const Note& note);

/// Writes a single note tuning change, if the key needs one. @param fraction  of a semitone, -0.5 to 0.5
char* retune(Voice& voice, char* out, std::uint64_t rest, int key, double fraction);

/// Iterates over the events of a voice; supports only those that the writer writes.
class Events {
public:
    /// @param opening  bytes before the events of the voice; both have to outlive this
    Events(const Voice& voice, std::string_view opening);

    bool done() const { return event_.empty(); }
    std::int64_t tick() const { return tick_; }
    /// Sort key of the events of all voices.
    std::int64_t place() const;
    std::string_view event() const { return event_; }

    void next();

private:
    std::uint64_t number();

    std::vector<std::string_view> pieces_;
    std::size_t piece_ = 0;
    std::string_view rest_;   // rest of the piece
    std::string_view event_;  // without its delta
    std::int64_t tick_ = 0;
};

}  // namespace sikku::midi
