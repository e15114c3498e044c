#include "music/score_head.h"

#include "engine/interpreter.h"
#include "music/melody/symbol_table.h"
#include "music/score/instruments.h"
#include "music/score/spelling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sikku {
namespace {

// Programs of General MIDI, counted from 0.
constexpr int strings = 48;
constexpr int sitar = 104;

std::string made_with(const PlaySettings& settings, const Document& first, bool is_arrangement) {
    std::string made = recipe(first, settings.recipe);
    if (!is_arrangement) return made;
    // An arrangement contains the settings of its patterns.
    OptionValues keys;
    for (const Setting& key : settings.keys) keys.push_back({key.origin, key.value});
    const std::string text = recipe_options(play_options(), keys).text + settings.recipe.text;
    return made.substr(0, made.find(',')) + (text.empty() ? "" : ",") + text;
}

/// Adds the texts of a pattern.
void add_texts(const Player& player, std::vector<std::string>& titles, ScoreHead& head) {
    const Pattern& pattern = player.document.pattern();
    const std::string title = pattern.text("title");
    if (!title.empty() && std::find(titles.begin(), titles.end(), title) == titles.end()) titles.push_back(title);
    if (head.composer.empty()) head.composer = pattern.text("composer");
    if (head.source.empty()) head.source = pattern.text("source");
}

Part drum_part(const std::string& name, int voices, bool has_chords, const Swing& swing) {
    Part part;
    part.swing = swing;
    part.has_chords = has_chords;
    part.name = name.empty() ? "Drums" : name;
    part.is_drums = true;
    part.voices = voices;
    part.spelling = spell(*find_scale("major"), {});
    return part;
}

/// The part of the curve of a player.
Part part_of(const Player& player, const PlayOptions& playing) {
    const Melody& melody = player.melody;
    Part part;
    part.name = player.name.empty() ? instrument_of(melody.program).name : player.name;
    part.has_instrument_name = player.name.empty();
    part.scale = scale_of(melody);
    part.program = melody.program;
    part.key = key_signature(melody.scale, melody.tonic_spelling);
    part.spelling = spell(melody.scale, melody.tonic_spelling);
    part.signature = print_signature(melody.scale, melody.tonic_spelling);
    part.voices = voices_of(player, playing);
    part.has_chords = melody.table.most_notes() > 1;
    part.swing = player.printed_swing;
    part.touch = player.printed_touch;
    part.tonic = melody.tonic + melody.transpose;
    return part;
}

/// The part of the drone or the chords of a player, from that of its curve.
Part accompaniment_of(Part part, const Melody& melody) {
    part.has_chords = false;
    part.swing = {};
    part.touch = {};
    part.is_accompaniment = true;
    part.voices = melody.accompanying_voices();
    part.program = melody.harmony == Harmony::drone ? sitar : melody.accompanist.value_or(strings);
    part.name = instrument_of(part.program).name;
    part.has_instrument_name = true;
    return part;
}

struct VoiceCount {
    int all = 0;
    int pitched = 0;  ///< all but the drums
};

/// Numbers the voices of a player after those of the players before it, and adds its parts.
void add_parts(Player& player, const PlayOptions& playing, VoiceCount& voices, std::vector<Part>& parts) {
    const Melody& melody = player.melody;
    player.first_voice = voices.all;
    const Part part = part_of(player, playing);
    const SoundKinds sounds = sound_kinds(player.document.grammar(), melody);
    const int accompanying = melody.accompanying_voices();
    // Drums alone are the only part of their pattern.
    const bool is_drums_alone = sounds.has_drums && !sounds.has_pitches && accompanying == 0;
    player.has_drums = sounds.has_drums;
    player.chords_from = part.voices;
    player.drums_from = is_drums_alone ? 0 : part.voices + accompanying;
    voices.all += player.drums_from + (sounds.has_drums ? part.voices : 0);
    voices.pitched += player.drums_from;
    if (voices.all > most_voices)
        throw ScoreError(fmt::format("too many voices: a score has at most {}", most_voices));
    if (!is_drums_alone) parts.push_back(part);
    if (accompanying > 0) parts.push_back(accompaniment_of(part, melody));
    if (!sounds.has_drums) return;
    parts.push_back(drum_part(is_drums_alone ? player.name : "", part.voices, part.has_chords, part.swing));
}

/// The keys of the sections within a piece.
/// @param keys  of the first pitched part of each section; 0: of those that play from the beginning
std::vector<KeyChange> section_keys(const Ensemble& ensemble, const PlayOptions& playing,
                                    const std::map<char, std::optional<KeySignature>>& keys) {
    std::vector<KeyChange> result;
    for (const SectionStart& start : ensemble.sections) {
        if (start.onset >= playing.to) break;
        auto key = keys.find(start.section);
        if (key == keys.end()) key = keys.find(0);
        if (start.onset <= playing.from) result.clear();
        result.push_back(
            {std::max<std::int64_t>(0, start.onset - playing.from), key == keys.end() ? std::nullopt : key->second});
    }
    return result;
}

}  // namespace

ScoreHead head_of(const PlaySettings& settings, Ensemble& ensemble, const Arrangement* arrangement,
                  const PlayOptions& playing, int most) {
    ScoreHead head;
    const TempoAndMeter first = ensemble.tempo_and_meter(playing.from);
    head.tempo = first.tempo;
    head.tempo_words = first.tempo_words;
    head.meter = first.meter;
    if (playing.from == 0 && playing.ahead == 0) head.upbeat = ensemble.upbeat;
    head.changes = changes_after(ensemble.changes, playing.from);
    if (playing.to < INT64_MAX) {
        std::erase_if(head.changes,
                      [&](const SectionChange& change) { return change.onset >= playing.to - playing.from; });
    }
    head.ritardando = ensemble.has_ending(playing) ? ensemble.ritardando(playing) : 0;
    head.is_transposed = settings.is_transposed;
    head.syllables = settings.syllables;
    head.has_chord_signs = settings.has_chord_signs;
    head.has_graces = settings.has_graces;
    head.first_bar = settings.from_bar;
    head.made = made_with(settings, ensemble.players.front().document, arrangement != nullptr);
    if (arrangement) {
        head.title = arrangement->title;
        head.composer = arrangement->composer;
        head.source = arrangement->source;
    }
    head.pattern = arrangement ? arrangement->text : ensemble.players.front().document.source().text();
    PlayOptions counting = playing;
    counting.most_voices = most_voices;
    if (ensemble.needs_whole()) {
        counting.from = 0;
        counting.to = INT64_MAX;
    }
    std::vector<std::string> titles;
    std::map<char, std::optional<KeySignature>> keys;  // by section
    VoiceCount voices;
    for (Player& player : ensemble.players) {
        if (!player.is_bass) add_texts(player, titles, head);
        const std::size_t first_part = head.parts.size();
        add_parts(player, counting, voices, head.parts);
        const Part& own = head.parts[first_part];
        // Scales without a key of their own, such as blues, have the signs of print.
        if (!own.is_drums) keys.try_emplace(player.section, own.key ? own.key : own.signature);
    }
    head.keys = section_keys(ensemble, playing, keys);
    if (voices.pitched > most) {
        throw ScoreError(
            fmt::format("too many voices: {} at once; {} need a MIDI channel for each voice; there are {} besides "
                        "drums",
                        voices.pitched,
                        ensemble.has_glides()  ? "glissandi"
                        : ensemble.has_bends() ? "gamakas"
                                               : "notes between the keys",
                        most_channels));
    }
    if (head.title.empty()) head.title = fmt::format("{}", fmt::join(titles, ", "));
    return head;
}

int pitched_voices(const ScoreHead& head) {
    int voices = 0;
    for (const Part& part : head.parts) voices += part.is_drums ? 0 : part.voices;
    return voices;
}

}  // namespace sikku
