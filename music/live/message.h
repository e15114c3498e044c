// music/live/message.h: MIDI messages as they are sent.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>

namespace sikku::live {

constexpr std::uint8_t clock_byte = 0xF8;
constexpr std::uint8_t start_byte = 0xFA;
constexpr std::uint8_t continue_byte = 0xFB;
constexpr std::uint8_t stop_byte = 0xFC;
constexpr std::uint8_t position_byte = 0xF2;
constexpr int clocks_per_quarter = 24;

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

}  // namespace sikku::live
