#include "music/scores.h"

#include "engine/base/memory.h"
#include "engine/base/text.h"
#include "engine/derivation/forecast.h"
#include "engine/derivation/word_size.h"
#include "music/arrangement.h"
#include "music/melody/melody.h"
#include "music/note_stream.h"
#include "music/play_settings.h"
#include "music/players.h"
#include "music/score/comments.h"
#include "music/score/glides.h"
#include "music/score/note_order.h"
#include "music/score/player_parts.h"
#include "music/score_head.h"
#include "music/score_remarks.h"
#include "music/score_writers.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

namespace sikku {
namespace {

constexpr int widest_bend = 12;  // semitones, for gamakas

using Outputs = std::vector<std::unique_ptr<Output>>;

/// A planned score.
class ScoreWork : public Work {
public:
    /// @throws SettingError, PatternError; std::runtime_error if a file that a pattern names cannot be read
    ScoreWork(const Document& document, const ScoreWriter& writer, PlaySettings settings,
              const std::filesystem::path& folder)
        : writer_(writer), settings_(std::move(settings)), folder_(folder) {
        add(document, 0, "");
        complete();
    }
    ScoreWork(Arrangement arrangement, const ScoreWriter& writer, PlaySettings settings,
              const std::filesystem::path& folder)
        : writer_(writer), settings_(std::move(settings)), folder_(folder), arrangement_(std::move(arrangement)) {
        for (const Track& track : arrangement_->tracks) add(track.document, track.section, track.name);
        ensemble_.form = arrangement_->form;
        complete();
    }

    Cost forecast() const override;
    std::vector<std::pair<std::string, std::string>> read_files() const override { return files_; }
    Made make(Destination& destination, const std::filesystem::path& name, const Monitor& monitor,
              int threads) override;
    NoteList list(const Monitor& monitor) {
        const PlayOptions playing = begin(monitor);
        const ScoreHead head = make_head(playing, most_voices);  // numbers the voices of the parts
        NoteCollector collector(static_cast<std::size_t>(available_memory() / 4 / sizeof(Note)));
        perform(ensemble_, playing, use(), human(), collector);
        NoteList result{collector.notes(), collector.end(), head.tempo, head.meter,
                        head.upbeat,       head.changes,    head.parts};
        sort_by_time(result.notes);
        return result;
    }
    std::unique_ptr<NoteStream> stream(const Monitor& monitor) {
        const PlayOptions playing = begin(monitor);
        StreamedScore score;
        const bool is_limited = midi_.microtonal && midi_.tuning != Tuning::mpe;
        score.head = make_head(playing, is_limited ? most_channels : most_voices);
        score.midi = midi_;
        score.midi.share_channels =
            !is_limited && midi_.tuning != Tuning::mpe && pitched_voices(score.head) > most_channels;
        if (score.midi.share_channels) channel_slots(score.head);  // refuses too many instruments
        score.human = human();
        return stream_notes(std::move(score), ensemble_, playing);
    }
    std::string describe(const Monitor& monitor) {
        const PlayOptions playing = begin(monitor);
        const bool is_arranged = arrangement_ || ensemble_.needs_whole();
        if (is_arranged) make_head(playing, most_voices);  // numbers the voices of the parts
        std::string text = description(ensemble_.players, playing,
                                       settings_.from_bar == 1 && settings_.bars == 0 && settings_.seconds == 0,
                                       [&](const Player& player) { return play_alone(player, playing); });
        if (!is_arranged) return text;
        NullSink nobody;
        Made made;
        const bool is_performed = ensemble_.players.front().melody.expression.tempo.is_on() ||
                                  ensemble_.is_strict() || playing.is_excerpt();
        EnsembleReport report =
            is_performed ? perform(ensemble_, playing, use(), human(), nobody) : play_all(ensemble_, playing, nobody);
        if (!is_performed) report.seconds = seconds_of(ensemble_, playing, report.end, use());
        report_notes(ensemble_, playing, report, made);
        report_replaced(made);
        // A single part is described already, unless its tempo changes.
        const bool is_alone = !arrangement_ && ensemble_.players.size() == 1 &&
                              !ensemble_.players.front().melody.expression.tempo.is_on();
        if (!is_alone) text += "together\n";
        for (auto remark = made.remarks.begin() + (is_alone ? 1 : 0); remark != made.remarks.end(); ++remark) {
            text += remark->text + "\n";
        }
        return text;
    }

private:
    /// Sets the sections, and the changes of tempo and meter, if they are needed. @return the requested piece
    PlayOptions begin(const Monitor& monitor, bool needs_keys = false) {
        const bool changes_key = needs_keys && !ensemble_.form.empty() && ensemble_.has_several_keys();
        if (!ensemble_.section_tempos.empty() || changes_key) {
            PlaySettings whole;
            whole.budget = settings_.budget;
            ensemble_.sections = section_starts(ensemble_, piece_of(whole, ensemble_, monitor));
            ensemble_.changes = section_changes(ensemble_);
        }
        return piece_of(settings_, ensemble_, monitor);
    }

    /// Warns of options that this format cannot express.
    void warn_of_unused(Made& made) const {
        const auto warn = [&](const std::string& option, const char* reason) { made.warn_of_unused(option, reason); };
        if (settings_.format != 1 && writer_.medium != ScoreMedium::midi) {
            warn("midi-format", "it applies only to MIDI files");
        }
        if (!settings_.is_transposed && writer_.medium != ScoreMedium::notation)
            warn("score", "it applies only to print");
        if (writer_.medium != ScoreMedium::notation) {
            if (settings_.syllables != Syllables::none) warn("syllables", "it applies only to print");
            if (settings_.has_chord_signs) warn("chord-symbols", "it applies only to print");
            if (settings_.has_graces) warn("grace-notes", "it applies only to print");
            if (settings_.has_repeats) warn("repeats", "it applies only to print");
        }
        if (settings_.has_parts && writer_.medium != ScoreMedium::notation) warn("parts", "it applies only to print");
        if (settings_.tuning != Tuning::bend && !writer_.has_channels()) {
            warn("tuning", "it applies only to MIDI and sound");
        }
        if (settings_.humanise > 0 && writer_.medium == ScoreMedium::notation) {
            warn("humanise", "printed scores are exact");
        }
        for (const Setting& key : settings_.keys) {
            if (!writer_.is_printed) break;
            if (key.key == "pan" || key.key == "controller") warn(key.key, "it is heard, not printed");
            if (key.key == "gamaka" && !settings_.has_graces)
                warn(key.key, "gamakas are heard, not printed; 'grace-notes' prints kampitas and jarus");
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
        if (writer_.is_printed) {
            const Articulation touch = std::exchange(melody.articulation, Articulation::legato);
            player.printed_touch.sounding = touch == Articulation::detached ? melody.sounding : 1;
            player.printed_touch.is_by_depth = touch == Articulation::by_depth;
            player.printed_touch.has_phrases = melody.phrase_order > 0;
        }
        if (writer_.is_printed && !writer_.plays_swing) {
            player.printed_swing = {std::exchange(melody.swing, 0.5), melody.swing_unit};
        }
        melody.lowest = std::max(melody.lowest, writer_.lowest);
        std::vector<Player>& players = ensemble_.players;
        players.push_back(player);
        if (melody.harmony == Harmony::bass) players.push_back(bass_of(player));
        for (Player& follower : followers_of(player)) players.push_back(std::move(follower));
    }

    /// An excerpt of the only part is an excerpt of the score. @throws ScoreError if the requested bars lie behind it
    void take_excerpt() {
        if (ensemble_.players.size() != 1 || ensemble_.needs_whole() || !has_excerpt(ensemble_.players.front()))
            return;
        Layout& layout = ensemble_.players.front().melody.layout;
        const std::int64_t before = settings_.from_bar - 1;
        if (before > INT64_MAX - layout.first_bar || (layout.bars > 0 && before >= layout.bars)) {
            const std::string end = layout.bars > 0 ? ": the excerpt has " + counted(layout.bars, "bar") : "";
            throw ScoreError("the requested bars contain no notes" + end);
        }
        // A pattern with both `excerpt` and `ending` means an excerpt that ends.
        const bool is_stated = !is_option("excerpt") && before == 0 && settings_.bars == 0 && settings_.seconds == 0;
        ensemble_.ends_excerpts = ensemble_.ends_excerpts || is_stated;
        settings_.from_bar += layout.first_bar - 1;
        if (layout.bars > 0) {
            const std::int64_t left = layout.bars - before;
            settings_.bars = settings_.bars > 0 ? std::min(settings_.bars, left) : left;
        }
        layout.first_bar = 1;
        layout.bars = 0;
    }
    bool is_option(std::string_view key) const {
        return std::any_of(settings_.keys.begin(), settings_.keys.end(),
                           [&](const Setting& setting) { return setting.key == key; });
    }

    /// Tempo and meter are those of the first player, unless the arrangement or an option sets them.
    void complete() {
        const Melody& first = ensemble_.players.front().melody;
        ensemble_.tempo = first.tempo;
        ensemble_.tempo_words = first.tempo_words;
        ensemble_.meter = first.meter;
        ensemble_.close = first.close;
        ensemble_.ends_excerpts = is_option("ending");
        take_excerpt();
        if (arrangement_ && arrangement_->tempo && !is_option("tempo")) {
            ensemble_.tempo = *arrangement_->tempo;
            ensemble_.tempo_words = arrangement_->tempo_words;
        }
        if (arrangement_ && arrangement_->meter && !is_option("meter")) ensemble_.meter = *arrangement_->meter;
        if (arrangement_) ensemble_.section_tempos = arrangement_->section_tempos;
        for (auto& [section, stated] : ensemble_.section_tempos) {
            if (is_option("tempo")) stated.tempo.reset();
            if (is_option("meter")) stated.meter.reset();
        }
        std::erase_if(ensemble_.section_tempos,
                      [](const auto& one) { return !one.second.tempo && !one.second.meter; });
        const bool has_upbeat = std::any_of(ensemble_.players.begin(), ensemble_.players.end(),
                                            [](const Player& player) { return player.melody.layout.opening() > 0; });
        if (has_upbeat && !ensemble_.section_tempos.empty()) {
            throw ScoreError("'upbeat:' cannot be combined with sections that state tempo or meter");
        }
        std::optional<char> first_section;
        if (!ensemble_.form.empty()) first_section = static_cast<char>('A' + ensemble_.form.front().letter);
        ensemble_.upbeat = upbeat_of(ensemble_.players, ensemble_.meter, first_section);
        if (ensemble_.upbeat >= ensemble_.meter.bar()) {
            throw ScoreError("the upbeat of a part must be shorter than a bar of the score");
        }
        ensemble_.piece = ensemble_.tempo_and_meter(0);
        if (first_section) {
            const TempoAndMeter opening = ensemble_.of_section(*first_section);
            ensemble_.tempo = opening.tempo;
            ensemble_.tempo_words = opening.tempo_words;
            ensemble_.meter = opening.meter;
        }
        for (const Player& player : ensemble_.players) {
            midi_.microtonal = midi_.microtonal || player.melody.is_microtonal();
        }
        const auto bend = [&](std::string_view what, int range) {
            if (settings_.tuning == Tuning::mts) {
                throw SettingError("tuning", "mts", fmt::format("{} are pitch bends; expected bend or mpe", what));
            }
            midi_.microtonal = true;
            midi_.bend_range = range;
        };
        if (ensemble_.has_bends() && !writer_.is_printed) bend("gamakas", widest_bend);
        if (ensemble_.has_glides() && !writer_.is_printed) bend("glissandi", glide_bend_range);
        midi_.format = settings_.format;
        midi_.tuning = settings_.tuning;
    }

    ScoreHead make_head(const PlayOptions& playing, int most) {
        ScoreHead head = head_of(settings_, ensemble_, arrangement_ ? &*arrangement_ : nullptr, playing, most);
        if (settings_.has_repeats) head.most_repeats = writer_.most_repeats;
        return head;
    }

    ExpressionSink::Use use() const {
        return writer_.is_printed ? ExpressionSink::Use::print : ExpressionSink::Use::performance;
    }
    Human human() const { return {settings_.humanise, settings_.seed}; }
    void check_size(const PlayOptions& playing) const;
    void report(const Rendition& rendition, Made& made) const;
    void report_marks(const Notation& notation, Made& made) const;
    void write(Rendition& rendition, Output& output) const;
    Outputs write_parts(Destination& destination, const Rendition& rendition, Made& made) const;

    const ScoreWriter& writer_;
    PlaySettings settings_;
    std::filesystem::path folder_;
    std::optional<Arrangement> arrangement_;  // unless a single pattern is played
    Ensemble ensemble_;
    std::vector<std::pair<std::string, std::string>> files_;
    MidiOptions midi_;
};

/// @throws BudgetError for more notes than a MIDI file can contain
void ScoreWork::check_size(const PlayOptions& playing) const {
    if (!writer_.has_channels() || playing.to < INT64_MAX) return;
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

/// Reports repeats, and missing chord symbols and syllables.
void ScoreWork::report_marks(const Notation& notation, Made& made) const {
    const bool has_chords = std::any_of(notation.parts.begin(), notation.parts.end(),
                                        [](const NotatedPart& part) { return !part.chords.empty(); });
    if (settings_.has_chord_signs && !has_chords) {
        made.warn_of_unused("chord-symbols", "no chord of the score has a name");
    } else if (notation.nameless_chords > 0) {
        made.warn(fmt::format(
            "{} no name, and a dash above the staff",
            notation.nameless_chords == 1 ? "1 chord has" : counted(notation.nameless_chords, "chord") + " have"));
    }
    if (settings_.has_repeats && notation.repeats.empty()) {
        made.warn_of_unused("repeats", "no passage of four bars or more is played twice in a row");
    } else if (settings_.has_repeats) {
        made.fact(fmt::format("{} printed as {}: {}", counted(notation.played_bars(), "bar"), notation.bars,
                              counted(notation.repeats.size(), "repeat")));
    }
    bool has_syllables = false;
    bool has_graces = false;
    each_symbol(notation, [&](const NotatedSymbol& symbol) {
        has_syllables = has_syllables || !symbol.syllable.empty();
        has_graces = has_graces || symbol.grace;
    });
    if (settings_.has_graces && !has_graces) made.warn_of_unused("grace-notes", "no note has a kampita or a jaru");
    if (settings_.syllables != Syllables::none && !has_syllables) {
        made.warn_of_unused("syllables", "no staff has a single voice with pitches");
    }
}

void ScoreWork::report(const Rendition& rendition, Made& made) const {
    if (!writer_.has_glides && ensemble_.has_glides()) {
        made.warn(fmt::format("the notes of {} do not slide: glissandi are held at the pitch they begin with",
                              writer_.name.label));
    }
    report_notes(ensemble_, rendition.playing, rendition.report, made);
    report_replaced(made);
    if (rendition.notation) report_notation(*rendition.notation, ensemble_, made);
    if (rendition.notation) report_marks(*rendition.notation, made);
    if (rendition.notation && !settings_.is_transposed && !rendition.notation->is_concert) {
        made.warn_of_unused("score", "no part has a transposing instrument");
    }
    const std::string& pattern = rendition.head.pattern;
    if (writer_.pattern == PatternForm::comments && !comments_keep(pattern)) {
        made.warn(
            "the comments of the score hold the pattern with blanks or '?' for its control characters and marks of "
            "direction");
    }
    if (writer_.pattern == PatternForm::xml && !fits_xml(pattern)) {
        made.warn("the score holds the pattern with U+FFFD for its control characters, which XML cannot hold");
    }
    if (!rendition.warning.empty()) made.warn(rendition.warning);
}

/// Writes the score itself.
void ScoreWork::write(Rendition& rendition, Output& output) const {
    const auto put = [&](Output& to) {
        if (writer_.print) return writer_.print(rendition.print(), rendition, to);
        writer_.write(rendition, to);
    };
    if (output.can_insert()) return put(output);
    if (!writer_.needs_file.empty()) {
        throw std::runtime_error(
            fmt::format("cannot write '{}': {} a regular file", rendition.name.string(), writer_.needs_file));
    }
    // Writers seek to the beginning, which pipes do not support.
    MemoryOutput whole;
    put(whole);
    output.write(whole.bytes());
}

/// Writes a part for each player beside the score: `blues-1-tenor-sax.pdf`.
Outputs ScoreWork::write_parts(Destination& destination, const Rendition& rendition, Made& made) const {
    Outputs outputs;
    if (!settings_.has_parts || !rendition.notation) return outputs;
    const std::vector<PlayerPart> players = player_parts(*rendition.notation, writer_.has_cues);
    if (players.size() < 2) {
        made.warn_of_unused("parts", "the score has a single player");
        return outputs;
    }
    std::string names;
    for (std::size_t i = 0; i < players.size(); ++i) {
        const std::filesystem::path& whole = rendition.name;
        std::filesystem::path name = whole;
        name.replace_filename(fmt::format("{}-{}-{}{}", whole.stem().string(), i + 1, file_part(players[i].name),
                                          whole.extension().string()));
        outputs.push_back(destination.open(name));
        writer_.print(players[i].notation, rendition, *outputs.back());
        names += (i > 0 ? ", " : "") + name.filename().string();
    }
    made.fact(fmt::format("parts: {}", names));
    return outputs;
}

Made ScoreWork::make(Destination& destination, const std::filesystem::path& name, const Monitor& monitor,
                     int /*threads*/) {
    Made made;
    for (const Player& player : ensemble_.players) {
        for (const std::string& warning : player.warnings) made.warn(warning);
    }
    for (const Player& player : ensemble_.players) {
        const std::string no_steps = reason_of_no_steps(player.document);
        const std::string& pattern = player.document.source().name();
        if (!no_steps.empty())
            made.warn(ensemble_.players.size() > 1 ? fmt::format("{}: {}", pattern, no_steps) : no_steps);
    }
    warn_of_unused(made);
    const PlayOptions playing = begin(monitor, writer_.medium == ScoreMedium::midi);
    monitor.expect(0);
    check_size(playing);
    const bool is_mpe = midi_.tuning == Tuning::mpe;
    const bool is_limited = writer_.has_channels() && midi_.microtonal && !is_mpe;
    const ScoreHead head = make_head(playing, is_limited ? most_channels : most_voices);
    midi_.share_channels = !midi_.microtonal && !is_mpe && pitched_voices(head) > most_channels;
    if (writer_.has_channels() && !is_mpe) report_shared_channels(ensemble_, head, midi_.share_channels, made);
    Rendition rendition{ensemble_, playing, head, use(), human(), midi_, monitor, name, {}, {}, {}};
    const auto output = destination.open(name);
    if (settings_.has_parts && writer_.print && !output->can_insert()) {
        throw SettingError("parts", "", "parts are written beside the score, which needs a regular file");
    }
    write(rendition, *output);
    const Outputs parts = write_parts(destination, rendition, made);
    report(rendition, made);
    output->commit();
    for (const auto& part : parts) part->commit();
    return made;
}

Cost ScoreWork::forecast() const {
    constexpr double program_seconds = 0.003, program_memory = 7e6;
    constexpr double node_seconds = 15e-9, player_memory = 0.5e6;
    constexpr double nodes_read = 50'000;  // limit, for words whose length only a derivation determines
    ScoreCost each = writer_.cost;
    if (settings_.has_parts && writer_.print) {
        // Each note is written twice; LilyPond runs once for each player; a part may have several players.
        const auto files = static_cast<double>(1 + ensemble_.players.size());
        each.seconds *= files;
        each.bytes *= files;
        each.note_seconds *= 2;
        each.note_bytes *= 2;
    }
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

/// Plans a single document, or an arrangement of several.
ScoreWork work_of(std::span<const Document> documents, const ScoreWriter& writer, const OptionValues& values,
                  const std::filesystem::path& folder) {
    if (documents.size() == 1) return {documents.front(), writer, read_play_settings(values), folder};
    return {arrangement_of(documents), writer, read_play_settings(values), folder};
}

/// The format whose options the notes of lists and streams have.
const ScoreWriter& midi_writer() {
    return score_writers().front();
}

class Scores : public Interpreter {
public:
    Scores() {
        for (const ScoreWriter& row : score_writers()) formats_.push_back(row.name);
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
        score_writer(format);
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

ScoreExtensions score_extensions() {
    ScoreExtensions result;
    for (const bool is_ready : {true, false}) {
        for (const ScoreWriter& row : score_writers()) {
            if (is_ready != (row.medium == ScoreMedium::midi || !row.needs_file.empty())) continue;
            // Names with two parts are those of formats whose extension is that of a print, too.
            const bool is_shared = row.name.extension.find('.') != std::string_view::npos;
            (row.medium == ScoreMedium::sound  ? result.sounds
             : row.medium == ScoreMedium::view ? result.views
                                               : result.scores)
                .push_back(fmt::format(".{}", is_shared ? row.name.alias : row.name.extension));
        }
    }
    return result;
}

std::unique_ptr<Work> plan_score(std::span<const Document> documents, std::string_view format,
                                 const OptionValues& values, const std::filesystem::path& folder) {
    return std::make_unique<ScoreWork>(work_of(documents, score_writer(format), values, folder));
}

std::unique_ptr<Work> plan_score(const Arrangement& arrangement, std::string_view format, const OptionValues& values,
                                 const std::filesystem::path& folder) {
    return std::make_unique<ScoreWork>(arrangement, score_writer(format), read_play_settings(values), folder);
}

NoteList list_notes(std::span<const Document> documents, const OptionValues& values, const Monitor& monitor) {
    return work_of(documents, midi_writer(), values, {}).list(monitor);
}

NoteList list_notes(const Arrangement& arrangement, const OptionValues& values, const Monitor& monitor) {
    return ScoreWork(arrangement, midi_writer(), read_play_settings(values), {}).list(monitor);
}

std::unique_ptr<NoteStream> stream_notes(std::span<const Document> documents, const OptionValues& values,
                                         const Monitor& monitor, const std::filesystem::path& folder) {
    return work_of(documents, midi_writer(), values, folder).stream(monitor);
}

std::unique_ptr<NoteStream> stream_notes(const Arrangement& arrangement, const OptionValues& values,
                                         const Monitor& monitor, const std::filesystem::path& folder) {
    return ScoreWork(arrangement, midi_writer(), read_play_settings(values), folder).stream(monitor);
}

std::string describe_score(std::span<const Document> documents, const OptionValues& values, const Monitor& monitor) {
    return work_of(documents, midi_writer(), values, {}).describe(monitor);
}

std::string describe_score(const Arrangement& arrangement, const OptionValues& values, const Monitor& monitor,
                           const std::filesystem::path& folder) {
    return ScoreWork(arrangement, midi_writer(), read_play_settings(values), folder).describe(monitor);
}

std::string play(const Document& document, std::string_view format, const OptionValues& values,
                 const Monitor& monitor) {
    return make_in_memory(scores(), document, format, values, monitor);
}

}  // namespace sikku
