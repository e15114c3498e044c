#include "music/score/midi_bytes.h"

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

std::string messages_now(std::span<const Message> messages) {
    std::string bytes;
    for (const Message& message : messages) {
        bytes += '\0';
        bytes.append(message.span().begin(), message.span().end());
    }
    return bytes;
}

}  // namespace sikku::midi
