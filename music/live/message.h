// music/live/message.h: messages of MIDI clocks, in addition to those of scores.
#pragma once

#include "music/score/midi_message.h"

#include <cstdint>

namespace sikku::live {

constexpr std::uint8_t clock_byte = 0xF8;
constexpr std::uint8_t start_byte = 0xFA;
constexpr std::uint8_t continue_byte = 0xFB;
constexpr std::uint8_t stop_byte = 0xFC;
constexpr std::uint8_t position_byte = 0xF2;
constexpr int clocks_per_quarter = 24;

using midi::Message;

}  // namespace sikku::live
