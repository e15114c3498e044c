#include "music/score/mpe.h"

#include <cstddef>
#include <tuple>

namespace sikku {

int MpeChannels::take(std::int64_t onset, std::int64_t end, int key, int voice) {
    int best = -1;
    for (int channel = 0; channel < static_cast<int>(uses_.size()); ++channel) {
        const Use& use = uses_[static_cast<std::size_t>(channel)];
        if (!is_mpe_member(channel) || use.end > onset) continue;
        if (use.end == onset && use.key == key && use.voice != voice) continue;
        if (best < 0) {
            best = channel;
            continue;
        }
        const Use& other = uses_[static_cast<std::size_t>(best)];
        if (std::tie(use.end, use.onset) < std::tie(other.end, other.onset)) best = channel;
    }
    if (best >= 0) uses_[static_cast<std::size_t>(best)] = {end, onset, key, voice};
    return best;
}

}  // namespace sikku
