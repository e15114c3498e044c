#include "music/score/repeats.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <optional>
#include <queue>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

namespace sikku {
namespace {

/// The number of bars at the end of a passage that can differ the last time.
std::size_t longest_ending(std::size_t count) {
    return count / 4;
}

/// The number of bars at the beginning of a passage that are the same each time.
std::size_t least_equal(std::size_t count) {
    return count - longest_ending(count);
}

/// Names of the stretches of 1, 2, 4, … bars: two stretches have the same name if their bars are equal (Karp, Miller
/// and Rosenberg 1972). The last length is the first at which all stretches differ.
class StretchNames {
public:
    explicit StretchNames(std::vector<std::uint32_t> contents) {
        names_.push_back(std::move(contents));
        while (name_longer()) {
        }
    }
    std::size_t levels() const { return names_.size(); }
    /// The names of stretches of 2^level bars, by their first bar.
    const std::vector<std::uint32_t>& at(std::size_t level) const { return names_[level]; }

    /// The number of equal bars from a and b on, b after a.
    std::size_t equal_after(std::size_t a, std::size_t b) const {
        std::size_t count = 0;
        for (std::size_t level = names_.size(); level-- > 0;) {
            const std::vector<std::uint32_t>& names = names_[level];
            if (b + count < names.size() && names[a + count] == names[b + count]) count += std::size_t{1} << level;
        }
        return count;
    }
    /// The number of equal bars before a and b, b after a.
    std::size_t equal_before(std::size_t a, std::size_t b) const {
        std::size_t count = 0;
        for (std::size_t level = names_.size(); level-- > 0;) {
            const std::size_t length = std::size_t{1} << level;
            const std::vector<std::uint32_t>& names = names_[level];
            if (a >= count + length && names[a - count - length] == names[b - count - length]) count += length;
        }
        return count;
    }

private:
    bool name_longer() {
        const std::vector<std::uint32_t>& half = names_.back();
        const std::size_t length = std::size_t{1} << (names_.size() - 1);
        if (half.size() <= length) return false;
        std::vector<std::pair<std::uint64_t, std::uint32_t>> pairs;
        for (std::size_t i = 0; i + length < half.size(); ++i) {
            pairs.emplace_back(std::uint64_t{half[i]} << 32 | half[i + length], static_cast<std::uint32_t>(i));
        }
        std::sort(pairs.begin(), pairs.end());
        std::vector<std::uint32_t> names(pairs.size());
        std::uint32_t name = 0;
        for (std::size_t i = 0; i < pairs.size(); ++i) {
            if (i > 0 && pairs[i].first != pairs[i - 1].first) ++name;
            names[pairs[i].second] = name;
        }
        const bool has_equal = name + 1 < pairs.size();
        names_.push_back(std::move(names));
        return has_equal;
    }

    std::vector<std::vector<std::uint32_t>> names_;
};

/// Bars `first` to `end`, each equal to the one `count` bars after it; maximal.
struct EqualRun {
    std::size_t count = 0;
    std::size_t first = 0;
    std::size_t end = 0;
};

/// Finds the runs that contain a passage, by the stretches of 2^level bars that each contains at a multiple of this
/// length: they occur again at a distance of about the same size, and thus a few times, or many in few runs.
std::vector<EqualRun> equal_runs(const StretchNames& names) {
    std::vector<EqualRun> runs;
    const std::size_t bars = names.at(0).size();
    std::vector<std::size_t> known_until(bars / 2 + 1, 0);  // end of the last run, by count
    std::size_t count = fewest_repeated_bars;
    for (std::size_t level = 1; level < names.levels() && count <= bars / 2; ++level) {
        const std::vector<std::uint32_t>& at = names.at(level);
        const std::size_t length = std::size_t{1} << level;
        // A run of twice the length less one contains a stretch of this length at a multiple of it.
        const std::size_t least = count;
        while (count <= bars / 2 && least_equal(count) < 4 * length - 1) ++count;
        if (count == least) continue;
        std::vector<std::size_t> order(at.size());
        for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
        std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return at[a] < at[b]; });
        std::vector<std::size_t> place(at.size());
        for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = i;
        for (std::size_t here = 0; here < at.size(); here += length) {
            const auto begin = order.begin() + static_cast<std::ptrdiff_t>(place[here]);
            auto other = std::lower_bound(begin, order.end(), here + least, [&](std::size_t one, std::size_t from) {
                return at[one] == at[here] && one < from;
            });
            for (; other != order.end() && at[*other] == at[here] && *other - here < count; ++other) {
                const std::size_t distance = *other - here;
                if (here < known_until[distance]) continue;
                const EqualRun run{distance, here - names.equal_before(here, *other),
                                   here + names.equal_after(here, *other)};
                known_until[distance] = run.end;
                if (run.end - run.first >= least_equal(distance)) runs.push_back(run);
            }
        }
    }
    return runs;
}

/// Chooses passages among the bars between two changes.
class RepeatSearch {
public:
    RepeatSearch(const ComparedBars& bars, std::size_t first, std::size_t end, std::size_t most_times)
        : offset_(first), most_times_(most_times) {
        const auto within = [&](const auto& all) { return all.begin() + static_cast<std::ptrdiff_t>(first); };
        const std::size_t count = end - first;
        is_open_.assign(within(bars.is_open), within(bars.is_open) + static_cast<std::ptrdiff_t>(count) + 1);
        // Bars are equal only if both or neither begin with a note held from before.
        for (std::size_t i = 0; i < count; ++i) {
            contents_.push_back(2 * bars.contents[first + i] + (is_open_[i] ? 1 : 0));
        }
        for (std::size_t i = 0; i <= count; ++i)
            last_border_.push_back(is_open_[i] && i > 0 ? last_border_[i - 1] : i);
        next_start_.assign(count + 1, count);
        next_sounding_.assign(count + 1, count);
        for (std::size_t i = count; i-- > 0;) {
            next_start_[i] = is_open_[i] ? next_start_[i + 1] : i;
            next_sounding_[i] = is_open_[i] || bars.is_silent[first + i] ? next_sounding_[i + 1] : i;
        }
    }

    void choose(std::vector<RepeatedBars>& chosen) {
        const std::size_t bars = contents_.size();
        if (bars < 2 * fewest_repeated_bars) return;
        free_[0] = bars;
        for (const EqualRun& run : equal_runs(StretchNames(contents_))) add(run, 0, bars);
        while (!candidates_.empty()) {
            const Candidate best = candidates_.top();
            candidates_.pop();
            const auto free = std::prev(free_.upper_bound(best.from));
            if (free->first != best.from || free->second != best.to) {
                // Passages chosen since may have left a shorter stretch.
                for (auto one = free_.lower_bound(best.from); one != free_.end() && one->first < best.to; ++one) {
                    add(best.run, one->first, one->second);
                }
                continue;
            }
            chosen.push_back(best.passage);
            chosen.back().first += offset_;
            free_[best.from] = best.passage.first;
            free_[best.passage.end()] = best.to;
        }
    }

private:
    /// The best passage of a run within free bars.
    struct Candidate {
        RepeatedBars passage;
        bool sounds = false;  // in its first bar
        EqualRun run;
        std::size_t from = 0;
        std::size_t to = 0;
        bool operator<(const Candidate& other) const {
            // If two passages are otherwise equal, prefer the earlier one.
            return std::tuple(passage.saved(), passage.count, sounds, other.passage.first) <
                   std::tuple(other.passage.saved(), other.passage.count, other.sounds, passage.first);
        }
    };

    void add(EqualRun run, std::size_t from, std::size_t to) {
        const EqualRun whole = run;
        run.first = std::max(run.first, from);
        run.end = std::min(run.end, to > run.count ? to - run.count : 0);
        if (run.first + least_equal(run.count) > run.end) return;
        auto passage = best_of(run, to, next_start_);
        if (!passage) return;
        const auto sounding = best_of(run, to, next_sounding_);
        if (sounding && sounding->saved() == passage->saved()) passage = sounding;
        const bool sounds = next_sounding_[passage->first] == passage->first;
        candidates_.push({*passage, sounds, whole, from, to});
    }

    std::optional<RepeatedBars> best_of(const EqualRun& run, std::size_t to,
                                        const std::vector<std::size_t>& next) const {
        std::optional<RepeatedBars> best;
        for (std::size_t first = next[run.first]; first + least_equal(run.count) <= run.end;
             first = next[first + 1]) {
            // Later passages cannot save more.
            if (best && most_saved(run, first) <= best->saved()) break;
            const auto passage = passage_from(run, first, to);
            if (passage && (!best || passage->saved() > best->saved())) best = passage;
        }
        return best;
    }

    /// The number of bars that a passage from a bar on would save if no note crossed its borders.
    std::size_t most_saved(const EqualRun& run, std::size_t first) const {
        const std::size_t again = (run.end - first) / run.count;
        const std::size_t rest = (run.end - first) % run.count;
        if (again + 1 >= most_times_) return (most_times_ - 1) * run.count;
        return again * run.count + (rest >= least_equal(run.count) ? rest : 0);
    }

    /// The passage from a bar on that saves the most.
    std::optional<RepeatedBars> passage_from(const EqualRun& run, std::size_t first, std::size_t to) const {
        const std::size_t count = run.count;
        const std::size_t again = (run.end - first) / count;
        const std::size_t rest = (run.end - first) % count;
        const std::size_t last = first + (again + 2) * count;
        if (again + 2 <= most_times_ && rest >= least_equal(count) && last <= to) {
            // In the last two passes, a note can be held into the first bar that differs in one and not in the other.
            std::size_t ending = run.end;
            if (is_open_[ending] || is_open_[ending + count]) ending = last_border_[ending - 1];
            const std::size_t least = first + again * count + least_equal(count);
            if (ending >= least) return RepeatedBars{first, count, last - count - ending, again + 2};
        }
        for (std::size_t times = std::min(again + 1, most_times_); times >= 2; --times) {
            if (!is_open_[first + times * count]) return RepeatedBars{first, count, 0, times};
        }
        return std::nullopt;
    }

    std::size_t offset_;
    std::size_t most_times_;
    std::vector<std::uint32_t> contents_;
    std::vector<bool> is_open_;
    std::vector<std::size_t> last_border_;    // last bar line up to here that no note crosses
    std::vector<std::size_t> next_start_;     // first bar from here on that a passage may begin with
    std::vector<std::size_t> next_sounding_;  // likewise, if it is not silent
    std::map<std::size_t, std::size_t> free_;
    std::priority_queue<Candidate> candidates_;
};

}  // namespace

std::vector<RepeatedBars> find_repeats(const ComparedBars& bars, std::size_t most_times) {
    std::vector<RepeatedBars> found;
    const std::size_t count = bars.contents.size();
    for (std::size_t first = 0; first < count;) {
        std::size_t end = first + 1;
        while (end < count && !bars.is_change[end]) ++end;
        RepeatSearch(bars, first, end, most_times).choose(found);
        first = end;
    }
    std::sort(found.begin(), found.end(),
              [](const RepeatedBars& a, const RepeatedBars& b) { return a.first < b.first; });
    return found;
}

RepeatSigns signs_at(std::span<const PrintedRepeat> repeats, std::int64_t tick) {
    RepeatSigns signs;
    auto repeat = std::lower_bound(repeats.begin(), repeats.end(), tick,
                                   [](const PrintedRepeat& one, std::int64_t at) { return one.last < at; });
    for (; repeat != repeats.end() && repeat->begin <= tick; ++repeat) {
        const PrintedRepeat* one = &*repeat;
        if (tick == one->begin) signs.begun = one;
        if (tick == one->end) signs.ended = one;
        if (one->has_endings() && tick == one->ending) signs.first_ending = one;
        if (one->has_endings() && tick == one->last) signs.closed = one;
    }
    return signs;
}

std::string count_of_repeats(const PrintedRepeat& repeat) {
    return std::to_string(repeat.times) + "\u00D7";
}

std::string passes_of_first_ending(const PrintedRepeat& repeat, std::string_view separator) {
    std::string text = "1";
    for (std::size_t pass = 2; pass < repeat.times; ++pass) text.append(separator).append(std::to_string(pass));
    return text;
}

std::vector<std::int64_t> borders_of(std::span<const PrintedRepeat> repeats) {
    std::vector<std::int64_t> borders;
    for (const PrintedRepeat& repeat : repeats) {
        for (const std::int64_t border : {repeat.begin, repeat.ending, repeat.end, repeat.last}) {
            if (borders.empty() || borders.back() != border) borders.push_back(border);
        }
    }
    return borders;
}

std::vector<std::int64_t> jumps_of(std::span<const PrintedRepeat> repeats) {
    std::vector<std::int64_t> jumps;
    for (const PrintedRepeat& repeat : repeats) {
        for (const std::int64_t jump : {repeat.begin, repeat.ending, repeat.end}) {
            if (jumps.empty() || jumps.back() != jump) jumps.push_back(jump);
        }
    }
    return jumps;
}

std::vector<std::int64_t> entries_of(std::span<const PrintedRepeat> repeats) {
    std::vector<std::int64_t> entries;
    for (const PrintedRepeat& repeat : repeats) {
        entries.push_back(repeat.begin);
        if (repeat.has_endings()) entries.push_back(repeat.end);
    }
    return entries;
}

const FoldedTime::Cut* FoldedTime::last_from(std::int64_t tick) const {
    const auto after = std::upper_bound(cuts_.begin(), cuts_.end(), tick,
                                        [](std::int64_t one, const Cut& cut) { return one < cut.from; });
    return after == cuts_.begin() ? nullptr : &*std::prev(after);
}

bool FoldedTime::is_cut(std::int64_t tick) const {
    const Cut* cut = last_from(tick);
    return cut && tick < cut->to;
}

std::int64_t FoldedTime::at(std::int64_t tick) const {
    const Cut* cut = last_from(tick);
    return cut ? tick - cut->removed : tick;
}

}  // namespace sikku
