#include "music/score/midi_bytes.h"

#include "music/score/mpe.h"
#include "music/score/score.h"

#include <array>
#include <cstddef>

namespace sikku::midi {

std::string delta(std::uint64_t value) {
    std::array<char, 4> bytes{};
    return {bytes.data(), put_delta(bytes.data(), value)};
}

std::string wide_delta(std::uint64_t value) {
    std::string bytes(4, '\0');
    for (int i = 0; i < 4; ++i) {
        put_byte(&bytes[static_cast<std::size_t>(i)],
                 static_cast<int>(value >> (21 - 7 * i) & 0x7F) | (i < 3 ? 0x80 : 0));
    }
    return bytes;
}

std::string big_endian(std::uint64_t value, int bytes) {
    std::string text;
    for (int i = bytes - 1; i >= 0; --i) text += static_cast<char>(value >> (8 * i) & 0xFF);
    return text;
}

std::string meta(int type, std::string_view data) {
    if (data.size() > most_delta) throw ScoreError("a text of 256 MB or more does not fit into a MIDI file");
    std::string bytes = {'\xFF', static_cast<char>(type)};
    return bytes.append(delta(data.size())).append(data);
}

std::string meta_now(int type, std::string_view data) {
    return '\0' + meta(type, data);
}

std::string controller_now(int channel, int number, int value) {
    return {'\0', static_cast<char>(status(0xB0, channel)), static_cast<char>(number), static_cast<char>(value)};
}

std::string parameter_now(int channel, int parameter, int value) {
    return controller_now(channel, 101, 0) + controller_now(channel, 100, parameter) +
           controller_now(channel, 6, value) + controller_now(channel, 38, 0);
}

std::string no_parameter_now(int channel) {
    return controller_now(channel, 101, 127) + controller_now(channel, 100, 127);
}

std::string mpe_configuration() {
    std::string bytes = parameter_now(mpe_master, mpe_parameter, mpe_members) + no_parameter_now(mpe_master);
    for (int channel = 0; channel < channels; ++channel) {
        if (!is_mpe_member(channel)) continue;
        bytes += parameter_now(channel, bend_range_parameter, mpe_bend_range) + no_parameter_now(channel);
    }
    return bytes;
}

}  // namespace sikku::midi
