#include "music/score/midi_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <string_view>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t header_bytes = 14;
constexpr std::size_t chunk_head_bytes = 8;
constexpr int default_tempo = 500'000;  // microseconds a quarter, if a file does not state it
constexpr std::size_t no_fault = std::numeric_limits<std::size_t>::max();

constexpr int end_of_track = 0x2F;
constexpr int tempo_type = 0x51;

/// Data bytes of a channel message.
std::size_t data_bytes(int status) {
    const int kind = status & 0xF0;
    return kind == 0xC0 || kind == 0xD0 ? 1 : 2;
}

/// `1 byte`, `2 bytes`
std::string bytes_of(std::uint64_t count) {
    return fmt::format("{} byte{}", count, count == 1 ? "" : "s");
}

/// `channel 1, key 60`
std::string name_of(int channel, int key) {
    return fmt::format("channel {}, key {}", channel + 1, key);
}

/// Sizes of meta events in the standard.
struct MetaForm {
    int type;
    std::size_t size;
    std::string_view name;
};

constexpr std::array<MetaForm, 7> meta_forms = {{{0x20, 1, "channel prefix"},
                                                 {0x21, 1, "port"},
                                                 {end_of_track, 0, "end-of-track"},
                                                 {tempo_type, 3, "tempo"},
                                                 {0x54, 5, "SMPTE offset"},
                                                 {0x58, 4, "time signature"},
                                                 {0x59, 2, "key signature"}}};

/// One event as it lies in the file.
struct Layout {
    std::uint64_t delta = 0;
    std::size_t delta_bytes = 0;
    std::size_t at = 0;  ///< its status, or the first data byte under running status
    int status = 0;      ///< 0 if running status lacks a status
    bool is_running = false;
    int type = -1;                 ///< type of a meta event
    std::size_t length_bytes = 0;  ///< bytes of the length of a meta or sysex event
    std::size_t length_at = 0;
    std::size_t data = 0;
    std::size_t size = 0;
    std::size_t next = 0;
};

/// A note-on that waits for its note-off.
struct Start {
    std::int64_t tick = 0;
    std::size_t at = 0;
    std::size_t fault = no_fault;  ///< index of the fault that its key sounded already
};

/// The note-ons of a key that have no note-off yet; the first is ended first.
struct Sounding {
    std::vector<Start> starts;
    std::size_t first = 0;

    bool empty() const { return first == starts.size(); }
    Start take() {
        const Start start = starts[first++];
        if (empty()) clear();
        return start;
    }
    void clear() {
        starts.clear();
        first = 0;
    }
};

struct TrackState {
    int number = 0;               ///< counted from 1
    std::size_t head = 0;         ///< beginning of the chunk
    std::size_t at = 0;           ///< the next event
    std::size_t end = 0;          ///< end of the chunk by its head, possibly beyond the file
    std::size_t limit = 0;        ///< where reading stops
    std::int64_t tick = 0;        ///< tick of the last event
    int running = 0;              ///< the status that data bytes belong to; 0 if there is none
    int last_channel_status = 0;  ///< kept after meta and sysex events
    bool sysex_is_open = false;   ///< the last F0 was not ended by an F7
    std::size_t sysex_at = 0;     ///< beginning of that message
    std::int64_t sysex_tick = 0;  ///< its tick
    bool has_begun = false;       ///< a channel or sysex event was seen
    bool ended = false;           ///< the end-of-track was seen
    bool is_extended = false;     ///< it continued after the end that its head states
    bool is_readable = true;      ///< it could be read up to its end
    bool told_second_end = false;
    bool told_events_after_end = false;
    std::size_t sounding = 0;  ///< notes that have not ended
};

/// Reads a file once and finds its faults.
class Walk {
public:
    explicit Walk(std::span<const std::uint8_t> bytes) : bytes_(bytes), sounding_(std::size_t{16} * 128) {}

    std::vector<MidiFault> run() {
        if (read_header()) {
            read_chunks();
            if (!is_full()) check_tracks();
        }
        std::stable_sort(faults_.begin(), faults_.end(),
                         [](const MidiFault& a, const MidiFault& b) { return a.at < b.at; });
        return std::move(faults_);
    }

private:
    bool is_full() const { return faults_.size() == most_midi_faults; }

    /// Adds a fault. @return false
    template <class... Values>
    bool fault(std::size_t at, fmt::format_string<Values...> what, Values&&... values) {
        if (!is_full()) faults_.push_back({at, fmt::format(what, std::forward<Values>(values)...)});
        return false;
    }
    /// Adds what the format permits, but few programs expect.
    template <class... Values>
    void remark(std::size_t at, fmt::format_string<Values...> what, Values&&... values) {
        if (is_full()) return;
        faults_.push_back({at, fmt::format(what, std::forward<Values>(values)...), true});
    }
    template <class... Values>
    void fault(const TrackState& track, std::size_t at, fmt::format_string<Values...> what, Values&&... values) {
        fault(at, "track {}, tick {}: {}", track.number, track.tick,
              fmt::format(what, std::forward<Values>(values)...));
    }

    std::size_t size() const { return bytes_.size(); }
    std::uint32_t big_endian(std::size_t at, std::size_t count) const {
        std::uint32_t value = 0;
        for (const std::uint8_t byte : bytes_.subspan(at, count)) value = value << 8 | byte;
        return value;
    }
    bool has(std::size_t at, std::string_view text) const {
        return at <= size() && text.size() <= size() - at &&
               std::equal(text.begin(), text.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(at),
                          [](char a, std::uint8_t b) { return static_cast<std::uint8_t>(a) == b; });
    }

    /// True if a chunk may begin here: four letters and a length that fits into the file. A track may have any
    /// length.
    bool is_chunk(std::size_t at) const {
        if (at > size() || size() - at < chunk_head_bytes) return false;
        if (has(at, "MTrk")) return true;
        const auto kind = bytes_.subspan(at, 4);
        return std::all_of(kind.begin(), kind.end(), [](std::uint8_t byte) { return byte >= 0x20 && byte < 0x7F; }) &&
               big_endian(at + 4, 4) <= size() - at - chunk_head_bytes;
    }

    /// The beginning of the next track, or the end of the file.
    std::size_t next_track(std::size_t at) const {
        constexpr std::string_view kind = "MTrk";
        const auto found = std::search(bytes_.begin() + static_cast<std::ptrdiff_t>(std::min(at, size())),
                                       bytes_.end(), kind.begin(), kind.end());
        return static_cast<std::size_t>(found - bytes_.begin());
    }

    /// False if nothing can be read after it.
    bool read_header() {
        if (size() == 0) return fault(0, "this is not a MIDI file: it is empty");
        if (!has(0, "MThd")) {
            return fault(0, "{}",
                         has(0, "RIFF") ? "this is a RIFF file, not a MIDI file, though it may contain one"
                                        : "this is not a MIDI file: it does not begin with MThd");
        }
        if (size() < header_bytes) return fault(size(), "header: the file ends within it");
        const std::uint32_t length = big_endian(4, 4);
        if (length < 6) return fault(4, "header: a length of {}, but 6 are needed", bytes_of(length));
        if (length > size() - chunk_head_bytes) {
            return fault(4, "header: a length of {}, but the file ends after {}", bytes_of(length),
                         size() - chunk_head_bytes);
        }
        const auto format = static_cast<int>(big_endian(8, 2));
        format_ = format;
        declared_ = static_cast<int>(big_endian(10, 2));
        division_ = static_cast<int>(big_endian(12, 2));
        if (division_ >= 0x8000) division_ -= 0x10000;
        if (format > 2) {
            fault(8, "header: format {}, but there are only 0, 1 and 2", format);
        } else if (format == 2) {
            remark(8, "header: format 2, tracks that are pieces of their own, which few programs read");
        } else if (format == 0 && declared_ > 1) {
            fault(8, "header: format 0 has one track, and not {}", declared_);
        }
        if (declared_ == 0) fault(10, "header: it declares no tracks");
        check_division();
        at_ = chunk_head_bytes + length;
        return true;
    }

    void check_division() {
        if (division_ > 0) return;
        if (division_ == 0) {
            fault(12, "header: a division of 0 ticks a quarter");
            return;
        }
        const int frames = -(division_ >> 8);
        if (frames != 24 && frames != 25 && frames != 29 && frames != 30) {
            fault(12,
                  "header: a division of {} SMPTE frames a second, but there are only 24, 25, 29 "
                  "(for 29.97) and 30",
                  frames);
        }
        if ((division_ & 0xFF) == 0) fault(13, "header: a division of 0 ticks a SMPTE frame");
    }

    void read_chunks() {
        while (at_ < size() && !is_full()) {
            if (has(at_, "MTrk") && is_chunk(at_)) {
                read_track();
            } else if (is_chunk(at_)) {
                if (has(at_, "MThd")) {
                    fault(at_, "a second header: a file has one");
                    format_ = -1;  // its tracks are those of another file
                }
                at_ += chunk_head_bytes + big_endian(at_ + 4, 4);
            } else {
                const std::size_t next = next_track(at_ + 1);
                fault(at_, "{}: {} that form{} no chunk",
                      found_ == 0 ? std::string("after the header") : fmt::format("after track {}", found_),
                      bytes_of(next - at_), next - at_ == 1 ? "s" : "");
                at_ = next;
            }
        }
    }

    void check_tracks() {
        if (found_ != declared_) {
            fault(10, "header: it declares {} track{}, but there {} {}", declared_, declared_ == 1 ? "" : "s",
                  found_ == 1 ? "is" : "are", found_);
        }
        check_ends();
    }

    /// Remarks on tracks that end more than an hour after the last event, as a longer rest is seldom meant.
    void check_ends() {
        if (division_ == 0) return;
        double seconds = 1e-6 * tempo_ / division_;  // a tick, after the last event
        if (division_ < 0) {
            const int frames = -(division_ >> 8);
            const int ticks = division_ & 0xFF;
            if (frames == 0 || ticks == 0) return;
            seconds = 1.0 / ((frames == 29 ? 30.0 / 1.001 : frames) * ticks);
        }
        for (const auto& [number, tick, at] : ends_) {
            const double hours = static_cast<double>(tick - last_tick_) * seconds / 3600.0;
            if (hours > 1.0) {
                remark(at, "track {}, tick {}: its end-of-track comes {:.1f} hours after the last event", number,
                       tick, hours);
            }
        }
    }

    void read_track() {
        TrackState track;
        track.number = ++found_;
        track.head = at_;
        track.at = at_ + chunk_head_bytes;
        const std::size_t length = big_endian(at_ + 4, 4);
        track.end = track.at + length;
        track.limit = std::min(track.end, size());
        while (!is_full() && read_next(track)) {
        }
        if (is_full()) return;
        if (!track.ended && track.end > size()) {
            track.is_readable = false;
            fault(track, size(), "the file ends within it; {} missing", bytes_of(track.end - size()));
        } else if (track.ended && track.is_readable && track.end > size() && track.at == size()) {
            fault_length(track, fmt::format("its end-of-track, and with it the file, comes after {}",
                                            size() - track.head - chunk_head_bytes));
        }
        if (track.sysex_is_open && track.is_readable) fault_open_sysex(track);
        end_notes(track);
        at_ = track.ended ? track.at : track.limit;
    }

    void fault_length(const TrackState& track, std::string_view what) {
        fault(track.head + 4, "track {}: its length is given as {}, but {}", track.number,
              bytes_of(big_endian(track.head + 4, 4)), what);
    }

    /// Reads one event; false at the end of the track.
    bool read_next(TrackState& track) {
        if (track.at == track.limit) {
            if (track.ended) return false;
            if (extend(track)) return true;
            if (track.end <= size()) fault(track, track.at, "it has no end-of-track");
            return false;
        }
        if (track.ended && is_chunk(track.at)) {
            fault_length(track,
                         fmt::format("its end-of-track comes after {}", track.at - track.head - chunk_head_bytes));
            return false;
        }
        Layout event;
        if (!lay_out(track, event)) {
            if (track.ended) {
                tell_events_after_end(track, track.at);
                track.at = track.limit;
                return false;
            }
            if (extend(track)) return true;
            track.is_readable = false;
            if (track.end <= size()) fault(track, track.at, "its chunk ends within an event");
            return false;
        }
        if (track.ended) {
            skip_after_end(track, event);
        } else {
            read_event(track, event);
        }
        // If its length is wrong, the bytes after the end-of-track cannot be interpreted.
        return !(track.ended && track.is_extended);
    }

    /// True if the track continues after the end that its head states, as no chunk begins there.
    bool extend(TrackState& track) {
        if (track.is_extended || track.end >= size() || is_chunk(track.end)) return false;
        track.is_extended = true;
        track.limit = next_track(track.end);
        fault_length(track, "its events go on after that");
        return true;
    }

    void tell_events_after_end(TrackState& track, std::size_t at) {
        if (!track.told_events_after_end) fault(track, at, "something comes after its end-of-track");
        track.told_events_after_end = true;
    }

    void skip_after_end(TrackState& track, const Layout& event) {
        track.at = event.next;
        if (event.status == 0xFF && event.type == end_of_track) {
            if (!track.told_second_end) fault(track, event.at, "a second end-of-track");
            track.told_second_end = true;
        } else {
            tell_events_after_end(track, event.at);
        }
    }

    /// False if the number does not end before `limit`.
    bool read_number(std::size_t& at, std::size_t limit, std::uint64_t& value) const {
        constexpr std::uint64_t most = std::uint64_t{1} << 28;  // longer numbers are wrong anyway
        value = 0;
        while (at < limit) {
            const std::uint8_t byte = bytes_[at++];
            if (value < most) value = value << 7 | (byte & 0x7F);
            if (byte < 0x80) return true;
        }
        return false;
    }

    /// Finds the parts of the event at track.at. False if it does not end before the limit.
    bool lay_out(const TrackState& track, Layout& event) const {
        std::size_t at = track.at;
        if (!read_number(at, track.limit, event.delta) || at == track.limit) return false;
        event.delta_bytes = at - track.at;
        event.at = at;
        const int first = bytes_[at];
        if (first < 0x80) {
            event.is_running = true;
            event.status = track.running != 0 ? track.running : track.last_channel_status;
            event.size = event.status == 0 ? 0 : data_bytes(event.status);
        } else {
            event.status = first;
            ++at;
            if (first < 0xF0) {
                event.size = data_bytes(first);
            } else if (first == 0xFF || first == 0xF0 || first == 0xF7) {
                if (first == 0xFF) {
                    if (at == track.limit) return false;
                    event.type = bytes_[at++];
                }
                event.length_at = at;
                std::uint64_t length = 0;
                if (!read_number(at, track.limit, length) || length > track.limit - at) return false;
                event.length_bytes = at - event.length_at;
                event.size = length;
            } else {
                // System messages as on a cable.
                event.size = first == 0xF2 ? 2 : first == 0xF1 || first == 0xF3 ? 1 : 0;
            }
        }
        if (event.size > track.limit - at) return false;
        event.data = at;
        event.next = at + event.size;
        return true;
    }

    void read_event(TrackState& track, const Layout& event) {
        track.tick += static_cast<std::int64_t>(event.delta);
        if (event.delta_bytes > 4) fault_number(track, track.at, event.delta_bytes);
        if (event.length_bytes > 4) fault_number(track, event.length_at, event.length_bytes);
        track.at = event.next;
        if (event.is_running && track.running == 0) {
            if (event.status == 0) {
                fault(track, event.at,
                      "data byte {:02X} where the status of an event is needed; the rest of the track is "
                      "ignored",
                      bytes_[event.at]);
                track.is_readable = false;
                track.ended = true;  // as far as it can be read
                track.at = track.limit;
                return;
            }
            fault(track, event.at,
                  "data byte {:02X} where the status of an event is needed: running status ends with a "
                  "meta or sysex event",
                  bytes_[event.at]);
        }
        const bool is_end = event.status == 0xFF && event.type == end_of_track;
        if (!is_end) note_event_at(track.tick);
        if (event.status < 0xF0) {
            read_channel_event(track, event);
        } else {
            track.running = 0;
            if (event.status == 0xFF) {
                read_meta(track, event);
            } else if (event.status == 0xF0 || event.status == 0xF7) {
                read_sysex(track, event);
            } else {
                fault(track, event.at, "status byte {:02X}, which no MIDI file may have", event.status);
            }
        }
        if (is_end) {
            track.ended = true;
            ends_.push_back({track.number, track.tick, event.at});
        }
    }

    void fault_number(const TrackState& track, std::size_t at, std::size_t count) {
        fault(track, at, "a variable-length number of {} bytes, but 4 is the most", count);
    }

    void note_event_at(std::int64_t tick) { last_tick_ = std::max(last_tick_, tick); }

    void read_channel_event(TrackState& track, const Layout& event) {
        track.running = track.last_channel_status = event.status;
        track.has_begun = true;
        for (std::size_t i = event.data; i < event.next; ++i) {
            if (bytes_[i] > 0x7F) fault(track, i, "data byte {:02X} is above 7F", bytes_[i]);
        }
        const int kind = event.status & 0xF0;
        if (kind != 0x80 && kind != 0x90) return;
        const int channel = event.status & 0x0F;
        const int key = bytes_[event.data] & 0x7F;
        if (kind == 0x90 && (bytes_[event.data + 1] & 0x7F) > 0) {
            begin_note(track, event.at, channel, key);
        } else {
            end_note(track, event.at, channel, key);
        }
    }

    Sounding& sounding(int channel, int key) { return sounding_[static_cast<std::size_t>(channel * 128 + key)]; }

    void begin_note(TrackState& track, std::size_t at, int channel, int key) {
        ++track.sounding;
        Sounding& notes = sounding(channel, key);
        std::size_t told = no_fault;
        if (!notes.empty() && !is_full()) {
            told = faults_.size();
            fault(track, at, "a note-on of {}, which sounds since tick {}", name_of(channel, key),
                  notes.starts[notes.first].tick);
        }
        notes.starts.push_back({track.tick, at, told});
    }

    void end_note(TrackState& track, std::size_t at, int channel, int key) {
        Sounding& notes = sounding(channel, key);
        if (notes.empty()) {
            fault(track, at, "a note-off of {}, which does not sound", name_of(channel, key));
            return;
        }
        const Start start = notes.take();
        --track.sounding;
        if (start.tick == track.tick) {
            fault(track, start.at, "a note without length of {}", name_of(channel, key));
            return;
        }
        if (notes.empty()) return;
        const Start& last = notes.starts.back();
        if (last.tick == track.tick && last.fault != no_fault) {
            faults_[last.fault].what = fmt::format(
                "track {}, tick {}: a note-on of {} before the note-off of the same tick that ends the "
                "note before",
                track.number, track.tick, name_of(channel, key));
        }
    }

    /// Reports notes that still sound, if the track was read to its end.
    void end_notes(const TrackState& track) {
        if (track.sounding == 0) return;
        for (std::size_t i = 0; i < sounding_.size(); ++i) {
            Sounding& notes = sounding_[i];
            while (!notes.empty() && track.is_readable && !is_full()) {
                const Start start = notes.take();
                fault(start.at, "track {}, tick {}: a note of {} that does not end", track.number, start.tick,
                      name_of(static_cast<int>(i / 128), static_cast<int>(i % 128)));
            }
            notes.clear();
        }
    }

    void fault_open_sysex(const TrackState& track) {
        fault(track.sysex_at, "track {}, tick {}: a sysex message that is not ended by F7", track.number,
              track.sysex_tick);
    }

    void read_sysex(TrackState& track, const Layout& event) {
        track.has_begun = true;
        const auto data = bytes_.subspan(event.data, event.size);
        const bool ends = !data.empty() && data.back() == 0xF7;
        if (event.status == 0xF0) {
            if (track.sysex_is_open) fault_open_sysex(track);
            track.sysex_at = event.at;
            track.sysex_tick = track.tick;
        } else if (!track.sysex_is_open) {
            return;  // an escape: any bytes
        }
        track.sysex_is_open = !ends;
        for (std::size_t i = 0; i + (ends ? 1 : 0) < data.size(); ++i) {
            if (data[i] > 0x7F) {
                fault(track, event.data + i, "byte {:02X} within a sysex message", data[i]);
                break;
            }
        }
    }

    void read_meta(TrackState& track, const Layout& event) {
        if (event.type > 0x7F) {
            fault(track, event.at + 1, "a meta event of type {:02X}, which is above 7F", event.type);
            return;
        }
        if (event.type == 0 && event.size != 2 && event.size != 0) {
            fault(track, event.length_at, "a sequence number of {} instead of 2", bytes_of(event.size));
        }
        if (event.type == 0) require_beginning(track, event, "a sequence number");
        for (const MetaForm& form : meta_forms) {
            if (form.type != event.type) continue;
            if (form.size != event.size) {
                fault(track, event.length_at, "{} of {} instead of {}", form.name, bytes_of(event.size), form.size);
                return;
            }
        }
        check_meta_data(track, event);
    }

    /// Some meta events stand at the beginning of a track (RP-001, "Meta Events").
    void require_beginning(const TrackState& track, const Layout& event, std::string_view name) {
        if (track.tick > 0 || track.has_begun) {
            fault(track, event.at, "{} after the beginning of its track", name);
        }
    }

    /// Hours with the frame rate in bits 5 and 6, minutes, seconds, frames and hundredths of a frame.
    void check_smpte_offset(const TrackState& track, const Layout& event) {
        require_beginning(track, event, "an SMPTE offset");
        if (format_ == 1 && track.number > 1) {
            fault(track, event.at, "an SMPTE offset outside the first track, where format 1 has it");
        }
        constexpr std::array<int, 4> frames = {24, 25, 30, 30};
        const int rate = bytes_[event.data] >> 5 & 3;
        const struct {
            int value, most;
            std::string_view unit;
        } fields[] = {{bytes_[event.data] & 0x1F, 23, "hours"},
                      {bytes_[event.data + 1], 59, "minutes"},
                      {bytes_[event.data + 2], 59, "seconds"},
                      {bytes_[event.data + 3], frames[static_cast<std::size_t>(rate)] - 1, "frames"},
                      {bytes_[event.data + 4], 99, "hundredths of a frame"}};
        for (std::size_t i = 0; i < std::size(fields); ++i) {
            if (fields[i].value <= fields[i].most) continue;
            fault(track, event.data + i, "an SMPTE offset of {} {}, but {} is the most", fields[i].value,
                  fields[i].unit, fields[i].most);
        }
    }

    void check_meta_data(const TrackState& track, const Layout& event) {
        const auto data = [&](std::size_t i) { return static_cast<int>(bytes_[event.data + i]); };
        if (event.type == tempo_type) {
            const auto tempo = static_cast<int>(big_endian(event.data, 3));
            if (tempo == 0) {
                fault(track, event.data, "a tempo of 0 microseconds a quarter");
            } else if (track.tick >= tempo_tick_) {
                tempo_tick_ = track.tick;
                tempo_ = tempo;
            }
            if (format_ == 1 && track.number > 1) {
                fault(track, event.at, "a tempo outside the first track, which programs ignore in format 1");
            }
        } else if (event.type == 0x20 && data(0) > 15) {
            fault(track, event.data, "a channel prefix of {}, but 15 is the most", data(0));
        } else if (event.type == 0x54) {
            check_smpte_offset(track, event);
        } else if (event.type == 0x58) {
            if (data(0) == 0) fault(track, event.data, "a time signature of no beats");
            // 2^7 is a 128th, the shortest that has a name.
            if (data(1) > 7) fault(track, event.data + 1, "a time signature in units of 1/2^{}", data(1));
        } else if (event.type == 0x59) {
            const int fifths = data(0) < 0x80 ? data(0) : data(0) - 0x100;
            if (fifths < -7 || fifths > 7) {
                fault(track, event.data, "a key signature of {} fifths, but 7 is the most", fifths);
            }
            if (data(1) > 1) {
                fault(track, event.data + 1, "a key signature of mode {}; 0 is major, 1 is minor", data(1));
            }
        }
    }

    struct End {
        int track = 0;
        std::int64_t tick = 0;
        std::size_t at = 0;
    };

    std::span<const std::uint8_t> bytes_;
    std::vector<MidiFault> faults_;
    std::size_t at_ = 0;  // the next chunk
    int format_ = 0;
    int declared_ = 0;
    int found_ = 0;
    int division_ = 0;
    std::vector<Sounding> sounding_;  // notes of the track, by channel and key
    std::int64_t last_tick_ = 0;      // tick of the last event other than an end-of-track
    std::int64_t tempo_tick_ = 0;
    int tempo_ = default_tempo;  // the last of the file
    std::vector<End> ends_;
};

}  // namespace

std::vector<MidiFault> check_midi(std::span<const std::uint8_t> bytes) {
    return Walk(bytes).run();
}

}  // namespace sikku
