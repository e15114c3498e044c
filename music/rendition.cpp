#include "music/rendition.h"

#include "engine/base/memory.h"
#include "music/excerpt.h"
#include "music/score/unisons.h"

namespace sikku {
namespace {

/// True if drums sound together on their channel.
bool has_drum_voices(const ScoreHead& head) {
    int voices = 0;
    for (const Part& part : head.parts) voices += part.is_drums ? part.voices : 0;
    return voices > 1;
}

}  // namespace

NoteCollector Rendition::collect() {
    NoteCollector collector;
    report = perform(ensemble, playing, use, human, collector);
    return collector;
}

const Notation& Rendition::print() {
    if (playing.is_excerpt() && !ensemble.has_ending(playing)) return print_excerpt();
    Notator notator(head);
    report = perform(ensemble, playing, use, {}, notator);
    notation = notator.notation();
    return *notation;
}

/// Arranges the notes of the context in bars, and cuts out those of the excerpt.
const Notation& Rendition::print_excerpt() {
    constexpr double most_symbols = 400e3;
    ExcerptContext context = context_of(ensemble, playing, most_symbols);
    // Whole bars are printed.
    PlayOptions bars = playing;
    if (bars.to < INT64_MAX) bars.to = ensemble.bar_lines().next(bars.to);
    Notator alone(head);
    report = perform(ensemble, bars, use, {}, alone);  // for the counts
    try {
        notation = print_within(context);
    } catch (const TooLongToPrint&) {
        if (!context.is_whole) throw;
        context = bars_around(ensemble, playing);
        notation = print_within(context);
    }
    ExpressionSink ranges(ensemble, use);
    ranges.fold_ranges();
    report.has_own_ranges = !context.is_whole && ranges.measures_ranges();
    notation->moved = alone.notation().moved;
    notation->bent = alone.notation().bent;
    notation->merged = alone.notation().merged;
    notation->outside = alone.notation().outside;
    return *notation;
}

Notation Rendition::print_within(const ExcerptContext& context) const {
    const Ensemble whole = with_fixed_anchors(ensemble, playing);
    const std::int64_t length =
        context.playing.to < INT64_MAX ? context.playing.to - context.playing.from : INT64_MAX;
    ScoreHead whole_head = head;
    whole_head.meter = ensemble.tempo_and_meter(context.playing.from).meter;
    whole_head.changes = changes_after(ensemble.changes, context.playing.from);
    whole_head.upbeat = context.playing.from == 0 && context.playing.ahead == 0 ? ensemble.upbeat : 0;
    if (ensemble.close != Close::none) {
        NullSink nobody;
        const bool has_end = context.is_whole || play_parts(whole, context.playing, nobody).end < length;
        if (has_end) whole_head.ritardando = ensemble.ritardando(context.playing);
    }
    const BarLines lines = ensemble.bar_lines();
    Notator::Bars bars;
    bars.first = lines.number(playing.from) - lines.number(context.playing.from);
    if (playing.to < INT64_MAX) {
        bars.count = std::max<std::int64_t>(1, lines.count(playing.to) - lines.number(playing.from));
    }
    Notator notator(whole_head, bars);
    perform_all(whole, context.playing, use, {}, notator);
    return notator.notation();
}

void Rendition::write_midi(Output& output) {
    const auto writer = sikku::write_midi(head, output, midi);
    if (!midi.share_channels && !has_drum_voices(head)) {
        report = perform(ensemble, playing, use, human, *writer);
        return;
    }
    UnisonMerger merger(*writer, head, static_cast<std::size_t>(available_memory() / 4 / sizeof(Note)),
                        midi.share_channels);
    report = perform(ensemble, playing, use, human, merger, &merger.strokes_before());
}

}  // namespace sikku
