#include "music/players.h"

#include "engine/base/diagnostic.h"
#include "engine/base/input_file.h"
#include "engine/base/keys.h"
#include "engine/base/text.h"
#include "engine/interpreter.h"
#include "music/score/curves.h"
#include "music/score/spelling.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <utility>

namespace sikku {
namespace {

constexpr int acoustic_bass = 32;  // program of General MIDI, counted from 0

/// @param first, then  folders to search, in this order
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

/// Length of a melody in ticks, by composition or otherwise by playing it. @throws BudgetError
Integer length_of(const Grammar& grammar, const Melody& melody) {
    if (const auto known = census(grammar, melody)) return known->ticks;
    NullSink nobody;
    return play(grammar, melody, nobody, {}).end;
}

/// Duration in words, with the ritardando.
std::string slowing_time_of(std::int64_t ticks, const Melody& melody) {
    ScoreHead head;
    head.ritardando = 2 * melody.meter.bar();
    return time_text(seconds_at(ticks, melody.tempo, tempo_map(head, {}, ticks)));
}

/// The title of a pattern, or the name of its file.
std::string name_of(const Document& document) {
    const std::string title = document.text("title");
    const std::string file = std::filesystem::path(document.source().name()).stem().string();
    return !title.empty() ? printable(title) : file.empty() || file == "-" ? "(untitled)" : printable(file);
}

}  // namespace

void check_phrases(const Pattern& pattern, const Grammar& grammar, Diagnostics& diagnostics) {
    Diagnostics known;  // reported by read_melody() before
    const Melody melody = read_melody(pattern, {}, known);
    const std::string problem = known.has_errors() ? std::string() : problem_of(grammar, melody);
    if (problem.empty()) return;
    for (const std::string_view name : {"phrases", "form", "cadence"}) {
        const Key* key = pattern.find(name);
        const std::string value = key ? lower_case(key->value.view()) : "none";
        if (value != "none" && value != "curve") return diagnostics.error(key->name_at, problem);
    }
    for (const std::string_view name : keys_of(KeyOwner::music)) {
        const Key* key = pattern.find(name);
        if (key && key->value.view().find("level") != std::string_view::npos) {
            return diagnostics.error(key->name_at, problem);
        }
    }
}

Player bass_of(const Player& player) {
    Player bass = player;
    const Melody& melody = player.melody;
    const bool has_voices = melody.branches == Branches::voices && has_brackets(player.document.grammar());
    if (has_voices || melody.own_voices() > 1 || !melody.table.empty()) {
        throw ScoreError(
            "`harmony: bass` needs a curve or a word of a single line, without branches or vertical runs as voices, "
            "counterpoint or a table of symbols");
    }
    const std::int64_t steps = player.document.grammar().steps() - melody.bass_order;
    if (steps < 1) {
        throw ScoreError(fmt::format("`harmony: bass {}` needs a derivation length of at least {}", melody.bass_order,
                                     melody.bass_order + 1));
    }
    bass.document = player.document.with({{"derivation length", "derivation length", std::to_string(steps)}});
    bass.is_bass = true;
    bass.warnings.clear();
    bass.name.clear();
    bass.printed_swing = {};
    bass.melody.harmony = Harmony::none;
    bass.melody.cadence = Cadence::none;
    bass.melody.articulation = Articulation::legato;
    bass.melody.rhythm = {};
    bass.melody.rhythms = {};
    bass.melody.has_rhythms_by_level = false;
    bass.melody.layout.climax.reset();
    bass.melody.layout.thinning = 0;
    bass.melody.leaps = 0;
    bass.melody.swing = 0.5;
    bass.melody.program = acoustic_bass;
    bass.melody.phrase_order = std::max<std::int64_t>(0, melody.phrase_order - melody.bass_order);
    if (!melody.layout.form.empty() && melody.phrase_order > 0 && bass.melody.phrase_order == 0) {
        throw ScoreError(
            fmt::format("`harmony: bass {}` needs sections of a form that are sub-curves of order {} or more",
                        melody.bass_order, melody.bass_order + 1));
    }
    constexpr double two_octaves = 24;
    transpose(bass.melody, -two_octaves);
    bass.melody.lowest = std::max(0.0, melody.lowest - two_octaves);
    bass.melody.highest = std::max(0.0, melody.highest - two_octaves);
    // If both breathe, they breathe equally often.
    Melody whole = melody;
    whole.layout.upbeat = 0;
    if (bass.melody.phrase_order > 0) {
        whole.breath = 0;
        whole.breathes_to_bar = false;
    }
    Melody plain = bass.melody;
    plain.layout.upbeat = 0;
    plain.breath = 0;
    plain.breathes_to_bar = false;
    const Integer own = length_of(player.document.grammar(), whole);
    const Integer coarse = length_of(bass.document.grammar(), plain);
    if (coarse == 0) throw ScoreError("`harmony: bass`: the curve of the lower order has no notes");
    const Integer ratio = (own + coarse / 2) / coarse;
    constexpr std::int64_t longest = std::int64_t{1} << 40;
    if (ratio > longest / melody.unit)
        throw ScoreError("the notes of the bass would be too long: a lower order is needed");
    bass.melody.unit *= std::max<std::int64_t>(1, ratio.convert_to<std::int64_t>());
    bass.playable = std::make_shared<PlayableMelody>(bass.document.shared_grammar(), bass.melody);
    return bass;
}

std::vector<Player> followers_of(const Player& player) {
    std::vector<Player> followers;
    for (const Follower& one : player.melody.layout.canon) {
        Player follower = player;
        follower.warnings.clear();
        follower.is_follower = true;
        follower.melody.layout.canon.clear();
        Melody& melody = follower.melody;
        melody.layout.start += one.bars;
        // It repeats the notes of the part, including those moved by chords and range.
        melody.is_accompanied = false;
        if (!melody.has_chords()) melody.harmony = Harmony::none;
        melody.answer += one.degrees;
        melody.lowest = std::clamp(melody.lowest + one.semitones, 0.0, 127.0);
        melody.highest = std::clamp(melody.highest + one.semitones, 0.0, 127.0);
        transpose(melody, one.semitones);
        followers.push_back(std::move(follower));
    }
    return followers;
}

Player read_player(const PlaySettings& settings, const Document& given, const std::filesystem::path& folder,
                   const FileWitness& witness) {
    require_turtle(given, "it has no melody");
    Player player{given, {}, 0, 0, 0, false, false, false, 0, {}, {}, {}, {}, {}};
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
    player.playable = std::make_shared<PlayableMelody>(player.document.shared_grammar(), player.melody);
    return player;
}

int voices_of(const Player& player, const PlayOptions& playing) {
    const Melody& melody = player.melody;
    if (melody.branches != Branches::voices || !has_brackets(player.document.grammar())) {
        return melody.own_voices();
    }
    NullSink nobody;
    return std::max(1, player.play(nobody, playing).voices);
}

std::string scale_of(const Melody& melody) {
    const auto spelling = spell(melody.scale, melody.tonic_spelling);
    return fmt::format("{} from {}", melody.scale.title, note_name(melody.tonic + melody.transpose, spelling));
}

std::string reason_of_silence(const Player& player, std::uint64_t lost) {
    const Melody& melody = player.melody;
    if (lost > 0) return ": every note is shorter than a tick, or has no key in the key map";
    if (const std::string no_steps = reason_of_no_steps(player.document); !no_steps.empty()) return ": " + no_steps;
    const Grammar& grammar = player.document.grammar();
    const std::vector<char> reached = grammar.reachable();
    const auto moves = [&](Symbol symbol) {
        const Action action = grammar.symbols()[symbol].command.action;
        return reached[symbol] != 0 && (action == Action::draw || action == Action::move);
    };
    bool has_steps = false;
    for (Symbol symbol = 0; symbol < reached.size(); ++symbol) has_steps = has_steps || moves(symbol);
    if (!has_steps && melody.table.empty()) return ": the word has no steps such as F";
    if (melody.mapping == Mapping::symbols && !melody.table.empty())
        return ": no symbol of the word sounds; rows such as `note A: C4` name those that do";
    if (melody.rhythm.has_chance())
        return ": chance silences all of them; another `seed` or a higher percentage helps";
    if (melody.mapping != Mapping::runs) return {};
    return std::string(": the curve has no horizontal run there") +
           (melody.vertical != Vertical::voice ? "; try `vertical: voice`, another `heading:` or `mapping: symbols`"
                                               : "");
}

bool has_excerpt(const Player& player) {
    return player.melody.layout.first_bar > 1 || player.melody.layout.bars > 0;
}

void cut_excerpt(const Player& player, PlayOptions& options) {
    const Layout& layout = player.melody.layout;
    const std::int64_t bar = player.melody.meter.bar();
    // The bar of an upbeat has no number, and belongs to the first bar.
    const std::int64_t before = layout.first_bar - 1 + (layout.upbeat > 0 ? 1 : 0);
    const std::int64_t first = layout.first_bar > 1 ? before * bar : 0;
    options.from += first;
    if (options.to < INT64_MAX) options.to += first;
    if (layout.bars > 0) options.to = std::min(options.to, (before + layout.bars) * bar);
}

Integer bars_of(const Integer& ticks, const Meter& meter) {
    return (ticks + meter.bar() - 1) / meter.bar();
}

Integer last_bar(const Integer& ticks, const Melody& melody) {
    return bars_of(ticks, melody.meter) - (melody.layout.upbeat > 0 ? 1 : 0);
}

std::string time_of(const Integer& ticks, double tempo) {
    return time_text(ticks.convert_to<double>() / static_cast<double>(ticks_per_quarter) * 60 / tempo);
}

std::string range_of(const PlayReport& report, const Melody& melody) {
    if (report.lowest > report.highest) return "drums";
    const auto spelling = spell(melody.scale, melody.tonic_spelling);
    return fmt::format("{} to {}", note_name(report.lowest, spelling), note_name(report.highest, spelling));
}

std::string skipped_text(const std::map<std::string, std::uint64_t>& skipped) {
    constexpr std::size_t most_named = 8;
    std::vector<std::pair<std::string, std::uint64_t>> counts(skipped.begin(), skipped.end());
    std::stable_sort(counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
    std::string text;
    for (std::size_t i = 0; i < std::min(counts.size(), most_named); ++i) {
        text += fmt::format("{}{} {}", i > 0 ? ", " : "", counts[i].second, printable(counts[i].first));
    }
    if (counts.size() > most_named) text += fmt::format(" and {} other symbols", counts.size() - most_named);
    return text;
}

std::string description(const std::vector<Player>& players, const PlayOptions& piece, bool is_whole,
                        const PlayAlone& play_whole) {
    PlayOptions playing = piece;
    playing.budget = std::min(piece.budget, 20e6);
    std::string text;
    for (const Player& player : players) {
        if (player.is_bass) continue;
        const Melody& melody = player.melody;
        const bool is_arranged = melody.layout.needs_whole();
        const bool is_all = is_whole && !has_excerpt(player) && !is_arranged;
        const auto known = is_all ? census(player.document.grammar(), melody) : std::nullopt;
        std::optional<PlayReport> played;
        PlayOptions of_part = playing;
        of_part.from += player.melody.begin();
        if (of_part.to < INT64_MAX) of_part.to += player.melody.begin();
        cut_excerpt(player, of_part);
        try {
            NullSink nobody;
            played = is_arranged ? play_whole(player) : player.play(nobody, of_part);
        } catch (const BudgetError&) {
            if (!known) throw;
        }
        const auto out = std::back_inserter(text);
        fmt::format_to(out, "{}, n = {}\n", name_of(player.document), player.document.grammar().steps());
        const std::string notes = played              ? std::to_string(played->notes)
                                  : known->has_chance ? "at most " + known->notes.str()
                                                      : known->notes.str();
        const Integer ticks = played ? Integer(played->end) : known->ticks - melody.begin();
        // The bar of an upbeat has no number.
        const std::int64_t upbeat = piece.from == 0 ? melody.layout.opening() : 0;
        // Several parts slow down together.
        const bool slows = melody.close != Close::none && players.size() == 1 && ticks < (Integer(1) << 50);
        fmt::format_to(
            out, "scale     {}\nnotes     {}\nbars      {}\ntime      {}\n", scale_of(melody), notes,
            bars_of(ticks - upbeat, melody.meter).str(),
            slows ? slowing_time_of(ticks.convert_to<std::int64_t>(), melody) : time_of(ticks, melody.tempo));
        if (played && played->notes > 0) fmt::format_to(out, "range     {}\n", range_of(*played, melody));
        if (played && played->notes == 0) {
            fmt::format_to(out, "the melody contains no notes{}\n", reason_of_silence(player, played->lost));
        }
        if (played && !played->skipped.empty()) {
            fmt::format_to(out, "no sound  {}\n", skipped_text(played->skipped));
        }
        if (known) fmt::format_to(out, "height    {}\n", counted(known->height.str(), "degree"));
    }
    return text;
}

}  // namespace sikku
