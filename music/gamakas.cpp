#include "music/gamakas.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sikku {
namespace {

constexpr std::int64_t bend_ticks = ticks_per_quarter / 32;
constexpr std::int64_t most_points = 1'000'000;  // for one note
constexpr double widest_bend = 12;               // semitones

/// A smooth step from 0 to 1, level at both ends, in plain arithmetic, so that all machines write the same bytes.
double smooth(double part) {
    const double within = std::clamp(part, 0.0, 1.0);
    return within * within * (3 - 2 * within);
}

/// Adds points of a bend between two ticks of a note. @param offset  function of the position, from 0 to 1
template <class Offset>
void add(const Note& note, std::int64_t begin, std::int64_t end, Offset offset, std::vector<ControlPoint>& points) {
    if ((end - begin) / bend_ticks > most_points) {
        throw ScoreError(
            fmt::format("a note of {} quarters is too long for a gamaka", note.duration / ticks_per_quarter));
    }
    for (std::int64_t at = begin; at < end; at += bend_ticks) {
        const double part = static_cast<double>(at - begin) / static_cast<double>(end - begin);
        points.push_back({note.onset + at, note.voice, ControlPoint::bend, offset(part)});
    }
}

double ticks_per_second(double tempo) {
    return tempo * static_cast<double>(ticks_per_quarter) / 60;
}

std::int16_t to_cents(double semitones) {
    return static_cast<std::int16_t>(std::lround(100 * semitones));
}

}  // namespace

void Bender::bend(Note* before, Note& note, const Note* after, double tempo,
                  std::vector<ControlPoint>& points) const {
    if (note.glide.ticks > 0) return;
    const std::int64_t degree = degree_of(note.key);
    for (const Gamaka& gamaka : melody_.expression.gamakas) {
        const auto size = static_cast<std::int64_t>(melody_.scale.size());
        const std::int64_t within = (degree % size + size) % size;
        const auto& degrees = gamaka.degrees;
        if (!degrees.empty() && std::find(degrees.begin(), degrees.end(), within) == degrees.end()) continue;
        using enum Gamaka::Approach;
        const bool is_approached =
            gamaka.approach == any ||
            (before && (gamaka.approach == rising ? before->key < note.key : before->key > note.key));
        if (!is_approached) continue;
        switch (gamaka.kind) {
            case Gamaka::Kind::kampita:
                if (swing(note, degree, tempo, points)) return;
                break;
            case Gamaka::Kind::jaru:
                if (before && before->onset + before->duration == note.onset && before->glide.ticks == 0) {
                    if (slide(note, before->key - note.key, true, tempo, points)) {
                        before->is_sliding = true;
                        note.grace = to_cents(before->key - note.key);
                    }
                    return;
                }
                break;
            case Gamaka::Kind::meend:
                if (after && note.onset + note.duration == after->onset) {
                    note.is_sliding = slide(note, after->key - note.key, false, tempo, points);
                    return;
                }
                break;
        }
    }
}

std::int64_t Bender::degree_of(double key) const {
    const Scale& scale = melody_.scale;
    const double cents = 100 * (key - melody_.tonic - melody_.transpose);
    const auto size = static_cast<std::int64_t>(scale.size());
    std::int64_t best = static_cast<std::int64_t>(std::floor(cents / std::fabs(scale.period))) * size;
    const auto distance = [&](std::int64_t one) {
        return std::min(std::fabs(scale.cents(one, false) - cents), std::fabs(scale.cents(one, true) - cents));
    };
    for (std::int64_t one = best - size; one <= best + 2 * size; ++one) {
        if (distance(one) < distance(best) - 1e-9) best = one;
    }
    return best;
}

/// Swings up and back so that a whole number of swings fills the note. @return false for notes that are too short
bool Bender::swing(Note& note, std::int64_t degree, double tempo, std::vector<ControlPoint>& points) const {
    constexpr double swings_per_second = 5;
    const double seconds = static_cast<double>(note.duration) / ticks_per_second(tempo);
    const double swings = std::floor(seconds * swings_per_second + 0.25);
    if (swings < 1) return false;
    const double above = (melody_.scale.cents(degree + 1, false) - melody_.scale.cents(degree, false)) / 100;
    const double width = std::min(2.0, above);
    const auto offset = [&](double part) {
        const double within = part * swings - std::floor(part * swings);
        return width * smooth(1 - std::fabs(2 * within - 1));
    };
    add(note, 0, note.duration, offset, points);
    note.grace = to_cents(above);
    return true;
}

/// @param from  true if it begins, instead of ending, with the offset
/// @return false for unisons, intervals that are too wide, and notes that are too short
bool Bender::slide(const Note& note, double offset, bool from, double tempo,
                   std::vector<ControlPoint>& points) const {
    constexpr double longest = 0.25;  // seconds
    if (offset == 0 || std::fabs(offset) > widest_bend) return false;
    const auto length = std::min(note.duration / 2, static_cast<std::int64_t>(longest * ticks_per_second(tempo)));
    if (length < 2 * bend_ticks) return false;
    if (from) {
        add(
            note, 0, length, [&](double part) { return offset * (1 - smooth(part)); }, points);
        points.push_back({note.onset + length, note.voice, ControlPoint::bend, 0});
    } else {
        const auto rise = [&](double part) { return offset * smooth(part); };
        add(note, note.duration - length, note.duration, rise, points);
    }
    return true;
}

}  // namespace sikku
