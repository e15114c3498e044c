#include "music/melody/emitter.h"

#include "music/score/glides.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace sikku::mapping {
namespace {

constexpr std::size_t notes_in_block = 1024;
constexpr std::int64_t cached_degrees = 8192;

}  // namespace

Emitter::Emitter(const Melody& melody, NoteSink& sink, const PlayOptions& options)
    : melody_(melody), sink_(sink), options_(options) {
    if (melody.is_shaped()) shaper_.emplace(melody);
    if (melody.accompanying_voices() > 0) accompaniment_.emplace(melody);
    block_.reserve(notes_in_block);
    for (auto& keys : keys_) keys.assign(2 * cached_degrees, Placed{});
}

void Emitter::limit_leap(Line& line, Shaper::Draft& draft) const {
    const auto period = static_cast<std::int64_t>(melody_.scale.size());
    if (std::exchange(line.phrase, phrase_) != phrase_) {
        line.leapt_to = unknown;
        line.leapt_by = 0;
    }
    std::int64_t degree = draft.degree + line.leapt_by;
    if (line.leapt_to != unknown) {
        const auto from = melody_.key(line.leapt_to, false);
        const auto to = melody_.key(degree, false);
        const double leap = from && to ? *to - *from : 0;
        if (std::fabs(leap) > melody_.leaps) degree -= std::llround(leap * 100 / melody_.scale.period) * period;
    }
    line.leapt_by = degree - draft.degree;
    line.leapt_to = degree;
    draft.goal += line.leapt_by;
    draft.degree = degree;
}

void Emitter::end_phrase(int voice, bool is_odd) {
    if (voice == 0) ++phrase_;
    if (!shaper_) return;
    shaper_->end_phrase(voice, is_odd);
    hand_on();
}

void Emitter::shape(Line& line, Shaper::Draft& draft) {
    take_time(line, draft.onset, draft.end);
    draft.voice = line.voice;
    shaper_->add(line.voice, draft);
    hand_on();
}

void Emitter::hand_on() {
    for (const Shaper::Draft& note : shaper_->take()) {
        const auto at = static_cast<std::size_t>(note.voice);
        if (at >= shaped_.size()) shaped_.resize(at + 1);
        shaped_[at].voice = note.voice;
        if (note.is_moved && is_in_piece(note)) ++report.moved;
        if (note.is_fixed() || note.glide <= 0) {
            place_fixed(shaped_[at], note);
        } else {
            place_gliding(shaped_[at], note);
        }
    }
    for (const auto& [begin, end, chord] : shaper_->take_chords()) {
        const std::int64_t bar = melody_.meter.bar();
        std::int64_t at = std::max(begin, options_.from / bar * bar);
        for (; at < std::min(end, options_.to); at += bar) accompany(at, chord);
    }
}

void Emitter::finish(std::int64_t end) {
    if (shaper_) {
        shaper_->finish(end < options_.to);
        hand_on();
    }
    for (std::size_t voice = 0; voice < gliding_.size(); ++voice) settle(static_cast<int>(voice), nullptr, false);
    if (accompaniment_ && melody_.harmony != Harmony::triads) {
        const std::int64_t bar = melody_.meter.bar();
        // The line itself may be silent, or shorter than its branches.
        std::int64_t last = end;
        for (const std::int64_t busy : busy_until_) last = std::max(last, busy);
        for (std::int64_t at = options_.from / bar * bar; at < std::min(last, options_.to); at += bar) {
            const bool is_last = end < options_.to && at + bar >= last;
            accompany(at, shaper_ ? shaper_->given_chord(at) : nullptr,
                      shaper_ ? shaper_->given_chord(at + bar) : nullptr, is_last);
        }
    }
    flush();
    const bool past = end <= options_.from;
    end = std::max<std::int64_t>(0, std::min(end, options_.to) - options_.from);
    for (const std::int64_t busy : busy_until_) {
        end = std::max(end, std::min(busy, options_.to) - options_.from);
    }
    report.melody_end = end;
    end = std::max(end, accompanied_);
    report.end = end;
    report.past = past;
    report.voices = static_cast<int>(busy_until_.size());
    sink_.finish(end);
}

void Emitter::accompany(std::int64_t begin, const Chord* chord, const Chord* next, bool is_last) {
    if (!accompaniment_ || begin < melody_.lead()) return;
    for (Note note : accompaniment_->bar(begin, chord, next, is_last)) {
        const std::int64_t from = std::max(note.onset, options_.from);
        const std::int64_t to = std::min(note.onset + note.duration, options_.to);
        if (from >= to) continue;
        note.onset = from - options_.from;
        note.duration = to - from;
        note.voice = static_cast<std::int16_t>(
            note.voice + (options_.chords_from > 0 ? options_.chords_from : melody_.own_voices()));
        accompanied_ = std::max(accompanied_, to - options_.from);
        ++report.notes;
        put(note, PlayOptions::no_degree);
    }
}

void Emitter::put(const Note& note, std::int64_t degree) {
    block_.push_back(note);
    if (options_.degrees) options_.degrees->push_back(degree);
    if (block_.size() == notes_in_block) flush();
}

void Emitter::put(const Shaper::Draft& draft, const Placed& placed, int voice, std::int64_t degree,
                  const Glide& glide) {
    report.moved += placed.is_moved ? 1 : 0;
    ++report.notes;
    Note note{draft.onset,
              draft.end - draft.onset,
              placed.key,
              static_cast<std::int16_t>(voice),
              static_cast<std::uint8_t>(std::clamp(draft.velocity + draft.emphasis.velocity(), 1, 127)),
              draft.from,
              draft.to,
              draft.symbol,
              static_cast<std::uint8_t>(std::min(draft.depth, 255)),
              static_cast<std::uint8_t>(draft.level),
              glide.semitones != 0,
              false,
              draft.is_first && melody_.phrase_order > 0,
              glide,
              false,
              draft.emphasis,
              draft.chord};
    if (!draft.is_drum) extend_range(placed.key);
    cut(note, options_.from, options_.to);
    note.onset -= options_.from;
    put(note, degree);
}

void Emitter::follow_line(Line& line, std::int64_t degree) const {
    if (line.last_degree != unknown && degree != line.last_degree) line.falling = degree < line.last_degree;
    line.last_degree = degree;
}

void Emitter::place(Line& line, const Shaper::Draft& note) {
    follow_line(line, note.degree);
    if (note.end <= note.onset) {
        ++report.lost;
        return;
    }
    // Notes before the piece count, so that it has the same voices as in the whole melody.
    reserve(line, note.onset, note.end);
    if (held_back_ > 0) settle(line.voice, &note, line.falling);
    if (!is_in_piece(note)) return;
    const Placed placed = key_of(note.degree, line.falling);
    if (placed.is_silent) {
        ++report.lost;
        return;
    }
    put(note, placed, line.voice, placed.degree);
}

void Emitter::place_fixed(Line& line, const Shaper::Draft& note) {
    if (!note.is_fixed()) return place(line, note);
    if (note.end <= note.onset) {
        ++report.lost;
        return;
    }
    reserve(line, note.onset, note.end);
    if (!is_in_piece(note)) return;
    const Placed placed =
        note.is_drum ? Placed{note.key, false, false, 0} : within_range(note.key, note.degree, false);
    put(note, placed, line.voice + (note.is_drum ? options_.drums_from : 0), PlayOptions::no_degree);
}

void Emitter::place_gliding(Line& line, const Shaper::Draft& note) {
    follow_line(line, note.degree);
    if (note.end <= note.onset) {
        ++report.lost;
        return;
    }
    reserve(line, note.onset, note.end);
    settle(line.voice, &note, line.falling);
    const auto at = static_cast<std::size_t>(line.voice);
    if (at >= gliding_.size()) gliding_.resize(at + 1);
    gliding_[at] = {note, line.falling, true};
    ++held_back_;
}

void Emitter::settle(int voice, const Shaper::Draft* next, bool falling) {
    if (static_cast<std::size_t>(voice) >= gliding_.size()) return;
    Gliding& gliding = gliding_[static_cast<std::size_t>(voice)];
    if (!std::exchange(gliding.is_held, false)) return;
    --held_back_;
    const Shaper::Draft& note = gliding.note;
    if (!is_in_piece(note)) return;
    const Placed placed = key_of(note.degree, gliding.falling);
    if (placed.is_silent) {
        ++report.lost;
        return;
    }
    const bool meets = next && next->onset == note.end;
    const Placed goal = meets ? key_of(next->degree, falling)
                              : key_of(note.goal, note.goal != note.degree && note.goal < note.degree);
    const double slide = goal.is_silent ? 0 : goal.key - placed.key;
    extend_range(placed.key + slide);
    put(note, placed, voice, placed.degree, {note.glide, static_cast<float>(slide), note.rise});
}

void Emitter::reserve(Line& line, std::int64_t onset, std::int64_t end) {
    if (line.voice < 0) line.voice = free_voice(onset);
    if (line.voice >= static_cast<int>(busy_until_.size())) busy_until_.resize(line.voice + 1U, 0);
    busy_until_[static_cast<std::size_t>(line.voice)] = end;
}

void Emitter::take_time(Line& line, std::int64_t onset, std::int64_t end) {
    if (line.voice < 0) line.voice = free_voice(onset);
    if (!shaper_) return;
    const auto at = static_cast<std::size_t>(line.voice);
    if (at >= taken_until_.size()) taken_until_.resize(at + 1, 0);
    taken_until_[at] = end;
}

int Emitter::free_voice(std::int64_t onset) {
    const std::vector<std::int64_t>& until = shaper_ ? taken_until_ : busy_until_;
    for (int voice = 0;; ++voice) {
        const auto at = static_cast<std::size_t>(voice);
        if (at >= held_.size()) held_.resize(at + 1, false);
        if (held_[at] || (at < until.size() && until[at] > onset)) continue;
        if (voice >= options_.most_voices) {
            throw ScoreError(
                fmt::format("too many voices: more than {} at once; a smaller n has fewer branches", voice));
        }
        held_[at] = true;
        return voice;
    }
}

Emitter::Placed Emitter::key_of(std::int64_t degree, bool falling) {
    if (degree < -cached_degrees || degree >= cached_degrees) return look_up(degree, falling);
    Placed& known = keys_[falling ? 1 : 0][static_cast<std::size_t>(degree + cached_degrees)];
    if (std::isnan(known.key)) known = look_up(degree, falling);
    return known;
}

Emitter::Placed Emitter::look_up(std::int64_t degree, bool falling) {
    const auto raw = melody_.key(degree, falling);
    if (!raw) {
        if (melody_.range == Range::refuse) refuse(degree, "no key at all");
        return {0, false, true, degree};
    }
    return answered(within_range(*raw, degree, falling), falling);
}

Emitter::Placed Emitter::within_range(double raw, std::int64_t degree, bool falling) {
    if (is_within(raw)) return {raw, false, false, degree};
    switch (melody_.range) {
        case Range::refuse:
            refuse(degree, fmt::format("key {:.0f}", raw));
        case Range::fold: {
            const double key = folded(melody_, raw);
            const double periods = (raw - key) * 100 / melody_.scale.period;
            const bool is_whole = std::isfinite(periods) && std::fabs(periods) < 1e9;
            const auto size = static_cast<std::int64_t>(melody_.scale.size());
            return {key, true, false, degree - (is_whole ? std::llround(periods) * size : 0)};
        }
        case Range::clamp:
        case Range::reflect:
            break;
    }
    if (!range_) range_.emplace(melody_);
    const std::int64_t inside = range_->inside(degree);
    const double key = std::clamp(melody_.key(inside, falling).value_or(60.0), melody_.lowest, melody_.highest);
    return {key, true, false, inside};
}

Emitter::Placed Emitter::answered(Placed placed, bool falling) const {
    if (melody_.answer == 0) return placed;
    const auto from = melody_.key(placed.degree, falling);
    placed.degree += melody_.answer;
    const auto to = melody_.key(placed.degree, falling);
    if (!from || !to) return {0, false, true, placed.degree};
    placed.key += *to - *from;
    for (; placed.key > 127; placed.key -= 12) placed.is_moved = true;
    for (; placed.key < 0; placed.key += 12) placed.is_moved = true;
    return placed;
}

void Emitter::refuse(std::int64_t degree, const std::string& key) const {
    throw ScoreError(
        fmt::format("degree {} of the scale would be {}, beyond the keys {:.0f} to {:.0f}: `range: fold`, another "
                    "tonic or a smaller n helps",
                    degree, key, melody_.lowest, melody_.highest));
}

}  // namespace sikku::mapping
