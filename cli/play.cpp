// cli/play.cpp: `sikku play`: a curve as music.
#include "cli/play.h"

#include "cli/file_bytes.h"
#include "cli/music_page.h"
#include "engine/base/output_file.h"
#include "engine/base/text.h"
#include "music/melody/mapping.h"
#include "music/score/audio.h"
#include "music/score/lilypond.h"
#include "music/score/midi.h"
#include "music/score/musicxml.h"
#include "music/score/notation.h"
#include "music/score/spelling.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>
#include <optional>

namespace sikku {
namespace {

enum class ScoreFormat { midi, musicxml, lilypond, wav, flac, svg, html };

constexpr int most_voices = 15;  // channels but the drums'

std::optional<ScoreFormat> score_format(const std::string& file) {
    static constexpr std::array<std::pair<std::string_view, ScoreFormat>, 9> endings = {
        {{".mid", ScoreFormat::midi},
         {".midi", ScoreFormat::midi},
         {".musicxml", ScoreFormat::musicxml},
         {".xml", ScoreFormat::musicxml},
         {".ly", ScoreFormat::lilypond},
         {".wav", ScoreFormat::wav},
         {".flac", ScoreFormat::flac},
         {".svg", ScoreFormat::svg},
         {".html", ScoreFormat::html}}};
    const std::string extension = lower_case(std::filesystem::path(file).extension().string());
    for (const auto& [ending, format] : endings) {
        if (extension == ending) return format;
    }
    return std::nullopt;
}

/// A pattern that is a part of the score.
struct Player {
    Document loaded;
    Melody melody;
    int first_voice = 0;
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
            const std::uint64_t chance =
                scrambled(seed_ ^ scrambled(static_cast<std::uint64_t>(from_ + note.onset) * 16 +
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
    static std::uint64_t scrambled(std::uint64_t value) {
        value += 0x9E3779B97F4A7C15;
        value = (value ^ (value >> 30)) * 0xBF58476D1CE4E5B9;
        value = (value ^ (value >> 27)) * 0x94D049BB133111EB;
        return value ^ (value >> 31);
    }
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
    std::ifstream stream(path, std::ios::binary);
    std::string text(most_bytes + 1, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    if (!stream.eof() && text.size() <= most_bytes) {
        throw std::runtime_error(fmt::format("{}: this file cannot be read", name));
    }
    if (text.empty()) throw std::runtime_error(fmt::format("{}: this file is empty", name));
    if (text.size() > most_bytes) throw std::runtime_error(fmt::format("{}: over 1 MB", name));
    return text;
}

/// Takes the name of a file that was read and what it holds.
using FileWitness = std::function<void(const std::string& name, const std::string& text)>;

Player load_player(const PlaySettings& options, const std::string& name, const Telling& telling,
                   const FileWitness& witness = {}) {
    PatternOptions one = options.pattern;
    one.pattern = name;
    std::vector<std::string> given;
    const auto keys = keys_of(KeyOwner::music);
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (!options.keys[i]) continue;
        one.more.push_back({"--" + std::string(keys[i]), std::string(keys[i]), *options.keys[i]});
        given.push_back(*options.keys[i]);
    }
    Player player{load(one, telling), {}, 0};
    Diagnostics diagnostics;
    const std::filesystem::path here = options.folder;
    const std::filesystem::path beside = name == "-" ? here : std::filesystem::path(name).parent_path();
    player.melody = read_melody(
        player.loaded.pattern(),
        [&](const std::string& file) {
            // What the pattern names lies beside it, what the command line names is seen from here.
            const bool is_option = std::find(given.begin(), given.end(), file) != given.end();
            std::string text = is_option ? read_small_file(here, beside, file) : read_small_file(beside, here, file);
            if (witness) witness(file, text);
            return text;
        },
        diagnostics);
    diagnostics.throw_if_errors();
    transpose(player.melody, options.transpose);
    return player;
}

std::string made_with(const PlaySettings& options, const std::vector<Player>& players) {
    std::string text = fmt::format("sikku {}, -n {}", SIKKU_VERSION, players.front().loaded.grammar().steps());
    if (!options.pattern.variant.empty()) text += " --variant " + options.pattern.variant;
    if (!options.pattern.seed.empty()) text += " --seed " + options.pattern.seed;
    for (const std::string& setting : options.pattern.settings) text += fmt::format(" --set '{}'", setting);
    const auto keys = keys_of(KeyOwner::music);
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (options.keys[i]) text += fmt::format(" --{} '{}'", keys[i], *options.keys[i]);
    }
    if (options.from_bar != 1) text += fmt::format(" --from-bar {}", options.from_bar);
    if (options.bars != 0) text += fmt::format(" --bars {}", options.bars);
    if (options.seconds != 0) text += fmt::format(" --seconds {}", options.seconds);
    if (options.transpose != 0) text += fmt::format(" --transpose {}", options.transpose);
    if (options.tuning != "bend") text += " --tuning " + options.tuning;
    if (options.humanise != 0) text += fmt::format(" --humanise {}", options.humanise);
    if (options.humanise != 0 && options.pattern.seed.empty()) text += fmt::format(" --seed {}", options.seed);
    return text;
}

/// The piece that is wanted, in ticks.
PlayOptions piece_of(const PlaySettings& options, const Melody& melody) {
    PlayOptions playing;
    const std::int64_t bar = melody.meter.bar();
    if (options.from_bar - 1 > (INT64_MAX / 4) / bar) {
        throw UsageError(fmt::format("--from-bar {}: that is more than 2^60 ticks away", options.from_bar));
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
    if (!has_brackets(player.loaded.grammar())) {
        if (melody.mapping == Mapping::counterpoint) return 2;
        return melody.mapping == Mapping::runs && melody.vertical == Vertical::voice ? 2 : 1;
    }
    Nobody nobody;
    return std::max(1, play(player.loaded.grammar(), melody, nobody, playing).voices);
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
        const Pattern& pattern = player.loaded.pattern();
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

std::string time_text(double seconds) {
    if (!std::isfinite(seconds) || seconds > 1e12) return fmt::format("{:.3g} years", seconds / 31'556'952);
    if (seconds < 60) return fmt::format("{:.1f} s", seconds);
    if (seconds < 3600) return fmt::format("{:.0f} min {:.0f} s", std::floor(seconds / 60), std::fmod(seconds, 60));
    return fmt::format("{:.1f} h", seconds / 3600);
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

/// What there is to know before a score is written: by playing to nobody, or, of what is too long for that, by the
/// fold.
void describe(const std::vector<Player>& players, const PlayOptions& piece, bool is_whole) {
    PlayOptions playing = piece;
    playing.budget = std::min(piece.budget, 20e6);
    for (const Player& player : players) {
        const Melody& melody = player.melody;
        const std::string title = player.loaded.pattern().text("title");
        const auto known = is_whole ? census(player.loaded.grammar(), melody) : std::nullopt;
        std::optional<PlayReport> played;
        try {
            Nobody nobody;
            played = play(player.loaded.grammar(), melody, nobody, playing);
        } catch (const BudgetError&) {
            if (!known) throw;
        }
        fmt::print("{}, n = {}\n", title.empty() ? "(untitled)" : printable(title), player.loaded.grammar().steps());
        const Integer notes = played ? Integer(played->notes) : known->notes;
        const Integer ticks = played ? Integer(played->end) : known->ticks;
        fmt::print("scale     {}\nnotes     {}\nbars      {}\ntime      {}\n", scale_of(melody), notes.str(),
                   bars_of(ticks, melody.meter).str(), time_of(ticks, melody.tempo));
        if (played && played->notes > 0) fmt::print("range     {}\n", range_of(*played, melody));
        if (known) fmt::print("height    {}\n", counted(known->height.str(), "degree"));
    }
}

/// Plays all parts into `sink`.
PlayReport play_all(const std::vector<Player>& players, const PlayOptions& playing, NoteSink& sink) {
    PlayReport all;
    all.past = true;
    for (const Player& player : players) {
        PartSink part(sink, player.first_voice);
        const PlayReport report = play(player.loaded.grammar(), player.melody, part, playing);
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
        throw ScoreError(
            "there is no note in this piece: the music ends before it begins; without -o its bars are told");
    }
    std::string why;
    const Melody& melody = players.front().melody;
    if (all.lost > 0) {
        why = ": every note is shorter than a tick, or has no key in the key map";
    } else if (melody.mapping == Mapping::runs) {
        why = ": the curve has no horizontal run there";
        if (melody.vertical != Vertical::voice) {
            why += "; `--vertical voice`, `--set heading=…` or `--mapping symbols` may find some";
        }
    }
    throw ScoreError(
        fmt::format("there is no note{}{}", playing.from > 0 || playing.to < INT64_MAX ? " in this piece" : "", why));
}

/// What became of the notes.
void tell_of(const std::vector<Player>& players, const PlayOptions& playing, const PlayReport& report,
             const Telling& telling) {
    const Melody& first = players.front().melody;
    telling.say("{}, {}, {}, {}\n", counted(report.notes, "note"),
                counted(bars_of(report.end, first.meter).str(), "bar"), time_of(report.end, first.tempo),
                range_of(report, first));
    if (report.moved > 0) {
        const auto spelling = spell(first.scale, first.tonic_spelling);
        telling.say("sikku: warning: {} beyond {} to {} and {}{}\n",
                    report.moved == 1 ? "1 note was" : counted(report.moved, "note") + " were",
                    note_name(first.lowest, spelling), note_name(first.highest, spelling),
                    first.range == Range::fold      ? "folded back"
                    : first.range == Range::reflect ? "reflected"
                                                    : "held at the last key",
                    playing.from > 0 && first.anchor != Anchor::piece
                        ? "; `--anchor piece` lets the piece begin with the tonic"
                        : "");
    }
    if (report.lost > 0) {
        telling.say("sikku: warning: {} too short for a tick, or without a key, left out\n",
                    counted(report.lost, "note"));
    }
    for (const Player& player : players) {
        const std::string name = printable(player.loaded.pattern().text("title"));
        const Melody& melody = player.melody;
        if (melody.tempo != first.tempo || melody.meter.beats != first.meter.beats ||
            melody.meter.unit != first.meter.unit) {
            telling.say("sikku: warning: {} keeps to the tempo and meter of the first pattern\n", name);
        }
    }
}

void tell_of(const Notation& notation, const Telling& telling) {
    if (notation.moved > 0) {
        telling.say(
            "sikku: warning: {} not begin or end at a 64th and are written at the nearest; `--unit 1/8` or another "
            "power of two keeps the rhythm\n",
            notation.moved == 1 ? "1 note does" : counted(notation.moved, "note") + " do");
    }
    if (notation.bent > 0) {
        telling.say("sikku: warning: {} written as the nearest quarter tone; .mid, .wav and .html keep the pitch\n",
                    notation.bent == 1 ? "1 note is" : counted(notation.bent, "note") + " are");
    }
}

}  // namespace

void check_score(const PlaySettings& options) {
    const auto known_format = score_format(options.output);
    if (!options.output.empty() && !known_format) {
        throw UsageError(
            fmt::format("-o {}: unknown extension; a score is .mid, .musicxml or .ly, sound is .wav or "
                        ".flac, and .svg or .html show it",
                        options.output));
    }
    if (options.seconds < 0 || !std::isfinite(options.seconds)) throw UsageError("--seconds: expected 0 or more");
    if (!(std::fabs(options.transpose) <= 127)) throw UsageError("--transpose: expected semitones, -127 to 127");
    if (!(options.humanise >= 0 && options.humanise <= 1)) throw UsageError("--humanise: expected 0 to 1");
}

void play_score(const PlaySettings& options, const Telling& telling) {
    check_score(options);
    const auto known_format = score_format(options.output);
    std::vector<Player> players;
    for (const std::string& name : options.patterns) players.push_back(load_player(options, name, telling));

    PlayOptions playing = piece_of(options, players.front().melody);
    playing.budget = options.budget;
    std::optional<Progress> progress;
    if (telling.watch) {
        playing.watch = telling.watch;
    } else {
        playing.watch = progress.emplace(0, telling.quiet).watch();
    }
    if (!known_format) {
        return describe(players, playing, options.from_bar == 1 && options.bars == 0 && options.seconds == 0);
    }
    const ScoreFormat format = *known_format;
    for (Player& player : players) {
        // The lowest octave of MIDI is below what MusicXML can tell.
        if (format == ScoreFormat::musicxml)
            player.melody.lowest = std::max(player.melody.lowest, lowest_in_musicxml);
    }
    MidiOptions midi;
    midi.format = options.format;
    midi.tuning = options.tuning == "mts" ? Tuning::mts : Tuning::bend;
    const bool as_midi = format == ScoreFormat::midi || format == ScoreFormat::wav || format == ScoreFormat::flac;
    for (const Player& player : players) {
        midi.microtonal = midi.microtonal || player.melody.is_microtonal();
        if (!as_midi || playing.to < INT64_MAX) continue;
        const auto known = census(player.loaded.grammar(), player.melody);
        if (known && known->notes > 0xFFFFFFFF / 8) {
            throw BudgetError(
                fmt::format("{} notes would make a file of over 4 GiB, which MIDI cannot write: "
                            "`--bars` or `--seconds` plays a piece of it",
                            known->notes.str()));
        }
    }
    const ScoreHead head = head_of(options, players, playing);

    OutputFile output(options.output);
    FileBytes bytes(output);
    PlayReport report;
    std::optional<Notation> notation;
    bool is_silent = false;
    const auto play_into = [&](NoteSink& sink) {
        Humaniser human(sink, options.humanise, options.seed, playing.from);
        report = play_all(players, playing, options.humanise > 0 ? static_cast<NoteSink&>(human) : sink);
    };
    switch (format) {
        case ScoreFormat::midi: {
            const auto writer = write_midi(head, bytes, midi);
            play_into(*writer);
            break;
        }
        case ScoreFormat::musicxml:
        case ScoreFormat::lilypond: {
            Notator notator(head);
            play_into(notator);
            notation = notator.notation();
            if (format == ScoreFormat::musicxml) {
                write_musicxml(*notation, head, bytes);
            } else {
                write_lilypond(*notation, head, bytes);
            }
            break;
        }
        case ScoreFormat::svg:
        case ScoreFormat::html: {
            NoteCollector collector;
            play_into(collector);
            if (format == ScoreFormat::svg) {
                write_music_svg(head, collector.notes(), collector.end(), bytes);
            } else {
                write_music_page(head, collector.notes(), collector.end(), bytes);
            }
            break;
        }
        case ScoreFormat::wav:
        case ScoreFormat::flac: {
            if (!output.can_insert())
                throw UsageError(fmt::format("-o {}: sound goes to a file only", options.output));
            OutputFile score(output.temporary().string() + ".mid");  // never to be seen
            FileBytes score_bytes(score);
            const auto writer = write_midi(head, score_bytes, midi);
            play_into(*writer);
            const double seconds =
                static_cast<double>(report.end) / static_cast<double>(ticks_per_quarter) * 60 / head.tempo;
            if (seconds > most_audio_seconds) {
                throw ScoreError(fmt::format(
                    "{} of sound are too long: a WAV file holds 6 hours 45 minutes; `--seconds` plays a piece",
                    time_text(seconds)));
            }
            is_silent = render_audio(score.temporary(), output.temporary(),
                                     format == ScoreFormat::wav ? AudioFormat::wav : AudioFormat::flac, [](double) {
                                         if (interrupted()) throw Interrupted();
                                     }) == 0;
            break;
        }
    }
    bytes.finish();
    output.commit();
    tell_of(players, playing, report, telling);
    if (notation) tell_of(*notation, telling);
    if (is_silent) {
        telling.say(
            "sikku: warning: nothing is to be heard: the soundfont has no sound for these keys of this instrument\n");
    }
}

std::vector<std::pair<std::string, std::string>> scala_files(const PlaySettings& options) {
    std::vector<std::pair<std::string, std::string>> files;
    try {
        for (const std::string& name : options.patterns) {
            load_player(options, name, {.quiet = true, .listener = {}, .watch = {}},
                        [&](const std::string& file, const std::string& text) { files.emplace_back(file, text); });
        }
    } catch (const std::exception&) {
        return {};
    }
    return files;
}

void add_play(CLI::App& app, bool& quiet) {
    auto* command = app.add_subcommand("play", "Play a curve: MIDI, MusicXML, LilyPond, sound, a page that plays");
    auto options = std::make_shared<PlaySettings>();
    command
        ->add_option("PATTERN", options->patterns,
                     "Pattern files, names of those that come along, or -; several become tracks of one score")
        ->required();
    add_override_options(*command, options->pattern);
    command->add_option("-o,--output", options->output,
                        "The file: .mid, .musicxml, .ly, .wav, .flac, .svg or .html; without it, notes, time and "
                        "range are told");
    const auto keys = keys_of(KeyOwner::music);
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const KeyInfo& key = *find_language_key(keys[i]);
        command
            ->add_option("--" + std::string(keys[i]), options->keys[i], fmt::format("{}: {}", key.help, key.values))
            ->type_name("VALUE");
    }
    command->add_option("--from-bar", options->from_bar, "Begin at this bar, counted from 1")
        ->check(CLI::Range(std::int64_t{1}, INT64_MAX));
    command->add_option("--bars", options->bars, "So many bars")->check(CLI::Range(std::int64_t{1}, INT64_MAX));
    command->add_option("--seconds", options->seconds, "At most so long");
    command->add_option("--transpose", options->transpose, "Semitones, added to every note");
    command->add_option("--humanise", options->humanise,
                        "0 to 1: how far from exact a player is; another one with another --seed");
    command->add_option("--midi-format", options->format, "1, a track for each voice, or 0")
        ->check(CLI::IsMember({0, 1}))
        ->capture_default_str();
    command->add_option("--tuning", options->tuning, "Microtones by pitch bend or by the MIDI Tuning Standard")
        ->check(CLI::IsMember({"bend", "mts"}))
        ->capture_default_str();
    add_budget_option(*command, options->budget);
    command->footer(
        "A horizontal run of the curve is a note: its pitch from y through the scale, its duration from its "
        "length.\n\n"
        "Examples:\n"
        "  sikku play hilbert -o hilbert.mid\n"
        "  sikku play dragon --mapping counterpoint --scale blues -o dragon.html\n"
        "  sikku play hilbert -n 40 --anchor piece --from-bar 1000000000 --bars 16 -o piece.musicxml");
    command->callback([options, &quiet] {
        options->seed = seed_of(options->pattern);
        play_score(*options, {.quiet = quiet, .listener = {}, .watch = {}});
    });
}

}  // namespace sikku
