#include "music/score/notation_excerpt.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace sikku {
namespace {

/// Changes in force from `from` on: the last one up to there, and those that follow.
template <class Change>
std::vector<Change> cut_changes(const std::vector<Change>& changes, std::int64_t from, std::int64_t to) {
    std::vector<Change> cut;
    for (Change change : changes) {
        if (change.onset >= to) break;
        if (change.onset <= from) cut.clear();
        change.onset = std::max<std::int64_t>(0, change.onset - from);
        cut.push_back(std::move(change));
    }
    return cut;
}

/// Begins a slur from before the cut at the first note, and ends one that leads out of it at the last.
void close_slurs(std::vector<NotatedSymbol>& symbols, bool is_open) {
    const auto is_note = [](const NotatedSymbol& symbol) { return symbol.kind == SymbolKind::note; };
    const auto first = std::find_if(symbols.begin(), symbols.end(), is_note);
    if (first == symbols.end()) return;
    first->begins_slur = first->begins_slur || is_open;
    for (const NotatedSymbol& symbol : symbols) is_open = (is_open || symbol.begins_slur) && !symbol.ends_slur;
    if (is_open) std::find_if(symbols.rbegin(), symbols.rend(), is_note)->ends_slur = true;
    for (NotatedSymbol& symbol : symbols) {
        if (symbol.begins_slur && symbol.ends_slur) symbol.begins_slur = symbol.ends_slur = false;
    }
}

void cut_voice(NotatedVoice& voice, std::int64_t from, std::int64_t to) {
    std::vector<NotatedSymbol> symbols;
    std::vector<TupletSpan> tuplets;
    std::map<int, int> numbers;  // of tuplets, by their numbers before
    bool is_in_slur = false;     // where the cut begins
    for (NotatedSymbol& symbol : voice.symbols) {
        if (symbol.onset < from) is_in_slur = (is_in_slur || symbol.begins_slur) && !symbol.ends_slur;
        if (symbol.onset < from || symbol.onset >= to) continue;
        if (symbol.tuplet >= 0) {
            const auto [number, is_new] = numbers.emplace(symbol.tuplet, static_cast<int>(tuplets.size()));
            if (is_new) {
                TupletSpan& span = tuplets.emplace_back(voice.tuplets[static_cast<std::size_t>(symbol.tuplet)]);
                span.from -= from;
                span.to -= from;
            }
            symbol.tuplet = number->second;
        }
        symbol.onset -= from;
        symbols.push_back(std::move(symbol));
    }
    if (!symbols.empty()) {
        symbols.front().tied_back = symbols.front().ends_slide = false;
        symbols.back().tied_forward = symbols.back().begins_slide = false;
    }
    voice.symbols = std::move(symbols);
    voice.tuplets = std::move(tuplets);
    close_slurs(voice.symbols, is_in_slur);
}

bool is_hairpin(const DynamicMark& mark) {
    return mark.kind == DynamicMark::Kind::crescendo || mark.kind == DynamicMark::Kind::diminuendo;
}

bool is_sounding(const NotatedVoice& voice) {
    return std::any_of(voice.symbols.begin(), voice.symbols.end(),
                       [](const NotatedSymbol& symbol) { return symbol.kind == SymbolKind::note; });
}

void cut_staff(Staff& staff, std::int64_t from, std::int64_t to) {
    staff.changes = cut_changes(staff.changes, from, to);
    for (NotatedVoice& voice : staff.voices) cut_voice(voice, from, to);
    const auto is_silent = [](const NotatedVoice& voice) { return !is_sounding(voice); };
    staff.voices.erase(std::remove_if(staff.voices.begin() + 1, staff.voices.end(), is_silent), staff.voices.end());
}

/// Onsets of the notes of some staves, ascending.
std::vector<std::int64_t> onsets_of(std::span<const Staff> staves) {
    std::vector<std::int64_t> onsets;
    for (const Staff& staff : staves) {
        for (const NotatedVoice& voice : staff.voices) {
            for (const NotatedSymbol& symbol : voice.symbols) {
                if (symbol.kind == SymbolKind::note && !symbol.tied_back) onsets.push_back(symbol.onset);
            }
        }
    }
    std::sort(onsets.begin(), onsets.end());
    onsets.erase(std::unique(onsets.begin(), onsets.end()), onsets.end());
    return onsets;
}

/// @param onsets  of the notes of the cut staff
std::vector<DynamicMark> cut_dynamics(const std::vector<DynamicMark>& marks, const std::vector<std::int64_t>& onsets,
                                      std::int64_t from, std::int64_t to) {
    using enum DynamicMark::Kind;
    std::vector<DynamicMark> cut;
    if (onsets.empty()) return cut;
    int current = -1;                    // level before the first note
    std::optional<DynamicMark> hairpin;  // begins before it and lasts
    const std::int64_t first = from + onsets.front();
    auto next = marks.begin();
    for (; next != marks.end() && next->onset < first; ++next) {
        if (next->kind == level) current = next->level;
        hairpin = is_hairpin(*next) ? std::optional(*next) : std::nullopt;
    }
    const bool begins_here = next != marks.end() && next->onset == first && next->kind == level;
    if (current >= 0 && !begins_here) cut.push_back({onsets.front(), level, current});
    if (hairpin && !(next != marks.end() && next->onset == first))
        cut.push_back({onsets.front(), hairpin->kind, current});
    for (; next != marks.end() && next->onset < to; ++next) {
        cut.push_back(*next);
        cut.back().onset -= from;
    }
    if (cut.empty() || !is_hairpin(cut.back())) return cut;
    // It leads to a level behind the cut, and ends at the last note.
    if (cut.back().onset < onsets.back()) {
        cut.push_back({onsets.back(), end, cut.back().level});
    } else {
        cut.pop_back();
    }
    return cut;
}

}  // namespace

std::vector<ChordMark> cut_chords(const std::vector<ChordMark>& chords, std::int64_t from, std::int64_t to) {
    return cut_changes(chords, from, to);
}

void cut_bars(NotatedPart& part, std::int64_t from, std::int64_t to) {
    part.keys = cut_changes(part.keys, from, to);
    for (Staff& staff : part.staves) cut_staff(staff, from, to);
    // Dynamics of the upper staff of two hands may be those of both.
    const bool are_shared = part.bracket == Bracket::brace && part.staves.back().dynamics.empty();
    for (Staff& staff : part.staves) {
        const std::span<const Staff> heard = are_shared ? std::span<const Staff>(part.staves) : std::span(&staff, 1);
        staff.dynamics = cut_dynamics(staff.dynamics, onsets_of(heard), from, to);
    }
}

}  // namespace sikku
