#include "music/score/rhythm.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace sikku {
namespace {

constexpr std::int64_t whole_note = 4 * ticks_per_quarter;
constexpr std::int64_t eighth_note = ticks_per_quarter / 2;

/// True if units are parts of beats.
bool has_short_units(const Meter& meter) {
    return meter.unit >= 8;
}

/// The beats, in units, of a meter with short units and without groups of its own.
std::vector<std::int64_t> usual_groups(int beats) {
    if (beats == 8) return {3, 3, 2};
    if (beats % 3 == 0) return std::vector<std::int64_t>(static_cast<std::size_t>(beats) / 3, 3);
    if (beats == 1) return {1};
    std::vector<std::int64_t> groups(static_cast<std::size_t>(beats) / 2, 2);
    if (beats % 2 != 0) ++groups.front();
    return groups;
}

bool is_power_of_two(std::int64_t value) {
    return value > 0 && (value & (value - 1)) == 0;
}

/// True if the length is a note value without a dot.
bool is_simple(std::int64_t length) {
    return length % shortest_value == 0 && is_power_of_two(length / shortest_value) && length <= whole_note;
}

/// The places at which a bar may be divided, in ticks.
struct Bar {
    std::int64_t length;
    std::vector<std::int64_t> ends;  ///< ends of groups
    std::int64_t middle;             ///< the length if the bar has no middle
    bool is_grouped;                 ///< groups are more than simple beats
    std::int64_t beat;               ///< within groups; 0 if groups are beats

    explicit Bar(const Meter& meter)
        : length(meter.bar()),
          is_grouped(meter.groups[0] != 0 || has_short_units(meter)),
          beat(has_short_units(meter) ? 0 : whole_note / meter.unit) {
        const std::vector<std::int64_t> groups = groups_of(meter);
        ends.resize(groups.size());
        std::partial_sum(groups.begin(), groups.end(), ends.begin());
        middle = !is_grouped && has_middle(static_cast<std::int64_t>(groups.size())) ? length / 2 : length;
    }

    std::int64_t group_end(std::int64_t time) const { return *std::upper_bound(ends.begin(), ends.end(), time); }
    std::int64_t group_begin(std::int64_t time) const {
        const auto end = std::upper_bound(ends.begin(), ends.end(), time);
        return end == ends.begin() ? 0 : *(end - 1);
    }
    bool is_group_end(std::int64_t time) const { return std::binary_search(ends.begin(), ends.end(), time); }

    /// True if a value can be printed. @param is_last  no other value is tied to its end
    bool fits(std::int64_t from, std::int64_t to, bool is_last) const {
        const std::int64_t begin = group_begin(from);
        if (is_grouped) {
            if (to > group_end(from)) return from == begin && is_group_end(to);
            return fits_group(from - begin, to - begin, group_end(from) - begin, is_last);
        }
        if (from < middle && to > middle) {
            // In bars of four beats a value may begin with the bar, or lie between two beats.
            return to - from == length || (ends.size() <= 4 && (from == 0 || (from == begin && is_group_end(to))));
        }
        return fits_group(from, to, length, is_last);
    }

private:
    /// True if a number of beats has a middle that values off the beat do not hide. Two beats have none: a value from
    /// the middle of one to the middle of the other is a syncopation that readers recognise.
    static bool has_middle(std::int64_t beats) { return beats % 2 == 0 && beats > 2; }

    /// True if a value fits into a group, or a bar, of beats. Off the beat it does not hide a middle; only a value
    /// that begins in the middle of a beat reaches into the next: to the end of a pair, or to its middle if it is the
    /// last.
    bool fits_group(std::int64_t from, std::int64_t to, std::int64_t group, bool is_last) const {
        if (beat == 0) return fits_place(from, to);
        const std::int64_t place = from % beat;
        if (place == 0) return true;
        if (2 * place != beat) return fits_place(place, place + to - from);
        std::int64_t beats = group / beat;
        for (; has_middle(beats); beats /= 2) {
            const std::int64_t half = beats / 2 * beat;
            if (from < half && to > half) return false;
            if (from < half) continue;
            from -= half;
            to -= half;
        }
        if (beats == 2) return to <= 2 * beat;
        return to - from <= (is_last ? beat : beat / 2);
    }
    /// True if a value fits the metrical place of `from`, its largest power of two.
    static bool fits_place(std::int64_t from, std::int64_t to) {
        if (from == 0) return true;
        const std::int64_t place = from / shortest_value;
        const std::int64_t wider = 4 * (place & -place);
        return to <= (place / wider + 1) * wider * shortest_value;
    }
};

/// The sorted times from `begin` up to, but excluding, `end`.
std::span<const std::int64_t> between(std::span<const std::int64_t> times, std::int64_t begin, std::int64_t end) {
    const auto first = std::lower_bound(times.begin(), times.end(), begin);
    const auto last = std::lower_bound(first, times.end(), end);
    return times.subspan(static_cast<std::size_t>(first - times.begin()), static_cast<std::size_t>(last - first));
}

}  // namespace

NoteValue note_value(std::int64_t length) {
    // 3, 6, 12, … 64ths are the dotted ones.
    const bool dotted = length / shortest_value % 3 == 0;
    return {static_cast<int>(whole_note / (dotted ? length / 3 * 2 : length)), dotted};
}

BeatUnit beat_unit(const Meter& meter) {
    const bool is_dotted = has_short_units(meter) && meter.groups[0] == 0 && meter.beats % 3 == 0;
    const std::int64_t length = whole_note / meter.unit * (is_dotted ? 3 : 1);
    return {note_value(length), static_cast<double>(length) / static_cast<double>(ticks_per_quarter)};
}

std::string beats_text(const Meter& meter) {
    std::string groups;
    for (const std::uint8_t group : meter.groups) {
        if (group != 0) groups += (groups.empty() ? "" : "+") + std::to_string(group);
    }
    return groups.empty() ? std::to_string(meter.beats) : groups;
}

std::int64_t beat_end(std::int64_t time, const BarLines& bars) {
    const Meter& meter = bars.meter(time);
    const std::int64_t begin = bars.begin(time);
    if (has_short_units(meter)) return begin + Bar(meter).group_end(time - begin);
    const std::int64_t beat = std::min(whole_note / meter.unit, ticks_per_quarter);
    return begin + ((time - begin) / beat + 1) * beat;
}

bool has_groups(const Meter& meter) {
    return meter.groups[0] != 0 || (has_short_units(meter) && meter.beats >= 5 && meter.beats % 3 != 0 &&
                                    (meter.beats % 2 != 0 || meter.beats == 8));
}

std::vector<std::int64_t> groups_of(const Meter& meter) {
    const std::int64_t unit = whole_note / meter.unit;
    std::vector<std::int64_t> groups;
    if (meter.groups[0] != 0) {
        for (const std::uint8_t group : meter.groups) {
            if (group != 0) groups.push_back(group * unit);
        }
    } else if (has_short_units(meter)) {
        groups = usual_groups(meter.beats);
        for (std::int64_t& group : groups) group *= unit;
    } else {
        groups.assign(static_cast<std::size_t>(meter.beats), unit);
    }
    return groups;
}

std::vector<std::int64_t> strong_beats(const Meter& meter) {
    if (meter.groups[0] == 0 && !has_groups(meter)) {
        if (meter.beats % 2 != 0) return {0};
        return {0, meter.bar() / 2};
    }
    std::vector<std::int64_t> beats = {0};
    const std::vector<std::int64_t> groups = groups_of(meter);
    for (std::size_t i = 0; i + 1 < groups.size(); ++i) beats.push_back(beats.back() + groups[i]);
    return beats;
}

Grid::Grid(std::span<const std::int64_t> times, const BarLines& bars) {
    for (std::size_t i = 0; i < times.size();) {
        const Meter& meter = bars.meter(times[i]);
        const std::int64_t bar = bars.length(times[i]);
        const bool is_halved = is_simple(bar) && !has_groups(meter);
        const std::int64_t begin = bars.begin(times[i]);
        std::size_t end = i;
        while (end < times.size() && times[end] < begin + bar) ++end;
        const std::span<const std::int64_t> inside = times.subspan(i, end - i);
        i = end;
        if (is_halved) {
            divide(begin, bar, inside);
            continue;
        }
        std::int64_t from = begin;
        for (const std::int64_t group : groups_of(meter)) {
            divide(from, group, between(inside, from, from + group));
            from += group;
        }
    }
}

Grid grid_of(std::span<const Note> notes, const BarLines& bars) {
    std::vector<std::int64_t> times;
    for (const Note& note : notes) {
        if (times.empty() || times.back() != note.onset) times.push_back(note.onset);
        times.push_back(note.onset + note.duration);
    }
    std::sort(times.begin(), times.end());
    return Grid(times, bars);
}

/// Adds a tuplet if every time is on its grid.
bool Grid::add(std::int64_t from, std::int64_t length, int actual, int normal, std::span<const std::int64_t> times) {
    const TupletSpan span{from, from + length, actual, normal, static_cast<int>(whole_note * normal / length)};
    // The ticks of a quarter are not divisible by 7, so septuplets are rounded.
    // A tuplet cannot begin before an upbeat.
    const bool fits = from >= 0 && (length % actual == 0 || actual == 7) && length % normal == 0 &&
                      length / normal >= shortest_value &&
                      std::all_of(times.begin(), times.end(),
                                  [&](std::int64_t time) { return span.tick(span.note_at(time)) == time; });
    if (fits) tuplets_.push_back(span);
    return fits;
}

bool Grid::divide_parts(std::int64_t from, std::int64_t length, int parts, std::span<const std::int64_t> times) {
    bool is_exact = true;
    for (int i = 0; i < parts; ++i) {
        const std::int64_t begin = from + length / parts * i;
        is_exact = divide(begin, length / parts, between(times, begin, begin + length / parts)) && is_exact;
    }
    return is_exact;
}

/// Divides a stretch. @return true if all times are on the grid; the time at `from` always is
bool Grid::divide(std::int64_t from, std::int64_t length, std::span<const std::int64_t> times) {
    if (std::all_of(times.begin(), times.end(),
                    [&](std::int64_t time) { return (time - from) % shortest_value == 0; })) {
        return true;
    }
    if (!is_simple(length)) {
        for (const int parts : {3, 2, 5, 7}) {
            if (length % (parts * shortest_value) == 0) return divide_parts(from, length, parts, times);
        }
        return false;
    }
    if (add(from, length, 3, 2, times) || add(from, length, 5, 4, times) || add(from, length, 7, 4, times))
        return true;
    if (length < 2 * shortest_value) return false;
    const std::size_t before = tuplets_.size();
    const bool is_exact = divide_parts(from, length, 2, times);
    const bool is_crossed =
        length <= ticks_per_quarter && !std::binary_search(times.begin(), times.end(), from + length / 2);
    if (length > ticks_per_quarter || (is_exact && !is_crossed)) return is_exact;
    // One tuplet for a whole beat reads better than two that are tied.
    const std::vector<TupletSpan> parts(tuplets_.begin() + static_cast<std::ptrdiff_t>(before), tuplets_.end());
    tuplets_.resize(before);
    if (add(from, length, 6, 4, times) || add(from, length, 10, 8, times) || add(from, length, 12, 8, times))
        return true;
    tuplets_.insert(tuplets_.end(), parts.begin(), parts.end());
    return is_exact;
}

std::size_t Grid::tuplet_from(std::int64_t time) const {
    return static_cast<std::size_t>(
        std::upper_bound(tuplets_.begin(), tuplets_.end(), time,
                         [](std::int64_t at, const TupletSpan& span) { return at < span.to; }) -
        tuplets_.begin());
}

std::int64_t Grid::nearest(std::int64_t time) const {
    const std::size_t at = tuplet_from(time);
    const bool is_inside = at < tuplets_.size() && tuplets_[at].from <= time;
    if (is_inside) return tuplets_[at].tick(tuplets_[at].note_at(time));
    return (time + shortest_value / 2) / shortest_value * shortest_value;
}

std::int64_t Grid::after(std::int64_t time) const {
    const std::size_t at = tuplet_from(time);
    const bool is_inside = at < tuplets_.size() && tuplets_[at].from <= time;
    return is_inside ? tuplets_[at].tick(tuplets_[at].note_at(time) + 1) : time + shortest_value;
}

std::vector<WrittenValue> written_values(std::int64_t from, std::int64_t to, const Meter& meter) {
    // In 64ths, longest first. A dotted 64th would need 128ths.
    static constexpr std::array<std::int64_t, 13> lengths = {96, 64, 48, 32, 24, 16, 12, 8, 6, 4, 3, 2, 1};
    const Bar bar(meter);
    std::vector<WrittenValue> result;
    while (from < to) {
        // A 64th always fits.
        const auto found = std::find_if(lengths.begin(), lengths.end() - 1, [&](std::int64_t candidate) {
            const std::int64_t end = from + candidate * shortest_value;
            return end <= to && bar.fits(from, end, end == to);
        });
        const std::int64_t length = *found * shortest_value;
        result.push_back({length, note_value(length)});
        from += length;
    }
    return result;
}

namespace {

/// Places of rests in a bar.
class Rests {
public:
    explicit Rests(const Meter& meter) : bar_(meter), groups_(groups_of(meter)), unit_(whole_note / meter.unit) {}

    /// The longest rest that may begin at `from` and ends at `to` or before.
    std::int64_t longest(std::int64_t from, std::int64_t to) const {
        const std::int64_t begin = bar_.group_begin(from);
        const std::int64_t end = bar_.group_end(from);
        if (from == begin) {
            if (const std::int64_t pair = pair_at(from); pair > 0 && from + pair <= to) return pair;
            if (end <= to && is_printable(end - begin)) return end - begin;
        }
        return longest_within(from - begin, std::min(to, end) - begin, end - begin);
    }

private:
    static bool is_printable(std::int64_t length) {
        return is_simple(length) || (length % 3 == 0 && is_simple(length / 3 * 2));
    }

    /// Two beats, if they are half of a bar or of a half bar; otherwise 0.
    std::int64_t pair_at(std::int64_t from) const {
        const bool is_even =
            groups_.size() % 4 == 0 && std::equal(groups_.begin() + 1, groups_.end(), groups_.begin());
        const std::int64_t pair = 2 * groups_.front();
        return is_even && from % pair == 0 && is_printable(pair) ? pair : 0;
    }

    /// The longest rest within a group: rests begin at a multiple of their length, and have dots only at a beat.
    std::int64_t longest_within(std::int64_t from, std::int64_t to, std::int64_t group) const {
        const std::int64_t beat =
            is_simple(group) && group <= ticks_per_quarter ? group : std::min(unit_, ticks_per_quarter);
        const bool is_dotted_beat = group == 3 * unit_ && unit_ <= eighth_note;
        for (std::int64_t base = whole_note; base > shortest_value; base /= 2) {
            const bool is_short = base <= std::max(beat, unit_);
            const bool is_half = is_simple(group) && 2 * base <= group;
            const bool is_two_thirds = is_dotted_beat && from == 0 && base == 2 * unit_;
            const std::int64_t dotted = base / 2 * 3;
            if (2 * base <= beat && from % (2 * base) == 0 && from + dotted <= to) return dotted;
            if ((is_short || is_half || is_two_thirds) && from % base == 0 && from + base <= to) return base;
        }
        return shortest_value;
    }

    Bar bar_;
    std::vector<std::int64_t> groups_;
    std::int64_t unit_;
};

}  // namespace

std::vector<WrittenValue> written_rests(std::int64_t from, std::int64_t to, const Meter& meter) {
    const Rests rests(meter);
    std::vector<WrittenValue> result;
    while (from < to) {
        const std::int64_t length = rests.longest(from, to);
        result.push_back({length, note_value(length)});
        from += length;
    }
    return result;
}

std::vector<WrittenValue> written_rests(std::int64_t from, std::int64_t to, const TupletSpan& tuplet) {
    std::int64_t at = tuplet.note_at(from);
    const std::int64_t end = tuplet.note_at(to);
    std::vector<WrittenValue> result;
    while (at < end) {
        std::int64_t count = 4;
        while (at % count != 0 || at + count > end || tuplet.divisor < count) count /= 2;
        result.push_back(
            {tuplet.tick(at + count) - tuplet.tick(at), {static_cast<int>(tuplet.divisor / count), false}});
        at += count;
    }
    return result;
}

std::vector<WrittenValue> written_values(std::int64_t from, std::int64_t to, const TupletSpan& tuplet) {
    const bool is_odd = tuplet.actual % 2 != 0;
    std::int64_t at = tuplet.note_at(from);
    const std::int64_t end = tuplet.note_at(to);
    std::vector<WrittenValue> result;
    while (at < end) {
        std::int64_t count = 1;
        for (const std::int64_t candidate : {8, 6, 4, 3, 2}) {
            const bool is_dotted = candidate % 3 == 0;
            const bool is_printable =
                is_dotted ? tuplet.divisor * 2 >= candidate / 3 * 4 : tuplet.divisor >= candidate;
            const bool is_placed = is_odd || candidate == 2 || at % (is_dotted ? candidate / 3 * 2 : candidate) == 0;
            if (at + candidate <= end && is_printable && is_placed) {
                count = candidate;
                break;
            }
        }
        const bool is_dotted = count % 3 == 0;
        result.push_back({tuplet.tick(at + count) - tuplet.tick(at),
                          {static_cast<int>(tuplet.divisor / (is_dotted ? count / 3 * 2 : count)), is_dotted}});
        // Dots on the shortest value of a tuplet do not occur: their count would be a fraction.
        at += count;
    }
    return result;
}

namespace {

int beams_of(const BeamedNote& note) {
    int count = 0;
    for (int divisor = note.value.divisor; note.is_note && divisor >= 8; divisor /= 2) ++count;
    return count;
}

/// Sets beams of notes that share at least the first beam. @param parts  notes of the same part share all beams
void beam(std::span<BeamedNote> notes, std::span<const std::int64_t> parts) {
    if (notes.size() < 2) return;
    for (std::size_t i = 0; i < notes.size(); ++i) {
        const int count = beams_of(notes[i]);
        const auto beams_to = [&](std::size_t other) {
            return parts[other] == parts[i] ? beams_of(notes[other]) : 1;
        };
        const int before = i > 0 ? beams_to(i - 1) : 0;
        const int next = i + 1 < notes.size() ? beams_to(i + 1) : 0;
        for (int level = 0; level < count; ++level) {
            const bool goes_back = before > level;
            const bool goes_on = next > level;
            Beam& sign = notes[i].beams[static_cast<std::size_t>(level)];
            if (goes_back || goes_on) {
                sign = goes_back && goes_on ? Beam::inside : goes_on ? Beam::begin : Beam::end;
            } else {
                // A hook points to the note with which it fills a larger value.
                const bool is_first = i == 0 || parts[i - 1] != parts[i];
                const bool is_last = i + 1 == notes.size() || parts[i + 1] != parts[i];
                const bool fills_up = notes[i].onset % (2 * notes[i].length) == 0;
                const bool points_on =
                    i == 0 || (i + 1 < notes.size() && (is_first != is_last ? is_first : fills_up));
                sign = points_on ? Beam::forward_hook : Beam::backward_hook;
            }
        }
    }
}

/// The part of each note: its eighth within the group if there are notes shorter than 16ths, else the same for all.
std::vector<std::int64_t> parts_of(std::span<const BeamedNote> notes, std::int64_t group) {
    const bool has_short = std::any_of(
        notes.begin(), notes.end(), [](const BeamedNote& note) { return note.is_note && note.value.divisor > 16; });
    std::vector<std::int64_t> parts(notes.size(), 0);
    for (std::size_t i = 0; has_short && i < notes.size(); ++i) {
        const bool is_inside = i > 0 && notes[i].tuplet >= 0 && notes[i].tuplet == notes[i - 1].tuplet;
        parts[i] = is_inside ? parts[i - 1] : (notes[i].onset - group) / eighth_note;
    }
    return parts;
}

/// The span of a bar that eighths alone share, if it equals a note value: half of an even number of quarters, or
/// three quarters. None in meters without quarters.
std::int64_t wide_group(std::int64_t within, const Meter& meter, const Bar& bar) {
    if (meter.unit != 4) return -1;
    const std::int64_t begin = bar.is_grouped ? bar.group_begin(within) : 0;
    const std::int64_t length = bar.is_grouped ? bar.group_end(within) - begin : bar.length;
    if (length == 3 * ticks_per_quarter) return begin;
    const std::int64_t half = whole_note / 2;
    return length % half == 0 ? begin + (within - begin) / half * half : -1;
}

}  // namespace

void set_beams(std::span<BeamedNote> notes, std::span<const TupletSpan> tuplets, const BarLines& bars) {
    /// The group in which a note is beamed. Beats of x/4 that hold eighths alone share a wider one.
    const auto is_plain = [](const BeamedNote& note) {
        return note.tuplet < 0 && (!note.is_note || note.value.divisor <= 8);
    };
    std::vector<std::int64_t> group(notes.size());
    std::vector<std::int64_t> wide(notes.size());  // as wide_group(), from the beginning of the score; -1: none
    const Meter* last = nullptr;
    Bar bar((Meter()));
    for (std::size_t i = 0; i < notes.size(); ++i) {
        const BeamedNote& note = notes[i];
        const Meter& meter = bars.meter(note.onset);
        if (&meter != std::exchange(last, &meter)) bar = Bar(meter);
        const std::int64_t begin = bars.begin(note.onset);
        const std::int64_t within = note.onset - begin;
        const std::int64_t first = bar.is_grouped ? bar.group_begin(within) : 0;
        const std::int64_t unit = std::max<std::int64_t>(whole_note / meter.unit, eighth_note);
        group[i] = begin + (has_short_units(meter) ? first : first + (within - first) / unit * unit);
        const std::int64_t shared = wide_group(within, meter, bar);
        wide[i] = shared < 0 ? -1 : begin + shared;
        if (note.tuplet >= 0) {
            const TupletSpan& tuplet = tuplets[static_cast<std::size_t>(note.tuplet)];
            if (tuplet.to - tuplet.from > ticks_per_quarter) group[i] = tuplet.from;
        }
    }
    for (std::size_t i = 0; i < notes.size();) {
        std::size_t end = i + 1;
        while (end < notes.size() && wide[i] >= 0 && wide[end] == wide[i]) ++end;
        const std::span<const BeamedNote> together = notes.subspan(i, end - i);
        if (std::all_of(together.begin(), together.end(), is_plain)) {
            std::fill(group.begin() + static_cast<std::ptrdiff_t>(i),
                      group.begin() + static_cast<std::ptrdiff_t>(end), group[i]);
        }
        i = end;
    }
    for (std::size_t i = 0; i < notes.size();) {
        std::size_t end = i;
        while (end < notes.size() && group[end] == group[i] && beams_of(notes[end]) > 0 &&
               (end == i || notes[end].onset == notes[end - 1].onset + notes[end - 1].length)) {
            ++end;
        }
        const std::span<BeamedNote> together = notes.subspan(i, end - i);
        beam(together, parts_of(together, group[i]));
        i = std::max(end, i + 1);
    }
}

}  // namespace sikku
