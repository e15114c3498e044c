#include "music/score/midi.h"
#include "music/score/midi_voice.h"

#include <fmt/format.h>

#include <map>
#include <set>

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
