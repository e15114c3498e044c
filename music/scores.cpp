#include "music/scores.h"

#include "engine/base/input_file.h"
#include "engine/base/keys.h"
#include "engine/base/memory.h"
#include "engine/base/output_file.h"
#include "engine/base/text.h"
#include "engine/derivation/forecast.h"
#include "engine/derivation/word_size.h"
#include "engine/geometry/lattice.h"
#include "music/arrangement.h"
#include "music/ensemble.h"
#include "music/humaniser.h"
#include "music/melody/melody.h"
#include "music/melody/melody_fold.h"
#include "music/note_stream.h"
#include "music/performance.h"
#include "music/play_settings.h"
#include "music/players.h"
#include "music/score/abc.h"
#include "music/score/audio.h"
#include "music/score/comments.h"
#include "music/score/csound.h"
#include "music/score/engraving.h"
#include "music/score/glides.h"
#include "music/score/instruments.h"
#include "music/score/lilypond.h"
#include "music/score/midi.h"
#include "music/score/music_page.h"
#include "music/score/musicxml.h"
#include "music/score/mxl.h"
#include "music/score/notation.h"
#include "music/score/rhythm.h"
#include "music/score/spelling.h"
#include "music/score/strudel.h"
#include "music/score/unisons.h"
#include "music/shared_channels.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iterator>
#include <map>
#include <optional>
#include <tuple>

namespace sikku {
namespace {

enum class ScoreFormat { midi, musicxml, mxl, lilypond, pdf, abc, wav, flac, csd, sco, strudel, svg, html };

constexpr int widest_bend = 12;    // semitones, for gamakas
constexpr int most_channels = 15;  // without the one of drums

struct ScoreFormatInfo {
    FormatName name;
    ScoreFormat format;
};

/// The formats of scores. A drawn score is named `notes.svg` and a printed one `score.pdf`, because `svg` and `pdf`
/// are prints.
constexpr std::array<ScoreFormatInfo, 13> format_table = {
    {{{"mid", "MIDI", "midi"}, ScoreFormat::midi},
     {{.extension = "musicxml", .label = "MusicXML", .alias = "xml", .is_text = true}, ScoreFormat::musicxml},
     {{"mxl", "compressed MusicXML"}, ScoreFormat::mxl},
     {{.extension = "ly", .label = "LilyPond", .is_text = true}, ScoreFormat::lilypond},
     {{"score.pdf", "printed score", "pdf"}, ScoreFormat::pdf},
     {{.extension = "abc", .label = "ABC", .is_text = true}, ScoreFormat::abc},
     {{"wav", "sound"}, ScoreFormat::wav},
     {{"flac", "sound"}, ScoreFormat::flac},
     {{.extension = "csd", .label = "Csound", .is_text = true}, ScoreFormat::csd},
     {{.extension = "sco", .label = "Csound score", .is_text = true}, ScoreFormat::sco},
     {{.extension = "strudel", .label = "Strudel", .is_text = true}, ScoreFormat::strudel},
     {{.extension = "notes.svg", .label = "the notes", .alias = "svg", .is_text = true}, ScoreFormat::svg},
     {{.extension = "html", .label = "play", .is_text = true}, ScoreFormat::html}}};

// Programs of General MIDI, counted from 0.
constexpr int strings = 48;
constexpr int sitar = 104;

std::string made_with(const PlaySettings& settings, const std::vector<Player>& players, bool is_arrangement) {
    std::string text;
    // The document of a single pattern contains the keys itself.
    for (const Setting& setting : settings.keys) {
        if (is_arrangement) text += fmt::format(" --{} '{}'", setting.key, setting.value);
    }
    if (settings.from_bar != 1) text += fmt::format(" --from-bar {}", settings.from_bar);
    if (settings.bars != 0) text += fmt::format(" --bars {}", settings.bars);
    if (settings.seconds != 0) text += fmt::format(" --seconds {}", settings.seconds);
    if (settings.transpose != 0) text += fmt::format(" --transpose {}", settings.transpose);
    if (settings.tuning != Tuning::bend) {
        text += settings.tuning == Tuning::mts ? " --tuning mts" : " --tuning mpe";
    }
    if (settings.humanise != 0) {
        text += fmt::format(" --humanise {}", settings.humanise);
        if (!players.front().document.has_override("seed")) text += fmt::format(" --seed {}", settings.seed);
    }
    const Document& first = players.front().document;
    const std::string made = recipe(first, first.grammar(), "", text);
    // An arrangement contains the settings of its patterns.
    return is_arrangement ? made.substr(0, made.find(',')) + (text.empty() ? "" : ",") + text : made;
}

/// Adds the texts of a pattern.
void add_texts(const Player& player, std::vector<std::string>& titles, ScoreHead& head) {
    const Pattern& pattern = player.document.pattern();
    const std::string title = pattern.text("title");
    if (!title.empty() && std::find(titles.begin(), titles.end(), title) == titles.end()) titles.push_back(title);
    if (head.composer.empty()) head.composer = pattern.text("composer");
    if (head.source.empty()) head.source = pattern.text("source");
}

Part drum_part(const std::string& name, int voices, bool has_chords) {
    Part part;
    part.has_chords = has_chords;
    part.name = name.empty() ? "Drums" : name;
    part.is_drums = true;
    part.voices = voices;
    part.spelling = spell(*find_scale("major"), {});
    return part;
}

/// @param arrangement  null for a single pattern
/// @param most         limit of voices of the format
ScoreHead head_of(const PlaySettings& options, Ensemble& ensemble, const Arrangement* arrangement,
                  const PlayOptions& playing, int most) {
    ScoreHead head;
    std::vector<Player>& players = ensemble.players;
    head.tempo = ensemble.tempo;
    head.ritardando = ensemble.close != Close::none ? 2 * ensemble.meter.bar() : 0;
    head.meter = ensemble.meter;
    head.made = made_with(options, players, arrangement != nullptr);
    if (arrangement) {
        head.title = arrangement->title;
        head.composer = arrangement->composer;
        head.source = arrangement->source;
    }
    head.pattern = arrangement ? arrangement->text : players.front().document.source().text();
    std::vector<std::string> titles;
    int voices = 0;
    int pitched = 0;  // all but the drums
    for (Player& player : players) {
        const Melody& melody = player.melody;
        if (!player.is_bass) add_texts(player, titles, head);
        Part part;
        const std::string& own_name = player.name;
        part.name = own_name.empty() ? instrument_of(melody.program).name : own_name;
        part.has_instrument_name = own_name.empty();
        part.scale = scale_of(melody);
        part.program = melody.program;
        part.key = key_signature(melody.scale, melody.tonic_spelling);
        part.spelling = spell(melody.scale, melody.tonic_spelling);
        part.signature = print_signature(melody.scale, melody.tonic_spelling);
        player.first_voice = voices;
        PlayOptions counting = playing;
        counting.most_voices = most_voices;
        if (ensemble.needs_whole()) {
            counting.from = 0;
            counting.to = INT64_MAX;
        }
        part.voices = voices_of(player, counting);
        const SoundKinds sounds = sound_kinds(player.document.grammar(), melody);
        const int own_voices = part.voices;
        const bool has_chords = melody.table.most_notes() > 1;
        part.has_chords = has_chords;
        // Drums alone are the only part of their pattern.
        const bool is_drums_alone = sounds.has_drums && !sounds.has_pitches && melody.accompanying_voices() == 0;
        player.has_drums = sounds.has_drums;
        player.chords_from = own_voices;
        player.drums_from = is_drums_alone ? 0 : own_voices + melody.accompanying_voices();
        voices += player.drums_from + (sounds.has_drums ? own_voices : 0);
        pitched += is_drums_alone ? 0 : own_voices + melody.accompanying_voices();
        if (voices > most_voices)
            throw ScoreError(fmt::format("too many voices: a score has at most {}", most_voices));
        if (!is_drums_alone) head.parts.push_back(part);
        if (melody.accompanying_voices() > 0) {
            part.has_chords = false;
            part.is_accompaniment = true;
            part.voices = melody.accompanying_voices();
            part.program = melody.harmony == Harmony::drone ? sitar : strings;
            part.name = instrument_of(part.program).name;
            part.has_instrument_name = true;
            head.parts.push_back(part);
        }
        if (sounds.has_drums)
            head.parts.push_back(drum_part(is_drums_alone ? player.name : "", own_voices, has_chords));
    }
    if (pitched > most) {
        throw ScoreError(
            fmt::format("too many voices: {} at once; {} need a MIDI channel for each voice; there are {} besides "
                        "drums",
                        pitched,
                        ensemble.has_glides()  ? "glissandi"
                        : ensemble.has_bends() ? "gamakas"
                                               : "notes between the keys",
                        most_channels));
    }
    if (head.title.empty()) head.title = fmt::format("{}", fmt::join(titles, ", "));
    return head;
}

/// Voices that need MIDI channels of their own.
int pitched_voices(const ScoreHead& head) {
    int voices = 0;
    for (const Part& part : head.parts) voices += part.is_drums ? 0 : part.voices;
    return voices;
}

/// True if drums sound together on their channel.
bool has_drum_voices(const ScoreHead& head) {
    int voices = 0;
    for (const Part& part : head.parts) voices += part.is_drums ? part.voices : 0;
    return voices > 1;
}

/// Treatment of notes beyond the range of a melody, for a remark.
std::string_view fate_of(const Melody& melody) {
    const double period = std::fabs(melody.scale.period) / 100;
    if (melody.range == Range::reflect) return "reflected";
    // A range narrower than a period has no other octave for most notes.
    return melody.range == Range::fold && period <= melody.highest - melody.lowest ? "folded back"
                                                                                   : "held at the last key";
}

/// Adds a remark for each range that notes lay beyond.
void report_moved(const Ensemble& ensemble, const PlayOptions& playing, const EnsembleReport& report, Made& made) {
    struct Moved {
        const Melody* melody;
        std::uint64_t notes;
        std::vector<std::string_view> instruments;
        bool is_anchored;  // by the first note of the whole melody
    };
    std::vector<Moved> ranges;
    for (std::size_t i = 0; i < report.moved_of.size(); ++i) {
        if (report.moved_of[i] == 0) continue;
        const Melody& melody = ensemble.players[i].melody;
        const auto is_same = [&](const Moved& one) {
            return one.melody->lowest == melody.lowest && one.melody->highest == melody.highest &&
                   fate_of(*one.melody) == fate_of(melody);
        };
        auto known = std::find_if(ranges.begin(), ranges.end(), is_same);
        if (known == ranges.end()) known = ranges.insert(known, {&melody, 0, {}, false});
        known->notes += report.moved_of[i];
        known->is_anchored = known->is_anchored || melody.anchor != Anchor::piece;
        const std::string_view name = instrument_of(melody.program).name;
        auto& names = known->instruments;
        if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
    }
    for (const Moved& one : ranges) {
        const auto spelling = spell(one.melody->scale, one.melody->tonic_spelling);
        made.warn(fmt::format(
            "{}{} {} beyond {} to {} and {}{}", counted(one.notes, "note"),
            ranges.size() > 1 ? fmt::format(" of {}", fmt::join(one.instruments, ", ")) : "",
            one.notes == 1 ? "was" : "were", note_name(one.melody->lowest, spelling),
            note_name(one.melody->highest, spelling), fate_of(*one.melody),
            playing.from > 0 && one.is_anchored ? "; with `anchor: piece` the piece begins on the tonic" : ""));
    }
}

void report_notes(const Ensemble& ensemble, const PlayOptions& playing, const EnsembleReport& report, Made& made) {
    const Melody& first = ensemble.players.front().melody;
    made.fact(fmt::format("{}, {}, {}, {}", counted(report.notes, "note"),
                          counted(bars_of(report.end, ensemble.meter).str(), "bar"),
                          report.seconds > 0 ? time_text(report.seconds) : time_of(report.end, ensemble.tempo),
                          range_of(report, first)));
    if (report.is_strict) {
        made.fact(fmt::format("counterpoint: {} moved, {} left before endings",
                              counted(report.counterpoint.moved, "note"),
                              counted(report.counterpoint.left, "fault")));
    }
    report_moved(ensemble, playing, report, made);
    if (report.lost > 0) {
        made.warn(counted(report.lost, "note") + " too short for a tick, or without a key, left out");
    }
    if (!report.skipped.empty()) made.fact("skipped: " + skipped_text(report.skipped));
    for (const std::string& symbol : report.unused) {
        made.warn(fmt::format("the pattern does not contain the symbol '{}' of the table{}", printable(symbol),
                              symbol.size() > 1 ? "; names are listed under `symbols:`" : ""));
    }
    for (const Player& player : ensemble.players) {
        const Melody& melody = player.melody;
        if (player.is_bass || player.is_follower) continue;
        const bool has_meter = melody.meter.beats == ensemble.meter.beats && melody.meter.unit == ensemble.meter.unit;
        if (melody.tempo != ensemble.tempo || (!has_meter && !player.document.has_override("meter"))) {
            made.warn(printable(player.document.text("title")) +
                      " is played in the tempo and meter of the first pattern");
        }
    }
}

/// Suggests a key with which notes would begin and end on note values; empty if none is known.
std::string_view remedy_for_moved(const Ensemble& ensemble) {
    for (const Player& player : ensemble.players) {
        const Melody& melody = player.melody;
        Note step;
        step.duration = melody.unit;
        const Grid grid = grid_of(std::span(&step, 1), ensemble.meter);
        if (grid.nearest(melody.unit) != melody.unit) return "; another `unit` such as 1/8 keeps the rhythm";
        int first = 0;
        const bool is_on_square_grid = is_on_grid(make_lattice(player.document.grammar()), first);
        if (melody.mapping == Mapping::runs && melody.rhythm.empty() && !is_on_square_grid) {
            return "; the curve leaves the square grid, where `rhythm: x` makes each step last one unit";
        }
    }
    return {};
}

void report_notation(const Notation& notation, const Ensemble& ensemble, Made& made) {
    if (notation.moved > 0) {
        const bool is_one = notation.moved == 1;
        made.warn(
            fmt::format("{} not begin or end at a 64th or in a tuplet of 3, 5, 6, 10 or 12 and {} written at the "
                        "nearest 64th{}",
                        is_one ? "1 note does" : counted(notation.moved, "note") + " do", is_one ? "is" : "are",
                        remedy_for_moved(ensemble)));
    }
    if (notation.merged > 0) {
        made.fact(fmt::format("{} in unison with other voices printed once", counted(notation.merged, "note")));
    }
    if (notation.bent > 0) {
        made.warn(fmt::format("{} written as the nearest quarter tone, with the difference in cents",
                              notation.bent == 1 ? "1 note is" : counted(notation.bent, "note") + " are"));
    }
}

/// True for scores of note values, which leave performance to the player.
bool is_printed(ScoreFormat format) {
    switch (format) {
        case ScoreFormat::musicxml:
        case ScoreFormat::mxl:
        case ScoreFormat::lilypond:
        case ScoreFormat::pdf:
        case ScoreFormat::abc:
        case ScoreFormat::strudel:
            return true;
        default:
            return false;
    }
}

/// A planned score.
class ScoreWork : public Work {
public:
    /// @throws SettingError, PatternError; std::runtime_error if a file that a pattern names cannot be read
    ScoreWork(const Document& document, ScoreFormat format, PlaySettings settings,
              const std::filesystem::path& folder)
        : format_(format), settings_(std::move(settings)), folder_(folder) {
        add(document, 0, "");
        complete();
    }
    ScoreWork(Arrangement arrangement, ScoreFormat format, PlaySettings settings, const std::filesystem::path& folder)
        : format_(format), settings_(std::move(settings)), folder_(folder), arrangement_(std::move(arrangement)) {
        for (const Track& track : arrangement_->tracks) add(track.document, track.section, track.name);
        ensemble_.form = arrangement_->form;
        complete();
    }

    Cost forecast() const override;
    std::vector<std::pair<std::string, std::string>> read_files() const override { return files_; }
    Made make(Destination& destination, const std::filesystem::path& name, const Monitor& monitor,
              int threads) override;
    NoteList list(const Monitor& monitor) {
        const PlayOptions playing = piece_of(settings_, ensemble_, monitor);
        const ScoreHead head = make_head(playing, most_voices);  // numbers the voices of the parts
        NoteCollector collector(static_cast<std::size_t>(available_memory() / 4 / sizeof(Note)));
        play_into(collector, playing);
        NoteList result{collector.notes(), collector.end(), head.tempo, head.meter, head.parts};
        std::stable_sort(result.notes.begin(), result.notes.end(), [](const Note& a, const Note& b) {
            return std::tie(a.onset, a.voice) < std::tie(b.onset, b.voice);
        });
        return result;
    }
    std::unique_ptr<NoteStream> stream(const Monitor& monitor) {
        const PlayOptions playing = piece_of(settings_, ensemble_, monitor);
        StreamedScore score;
        const bool is_limited = midi_.microtonal && midi_.tuning != Tuning::mpe;
        score.head = make_head(playing, is_limited ? most_channels : most_voices);
        score.midi = midi_;
        score.midi.share_channels =
            !is_limited && midi_.tuning != Tuning::mpe && pitched_voices(score.head) > most_channels;
        if (score.midi.share_channels) channel_slots(score.head);  // refuses too many instruments
        score.humanise = settings_.humanise;
        score.seed = settings_.seed;
        return stream_notes(std::move(score), ensemble_, playing);
    }
    std::string describe(const Monitor& monitor) {
        const PlayOptions playing = piece_of(settings_, ensemble_, monitor);
        const bool is_arranged = arrangement_ || ensemble_.needs_whole();
        if (is_arranged) make_head(playing, most_voices);  // numbers the voices of the parts
        std::string text = description(ensemble_.players, playing,
                                       settings_.from_bar == 1 && settings_.bars == 0 && settings_.seconds == 0,
                                       [&](const Player& player) { return play_alone(player, playing); });
        if (!is_arranged) return text;
        NullSink nobody;
        Made made;
        const bool has_tempo = ensemble_.players.front().melody.expression.tempo.is_on();
        EnsembleReport report = has_tempo ? play_into(nobody, playing) : play_all(ensemble_, playing, nobody);
        if (!has_tempo) report.seconds = seconds_of(report.end, {});
        report_notes(ensemble_, playing, report, made);
        report_replaced(made);
        // A single part is described already, unless its tempo changes.
        const bool is_alone = !arrangement_ && ensemble_.players.size() == 1 && !has_tempo;
        if (!is_alone) text += "together\n";
        for (auto remark = made.remarks.begin() + (is_alone ? 1 : 0); remark != made.remarks.end(); ++remark) {
            text += remark->text + "\n";
        }
        return text;
    }

private:
    /// Warns of options that this format cannot express.
    void warn_of_unused(Made& made) const {
        const auto warn = [&](const std::string& option, const char* reason) { made.warn_of_unused(option, reason); };
        if (settings_.format != 1 && format_ != ScoreFormat::midi)
            warn("midi-format", "it applies only to MIDI files");
        if (settings_.tuning != Tuning::bend && !is_midi()) warn("tuning", "it applies only to MIDI and sound");
        if (settings_.humanise > 0 && is_printed(format_) && format_ != ScoreFormat::strudel) {
            warn("humanise", "printed scores are exact");
        }
        for (const Setting& key : settings_.keys) {
            if (!is_printed(format_)) break;
            if (key.key == "pan" || key.key == "controller") warn(key.key, "it is heard, not printed");
            if (key.key == "gamaka") warn(key.key, "gamakas are heard, not printed");
            if (key.key == "swing") warn(key.key, "eighths are printed straight");
        }
    }
    /// Reports keys of the piece that replace those of patterns within it.
    void report_replaced(Made& made) const {
        if (!arrangement_) return;
        for (const std::string& remark : arrangement_->remarks) made.fact(remark);
    }
    PlayReport play_alone(const Player& player, const PlayOptions& playing) const {
        Ensemble alone;
        alone.players = {player};
        alone.tempo = player.melody.tempo;
        alone.meter = player.melody.meter;
        if (ensemble_.players.size() == 1) alone.close = ensemble_.close;
        Player& part = alone.players.front();
        part.section = 0;
        part.first_voice = 0;
        part.melody.layout.start = 0;
        NullSink nobody;
        return play_parts(alone, playing, nobody);
    }

    void add(const Document& document, char section, const std::string& part_name) {
        const auto witness = [this](const std::string& name, const std::string& text) {
            files_.emplace_back(name, text);
        };
        Player player = read_player(settings_, document, folder_, witness);
        Melody& melody = player.melody;
        player.section = section;
        player.name = part_name;
        if (is_printed(format_)) {
            melody.swing = 0.5;
            melody.articulation = Articulation::legato;
        }
        // MusicXML cannot represent the lowest octave of MIDI.
        if (format_ == ScoreFormat::musicxml || format_ == ScoreFormat::mxl) {
            melody.lowest = std::max(melody.lowest, lowest_in_musicxml);
        }
        std::vector<Player>& players = ensemble_.players;
        players.push_back(player);
        if (melody.harmony == Harmony::bass) players.push_back(bass_of(player));
        for (Player& follower : followers_of(player)) players.push_back(std::move(follower));
    }

    /// Tempo and meter are those of the first player, unless the arrangement or an option sets them.
    void complete() {
        const Melody& first = ensemble_.players.front().melody;
        const auto is_option = [&](std::string_view key) {
            return std::any_of(settings_.keys.begin(), settings_.keys.end(),
                               [&](const Setting& setting) { return setting.key == key; });
        };
        ensemble_.tempo = first.tempo;
        ensemble_.meter = first.meter;
        ensemble_.close = first.close;
        if (arrangement_ && arrangement_->tempo && !is_option("tempo")) ensemble_.tempo = *arrangement_->tempo;
        if (arrangement_ && arrangement_->meter && !is_option("meter")) ensemble_.meter = *arrangement_->meter;
        for (const Player& player : ensemble_.players) {
            midi_.microtonal = midi_.microtonal || player.melody.is_microtonal();
        }
        if (ensemble_.has_bends() && !is_printed(format_)) {
            if (settings_.tuning == Tuning::mts) {
                throw SettingError("tuning", "mts", "gamakas are pitch bends; expected bend or mpe");
            }
            midi_.microtonal = true;
            midi_.bend_range = widest_bend;
        }
        if (ensemble_.has_glides() && !is_printed(format_)) {
            if (settings_.tuning == Tuning::mts) {
                throw SettingError("tuning", "mts", "glissandi are pitch bends; expected bend or mpe");
            }
            midi_.microtonal = true;
            midi_.bend_range = glide_bend_range;
        }
        midi_.format = settings_.format;
        midi_.tuning = settings_.tuning;
    }

    ScoreHead make_head(const PlayOptions& playing, int most) {
        return head_of(settings_, ensemble_, arrangement_ ? &*arrangement_ : nullptr, playing, most);
    }

    /// True for MIDI files and for sound, which is rendered from them.
    bool is_midi() const {
        return format_ == ScoreFormat::midi || format_ == ScoreFormat::wav || format_ == ScoreFormat::flac;
    }
    void check_size(const PlayOptions& playing) const;
    void write(const ScoreHead& head, const PlayOptions& playing, Output& output, Made& made);
    void write_notation(const Notation& notation, const ScoreHead& head, Output& output) const;
    /// @return peak level
    double write_sound(const ScoreHead& head, const PlayOptions& playing, Output& output, EnsembleReport& report);
    EnsembleReport write_midi_file(const ScoreHead& head, const PlayOptions& playing, Output& output) const {
        const auto writer = write_midi(head, output, midi_);
        if (!midi_.share_channels && !has_drum_voices(head)) return play_into(*writer, playing);
        UnisonMerger merger(*writer, head, static_cast<std::size_t>(available_memory() / 4 / sizeof(Note)),
                            midi_.share_channels);
        return play_into(merger, playing);
    }
    EnsembleReport play_into(NoteSink& sink, const PlayOptions& playing) const {
        Humaniser human(sink, settings_.humanise, settings_.seed, playing.from);
        return express_into(settings_.humanise > 0 ? static_cast<NoteSink&>(human) : sink, playing);
    }
    EnsembleReport express_into(NoteSink& sink, const PlayOptions& playing) const {
        Curves curves;
        EnsembleReport report;
        if (ensemble_.has_expression()) {
            ExpressionSink expressive(
                ensemble_, is_printed(format_) ? ExpressionSink::Use::print : ExpressionSink::Use::performance);
            expressive.fold_ranges(playing);
            if (expressive.needs_ranges()) play_all(ensemble_, playing, expressive);
            expressive.write_to(sink);
            report = play_all(ensemble_, playing, expressive);
            curves.tempo = expressive.tempo();
        } else {
            report = play_all(ensemble_, playing, sink);
        }
        report.seconds = seconds_of(report.end, curves);
        return report;
    }
    /// Seconds until a tick, with all changes of tempo.
    double seconds_of(std::int64_t end, const Curves& curves) const {
        ScoreHead times;
        times.ritardando = ensemble_.close != Close::none && !is_printed(format_) ? 2 * ensemble_.meter.bar() : 0;
        return seconds_at(end, ensemble_.tempo, tempo_map(times, curves, end));
    }

    ScoreFormat format_;
    PlaySettings settings_;
    std::filesystem::path folder_;
    std::optional<Arrangement> arrangement_;  // unless a single pattern is played
    Ensemble ensemble_;
    std::vector<std::pair<std::string, std::string>> files_;
    MidiOptions midi_;
    Monitor monitor_;
    std::filesystem::path name_;  // name of the output, for messages
};

/// @throws BudgetError for more notes than a MIDI file can contain
void ScoreWork::check_size(const PlayOptions& playing) const {
    if (!is_midi() || playing.to < INT64_MAX) return;
    for (const Player& player : ensemble_.players) {
        if (player.melody.layout.bars > 0) continue;
        const auto known = census(player.document.grammar(), player.melody);
        if (known && known->notes > 0xFFFFFFFF / 8) {
            throw BudgetError(
                fmt::format("{} notes would exceed the limit of MIDI files, 4 GiB; limit the "
                            "bars or seconds",
                            readable(known->notes.str())));
        }
    }
}

double ScoreWork::write_sound(const ScoreHead& head, const PlayOptions& playing, Output& output,
                              EnsembleReport& report) {
    OutputFile score(output.temporary().string() + ".mid", name_);  // never committed
    report = write_midi_file(head, playing, score);
    const double seconds = static_cast<double>(report.end) / static_cast<double>(ticks_per_quarter) * 60 / head.tempo;
    if (seconds > most_audio_seconds) {
        throw ScoreError(
            fmt::format("{} of sound are too long: a WAV file can contain 6 hours 45 minutes; limit the bars or "
                        "seconds",
                        time_text(seconds)));
    }
    return render_audio(
        score.temporary(), output.temporary(), format_ == ScoreFormat::wav ? AudioFormat::wav : AudioFormat::flac,
        [this](double) { monitor_.check(); }, name_);
}

void ScoreWork::write_notation(const Notation& notation, const ScoreHead& head, Output& output) const {
    MemoryOutput whole;
    switch (format_) {
        case ScoreFormat::mxl:
            write_musicxml(notation, head, whole);
            write_mxl(whole.bytes(), output);
            break;
        case ScoreFormat::pdf:
            write_lilypond(notation, head, whole);
            engrave(whole.bytes(), head, output.temporary(), name_, [this] { monitor_.check(); });
            break;
        case ScoreFormat::abc:
            write_abc(notation, head, output);
            break;
        case ScoreFormat::lilypond:
            write_lilypond(notation, head, output);
            break;
        default:
            write_musicxml(notation, head, output);
    }
}

void ScoreWork::write(const ScoreHead& head, const PlayOptions& playing, Output& output, Made& made) {
    EnsembleReport report;
    std::optional<Notation> notation;
    bool is_silent = false;
    switch (format_) {
        case ScoreFormat::midi: {
            report = write_midi_file(head, playing, output);
            break;
        }
        case ScoreFormat::musicxml:
        case ScoreFormat::mxl:
        case ScoreFormat::lilypond:
        case ScoreFormat::pdf:
        case ScoreFormat::abc: {
            Notator notator(head);
            report = express_into(notator, playing);  // never humanised
            notation = notator.notation();
            write_notation(*notation, head, output);
            break;
        }
        case ScoreFormat::csd:
        case ScoreFormat::sco:
        case ScoreFormat::strudel:
        case ScoreFormat::svg:
        case ScoreFormat::html: {
            NoteCollector collector;
            report = play_into(collector, playing);
            const std::vector<Note>& notes = collector.notes();
            if (format_ == ScoreFormat::csd)
                write_csound_file(head, notes, collector.end(), output, collector.curves());
            if (format_ == ScoreFormat::sco)
                write_csound_score(head, notes, collector.end(), output, collector.curves());
            if (format_ == ScoreFormat::strudel) {
                write_strudel(head, notes, collector.end(), output);
                if (ensemble_.has_glides()) {
                    made.warn("the notes of Strudel do not slide: glissandi are held at the pitch they begin with");
                }
            }
            if (format_ == ScoreFormat::svg) write_music_svg(head, notes, collector.end(), output);
            if (format_ == ScoreFormat::html)
                write_music_page(head, notes, collector.end(), output, collector.curves());
            break;
        }
        case ScoreFormat::wav:
        case ScoreFormat::flac:
            is_silent = write_sound(head, playing, output, report) == 0;
            break;
    }
    report_notes(ensemble_, playing, report, made);
    report_replaced(made);
    if (notation) report_notation(*notation, ensemble_, made);
    const bool is_commented = format_ == ScoreFormat::abc || format_ == ScoreFormat::lilypond ||
                              format_ == ScoreFormat::csd || format_ == ScoreFormat::sco ||
                              format_ == ScoreFormat::strudel;
    if (is_commented && !comments_keep(head.pattern)) {
        made.warn(
            "the comments of the score hold the pattern with blanks or '?' for its control characters and marks of "
            "direction");
    }
    const bool is_xml =
        format_ == ScoreFormat::musicxml || format_ == ScoreFormat::mxl || format_ == ScoreFormat::html;
    if (is_xml && !fits_xml(head.pattern)) {
        made.warn("the score holds the pattern with U+FFFD for its control characters, which XML cannot hold");
    }
    if (is_silent) made.warn("the sound is silent: the soundfont has no sound for these keys of this instrument");
}

Made ScoreWork::make(Destination& destination, const std::filesystem::path& name, const Monitor& monitor,
                     int /*threads*/) {
    Made made;
    for (const Player& player : ensemble_.players) {
        for (const std::string& warning : player.warnings) made.warn(warning);
    }
    warn_of_unused(made);
    monitor_ = monitor;
    name_ = name;
    const PlayOptions playing = piece_of(settings_, ensemble_, monitor);
    monitor.expect(0);
    check_size(playing);
    const bool is_mpe = midi_.tuning == Tuning::mpe;
    const bool is_limited = is_midi() && midi_.microtonal && !is_mpe;
    const ScoreHead head = make_head(playing, is_limited ? most_channels : most_voices);
    midi_.share_channels = !midi_.microtonal && !is_mpe && pitched_voices(head) > most_channels;
    if (is_midi() && !is_mpe) {
        const auto names = parts_controlled_together(ensemble_, head, midi_.share_channels);
        if (!names.empty()) {
            made.warn(fmt::format("voices of {} share MIDI channels, and with them pan and controllers{}",
                                  fmt::join(names, ", "),
                                  midi_.share_channels ? "; 'tuning' mpe gives each note a channel" : ""));
        }
    }
    const auto output = destination.open(name);
    if (output->can_insert()) {
        write(head, playing, *output, made);
    } else {
        if (format_ == ScoreFormat::wav || format_ == ScoreFormat::flac || format_ == ScoreFormat::pdf) {
            throw std::runtime_error(
                fmt::format("cannot write '{}': {} a regular file", name.string(),
                            format_ == ScoreFormat::pdf ? "a printed score needs" : "sound needs"));
        }
        // Writers of sound seek to the beginning, which pipes do not support.
        MemoryOutput whole;
        write(head, playing, whole, made);
        output->write(whole.bytes());
    }
    output->commit();
    return made;
}

namespace {

/// Seconds of processor time, bytes and bytes of memory of a score in a format, and of each of its notes.
struct ScoreFormatCost {
    double seconds, bytes, memory;
    double note_seconds, note_bytes, note_memory;
};
ScoreFormatCost cost_of(ScoreFormat format) {
    switch (format) {
        case ScoreFormat::midi:
            return {0, 600, 1e6, 80e-9, 9, 0};
        case ScoreFormat::wav:
        case ScoreFormat::flac:
            return {1, 600, 60e6, 2e-3, 44'100, 0};
        case ScoreFormat::pdf:
            return {2, 10'000, 120e6, 2e-3, 300, 20'000};
        case ScoreFormat::mxl:
            return {0.001, 1000, 2e6, 2.5e-6, 12, 110};
        case ScoreFormat::musicxml:
        case ScoreFormat::lilypond:
        case ScoreFormat::abc:
        case ScoreFormat::csd:
        case ScoreFormat::sco:
        case ScoreFormat::strudel:
        case ScoreFormat::svg:
        case ScoreFormat::html:
            break;
    }
    return {0.001, 1000, 2e6, 0.5e-6, 120, 110};
}

}  // namespace

Cost ScoreWork::forecast() const {
    constexpr double program_seconds = 0.003, program_memory = 7e6;
    constexpr double node_seconds = 15e-9, player_memory = 0.5e6;
    constexpr double nodes_read = 50'000;  // limit, for words whose length only a derivation determines
    const ScoreFormatCost each = cost_of(format_);
    Cost result;
    result.seconds = result.shared_seconds = program_seconds;
    result.memory = result.shared_memory = program_memory;
    result.seconds += each.seconds;
    result.bytes = each.bytes;
    result.memory += each.memory;
    for (const Player& player : ensemble_.players) {
        const Grammar& grammar = player.document.grammar();
        const WordSize size = word_size(shorten(grammar), nodes_read);
        result.is_doubtful |= size.nodes > settings_.budget && settings_.bars == 0 && settings_.seconds == 0;
        double nodes = std::min(size.nodes, settings_.budget);
        double notes = std::min(size.drawn, nodes);
        if (settings_.bars > 0 || settings_.seconds > 0) {
            nodes = notes = std::min(
                notes, std::max(10'000.0, 64.0 * static_cast<double>(settings_.bars) + 32 * settings_.seconds));
        }
        result.seconds +=
            nodes * node_seconds + notes * each.note_seconds + matching_seconds(grammar, settings_.budget);
        result.bytes += notes * each.note_bytes;
        result.memory += player_memory + notes * each.note_memory;
    }
    return result;
}

/// @throws SettingError
ScoreFormat known(std::string_view format) {
    for (const ScoreFormatInfo& row : format_table) {
        if (find_format(std::span(&row.name, 1), format)) return row.format;
    }
    refuse_option("format", std::string(format), "unknown format");
}

/// Plans a single document, or an arrangement of several.
ScoreWork work_of(std::span<const Document> documents, ScoreFormat format, const OptionValues& values,
                  const std::filesystem::path& folder) {
    if (documents.size() == 1) return {documents.front(), format, read_play_settings(values), folder};
    return {arrangement_of(documents), format, read_play_settings(values), folder};
}

class Scores : public Interpreter {
public:
    Scores() {
        for (const ScoreFormatInfo& row : format_table) formats_.push_back(row.name);
        for (const Option<PlaySettings>& row : play_options()) options_.push_back(&row.info);
    }
    KeyOwner owner() const override { return KeyOwner::music; }
    void check_keys(const Pattern& pattern, Diagnostics& diagnostics) const override {
        read_melody(pattern, {}, diagnostics);
    }
    void check_grammar(const Pattern& pattern, const Grammar& grammar, Diagnostics& diagnostics) const override {
        check_phrases(pattern, grammar, diagnostics);
    }
    std::span<const FormatName> formats() const override { return formats_; }
    std::span<const OptionInfo* const> options() const override { return options_; }
    void check(std::string_view format, const OptionValues& values) const override {
        known(format);
        read_play_settings(values);
    }
    std::unique_ptr<Work> plan(const Document& document, std::string_view format, const OptionValues& values,
                               const std::filesystem::path& folder) const override {
        return plan_score(std::span(&document, 1), format, values, folder);
    }

private:
    std::vector<FormatName> formats_;
    std::vector<const OptionInfo*> options_;
};

}  // namespace

const Interpreter& scores() {
    static const Scores interpreter;
    return interpreter;
}

std::unique_ptr<Work> plan_score(std::span<const Document> documents, std::string_view format,
                                 const OptionValues& values, const std::filesystem::path& folder) {
    return std::make_unique<ScoreWork>(work_of(documents, known(format), values, folder));
}

std::unique_ptr<Work> plan_score(const Arrangement& arrangement, std::string_view format, const OptionValues& values,
                                 const std::filesystem::path& folder) {
    return std::make_unique<ScoreWork>(arrangement, known(format), read_play_settings(values), folder);
}

NoteList list_notes(std::span<const Document> documents, const OptionValues& values, const Monitor& monitor) {
    return work_of(documents, ScoreFormat::midi, values, {}).list(monitor);
}

NoteList list_notes(const Arrangement& arrangement, const OptionValues& values, const Monitor& monitor) {
    return ScoreWork(arrangement, ScoreFormat::midi, read_play_settings(values), {}).list(monitor);
}

std::unique_ptr<NoteStream> stream_notes(std::span<const Document> documents, const OptionValues& values,
                                         const Monitor& monitor, const std::filesystem::path& folder) {
    return work_of(documents, ScoreFormat::midi, values, folder).stream(monitor);
}

std::unique_ptr<NoteStream> stream_notes(const Arrangement& arrangement, const OptionValues& values,
                                         const Monitor& monitor, const std::filesystem::path& folder) {
    return ScoreWork(arrangement, ScoreFormat::midi, read_play_settings(values), folder).stream(monitor);
}

std::string describe_score(std::span<const Document> documents, const OptionValues& values, const Monitor& monitor) {
    return work_of(documents, ScoreFormat::midi, values, {}).describe(monitor);
}

std::string describe_score(const Arrangement& arrangement, const OptionValues& values, const Monitor& monitor,
                           const std::filesystem::path& folder) {
    return ScoreWork(arrangement, ScoreFormat::midi, read_play_settings(values), folder).describe(monitor);
}

std::string play(const Document& document, std::string_view format, const OptionValues& values,
                 const Monitor& monitor) {
    return make_in_memory(scores(), document, format, values, monitor);
}

}  // namespace sikku
