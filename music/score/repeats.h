// music/score/repeats.h: finds passages that are played several times in a row, for repeat signs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// The properties of the bars of a score that the search for repeats needs.
struct ComparedBars {
    std::vector<std::uint32_t> contents;  ///< of each bar: equal numbers for bars that are printed alike
    std::vector<bool> is_silent;          ///< of each bar
    std::vector<bool> is_change;          ///< of each bar: key, tempo or meter change at its beginning
    std::vector<bool> is_open;            ///< of each bar line, the last included: a note or a slide crosses it
};

/// Bars that are played several times in a row: a passage that is the same each time, or differs only at its end.
struct RepeatedBars {
    std::size_t first = 0;
    std::size_t count = 0;   ///< bars of the passage
    std::size_t ending = 0;  ///< bars at its end that differ the last time; 0: none
    std::size_t times = 2;
    std::size_t end() const { return first + times * count; }  ///< the first bar after all passes
    /// The number of bars that repeat signs save.
    std::size_t saved() const { return (times - 1) * count - ending; }
    bool operator==(const RepeatedBars&) const = default;
};

constexpr std::size_t fewest_repeated_bars = 4;
constexpr std::size_t most_times_repeated = 4;  ///< more are hard to count while playing

/// Finds the passages to print once: at least four bars, played two to `most_times` times; the last time, at most the
/// last quarter differs. No note crosses their bar lines, except the one after a second ending, and nothing
/// changes within. Those that save the most bars come first; of equal ones, the longer passage, then one that begins
/// with a bar that sounds, then the earlier one. The bars left before and after a passage are searched in the same
/// way; passages are not nested. Cost: about O(bars log^2 bars). Memory: O(bars log bars).
/// @return ascending
std::vector<RepeatedBars> find_repeats(const ComparedBars& bars, std::size_t most_times = most_times_repeated);

/// A passage between repeat signs, in ticks of the print. All are at bar lines.
struct PrintedRepeat {
    std::int64_t begin = 0;
    std::int64_t ending = 0;  ///< the first ending begins here; `end` if there are no endings
    std::int64_t end = 0;     ///< the end-repeat sign; the second ending begins here
    std::int64_t last = 0;    ///< the second ending ends here; `end` if there are no endings
    std::size_t times = 2;    ///< how often it is played
    bool has_endings() const { return ending < end; }
};

/// The repeats that have a sign or the border of an ending at a bar line; null: none.
struct RepeatSigns {
    const PrintedRepeat* begun = nullptr;
    const PrintedRepeat* first_ending = nullptr;  ///< its first ending begins
    const PrintedRepeat* ended = nullptr;         ///< its end-repeat sign; its second ending begins, if it has one
    const PrintedRepeat* closed = nullptr;        ///< its second ending ends
    bool any() const { return begun || first_ending || ended || closed; }
    bool has_sign() const { return begun || ended; }
};
RepeatSigns signs_at(std::span<const PrintedRepeat> repeats, std::int64_t tick);

/// The printed number of times that a passage is played: `3×`.
std::string count_of_repeats(const PrintedRepeat& repeat);
/// The passes that have the first ending: `1`, or `1SEPARATOR2` and so on.
std::string passes_of_first_ending(const PrintedRepeat& repeat, std::string_view separator);

/// The bar lines where repeats and endings begin and end, ascending.
std::vector<std::int64_t> borders_of(std::span<const PrintedRepeat> repeats);

/// The bar lines at which the bar before or after differs between passes: those of borders_of() without the ends of
/// second endings.
std::vector<std::int64_t> jumps_of(std::span<const PrintedRepeat> repeats);

/// The bar lines that are reached from several bars: the beginnings of repeats and of second endings.
std::vector<std::int64_t> entries_of(std::span<const PrintedRepeat> repeats);

/// Times of a score whose repeated bars are cut out.
class FoldedTime {
public:
    /// Cuts out the ticks from one to another. Cuts come in ascending order, in ticks of the whole score.
    void cut(std::int64_t from, std::int64_t to) { cuts_.push_back({from, to, removed() + (to - from)}); }
    bool is_cut(std::int64_t tick) const;
    /// A tick that is not cut out, as a tick of the print.
    std::int64_t at(std::int64_t tick) const;
    /// Ticks that are cut out.
    std::int64_t removed() const { return cuts_.empty() ? 0 : cuts_.back().removed; }

private:
    struct Cut {
        std::int64_t from;
        std::int64_t to;
        std::int64_t removed;  ///< up to its end
    };
    const Cut* last_from(std::int64_t tick) const;
    std::vector<Cut> cuts_;
};

}  // namespace sikku
