#include "music/score/turns.h"

#include "music/score/notation.h"
#include "music/score/note_order.h"
#include "music/score/staves.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t most_voices_of_keyboard = 4;

/// Bars from the first to the last, both included.
struct Stretch {
    std::int64_t first = 0;
    std::int64_t last = 0;
};

/// A part of the score, with the bars in which it sounds.
struct TurnSource {
    std::size_t index = 0;
    int first_voice = 0;
    std::span<const std::vector<Note>> voices;
    std::vector<Stretch> bars;  ///< bars in which it sounds, ascending, not adjacent
    double height = 60;         ///< mean key
};

/// Sources that take turns.
struct Line {
    std::vector<const TurnSource*> sources;
    std::vector<Stretch> bars;
    double keys = 0;  ///< sum of the heights of the sources
    double height() const { return keys / static_cast<double>(sources.size()); }
};

/// A source and the bars in which it has the staves.
struct Turn {
    Stretch bars;
    const TurnSource* source = nullptr;
};

/// Sorts stretches and joins those that touch.
std::vector<Stretch> joined(std::vector<Stretch> all) {
    std::sort(all.begin(), all.end(), [](const Stretch& a, const Stretch& b) { return a.first < b.first; });
    std::vector<Stretch> result;
    for (const Stretch& one : all) {
        if (!result.empty() && one.first <= result.back().last + 1) {
            result.back().last = std::max(result.back().last, one.last);
        } else {
            result.push_back(one);
        }
    }
    return result;
}

bool share_a_bar(const std::vector<Stretch>& a, const std::vector<Stretch>& b) {
    for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
        if (a[i].first <= b[j].last && b[j].first <= a[i].last) return true;
        ++(a[i].last < b[j].last ? i : j);
    }
    return false;
}

TurnSource source_of(std::size_t index, int first_voice, std::span<const std::vector<Note>> voices,
                     const BarLines& bars) {
    TurnSource source{index, first_voice, voices, {}, 60};
    double sum = 0;
    for (const auto& voice : voices) {
        for (const Note& note : voice) {
            source.bars.push_back({bars.number(note.onset), bars.number(note.onset + note.duration - 1)});
            sum += note.key;
        }
    }
    if (!source.bars.empty()) source.height = sum / static_cast<double>(source.bars.size());
    source.bars = joined(std::move(source.bars));
    return source;
}

/// @return false if the parts need different staves
bool is_same_instrument(const Part& a, const Part& b) {
    return a.name == b.name && a.program == b.program && a.is_drums == b.is_drums && a.swing == b.swing;
}

std::vector<Line> lines_of(std::span<const Part> parts, const std::vector<TurnSource>& sources) {
    std::vector<Line> lines;
    for (const TurnSource& source : sources) {
        Line* best = nullptr;
        for (Line& line : lines) {
            if (!is_same_instrument(parts[line.sources.front()->index], parts[source.index]) ||
                share_a_bar(line.bars, source.bars)) {
                continue;
            }
            const auto distance = [&](const Line& one) { return std::fabs(one.height() - source.height); };
            if (!best || distance(line) < distance(*best)) best = &line;
        }
        if (!best) best = &lines.emplace_back();
        best->sources.push_back(&source);
        best->keys += source.height;
        std::vector<Stretch> bars = std::move(best->bars);
        bars.insert(bars.end(), source.bars.begin(), source.bars.end());
        best->bars = joined(std::move(bars));
    }
    return lines;
}

std::vector<Turn> turns_of(const Line& line) {
    std::vector<Turn> all;
    for (const TurnSource* source : line.sources) {
        for (const Stretch& bars : source->bars) all.push_back({bars, source});
    }
    std::sort(all.begin(), all.end(), [](const Turn& a, const Turn& b) { return a.bars.first < b.bars.first; });
    std::vector<Turn> turns;
    for (const Turn& one : all) {
        if (!turns.empty() && turns.back().source == one.source) {
            turns.back().bars.last = one.bars.last;
        } else {
            turns.push_back(one);
        }
    }
    return turns;
}

/// True if the notes of a turn do not need signs in a key.
bool fits(const Turn& turn, const KeyOfBars& key, const BarLines& bars) {
    const std::array<int, 7> signs = signs_of(key.key);
    for (const auto& voice : turn.source->voices) {
        auto note = std::lower_bound(voice.begin(), voice.end(), bars.onset(turn.bars.first),
                                     [](const Note& one, std::int64_t tick) { return one.onset < tick; });
        for (; note != voice.end() && bars.number(note->onset) <= turn.bars.last; ++note) {
            const Pitch pitch = spelled(note->key, key.spelling);
            if (pitch.quarters != 2 * signs[static_cast<std::size_t>(pitch.letter)]) return false;
        }
    }
    return true;
}

/// A change of key that is due when a source begins, and may come as soon as the one before has ended.
struct DueChange {
    Stretch bars;
    std::size_t part = 0;
    std::size_t key = 0;  ///< index in the keys of the part
};

/// @return the keys of a line @param due  receives the changes
std::vector<KeyOfBars> keys_of(std::span<const Part> parts, const Line& line, std::size_t index, const BarLines& bars,
                               std::vector<DueChange>& due) {
    const std::vector<Turn> turns = turns_of(line);
    const auto key_of = [&](const TurnSource& source, std::int64_t onset) {
        const Part& part = parts[source.index];
        return KeyOfBars{onset, printed_key(part), part.spelling, spelled(std::round(part.tonic), part.spelling)};
    };
    std::vector<KeyOfBars> keys = {key_of(turns.empty() ? *line.sources.front() : *turns.front().source, 0)};
    for (std::size_t i = 1; i < turns.size(); ++i) {
        KeyOfBars next = key_of(*turns[i].source, bars.onset(turns[i].bars.first));
        const bool is_same = signs_of(next.key) == signs_of(keys.back().key);
        if (!is_same && fits(turns[i], keys.back(), bars)) continue;
        if (is_same) {
            next.key = keys.back().key;
        } else {
            due.push_back({{turns[i - 1].bars.last + 1, turns[i].bars.first}, index, keys.size()});
        }
        keys.push_back(next);
    }
    return keys;
}

/// Moves changes to as few bar lines as possible.
void gather_changes(std::vector<DueChange> due, const BarLines& bars, std::vector<PrintedPart>& printed) {
    std::stable_sort(due.begin(), due.end(),
                     [](const DueChange& a, const DueChange& b) { return a.bars.last < b.bars.last; });
    std::int64_t at = -1;
    for (const DueChange& change : due) {
        if (at < change.bars.first) at = change.bars.last;
        printed[change.part].keys[change.key].onset = bars.onset(at);
    }
}

double mean_key(const std::vector<Note>& notes) {
    double sum = 0;
    for (const Note& note : notes) sum += note.key;
    return sum / static_cast<double>(notes.size());
}

/// The notes of a line, by voice: those of several sources from the highest to the lowest.
std::vector<std::vector<Note>> voices_of(const Line& line) {
    if (line.sources.size() == 1) {
        const auto& voices = line.sources.front()->voices;
        return {voices.begin(), voices.end()};
    }
    std::vector<std::vector<Note>> result;
    for (const TurnSource* source : line.sources) {
        std::vector<const std::vector<Note>*> order;
        for (const auto& voice : source->voices) {
            if (!voice.empty()) order.push_back(&voice);
        }
        std::stable_sort(order.begin(), order.end(),
                         [](const auto* a, const auto* b) { return mean_key(*a) > mean_key(*b); });
        result.resize(std::max(result.size(), std::max<std::size_t>(order.size(), 1)));
        for (std::size_t i = 0; i < order.size(); ++i) {
            result[i].insert(result[i].end(), order[i]->begin(), order[i]->end());
        }
    }
    for (auto& voice : result) sort_by_onset(voice);
    return result;
}

bool has_same_keys(const PrintedPart& a, const PrintedPart& b) {
    return std::equal(a.keys.begin(), a.keys.end(), b.keys.begin(), b.keys.end(),
                      [](const KeyOfBars& one, const KeyOfBars& other) {
                          return one.onset == other.onset && signs_of(one.key) == signs_of(other.key);
                      });
}

/// Joins two to four lines of one keyboard into a part for two hands, or for hands and pedal.
void join_hands(std::vector<PrintedPart>& printed) {
    for (std::size_t i = 0; i < printed.size(); ++i) {
        PrintedPart& upper = printed[i];
        if (upper.part.is_drums || !is_keyboard(upper.part.program) || upper.voices.size() != 1) continue;
        std::vector<std::size_t> others;
        bool fits = true;
        for (std::size_t k = 0; k < printed.size(); ++k) {
            const PrintedPart& other = printed[k];
            if (k == i || !is_same_instrument(upper.part, other.part)) continue;
            fits = fits && k > i && other.voices.size() == 1 && has_same_keys(upper, other);
            others.push_back(k);
        }
        if (others.empty() || others.size() >= most_voices_of_keyboard || !fits) continue;
        for (const std::size_t k : others) {
            upper.voices.push_back(std::move(printed[k].voices.front()));
            upper.sources.insert(upper.sources.end(), printed[k].sources.begin(), printed[k].sources.end());
        }
        upper.part.voices = static_cast<int>(upper.voices.size());
        for (auto k = others.rbegin(); k != others.rend(); ++k) {
            printed.erase(printed.begin() + static_cast<std::ptrdiff_t>(*k));
        }
    }
}

/// Number of notes that need an accidental in a key.
std::size_t signs_in(const PrintedPart& part, const std::vector<double>& others, const KeySignature& key) {
    const std::array<int, 7> signs = signs_of(key);
    const auto needs_one = [&](double sound) {
        const Pitch pitch = spelled(sound, part.keys.front().spelling);
        return pitch.quarters != 2 * signs[static_cast<std::size_t>(pitch.letter)];
    };
    auto count = static_cast<std::size_t>(std::count_if(others.begin(), others.end(), needs_one));
    for (const auto& voice : part.voices) {
        count += static_cast<std::size_t>(
            std::count_if(voice.begin(), voice.end(), [&](const Note& note) { return needs_one(note.key); }));
    }
    return count;
}

void set_key(PrintedPart& part, const KeySignature& key) {
    for (KeyOfBars& one : part.keys) one.key = key;
}

/// The place of a tonic on the line of fifths, C at 0.
int tonic_of(const KeySignature& key) {
    return key.fifths + static_cast<int>(key.mode) - 1;
}

}  // namespace

void agree_on_keys(std::vector<PrintedPart>& printed, std::span<const std::vector<double>> others) {
    std::map<int, std::vector<std::size_t>> on_tonic;
    std::vector<std::size_t> all;
    for (std::size_t i = 0; i < printed.size(); ++i) {
        const std::vector<KeyOfBars>& keys = printed[i].keys;
        const bool is_single = std::all_of(keys.begin(), keys.end(), [&](const KeyOfBars& key) {
            return signs_of(key.key) == signs_of(keys.front().key);
        });
        if (printed[i].part.is_drums || !is_single) continue;
        all.push_back(i);
        if (const auto& key = printed[i].keys.front().key) on_tonic[tonic_of(*key)].push_back(i);
    }
    for (const auto& [tonic, parts] : on_tonic) {
        std::optional<KeySignature> best;
        std::size_t fewest = 0;
        for (const std::size_t candidate : parts) {
            const KeySignature key = *printed[candidate].keys.front().key;
            std::size_t signs = 0;
            for (const std::size_t part : parts) signs += signs_in(printed[part], others[part], key);
            if (best && signs >= fewest) continue;
            best = key;
            fewest = signs;
        }
        for (const std::size_t part : parts) set_key(printed[part], *best);
    }
    if (all.empty() || !printed[all.front()].keys.front().key) return;
    const KeySignature first = *printed[all.front()].keys.front().key;
    for (const std::size_t part : all) {
        if (signs_in(printed[part], others[part], first) == 0) set_key(printed[part], first);
    }
}

const KeyOfBars& PrintedPart::key_at(std::int64_t onset) const {
    const auto next = std::upper_bound(keys.begin(), keys.end(), onset,
                                       [](std::int64_t tick, const KeyOfBars& key) { return tick < key.onset; });
    return next == keys.begin() ? keys.front() : *(next - 1);
}

std::vector<PrintedPart> share_parts(std::span<const Part> parts, std::span<const std::vector<Note>> voices,
                                     const BarLines& bars) {
    std::vector<TurnSource> sources;
    std::size_t first_voice = 0;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const auto count = static_cast<std::size_t>(parts[i].voices);
        sources.push_back(source_of(i, static_cast<int>(first_voice), voices.subspan(first_voice, count), bars));
        first_voice += count;
    }
    std::vector<PrintedPart> printed;
    std::vector<DueChange> due;
    for (const Line& line : lines_of(parts, sources)) {
        const auto* const sounding = std::find_if(line.sources.data(), line.sources.data() + line.sources.size(),
                                                  [](const TurnSource* source) { return !source->bars.empty(); });
        PrintedPart one;
        one.part =
            parts[(sounding == line.sources.data() + line.sources.size() ? line.sources.front() : *sounding)->index];
        one.first_voice = line.sources.front()->first_voice;
        one.voices = voices_of(line);
        one.part.voices = static_cast<int>(one.voices.size());
        for (const TurnSource* source : line.sources) {
            one.sources.push_back(source->index);
            one.part.has_chords = one.part.has_chords || parts[source->index].has_chords;
        }
        one.keys = keys_of(parts, line, printed.size(), bars, due);
        printed.push_back(std::move(one));
    }
    gather_changes(std::move(due), bars, printed);
    join_hands(printed);
    return printed;
}

}  // namespace sikku
