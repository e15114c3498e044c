// tests/midi_reader.h: a reader of MIDI files for tests, independent of what writes and checks them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace sikku {

/// One event.
struct MidiEvent {
    int track = 0;          ///< counted from 0
    std::int64_t tick = 0;  ///< from the beginning
    std::uint64_t at = 0;   ///< the byte where it begins, after its delta
    int status = 0;         ///< 0x80 to 0xEF with the channel, 0xF0, 0xF7 or 0xFF (meta)
    int type = -1;          ///< of a meta event
    std::string data;       ///< without status, type and length
    bool operator==(const MidiEvent&) const = default;
};

/// A note as it sounds.
struct MidiNote {
    std::int64_t onset = 0;
    std::int64_t duration = 0;
    int key = 0;
    double bend = 0.0;  ///< semitones above the key: pitch bend in its range, single note tunings
    int velocity = 0;
    int channel = 0;  ///< counted from 0
    int track = 0;
};

struct MidiFile {
    int format = 0;
    int division = 0;                ///< ticks a quarter; negative: of SMPTE, as in the file
    int declared_tracks = 0;         ///< in the header
    std::vector<MidiEvent> events;   ///< track after track, end-of-tracks too
    std::vector<std::int64_t> ends;  ///< tick of the end of each track
    std::vector<MidiNote> notes;     ///< by onset, then channel, then key
    std::string title;               ///< the name of the first track
    std::string pattern;             ///< its first text
    std::string made;                ///< its second text
};

constexpr int midi_any_program = -1;

/// What controllers, bends and tunings make of a channel.
struct MidiChannel {
    int parameter = -1;  ///< the registered parameter that data entry sets; -1: none
    int parameter_high = 0x7F;
    int parameter_low = 0x7F;
    double bend_range = 2.0;
    int bend = 0;  ///< -8192 to 8191
    int tuning = midi_any_program;
};

/// Turns events into notes.
class MidiNotes {
public:
    std::vector<MidiNote> read(const std::vector<MidiEvent>& events) {
        std::vector<const MidiEvent*> order;
        order.reserve(events.size());
        for (const MidiEvent& event : events) order.push_back(&event);
        std::stable_sort(order.begin(), order.end(),
                         [](const MidiEvent* a, const MidiEvent* b) { return a->tick < b->tick; });
        for (const MidiEvent* event : order) read(*event);
        std::stable_sort(notes_.begin(), notes_.end(), [](const MidiNote& a, const MidiNote& b) {
            return std::tie(a.onset, a.channel, a.key) < std::tie(b.onset, b.channel, b.key);
        });
        return std::move(notes_);
    }

private:
    static int byte(const MidiEvent& event, std::size_t i) { return static_cast<unsigned char>(event.data[i]); }

    void read(const MidiEvent& event) {
        if (event.status == 0xF0) return tune(event);
        if (event.status >= 0xF0) return;
        MidiChannel& channel = channels_[static_cast<std::size_t>(event.status & 0x0F)];
        switch (event.status & 0xF0) {
            case 0x90:
                if (byte(event, 1) > 0) return begin(event, channel);
                [[fallthrough]];
            case 0x80:
                return end(event);
            case 0xB0:
                return control(channel, byte(event, 0), byte(event, 1));
            case 0xE0:
                channel.bend = (byte(event, 1) << 7 | byte(event, 0)) - 8192;
                return;
            default:
                return;
        }
    }

    static void control(MidiChannel& channel, int number, int value) {
        if (number == 101) channel.parameter_high = value;
        if (number == 100) channel.parameter_low = value;
        if (channel.parameter_high != 0) return;
        if (number == 6 && channel.parameter_low == 0) channel.bend_range = value;
        if (number == 38 && channel.parameter_low == 0) {
            channel.bend_range = static_cast<int>(channel.bend_range) + value / 100.0;
        }
        if (number == 6 && channel.parameter_low == 3) channel.tuning = value;
    }

    /// Single note tuning changes: F0 7F device 08 02 program count [key, semitones, fraction] F7.
    void tune(const MidiEvent& event) {
        const auto& data = event.data;
        if (data.size() < 6 || byte(event, 0) != 0x7F || byte(event, 2) != 8 || byte(event, 3) != 2) return;
        const int count = byte(event, 5);
        for (int i = 0; i < count && data.size() >= static_cast<std::size_t>(10 + 4 * i); ++i) {
            const auto at = static_cast<std::size_t>(6 + 4 * i);
            const double pitch = byte(event, at + 1) + (byte(event, at + 2) * 128 + byte(event, at + 3)) / 16384.0;
            tunings_[{byte(event, 4), byte(event, at)}] = pitch;
        }
    }

    void begin(const MidiEvent& event, const MidiChannel& channel) {
        MidiNote note{.onset = event.tick,
                      .key = byte(event, 0),
                      .bend = channel.bend * channel.bend_range / 8192.0,
                      .velocity = byte(event, 1),
                      .channel = event.status & 0x0F,
                      .track = event.track};
        if (const auto found = tunings_.find({channel.tuning, note.key}); found != tunings_.end()) {
            note.bend += found->second - note.key;
        }
        sounding_[{event.track, note.channel, note.key}].push_back(note);
    }

    /// The first that began ends first.
    void end(const MidiEvent& event) {
        const auto found = sounding_.find({event.track, event.status & 0x0F, byte(event, 0)});
        if (found == sounding_.end()) return;
        MidiNote note = found->second.front();
        found->second.pop_front();
        if (found->second.empty()) sounding_.erase(found);
        note.duration = event.tick - note.onset;
        notes_.push_back(note);
    }

    std::array<MidiChannel, 16> channels_;
    std::map<std::pair<int, int>, double> tunings_;  // of program and key
    std::map<std::tuple<int, int, int>, std::deque<MidiNote>> sounding_;
    std::vector<MidiNote> notes_;
};

/// Splits a file that check_midi() finds no fault with into events.
class MidiEvents {
public:
    explicit MidiEvents(std::string_view bytes) : bytes_(bytes) {}

    MidiFile read() {
        MidiFile file;
        if (!bytes_.starts_with("MThd")) return file;
        at_ = 4;
        const std::size_t next = 8 + big_endian(4);
        file.format = static_cast<int>(big_endian(2));
        file.declared_tracks = static_cast<int>(big_endian(2));
        file.division = static_cast<std::int16_t>(big_endian(2));
        for (at_ = next; at_ + 8 <= bytes_.size();) {
            const std::string_view kind = bytes_.substr(at_, 4);
            at_ += 4;
            const std::size_t length = big_endian(4);
            const std::size_t end = std::min(at_ + length, bytes_.size());
            if (kind == "MTrk") read_track(file, end);
            at_ = end;
        }
        return file;
    }

private:
    std::uint32_t big_endian(int count) {
        std::uint32_t value = 0;
        for (; count > 0; --count) value = value << 8 | static_cast<std::uint32_t>(byte());
        return value;
    }
    /// 0 beyond the end.
    int byte() { return at_ < bytes_.size() ? static_cast<unsigned char>(bytes_[at_++]) : 0; }
    std::uint32_t number() {
        std::uint32_t value = 0;
        for (;;) {
            const int each = byte();
            value = value << 7 | static_cast<std::uint32_t>(each & 0x7F);
            if (each < 0x80) return value;
        }
    }

    void read_track(MidiFile& file, std::size_t end) {
        std::int64_t tick = 0;
        for (int running = 0; at_ < end;) {
            tick += number();
            MidiEvent event;
            event.track = static_cast<int>(file.ends.size());
            event.tick = tick;
            event.at = at_;
            event.status = byte();
            if (event.status < 0x80) {
                event.status = running;
                --at_;
            }
            std::size_t size = 0;
            if (event.status >= 0xF0) {
                if (event.status == 0xFF) event.type = byte();
                size = number();
            } else {
                running = event.status;
                const int kind = event.status & 0xF0;
                size = kind == 0xC0 || kind == 0xD0 ? 1 : 2;
            }
            if (at_ > end || size > end - at_) break;  // cut off
            event.data = bytes_.substr(at_, size);
            at_ += size;
            file.events.push_back(std::move(event));
        }
        file.ends.push_back(tick);
    }

    std::string_view bytes_;
    std::size_t at_ = 0;
};

/// What a MIDI file holds; notes that do not end are left out.
inline MidiFile read_midi(std::string_view bytes) {
    MidiFile file = MidiEvents(bytes).read();
    file.notes = MidiNotes().read(file.events);
    int texts = 0;
    for (const MidiEvent& event : file.events) {
        if (event.track != 0) break;
        if (event.type == 3 && file.title.empty()) file.title = event.data;
        if (event.type == 1 && ++texts <= 2) (texts == 1 ? file.pattern : file.made) = event.data;
    }
    return file;
}

}  // namespace sikku
