#include "music/score/player_parts.h"

#include "engine/base/diagnostic.h"
#include "music/score/labels.h"
#include "music/score/signs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <set>
#include <span>
#include <utility>

namespace sikku {
namespace {

constexpr std::int64_t fewest_rests_before_cue = 8;  // bars
constexpr std::int64_t most_cue_bars = 2;

/// A staff that may be quoted as a cue, with its abbreviation.
struct Line {
    const NotatedPart* part = nullptr;
    const Staff* staff = nullptr;
    std::string name;
};

std::vector<Line> lines_of(const Notation& score) {
    std::vector<Line> lines;
    for (const NotatedPart& part : score.parts) {
        const std::size_t count = part.bracket == Bracket::bracket ? part.staves.size() : 1;
        for (std::size_t i = 0; i < part.staves.size(); ++i) {
            lines.push_back({&part, &part.staves[i], line_name(part.abbreviation, i, count)});
        }
    }
    return lines;
}

std::vector<bool> silent_bars(const NotatedPart& part, const Notation& score) {
    std::vector<bool> silent(static_cast<std::size_t>(score.bars), true);
    for (const Staff& staff : part.staves) {
        for (const NotatedVoice& voice : staff.voices) {
            for (const NotatedSymbol& symbol : voice.symbols) {
                if (!score.is_whole_rest(symbol))
                    silent[static_cast<std::size_t>(score.bar_lines.number(symbol.onset))] = false;
            }
        }
    }
    return silent;
}

// ---- cues

/// The symbols of a voice from one tick to another.
std::span<const NotatedSymbol> symbols_within(const NotatedVoice& voice, std::int64_t from, std::int64_t to) {
    const auto find = [&](std::int64_t tick) {
        return std::lower_bound(voice.symbols.begin(), voice.symbols.end(), tick,
                                [](const NotatedSymbol& symbol, std::int64_t at) { return symbol.onset < at; });
    };
    const auto first = find(from);
    return std::span(voice.symbols)
        .subspan(static_cast<std::size_t>(first - voice.symbols.begin()), static_cast<std::size_t>(find(to) - first));
}

std::ptrdiff_t onsets_in(const NotatedVoice& voice, std::int64_t from, std::int64_t to) {
    const auto symbols = symbols_within(voice, from, to);
    return std::count_if(symbols.begin(), symbols.end(), [](const NotatedSymbol& symbol) {
        return symbol.kind == SymbolKind::note && !symbol.tied_back;
    });
}

struct CueSource {
    const Line* line = nullptr;
    const NotatedVoice* voice = nullptr;
};

/// The voice with the most notes that sounds in the last bar before `to`; of equal ones, the first.
std::optional<CueSource> source_of(const std::vector<Line>& lines, const Staff& own, std::int64_t from,
                                   std::int64_t last_bar, std::int64_t to) {
    std::optional<CueSource> best;
    std::ptrdiff_t most = 0;
    for (const bool is_accompaniment : {false, true}) {
        for (const Line& line : lines) {
            if (line.staff == &own || line.part->part.is_drums) continue;
            if (line.part->part.is_accompaniment != is_accompaniment) continue;
            for (const NotatedVoice& voice : line.staff->voices) {
                const std::ptrdiff_t count = onsets_in(voice, last_bar, to) == 0 ? 0 : onsets_in(voice, from, to);
                if (count > most) best = CueSource{&line, &voice};
                most = std::max(most, count);
            }
        }
        if (best) break;
    }
    return best;
}

/// A pitch of one part as another part writes it.
Pitch rewritten(const Pitch& pitch, const NotatedPart& source, const NotatedPart& target) {
    const Transposition none;
    const Transposition& from = source.transposition ? *source.transposition : none;
    const Transposition& to = target.transposition ? *target.transposition : none;
    const int height = pitch.height() - from.letters + to.letters;
    const double key = pitch.key() - from.semitones + to.semitones;
    Pitch result{((height % 7) + 7) % 7, 0, 0};
    result.octave = (height - result.letter) / 7;
    result.quarters = static_cast<int>(std::lround(2 * (key - result.key())));
    constexpr int one_sign = 2;
    return std::abs(result.quarters) <= one_sign ? result : spelled(key, target.part.spelling);
}

/// Octaves by which a cue is written higher, so that it stands on the staff.
int octaves_for(const NotatedVoice& cue, const StaffChange& change) {
    double sum = 0;
    int count = 0;
    for (const NotatedSymbol& symbol : cue.symbols) {
        if (symbol.kind != SymbolKind::note) continue;
        sum += symbol.pitch.height();
        ++count;
    }
    const double away = middle_line(change.clef) + 7 * change.octaves - sum / std::max(1, count);
    return static_cast<int>(std::trunc(away / 5));  // an octave from more than five steps on
}

/// Copies some bars of a voice, with its note values only.
NotatedVoice copied(const NotatedVoice& source, std::int64_t from, std::int64_t to) {
    NotatedVoice copy;
    copy.voice = source.voice;
    copy.tuplets = source.tuplets;
    for (const NotatedSymbol& symbol : symbols_within(source, from, to)) {
        NotatedSymbol& cue = copy.symbols.emplace_back(symbol);
        cue.begins_slur = cue.ends_slur = cue.is_staccato = false;
        cue.syllable = {};
        cue.grace.reset();
        cue.is_accented = cue.is_ghost = cue.begins_slide = cue.ends_slide = cue.has_fermata = cue.slows_down = false;
        cue.leaves = cue.cents = 0;
        if (cue.kind == SymbolKind::bar_rest) cue.kind = SymbolKind::gap;
        // The highest note of a chord.
        if (!cue.chord.empty()) cue.pitch = cue.chord.back().pitch;
        cue.chord.clear();
    }
    copy.symbols.front().tied_back = false;
    copy.symbols.back().tied_forward = false;
    return copy;
}

/// @param jumps  bar lines of repeats; a cue does not cross them, because the music before them depends on the pass
void add_cue(NotatedPart& player, const Staff& own, const std::vector<Line>& lines, std::int64_t entry,
             const BarLines& bars, const std::vector<std::int64_t>& jumps) {
    const std::int64_t to = bars.onset(entry);
    const std::int64_t last_bar = bars.onset(entry - 1);
    std::int64_t from = bars.onset(entry - most_cue_bars);
    if (std::binary_search(jumps.begin(), jumps.end(), last_bar)) from = last_bar;
    const auto source = source_of(lines, own, from, last_bar, to);
    if (!source) return;
    while (onsets_in(*source->voice, from, bars.end(from)) == 0) from = bars.end(from);
    Staff& staff = player.staves.front();
    Cue cue{source->line->name, from, to, copied(*source->voice, from, to)};
    for (NotatedSymbol& symbol : cue.voice.symbols) {
        symbol.pitch = rewritten(symbol.pitch, *source->line->part, player);
    }
    const auto after = std::upper_bound(staff.changes.begin(), staff.changes.end(), from,
                                        [](std::int64_t tick, const StaffChange& one) { return tick < one.onset; });
    const int octaves = octaves_for(cue.voice, *(after - 1));
    for (NotatedSymbol& symbol : cue.voice.symbols) symbol.pitch.octave += octaves;
    Staff alone;
    alone.voices.push_back(std::move(cue.voice));
    set_accidentals(alone, player.keys, bars);
    cue.voice = std::move(alone.voices.front());
    staff.cues.push_back(std::move(cue));
}

void add_cues(Notation& player, const Staff& own, const std::vector<Line>& lines) {
    const std::vector<bool> silent = silent_bars(player.parts.front(), player);
    const std::vector<std::int64_t> jumps = jumps_of(player.repeats);
    std::int64_t rests = 0;
    for (std::int64_t bar = 0; bar < player.bars; ++bar) {
        if (silent[static_cast<std::size_t>(bar)]) {
            ++rests;
            continue;
        }
        // Before an entry after an end-repeat sign, the player would also read the cue in passes without the entry.
        const bool follows_repeat = signs_at(player.repeats, player.bar_lines.onset(bar)).ended;
        if (rests >= fewest_rests_before_cue && !follows_repeat) {
            add_cue(player.parts.front(), own, lines, bar, player.bar_lines, jumps);
        }
        rests = 0;
    }
}

// ---- rests

/// Bars that begin a new number of bars of rest, because something is printed at their beginning or before it.
std::set<std::int64_t> breaks_of(const Notation& player) {
    const NotatedPart& part = player.parts.front();
    std::set<std::int64_t> breaks;
    const auto add = [&](std::int64_t onset) { breaks.insert(player.bar_lines.number(onset)); };
    for (const std::int64_t onset : player.double_bars) add(onset);
    for (const std::int64_t onset : borders_of(player.repeats)) add(onset);
    for (const KeyChange& key : part.keys) add(key.onset);
    for (const Staff& staff : part.staves) {
        for (const StaffChange& change : staff.changes) add(change.onset);
        for (const DynamicMark& mark : staff.dynamics) add(mark.onset);
        for (const Cue& cue : staff.cues) {
            for (std::int64_t onset = cue.from; onset <= cue.to; onset = player.bar_lines.end(onset)) add(onset);
        }
        for (const NotatedVoice& voice : staff.voices) {
            for (const NotatedSymbol& symbol : voice.symbols) {
                if (symbol.slows_down || symbol.has_fermata) add(symbol.onset);
            }
        }
    }
    return breaks;
}

void gather_rests(Notation& player) {
    const std::vector<bool> silent = silent_bars(player.parts.front(), player);
    const std::set<std::int64_t> breaks = breaks_of(player);
    for (std::int64_t bar = 0; bar < player.bars;) {
        std::int64_t end = bar;
        while (end < player.bars && silent[static_cast<std::size_t>(end)] && (end == bar || !breaks.contains(end))) {
            ++end;
        }
        if (end - bar > 1) player.gathered_rests.emplace(bar, end - bar);
        bar = std::max(end, bar + 1);
    }
}

/// Moves chord symbols over bars of rest to the bar where the player enters, unless a repeat or a second ending
/// begins before it.
void move_silent_chords(Notation& player) {
    const std::vector<bool> silent = silent_bars(player.parts.front(), player);
    std::vector<ChordMark> kept;
    const std::vector<std::int64_t> turns = entries_of(player.repeats);
    const auto next_entry = [&](std::int64_t onset) {
        auto bar = static_cast<std::size_t>(player.bar_lines.number(onset));
        while (bar < silent.size() && silent[bar]) ++bar;
        return player.bar_lines.onset(static_cast<std::int64_t>(bar));
    };
    for (ChordMark chord : player.parts.front().chords) {
        const bool is_silent = silent[static_cast<std::size_t>(player.bar_lines.number(chord.onset))];
        const std::int64_t before = chord.onset;
        if (is_silent) chord.onset = next_entry(chord.onset);
        const auto turn = std::upper_bound(turns.begin(), turns.end(), before);
        if (turn != turns.end() && *turn <= chord.onset) continue;
        // The last one before an entry is in force there.
        if (!kept.empty() && kept.back().onset == chord.onset) kept.pop_back();
        if (chord.onset < player.end()) kept.push_back(chord);
    }
    player.parts.front().chords = std::move(kept);
}

/// Gives a player the names of the score's chords, as this part writes them.
void add_chords(const Notation& score, NotatedPart& part) {
    const auto source = std::find_if(score.parts.begin(), score.parts.end(),
                                     [](const NotatedPart& one) { return !one.chords.empty(); });
    if (source == score.parts.end() || part.part.is_drums) return;
    part.chords = source->chords;
    for (ChordMark& chord : part.chords) {
        chord.root = rewritten(chord.root, *source, part);
        if (chord.bass) chord.bass = rewritten(*chord.bass, *source, part);
    }
}

/// Copies the ritardando, which only the first part of the score carries.
void slow_down(const Notation& score, Notation& player) {
    const std::vector<NotatedSymbol>& first = score.parts.front().staves.front().voices.front().symbols;
    const auto slow =
        std::find_if(first.begin(), first.end(), [](const NotatedSymbol& symbol) { return symbol.slows_down; });
    if (slow == first.end()) return;
    std::vector<NotatedSymbol>& own = player.parts.front().staves.front().voices.front().symbols;
    for (NotatedSymbol& symbol : own) symbol.slows_down = false;
    const auto begin = std::find_if(own.begin(), own.end(),
                                    [&](const NotatedSymbol& symbol) { return symbol.onset >= slow->onset; });
    if (begin != own.end()) begin->slows_down = true;
}

}  // namespace

std::vector<PlayerPart> player_parts(const Notation& score, bool has_cues) {
    const std::vector<Line> lines = lines_of(score);
    std::vector<PlayerPart> players;
    for (const NotatedPart& part : score.parts) {
        const bool is_divided = part.bracket == Bracket::bracket && part.staves.size() > 1;
        for (std::size_t i = 0; i < (is_divided ? part.staves.size() : 1); ++i) {
            PlayerPart& player = players.emplace_back();
            player.name = line_name(part.name, i, is_divided ? part.staves.size() : 1);
            Notation& notation = player.notation;
            notation.changes = score.changes;
            notation.double_bars = score.double_bars;
            notation.repeats = score.repeats;
            notation.is_held = score.is_held;
            notation.bars = score.bars;
            notation.bar_lines = score.bar_lines;
            notation.is_cut = score.is_cut;
            notation.is_concert = score.is_concert && transposition_of(part.part.program) && !part.part.is_drums;
            notation.is_extracted = true;
            NotatedPart& own = notation.parts.emplace_back(part);
            own.name = player.name;
            if (is_divided) {
                own.staves = {part.staves[i]};
                own.bracket = Bracket::none;
            }
            add_chords(score, own);
            slow_down(score, notation);
            move_silent_chords(notation);
            if (has_cues && own.staves.size() == 1 && !own.part.is_drums) add_cues(notation, part.staves[i], lines);
            gather_rests(notation);
        }
    }
    return players;
}

std::string file_part(std::string_view name) {
    constexpr std::size_t most = 40;  // bytes
    std::string result;
    while (!name.empty() && result.size() < most) {
        const std::size_t length = std::max<std::size_t>(1, utf8_length(name));
        const char first = name[0];
        const bool is_letter = (first >= 'a' && first <= 'z') || (first >= '0' && first <= '9') || length > 1;
        if (first >= 'A' && first <= 'Z') {
            result += static_cast<char>(first - 'A' + 'a');
        } else if (is_letter) {
            result += name.substr(0, length);
        } else if (!result.empty() && !result.ends_with('-')) {
            result += '-';
        }
        name.remove_prefix(length);
    }
    while (result.ends_with('-')) result.pop_back();
    return result.empty() ? "part" : result;
}

}  // namespace sikku
