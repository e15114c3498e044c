#include "music/score/dynamics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

namespace sikku {
namespace {

constexpr double step = 16;  // difference in velocity between two levels
constexpr int levels = 8;
constexpr double reluctance = 3;
constexpr std::size_t longest_hairpin = 4;  // bars
constexpr double least_slope = 2;           // change of velocity from bar to bar
constexpr double accent = 14;
constexpr std::int64_t least_rest = ticks_per_quarter / 2;  // shortest rest that a hairpin does not cross

double middle_velocity(int level) {
    return step * (level + 1);
}

/// The mean velocity of a bar with notes, without accents.
struct BarLoudness {
    std::int64_t bar = 0;
    std::int64_t onset = 0;  ///< onset of its first note
    double velocity = 0;
    double weight = 0;  ///< ticks in which it sounds
};

std::vector<BarLoudness> loudness_of(std::span<const Note> notes, std::int64_t bar_length) {
    std::vector<BarLoudness> bars;
    for (const Note& note : notes) {
        const std::int64_t bar = note.onset / bar_length;
        if (bars.empty() || bars.back().bar != bar) {
            bars.push_back({bar, note.onset, 0, 0});
        }
        const auto duration = static_cast<double>(note.duration);
        const int velocity = note.velocity - note.emphasis.velocity();
        bars.back().weight += duration;
        bars.back().velocity += (velocity - bars.back().velocity) * duration / bars.back().weight;
    }
    return bars;
}

/// Adds a hairpin that leads to a level at `to`, if it has enough notes.
void add_hairpin(DynamicMark mark, std::int64_t to, std::span<const Note> notes, std::vector<DynamicMark>& marks) {
    std::int64_t last = -1;
    std::int64_t end = 0;
    int onsets = 0;
    const auto* note = std::lower_bound(notes.data(), notes.data() + notes.size(), mark.onset,
                                        [](const Note& one, std::int64_t tick) { return one.onset < tick; });
    for (; note != notes.data() + notes.size() && note->onset < to; ++note) {
        if (note->onset != last) ++onsets;
        last = note->onset;
        end = std::max(end, note->onset + note->duration);
    }
    if (onsets < 2) return;
    marks.push_back(mark);
    if (to - end >= least_rest) marks.push_back({end, DynamicMark::Kind::end, mark.level});
}

/// Adds the dynamics of notes that state none. @param current  level in force before them; -1: none
void add_derived(std::span<const Note> notes, std::int64_t bar_length, int& current,
                 std::vector<DynamicMark>& marks) {
    using enum DynamicMark::Kind;
    const std::vector<BarLoudness> bars = loudness_of(notes, bar_length);
    std::size_t changed_at = 0;
    for (std::size_t i = 0; i < bars.size(); ++i) {
        const double velocity = bars[i].velocity;
        // A few notes alone do not change the level.
        if (current >= 0 && 2 * bars[i].weight < static_cast<double>(bar_length)) continue;
        if (current >= 0 && std::fabs(velocity - middle_velocity(current)) <= step / 2 + reluctance) continue;
        const int next = dynamic_level(velocity);
        if (next == current) continue;
        if (current >= 0) {
            const double side = next > current ? 1 : -1;
            std::size_t begin = i;
            while (begin > changed_at && i - begin < longest_hairpin && bars[begin].bar == bars[begin - 1].bar + 1 &&
                   side * (bars[begin].velocity - bars[begin - 1].velocity) >= least_slope) {
                --begin;
            }
            if (begin < i) {
                add_hairpin({bars[begin].onset, side > 0 ? crescendo : diminuendo, current}, bars[i].onset, notes,
                            marks);
            }
        }
        marks.push_back({bars[i].onset, level, next});
        current = next;
        changed_at = i;
    }
}

/// A dynamic that the pattern states for the notes of an onset.
struct StatedLevel {
    std::size_t first = 0;  ///< index of the first of these notes
    std::size_t end = 0;
    int level = -1;            ///< of the loudest; -1: none is stated
    bool is_repeated = false;  ///< the bar repeats the balance of a bar before
};

std::vector<StatedLevel> stated_levels(std::span<const Note> notes) {
    std::vector<StatedLevel> all;
    for (std::size_t i = 0; i < notes.size();) {
        StatedLevel& one = all.emplace_back(StatedLevel{i, i, -1, false});
        for (; i < notes.size() && notes[i].onset == notes[one.first].onset; ++i) {
            one.level = std::max<int>(one.level, notes[i].emphasis.dynamic);
        }
        one.end = i;
    }
    return all;
}

/// A balance such as loud bass notes and soft chords is printed once: of four or more bars in a row whose notes have
/// the same levels at the same places, or some of them, the second and all that follow are marked as repeated.
void find_balance(std::span<const Note> notes, std::int64_t bar_length, std::int64_t fresh_from,
                  std::vector<StatedLevel>& stated) {
    constexpr std::size_t fewest_bars = 4;
    struct Bar {
        std::size_t first = 0;  // in `stated`
        std::size_t end = 0;
        std::map<std::int64_t, int> levels;  // by place
    };
    std::vector<Bar> bars;
    std::int64_t last_bar = -1;
    for (std::size_t i = 0; i < stated.size(); ++i) {
        const std::int64_t onset = notes[stated[i].first].onset;
        if (onset / bar_length != last_bar) bars.push_back({i, i, {}});
        last_bar = onset / bar_length;
        bars.back().end = i + 1;
        bars.back().levels[onset % bar_length] = stated[i].level;
    }
    const auto is_balance = [](const Bar& bar) {
        const int level = bar.levels.begin()->second;
        return std::all_of(bar.levels.begin(), bar.levels.end(), [](const auto& one) { return one.second >= 0; }) &&
               std::any_of(bar.levels.begin(), bar.levels.end(),
                           [&](const auto& one) { return one.second != level; });
    };
    const auto mark_repeated = [&](std::size_t begin, std::size_t end) {
        bool is_printed = false;
        for (std::size_t bar = begin; bar < end; ++bar) {
            for (std::size_t k = bars[bar].first; k < bars[bar].end; ++k) stated[k].is_repeated = is_printed;
            // The first bar that is printed states it.
            const std::int64_t onset = notes[stated[bars[bar].first].first].onset;
            is_printed = is_printed || onset / bar_length * bar_length >= fresh_from;
        }
    };
    for (std::size_t i = 0; i < bars.size();) {
        const Bar& first = bars[i];
        std::size_t end = i + 1;
        if (is_balance(first)) {
            while (end < bars.size() && std::includes(first.levels.begin(), first.levels.end(),
                                                      bars[end].levels.begin(), bars[end].levels.end())) {
                ++end;
            }
        }
        const bool is_long = end - i >= fewest_bars;
        if (is_long) mark_repeated(i, end);
        i = is_long ? end : i + 1;
    }
}

}  // namespace

std::string_view dynamic_name(int level) {
    static constexpr std::array<std::string_view, levels> names = {"ppp", "pp", "p", "mp", "mf", "f", "ff", "fff"};
    return names[static_cast<std::size_t>(std::clamp(level, 0, levels - 1))];
}

int dynamic_level(double velocity) {
    return std::clamp(static_cast<int>(std::lround(velocity / step)) - 1, 0, levels - 1);
}

std::vector<DynamicMark> dynamics_of(std::span<const Note> notes, std::int64_t bar_length, std::int64_t fresh_from) {
    std::vector<DynamicMark> marks;
    int current = -1;
    std::size_t derived = 0;  // first note whose dynamics are still to be derived
    std::vector<StatedLevel> all = stated_levels(notes);
    find_balance(notes, bar_length, fresh_from, all);
    for (const StatedLevel& stated : all) {
        if (stated.level < 0) continue;
        add_derived(notes.subspan(derived, stated.first - derived), bar_length, current, marks);
        derived = stated.end;
        if (stated.level != current && !stated.is_repeated) {
            marks.push_back({notes[stated.first].onset, DynamicMark::Kind::level, stated.level});
        }
        current = stated.level;
    }
    add_derived(notes.subspan(derived), bar_length, current, marks);
    return marks;
}

std::vector<bool> accents_of(std::span<const Note> notes, std::int64_t bar_length) {
    std::vector<bool> accents(notes.size(), false);
    const bool is_stated = std::any_of(notes.begin(), notes.end(), [](const Note& note) {
        return note.emphasis.stress != Stress::plain || note.emphasis.dynamic >= 0;
    });
    if (is_stated) {
        std::transform(notes.begin(), notes.end(), accents.begin(),
                       [](const Note& note) { return note.emphasis.is_accented(); });
        return accents;
    }
    const std::vector<BarLoudness> bars = loudness_of(notes, bar_length);
    std::size_t bar = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < notes.size(); ++i) {
        while (bars[bar].bar != notes[i].onset / bar_length) ++bar;
        accents[i] = notes[i].velocity >= bars[bar].velocity + accent && i > 0 &&
                     notes[i].velocity >= notes[i - 1].velocity + accent;
        if (accents[i]) ++count;
    }
    if (3 * count > notes.size()) accents.assign(notes.size(), false);
    return accents;
}

}  // namespace sikku
