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

std::vector<BarLoudness> loudness_of(std::span<const Note> notes, const BarLines& bars) {
    std::vector<BarLoudness> all;
    for (const Note& note : notes) {
        const std::int64_t bar = bars.number(note.onset);
        if (all.empty() || all.back().bar != bar) {
            all.push_back({bar, note.onset, 0, 0});
        }
        const auto duration = static_cast<double>(note.duration);
        const int velocity = note.velocity - note.emphasis.velocity();
        all.back().weight += duration;
        all.back().velocity += (velocity - all.back().velocity) * duration / all.back().weight;
    }
    return all;
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
void add_derived(std::span<const Note> notes, const BarLines& bars, int& current, std::vector<DynamicMark>& marks) {
    using enum DynamicMark::Kind;
    const std::vector<BarLoudness> loudness = loudness_of(notes, bars);
    std::size_t changed_at = 0;
    for (std::size_t i = 0; i < loudness.size(); ++i) {
        const double velocity = loudness[i].velocity;
        // A few notes alone do not change the level.
        if (current >= 0 && 2 * loudness[i].weight < static_cast<double>(bars.length(loudness[i].onset))) continue;
        if (current >= 0 && std::fabs(velocity - middle_velocity(current)) <= step / 2 + reluctance) continue;
        const int next = dynamic_level(velocity);
        if (next == current) continue;
        if (current >= 0) {
            const double side = next > current ? 1 : -1;
            std::size_t begin = i;
            while (begin > changed_at && i - begin < longest_hairpin &&
                   loudness[begin].bar == loudness[begin - 1].bar + 1 &&
                   side * (loudness[begin].velocity - loudness[begin - 1].velocity) >= least_slope) {
                --begin;
            }
            if (begin < i) {
                add_hairpin({loudness[begin].onset, side > 0 ? crescendo : diminuendo, current}, loudness[i].onset,
                            notes, marks);
            }
        }
        marks.push_back({loudness[i].onset, level, next});
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
/// the same levels at the same places, or some of them, the second and all that follow are marked as repeated, except
/// for the first after the beginning of a repeat or a second ending.
void find_balance(std::span<const Note> notes, const BarLines& bars, std::int64_t fresh_from,
                  std::span<const PrintedRepeat> repeats, std::vector<StatedLevel>& stated) {
    constexpr std::size_t fewest_bars = 4;
    struct Bar {
        std::size_t first = 0;  // in `stated`
        std::size_t end = 0;
        std::map<std::int64_t, int> levels;  // by place
    };
    std::vector<Bar> stating;
    std::int64_t last_bar = -1;
    for (std::size_t i = 0; i < stated.size(); ++i) {
        const std::int64_t onset = notes[stated[i].first].onset;
        if (bars.number(onset) != last_bar) stating.push_back({i, i, {}});
        last_bar = bars.number(onset);
        stating.back().end = i + 1;
        stating.back().levels[bars.place(onset)] = stated[i].level;
    }
    const auto is_balance = [](const Bar& bar) {
        const int level = bar.levels.begin()->second;
        return std::all_of(bar.levels.begin(), bar.levels.end(), [](const auto& one) { return one.second >= 0; }) &&
               std::any_of(bar.levels.begin(), bar.levels.end(),
                           [&](const auto& one) { return one.second != level; });
    };
    const std::vector<std::int64_t> entries = entries_of(repeats);
    const auto entries_before = [&](std::int64_t tick) {
        return std::upper_bound(entries.begin(), entries.end(), tick) - entries.begin();
    };
    const auto mark_repeated = [&](std::size_t begin, std::size_t end) {
        bool is_printed = false;
        std::ptrdiff_t entry = 0;
        for (std::size_t bar = begin; bar < end; ++bar) {
            const std::ptrdiff_t last_entry = entries_before(notes[stated[stating[bar].first].first].onset);
            is_printed = is_printed && last_entry == entry;
            entry = last_entry;
            for (std::size_t k = stating[bar].first; k < stating[bar].end; ++k) stated[k].is_repeated = is_printed;
            // The first bar that is printed states it.
            const std::int64_t onset = notes[stated[stating[bar].first].first].onset;
            is_printed = is_printed || bars.begin(onset) >= fresh_from;
        }
    };
    for (std::size_t i = 0; i < stating.size();) {
        const Bar& first = stating[i];
        std::size_t end = i + 1;
        if (is_balance(first)) {
            while (end < stating.size() && std::includes(first.levels.begin(), first.levels.end(),
                                                         stating[end].levels.begin(), stating[end].levels.end())) {
                ++end;
            }
        }
        const bool is_long = end - i >= fewest_bars;
        if (is_long) mark_repeated(i, end);
        i = is_long ? end : i + 1;
    }
}

/// Writes the dynamics of notes from one border of a repeat to the next.
class DynamicsWriter {
public:
    DynamicsWriter(std::span<const Note> notes, const BarLines& bars, std::int64_t fresh_from,
                   std::span<const PrintedRepeat> repeats)
        : notes_(notes), bars_(bars), stated_(stated_levels(notes)) {
        find_balance(notes, bars, fresh_from, repeats, stated_);
    }
    const std::vector<DynamicMark>& marks() const { return marks_; }

    void write_until(std::int64_t end) {
        std::size_t derived = place_.note;  // first note whose dynamics are still to be derived
        for (; place_.stated < stated_.size(); ++place_.stated) {
            const StatedLevel& stated = stated_[place_.stated];
            const std::int64_t onset = notes_[stated.first].onset;
            if (onset >= end) break;
            place_.note = stated.end;
            if (stated.level < 0) continue;
            add_derived(notes_.subspan(derived, stated.first - derived), bars_, place_.level, marks_);
            derived = stated.end;
            if (stated.level != place_.level && !stated.is_repeated) {
                marks_.push_back({onset, DynamicMark::Kind::level, stated.level});
            }
            place_.level = stated.level;
        }
        add_derived(notes_.subspan(derived, place_.note - derived), bars_, place_.level, marks_);
    }

    void write_repeat(const PrintedRepeat& repeat) {
        const Place before = place_;
        const auto marks_before = static_cast<std::ptrdiff_t>(marks_.size());
        write_until(repeat.ending);
        int in_force = place_.level;  // where the second ending begins
        write_until(repeat.end);
        if (place_.level != before.level) {
            marks_.erase(marks_.begin() + marks_before, marks_.end());
            place_ = before;
            place_.level = unknown;
            write_until(repeat.ending);
            in_force = place_.level;
            write_until(repeat.end);
        }
        if (repeat.has_endings() && place_.level != in_force) place_.level = unknown;
        write_until(repeat.last);
    }

private:
    static constexpr int unknown = -1;
    struct Place {
        std::size_t stated = 0;
        std::size_t note = 0;
        int level = unknown;  ///< in force
    };

    std::span<const Note> notes_;
    const BarLines& bars_;
    std::vector<StatedLevel> stated_;
    Place place_;
    std::vector<DynamicMark> marks_;
};

}  // namespace

std::string_view dynamic_name(int level) {
    static constexpr std::array<std::string_view, levels> names = {"ppp", "pp", "p", "mp", "mf", "f", "ff", "fff"};
    return names[static_cast<std::size_t>(std::clamp(level, 0, levels - 1))];
}

int dynamic_level(double velocity) {
    return std::clamp(static_cast<int>(std::lround(velocity / step)) - 1, 0, levels - 1);
}

std::vector<DynamicMark> dynamics_of(std::span<const Note> notes, const BarLines& bars, std::int64_t fresh_from,
                                     std::span<const PrintedRepeat> repeats) {
    DynamicsWriter writer(notes, bars, fresh_from, repeats);
    for (const PrintedRepeat& repeat : repeats) {
        writer.write_until(repeat.begin);
        writer.write_repeat(repeat);
    }
    writer.write_until(INT64_MAX);
    return writer.marks();
}

std::vector<bool> accents_of(std::span<const Note> notes, const BarLines& bars) {
    std::vector<bool> accents(notes.size(), false);
    const bool is_stated = std::any_of(notes.begin(), notes.end(), [](const Note& note) {
        return note.emphasis.stress != Stress::plain || note.emphasis.dynamic >= 0;
    });
    if (is_stated) {
        std::transform(notes.begin(), notes.end(), accents.begin(),
                       [](const Note& note) { return note.emphasis.is_accented(); });
        return accents;
    }
    const std::vector<BarLoudness> loudness = loudness_of(notes, bars);
    std::size_t bar = 0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < notes.size(); ++i) {
        while (loudness[bar].bar != bars.number(notes[i].onset)) ++bar;
        accents[i] = notes[i].velocity >= loudness[bar].velocity + accent && i > 0 &&
                     notes[i].velocity >= notes[i - 1].velocity + accent;
        if (accents[i]) ++count;
    }
    if (3 * count > notes.size()) accents.assign(notes.size(), false);
    return accents;
}

}  // namespace sikku
