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
    /// The key that sounds at a tick, or begins up to `late` ticks after it.
    std::optional<double> at(std::int64_t tick, std::int64_t late) const {
        const auto after = first_after(tick);
        if (after != notes_.end() && after->onset <= tick + late) return after->key;
        if (after == notes_.begin()) return std::nullopt;
        const Note& note = *std::prev(after);
        return note.onset + note.duration > tick ? std::optional(note.key) : std::nullopt;
    }
    /// The last note that began before `tick`.
    std::optional<Note> before(std::int64_t tick) const {
        const auto after = first_after(tick - 1);
        return after == notes_.begin() ? std::nullopt : std::optional(*std::prev(after));
    }
    bool begins_at(std::int64_t tick, std::int64_t late) const {
        const auto after = first_after(tick - late - 1);
        return after != notes_.end() && after->onset <= tick + late;
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
    /// @param late  ticks by which notes may begin after their beat
    explicit Checker(const BarLines& bars, std::int64_t late = 0) : bars_(bars), late_(late) {}

    struct Faults {
        int dissonances = 0;  ///< on strong beats
        int parallels = 0;
    };
    /// The faults if `note` sounds after `last` in its voice.
    Faults faults(const Note& note, const std::optional<Note>& last, const Lines& lines) const {
        Faults found;
        const std::int64_t begin = note.onset - late_;
        const std::int64_t end = note.onset + note.duration;
        for (std::int64_t bar = bars_.begin(std::max<std::int64_t>(0, begin)); bar < end; bar = bars_.end(bar)) {
            for (const std::int64_t beat : strong_beats(bars_.meter(bar))) {
                const std::int64_t tick = bar + beat;
                if (tick >= begin && tick < end) found.dissonances += dissonances(note.key, tick, lines);
            }
        }
        for (const auto& [voice, other] : lines) {
            // Parallels: both voices move from one note to another.
            const auto now = other.at(note.onset, late_);
            if (!last || !now || !other.begins_at(note.onset, late_)) continue;
            const auto before = other.before(note.onset - late_);
            if (before && is_parallel(before->key, last->key, *now, note.key)) ++found.parallels;
        }
        return found;
    }

private:
    /// Number of dissonances at a tick. A fourth is consonant above a lower voice.
    int dissonances(double key, std::int64_t tick, const Lines& lines) const {
        constexpr int fourth = 5;
        std::vector<double> sounding;
        for (const auto& [voice, other] : lines) {
            if (const auto against = other.at(tick, late_)) sounding.push_back(*against);
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

    const BarLines& bars_;
    std::int64_t late_;
};

/// Places the notes of one voice, one after another, each where it clashes least.
class Leader {
public:
    Leader(const Checker& checker, const Melody& melody, const Lines& lines)
        : checker_(checker), melody_(melody), lines_(lines) {}

    void lead(FormNote& note) {
        if (note.has_degree) settle(note);
        last_ = &note;
    }
    std::uint64_t moved() const { return moved_; }

private:
    void settle(FormNote& note) {
        // A fault costs more than any move, and a repeated note more than a degree.
        constexpr int fault = 1000;
        constexpr int repetition = 3;
        constexpr int degree = 2;
        const bool was_repeated = last_ && last_->note.key == note.note.key;
        int least = std::numeric_limits<int>::max();
        FormNote best = note;
        for (const std::int64_t move : moves) {
            const FormNote tried = moved(note, move);
            // Notes folded into the range would leap.
            if (static_cast<double>(move) * (tried.note.key - note.note.key) * melody_.scale.period < 0) continue;
            const auto [dissonances, parallels] =
                checker_.faults(tried.note, last_ ? std::optional(last_->note) : std::nullopt, lines_);
            const int faults = dissonances + 2 * parallels;
            const bool repeats = !was_repeated && last_ && last_->note.key == tried.note.key;
            const int cost = faults * fault + static_cast<int>(std::abs(move)) * degree + (repeats ? repetition : 0);
            if (move == 0 && faults == 0) return;
            if (cost >= least) continue;
            least = cost;
            best = tried;
        }
        moved_ += best.degree != note.degree ? 1 : 0;
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
    std::uint64_t moved_ = 0;
    const FormNote* last_ = nullptr;
};

}  // namespace

bool is_consonant(double low, double high) {
    const int interval = interval_class(low, high);
    return interval == 0 || interval == 3 || interval == 4 || interval == 7 || interval == 8 || interval == 9;
}

std::uint64_t make_strict(std::span<const FormNote> fixed, std::vector<FormNote>& part, const Melody& melody,
                          const BarLines& bars) {
    std::uint64_t moved = 0;
    const Checker checker(bars);
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
        Leader leader(checker, melody, lines);
        Line line;
        for (FormNote* one : notes) {
            leader.lead(*one);
            line.add(one->note);
        }
        lines[voice] = std::move(line);
        moved += leader.moved();
    }
    return moved;
}

std::vector<std::int64_t> sounding_faults(std::span<const SoundingVoice> voices, const BarLines& bars,
                                          std::int64_t late) {
    const Checker checker(bars, late);
    std::vector<std::int64_t> ticks;
    Lines lines;
    for (const SoundingVoice& voice : voices) {
        std::optional<Note> last;
        Line line;
        for (const Note& note : voice.notes) {
            line.add(note);
            if (!voice.is_led) continue;
            const auto [dissonances, parallels] = checker.faults(note, last, lines);
            ticks.insert(ticks.end(), static_cast<std::size_t>(dissonances + parallels), note.onset);
            last = note;
        }
        lines.emplace(static_cast<int>(lines.size()), std::move(line));
    }
    std::sort(ticks.begin(), ticks.end());
    return ticks;
}

}  // namespace sikku
