#include "music/live/voices.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sikku::live {

using namespace midi;

namespace {

constexpr int all_notes_off = 123;
constexpr std::uint32_t unset = ~std::uint32_t{0};

Message bend(int channel, int value) {
    return {0xE0 | channel, value & 0x7F, value >> 7};
}

/// Channels by voice, without that of drums. They repeat if there are too few, as with MPE, which needs none of them.
std::vector<int> channels_of(const ScoreHead& head, bool share) {
    const std::vector<int> slots = share ? channel_slots(head) : std::vector<int>();
    std::vector<int> channels;
    int pitched = 0;
    for (std::size_t i = 0; i < head.parts.size(); ++i) {
        for (int voice = 0; voice < head.parts[i].voices; ++voice) {
            if (head.parts[i].is_drums) {
                channels.push_back(drum_channel);
                continue;
            }
            const int slot = share ? slots[i] : pitched++ % 15;
            channels.push_back(slot < drum_channel ? slot : slot + 1);
        }
    }
    return channels;
}

}  // namespace

Voices::Voices(const ScoreHead& head, const MidiOptions& midi)
    : head_(head),
      midi_(midi),
      is_mpe_(midi.tuning == Tuning::mpe),
      bend_range_(is_mpe_ ? mpe_bend_range : midi.bend_range),
      channels_(channels_of(head, midi.share_channels)),
      voice_count_(static_cast<int>(channels_.size())) {
    sounding_.resize(static_cast<std::size_t>(voice_count_));
    values_.resize(static_cast<std::size_t>(voice_count_));
    programs_.fill(-1);
    bends_.fill(centre);
    if (midi.microtonal && midi.tuning == Tuning::mts) {
        tuned_.resize(16);
        for (auto& keys : tuned_) keys.fill(unset);
    }
}

int Voices::channel_of(int voice) const {
    return channels_[static_cast<std::size_t>(voice)];
}

void Voices::prepare(std::vector<Message>& messages) const {
    const auto add = [&](const std::vector<Message>& all) {
        messages.insert(messages.end(), all.begin(), all.end());
    };
    if (is_mpe_) return add(mpe_setup());
    std::array<bool, 16> is_ready{};
    for (int voice = 0; voice < voice_count_; ++voice) {
        const int channel = channel_of(voice);
        if (std::exchange(is_ready[static_cast<std::size_t>(channel)], true)) continue;
        add(channel_setup(channel, midi_, head_.part_of(voice).program));
    }
}

void Voices::tune(int channel, int key, double fraction, std::vector<Message>& messages) {
    if (channel == drum_channel) return;
    if (std::fabs(fraction) <= least_fraction) fraction = 0;
    if (bends_notes()) {
        const int value =
            std::clamp(centre + static_cast<int>(std::lround(fraction * centre / bend_range_)), 0, 16383);
        int& last = bends_[static_cast<std::size_t>(channel)];
        if (!is_mpe_ && value == last) return;
        last = value;
        messages.push_back(bend(channel, value));
    } else if (!tuned_.empty()) {
        const auto value = static_cast<std::uint32_t>(std::lround((key + fraction) * 0x1p14));
        std::uint32_t& last = tuned_[static_cast<std::size_t>(channel)][static_cast<std::size_t>(key)];
        if (value == last) return;
        last = value;
        messages.push_back(key_tuning(channel, key, value));
    }
}

void Voices::begin(const Note& note, std::int64_t tick, std::vector<Message>& messages) {
    const int voice = note.voice;
    if (voice < 0 || voice >= voice_count_ || !(note.key >= 0 && note.key <= 127)) return;
    end(voice, tick, messages);
    const int key = static_cast<int>(note.key + 0.5);
    int channel = channel_of(voice);
    if (is_mpe_ && channel != drum_channel) {
        channel = mpe_.take(tick, INT64_MAX, key, 0);
        if (channel < 0) {
            end(*std::find_if_not(order_.begin(), order_.end(),
                                  [this](int one) { return head_.part_of(one).is_drums; }),
                tick, messages);
            channel = mpe_.take(tick, INT64_MAX, key, 0);
        }
        const int program = head_.part_of(voice).program;
        int& last = programs_[static_cast<std::size_t>(channel)];
        if (last != program) messages.push_back({0xC0 | channel, program});
        last = program;
        set_controllers(voice, channel, messages);
    }
    Key& state = keys_[static_cast<std::size_t>(channel)][static_cast<std::size_t>(key)];
    sounding_[static_cast<std::size_t>(voice)] = {channel, key, note.key - key, note.velocity};
    order_.push_back(voice);
    is_used_[static_cast<std::size_t>(channel)] = true;
    ++state.notes;
    // Voices that share a channel strike a key once at a time; a later stroke ends the one before.
    if (state.notes > 1 && state.since == tick) return;
    if (state.notes > 1) messages.push_back({0x80 | channel, key, release});
    state.since = tick;
    tune(channel, key, note.key - key, messages);
    messages.push_back({0x90 | channel, key, std::clamp<int>(note.velocity, 1, 127)});
}

void Voices::control(const ControlPoint& point, std::vector<Message>& messages) {
    if (point.voice < 0 || point.voice >= voice_count_) return;
    const Sounding& note = sounding_[static_cast<std::size_t>(point.voice)];
    if (point.number == ControlPoint::bend) {
        if (note.channel >= 0 && bends_notes()) tune(note.channel, note.key, note.fraction + point.value, messages);
        return;
    }
    const int value = controller_value(point);
    if (!is_mpe_) return messages.push_back(controller(channel_of(point.voice), point.number, value));
    values_[static_cast<std::size_t>(point.voice)][point.number] = value;
    if (note.channel < 0) return;
    sent_[static_cast<std::size_t>(note.channel)][point.number] = value;
    messages.push_back(controller(note.channel, point.number, value));
}

/// With MPE: sets the values of a voice, and no others, on the channel of its next note.
void Voices::set_controllers(int voice, int channel, std::vector<Message>& messages) {
    std::map<int, int>& values = values_[static_cast<std::size_t>(voice)];
    std::map<int, int>& sent = sent_[static_cast<std::size_t>(channel)];
    for (const auto& [number, value] : sent) values.try_emplace(number, usual_controller_value(number));
    for (const auto& [number, value] : values) {
        if (const auto last = sent.find(number); last != sent.end() && last->second == value) continue;
        sent[number] = value;
        messages.push_back(controller(channel, number, value));
    }
}

void Voices::slide(int voice, double key, std::int64_t tick, std::vector<Message>& messages) {
    if (voice < 0 || voice >= voice_count_ || !bends_notes()) return;
    const Sounding note = sounding_[static_cast<std::size_t>(voice)];
    if (note.channel < 0) return;
    if (std::fabs(key - note.key) <= bend_range_) return tune(note.channel, note.key, key - note.key, messages);
    Note anew;
    anew.voice = static_cast<std::int16_t>(voice);
    anew.key = key;
    anew.velocity = note.velocity;
    begin(anew, tick, messages);
}

void Voices::end(int voice, std::int64_t tick, std::vector<Message>& messages) {
    if (voice < 0 || voice >= voice_count_) return;
    Sounding& note = sounding_[static_cast<std::size_t>(voice)];
    if (note.channel < 0) return;
    Key& state = keys_[static_cast<std::size_t>(note.channel)][static_cast<std::size_t>(note.key)];
    if (--state.notes == 0) messages.push_back({0x80 | note.channel, note.key, release});
    if (is_mpe_ && note.channel != drum_channel) mpe_.release(note.channel, tick);
    note.channel = -1;
    order_.erase(std::find(order_.begin(), order_.end(), voice));
}

void Voices::silence(std::int64_t tick, std::vector<Message>& messages) {
    while (!order_.empty()) end(order_.front(), tick, messages);
    for (int channel = 0; channel < 16; ++channel) {
        if (!is_used_[static_cast<std::size_t>(channel)]) continue;
        messages.push_back(controller(channel, all_notes_off, 0));
        int& last = bends_[static_cast<std::size_t>(channel)];
        if (last != centre) messages.push_back(bend(channel, centre));
        last = centre;
    }
}

}  // namespace sikku::live
