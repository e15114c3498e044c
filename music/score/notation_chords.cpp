#include "music/score/chord_signs.h"
#include "music/score/notation.h"
#include "music/score/notation_excerpt.h"
#include "music/score/repeats.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace sikku {

/// The chords of the score and their onsets: in each bar those of the first part that has chords. If the first chord
/// of a bar is struck late and no earlier chord sounds before it, it applies to the whole bar.
std::vector<std::pair<std::int64_t, ChordSign>> Notator::changes_of_chords() const {
    std::map<std::int64_t, std::size_t> part_of_bar;
    for (const auto& [place, chord] : chord_signs_) {
        part_of_bar.try_emplace(bar_lines_.number(place.second), place.first);
    }
    std::map<std::int64_t, std::pair<std::int64_t, ChordSign>> chords;  // by onset
    for (const auto& [place, chord] : chord_signs_) {
        if (part_of_bar.at(bar_lines_.number(place.second)) == place.first) chords.emplace(place.second, chord);
    }
    std::vector<std::pair<std::int64_t, ChordSign>> changes;
    std::int64_t sounds_until = 0;
    ChordSign before;
    const std::vector<std::int64_t> entries = entries_of(repeats_);
    auto entry = entries.begin();
    for (const auto& [onset, chord] : chords) {
        const auto& [end, sign] = chord;
        const std::int64_t bar_begin = std::max<std::int64_t>(0, bar_lines_.begin(onset));
        const auto next_entry = std::upper_bound(entry, entries.end(), onset);
        if (sign != before || next_entry != entry)
            changes.emplace_back(sounds_until <= bar_begin ? bar_begin : onset, sign);
        entry = next_entry;
        sounds_until = std::max(sounds_until, end);
        before = sign;
    }
    return changes;
}

/// Names the chords above the first part with pitches.
void Notator::name_chords() {
    const auto first = std::find_if(printed_.begin(), printed_.end(), [](const PrintedPart& one) {
        return !one.part.is_drums && !one.part.is_accompaniment;
    });
    if (!has_chord_signs_ || first == printed_.end()) return;
    NotatedPart& part = notation_.parts[static_cast<std::size_t>(first - printed_.begin())];
    const int up = part.transposition ? part.transposition->semitones : 0;
    for (const auto& [onset, sign] : changes_of_chords()) {
        const std::array<Spelling, 12>& spelling = first->key_at(onset).spelling;
        const auto written = [&](int pitch_class) { return spelled(60 + pitch_class + up, spelling); };
        ChordMark mark{onset, sign.quality, written(sign.root), {}};
        if (sign.bass >= 0) mark.bass = written(sign.bass);
        part.chords.push_back(mark);
    }
    part.chords = cut_chords(part.chords, first_tick(), first_tick() + notation_.end());
    // A score does not begin with the end of a chord, unless a repeat leads back to it.
    const auto leads_back = [&](const ChordMark& chord) {
        return signs_at(notation_.repeats, chord.onset).begun != nullptr;
    };
    while (!part.chords.empty() && part.chords.front().quality < 0 && !leads_back(part.chords.front()))
        part.chords.erase(part.chords.begin());
    notation_.nameless_chords = static_cast<std::uint64_t>(std::count_if(
        part.chords.begin(), part.chords.end(), [](const ChordMark& chord) { return chord.quality < 0; }));
}

}  // namespace sikku
