// music/score/player_parts.h: a score of its own for each player: bars of rest gathered, with cues before entries.
#pragma once

#include "music/score/notation.h"

#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// The part of one player, as a score with a single part.
struct PlayerPart {
    std::string name;
    Notation notation;
};

/// The parts of all players, in the order of the score: one for each part, and for parts whose staves a bracket joins
/// one for each staff. Bars of rest are gathered, except where the key or the tempo changes, at double bars and at a
/// last bar that is held. After eight bars of rest and more, a player of one staff gets the last bars of another part
/// as a cue: of the one with the most notes there, in the player's clef and transposition. Drums neither
/// receive nor provide cues.
/// Cost: O(players * notes).
std::vector<PlayerPart> player_parts(const Notation& score, bool has_cues = true);

/// A part of a file name: letters and digits of a name in lower case, joined by hyphens. `Clarinet in B♭` gives
/// `clarinet-in-b♭`.
std::string file_part(std::string_view name);

}  // namespace sikku
