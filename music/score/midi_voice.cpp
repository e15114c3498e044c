#include "music/score/midi_voice.h"

#include <fmt/format.h>

#include <array>
#include <cmath>

namespace sikku::midi {
namespace {

/// The order of events of one tick in the file.
int rank(unsigned char status) {
    // By kind: controllers, program, note-offs, bends, note-ons; others come first, except tunings.
    static constexpr std::array<int, 16> ranks = {0, 0, 0, 0, 0, 0, 0, 0, 3, 5, 0, 1, 2, 0, 4, 0};
    return status == 0xF0 ? 4 : ranks[status >> 4];
}

}  // namespace

Events::Events(const Voice& voice, std::string_view opening) {
    pieces_.push_back(opening);
    pieces_.insert(pieces_.end(), voice.full.begin(), voice.full.end());
    pieces_.push_back(voice.open_block());
    next();
}

std::int64_t Events::place() const {
    return tick_ * 8 + rank(static_cast<unsigned char>(event_.front()));
}

void Events::next() {
    event_ = {};
    while (rest_.empty()) {
        if (piece_ == pieces_.size()) return;
        rest_ = pieces_[piece_++];
    }
    tick_ += static_cast<std::int64_t>(number());
    const auto first = static_cast<unsigned char>(rest_.front());
    std::size_t size = (first & 0xF0) == 0xC0 ? 2 : 3;
    if (first >= 0xF0) {
        const std::string_view whole = rest_;
        rest_.remove_prefix(first == 0xFF ? 2 : 1);
        const auto data = static_cast<std::size_t>(number());
        size = whole.size() - rest_.size() + data;
        rest_ = whole;
    }
    event_ = rest_.substr(0, size);
    rest_.remove_prefix(size);
}

std::uint64_t Events::number() {
    std::uint64_t value = 0;
    for (;;) {
        const auto byte = static_cast<unsigned char>(rest_.front());
        rest_.remove_prefix(1);
        value = value << 7 | (byte & 0x7F);
        if (byte < 0x80) return value;
    }
}

void refuse_note(const Voice& voice, std::int64_t now, const Note& note) {
    const std::string where = fmt::format("voice {}, tick {}: ", voice.number + 1, note.onset);
    if (note.onset < 0) throw ScoreError(where + "a note before the beginning of the score");
    if (note.duration <= 0) throw ScoreError(where + fmt::format("a note of {} ticks", note.duration));
    if (note.onset < now) throw ScoreError(where + fmt::format("a note before the last one ends at {}", now));
    if (!(note.key >= 0.0 && note.key <= 127.0)) {
        throw ScoreError(where + fmt::format("key {} is not within 0 to 127", note.key));
    }
    if (note.velocity < 1 || note.velocity > 127) {
        throw ScoreError(where + fmt::format("velocity {} is not within 1 to 127", note.velocity));
    }
    const bool is_long = static_cast<std::uint64_t>(note.duration) > most_delta;
    if (is_long || static_cast<std::uint64_t>(note.onset - now) > most_delta) {
        throw ScoreError(where + fmt::format("a {} of {} ticks; a MIDI file can tell up to {}",
                                             is_long ? "note" : "rest before it",
                                             is_long ? note.duration : note.onset - now, most_delta));
    }
    if (has_glide(note)) throw ScoreError(where + "the note slides, which needs pitch bends of microtones");
    throw ScoreError(where + fmt::format("key {} has a fraction, but no microtones were announced", note.key));
}

char* retune(Voice& voice, char* out, std::uint64_t rest, int key, double fraction) {
    const auto wanted = static_cast<std::uint32_t>(std::lround((key + fraction) * 0x1p14));
    std::uint32_t& tuned = voice.tuned[static_cast<std::size_t>(key)];
    if (wanted == tuned) return out;
    tuned = wanted;
    out = put_delta(out, rest);
    const Message message = key_tuning(voice.channel, key, wanted);
    // In files the number of the bytes that follow stands behind the first.
    out = put_byte(put_byte(out, message.bytes[0]), message.size - 1);
    for (const std::uint8_t byte : message.span().subspan(1)) out = put_byte(out, byte);
    return out;
}

}  // namespace sikku::midi
