// music/score/midi_message.h: MIDI messages, which files store and ports send.
#pragma once

#include "music/score/midi.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <vector>

namespace sikku::midi {

constexpr int channels = 16;
constexpr int drum_channel = 9;  ///< General MIDI, counted from 0
constexpr std::size_t most_pitched_channels = channels - 1;
constexpr int centre = 8192;  ///< value without pitch bend
constexpr int release = 64;   ///< the velocity of a note-off that does not matter
/// Half a cent, which is inaudible, and a margin, as cents are not exact in binary.
constexpr double least_fraction = 0.005 + 1e-9;

/// A MIDI message of up to 12 bytes: those of channels, of clocks, and single note tuning changes.
struct Message {
    std::array<std::uint8_t, 12> bytes{};
    std::uint8_t size = 0;

    Message() = default;
    Message(std::initializer_list<int> values) : size(static_cast<std::uint8_t>(values.size())) {
        std::transform(values.begin(), values.end(), bytes.begin(),
                       [](int value) { return static_cast<std::uint8_t>(value); });
    }
    std::span<const std::uint8_t> span() const { return {bytes.data(), size}; }
    /// The first byte without its channel, such as 0x90; whole for messages without a channel.
    int kind() const { return bytes[0] < 0xF0 ? bytes[0] & 0xF0 : bytes[0]; }
    int channel() const { return bytes[0] & 0x0F; }
    bool operator==(const Message&) const = default;
};

inline Message controller(int channel, int number, int value) {
    return {0xB0 | channel, number, value};
}

/// A single note tuning change in real time, to all devices: a key of the channel's tuning program sounds at a pitch
/// in 2^-14 semitones.
Message key_tuning(int channel, int key, std::uint32_t pitch);

/// Messages that a channel needs before its first note, except with MPE: the range of its bend or its tuning program,
/// and the program. Each channel has a tuning program of its own, so that voices do not retune each other's keys.
std::vector<Message> channel_setup(int channel, const MidiOptions& options, int program);

/// Messages that assign channels 2 to 16 to single notes. The range of the bend is repeated for synthesizers without
/// MPE.
std::vector<Message> mpe_setup();

}  // namespace sikku::midi
