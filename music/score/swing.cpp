#include "music/score/swing.h"

#include "music/score/text_writer.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

namespace sikku {

std::optional<Swing> common_swing(const Notation& notation) {
    std::optional<Swing> common;
    for (const NotatedPart& part : notation.parts) {
        if (part.part.is_accompaniment) continue;
        if (common && *common != part.part.swing) return std::nullopt;
        common = part.part.swing;
    }
    return common && common->is_on() ? common : std::nullopt;
}

std::string swing_words(const Swing& swing) {
    const double percent = 100 * swing.share;
    std::string words = percent <= 61 ? "Light swing" : percent >= 71 ? "Hard swing" : "Swing";
    constexpr std::int64_t whole = 4 * ticks_per_quarter;
    switch (whole / swing.unit) {
        case 4:
            return words + " (quarters)";
        case 8:
            return words;
        case 16:
            return words + " (sixteenths)";
        default:
            return words +
                   fmt::format(" (1/{})", number(static_cast<double>(whole) / static_cast<double>(swing.unit), 3));
    }
}

std::string words_of_tempo(const Notation& notation, const ScoreHead& head) {
    const auto swing = common_swing(notation);
    if (!swing) return head.tempo_words;
    return head.tempo_words.empty() ? swing_words(*swing) : head.tempo_words + ", " + swing_words(*swing);
}

std::pair<int, int> swing_ratio(const Swing& swing) {
    const auto percent = static_cast<int>(std::lround(100 * swing.share));
    if (percent == 66 || percent == 67) return {2, 1};
    const int common = std::gcd(percent, 100 - percent);
    return {percent / common, (100 - percent) / common};
}

}  // namespace sikku
