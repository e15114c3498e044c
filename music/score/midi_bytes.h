// music/score/midi_bytes.h: the numbers and messages of MIDI files as bytes.
#pragma once

#include "music/score/midi_message.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace sikku::midi {

/// The largest number that four bytes of seven bits can represent.
constexpr std::uint64_t most_delta = (std::uint64_t{1} << 28) - 1;

inline char* put_byte(char* out, int byte) {
    *out = static_cast<char>(byte);
    return out + 1;
}

/// A variable-length number: seven bits a byte, the highest first; all but the last byte have bit 7 set.
inline char* put_delta(char* out, std::uint64_t value) {
    const auto seven = [value](int shift) { return static_cast<int>(value >> shift & 0x7F); };
    if (value >= 0x80) {
        if (value >= 0x4000) {
            if (value >= 0x200000) out = put_byte(out, 0x80 | seven(21));
            out = put_byte(out, 0x80 | seven(14));
        }
        out = put_byte(out, 0x80 | seven(7));
    }
    return put_byte(out, seven(0));
}

/// put_delta() as text. @param value  at most most_delta
std::string delta(std::uint64_t value);
/// Like delta(), but always four bytes: leading zeros are legal, if wasteful.
std::string wide_delta(std::uint64_t value);
std::string big_endian(std::uint64_t value, int bytes);

/// The first byte of a channel message.
constexpr int status(int kind, int channel) {
    return kind | channel;
}

constexpr int text_type = 0x01;
constexpr int name_type = 0x03;
constexpr int instrument_type = 0x04;
constexpr int end_type = 0x2F;
constexpr int tempo_type = 0x51;
constexpr int meter_type = 0x58;
constexpr int key_type = 0x59;

/// A meta event without its delta. @throws ScoreError for 256 MB or more
std::string meta(int type, std::string_view data);
/// A meta event at the tick of the event before it.
std::string meta_now(int type, std::string_view data);
/// Messages at the tick of the event before them.
std::string messages_now(std::span<const Message> messages);

}  // namespace sikku::midi
