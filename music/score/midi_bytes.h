// music/score/midi_bytes.h: the numbers and messages of MIDI files as bytes.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace sikku::midi {

/// The largest number that four bytes of seven bits can represent.
constexpr std::uint64_t most_delta = (std::uint64_t{1} << 28) - 1;
constexpr int channels = 16;
constexpr int drum_channel = 9;  ///< General MIDI, counted from 0
constexpr int centre = 8192;     ///< value without pitch bend

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
std::string controller_now(int channel, int number, int value);

constexpr int bend_range_parameter = 0;
constexpr int tuning_program_parameter = 3;
constexpr int tuning_bank_parameter = 4;
constexpr int mpe_parameter = 6;
/// A registered parameter: selects it, then sets both halves of its value.
std::string parameter_now(int channel, int parameter, int value);
/// Deselects the parameter, so that further data entry has no effect.
std::string no_parameter_now(int channel);
/// Assigns channels 2 to 16 to single notes. The range of the bend is repeated for synthesizers without MPE.
std::string mpe_configuration();

}  // namespace sikku::midi
