#include "music/score/notation_repeats.h"

#include "engine/base/bits.h"
#include "music/score/bar_lines.h"
#include "music/score/instruments.h"
#include "music/score/turns.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace sikku {
namespace {

/// Data on which repeats depend in addition to the notes of the printed parts.
struct RepeatSources {
    const BarLines& bar_lines;
    std::int64_t first_bar = 0;  ///< bars that are printed
    std::int64_t bars = 0;
    std::span<const SectionChange> changes;
    std::optional<std::int64_t> slows_from;  ///< tick of a ritardando
    bool has_graces = false;                 ///< grace notes are printed
    /// The other keys in the chord of a note of a part.
    std::function<std::vector<double>(std::size_t part, const Note& note)> chord_of;
};

/// The numbers that describe what is printed in a bar.
using BarContents = std::vector<std::uint64_t>;

/// Compares bars by everything that is printed in them, in all parts: the places and lengths of notes, their keys,
/// chords, stress, dynamics, slides, grace notes and fermatas. Velocities have to be equal where dynamics are
/// printed. A bar of a ritardando differs from all others. Cost: O(notes log notes + bars log bars).
class BarComparison {
public:
    BarComparison(std::span<const PrintedPart> parts, const RepeatSources& sources)
        : parts_(parts),
          sources_(sources),
          contents_(static_cast<std::size_t>(sources.bars)),
          crossings_(static_cast<std::size_t>(sources.bars) + 2, 0) {}

    ComparedBars compare() {
        const auto count = static_cast<std::size_t>(sources_.bars);
        ComparedBars bars;
        bars.is_change.assign(count, false);
        for (std::size_t i = 0; i < parts_.size(); ++i) add_part(i);
        for (std::size_t i = 0; i < count; ++i) bars.is_silent.push_back(contents_[i].empty());
        for (std::size_t i = 0; i < count; ++i) {
            const std::int64_t onset = sources_.bar_lines.onset(sources_.first_bar + static_cast<std::int64_t>(i));
            // An upbeat is shorter than a bar of its meter.
            contents_[i].push_back(static_cast<std::uint64_t>(sources_.bar_lines.written(onset)));
            const bool slows = sources_.slows_from && *sources_.slows_from < onset + sources_.bar_lines.length(onset);
            contents_[i].push_back(slows ? i + 1 : 0);
        }
        bars.contents = numbered();
        std::int64_t crossing = 0;
        for (std::size_t i = 0; i <= count; ++i) {
            crossing += crossings_[i];
            bars.is_open.push_back(crossing > 0);
        }
        const auto add_change = [&](std::int64_t onset) {
            const std::int64_t bar = sources_.bar_lines.number(onset) - sources_.first_bar;
            if (bar >= 0 && bar < sources_.bars) bars.is_change[static_cast<std::size_t>(bar)] = true;
        };
        for (const SectionChange& change : sources_.changes) add_change(change.onset);
        for (const PrintedPart& part : parts_) {
            for (const KeyOfBars& key : part.keys) add_change(key.onset);
        }
        return bars;
    }

private:
    void add_part(std::size_t index) {
        const PrintedPart& part = parts_[index];
        for (std::size_t voice = 0; voice < part.voices.size(); ++voice) {
            for (const Note& note : part.voices[voice]) {
                const std::int64_t bar = sources_.bar_lines.number(note.onset);
                // Strokes of drums are not tied.
                if (!part.part.is_drums) add_crossings(note, bar);
                const std::int64_t printed = bar - sources_.first_bar;
                if (printed < 0 || printed >= sources_.bars) continue;
                add_note(note, index, voice, contents_[static_cast<std::size_t>(printed)]);
            }
        }
    }

    /// Records the bar lines that a note or its slide crosses.
    void add_crossings(const Note& note, std::int64_t bar) {
        const BarLines& lines = sources_.bar_lines;
        const std::int64_t end = note.onset + note.duration;
        // A slide leads to the note that begins where this one ends.
        const std::int64_t last = note.is_sliding ? lines.number(end) : lines.number(end - 1);
        const auto within = [&](std::int64_t line) {
            return static_cast<std::size_t>(
                std::clamp<std::int64_t>(line - sources_.first_bar, 0, sources_.bars + 1));
        };
        ++crossings_[within(bar + 1)];
        --crossings_[within(last + 1)];
    }

    void add_note(const Note& note, std::size_t index, std::size_t voice, BarContents& contents) const {
        const Part& part = parts_[index].part;
        const auto add = [&](auto number) { contents.push_back(static_cast<std::uint64_t>(number)); };
        const auto add_real = [&](double number) { contents.push_back(bit_cast<std::uint64_t>(number)); };
        add(index);
        add(voice);
        add(sources_.bar_lines.place(note.onset));
        add(note.duration);
        add_real(note.key);
        add(is_without_dynamics(part.program) && !part.is_drums ? 0 : note.velocity);
        add(static_cast<int>(note.emphasis.stress));
        add(note.emphasis.dynamic);
        add(note.is_sliding ? 1 : 0);
        add(note.glide.ticks);
        add_real(note.glide.semitones);
        add(note.has_fermata ? 1 : 0);
        add(part.touch.is_by_depth ? note.depth : 0);
        add(sources_.has_graces ? note.grace : 0);
        add(note.chord.quality);
        add(note.chord.root);
        add(note.chord.bass);
        std::vector<double> others = sources_.chord_of(index, note);
        std::sort(others.begin(), others.end());
        add(others.size());
        for (const double key : others) add_real(key);
    }

    /// The number of each distinct content.
    std::vector<std::uint32_t> numbered() {
        std::map<BarContents, std::uint32_t> known;
        std::vector<std::uint32_t> numbers;
        for (BarContents& contents : contents_) {
            const auto next = static_cast<std::uint32_t>(known.size());
            numbers.push_back(known.try_emplace(std::move(contents), next).first->second);
        }
        return numbers;
    }

    std::span<const PrintedPart> parts_;
    const RepeatSources& sources_;
    std::vector<BarContents> contents_;
    std::vector<std::int64_t> crossings_;  // by bar line: notes that cross it minus those that cross the previous one
};

/// The change in force before a tick.
const StaffChange* change_before(const std::vector<StaffChange>& changes, std::int64_t tick) {
    const auto next = std::lower_bound(changes.begin(), changes.end(), tick,
                                       [](const StaffChange& change, std::int64_t at) { return change.onset < at; });
    return next == changes.begin() ? nullptr : &*std::prev(next);
}

/// Cuts bars out of the notes and keys of a part.
void fold(PrintedPart& part, const FoldedTime& time) {
    for (std::vector<Note>& voice : part.voices) {
        std::erase_if(voice, [&](const Note& note) { return time.is_cut(note.onset); });
        for (Note& note : voice) note.onset = time.at(note.onset);
    }
    for (KeyOfBars& key : part.keys) key.onset = time.at(key.onset);
}

}  // namespace

void restate_clefs(std::vector<StaffChange>& changes, std::span<const PrintedRepeat> repeats) {
    // The change at a border, or a new one that states what is in force.
    const auto at = [&](std::int64_t border) -> StaffChange& {
        auto found =
            std::lower_bound(changes.begin(), changes.end(), border,
                             [](const StaffChange& change, std::int64_t tick) { return change.onset < tick; });
        if (found == changes.end() || found->onset != border) {
            StaffChange again = *std::prev(found);
            again.onset = border;
            again.restates_clef = again.restarts_line = false;
            found = changes.insert(found, again);
        }
        return *found;
    };
    for (const std::int64_t jump : jumps_of(repeats)) {
        const StaffChange* before = change_before(changes, jump);
        if (before && before->octaves != 0) at(jump).restarts_line = true;
    }
    for (const PrintedRepeat& repeat : repeats) {
        if (!repeat.has_endings() || repeat.ending <= changes.front().onset) continue;
        const Clef clef = change_before(changes, repeat.ending)->clef;
        if (change_before(changes, repeat.end)->clef != clef) at(repeat.end).restates_clef = true;
    }
}

/// Finds the passages that have repeat signs, and cuts out their further passes. @return the end of the print
std::int64_t Notator::fold_repeats(std::int64_t end) {
    RepeatSources sources{bar_lines_, printed_bars_.first, printed_bars_.count, changes_, {}, has_graces_, {}};
    if (ritardando_ > 0) sources.slows_from = end - ritardando_;
    sources.chord_of = [&](std::size_t part, const Note& note) {
        const auto chord = chords_.find({part, note.symbol, note.onset});
        return chord == chords_.end() ? std::vector<double>() : chord->second;
    };
    FoldedTime time;
    BarLines folded = bar_lines_;
    for (const RepeatedBars& bars : find_repeats(BarComparison(printed_, sources).compare(), most_repeats_)) {
        const auto onset = [&](std::size_t bar) {
            return bar_lines_.onset(printed_bars_.first + static_cast<std::int64_t>(bar));
        };
        const std::int64_t begin = onset(bars.first);
        const std::int64_t again = onset(bars.first + bars.count);
        const std::int64_t last = onset(bars.end());
        const std::int64_t ending = last - onset(bars.end() - bars.ending);
        const std::int64_t before = time.removed();
        repeats_.push_back(
            {begin - before, again - ending - before, again - before, again + ending - before, bars.times});
        time.cut(again, last - ending);
        folded = folded.without(again - before, last - ending - before);
        all_bars_ -= static_cast<std::int64_t>(bars.saved());
        printed_bars_.count -= static_cast<std::int64_t>(bars.saved());
    }
    if (repeats_.empty()) return end;
    bar_lines_ = folded;
    for (PrintedRepeat repeat : repeats_) {
        for (std::int64_t* tick : {&repeat.begin, &repeat.ending, &repeat.end, &repeat.last}) *tick -= first_tick();
        notation_.repeats.push_back(repeat);
    }
    for (PrintedPart& part : printed_) fold(part, time);
    for (SectionChange& change : changes_) change.onset = time.at(change.onset);
    std::map<ChordPlace, std::vector<double>> chords;
    for (auto& [place, keys] : chords_) {
        const auto& [part, symbol, onset] = place;
        if (!time.is_cut(onset)) chords[{part, symbol, time.at(onset)}] = std::move(keys);
    }
    chords_ = std::move(chords);
    std::map<std::pair<std::size_t, std::int64_t>, std::pair<std::int64_t, ChordSign>> signs;
    for (const auto& [place, chord] : chord_signs_) {
        if (time.is_cut(place.second)) continue;
        const std::int64_t onset = time.at(place.second);
        signs[{place.first, onset}] = {chord.first - place.second + onset, chord.second};
    }
    chord_signs_ = std::move(signs);
    return end - time.removed();
}

}  // namespace sikku
