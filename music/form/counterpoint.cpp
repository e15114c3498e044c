#include "music/form/counterpoint.h"

#include "music/score/note_order.h"
#include "music/score/rhythm.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>

namespace sikku {
namespace {

constexpr std::array<std::int64_t, 7> moves = {0, 1, -1, 2, -2, 3, -3};

/// The notes of a voice, by onset, none overlapping.
class Line {
public:
    void add(const Note& note) { notes_.push_back(note); }
    void sort() { sort_by_onset(notes_); }
    /// The key that sounds at a tick.
    std::optional<double> at(std::int64_t tick) const {
        const auto after = first_after(tick);
        if (after == notes_.begin()) return std::nullopt;
        const Note& note = *std::prev(after);
        return note.onset + note.duration > tick ? std::optional(note.key) : std::nullopt;
    }
    /// The last note that began before `tick`.
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

using Lines = std::map<int, Line>;

/// Finds the faults of a note among other voices.
class Checker {
public:
    explicit Checker(const Meter& meter) : bar_(meter.bar()), beats_(strong_beats(meter)) {}

    /// Counts dissonances on strong beats, and parallels twice, if `note` sounds after `last` in its voice.
    int faults(const Note& note, const std::optional<Note>& last, const Lines& lines) const {
        int count = 0;
        const std::int64_t end = note.onset + note.duration;
        for (std::int64_t bar = note.onset / bar_ * bar_; bar < end; bar += bar_) {
            for (const std::int64_t beat : beats_) {
                const std::int64_t tick = bar + beat;
                if (tick >= note.onset && tick < end) count += dissonances(note.key, tick, lines);
            }
        }
        for (const auto& [voice, other] : lines) {
            // Parallels: both voices move from one note to another.
            const auto now = other.at(note.onset);
            if (!last || !now || !other.begins_at(note.onset)) continue;
            const auto before = other.before(note.onset);
            if (before && is_parallel(before->key, last->key, *now, note.key)) count += 2;
        }
        return count;
    }

private:
    /// Number of dissonances at a tick. A fourth is consonant above a lower voice.
    static int dissonances(double key, std::int64_t tick, const Lines& lines) {
        constexpr int fourth = 5;
        std::vector<double> sounding;
        for (const auto& [voice, other] : lines) {
            if (const auto against = other.at(tick)) sounding.push_back(*against);
        }
        if (sounding.empty()) return 0;
        const double lowest = *std::min_element(sounding.begin(), sounding.end());
        return static_cast<int>(std::count_if(sounding.begin(), sounding.end(), [&](double against) {
            const double low = std::min(against, key);
            const double high = std::max(against, key);
            const bool is_upper_fourth = low > std::min(lowest, key) && interval_class(low, high) == fourth;
            return !is_consonant(low, high) && !is_upper_fourth;
        }));
    }

    std::int64_t bar_;
    std::vector<std::int64_t> beats_;
};

/// Places the notes of one voice, one after another, each where it clashes least.
class Leader {
public:
    Leader(const Checker& checker, const Melody& melody, const Lines& lines, CounterpointReport& report)
        : checker_(checker), melody_(melody), lines_(lines), report_(report) {}

    void lead(FormNote& note) {
        if (note.has_degree) settle(note);
        last_ = &note;
    }

private:
    void settle(FormNote& note) {
        // A fault costs more than any move, and a repeated note more than a degree.
        constexpr int fault = 1000;
        constexpr int repetition = 3;
        constexpr int degree = 2;
        const bool was_repeated = last_ && last_->note.key == note.note.key;
        int least = std::numeric_limits<int>::max();
        int faults_left = 0;
        FormNote best = note;
        for (const std::int64_t move : moves) {
            const FormNote tried = moved(note, move);
            // Notes folded into the range would leap.
            if (static_cast<double>(move) * (tried.note.key - note.note.key) * melody_.scale.period < 0) continue;
            const int faults = checker_.faults(tried.note, last_ ? std::optional(last_->note) : std::nullopt, lines_);
            const bool repeats = !was_repeated && last_ && last_->note.key == tried.note.key;
            const int cost = faults * fault + static_cast<int>(std::abs(move)) * degree + (repeats ? repetition : 0);
            if (move == 0 && faults == 0) return;
            if (cost >= least) continue;
            least = cost;
            faults_left = faults;
            best = tried;
        }
        report_.moved += best.degree != note.degree ? 1 : 0;
        report_.left += static_cast<std::uint64_t>(faults_left);
        note = best;
    }

    FormNote moved(const FormNote& note, std::int64_t move) const {
        FormNote result = note;
        if (move == 0) return result;
        result.degree += move;
        const bool falling = last_ && last_->has_degree && result.degree < last_->degree;
        result.note.key = key_within(melody_, result.degree, falling);
        return result;
    }

    const Checker& checker_;
    const Melody& melody_;
    const Lines& lines_;
    CounterpointReport& report_;
    const FormNote* last_ = nullptr;
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
    Lines lines;
    for (const FormNote& one : fixed) lines[one.note.voice].add(one.note);
    std::map<int, std::vector<FormNote*>> voices;
    for (FormNote& one : part) voices[one.note.voice].push_back(&one);
    // Chords are not moved; the melody above them adapts to them.
    for (auto voice = voices.begin(); voice != voices.end();) {
        const auto& notes = voice->second;
        if (std::any_of(notes.begin(), notes.end(), [](const FormNote* one) { return one->has_degree; })) {
            ++voice;
            continue;
        }
        for (const FormNote* one : notes) lines[voice->first].add(one->note);
        voice = voices.erase(voice);
    }
    for (auto& [voice, line] : lines) line.sort();
    for (auto& [voice, notes] : voices) {
        std::stable_sort(notes.begin(), notes.end(),
                         [](const FormNote* a, const FormNote* b) { return a->note.onset < b->note.onset; });
        Leader leader(checker, melody, lines, report);
        Line line;
        for (FormNote* one : notes) {
            leader.lead(*one);
            line.add(one->note);
        }
        lines[voice] = std::move(line);
    }
    return report;
}

}  // namespace sikku
