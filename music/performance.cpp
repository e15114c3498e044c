#include "music/performance.h"

#include "music/excerpt.h"
#include "music/held_ending.h"
#include "music/humaniser.h"
#include "music/strict_check.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sikku {
namespace {

constexpr std::int64_t control_ticks = ticks_per_quarter / 16;  // between points of a ramp
constexpr std::size_t held_back = 2;  // notes of a voice that are held back, if the next may bend them

/// Direction of the turn before a note: -1 to the right, 1 to the left, 0 straight on.
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

/// Values of a source at the beginning and the end of a note.
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
            return both(note.level);
        case ExpressionSource::none:
            break;
    }
    return both(0);
}

/// True for notes of the curve; accompaniments have no place on it.
bool is_of_curve(const Note& note) {
    return note.from != note.end_point();
}

/// Adds the points of a note where the rounded value changes.
/// @param part  position in the range of the source, from 0 to 1, where the note begins and ends
/// @param last  value of the voice so far
void add_control(const Note& note, std::pair<double, double> part, const ExpressionCurve& curve, int number,
                 std::optional<int>& last, std::vector<ControlPoint>& points) {
    const auto [begin, end] = part;
    // A note passes through at most 128 values.
    const std::int64_t step = control_ticks * std::max<std::int64_t>(1, note.duration / control_ticks / 4096);
    for (std::int64_t at = 0; at < note.duration; at += step) {
        const double here = begin + (end - begin) * static_cast<double>(at) / static_cast<double>(note.duration);
        const int value = static_cast<int>(std::floor(std::clamp(curve.at(here), 0.0, 127.0) + 0.5));
        if (last != value) points.push_back({note.onset + at, note.voice, number, static_cast<double>(value)});
        last = value;
        if (begin == end) break;
    }
}

void sort_by_tick(std::vector<ControlPoint>::iterator first, std::vector<ControlPoint>::iterator last) {
    const auto is_earlier = [](const ControlPoint& a, const ControlPoint& b) { return a.tick < b.tick; };
    if (!std::is_sorted(first, last, is_earlier)) std::stable_sort(first, last, is_earlier);
}

}  // namespace

ExpressionSink::ExpressionSink(const Ensemble& ensemble, Use use) : ensemble_(ensemble), use_(use) {
    for (const Player& player : ensemble.players) {
        const MelodicExpression& expression = player.melody.expression;
        std::vector<Followed>& curves = followed_.emplace_back();
        has_turns_.push_back(0);
        const auto follow = [&](const ExpressionCurve& curve, int number) {
            if (!curve.is_on()) return;
            const bool is_turn = curve.source == ExpressionSource::turn;
            curves.push_back(
                {curve, number, is_turn ? SourceRange{-1, 1} : SourceRange{INFINITY, -INFINITY}, is_turn});
            if (is_turn) has_turns_.back() = 1;
        };
        follow(expression.velocity, velocity);
        auto& bender = benders_.emplace_back();
        if (!expression.gamakas.empty()) bender.emplace(player.melody);
        if (use == Use::print) continue;
        follow(expression.pan, ControlPoint::pan);
        follow(expression.control, expression.controller);
        if (&player != &ensemble.players.front() || !expression.tempo.is_on()) continue;
        follow(expression.tempo, tempo_number);
        if (use == Use::performance) tempo_.emplace(expression.tempo, player.melody.tempo);
    }
}

ExpressionSink::ExpressionSink(const ExpressionSink& measured, NoteSink& sink)
    : ensemble_(measured.ensemble_),
      use_(measured.use_),
      sink_(&sink),
      followed_(measured.followed_),
      has_turns_(measured.has_turns_),
      benders_(measured.benders_) {
    const Melody& first = ensemble_.players.front().melody;
    if (first.expression.tempo.is_on()) tempo_.emplace(first.expression.tempo, first.tempo);
}

void ExpressionSink::fold_ranges() {
    if (ensemble_.needs_whole()) return;
    for (std::size_t i = 0; i < followed_.size(); ++i) {
        const Player& player = ensemble_.players[i];
        const bool has_place = std::any_of(followed_[i].begin(), followed_[i].end(), [](const Followed& one) {
            return one.curve.source == ExpressionSource::x || one.curve.source == ExpressionSource::y;
        });
        if (!has_place || player.is_bass) continue;
        const auto box = note_box(player.document.grammar(), player.melody);
        if (!box) continue;
        for (Followed& one : followed_[i]) {
            const bool is_x = one.curve.source == ExpressionSource::x;
            if (!is_x && one.curve.source != ExpressionSource::y) continue;
            one.range = is_x ? box->x : box->y;
            one.is_known = true;
        }
    }
}

void ExpressionSink::take_ranges(const ExpressionSink& other) {
    for (std::size_t i = 0; i < followed_.size(); ++i) {
        for (std::size_t k = 0; k < followed_[i].size(); ++k) {
            followed_[i][k].range = other.followed_[i][k].range;
            followed_[i][k].is_known = true;
        }
    }
}

bool ExpressionSink::needs_ranges() const {
    return tempo_ || measures_ranges();
}

bool ExpressionSink::measures_ranges() const {
    return std::any_of(followed_.begin(), followed_.end(), [](const std::vector<Followed>& curves) {
        return std::any_of(curves.begin(), curves.end(), [](const Followed& one) { return !one.is_known; });
    });
}

ExpressionSink::Line& ExpressionSink::line_of(int voice) {
    const auto at = static_cast<std::size_t>(voice);
    if (at >= lines_.size()) lines_.resize(at + 1);
    std::optional<Line>& line = lines_[at];
    if (line) return *line;
    line = Line();
    const std::vector<Player>& players = ensemble_.players;
    const auto next = std::upper_bound(players.begin(), players.end(), voice,
                                       [](int one, const Player& player) { return one < player.first_voice; });
    line->player = next == players.begin() ? 0 : static_cast<std::size_t>(next - players.begin()) - 1;
    const Player& player = players[line->player];
    const bool is_drum = player.has_drums && voice >= player.first_voice + player.drums_from;
    line->is_bent = benders_[line->player] && !is_drum;
    line->last.resize(followed_[line->player].size());
    return *line;
}

void ExpressionSink::notes(std::span<const Note> notes) {
    for (const Note& note : notes) {
        Line& line = line_of(note.voice);
        if (sink_ && line.is_bent) {
            hold(line, note);
        } else if (sink_) {
            const auto first = static_cast<std::ptrdiff_t>(points_.size());
            express(line, changed_.emplace_back(note), points_);
            sort_by_tick(points_.begin() + first, points_.end());
        } else {
            measure(line, note);
        }
    }
    if (sink_) hand_on();
}

void ExpressionSink::measure(Line& line, const Note& note) {
    if (!is_of_curve(note)) return;
    for (Followed& one : followed_[line.player]) {
        const auto [begin, end] = values_of(one.curve.source, line.before ? &*line.before : nullptr, note);
        if (!one.is_known) {
            one.range.low = std::min({one.range.low, begin, end});
            one.range.high = std::max({one.range.high, begin, end});
        }
        if (one.number == tempo_number && tempo_) tempo_->add(note.onset, (begin + end) / 2);
    }
    if (has_turns_[line.player] != 0) line.before = note;
}

/// Changes the velocity of a note, and adds the points of its controllers.
void ExpressionSink::express(Line& line, Note& note, std::vector<ControlPoint>& points) {
    if (!is_of_curve(note)) return;
    const std::vector<Followed>& curves = followed_[line.player];
    for (std::size_t i = 0; i < curves.size(); ++i) {
        const auto& [curve, number, range, is_known] = curves[i];
        const auto [begin, end] = values_of(curve.source, line.before ? &*line.before : nullptr, note);
        if (number == tempo_number) {
            if (tempo_) tempo_->add(note.onset, (begin + end) / 2);
            continue;
        }
        const std::pair<double, double> part{range.part(begin), range.part(end)};
        if (number != velocity) {
            add_control(note, part, curve, number, line.last[i], points);
            continue;
        }
        const double value = curve.at((part.first + part.second) / 2);
        note.velocity =
            static_cast<std::uint8_t>(std::clamp<long>(std::lround(value) + note.emphasis.velocity(), 1, 127));
        note.emphasis.dynamic = -1;
    }
    if (has_turns_[line.player] != 0) line.before = note;
}

/// Holds a note back, as the next one may bend it and mark the one before it.
void ExpressionSink::hold(Line& line, const Note& note) {
    Line::Held next{note, {}};
    express(line, next.note, next.points);
    bend(line, &note);
    if (line.held.size() == held_back) release(line);
    line.held.push_back(std::move(next));
}

/// Bends the last note that is held. @param after  the one that follows it; null if there is none
void ExpressionSink::bend(Line& line, const Note* after) {
    if (line.held.empty()) return;
    auto& [note, points] = line.held.back();
    if (!is_of_curve(note)) return;
    Note* const before = line.held.size() == held_back ? &line.held.front().note : nullptr;
    bends_.clear();
    benders_[line.player]->bend(before && is_of_curve(*before) ? before : nullptr, note,
                                after && is_of_curve(*after) ? after : nullptr, ensemble_.tempo_at(note.onset),
                                bends_);
    if (use_ != Use::print) points.insert(points.begin(), bends_.begin(), bends_.end());
}

/// Forwards the first note that is held.
void ExpressionSink::release(Line& line) {
    auto& [note, points] = line.held.front();
    sort_by_tick(points.begin(), points.end());
    points_.insert(points_.end(), points.begin(), points.end());
    changed_.push_back(note);
    line.held.erase(line.held.begin());
}

void ExpressionSink::hand_on() {
    if (!points_.empty()) sink_->controls(points_);
    if (!changed_.empty()) sink_->notes(changed_);
    points_.clear();
    changed_.clear();
}

void ExpressionSink::finish(std::int64_t end) {
    if (!sink_) {
        end_ = end;
        return;
    }
    for (std::optional<Line>& line : lines_) {
        if (!line) continue;
        bend(*line, nullptr);
        while (!line->held.empty()) release(*line);
    }
    hand_on();
    sink_->finish(end);
}

void ExpressionSink::write_to(NoteSink& sink) {
    sink_ = &sink;
    lines_.clear();
    if (!tempo_) return;
    curves_.tempo = tempos(end_);
    tempo_.reset();
    sink_->curves(curves_);
}

std::vector<TempoPoint> ExpressionSink::tempos(std::int64_t end) const {
    if (!tempo_) return {};
    for (const Followed& one : followed_.front()) {
        if (one.number == tempo_number) return tempo_->points(one.range, end);
    }
    return {};
}

namespace {

/// Parts that state an excerpt follow the ranges of the whole curve, which is played for them once.
void take_whole_ranges(const Ensemble& ensemble, ExpressionSink::Use use, ExpressionSink& expressive) {
    if (!expressive.needs_ranges() || std::none_of(ensemble.players.begin(), ensemble.players.end(), has_excerpt))
        return;
    Ensemble whole = without_excerpts(ensemble);
    if (!is_soon_played(whole)) return;
    ExpressionSink measured(whole, use);
    measured.fold_ranges();
    try {
        play_all(whole, {}, measured);
    } catch (const ScoreError&) {
        return;  // its form has other sections, for example
    }
    expressive.take_ranges(measured);
}

/// Plays an excerpt within its context, in which curves of expression have their ranges and the end slows down.
EnsembleReport perform_within(const Ensemble& ensemble, const ExcerptContext& context, const PlayOptions& playing,
                              ExpressionSink::Use use, const Human& human, NoteSink& sink, LastStrokes* before) {
    NullSink nobody;
    EnsembleReport report = play_parts(ensemble, playing, nobody);  // for the counts
    Ensemble whole = with_fixed_anchors(ensemble, playing);
    if (ensemble.ends_excerpts) whole.close = Close::none;
    whole.ends_excerpts = false;
    ExpressionSink expressive(whole, use);
    expressive.fold_ranges();
    take_whole_ranges(whole, use, expressive);
    report.has_own_ranges = !context.is_whole && expressive.measures_ranges();
    const std::int64_t end = play_all(whole, context.playing, expressive).end;
    const std::int64_t from = playing.from - context.playing.from;
    const std::int64_t to = playing.to < INT64_MAX ? playing.to - context.playing.from : INT64_MAX;

    Curves curves;
    const bool slows = whole.close != Close::none && use != ExpressionSink::Use::print &&
                       (context.playing.to == INT64_MAX || end < context.playing.to - context.playing.from);
    ScoreHead head;
    head.ritardando = slows ? whole.ritardando(context.playing) : 0;
    curves.tempo = cut_tempo(tempo_map(head, {expressive.tempos(end), {}}, end), from, to);
    if (!curves.tempo.empty()) sink.curves(curves);

    Humaniser humaniser(sink, human.amount, human.seed, playing.from);
    NoteSink& human_or_not = human.amount > 0 ? static_cast<NoteSink&>(humaniser) : sink;
    HeldEnding ending(ensemble, human_or_not);
    const bool is_held = ensemble.ends_excerpts && ensemble.close == Close::fermata;
    ExcerptSink excerpt(is_held ? static_cast<NoteSink&>(ending) : human_or_not, from, to, before);
    expressive.write_to(excerpt);
    const EnsembleReport around = play_parts(whole, context.playing, expressive);
    report.end = std::max<std::int64_t>(0, std::min(around.end, to) - from);
    expressive.finish(around.end);
    if (excerpt.count() == 0) play_all(ensemble, playing, nobody);  // throws the reason
    if (report.notes == 0) {
        // Only a note that a fermata holds sounds.
        report.lowest = excerpt.lowest();
        report.highest = excerpt.highest();
    }
    report.notes = excerpt.count();
    if (is_held) {
        const std::int64_t most = playing.to < INT64_MAX ? playing.to - playing.from : INT64_MAX;
        report.end = ending.finish(report.end, ensemble.bar_lines().from(playing.from), most);
        human_or_not.finish(report.end);
    }
    report.seconds = seconds_of(ensemble, playing, report.end, use, curves.tempo);
    return report;
}

}  // namespace

EnsembleReport perform_all(const Ensemble& ensemble, const PlayOptions& playing, ExpressionSink::Use use,
                           const Human& human, NoteSink& sink) {
    Humaniser humaniser(sink, human.amount, human.seed, playing.from);
    NoteSink& to = human.amount > 0 ? static_cast<NoteSink&>(humaniser) : sink;
    std::vector<TempoPoint> tempo;
    EnsembleReport report;
    if (ensemble.has_expression()) {
        ExpressionSink expressive(ensemble, use);
        expressive.fold_ranges();
        take_whole_ranges(ensemble, use, expressive);
        if (expressive.needs_ranges()) play_all(ensemble, playing, expressive);
        expressive.write_to(to);
        report = play_all(ensemble, playing, expressive);
        tempo = expressive.tempo();
    } else {
        report = play_all(ensemble, playing, to);
    }
    report.seconds = seconds_of(ensemble, playing, report.end, use, tempo);
    return report;
}

EnsembleReport perform(const Ensemble& ensemble, const PlayOptions& playing, ExpressionSink::Use use,
                       const Human& human, NoteSink& sink, LastStrokes* before) {
    const bool merges_before = before && playing.from > 0;
    const auto play_into = [&](NoteSink& to) {
        return playing.is_excerpt() && (depends_on_whole(ensemble) || merges_before)
                   ? perform_within(ensemble, context_of(ensemble, playing), playing, use, human, to, before)
                   : perform_all(ensemble, playing, use, human, to);
    };
    if (!ensemble.is_strict()) return play_into(sink);
    StrictCheck check(ensemble, ensemble.bar_lines().from(playing.from), sink);
    EnsembleReport report = play_into(check);
    report.strict_faults = check.faults(human.amount > 0 ? Humaniser::latest : 0);
    return report;
}

double seconds_of(const Ensemble& ensemble, const PlayOptions& playing, std::int64_t end, ExpressionSink::Use use,
                  const std::vector<TempoPoint>& curve) {
    ScoreHead times;
    if (ensemble.has_ending(playing) && use != ExpressionSink::Use::print) {
        times.ritardando = ensemble.ritardando(playing);
    }
    times.tempo = ensemble.tempo_and_meter(playing.from).tempo;
    times.changes = changes_after(ensemble.changes, playing.from);
    return seconds_at(end, times.tempo, tempo_map(times, {curve, {}}, end));
}

}  // namespace sikku
