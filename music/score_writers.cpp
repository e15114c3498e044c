#include "music/score_writers.h"

#include "engine/base/output_file.h"
#include "engine/base/text.h"
#include "music/score/audio.h"
#include "music/score/engraving.h"
#include "music/score/repeats.h"
#include "music/score/score_formats.h"

#include <fmt/format.h>

#include <array>

namespace sikku {
namespace {

using enum ScoreMedium;

template <AudioFormat format>
void write_sound(Rendition& rendition, Output& output) {
    OutputFile score(output.temporary().string() + ".mid", rendition.name);  // never committed
    rendition.write_midi(score);
    const double seconds = rendition.report.seconds;
    if (seconds > most_audio_seconds) {
        throw ScoreError(
            fmt::format("{} of sound are too long: a WAV file can contain 6 hours 45 minutes; limit the bars or "
                        "seconds",
                        time_text(seconds)));
    }
    const double peak = render_audio(
        score.temporary(), output.temporary(), format, [&](double) { rendition.monitor.check(); }, rendition.name);
    if (peak == 0)
        rendition.warning = "the sound is silent: the soundfont has no sound for these keys of this instrument";
}

/// Writes notation by a function of notation and head.
template <void (*write)(const Notation&, const ScoreHead&, Output&)>
void write_notation(const Notation& notation, const Rendition& rendition, Output& output) {
    write(notation, rendition.head, output);
}

void write_compressed(const Notation& notation, const Rendition& rendition, Output& output) {
    MemoryOutput whole;
    write_musicxml(notation, rendition.head, whole);
    write_mxl(whole.bytes(), output);
}

void write_engraved(const Notation& notation, const Rendition& rendition, Output& output) {
    MemoryOutput whole;
    write_lilypond(notation, rendition.head, whole);
    engrave(whole.bytes(), rendition.head, output.temporary(), rendition.name, [&] { rendition.monitor.check(); });
}

/// Writes all notes by a function of head, notes, end and perhaps curves.
template <auto write>
void write_notes(Rendition& rendition, Output& output) {
    const NoteCollector all = rendition.collect();
    if constexpr (requires { write(rendition.head, all.notes(), all.end(), output, all.curves()); }) {
        write(rendition.head, all.notes(), all.end(), output, all.curves());
    } else {
        write(rendition.head, all.notes(), all.end(), output);
    }
}

constexpr ScoreCost sound_cost{1, 600, 60e6, 2e-3, 44'100, 0};

/// A drawn score is named `notes.svg` and a printed one `score.pdf`, because `svg` and `pdf` are prints.
constexpr std::array<ScoreWriter, 13> table = {{
    {.name = {"mid", "MIDI", "midi"},
     .medium = midi,
     .cost = {0, 600, 1e6, 80e-9, 9, 0},
     .write = [](Rendition& rendition, Output& output) { rendition.write_midi(output); }},
    {.name = {.extension = "musicxml", .label = "MusicXML", .alias = "xml", .is_text = true},
     .medium = notation,
     .is_printed = true,
     .pattern = PatternForm::xml,
     .lowest = lowest_in_musicxml,
     .print = write_notation<write_musicxml>,
     .has_cues = true,
     .most_repeats = most_times_repeated},
    {.name = {"mxl", "compressed MusicXML"},
     .medium = notation,
     .is_printed = true,
     .pattern = PatternForm::xml,
     .lowest = lowest_in_musicxml,
     .cost = {0.001, 1000, 2e6, 2.5e-6, 12, 110},
     .print = write_compressed,
     .has_cues = true,
     .most_repeats = most_times_repeated},
    {.name = {.extension = "ly", .label = "LilyPond", .is_text = true},
     .medium = notation,
     .is_printed = true,
     .pattern = PatternForm::comments,
     .print = write_notation<write_lilypond>,
     .has_cues = true,
     .most_repeats = most_times_repeated},
    {.name = {"score.pdf", "printed score", "pdf"},
     .medium = notation,
     .is_printed = true,
     .needs_file = "a printed score needs",
     .cost = {2, 10'000, 120e6, 2e-3, 300, 20'000},
     .print = write_engraved,
     .has_cues = true,
     .most_repeats = most_times_repeated},
    {.name = {.extension = "abc", .label = "ABC", .is_text = true},
     .medium = notation,
     .is_printed = true,
     .pattern = PatternForm::comments,
     .print = write_notation<write_abc>,
     .most_repeats = 2},
    {.name = {"wav", "sound"},
     .medium = sound,
     .needs_file = "sound needs",
     .cost = sound_cost,
     .write = write_sound<AudioFormat::wav>},
    {.name = {"flac", "sound"},
     .medium = sound,
     .needs_file = "sound needs",
     .cost = sound_cost,
     .write = write_sound<AudioFormat::flac>},
    {.name = {.extension = "csd", .label = "Csound", .is_text = true},
     .pattern = PatternForm::comments,
     .write = write_notes<write_csound_file>},
    {.name = {.extension = "sco", .label = "Csound score", .is_text = true},
     .pattern = PatternForm::comments,
     .write = write_notes<write_csound_score>},
    {.name = {.extension = "strudel", .label = "Strudel", .is_text = true},
     .is_printed = true,
     .plays_swing = true,
     .has_glides = false,
     .pattern = PatternForm::comments,
     .write = write_notes<write_strudel>},
    {.name = {.extension = "notes.svg", .label = "the notes", .alias = "svg", .is_text = true},
     .medium = view,
     .write = write_notes<write_music_svg>},
    {.name = {.extension = "html", .label = "play", .is_text = true},
     .medium = view,
     .pattern = PatternForm::xml,
     .write = write_notes<write_music_page>},
}};

}  // namespace

std::span<const ScoreWriter> score_writers() {
    return table;
}

const ScoreWriter& score_writer(std::string_view format) {
    for (const ScoreWriter& row : table) {
        if (find_format(std::span(&row.name, 1), format)) return row;
    }
    refuse_option("format", std::string(format), "unknown format");
}

}  // namespace sikku
