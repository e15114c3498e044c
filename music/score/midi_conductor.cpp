#include "music/score/midi_conductor.h"

#include "music/score/midi_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

namespace sikku::midi {
namespace {

void check_meter(const Meter& meter) {
    const bool is_power =
        meter.unit >= 1 && meter.unit <= 64 && std::has_single_bit(static_cast<unsigned>(meter.unit));
    if (meter.beats < 1 || meter.beats > 255 || !is_power) {
        throw ScoreError(fmt::format("a MIDI file cannot contain a meter of {}/{}", meter.beats, meter.unit));
    }
}

/// @return microseconds a quarter
double micro_of(double tempo) {
    const double micro = std::round(60e6 / tempo);
    if (!(tempo > 0 && micro >= 1 && micro < 0x1p24)) {
        throw ScoreError(fmt::format("a MIDI file cannot contain a tempo of {} quarters a minute", tempo));
    }
    return micro;
}

void check_head(const ScoreHead& head) {
    check_meter(head.meter);
    for (const SectionChange& change : head.changes) {
        check_meter(change.to.meter);
        micro_of(change.to.tempo);
    }
    for (const Part& part : head.parts) {
        if (part.program < 0 || part.program > 127) {
            throw ScoreError(fmt::format("part '{}': program {} is not within 0 to 127", part.name, part.program));
        }
        if (part.key && (part.key->fifths < -7 || part.key->fifths > 7)) {
            throw ScoreError(fmt::format("part '{}': a key signature of {} fifths", part.name, part.key->fifths));
        }
    }
    for (const KeyChange& change : head.keys) {
        if (change.key && (change.key->fifths < -7 || change.key->fifths > 7))
            throw ScoreError(fmt::format("a key signature of {} fifths", change.key->fifths));
    }
}

/// The key with which a score begins: that of the first section or, without sections, of the first pitched part.
std::optional<KeySignature> first_key(const ScoreHead& head) {
    if (!head.keys.empty()) return head.keys.front().key;
    const auto part =
        std::find_if(head.parts.begin(), head.parts.end(), [](const Part& one) { return !one.is_drums; });
    return part == head.parts.end() ? std::nullopt : part->key;
}

/// The bytes of a key signature; a section without a key has no accidentals.
std::string key_bytes(const std::optional<KeySignature>& key) {
    const KeySignature signature = key.value_or(KeySignature{});
    return {static_cast<char>(signature.fifths), static_cast<char>(signature.minor)};
}

/// The meter of a short bar within a meter. @param ticks  length of the bar, a multiple of 30
Meter short_meter(std::int64_t ticks, const Meter& meter) {
    const std::int64_t whole_note = 4 * ticks_per_quarter;
    Meter result{0, meter.unit, {}};
    while (ticks % (whole_note / result.unit) != 0) result.unit *= 2;
    result.beats = static_cast<int>(ticks / (whole_note / result.unit));
    for (; result.beats > 255 && result.beats % 2 == 0; result.beats /= 2) result.unit /= 2;
    return result;
}

std::string meter_bytes(const Meter& meter) {
    const int power = std::countr_zero(static_cast<unsigned>(meter.unit));
    // The metronome clicks with every unit, in 24ths of a quarter; a quarter has eight 32nds.
    const int click = std::max(96 / meter.unit, 1);
    return {static_cast<char>(meter.beats), static_cast<char>(power), static_cast<char>(click), 8};
}

}  // namespace

std::string ConductorChange::event() const {
    if (meter) return meta(meter_type, meter_bytes(*meter));
    return key ? meta(key_type, key_bytes(key->key)) : meta(tempo_type, big_endian(micro, 3));
}

Conductor::Conductor(const ScoreHead& head, const Curves* curves, bool is_mpe) : head_(&head), curves_(curves) {
    check_head(head);
    opening_ = make_opening(is_mpe);
}

std::string Conductor::make_opening(bool is_mpe) const {
    const double micro = micro_of(head_->tempo * first_factor());
    std::string bytes;
    if (!head_->title.empty()) bytes += meta_now(name_type, head_->title);
    // Texts are unnamed, so the first is always the pattern, even if it is empty.
    bytes += meta_now(text_type, head_->pattern);
    bytes += meta_now(text_type, head_->made);
    bytes += meta_now(tempo_type, big_endian(static_cast<std::uint64_t>(micro), 3));
    const bool has_upbeat = head_->upbeat > 0;
    bytes += meta_now(meter_type, meter_bytes(has_upbeat ? short_meter(head_->upbeat, head_->meter) : head_->meter));
    if (const auto key = first_key(*head_)) bytes += meta_now(key_type, key_bytes(key));
    if (is_mpe) bytes += messages_now(mpe_setup());
    return bytes;
}

/// Factor of the tempo at the beginning of the score.
double Conductor::first_factor() const {
    const bool has_curve = curves_ && !curves_->tempo.empty() && curves_->tempo.front().tick == 0;
    return has_curve ? curves_->tempo.front().factor : 1;
}

std::vector<ConductorChange> Conductor::changes(std::int64_t end) const {
    static const Curves nothing;
    const Curves& curves = curves_ ? *curves_ : nothing;
    // Avoids copying a long map.
    std::vector<TempoPoint> changing;
    if (head_->changes_tempo()) changing = tempo_map(*head_, curves, end);
    const std::vector<TempoPoint>& map = head_->changes_tempo() ? changing : curves.tempo;
    std::vector<ConductorChange> result;
    result.reserve(map.size() + head_->changes.size());
    std::int64_t last = 0;
    for (const TempoPoint& point : map) {
        // A delta cannot express a later tick.
        const bool is_late = static_cast<std::uint64_t>(point.tick) > most_delta;
        const double tempo = is_late ? head_->tempo : head_->tempo * point.factor;
        // The opening contains the first tempo.
        if (point.tick == 0 && point.factor == first_factor()) continue;
        if (!is_late) last = point.tick;
        result.push_back({last, static_cast<std::uint32_t>(std::min(std::round(60e6 / tempo), 0x1p24 - 1))});
    }
    const auto insert = [&](const ConductorChange& change) {
        const auto after =
            std::upper_bound(result.begin(), result.end(), change.tick,
                             [](std::int64_t tick, const ConductorChange& other) { return tick < other.tick; });
        result.insert(after, change);
    };
    if (head_->upbeat > 0) insert({std::min(head_->upbeat, end), 0, &head_->meter});
    const Meter* before = &head_->meter;
    for (const SectionChange& change : head_->changes) {
        const Meter& meter = change.to.meter;
        if (meter != *std::exchange(before, &meter)) insert({change.onset, 0, &meter});
    }
    std::string key = key_bytes(first_key(*head_));
    for (const KeyChange& change : head_->keys) {
        if (key_bytes(change.key) != std::exchange(key, key_bytes(change.key)))
            insert({std::min(change.onset, end), 0, nullptr, &change});
    }
    return result;
}

std::string Conductor::closing(std::int64_t end, const std::string& last) const {
    const std::vector<ConductorChange> all = changes(end);
    if (all.empty()) return last + meta(end_type, "");
    std::string bytes;
    bytes.reserve(all.size() * (wide_delta(0) + ConductorChange{}.event()).size() + last.size() + 16);
    std::int64_t now = 0;
    for (const ConductorChange& change : all) {
        bytes += wide_delta(static_cast<std::uint64_t>(change.tick - now)) += change.event();
        now = change.tick;
    }
    const auto conductor_end = std::min<std::int64_t>(end, static_cast<std::int64_t>(most_delta));
    return bytes + wide_delta(static_cast<std::uint64_t>(std::max<std::int64_t>(0, conductor_end - now))) +
           meta(end_type, "");
}

}  // namespace sikku::midi
