// cli/play.cpp: `sikku play`: a curve as music.
#include "art/output_file.h"
#include "cli/command.h"
#include "cli/music_page.h"
#include "engine/text.h"
#include "music/audio.h"
#include "music/lilypond.h"
#include "music/mapping.h"
#include "music/midi.h"
#include "music/musicxml.h"
#include "music/notation.h"
#include "music/spelling.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>

namespace sikku {
namespace {

enum class ScoreFormat { midi, musicxml, lilypond, wav, flac, svg, html };

struct Options {
    PatternOptions pattern;
    std::vector<std::string> patterns;
    std::string output;
    std::vector<std::string> keys = std::vector<std::string>(melody_keys().size());
    std::int64_t from_bar = 1;
    std::int64_t bars = 0;
    double seconds = 0;
    double transpose = 0;
    double humanise = 0;
    std::uint64_t seed = 1;
    int format = 1;
    std::string tuning = "bend";
    double budget = 200e6;
};

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
    LoadedPattern loaded;
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
    Humaniser(NoteSink& sink, double amount, std::uint64_t seed) : sink_(sink), amount_(amount), seed_(seed) {}
    void notes(std::span<const Note> notes) override {
        changed_.assign(notes.begin(), notes.end());
        for (Note& note : changed_) {
            // From the note's place alone: a piece from the middle sounds as it does in the whole.
            const std::uint64_t chance = scrambled(seed_ ^ scrambled(static_cast<std::uint64_t>(note.onset) * 16 +
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
    std::vector<Note> changed_;
};

/// Only counts.
class Nobody : public NoteSink {
public:
    void notes(std::span<const Note>) override {}
    void finish(std::int64_t) override {}
};

class FileBytes : public ByteSink {
public:
    explicit FileBytes(OutputFile& file) : file_(file) {}
    void write(std::string_view bytes) override {
        if (file_.can_insert()) {
            file_.write(bytes);
        } else {
            waiting_ += bytes;  // a pipe cannot go back
        }
    }
    void overwrite(std::uint64_t position, std::string_view bytes) override {
        if (file_.can_insert()) {
            file_.overwrite(position, bytes);
        } else {
            waiting_.replace(position, bytes.size(), bytes);
        }
    }
    void finish() {
        if (!waiting_.empty()) file_.write(waiting_);
    }

private:
    OutputFile& file_;
    std::string waiting_;
};

std::string read_file_near(const std::filesystem::path& folder, const std::string& name) {
    std::error_code error;
    std::filesystem::path path = folder / name;
    if (!std::filesystem::is_regular_file(path, error)) path = name;
    std::ifstream stream(path, std::ios::binary);
    std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    if (!stream || text.empty()) throw std::runtime_error(fmt::format("{}: this file cannot be read", name));
    if (text.size() > (std::size_t{1} << 20)) throw std::runtime_error(fmt::format("{}: over 1 MB", name));
    return text;
}

Player load_player(const Options& options, const std::string& name, bool quiet) {
    PatternOptions one = options.pattern;
    one.pattern = name;
    const auto keys = melody_keys();
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (!options.keys[i].empty()) {
            one.more.push_back({"--" + std::string(keys[i]), std::string(keys[i]), options.keys[i]});
        }
    }
    Player player{load(one, quiet), {}, 0};
    Diagnostics diagnostics;
    const std::filesystem::path folder =
        name == "-" ? std::filesystem::path() : std::filesystem::path(name).parent_path();
    player.melody = read_melody(
        player.loaded.pattern, [&](const std::string& file) { return read_file_near(folder, file); }, diagnostics);
    diagnostics.throw_if_errors();
    player.melody.transpose = options.transpose;
    return player;
}

std::string made_with(const Options& options, const std::vector<Player>& players) {
    std::string text = fmt::format("sikku {}, -n {}", SIKKU_VERSION, players.front().loaded.grammar.steps());
    if (!options.pattern.variant.empty()) text += " --variant " + options.pattern.variant;
    for (const std::string& setting : options.pattern.settings) text += fmt::format(" --set '{}'", setting);
    const auto keys = melody_keys();
    for (std::size_t i = 0; i < keys.size(); ++i) {
        if (!options.keys[i].empty()) text += fmt::format(" --{} '{}'", keys[i], options.keys[i]);
    }
    if (options.from_bar != 1) text += fmt::format(" --from-bar {}", options.from_bar);
    if (options.bars != 0) text += fmt::format(" --bars {}", options.bars);
    if (options.seconds != 0) text += fmt::format(" --seconds {}", options.seconds);
    if (options.transpose != 0) text += fmt::format(" --transpose {}", options.transpose);
    if (options.humanise != 0) text += fmt::format(" --humanise {} --seed {}", options.humanise, options.seed);
    return text;
}

/// The piece that is wanted, in ticks.
PlayOptions piece_of(const Options& options, const Melody& melody) {
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
    if (!has_brackets(player.loaded.grammar)) {
        if (melody.mapping == Mapping::counterpoint) return 2;
        return melody.mapping == Mapping::runs && melody.vertical == Vertical::voice ? 2 : 1;
    }
    Nobody nobody;
    return std::max(1, play(player.loaded.grammar, melody, nobody, playing).voices);
}

ScoreHead head_of(const Options& options, std::vector<Player>& players, const PlayOptions& playing) {
    ScoreHead head;
    const Melody& first = players.front().melody;
    head.tempo = first.tempo;
    head.meter = first.meter;
    head.made = made_with(options, players);
    int voices = 0;
    for (Player& player : players) {
        const Pattern& pattern = player.loaded.pattern;
        const Melody& melody = player.melody;
        const std::string title = pattern.text("title");
        head.title += (head.title.empty() || title.empty() ? "" : ", ") + title;
        if (head.composer.empty()) head.composer = pattern.text("source");
        if (!head.pattern.empty()) head.pattern += '\n';
        head.pattern += pattern.source->text();
        Part part;
        part.name = instrument_names()[static_cast<std::size_t>(melody.program)];
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

/// What the fold knows, without a note being played.
void tell_census(const std::vector<Player>& players) {
    for (const Player& player : players) {
        const auto known = census(player.loaded.grammar, player.melody);
        const std::string title = player.loaded.pattern.text("title");
        fmt::print("{}, n = {}\n", title.empty() ? "(untitled)" : printable(title), player.loaded.grammar.steps());
        if (!known) {
            fmt::print("Only playing tells how many notes there are.\n");
            continue;
        }
        const double ticks = known->ticks.convert_to<double>();
        const Integer bars = (known->ticks + player.melody.meter.bar() - 1) / player.melody.meter.bar();
        fmt::print("notes     {}\nbars      {}\ntime      {}\nheight    {} degrees\n", known->notes.str(), bars.str(),
                   time_text(ticks / static_cast<double>(ticks_per_quarter) * 60 / player.melody.tempo),
                   known->height.str());
    }
}

/// Plays all parts into `sink`; tells on standard error what became of them.
void play_all(const std::vector<Player>& players, const PlayOptions& playing, NoteSink& sink, bool quiet) {
    std::int64_t end = 0;
    PlayReport all;
    for (const Player& player : players) {
        PartSink part(sink, player.first_voice);
        const PlayReport report = play(player.loaded.grammar, player.melody, part, playing);
        if (report.notes == 0) {
            const bool is_runs = player.melody.mapping == Mapping::runs;
            throw ScoreError(fmt::format("there is no note{}{}",
                                         playing.from > 0 || playing.to < INT64_MAX ? " in this piece" : "",
                                         is_runs ? ": the curve has no horizontal run there. `--vertical voice` or "
                                                   "`glissando`, another `--set heading=…`, `--sloped project` or "
                                                   "`--mapping symbols` finds some"
                                                 : ""));
        }
        all.notes += report.notes;
        all.moved += report.moved;
        all.lost += report.lost;
        all.lowest = std::min(all.lowest, report.lowest);
        all.highest = std::max(all.highest, report.highest);
        end = std::max(end, report.end);
    }
    sink.finish(end);
    if (quiet) return;
    const Melody& first = players.front().melody;
    const auto spelling = spell(first.scale, first.tonic_spelling);
    const double seconds = static_cast<double>(end) / static_cast<double>(ticks_per_quarter) * 60 / first.tempo;
    tell("{} notes, {} bars, {}, {} to {}\n", all.notes, (end + first.meter.bar() - 1) / first.meter.bar(),
         time_text(seconds), note_name(all.lowest, spelling), note_name(all.highest, spelling));
    if (all.moved > 0) {
        tell("sikku: warning: {} notes were beyond the keys of MIDI and were {}\n", all.moved,
             first.range == Range::fold      ? "folded back by octaves"
             : first.range == Range::reflect ? "reflected"
                                             : "held at the last key");
    }
    if (all.lost > 0)
        tell("sikku: warning: {} notes are too short for a tick, or have no key, and are left out\n", all.lost);
}

void run(const Options& options, bool quiet) {
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
    std::vector<Player> players;
    for (const std::string& name : options.patterns) players.push_back(load_player(options, name, quiet));
    if (!known_format) return tell_census(players);
    const ScoreFormat format = *known_format;

    PlayOptions playing = piece_of(options, players.front().melody);
    playing.budget = options.budget;
    Progress progress(0, quiet);
    playing.watch = progress.watch();
    MidiOptions midi;
    midi.format = options.format;
    midi.tuning = options.tuning == "mts" ? Tuning::mts : Tuning::bend;
    const bool as_midi = format == ScoreFormat::midi || format == ScoreFormat::wav || format == ScoreFormat::flac;
    for (const Player& player : players) {
        midi.microtonal = midi.microtonal || player.melody.is_microtonal();
        if (!as_midi || playing.to < INT64_MAX) continue;
        const auto known = census(player.loaded.grammar, player.melody);
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
    const auto play_into = [&](NoteSink& sink) {
        Humaniser human(sink, options.humanise, options.seed);
        play_all(players, playing, options.humanise > 0 ? static_cast<NoteSink&>(human) : sink, quiet);
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
            if (format == ScoreFormat::musicxml) {
                write_musicxml(notator.notation(), head, bytes);
            } else {
                write_lilypond(notator.notation(), head, bytes);
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
            const std::filesystem::path beside = output.temporary().string() + ".mid";
            {
                OutputFile file(beside);
                FileBytes midi_bytes(file);
                const auto writer = write_midi(head, midi_bytes, midi);
                play_into(*writer);
                file.commit();
            }
            const auto remove = [&] {
                std::error_code error;
                std::filesystem::remove(beside, error);
            };
            try {
                render_audio(beside, output.temporary(),
                             format == ScoreFormat::wav ? AudioFormat::wav : AudioFormat::flac, [](double) {
                                 if (interrupted()) throw Interrupted();
                             });
            } catch (...) {
                remove();
                throw;
            }
            remove();
            break;
        }
    }
    bytes.finish();
    output.commit();
}

}  // namespace

void add_play(CLI::App& app, bool& quiet) {
    auto* command = app.add_subcommand("play", "Play a curve: MIDI, MusicXML, LilyPond, sound, a page that plays");
    auto options = std::make_shared<Options>();
    command
        ->add_option("PATTERN", options->patterns,
                     "Pattern files, names of those that come along, or -; several become tracks of one score")
        ->required();
    add_override_options(*command, options->pattern);
    command->add_option("-o,--output", options->output,
                        "The file: .mid, .musicxml, .ly, .wav, .flac, .svg or .html; without it, the number of notes "
                        "and the time are told");
    static const std::map<std::string_view, const char*> help = {
        {"scale", "A scale by name (`sikku scales` lists them), or a .scl file"},
        {"keyboard", "A Scala key map, .kbm"},
        {"tonic", "The note of degree 0: C4, F#3, Bb, or a frequency"},
        {"anchor", "Which y sounds the tonic: first note, lowest note, lowest vertex, centre"},
        {"unit", "The length of a step: 1/16 to 1/1"},
        {"vertical", "Vertical runs: ignore, rest, extend, glissando, voice"},
        {"runs", "merged, or each step"},
        {"sloped", "Runs that slope: project, skip, refuse"},
        {"range", "Notes beyond the keys of MIDI: fold, reflect, clamp, refuse"},
        {"tempo", "Quarter notes a minute"},
        {"meter", "Such as 4/4"},
        {"velocity", "fixed, by turn, by depth, by length"},
        {"mapping", "runs, counterpoint, symbols"},
        {"instrument", "A General MIDI instrument by name or number (1 to 128)"}};
    const auto keys = melody_keys();
    for (std::size_t i = 0; i < keys.size(); ++i) {
        command->add_option("--" + std::string(keys[i]), options->keys[i], help.at(keys[i]))->type_name("VALUE");
    }
    command->add_option("--from-bar", options->from_bar, "Begin at this bar, counted from 1")
        ->check(CLI::Range(std::int64_t{1}, INT64_MAX));
    command->add_option("--bars", options->bars, "So many bars")->check(CLI::Range(std::int64_t{1}, INT64_MAX));
    command->add_option("--seconds", options->seconds, "At most so long");
    command->add_option("--transpose", options->transpose, "Semitones, added to every note");
    command->add_option("--humanise", options->humanise, "0 to 1: how far from exact a player is");
    command->add_option("--seed", options->seed, "Of --humanise")->capture_default_str();
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
        "  sikku play hilbert -n 40 --from-bar 1000000000 --bars 16 -o piece.musicxml");
    command->callback([options, &quiet] { run(*options, quiet); });
}

}  // namespace sikku
