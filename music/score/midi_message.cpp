#include "music/score/midi_message.h"

#include "music/score/mpe.h"

#include <fmt/format.h>

#include <array>
#include <map>
#include <set>
#include <utility>

namespace sikku::midi {
namespace {

constexpr int bend_range_parameter = 0;
constexpr int tuning_program_parameter = 3;
constexpr int tuning_bank_parameter = 4;
constexpr int mpe_parameter = 6;

/// Adds a registered parameter: selects it, then sets both halves of its value.
void add_parameter(int channel, int parameter, int value, std::vector<Message>& messages) {
    for (const auto& [number, part] :
         std::array<std::pair<int, int>, 4>{{{101, 0}, {100, parameter}, {6, value}, {38, 0}}}) {
        messages.push_back(controller(channel, number, part));
    }
}

/// Deselects the parameter, so that further data entry has no effect.
void end_parameters(int channel, std::vector<Message>& messages) {
    for (const int number : {101, 100}) messages.push_back(controller(channel, number, 127));
}

}  // namespace

Message key_tuning(int channel, int key, std::uint32_t pitch) {
    const auto seven = [pitch](int shift) { return static_cast<int>(pitch >> shift & 0x7F); };
    return {0xF0, 0x7F, 0x7F, 8, 2, channel, 1, key, seven(14), seven(7), seven(0), 0xF7};
}

std::vector<Message> channel_setup(int channel, const MidiOptions& options, int program) {
    std::vector<Message> messages;
    if (options.microtonal && channel != drum_channel) {
        if (options.tuning == Tuning::bend) {
            add_parameter(channel, bend_range_parameter, options.bend_range, messages);
        } else {
            add_parameter(channel, tuning_bank_parameter, 0, messages);
            add_parameter(channel, tuning_program_parameter, channel, messages);
        }
        end_parameters(channel, messages);
    }
    messages.push_back({0xC0 | channel, program});
    return messages;
}

std::vector<Message> mpe_setup() {
    std::vector<Message> messages;
    add_parameter(mpe_master, mpe_parameter, mpe_members, messages);
    end_parameters(mpe_master, messages);
    for (int channel = 0; channel < channels; ++channel) {
        if (!is_mpe_member(channel)) continue;
        add_parameter(channel, bend_range_parameter, mpe_bend_range, messages);
        end_parameters(channel, messages);
    }
    return messages;
}

}  // namespace sikku::midi

namespace sikku {

std::vector<int> channel_slots(const ScoreHead& head) {
    std::set<int> programs;
    for (const Part& part : head.parts) {
        if (!part.is_drums) programs.insert(part.program);
    }
    if (programs.size() > midi::most_pitched_channels) {
        throw ScoreError(fmt::format("{} instruments in {} parts: MIDI has channels for {} besides drums",
                                     programs.size(), head.parts.size(), midi::most_pitched_channels));
    }
    std::size_t spare = midi::most_pitched_channels - programs.size();
    std::map<int, int> of_program;
    std::vector<int> slots;
    int next = 0;
    for (const Part& part : head.parts) {
        if (part.is_drums) {
            slots.push_back(0);
            continue;
        }
        const auto known = of_program.find(part.program);
        const bool has_own = known == of_program.end() || spare > 0;
        if (known != of_program.end() && spare > 0) --spare;
        slots.push_back(has_own ? next++ : known->second);
        of_program.try_emplace(part.program, slots.back());
    }
    return slots;
}

}  // namespace sikku
