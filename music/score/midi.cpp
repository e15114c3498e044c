#include "music/score/midi.h"

#include "engine/base/memory.h"
#include "music/score/curves.h"
#include "music/score/glides.h"
#include "music/score/labels.h"
#include "music/score/midi_bytes.h"
#include "music/score/midi_conductor.h"
#include "music/score/midi_voice.h"
#include "music/score/mpe.h"
#include "music/score/note_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace sikku {

using namespace midi;

namespace {

constexpr std::uint64_t most_track_bytes = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t most_voices = most_pitched_channels;
constexpr std::uint32_t unset = ~std::uint32_t{0};
constexpr int none = -1;

class MidiWriter final : public NoteSink {
public:
    MidiWriter(const ScoreHead& head, Output& sink, const MidiOptions& options)
        : head_(head),
          sink_(sink),
          options_(options),
          is_mpe_(options.tuning == Tuning::mpe),
          bend_range_(is_mpe_ ? mpe_bend_range : options.bend_range),
          slots_(options.share_channels ? channel_slots(head) : std::vector<int>()),
          labels_(labels_of(head.parts)),
          conductor_(head, nullptr, is_mpe_) {
        check_options();
        std::size_t voices = 0;
        for (const Part& part : head_.parts) voices += static_cast<std::size_t>(std::max(part.voices, 0));
        voices_.resize(std::min(voices, std::size_t{std::numeric_limits<std::int16_t>::max()} + 1));
    }

    void curves(const Curves& curves) override {
        curves_ = &curves;
        conductor_ = Conductor(head_, curves_, is_mpe_);
    }

    void controls(std::span<const ControlPoint> points) override {
        coming_.resize(voices_.size());
        for (const ControlPoint& point : points) coming_.at(static_cast<std::size_t>(point.voice)).push_back(point);
        has_coming_ = has_coming_ || !points.empty();
    }

    void notes(std::span<const Note> notes) override {
        if (is_mpe_) return collect(notes);
        while (!notes.empty()) {
            Voice& voice = voice_of(notes.front());
            if (has_coming_) take_controls(voice);
            if (!voice.controls.empty() || has_glide(notes.front())) {
                notes = notes.subspan(write_curved(voice, notes));
                continue;
            }
            notes = notes.subspan(options_.microtonal ? write<true>(voice, notes) : write<false>(voice, notes));
        }
    }

    void finish(std::int64_t end) override {
        if (is_mpe_) write_collected();
        check_end(end);
        if (options_.format == 0) {
            write_merged(end);
            return;
        }
        const auto conductor_end = std::min(static_cast<std::uint64_t>(end), most_delta);
        if (streamed_) {
            sink_.overwrite(10, big_endian(1 + sounding_, 2));
            sink_.overwrite(conductor_end_at_, conductor_.closing(end, wide_delta(conductor_end)));
        } else {
            write_head(1 + sounding_, conductor_.closing(end, delta(conductor_end)));
        }
        for (const auto& voice : voices_) {
            if (!voice) continue;
            const std::string last = end_of_track(end - voice->now);
            const std::string opening = open(*voice);
            const std::uint64_t size = opening.size() + voice->bytes() + last.size();
            check_track(size);
            if (streamed_ && voice->number == 0) {
                sink_.overwrite(streamed_length_at_, big_endian(size, 4));
            } else {
                sink_.write("MTrk" + big_endian(size, 4) + opening);
                for (const std::string& block : voice->full) sink_.write(block);
            }
            sink_.write(voice->open_block());
            sink_.write(last);
        }
    }

private:
    Voice& voice_of(const Note& note) {
        const bool known = note.voice >= 0 && static_cast<std::size_t>(note.voice) < voices_.size();
        if (!known) throw ScoreError(fmt::format("there is a note of voice {}, which no part has", note.voice + 1));
        auto& voice = voices_[static_cast<std::size_t>(note.voice)];
        if (!voice) voice = begin_voice(note.voice);
        return *voice;
    }

    /// Adds the points received by controls() to those of the voice.
    void take_controls(Voice& voice) {
        std::vector<ControlPoint>& coming = coming_[static_cast<std::size_t>(voice.number)];
        if (coming.empty()) return;
        coming.insert(coming.begin(), voice.controls.begin(), voice.controls.end());
        voice.own_controls.swap(coming);
        coming.clear();
        voice.controls = voice.own_controls;
    }

    void collect(std::span<const Note> notes) {
        if (notes.size() > most_collected_ - std::min(most_collected_, collected_.size())) {
            throw ScoreError(
                fmt::format("more than {} notes do not fit into memory, where MPE needs them; limit the bars or "
                            "seconds",
                            most_collected_));
        }
        collected_.insert(collected_.end(), notes.begin(), notes.end());
    }

    /// Channels are distributed in the order of onsets.
    void write_collected() {
        sort_by_time(collected_);
        MpeChannels distribution;
        std::array<int, channels> programs{};
        programs.fill(-1);
        for (const Note& note : collected_) {
            Voice& voice = voice_of(note);
            if (note.duration <= 0 || !(note.key >= 0.0 && note.key <= 127.0)) refuse_note(voice, voice.now, note);
            const auto end = static_cast<std::int64_t>(static_cast<std::uint64_t>(note.onset) +
                                                       static_cast<std::uint64_t>(note.duration));
            if (voice.is_drums) {
                write<false>(voice, std::span(&note, 1));
                continue;
            }
            voice.channel = distribution.take(note.onset, end, static_cast<int>(note.key + 0.5), voice.number);
            if (voice.channel < 0) {
                throw ScoreError(fmt::format("more than {} notes at the same time; MPE has channels for {}",
                                             most_mpe_notes, most_mpe_notes));
            }
            int& program = programs[static_cast<std::size_t>(voice.channel)];
            voice.has_new_program = program != voice.program;
            program = voice.program;
            voice.bend = none;
            const std::span one(&note, 1);
            if (has_coming_) take_controls(voice);
            if (has_glide(note) || has_coming_ || (curves_ && !curves_->controls.empty())) {
                write_curved(voice, one);
            } else {
                write<true>(voice, one);
            }
        }
        collected_.clear();
    }

    void check_options() const {
        if (options_.format != 0 && options_.format != 1) {
            throw ScoreError(fmt::format("MIDI files are written in format 0 or 1, not {}", options_.format));
        }
        if (options_.bend_range < 1 || options_.bend_range > 24) {
            throw ScoreError(fmt::format("a bend range of {} semitones: expected 1 to 24", options_.bend_range));
        }
        if (options_.share_channels && (options_.microtonal || is_mpe_)) {
            throw ScoreError("voices can share channels only without microtones");
        }
    }

    void check_end(std::int64_t end) const {
        std::int64_t last = 0;
        for (const auto& voice : voices_) {
            if (!voice) continue;
            last = std::max(last, voice->now);
            if (voice->now > end) break;
            // In format 0 other voices may continue until then.
            if (options_.format == 1 && static_cast<std::uint64_t>(end - voice->now) > most_delta) {
                throw ScoreError(fmt::format(
                    "voice {} is silent for the last {} ticks of the score; a MIDI file can tell rests up "
                    "to {} ticks",
                    voice->number + 1, end - voice->now, most_delta));
            }
        }
        if (end < last) throw ScoreError(fmt::format("the score ends at tick {}, but its notes at {}", end, last));
        if ((sounding_ == 0 || options_.format == 0) && static_cast<std::uint64_t>(end - last) > most_delta) {
            throw ScoreError(fmt::format("the score ends with {} ticks of silence; a MIDI file can tell up to {}",
                                         end - last, most_delta));
        }
    }

    static void check_track(std::uint64_t bytes) {
        if (bytes > most_track_bytes) throw ScoreError("a track of a MIDI file cannot be larger than 4 GB");
    }

    static std::string end_of_track(std::int64_t rest) {
        return delta(static_cast<std::uint64_t>(rest)) + meta(end_type, "");
    }

    std::string header(std::uint64_t tracks) const {
        return "MThd" + big_endian(6, 4) + big_endian(static_cast<std::uint64_t>(options_.format), 2) +
               big_endian(tracks, 2) + big_endian(ticks_per_quarter, 2);
    }

    /// @param last  bytes that end the first track
    void write_head(std::uint64_t tracks, const std::string& last) {
        const std::uint64_t size = conductor_.opening().size() + last.size();
        check_track(size);
        const std::string front = header(tracks) + "MTrk" + big_endian(size, 4);
        sink_.write(front);
        sink_.write(conductor_.opening());
        sink_.write(last);
        conductor_end_at_ = front.size() + conductor_.opening().size();
        head_bytes_ = front.size() + size;
    }

    std::unique_ptr<Voice> begin_voice(std::int16_t number) {
        const bool is_drums = head_.part_of(number).is_drums;
        if (!is_drums && !options_.share_channels && !is_mpe_ && pitched_ == most_voices) {
            throw ScoreError(fmt::format("too many voices: a MIDI file has channels for {}", most_voices));
        }
        auto voice = std::make_unique<Voice>();
        voice->number = number;
        const int slot = options_.share_channels         ? slots_[head_.part_index(number)]
                         : voices_.size() <= most_voices ? number
                                                         : static_cast<int>(pitched_);
        voice->is_drums = is_drums;
        if (curves_) voice->controls = curves_->of_voice(number);
        voice->channel = is_drums ? drum_channel : slot < drum_channel ? slot : slot + 1;
        ++sounding_;
        pitched_ += is_drums ? 0 : 1;
        voice->program = head_.part_of(number).program;
        if (options_.microtonal && options_.tuning == Tuning::mts && !is_drums) voice->tuned.assign(128, unset);
        return voice;
    }

    /// The name of a voice as in print. The voices of its part that sound are numbered; for a streamed voice all are,
    /// as more may follow.
    std::string name_of(const Voice& voice) const {
        const std::size_t part = head_.part_index(voice.number);
        const std::string& name = labels_[part].name;
        if (name.empty()) return {};
        std::size_t before = 0;
        std::size_t count = 0;
        for (const auto& one : voices_) {
            if (!one || head_.part_index(one->number) != part) continue;
            before += one->number < voice.number ? 1 : 0;
            ++count;
        }
        if (streamed_ && voice.number == 0) count = static_cast<std::size_t>(head_.parts[part].voices);
        return line_name(name, before, count);
    }

    /// The bytes at the beginning of a voice's track, all at tick 0.
    std::string open(const Voice& voice) const {
        std::string bytes;
        const std::string name = name_of(voice);
        if (!name.empty()) bytes += meta_now(options_.format == 1 ? name_type : instrument_type, name);
        return is_mpe_ ? bytes : bytes + messages_now(channel_setup(voice.channel, options_, voice.program));
    }

    /// Writes the first notes as long as they belong to this voice; returns their number.
    template <bool microtonal>
    std::size_t write(Voice& voice, std::span<const Note> notes) {
        char* out = voice.out;
        std::int64_t now = voice.now;
        const int on = status(0x90, voice.channel);
        const int off = status(0x80, voice.channel);
        const char* const last_start = voice.last_start();
        std::size_t i = 0;
        for (; i < notes.size() && notes[i].voice == voice.number; ++i) {
            const Note& note = notes[i];
            if (has_glide(note)) break;
            // Unsigned, so that negative values are too large.
            std::uint64_t rest = static_cast<std::uint64_t>(note.onset) - static_cast<std::uint64_t>(now);
            const auto length = static_cast<std::uint64_t>(note.duration);
            const bool is_key = note.key >= 0.0 && note.key <= 127.0;
            if (rest > most_delta || length - 1 >= most_delta || !is_key || note.velocity - 1U > 126U) {
                refuse_note(voice, now, note);
            }
            const int key = static_cast<int>(note.key + 0.5);
            const double fraction = note.key - key;
            const bool is_fraction = std::abs(fraction) > least_fraction;
            if (out > last_start) {
                voice.out = out;
                flush(voice);
                out = voice.out;
            }
            if constexpr (microtonal) {
                if (voice.has_new_program) {
                    out = put_delta(out, std::exchange(rest, 0));
                    out = put_byte(out, status(0xC0, voice.channel));
                    out = put_byte(out, voice.program);
                    voice.has_new_program = false;
                }
                char* const tuned = voice.tuned.empty() ? bend(voice, out, rest, is_fraction ? fraction : 0.0)
                                                        : retune(voice, out, rest, key, is_fraction ? fraction : 0.0);
                if (tuned != out) rest = 0;
                out = tuned;
            } else if (is_fraction) {
                refuse_note(voice, now, note);
            }
            out = put_delta(out, rest);
            out = put_byte(out, on);
            out = put_byte(out, key);
            out = put_byte(out, note.velocity);
            out = put_delta(out, length);
            out = put_byte(out, off);
            out = put_byte(out, key);
            out = put_byte(out, release);
            now = note.onset + note.duration;
        }
        voice.out = out;
        voice.now = now;
        return i;
    }

    /// Writes notes like write(), with bends and controllers before and during them.
    std::size_t write_curved(Voice& voice, std::span<const Note> notes) {
        std::size_t i = 0;
        for (; i < notes.size() && notes[i].voice == voice.number; ++i) {
            const Note& note = notes[i];
            const double fraction = note.key - std::round(note.key);
            const bool is_key = note.key >= 0.0 && note.key <= 127.0;
            const bool is_far = static_cast<std::uint64_t>(note.onset - voice.now) > most_delta;
            const bool is_bent =
                (std::fabs(fraction) > least_fraction && !options_.microtonal) || (has_glide(note) && !bends_notes());
            if (is_far || is_bent || note.duration <= 0 || note.velocity - 1U > 126U || !is_key) {
                refuse_note(voice, voice.now, note);
            }
            const std::int64_t end = note.onset + note.duration;
            const double bent = lead_in(voice, note.onset);
            if (std::exchange(voice.has_new_program, false)) put_program(voice, note.onset);
            if (!voice.tuned.empty()) {
                if (voice.out > voice.last_start()) flush(voice);
                const auto rest = static_cast<std::uint64_t>(note.onset - voice.now);
                char* const tuned = retune(voice, voice.out, rest, static_cast<int>(std::lround(note.key)), fraction);
                if (tuned != voice.out) voice.now = note.onset;
                voice.out = tuned;
            } else if (bends_notes() && !voice.is_drums) {
                put_bend(voice, note.onset, fraction + bent);
            }
            auto key = static_cast<int>(std::lround(note.key));
            put_event(voice, note.onset, status(0x90, voice.channel), key, note.velocity);
            for (const GlidePoint& point : glide_points(note, head_.tempo)) {
                write_controls(voice, point.tick + 1, false, 0);
                key = slide(voice, point, key, note.velocity);
            }
            write_controls(voice, end, !has_glide(note), fraction);
            put_event(voice, end, status(0x80, voice.channel), key, release);
        }
        return i;
    }

    /// Writes the points up to the onset of a note. With MPE its channel gets the values that the voice has now.
    /// @return the bend at the onset
    double lead_in(Voice& voice, std::int64_t onset) {
        if (!is_mpe_) write_controls(voice, onset, false, 0);
        double bent = 0;
        std::size_t used = 0;
        for (const ControlPoint& point : voice.controls) {
            if (point.tick > onset) break;
            ++used;
            if (point.number != ControlPoint::bend) {
                voice.values[point.number] = controller_value(point);
            } else if (point.tick == onset) {
                bent = point.value;
            }
        }
        if (!is_mpe_) {
            write_controls(voice, onset + 1, false, 0);
            return bent;
        }
        voice.controls = voice.controls.subspan(used);
        std::map<int, int>& sent = sent_[static_cast<std::size_t>(voice.channel)];
        // Values left there by other voices do not apply to this one.
        for (const auto& [number, value] : sent) voice.values.try_emplace(number, usual_controller_value(number));
        for (const auto& [number, value] : voice.values) {
            if (const auto last = sent.find(number); last != sent.end() && last->second == value) continue;
            sent[number] = value;
            put_event(voice, onset, status(0xB0, voice.channel), number, value);
        }
        return bent;
    }

    bool bends_notes() const { return is_mpe_ || (options_.microtonal && options_.tuning == Tuning::bend); }

    /// Bends the sounding note. If the pitch is too far from its key, the key reached by the slide is struck.
    /// @return the key that sounds now
    int slide(Voice& voice, const GlidePoint& point, int key, int velocity) {
        if (std::fabs(point.key - key) <= bend_range_) {
            put_bend(voice, point.tick, point.key - key);
            return key;
        }
        put_event(voice, point.tick, status(0x80, voice.channel), key, release);
        key = static_cast<int>(std::lround(point.key));
        put_bend(voice, point.tick, point.key - key);
        put_event(voice, point.tick, status(0x90, voice.channel), key, velocity);
        return key;
    }

    /// Writes the points before `until`. @param bends  true if a note of that fraction sounds, which may be bent
    void write_controls(Voice& voice, std::int64_t until, bool bends, double fraction) {
        std::size_t used = 0;
        for (const ControlPoint& point : voice.controls) {
            if (point.tick >= until) break;
            ++used;
            const std::int64_t tick = std::max(point.tick, voice.now);
            if (point.number != ControlPoint::bend) {
                const int value = controller_value(point);
                put_event(voice, tick, status(0xB0, voice.channel), point.number, value);
                if (!is_mpe_) continue;
                voice.values[point.number] = value;
                sent_[static_cast<std::size_t>(voice.channel)][point.number] = value;
            } else if (bends && (options_.microtonal || is_mpe_) && !voice.is_drums) {
                put_bend(voice, tick, fraction + point.value);
            }
        }
        voice.controls = voice.controls.subspan(used);
    }

    void put_bend(Voice& voice, std::int64_t tick, double semitones) {
        const int wanted =
            std::clamp(centre + static_cast<int>(std::lround(semitones * centre / bend_range_)), 0, 16383);
        if (wanted == voice.bend) return;
        voice.bend = wanted;
        put_event(voice, tick, status(0xE0, voice.channel), wanted & 0x7F, wanted >> 7);
    }

    void put_event(Voice& voice, std::int64_t tick, int first, int second, int third) {
        put_two(voice, tick, first, second);
        voice.out = put_byte(voice.out, third);
    }

    void put_program(Voice& voice, std::int64_t tick) {
        put_two(voice, tick, status(0xC0, voice.channel), voice.program);
    }

    void put_two(Voice& voice, std::int64_t tick, int first, int second) {
        const auto rest = static_cast<std::uint64_t>(tick - voice.now);
        if (rest > most_delta) {
            throw ScoreError(
                fmt::format("voice {}, tick {}: {} ticks without an event; a MIDI file can tell up to {}",
                            voice.number + 1, tick, rest, most_delta));
        }
        if (voice.out > voice.last_start()) flush(voice);
        voice.out = put_byte(put_byte(put_delta(voice.out, rest), first), second);
        voice.now = tick;
    }

    /// Bends a channel. @param fraction  fraction of a semitone, -0.5 to 0.5
    char* bend(Voice& voice, char* out, std::uint64_t rest, double fraction) const {
        const int wanted = centre + static_cast<int>(std::lround(fraction * centre / bend_range_));
        if (wanted == voice.bend) return out;
        voice.bend = wanted;
        out = put_delta(out, rest);
        out = put_byte(out, status(0xE0, voice.channel));
        out = put_byte(out, wanted & 0x7F);
        return put_byte(out, wanted >> 7);
    }

    /// Makes room in the open block.
    void flush(Voice& voice) {
        voice.full_bytes += voice.open_block().size();
        check_track(voice.full_bytes);
        if (voice.number == 0 && options_.format == 1) {
            if (!streamed_) begin_streaming(voice);
            sink_.write(voice.open_block());
        } else {
            voice.full.emplace_back(voice.open_block());
        }
        voice.out = voice.block.get();
    }

    /// Writes the head and the beginning of voice 0; finish() fills in the missing numbers.
    void begin_streaming(const Voice& voice) {
        streamed_ = true;
        write_head(0, conductor_.closing(0, wide_delta(0)));
        streamed_length_at_ = head_bytes_ + 4;
        sink_.write("MTrk" + big_endian(0, 4) + open(voice));
    }

    /// Writes all voices in one track, by tick, rank and voice.
    void write_merged(std::int64_t end) {
        std::vector<std::string> openings;
        openings.reserve(sounding_);  // events refer to them
        std::vector<Events> voices;
        for (const auto& voice : voices_) {
            if (!voice) continue;
            openings.push_back(open(*voice));
            voices.emplace_back(*voice, openings.back());
        }
        const std::string head = header(1);
        sink_.write(head + "MTrk" + big_endian(0, 4));
        std::string block = conductor_.opening();
        std::uint64_t bytes = 0;
        std::int64_t now = 0;
        const auto write_block = [&] {
            bytes += block.size();
            check_track(bytes);
            sink_.write(block);
            block.clear();
        };
        const std::vector<ConductorChange> changes = conductor_.changes(end);
        auto change = changes.begin();
        const auto change_until = [&](std::int64_t tick) {
            for (; change != changes.end() && change->tick <= tick; ++change) {
                block += delta(static_cast<std::uint64_t>(change->tick - now)) += change->event();
                now = change->tick;
            }
        };
        for (;;) {
            const auto first = std::min_element(voices.begin(), voices.end(), [](const Events& a, const Events& b) {
                return !a.done() && (b.done() || a.place() < b.place());
            });
            if (first == voices.end() || first->done()) break;
            change_until(first->tick());
            block += delta(static_cast<std::uint64_t>(first->tick() - now));
            block += first->event();
            now = first->tick();
            first->next();
            if (block.size() >= block_bytes) write_block();
        }
        change_until(end);
        block += end_of_track(end - now);
        write_block();
        sink_.overwrite(head.size() + 4, big_endian(bytes, 4));
    }

    const ScoreHead& head_;
    Output& sink_;
    const Curves* curves_ = nullptr;
    std::vector<std::vector<ControlPoint>> coming_;  ///< points of controls(), by voice
    bool has_coming_ = false;
    const MidiOptions options_;
    const bool is_mpe_;
    const int bend_range_;
    const std::vector<int> slots_;     // channel slots by part, if channels are shared
    const std::vector<Label> labels_;  // by part
    Conductor conductor_;
    const std::size_t most_collected_ = static_cast<std::size_t>(available_memory() / 4 / sizeof(Note));
    std::vector<Note> collected_;                    // with MPE, until finish()
    std::array<std::map<int, int>, channels> sent_;  // values of controllers, by channel, with MPE
    std::vector<std::unique_ptr<Voice>> voices_;     // by number; null while they are silent
    std::size_t sounding_ = 0;
    std::size_t pitched_ = 0;  // number of those that are not drums
    bool streamed_ = false;    // head and the beginning of voice 0 are in the sink
    std::uint64_t head_bytes_ = 0;
    std::uint64_t conductor_end_at_ = 0;
    std::uint64_t streamed_length_at_ = 0;
};

}  // namespace

std::unique_ptr<NoteSink> write_midi(const ScoreHead& head, Output& sink, const MidiOptions& options) {
    return std::make_unique<MidiWriter>(head, sink, options);
}

}  // namespace sikku
