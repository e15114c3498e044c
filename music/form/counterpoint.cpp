#include "music/form/counterpoint.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

namespace sikku {
namespace {

constexpr std::array<std::int64_t, 7> moves = {0, 1, -1, 2, -2, 3, -3};

/// The notes of a voice, by onset, none overlapping.
class Line {
public:
    void add(const Note& note) { notes_.push_back(note); }
    void sort() {
        std::stable_sort(notes_.begin(), notes_.end(),
                         [](const Note& a, const Note& b) { return a.onset < b.onset; });
    }
    /// The key that sounds at a tick.
    std::optional<double> at(std::int64_t tick) const {
        const auto after = first_after(tick);
        if (after == notes_.begin()) return std::nullopt;
        const Note& note = *std::prev(after);
        return note.onset + note.duration > tick ? std::optional(note.key) : std::nullopt;
    }
    /// Onsets from `begin` to before `end`.
    template <class Visit>
    void onsets(std::int64_t begin, std::int64_t end, Visit visit) const {
        for (auto note = first_after(begin - 1); note != notes_.end() && note->onset < end; ++note)
            visit(note->onset);
    }
    /// The key of the last note that began before `tick`.
    std::optional<Note> before(std::int64_t tick) const {
        const auto after = first_after(tick - 1);
        return after == notes_.begin() ? std::nullopt : std::optional(*std::prev(after));
    }
    bool begins_at(std::int64_t tick) const {
        const auto after = first_after(tick - 1);
        return after != notes_.end() && after->onset == tick;
    }

private:
    std::vector<Note>::const_iterator first_after(std::int64_t tick) const {
        return std::upper_bound(notes_.begin(), notes_.end(), tick,
                                [](std::int64_t at, const Note& note) { return at < note.onset; });
    }
    std::vector<Note> notes_;
};

int interval_class(double a, double b) {
    const auto semitones = static_cast<int>(std::lround(std::fabs(a - b)));
    return semitones % 12;
}

bool is_perfect(int interval) {
    return interval == 0 || interval == 7;
}

/// Ticks of a bar that are strong: its beginning, and the beginnings of its groups or its middle.
std::vector<std::int64_t> strong_beats(const Meter& meter) {
    std::vector<std::int64_t> beats = {0};
    const std::int64_t beat = meter.bar() / meter.beats;
    for (std::size_t i = 0; i + 1 < meter.groups.size() && meter.groups[i + 1] != 0; ++i) {
        beats.push_back(beats.back() + beat * meter.groups[i]);
    }
    if (meter.groups.front() == 0 && meter.beats % 2 == 0) beats.push_back(meter.bar() / 2);
    return beats;
}

class Checker {
public:
    explicit Checker(const Meter& meter) : bar_(meter.bar()), beats_(strong_beats(meter)) {}

    /// Counts what is wrong if `note` sounds after `last` in its voice, against another voice.
    int faults(const Note& note, const std::optional<Note>& last, const Line& other) const {
        int count = 0;
        const std::int64_t end = note.onset + note.duration;
        for (std::int64_t bar = note.onset / bar_ * bar_; bar < end; bar += bar_) {
            for (const std::int64_t beat : beats_) {
                const std::int64_t tick = bar + beat;
                if (tick < note.onset || tick >= end) continue;
                const auto against = other.at(tick);
                if (against && !is_consonant(std::min(*against, note.key), std::max(*against, note.key))) ++count;
            }
        }
        // Parallels where both begin a note after another.
        const auto now = other.at(note.onset);
        if (last && now && other.begins_at(note.onset)) {
            const auto before = other.before(note.onset);
            const bool both_move = before && before->key != *now && last->key != note.key;
            if (both_move) {
                const int interval = interval_class(note.key, *now);
                if (is_perfect(interval) && interval == interval_class(last->key, before->key)) count += 2;
            }
        }
        return count;
    }

private:
    std::int64_t bar_;
    std::vector<std::int64_t> beats_;
};

}  // namespace

bool is_consonant(double low, double high) {
    const int interval = interval_class(low, high);
    return interval == 0 || interval == 3 || interval == 4 || interval == 7 || interval == 8 || interval == 9;
}

CounterpointReport make_strict(std::span<const FormNote> fixed, std::vector<FormNote>& part, const Melody& melody,
                               const Meter& meter) {
    CounterpointReport report;
    const Checker checker(meter);
    std::map<int, Line> lines;
    for (const FormNote& one : fixed) lines[one.note.voice].add(one.note);
    for (auto& [voice, line] : lines) line.sort();
    std::map<int, std::vector<FormNote*>> voices;
    for (FormNote& one : part) voices[one.note.voice].push_back(&one);
    for (auto& [voice, notes] : voices) {
        std::stable_sort(notes.begin(), notes.end(),
                         [](const FormNote* a, const FormNote* b) { return a->note.onset < b->note.onset; });
        std::optional<Note> last;
        std::int64_t last_degree = 0;
        Line line;
        for (FormNote* one : notes) {
            if (one->has_degree) {
                int best_faults = -1;
                FormNote best = *one;
                for (const std::int64_t move : moves) {
                    FormNote tried = *one;
                    tried.degree += move;
                    const bool falling = last && tried.degree < last_degree;
                    if (move != 0) tried.note.key = key_within(melody, tried.degree, falling);
                    int faults = 0;
                    for (const auto& [number, other] : lines) faults += checker.faults(tried.note, last, other);
                    if (best_faults >= 0 && faults >= best_faults) continue;
                    best_faults = faults;
                    best = tried;
                    if (faults == 0) break;
                }
                report.moved += best.degree != one->degree ? 1 : 0;
                report.left += static_cast<std::uint64_t>(std::max(best_faults, 0));
                *one = best;
                last_degree = one->degree;
            }
            last = one->note;
            line.add(one->note);
        }
        lines[voice] = std::move(line);
    }
    return report;
}

}  // namespace sikku
