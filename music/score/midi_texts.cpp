#include "music/score/midi_texts.h"

#include "engine/base/input_file.h"
#include "engine/language/pattern.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace sikku {
namespace {

/// Reads bytes in order; throws at their end.
class Reader {
public:
    explicit Reader(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

    bool is_at_end() const { return rest_.empty(); }
    std::span<const std::uint8_t> take(std::size_t count) {
        if (count > rest_.size()) throw std::runtime_error("is damaged or truncated");
        const auto taken = rest_.first(count);
        rest_ = rest_.subspan(count);
        return taken;
    }
    std::uint8_t byte() { return take(1).front(); }
    std::uint32_t big_endian(std::size_t count) {
        std::uint32_t value = 0;
        for (const std::uint8_t each : take(count)) value = value << 8 | each;
        return value;
    }
    /// Reads a number of seven bits a byte, at most four bytes.
    std::uint32_t number() {
        std::uint32_t value = 0;
        for (int i = 0; i < 4; ++i) {
            const std::uint8_t each = byte();
            value = value << 7 | (each & 0x7F);
            if (each < 0x80) return value;
        }
        throw std::runtime_error("is damaged or truncated");
    }
    bool begins_with(std::string_view text) const {
        return text.size() <= rest_.size() &&
               std::equal(text.begin(), text.end(), rest_.begin(),
                          [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
    }

private:
    std::span<const std::uint8_t> rest_;
};

std::string text_of(std::span<const std::uint8_t> data) {
    if (data.size() > most_pattern_bytes) {
        throw std::runtime_error("contains a text of more than 64 MB, the limit for patterns");
    }
    return {data.begin(), data.end()};
}

}  // namespace

MidiTexts read_midi_texts(std::span<const std::uint8_t> bytes) {
    MidiTexts found;
    Reader reader(bytes);
    // Other chunks may come before the first track.
    while (!reader.begins_with("MTrk")) {
        reader.take(4);
        reader.take(reader.big_endian(4));
        if (reader.is_at_end()) return found;
    }
    reader.take(8);  // a wrong length matters only to check_midi()
    int texts = 0;
    for (int running = 0; texts < 2;) {
        reader.number();  // the delta
        const int first = reader.byte();
        const int status = first < 0x80 ? running : first;
        const std::size_t data_taken = first < 0x80 ? 1 : 0;
        if (status < 0x80) throw std::runtime_error("is damaged or truncated");
        if (status < 0xF0) {
            running = status;
            reader.take((status >= 0xC0 && status < 0xE0 ? 1 : 2) - data_taken);
            continue;
        }
        constexpr int meta = 0xFF, text_type = 0x01, end_of_track = 0x2F;
        const int type = status == meta ? reader.byte() : -1;
        if (type == end_of_track) break;
        const auto data = reader.take(reader.number());
        if (type == text_type) (texts++ == 0 ? found.pattern : found.made) = text_of(data);
    }
    return found;
}

bool is_midi_file(const std::filesystem::path& file) {
    try {
        return InputFile(file).read(0, 4) == "MThd";
    } catch (const std::system_error&) {
        return false;
    }
}

std::optional<MidiTexts> read_midi_file_texts(const std::filesystem::path& file) {
    if (!is_midi_file(file)) return std::nullopt;
    // The texts come first; the data around them are small.
    constexpr std::size_t most_bytes = most_pattern_bytes + (std::size_t{2} << 20);
    const std::string bytes = InputFile(file).read(0, most_bytes);
    std::optional<MidiTexts> found;
    try {
        found = read_midi_texts({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(file.string() + ": this MIDI file " + error.what());
    }
    if (found->pattern.empty()) throw std::runtime_error(file.string() + ": this MIDI file contains no pattern");
    return found;
}

}  // namespace sikku
