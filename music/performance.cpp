#include "music/performance.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace sikku {
namespace {

constexpr std::int64_t control_ticks = ticks_per_quarter / 16;  // between points of a ramp
constexpr std::int64_t bend_ticks = ticks_per_quarter / 32;
constexpr double widest_bend = 12;  // semitones

/// From 0 to 1, level at both ends. Plain arithmetic, so that every machine gives the same bytes.
double smooth(double part) {
    const double within = std::clamp(part, 0.0, 1.0);
    return within * within * (3 - 2 * within);
}

/// Values of a source, from 0 to 1.
struct SourceRange {
    double low = 0;
    double high = 0;
    double part(double value) const { return high > low ? (value - low) / (high - low) : 0.5; }
};

SourceRange range_of(const std::vector<double>& values) {
    if (values.empty()) return {};
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return {*low, *high};
}

/// Beginning and end of each note, from 0 to 1.
using Parts = std::vector<std::pair<double, double>>;

/// The order of the largest sub-curve that begins with each symbol that begins a note.
std::unordered_map<std::uint64_t, int> levels_of(const Player& player, const PlayOptions& playing) {
    class Onsets : public NoteSink {
    public:
        void notes(std::span<const Note> notes) override {
            for (const Note& note : notes) all.emplace_back(note.onset, note.symbol);
        }
        void finish(std::int64_t) override {}
        std::vector<std::pair<std::int64_t, std::uint64_t>> all;
    };
    std::unordered_map<std::uint64_t, int> levels;
    const std::int64_t steps = player.document.grammar().steps();
    constexpr std::int64_t most_levels = 64;
    for (std::int64_t order = 1; order <= std::min(steps, most_levels); ++order) {
        Melody melody = player.melody;
        melody.phrase_order = order;
        melody.breath = 0;
        melody.cadence = Cadence::none;
        melody.harmony = Harmony::none;
        melody.swing = 0.5;
        melody.articulation = Articulation::legato;
        melody.layout.form.clear();
        std::vector<std::int64_t> begins = {0};
        PlayOptions options = playing;
        options.from = 0;
        options.to = INT64_MAX;
        options.phrase_ends = &begins;
        Onsets onsets;
        play(player.document.grammar(), melody, onsets, options);
        std::sort(begins.begin(), begins.end());
        for (const auto& [onset, symbol] : onsets.all) {
            if (symbol > 0 && std::binary_search(begins.begin(), begins.end(), onset)) {
                levels[symbol] = static_cast<int>(order);
            }
        }
    }
    return levels;
}

/// -1 to the right, 1 to the left, 0 straight on.
double turn_into(const Note* before, const Note& note) {
    if (!before) return 0;
    const bool has_risen = before->glide.rise != 0;
    const glm::dvec2 ahead = before->end_point() - (has_risen ? before->to : before->from);
    glm::dvec2 next = note.from - before->end_point();
    constexpr double nothing = 1e-9;
    if (std::fabs(next.x) + std::fabs(next.y) < nothing) next = note.end_point() - note.from;
    const double cross = ahead.x * next.y - ahead.y * next.x;
    return cross > nothing ? 1 : cross < -nothing ? -1 : 0;
}

/// Values of a source at the beginning and the end of a note; the level is not known here.
std::pair<double, double> values_of(ExpressionSource source, const Note* before, const Note& note) {
    const auto both = [](double value) { return std::pair(value, value); };
    switch (source) {
        case ExpressionSource::x:
            return {note.from.x, note.to.x};
        case ExpressionSource::y:
            return {note.from.y, note.end_point().y};
        case ExpressionSource::depth:
            return both(note.depth);
        case ExpressionSource::turn:
            return both(turn_into(before, note));
        case ExpressionSource::length:
            return both(static_cast<double>(note.duration));
        case ExpressionSource::level:
        case ExpressionSource::none:
            break;
    }
    return both(0);
}

/// What accompanies a melody comes from no place of the curve.
bool is_of_curve(const Note& note) {
    return note.from != note.end_point();
}

Parts parts_of(const Player& player, const PlayOptions& playing, ExpressionSource source,
               const std::vector<Note*>& notes) {
    std::vector<double> first;
    std::vector<double> last;
    const auto levels =
        source == ExpressionSource::level ? levels_of(player, playing) : std::unordered_map<std::uint64_t, int>();
    std::map<std::int16_t, const Note*> before;
    for (const Note* note : notes) {
        auto [value, end] = values_of(source, before[note->voice], *note);
        if (source == ExpressionSource::level) {
            const auto level = levels.find(note->symbol);
            value = end = level == levels.end() ? 0 : level->second;
        }
        before[note->voice] = note;
        first.push_back(value);
        last.push_back(end);
    }
    std::vector<double> all = first;
    all.insert(all.end(), last.begin(), last.end());
    const SourceRange range = source == ExpressionSource::turn ? SourceRange{-1, 1} : range_of(all);
    Parts parts;
    for (std::size_t i = 0; i < first.size(); ++i) parts.emplace_back(range.part(first[i]), range.part(last[i]));
    return parts;
}

std::vector<double> middles(const Parts& parts) {
    std::vector<double> result;
    for (const auto& [begin, end] : parts) result.push_back((begin + end) / 2);
    return result;
}

/// Adds the points of a note where the rounded value changes.
/// @param part  of the source, from 0 to 1, where the note begins and ends
/// @param last  value of the voice so far
void add_control(const Note& note, std::pair<double, double> part, const ExpressionCurve& curve, int number,
                 std::optional<int>& last, std::vector<ControlPoint>& points) {
    const auto [begin, end] = part;
    for (std::int64_t at = 0; at < note.duration; at += control_ticks) {
        const double here = begin + (end - begin) * static_cast<double>(at) / static_cast<double>(note.duration);
        const int value = static_cast<int>(std::floor(std::clamp(curve.at(here), 0.0, 127.0) + 0.5));
        if (last != value) points.push_back({note.onset + at, note.voice, number, static_cast<double>(value)});
        last = value;
        if (begin == end) break;
    }
}

/// The same for all notes of a part.
void add_control(const std::vector<Note*>& notes, const Parts& parts, const ExpressionCurve& curve, int number,
                 std::vector<ControlPoint>& points) {
    std::map<std::int16_t, std::optional<int>> last;
    for (std::size_t i = 0; i < notes.size(); ++i) {
        add_control(*notes[i], parts[i], curve, number, last[notes[i]->voice], points);
    }
}

/// The bends of the notes of one voice.
class Bender {
public:
    Bender(const Player& player, double tempo, std::vector<ControlPoint>& points)
        : melody_(player.melody),
          ticks_per_second_(tempo * static_cast<double>(ticks_per_quarter) / 60),
          points_(points) {}

    void bend(Note* before, Note& note, const Note* after) {
        if (note.glide.ticks > 0) return;
        const std::int64_t degree = degree_of(note.key);
        for (const Gamaka& gamaka : melody_.expression.gamakas) {
            const auto size = static_cast<std::int64_t>(melody_.scale.size());
            const std::int64_t within = (degree % size + size) % size;
            const auto& degrees = gamaka.degrees;
            if (!degrees.empty() && std::find(degrees.begin(), degrees.end(), within) == degrees.end()) continue;
            switch (gamaka.kind) {
                case Gamaka::Kind::kampita:
                    if (swing(note, degree)) return;
                    break;
                case Gamaka::Kind::jaru:
                    if (before && before->onset + before->duration == note.onset && before->glide.ticks == 0) {
                        before->is_sliding = slide(note, before->key - note.key, true) || before->is_sliding;
                        return;
                    }
                    break;
                case Gamaka::Kind::meend:
                    if (after && note.onset + note.duration == after->onset) {
                        note.is_sliding = slide(note, after->key - note.key, false);
                        return;
                    }
                    break;
            }
        }
    }

private:
    std::int64_t degree_of(double key) const {
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
    bool swing(const Note& note, std::int64_t degree) {
        constexpr double swings_per_second = 5;
        const double seconds = static_cast<double>(note.duration) / ticks_per_second_;
        const auto swings = static_cast<int>(std::floor(seconds * swings_per_second + 0.25));
        if (swings < 1) return false;
        const double width =
            std::min(2.0, (melody_.scale.cents(degree + 1, false) - melody_.scale.cents(degree, false)) / 100);
        add(note, 0, note.duration, [&](double part) {
            const double within = part * swings - std::floor(part * swings);
            return width * smooth(1 - std::fabs(2 * within - 1));
        });
        return true;
    }

    /// @param from  whether it begins, instead of ending, with the offset
    /// @return false for unisons, intervals that are too wide, and notes that are too short
    bool slide(const Note& note, double offset, bool from) {
        constexpr double longest = 0.25;  // seconds
        if (offset == 0 || std::fabs(offset) > widest_bend) return false;
        const auto length = std::min(note.duration / 2, static_cast<std::int64_t>(longest * ticks_per_second_));
        if (length < 2 * bend_ticks) return false;
        if (from) {
            add(note, 0, length, [&](double part) { return offset * (1 - smooth(part)); });
            points_.push_back({note.onset + length, note.voice, ControlPoint::bend, 0});
        } else {
            add(note, note.duration - length, note.duration, [&](double part) { return offset * smooth(part); });
        }
        return true;
    }

    /// Points of a function of the part of a stretch of a note.
    template <class Offset>
    void add(const Note& note, std::int64_t begin, std::int64_t end, Offset offset) {
        for (std::int64_t at = begin; at < end; at += bend_ticks) {
            const double part = static_cast<double>(at - begin) / static_cast<double>(end - begin);
            points_.push_back({note.onset + at, note.voice, ControlPoint::bend, offset(part)});
        }
    }

    const Melody& melody_;
    double ticks_per_second_;
    std::vector<ControlPoint>& points_;
};

}  // namespace

bool streams_expression(const Ensemble& ensemble, bool with_controls) {
    const std::vector<Player>& players = ensemble.players;
    return std::all_of(players.begin(), players.end(), [&](const Player& player) {
        MelodicExpression others = player.melody.expression;
        if (others.uses(ExpressionSource::level)) return false;
        others.velocity = {};
        if (with_controls) others.pan = others.control = {};
        return !others.any();
    });
}

ExpressionSink::ExpressionSink(const Ensemble& ensemble, bool is_printed) : ensemble_(ensemble) {
    for (const Player& player : ensemble.players) {
        const MelodicExpression& expression = player.melody.expression;
        std::vector<Followed>& curves = followed_.emplace_back();
        has_turns_.push_back(0);
        const auto follow = [&](const ExpressionCurve& curve, int number) {
            if (!curve.is_on()) return;
            const bool is_turn = curve.source == ExpressionSource::turn;
            curves.push_back({curve, number, is_turn ? -1 : INFINITY, is_turn ? 1 : -INFINITY});
            if (is_turn) has_turns_.back() = 1;
        };
        follow(expression.velocity, velocity);
        if (is_printed) continue;
        follow(expression.pan, ControlPoint::pan);
        follow(expression.control, expression.controller);
    }
}

void ExpressionSink::notes(std::span<const Note> notes) {
    if (sink_) changed_.assign(notes.begin(), notes.end());
    points_.clear();
    for (std::size_t i = 0; i < notes.size(); ++i) {
        const Note& note = notes[i];
        if (!is_of_curve(note)) continue;
        const std::size_t player = player_of(note.voice);
        if (followed_[player].empty()) continue;
        const auto voice = static_cast<std::size_t>(note.voice);
        if (voice >= lines_.size()) lines_.resize(voice + 1);
        express(followed_[player], lines_[voice], note, i);
        if (has_turns_[player]) lines_[voice].before = note;
    }
    if (!sink_) return;
    if (!points_.empty()) sink_->controls(points_);
    sink_->notes(changed_);
}

void ExpressionSink::express(std::vector<Followed>& curves, Line& line, const Note& note, std::size_t index) {
    const std::size_t first_point = points_.size();
    line.last.resize(curves.size());
    for (std::size_t i = 0; i < curves.size(); ++i) {
        auto& [curve, number, low, high] = curves[i];
        const auto [begin, end] = values_of(curve.source, line.before ? &*line.before : nullptr, note);
        if (!sink_) {
            low = std::min({low, begin, end});
            high = std::max({high, begin, end});
            continue;
        }
        const SourceRange range{low, high};
        const std::pair<double, double> part{range.part(begin), range.part(end)};
        if (number != velocity) {
            add_control(note, part, curve, number, line.last[i], points_);
            continue;
        }
        const double value = std::clamp(curve.at((part.first + part.second) / 2), 1.0, 127.0);
        changed_[index].velocity = static_cast<std::uint8_t>(std::lround(value));
    }
    std::stable_sort(points_.begin() + static_cast<std::ptrdiff_t>(first_point), points_.end(),
                     [](const ControlPoint& a, const ControlPoint& b) { return a.tick < b.tick; });
}

void ExpressionSink::write_to(NoteSink& sink) {
    sink_ = &sink;
    lines_.clear();
}

std::size_t ExpressionSink::player_of(int voice) const {
    const std::vector<Player>& players = ensemble_.players;
    const auto next = std::upper_bound(players.begin(), players.end(), voice,
                                       [](int one, const Player& player) { return one < player.first_voice; });
    return next == players.begin() ? 0 : static_cast<std::size_t>(next - players.begin()) - 1;
}

PerformanceSink::PerformanceSink(NoteSink& sink, const Ensemble& ensemble, const PlayOptions& playing,
                                 bool is_printed)
    : sink_(sink), ensemble_(ensemble), playing_(playing), is_printed_(is_printed) {}

void PerformanceSink::notes(std::span<const Note> notes) {
    if (notes.size() > most - notes_.size()) {
        throw ScoreError(fmt::format("parts with expression have at most {} notes; limit the bars", most));
    }
    notes_.insert(notes_.end(), notes.begin(), notes.end());
}

void PerformanceSink::finish(std::int64_t end) {
    end_ = end;
    const std::vector<Player>& players = ensemble_.players;
    for (std::size_t i = 0; i < players.size(); ++i) {
        if (!players[i].melody.expression.any()) continue;
        const int first = players[i].first_voice;
        const int next = i + 1 < players.size() ? players[i + 1].first_voice : INT16_MAX + 1;
        std::vector<Note*> notes;
        for (Note& note : notes_) {
            if (note.voice >= first && note.voice < next && is_of_curve(note)) notes.push_back(&note);
        }
        std::stable_sort(notes.begin(), notes.end(), [](const Note* a, const Note* b) {
            return std::tie(a->onset, a->voice) < std::tie(b->onset, b->voice);
        });
        express(players[i], notes);
        if (curves_.controls.size() > most) {
            throw ScoreError(
                fmt::format("the curves of pan, controllers and gamakas have more than {} points; limit "
                            "the bars",
                            most));
        }
    }
    std::stable_sort(curves_.controls.begin(), curves_.controls.end(),
                     [](const ControlPoint& a, const ControlPoint& b) {
                         return std::tie(a.voice, a.tick) < std::tie(b.voice, b.tick);
                     });
    if (!curves_.empty()) sink_.curves(curves_);
    sink_.notes(notes_);
    sink_.finish(end);
}

void PerformanceSink::express(const Player& player, std::vector<Note*>& notes) {
    const MelodicExpression& expression = player.melody.expression;
    std::map<ExpressionSource, Parts> known;
    const auto parts = [&](ExpressionSource source) -> const Parts& {
        const auto [found, is_new] = known.try_emplace(source);
        if (is_new) found->second = parts_of(player, playing_, source, notes);
        return found->second;
    };
    if (expression.velocity.is_on()) {
        const std::vector<double> values = middles(parts(expression.velocity.source));
        for (std::size_t i = 0; i < notes.size(); ++i) {
            const double velocity = std::clamp(expression.velocity.at(values[i]), 1.0, 127.0);
            notes[i]->velocity = static_cast<std::uint8_t>(std::lround(velocity));
        }
    }
    bend(player, notes);
    if (is_printed_) return;
    if (expression.pan.is_on()) {
        add_control(notes, parts(expression.pan.source), expression.pan, ControlPoint::pan, curves_.controls);
    }
    if (expression.control.is_on()) {
        add_control(notes, parts(expression.control.source), expression.control, expression.controller,
                    curves_.controls);
    }
    if (expression.tempo.is_on() && &player == &ensemble_.players.front()) {
        add_tempo(player, notes, middles(parts(expression.tempo.source)), end_);
    }
}

/// Bends the notes of each voice, and marks those that slide.
void PerformanceSink::bend(const Player& player, const std::vector<Note*>& notes) {
    if (player.melody.expression.gamakas.empty()) return;
    std::map<std::int16_t, std::vector<Note*>> voices;
    for (Note* note : notes) {
        if (player.has_drums && note->voice >= player.first_voice + player.drums_from) continue;
        voices[note->voice].push_back(note);
    }
    std::vector<ControlPoint> unheard;
    Bender bender(player, ensemble_.tempo, is_printed_ ? unheard : curves_.controls);
    for (const auto& [voice, line] : voices) {
        for (std::size_t i = 0; i < line.size(); ++i) {
            bender.bend(i > 0 ? line[i - 1] : nullptr, *line[i], i + 1 < line.size() ? line[i + 1] : nullptr);
        }
    }
}

/// A tempo for each quarter: the mean of the notes that begin in it, smoothed over its neighbours.
void PerformanceSink::add_tempo(const Player& player, const std::vector<Note*>& notes,
                                const std::vector<double>& parts, std::int64_t end) {
    const auto beats = static_cast<std::size_t>(end / ticks_per_quarter + 1);
    if (beats > most) throw ScoreError(fmt::format("a tempo that follows the curve needs fewer than {} beats", most));
    std::vector<double> sums(beats, 0);
    std::vector<double> counts(beats, 0);
    for (std::size_t i = 0; i < notes.size(); ++i) {
        const auto beat = static_cast<std::size_t>(notes[i]->onset / ticks_per_quarter);
        sums[beat] += parts[i];
        ++counts[beat];
    }
    std::vector<double> values(beats, parts.empty() ? 0.5 : parts.front());
    for (std::size_t i = 0; i < beats; ++i) {
        values[i] = counts[i] > 0 ? sums[i] / counts[i] : i > 0 ? values[i - 1] : values[i];
    }
    constexpr int passes = 2;
    for (int pass = 0; pass < passes; ++pass) {
        std::vector<double> next = values;
        for (std::size_t i = 0; i < beats; ++i) {
            const double before = values[i > 0 ? i - 1 : 0];
            const double after = values[std::min(i + 1, beats - 1)];
            next[i] = (before + 2 * values[i] + after) / 4;
        }
        values = std::move(next);
    }
    for (std::size_t i = 0; i < beats; ++i) {
        const auto tick = static_cast<std::int64_t>(i) * ticks_per_quarter;
        const double factor = player.melody.expression.tempo.at(values[i]) / player.melody.tempo;
        if (tick >= end || (!curves_.tempo.empty() && curves_.tempo.back().factor == factor)) continue;
        curves_.tempo.push_back({tick, factor});
    }
}

}  // namespace sikku
