#include "music/scores.h"

#include "engine/base/chance.h"
#include "engine/base/input_file.h"
#include "engine/base/keys.h"
#include "engine/base/memory.h"
#include "engine/base/output_file.h"
#include "engine/base/text.h"
#include "engine/derivation/forecast.h"
#include "music/melody/mapping.h"
#include "music/melody/melody.h"
#include "music/play_settings.h"
#include "music/score/audio.h"
#include "music/score/lilypond.h"
#include "music/score/midi.h"
#include "music/score/music_page.h"
#include "music/score/musicxml.h"
#include "music/score/notation.h"
#include "music/score/spelling.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iterator>
#include <optional>
#include <tuple>

namespace sikku {
namespace {

enum class ScoreFormat { midi, musicxml, lilypond, wav, flac, svg, html };

constexpr int most_voices = 15;  // channels but the drums'

struct ScoreFormatInfo {
    FormatName name;
    ScoreFormat format;
};

/// The formats of scores. A drawn score is named `notes.svg`, because `svg` is a print.
constexpr std::array<ScoreFormatInfo, 7> format_table = {
    {{{"mid", "MIDI", "midi"}, ScoreFormat::midi},
     {{.extension = "musicxml", .label = "MusicXML", .alias = "xml", .is_text = true}, ScoreFormat::musicxml},
     {{.extension = "ly", .label = "LilyPond", .is_text = true}, ScoreFormat::lilypond},
     {{"wav", "sound"}, ScoreFormat::wav},
     {{"flac", "sound"}, ScoreFormat::flac},
     {{.extension = "notes.svg", .label = "the notes", .alias = "svg", .is_text = true}, ScoreFormat::svg},
     {{.extension = "html", .label = "play", .is_text = true}, ScoreFormat::html}}};

/// A pattern that is a part of the score.
struct Player {
    Document document;
    Melody melody;
    int first_voice = 0;
    std::vector<std::string> warnings;  ///< warnings about values of options
};

/// Hands the notes of one part on, as voices after those of the parts before it; the end waits for the last part.
class PartSink : public NoteSink {
public:
    PartSink(NoteSink& sink, int first_voice) : sink_(sink), first_voice_(first_voice) {}
    void notes(std::span<const Note> notes) override {
        if (first_voice_ == 0) return sink_.notes(notes);
        moved_.assign(notes.begin(), notes.end());
        for (Note& note : moved_) note.voice = static_cast<std::int16_t>(note.voice + first_voice_);
        sink_.notes(moved_);
    }
    void finish(std::int64_t) override {}

private:
    NoteSink& sink_;
    int first_voice_;
    std::vector<Note> moved_;
};

/// Notes begin a little late and are a little louder or softer, as a player's are; where they end stays.
class Humaniser : public NoteSink {
public:
    /// @param amount  0 to 1: of 60 ticks and of 24 steps of velocity
    /// @param from    ticks before the first: a piece from the middle sounds as it does in the whole, but for notes
    ///                that its edges cut
    Humaniser(NoteSink& sink, double amount, std::uint64_t seed, std::int64_t from)
        : sink_(sink), amount_(amount), seed_(seed), from_(from) {}
    void notes(std::span<const Note> notes) override {
        changed_.assign(notes.begin(), notes.end());
        for (Note& note : changed_) {
            const std::uint64_t chance = next(seed_ ^ next(static_cast<std::uint64_t>(from_ + note.onset) * 16 +
                                                           static_cast<std::uint64_t>(note.voice)));
            const double late = static_cast<double>(chance >> 40) / 0x1p24;
            const double loud = static_cast<double>(chance & 0xFFFFFF) / 0x1p24 - 0.5;
            const auto delay = std::min(static_cast<std::int64_t>(late * amount_ * 60), note.duration / 4);
            note.onset += delay;
            note.duration -= delay;
            note.velocity = static_cast<std::uint8_t>(
                std::clamp(static_cast<int>(note.velocity) + static_cast<int>(loud * amount_ * 24), 1, 127));
        }
        sink_.notes(changed_);
    }
    void finish(std::int64_t end) override { sink_.finish(end); }

private:
    /// Steele, Lea and Flood 2014: SplitMix64.
    static std::uint64_t next(std::uint64_t value) { return scrambled(value + 0x9E3779B97F4A7C15); }
    NoteSink& sink_;
    double amount_;
    std::uint64_t seed_;
    std::int64_t from_;
    std::vector<Note> changed_;
};

/// Only counts.
class Nobody : public NoteSink {
public:
    void notes(std::span<const Note>) override {}
    void finish(std::int64_t) override {}
};

/// @param first, then  folders where it is looked for
std::string read_small_file(const std::filesystem::path& first, const std::filesystem::path& then,
                            const std::string& name) {
    constexpr std::size_t most_bytes = std::size_t{1} << 20;
    std::error_code error;
    const bool is_there = std::filesystem::exists(first / name, error);
    const std::filesystem::path path = (is_there ? first : then) / name;
    if (std::filesystem::is_fifo(path, error)) throw std::runtime_error(fmt::format("{}: this is a pipe", name));
    std::string text = read_file(path, name, most_bytes);
    if (text.empty()) throw std::runtime_error(fmt::format("{}: this file is empty", name));
    if (text.size() > most_bytes) throw std::runtime_error(fmt::format("{}: over 1 MB", name));
    return text;
}

/// Takes the name of a file that was read and what it holds.
using FileWitness = std::function<void(const std::string& name, const std::string& text)>;

Player read_player(const PlaySettings& settings, const Document& given, const std::filesystem::path& folder,
                   const FileWitness& witness) {
    Player player{given, {}, 0, {}};
    for (const Setting& setting : settings.keys) {
        try {
            player.document = player.document.with({setting});
        } catch (const PatternError& error) {
            throw SettingError(setting.key, setting.value, error.diagnostics().front().message);
        }
    }
    Diagnostics diagnostics;
    const std::string& name = given.source().name();
    const std::filesystem::path beside = name == "-" ? folder : std::filesystem::path(name).parent_path();
    player.melody = read_melody(
        player.document.pattern(),
        [&](const std::string& file) {
            // Files that the pattern names are beside it; files that options name are in the folder of the options.
            const bool is_option = std::any_of(settings.keys.begin(), settings.keys.end(),
                                               [&](const Setting& setting) { return setting.value == file; });
            std::string text =
                is_option ? read_small_file(folder, beside, file) : read_small_file(beside, folder, file);
            if (witness) witness(file, text);
            return text;
        },
        diagnostics);
    diagnostics.throw_if_errors();
    // Warnings about the pattern itself belong to the document.
    for (const Diagnostic& warning : diagnostics.list()) {
        if (warning.where.line == 0) player.warnings.push_back(warning.message);
    }
    transpose(player.melody, settings.transpose);
    return player;
}

std::string made_with(const PlaySettings& settings, const std::vector<Player>& players) {
    std::string text;
    for (const Setting& setting : settings.keys) text += fmt::format(" --{} '{}'", setting.key, setting.value);
    if (settings.from_bar != 1) text += fmt::format(" --from-bar {}", settings.from_bar);
    if (settings.bars != 0) text += fmt::format(" --bars {}", settings.bars);
    if (settings.seconds != 0) text += fmt::format(" --seconds {}", settings.seconds);
    if (settings.transpose != 0) text += fmt::format(" --transpose {}", settings.transpose);
    if (settings.tuning != Tuning::bend) text += " --tuning mts";
    if (settings.humanise != 0) {
        text += fmt::format(" --humanise {}", settings.humanise);
        if (!players.front().document.has_override("seed")) text += fmt::format(" --seed {}", settings.seed);
    }
    const Document& first = players.front().document;
    return recipe(first, first.grammar(), "", text);
}

/// The piece that is wanted, in ticks.
PlayOptions piece_of(const PlaySettings& options, const Melody& melody, const Monitor& monitor) {
    PlayOptions playing;
    playing.budget = options.budget;
    playing.watch = [monitor](std::uint64_t symbols) { monitor.advance(symbols); };
    const std::int64_t bar = melody.meter.bar();
    if (options.from_bar - 1 > (INT64_MAX / 4) / bar) {
        throw SettingError("from-bar", std::to_string(options.from_bar),
                           "this bar is more than 2^60 ticks from the beginning");
    }
    playing.from = (options.from_bar - 1) * bar;
    if (options.bars > 0) playing.to = playing.from + std::min(options.bars, (INT64_MAX / 4) / bar) * bar;
    if (options.seconds > 0) {
        const double ticks = options.seconds * melody.tempo / 60 * static_cast<double>(ticks_per_quarter);
        playing.to = std::min(playing.to, playing.from + static_cast<std::int64_t>(std::min(ticks, 4e18)));
    }
    return playing;
}

bool has_brackets(const Grammar& grammar) {
    const std::vector<char> reached = grammar.reachable();
    for (Symbol symbol = 0; symbol < reached.size(); ++symbol) {
        if (reached[symbol] && grammar.is_push(symbol)) return true;
    }
    return false;
}

/// How many voices sound; where brackets make them, only playing tells.
int voices_of(const Player& player, const PlayOptions& playing) {
    const Melody& melody = player.melody;
    if (!has_brackets(player.document.grammar())) {
        if (melody.mapping == Mapping::counterpoint) return 2;
        return melody.mapping == Mapping::runs && melody.vertical == Vertical::voice ? 2 : 1;
    }
    Nobody nobody;
    return std::max(1, play(player.document.grammar(), melody, nobody, playing).voices);
}

std::string scale_of(const Melody& melody) {
    const auto spelling = spell(melody.scale, melody.tonic_spelling);
    return fmt::format("{} from {}", melody.scale.title, note_name(melody.tonic + melody.transpose, spelling));
}

ScoreHead head_of(const PlaySettings& options, std::vector<Player>& players, const PlayOptions& playing) {
    ScoreHead head;
    const Melody& first = players.front().melody;
    head.tempo = first.tempo;
    head.meter = first.meter;
    head.made = made_with(options, players);
    int voices = 0;
    for (Player& player : players) {
        const Pattern& pattern = player.document.pattern();
        const Melody& melody = player.melody;
        const std::string title = pattern.text("title");
        head.title += (head.title.empty() || title.empty() ? "" : ", ") + title;
        if (head.composer.empty()) head.composer = pattern.text("source");
        if (!head.pattern.empty()) head.pattern += '\n';
        head.pattern += pattern.source->text();
        Part part;
        part.name = instrument_names()[static_cast<std::size_t>(melody.program)];
        part.scale = scale_of(melody);
        part.program = melody.program;
        part.key = key_signature(melody.scale, melody.tonic_spelling);
        part.spelling = spell(melody.scale, melody.tonic_spelling);
        player.first_voice = voices;
        PlayOptions counting = playing;
        counting.most_voices = most_voices - voices;
        part.voices = voices_of(player, counting);
        voices += part.voices;
        if (voices > most_voices) {
            throw ScoreError(fmt::format("too many voices: the patterns have {} together, MIDI has channels for {}",
                                         voices, most_voices));
        }
        head.parts.push_back(std::move(part));
    }
    return head;
}

Integer bars_of(const Integer& ticks, const Meter& meter) {
    return (ticks + meter.bar() - 1) / meter.bar();
}

std::string time_of(const Integer& ticks, double tempo) {
    return time_text(ticks.convert_to<double>() / static_cast<double>(ticks_per_quarter) * 60 / tempo);
}

std::string range_of(const PlayReport& report, const Melody& melody) {
    const auto spelling = spell(melody.scale, melody.tonic_spelling);
    return fmt::format("{} to {}", note_name(report.lowest, spelling), note_name(report.highest, spelling));
}

/// Why a melody has no notes, and what may help; empty if unknown.
std::string reason_of_silence(const Melody& melody, std::uint64_t lost) {
    if (lost > 0) return ": every note is shorter than a tick, or has no key in the key map";
    if (melody.mapping != Mapping::runs) return {};
    return std::string(": the curve has no horizontal run there") +
           (melody.vertical != Vertical::voice ? "; try `vertical: voice`, another `heading:` or `mapping: symbols`"
                                               : "");
}

/// Describes the music without writing a score: by playing, or, if that would take too long, by the fold.
std::string description(const std::vector<Player>& players, const PlayOptions& piece, bool is_whole) {
    PlayOptions playing = piece;
    playing.budget = std::min(piece.budget, 20e6);
    std::string text;
    for (const Player& player : players) {
        const Melody& melody = player.melody;
        const std::string title = player.document.text("title");
        const auto known = is_whole ? census(player.document.grammar(), melody) : std::nullopt;
        std::optional<PlayReport> played;
        try {
            Nobody nobody;
            played = play(player.document.grammar(), melody, nobody, playing);
        } catch (const BudgetError&) {
            if (!known) throw;
        }
        const auto out = std::back_inserter(text);
        fmt::format_to(out, "{}, n = {}\n", title.empty() ? "(untitled)" : printable(title),
                       player.document.grammar().steps());
        const Integer notes = played ? Integer(played->notes) : known->notes;
        const Integer ticks = played ? Integer(played->end) : known->ticks;
        fmt::format_to(out, "scale     {}\nnotes     {}\nbars      {}\ntime      {}\n", scale_of(melody), notes.str(),
                       bars_of(ticks, melody.meter).str(), time_of(ticks, melody.tempo));
        if (played && played->notes > 0) fmt::format_to(out, "range     {}\n", range_of(*played, melody));
        if (played && played->notes == 0) {
            fmt::format_to(out, "the melody contains no notes{}\n", reason_of_silence(melody, played->lost));
        }
        if (known) fmt::format_to(out, "height    {}\n", counted(known->height.str(), "degree"));
    }
    return text;
}

/// Plays all parts into `sink`.
PlayReport play_all(const std::vector<Player>& players, const PlayOptions& playing, NoteSink& sink) {
    PlayReport all;
    all.past = true;
    for (const Player& player : players) {
        PartSink part(sink, player.first_voice);
        const PlayReport report = play(player.document.grammar(), player.melody, part, playing);
        all.notes += report.notes;
        all.moved += report.moved;
        all.lost += report.lost;
        all.lowest = std::min(all.lowest, report.lowest);
        all.highest = std::max(all.highest, report.highest);
        all.end = std::max(all.end, report.end);
        all.past = all.past && report.past;
    }
    if (all.notes > 0) {
        sink.finish(all.end);
        return all;
    }
    if (playing.from > 0 && all.past) {
        Integer ticks = 0;
        for (const Player& player : players) {
            const auto known = census(player.document.grammar(), player.melody);
            if (!known) throw ScoreError("the requested bars contain no notes: the melody ends before them");
            ticks = std::max(ticks, known->ticks);
        }
        throw ScoreError(fmt::format("the requested bars contain no notes: the melody ends at bar {}",
                                     bars_of(ticks, players.front().melody.meter).str()));
    }
    throw ScoreError(
        fmt::format("the {} no notes{}",
                    playing.from > 0 || playing.to < INT64_MAX ? "requested bars contain" : "melody contains",
                    reason_of_silence(players.front().melody, all.lost)));
}

void report_notes(const std::vector<Player>& players, const PlayOptions& playing, const PlayReport& report,
                  Made& made) {
    const Melody& first = players.front().melody;
    made.fact(fmt::format("{}, {}, {}, {}", counted(report.notes, "note"),
                          counted(bars_of(report.end, first.meter).str(), "bar"), time_of(report.end, first.tempo),
                          range_of(report, first)));
    if (report.moved > 0) {
        const auto spelling = spell(first.scale, first.tonic_spelling);
        made.warn(fmt::format(
            "{} beyond {} to {} and {}{}", report.moved == 1 ? "1 note was" : counted(report.moved, "note") + " were",
            note_name(first.lowest, spelling), note_name(first.highest, spelling),
            first.range == Range::fold      ? "folded back"
            : first.range == Range::reflect ? "reflected"
                                            : "held at the last key",
            playing.from > 0 && first.anchor != Anchor::piece ? "; with `anchor: piece` the piece begins on the tonic"
                                                              : ""));
    }
    if (report.lost > 0) {
        made.warn(counted(report.lost, "note") + " too short for a tick, or without a key, left out");
    }
    for (const Player& player : players) {
        const Melody& melody = player.melody;
        if (melody.tempo != first.tempo || melody.meter.beats != first.meter.beats ||
            melody.meter.unit != first.meter.unit) {
            made.warn(printable(player.document.text("title")) +
                      " is played in the tempo and meter of the first pattern");
        }
    }
}

void report_notation(const Notation& notation, Made& made) {
    if (notation.moved > 0) {
        made.warn(
            fmt::format("{} not begin or end at a 64th and are written at the nearest; `unit: 1/8` or another "
                        "power of two keeps the rhythm",
                        notation.moved == 1 ? "1 note does" : counted(notation.moved, "note") + " do"));
    }
    if (notation.bent > 0) {
        made.warn(fmt::format("{} written as the nearest quarter tone; MIDI, sound and the page keep the pitch",
                              notation.bent == 1 ? "1 note is" : counted(notation.bent, "note") + " are"));
    }
}

/// A planned score.
class ScoreWork : public Work {
public:
    /// @throws SettingError, PatternError; std::runtime_error if a file that a pattern names cannot be read
    ScoreWork(std::span<const Document> documents, ScoreFormat format, PlaySettings settings,
              const std::filesystem::path& folder)
        : format_(format), settings_(std::move(settings)) {
        const auto witness = [this](const std::string& name, const std::string& text) {
            files_.emplace_back(name, text);
        };
        for (const Document& document : documents) {
            players_.push_back(read_player(settings_, document, folder, witness));
            Melody& melody = players_.back().melody;
            // MusicXML cannot represent the lowest octave of MIDI.
            if (format == ScoreFormat::musicxml) melody.lowest = std::max(melody.lowest, lowest_in_musicxml);
            midi_.microtonal = midi_.microtonal || melody.is_microtonal();
        }
        midi_.format = settings_.format;
        midi_.tuning = settings_.tuning;
    }

    Cost forecast() const override;
    std::vector<std::pair<std::string, std::string>> read_files() const override { return files_; }
    Made make(Destination& destination, const std::filesystem::path& name, const Monitor& monitor,
              int threads) override;
    NoteList list(const Monitor& monitor) {
        const PlayOptions playing = piece_of(settings_, players_.front().melody, monitor);
        const ScoreHead head = head_of(settings_, players_, playing);  // numbers the voices of the parts
        NoteCollector collector(static_cast<std::size_t>(available_memory() / 4 / sizeof(Note)));
        play_into(collector, playing);
        NoteList result{collector.notes(), collector.end(), head.tempo, head.meter, head.parts};
        std::stable_sort(result.notes.begin(), result.notes.end(), [](const Note& a, const Note& b) {
            return std::tie(a.onset, a.voice) < std::tie(b.onset, b.voice);
        });
        return result;
    }
    std::string describe(const Monitor& monitor) const {
        return description(players_, piece_of(settings_, players_.front().melody, monitor),
                           settings_.from_bar == 1 && settings_.bars == 0 && settings_.seconds == 0);
    }

private:
    void check_size(const PlayOptions& playing) const;
    void write(const ScoreHead& head, const PlayOptions& playing, Output& output, Made& made);
    /// @return peak level
    double write_sound(const ScoreHead& head, const PlayOptions& playing, Output& output, PlayReport& report);
    PlayReport play_into(NoteSink& sink, const PlayOptions& playing) const {
        Humaniser human(sink, settings_.humanise, settings_.seed, playing.from);
        return play_all(players_, playing, settings_.humanise > 0 ? static_cast<NoteSink&>(human) : sink);
    }

    ScoreFormat format_;
    PlaySettings settings_;
    std::vector<Player> players_;
    std::vector<std::pair<std::string, std::string>> files_;
    MidiOptions midi_;
    Monitor monitor_;
};

/// @throws BudgetError for more notes than a MIDI file can contain
void ScoreWork::check_size(const PlayOptions& playing) const {
    const bool as_midi = format_ == ScoreFormat::midi || format_ == ScoreFormat::wav || format_ == ScoreFormat::flac;
    if (!as_midi || playing.to < INT64_MAX) return;
    for (const Player& player : players_) {
        const auto known = census(player.document.grammar(), player.melody);
        if (known && known->notes > 0xFFFFFFFF / 8) {
            throw BudgetError(
                fmt::format("{} notes would exceed the limit of MIDI files, 4 GiB; limit the "
                            "bars or seconds",
                            known->notes.str()));
        }
    }
}

double ScoreWork::write_sound(const ScoreHead& head, const PlayOptions& playing, Output& output, PlayReport& report) {
    OutputFile score(output.temporary().string() + ".mid");  // never committed
    const auto writer = write_midi(head, score, midi_);
    report = play_into(*writer, playing);
    const double seconds = static_cast<double>(report.end) / static_cast<double>(ticks_per_quarter) * 60 / head.tempo;
    if (seconds > most_audio_seconds) {
        throw ScoreError(
            fmt::format("{} of sound are too long: a WAV file can contain 6 hours 45 minutes; limit the bars or "
                        "seconds",
                        time_text(seconds)));
    }
    return render_audio(score.temporary(), output.temporary(),
                        format_ == ScoreFormat::wav ? AudioFormat::wav : AudioFormat::flac,
                        [this](double) { monitor_.check(); });
}

void ScoreWork::write(const ScoreHead& head, const PlayOptions& playing, Output& output, Made& made) {
    PlayReport report;
    std::optional<Notation> notation;
    bool is_silent = false;
    switch (format_) {
        case ScoreFormat::midi: {
            const auto writer = write_midi(head, output, midi_);
            report = play_into(*writer, playing);
            break;
        }
        case ScoreFormat::musicxml:
        case ScoreFormat::lilypond: {
            Notator notator(head);
            report = play_into(notator, playing);
            notation = notator.notation();
            if (format_ == ScoreFormat::musicxml) {
                write_musicxml(*notation, head, output);
            } else {
                write_lilypond(*notation, head, output);
            }
            break;
        }
        case ScoreFormat::svg:
        case ScoreFormat::html: {
            NoteCollector collector;
            report = play_into(collector, playing);
            if (format_ == ScoreFormat::svg) {
                write_music_svg(head, collector.notes(), collector.end(), output);
            } else {
                write_music_page(head, collector.notes(), collector.end(), output);
            }
            break;
        }
        case ScoreFormat::wav:
        case ScoreFormat::flac:
            is_silent = write_sound(head, playing, output, report) == 0;
            break;
    }
    report_notes(players_, playing, report, made);
    if (notation) report_notation(*notation, made);
    if (is_silent) made.warn("the sound is silent: the soundfont has no sound for these keys of this instrument");
}

Made ScoreWork::make(Destination& destination, const std::filesystem::path& name, const Monitor& monitor,
                     int /*threads*/) {
    Made made;
    for (const Player& player : players_) {
        for (const std::string& warning : player.warnings) made.warn(warning);
    }
    monitor_ = monitor;
    const PlayOptions playing = piece_of(settings_, players_.front().melody, monitor);
    monitor.expect(0);
    check_size(playing);
    const ScoreHead head = head_of(settings_, players_, playing);
    const auto output = destination.open(name);
    if (output->can_insert()) {
        write(head, playing, *output, made);
    } else {
        if (format_ == ScoreFormat::wav || format_ == ScoreFormat::flac) {
            throw std::runtime_error(fmt::format("cannot write '{}': sound needs a regular file", name.string()));
        }
        // Writers of sound seek to the beginning, which pipes do not support.
        MemoryOutput whole;
        write(head, playing, whole, made);
        output->write(whole.bytes());
    }
    output->commit();
    return made;
}

Cost ScoreWork::forecast() const {
    constexpr double unknown_symbols = 1e6;  // assumed for words of unknown length
    Cost result;
    for (const Player& player : players_) {
        const Grammar& grammar = player.document.grammar();
        const auto known = estimate(grammar, true);
        double nodes = std::min(known ? known->nodes : unknown_symbols, settings_.budget);
        double notes = std::min(known ? drawn_symbols(grammar, *known) : nodes / 2, nodes);
        if (settings_.bars > 0 || settings_.seconds > 0) {
            nodes = notes = std::min(
                notes, std::max(10'000.0, 64.0 * static_cast<double>(settings_.bars) + 32 * settings_.seconds));
        }
        result.seconds += 0.0015 + nodes * 15e-9 + notes * 80e-9 + matching_seconds(grammar, settings_.budget);
        result.bytes += 600 + notes * 9;
        result.memory += 8e6;
        if (format_ == ScoreFormat::wav || format_ == ScoreFormat::flac) {
            result.seconds += 1 + notes * 0.002;
            result.bytes += notes * 44'100;
            result.memory += 60e6;
        } else if (format_ != ScoreFormat::midi) {
            result.seconds += notes * 1e-6;
            result.bytes += notes * 120;
            result.memory += notes * 300;
        }
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
    return std::make_unique<ScoreWork>(documents, known(format), read_play_settings(values), folder);
}

NoteList list_notes(std::span<const Document> documents, const OptionValues& values, const Monitor& monitor) {
    return ScoreWork(documents, ScoreFormat::midi, read_play_settings(values), {}).list(monitor);
}

std::string describe_score(std::span<const Document> documents, const OptionValues& values, const Monitor& monitor) {
    return ScoreWork(documents, ScoreFormat::midi, read_play_settings(values), {}).describe(monitor);
}

std::string play(const Document& document, std::string_view format, const OptionValues& values,
                 const Monitor& monitor) {
    return make_in_memory(scores(), document, format, values, monitor);
}

}  // namespace sikku
