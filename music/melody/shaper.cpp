#include "music/melody/shaper.h"

#include "music/score/rhythm.h"

#include <algorithm>
#include <cmath>

namespace sikku::mapping {
namespace {

constexpr std::size_t notes_of_cadence = 3;

}  // namespace

Shaper::Shaper(const Melody& melody)
    : melody_(melody),
      held_(melody.cadence == Cadence::none ? 1 : notes_of_cadence),
      fifth_(fifth_degree(melody.scale)),
      strong_beats_(strong_beats(melody.meter)) {
    if (melody.harmony == Harmony::triads) triads_ = triads_of(melody.scale);
    const bool changes_degrees = melody.has_chords() || melody.cadence != Cadence::none;
    const bool is_bounded = melody.range == Range::reflect || melody.range == Range::clamp;
    if (changes_degrees && is_bounded) range_.emplace(melody);
}

/// Moves a note into the range first, so that chords and cadences apply to the sounding degree.
void Shaper::keep_within(Draft& note) const {
    if (!range_ || note.is_fixed()) return;
    const std::int64_t inside = range_->inside(note.degree);
    note.is_moved = note.is_moved || inside != note.degree;
    note.degree = inside;
    note.goal = range_->inside(note.goal);
}

std::int64_t Shaper::tone_of(const Chord& chord, std::int64_t degree) const {
    return range_ ? chord.nearest(degree, range_->low(), range_->high()) : chord.nearest(degree);
}

void Shaper::add(int voice, Draft note) {
    const auto at = static_cast<std::size_t>(voice);
    if (at >= pending_.size()) pending_.resize(at + 1);
    note.voice = voice;
    keep_within(note);
    pending_[at].push_back(note);
    if (pending_[at].size() <= held_) return;
    release(pending_[at].front());
    pending_[at].erase(pending_[at].begin());
}

void Shaper::end_phrase(int voice, bool is_odd) {
    const auto at = static_cast<std::size_t>(voice);
    if (at >= pending_.size()) return;
    auto& notes = pending_[at];
    if (notes.empty()) return;
    cadence(notes, is_odd);
    notes.back().is_last = true;
    for (const Draft& note : notes) release(note);
    notes.clear();
}

void Shaper::finish(bool is_end) {
    if (is_end && melody_.cadence != Cadence::none) {
        for (const auto& notes : pending_) {
            if (notes.empty()) continue;
            last_bar_ = std::max(last_bar_, notes.back().onset / melody_.meter.bar() * melody_.meter.bar());
        }
    }
    for (std::size_t voice = 0; voice < pending_.size(); ++voice) {
        // The last phrase closes, regardless of its number.
        if (is_end) end_phrase(static_cast<int>(voice), true);
        for (const Draft& note : pending_[voice]) release(note);
        pending_[voice].clear();
    }
    close_bar();
    go_on_until(INT64_MAX);
}

std::int64_t Shaper::first_pending() const {
    std::int64_t first = bar_.empty() ? INT64_MAX : bar_.front().onset;
    for (const auto& notes : pending_) {
        if (!notes.empty()) first = std::min(first, notes.front().onset);
    }
    return first;
}

std::span<const Shaper::Draft> Shaper::take() {
    taken_.swap(ready_);
    ready_.clear();
    return taken_;
}

/// Moves the last note to the goal; those before it approach it by step from their side.
void Shaper::cadence(std::vector<Draft>& notes, bool is_odd) const {
    if (melody_.cadence == Cadence::none) return;
    const bool is_open = melody_.cadence == Cadence::alternate && !is_odd;
    const auto period = static_cast<std::int64_t>(melody_.scale.size());
    std::int64_t goal = goal_near(notes.back().degree, is_open ? fifth_ : 0, period, range_);
    // A given chord is applied first, so that the goal is still approached by step.
    if (const Chord* chord = given_chord(notes.back().onset)) goal = tone_of(*chord, goal);
    const bool from_above = notes.front().degree >= goal;
    std::int64_t distance = static_cast<std::int64_t>(notes.size()) - 1;
    for (Draft& note : notes) {
        if (note.is_fixed()) {
            --distance;
            continue;
        }
        const std::int64_t last = goal + (from_above ? distance : -distance);
        if (distance <= 1) {
            note.degree = last;
        } else {
            note.degree = std::clamp(note.degree, std::min(goal, last), std::max(goal, last));
        }
        if (range_) note.degree = range_->inside(note.degree);
        --distance;
    }
    notes.back().glide = 0;  // the goal is held
}

const Chord* Shaper::given_chord(std::int64_t tick) const {
    if (melody_.progression.empty()) return nullptr;
    if (last_bar_ >= 0 && tick >= last_bar_) return &melody_.progression.front();
    const auto size = static_cast<std::int64_t>(melody_.progression.size());
    // An upbeat belongs to the last chord.
    return &melody_.progression[static_cast<std::size_t>((melody_.bar_number(tick) + size) % size)];
}

bool Shaper::is_strong(const Draft& note) const {
    return std::binary_search(strong_beats_.begin(), strong_beats_.end(), note.onset % melody_.meter.bar());
}

void Shaper::release(Draft note) {
    if (!melody_.has_chords()) return perform(note);
    harmonise(note);
}

/// Attaches the name of a silent chord to a melody note.
void Shaper::name(Draft& note, const Chord& chord) const {
    if (melody_.figure.is_silent) note.chord = sign_of(chord, melody_.tonic + melody_.transpose);
}

void Shaper::harmonise(Draft note) {
    if (const Chord* chord = given_chord(note.onset)) {
        if (!note.is_fixed() && (is_strong(note) || note.is_last)) note.degree = tone_of(*chord, note.degree);
        name(note, *chord);
        return perform(note);
    }
    if (note.voice != leader_) return perform(note);
    const std::int64_t bar = melody_.meter.bar();
    if (!bar_.empty() && bar_.front().onset / bar != note.onset / bar) close_bar();
    bar_.push_back(note);
}

/// Repeats the chord of a note that is held beyond its bar.
void Shaper::go_on_until(std::int64_t tick) {
    if (!latest_.chord || sounding_until_ <= latest_.end) return;
    const std::int64_t bar = melody_.meter.bar();
    const std::int64_t end = std::min((sounding_until_ + bar - 1) / bar * bar, tick);
    if (latest_.end < end) chords_.push_back({latest_.end, end, latest_.chord});
}

/// Chooses the triad that contains most of the bar by duration; notes on strong beats and last notes count twice.
void Shaper::close_bar() {
    if (bar_.empty()) return;
    const Chord* best = nullptr;
    std::int64_t most = -1;
    for (const Chord& chord : triads_) {
        std::int64_t sounding = 0;
        for (const Draft& note : bar_) {
            const std::int64_t weight = is_strong(note) || note.is_last ? 2 : 1;
            if (!note.is_drum && chord.has(note.degree)) sounding += weight * (note.end - note.onset);
        }
        if (sounding <= most) continue;
        most = sounding;
        best = &chord;
    }
    const std::int64_t bar = melody_.meter.bar();
    const std::int64_t begin = bar_.front().onset / bar * bar;
    go_on_until(begin);
    latest_ = {begin, begin + bar, best};
    chords_.push_back(latest_);
    sounding_until_ = bar_.back().end;
    for (Draft& note : bar_) {
        if (!note.is_fixed() && (is_strong(note) || note.is_last)) note.degree = tone_of(*best, note.degree);
        name(note, *best);
        perform(note);
    }
    bar_.clear();
}

void Shaper::perform(Draft note) {
    if (melody_.swing != 0.5) swing(note);
    if (!note.is_last && !note.is_drum && note.glide == 0 && melody_.articulation != Articulation::legato) {
        double share = melody_.sounding;
        if (melody_.articulation == Articulation::by_depth) share = sounding_by_depth(note.depth);
        note.end =
            note.onset + std::max<std::int64_t>(1, std::llround(static_cast<double>(note.end - note.onset) * share));
    }
    ready_.push_back(note);
}

void Shaper::swing(Draft& note) {
    const auto at = static_cast<std::size_t>(note.voice);
    if (at >= swung_until_.size()) swung_until_.resize(at + 1, 0);
    // A tuplet that begins with an off-beat must not begin before it.
    note.onset = std::max(swung(note.onset), swung_until_[at]);
    const std::int64_t slides_from = swung(note.end - note.glide);
    note.end = std::max(swung(note.end), note.onset + 1);
    note.glide = std::clamp<std::int64_t>(note.end - slides_from, 0, note.end - note.onset);
    swung_until_[at] = note.end;
}

/// Only halves, quarters and eighths of the unit swing, with it: tuplets keep their time.
std::int64_t Shaper::swung(std::int64_t tick) const {
    const std::int64_t unit = melody_.swing_unit;
    const std::int64_t bar = melody_.meter.bar();
    if (!Swing{melody_.swing, unit}.moves(tick, bar)) return tick;
    const std::int64_t within = tick % bar % (2 * unit);
    const double first = melody_.swing * 2 * static_cast<double>(unit);
    const double moved = within <= unit ? first * static_cast<double>(within) / static_cast<double>(unit)
                                        : first + (2 * static_cast<double>(unit) - first) *
                                                      static_cast<double>(within - unit) / static_cast<double>(unit);
    return tick - within + std::llround(moved);
}

}  // namespace sikku::mapping
