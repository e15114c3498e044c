#include "music/excerpt.h"

#include "engine/derivation/forecast.h"
#include "engine/derivation/word_size.h"
#include "music/score/glides.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>

namespace sikku {
namespace {

/// Replaces `anchor: piece` by the height of the first note of the excerpt.
void fix_anchor(Player& player, const Ensemble& ensemble, const PlayOptions& playing) {
    Melody& melody = player.melody;
    if (melody.anchor != Anchor::piece) return;
    Melody plain = melody;
    plain.cadence = Cadence::none;
    plain.harmony = Harmony::none;
    plain.progression.clear();
    plain.articulation = Articulation::legato;
    plain.swing = 0.5;
    // Degrees are not changed, even far from the tonic.
    plain.lowest = -std::numeric_limits<double>::infinity();
    plain.highest = std::numeric_limits<double>::infinity();
    const PlayOptions whole = piece_of_part(player, ensemble, playing);
    for (std::int64_t length = ensemble.meter.bar(); whole.from < whole.to; length *= 2) {
        PlayOptions options = whole;
        options.to = whole.to - whole.from > length ? whole.from + length : whole.to;
        const auto first_degree = [&](Anchor anchor) {
            std::vector<std::int64_t> degrees;
            options.degrees = &degrees;
            plain.anchor = anchor;
            NullSink nobody;
            player.playable->play(plain, nobody, options);
            return degrees.empty() ? std::optional<std::int64_t>() : degrees.front();
        };
        if (const auto degree = first_degree(Anchor::piece)) {
            melody.shift += *degree - *first_degree(Anchor::first_note);
            melody.anchor = Anchor::first_note;
            return;
        }
        if (options.to == whole.to) return;
    }
}

}  // namespace

bool is_soon_played(const Ensemble& ensemble, double most) {
    double symbols = 0;
    for (const Player& player : ensemble.players) {
        symbols += word_size(shorten(player.document.grammar()), most).nodes;
    }
    return symbols <= most;
}

bool depends_on_whole(const Ensemble& ensemble) {
    if (ensemble.has_expression() || (ensemble.close != Close::none && !ensemble.ends_excerpts)) return true;
    // Notes cut at the end of an excerpt keep the loudness of their full length.
    return std::any_of(ensemble.players.begin(), ensemble.players.end(), [](const Player& player) {
        const Melody& melody = player.melody;
        // The last bar of a progression is held.
        const bool holds_last_bar = melody.harmony == Harmony::progression && !melody.figure.layers.empty();
        return melody.loudness == Loudness::by_length || holds_last_bar;
    });
}

Ensemble without_excerpts(Ensemble ensemble) {
    for (Player& player : ensemble.players) {
        player.melody.layout.first_bar = 1;
        player.melody.layout.bars = 0;
    }
    return ensemble;
}

ExcerptContext bars_around(const Ensemble& ensemble, const PlayOptions& excerpt) {
    constexpr std::int64_t around = 8;  // hairpins have four
    const BarLines bars = ensemble.bar_lines();
    std::int64_t first = std::max<std::int64_t>(0, bars.number(excerpt.from) - around);
    // Where a quarter begins, too, as the tempo follows quarters.
    while (bars.onset(first) % ticks_per_quarter != 0) --first;
    ExcerptContext context{excerpt, false};
    context.playing.from = bars.onset(first);
    const std::int64_t after = around * bars.length(excerpt.to);
    if (excerpt.to < INT64_MAX - after) context.playing.to = excerpt.to + after;
    return context;
}

ExcerptContext context_of(const Ensemble& ensemble, const PlayOptions& excerpt, double most_symbols) {
    // The bar lines of sections are known only after the whole score was read.
    const bool has_sections = !ensemble.changes.empty();
    if (!has_sections && (excerpt.ahead != 0 || !is_soon_played(ensemble, most_symbols))) {
        return bars_around(ensemble, excerpt);
    }
    ExcerptContext context{excerpt};
    context.playing.from = 0;
    context.playing.to = INT64_MAX;
    return context;
}

Ensemble with_fixed_anchors(Ensemble ensemble, const PlayOptions& excerpt) {
    // Scores that are read as a whole begin at their first note in any case.
    if (ensemble.needs_whole()) return ensemble;
    for (Player& player : ensemble.players) fix_anchor(player, ensemble, excerpt);
    return ensemble;
}

std::vector<TempoPoint> cut_tempo(std::span<const TempoPoint> tempo, std::int64_t from, std::int64_t to) {
    std::vector<TempoPoint> cut;
    for (const TempoPoint& point : tempo) {
        if (point.tick >= to) break;
        if (point.tick <= from) cut.clear();
        cut.push_back({std::max<std::int64_t>(0, point.tick - from), point.factor});
    }
    return cut;
}

void ExcerptSink::controls(std::span<const ControlPoint> points) {
    for (const ControlPoint& point : points) {
        const auto voice = static_cast<std::size_t>(point.voice);
        if (voice >= voices_.size()) voices_.resize(voice + 1);
        voices_[voice].coming.push_back(point);
    }
}

/// Takes the points of a note from those to come.
void ExcerptSink::pass_controls(Voice& voice, const Note& note) {
    const std::int64_t first = std::max(note.onset, from_);
    auto next = voice.coming.begin();
    for (; next != voice.coming.end() && next->tick < note.onset + note.duration && next->tick <= first; ++next) {
        if (note.onset + note.duration > from_ || next->number != ControlPoint::bend) {
            voice.before[next->number] = next->value;
        }
    }
    if (note.onset + note.duration > from_ && note.onset < to_) {
        for (const auto& [number, value] : voice.before)
            points_.push_back({first - from_, note.voice, number, value});
        voice.before.clear();
        for (; next != voice.coming.end() && next->tick < note.onset + note.duration; ++next) {
            if (next->tick >= to_) continue;
            points_.push_back(*next);
            points_.back().tick -= from_;
        }
    }
    while (next != voice.coming.end() && next->tick < note.onset + note.duration) ++next;
    voice.coming.erase(voice.coming.begin(), next);
}

void ExcerptSink::notes(std::span<const Note> notes) {
    for (const Note& note : notes) {
        const auto number = static_cast<std::size_t>(note.voice);
        if (number < voices_.size()) pass_controls(voices_[number], note);
        const bool begins_before = note.onset < from_;
        if (begins_before && before_) before_->add(note);
        if (note.onset + note.duration <= from_ || note.onset >= to_) continue;
        Note& piece = cut_.emplace_back(note);
        piece.is_remainder = begins_before;
        if (note.onset + note.duration > to_) piece.has_fermata = false;
        cut(piece, from_, to_);
        piece.onset -= from_;
        ++count_;
        lowest_ = std::min(lowest_, piece.key);
        highest_ = std::max(highest_, piece.key);
    }
    if (!points_.empty()) sink_.controls(points_);
    if (!cut_.empty()) sink_.notes(cut_);
    points_.clear();
    cut_.clear();
}

void ExcerptSink::finish(std::int64_t end) {
    sink_.finish(std::max<std::int64_t>(0, std::min(end, to_) - from_));
}

}  // namespace sikku
