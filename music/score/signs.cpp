#include "music/score/signs.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace sikku {
namespace {

void set_cents(Staff& staff, bool is_accompaniment, const BarLines& bars, std::span<const std::int64_t> entries) {
    for (NotatedVoice& voice : staff.voices) {
        std::int64_t current_bar = -1;
        auto current_entry = entries.begin();
        std::map<std::pair<int, int>, int> in_force;
        for (NotatedSymbol& symbol : voice.symbols) {
            if (symbol.kind != SymbolKind::note) continue;
            const auto entry = std::upper_bound(current_entry, entries.end(), symbol.onset);
            const bool is_new_bar = !is_accompaniment && bars.number(symbol.onset) != current_bar;
            if (is_new_bar || entry != current_entry) in_force.clear();
            current_bar = bars.number(symbol.onset);
            current_entry = entry;
            const auto set = [&](const Pitch& pitch, int& printed) {
                int& last = in_force[{pitch.height(), pitch.quarters}];
                const int cents = printed;
                if (symbol.tied_back || cents == last) printed = 0;
                last = cents;
            };
            set(symbol.pitch, symbol.cents);
            for (ChordNote& note : symbol.chord) set(note.pitch, note.cents);
        }
    }
}

}  // namespace

void set_accidentals(Staff& staff, std::span<const KeyChange> keys, const BarLines& bars) {
    struct Head {
        std::int64_t onset;
        const Pitch* pitch;
        bool* has_sign;
    };
    std::vector<Head> notes;
    for (NotatedVoice& voice : staff.voices) {
        for (NotatedSymbol& symbol : voice.symbols) {
            if (symbol.kind != SymbolKind::note || symbol.tied_back) continue;
            if (symbol.grace) notes.push_back({symbol.onset, &symbol.grace->pitch, &symbol.grace->has_sign});
            notes.push_back({symbol.onset, &symbol.pitch, &symbol.has_sign});
            for (ChordNote& other : symbol.chord) notes.push_back({symbol.onset, &other.pitch, &other.has_sign});
        }
    }
    std::stable_sort(notes.begin(), notes.end(), [](const Head& a, const Head& b) { return a.onset < b.onset; });
    std::int64_t current_bar = -1;
    std::map<std::pair<int, int>, int> in_force;
    std::array<int, 7> key{};
    std::size_t next_key = 0;
    for (const Head& note : notes) {
        if (bars.number(note.onset) != current_bar) {
            current_bar = bars.number(note.onset);
            while (next_key < keys.size() && keys[next_key].onset <= note.onset) key = signs_of(keys[next_key++].key);
            in_force.clear();
        }
        const Pitch& pitch = *note.pitch;
        const auto [entry, is_new] =
            in_force.try_emplace({pitch.octave, pitch.letter}, 2 * key[static_cast<std::size_t>(pitch.letter)]);
        *note.has_sign = entry->second != pitch.quarters;
        entry->second = pitch.quarters;
    }
}

void set_signs(Staff& staff, std::span<const KeyChange> keys, bool is_accompaniment, const BarLines& bars,
               std::span<const std::int64_t> entries) {
    set_accidentals(staff, keys, bars);
    set_cents(staff, is_accompaniment, bars, entries);
}

}  // namespace sikku
