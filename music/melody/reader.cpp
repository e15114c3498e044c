#include "music/melody/reader.h"

#include <cmath>

namespace sikku::mapping {
namespace {

Kind kind_of(const Command& command, bool moves_sound) {
    const bool is_finite = std::isfinite(command.value) && std::isfinite(command.angle.degrees);
    switch (command.action) {
        case Action::draw:
            return is_finite ? Kind::draw : Kind::not_finite;
        case Action::move:
            return !is_finite ? Kind::not_finite : moves_sound ? Kind::draw : Kind::move;
        case Action::turn:
            return is_finite ? Kind::turn : Kind::not_finite;
        case Action::push:
            return Kind::open;
        case Action::pop:
            return Kind::close;
        default:
            return Kind::nothing;
    }
}

}  // namespace

int loudness(const Melody& melody, int turned, double steps, std::size_t depth, std::int64_t onset) {
    switch (melody.loudness) {
        case Loudness::fixed:
            break;
        case Loudness::by_turn:
            return 80 + 18 * turned;
        case Loudness::by_depth:
            return std::max(30, 100 - 12 * static_cast<int>(std::min<std::size_t>(depth, 10)));
        case Loudness::by_length: {
            // Long notes are louder, and a phrase of four bars swells towards its middle.
            const double weight = 8.0 * std::min(4.0, steps);
            const auto phrase = static_cast<double>(4 * melody.meter.bar());
            const double within = std::fmod(static_cast<double>(onset), phrase) / phrase;
            return static_cast<int>(std::lround(58 + weight + 40 * within * (1 - within)));
        }
    }
    return 80;
}

int sign_of(const Angle& turn) {
    const double degrees = std::remainder(turn.degrees, 360.0);
    return degrees > 0 ? 1 : degrees < 0 ? -1 : 0;
}

std::vector<Kind> kinds_of(const Grammar& grammar, const Marks& marks, bool moves_sound) {
    std::vector<Kind> kinds;
    for (const SymbolInfo& symbol : grammar.symbols()) kinds.push_back(kind_of(symbol.command, moves_sound));
    for (Symbol symbol = 0; symbol < kinds.size(); ++symbol) {
        if (marks.level(symbol) > 0) kinds[symbol] = Kind::level;
        if (marks.phrase == symbol) kinds[symbol] = Kind::mark;
    }
    return kinds;
}

}  // namespace sikku::mapping
