#include "music/shared_channels.h"

#include "music/score/midi.h"

#include <algorithm>
#include <iterator>
#include <map>

namespace sikku {

std::vector<std::string> parts_controlled_together(const Ensemble& ensemble, const ScoreHead& head,
                                                   bool share_channels) {
    struct Channel {
        int voices = 0;
        bool is_controlled = false;
    };
    constexpr int drums = -1;
    const std::vector<int> slots = share_channels ? channel_slots(head) : std::vector<int>();
    std::map<int, Channel> channels;
    const auto is_controlled = [&](int voice) {
        const auto next = std::find_if(ensemble.players.begin(), ensemble.players.end(),
                                       [&](const Player& player) { return player.first_voice > voice; });
        const MelodicExpression& expression = std::prev(next)->melody.expression;
        return expression.pan.is_on() || expression.control.is_on();
    };
    // Voices of a part use one channel if channels are shared; those of drums always do.
    const auto each_shared = [&](const auto& visit) {
        int voice = 0;
        for (std::size_t i = 0; i < head.parts.size(); voice += head.parts[i].voices, ++i) {
            if (head.parts[i].is_drums || share_channels) {
                visit(head.parts[i], head.parts[i].is_drums ? drums : slots[i], voice);
            }
        }
    };
    each_shared([&](const Part& part, int channel, int voice) {
        channels[channel].voices += part.voices;
        // Accompaniments have no place on the curve to follow.
        if (!part.is_accompaniment && is_controlled(voice)) channels[channel].is_controlled = true;
    });
    std::vector<std::string> names;
    each_shared([&](const Part& part, int channel, int) {
        if (channels[channel].voices < 2 || !channels[channel].is_controlled) return;
        if (std::find(names.begin(), names.end(), part.name) == names.end()) names.push_back(part.name);
    });
    return names;
}

}  // namespace sikku
