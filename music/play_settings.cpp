#include "music/play_settings.h"

#include "engine/base/diagnostic.h"
#include "engine/base/keys.h"
#include "engine/interpreter.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>

namespace sikku {
namespace {

using S = PlaySettings;
using Text = const std::string&;
using enum OptionKind;

void set_key(S& settings, std::string_view name, const std::string& text) {
    std::string key(name);
    std::replace(key.begin(), key.end(), '-', ' ');
    settings.keys.push_back({std::string(name), std::move(key), text});
}

std::vector<Option<S>> make_table() {
    std::vector<Option<S>> table;
    for (const std::string_view name : keys_of(KeyOwner::music)) {
        table.push_back({key_option(name, "Melody", false), nullptr, set_key});
    }
    const std::vector<Option<S>> own = {
        {{.name = "from-bar",
          .help = "first bar, counted from 1 (1)",
          .value = "BAR",
          .kind = whole,
          .least = 1,
          .neutral = "1"},
         [](S& s, Text t) { read_whole("from-bar", t, s.from_bar); }},
        {{.name = "bars", .help = "number of bars (all)", .value = "BARS", .kind = whole, .least = 1},
         [](S& s, Text t) { read_whole("bars", t, s.bars); }},
        {{.name = "seconds",
          .help = "maximum length in seconds (all)",
          .value = "SECONDS",
          .unit = "s",
          .kind = number,
          .least = 0},
         [](S& s, Text t) {
             s.seconds = to_number(t);
             if (!(s.seconds > 0)) refuse_option("seconds", t, "expected a number above 0");
         }},
        {{.name = "transpose",
          .help = "semitones added to every note, -127 to 127 (0)",
          .value = "SEMITONES",
          .kind = number,
          .least = -127,
          .most = 127,
          .neutral = "0"},
         [](S& s, Text t) { s.transpose = to_number(t); }},
        {{.name = "humanise",
          .help = "deviation from exact onsets and velocities, 0 to 1 (0); the random seed selects another player",
          .value = "AMOUNT",
          .kind = number,
          .least = 0,
          .most = 1,
          .neutral = "0"},
         [](S& s, Text t) { s.humanise = to_number(t); }},
        {{.name = "seed", .help = "random seed of the pattern and of humanise (0)", .value = "N", .kind = whole},
         [](S& s, Text t) { read_whole("seed", t, s.seed); }},
        {{.name = "score",
          .help =
              "print of clarinets, horns and other transposing instruments: transposed (as it is read) or concert "
              "(as it sounds) (transposed)",
          .value = "transposed|concert",
          .neutral = "transposed"},
         [](S& s, Text t) {
             if (t != "transposed" && t != "concert") refuse_option("score", t, "expected transposed or concert");
             s.is_transposed = t == "transposed";
         }},
        {{.name = "syllables",
          .help =
              "degrees of the scale under the notes of a print: sargam (S R G), degrees (1 2 3), solfa (do re mi), "
              "none (none)",
          .value = "KIND",
          .neutral = "none"},
         [](S& s, Text t) {
             constexpr std::array<std::string_view, 4> names = {"none", "sargam", "degrees", "solfa"};
             const auto* name = std::find(names.begin(), names.end(), t);
             if (name == names.end()) refuse_option("syllables", t, "expected sargam, degrees, solfa or none");
             s.syllables = static_cast<Syllables>(name - names.begin());
         }},
        {{.name = "chord-symbols",
          .help = "name the chords of triads and progressions above the first staff of a print",
          .kind = flag},
         [](S& s, Text t) { s.has_chord_signs = t == "true"; }},
        {{.name = "grace-notes",
          .help =
              "print kampitas and jarus as grace notes: the degree above, or the note from which the pitch slides",
          .kind = flag},
         [](S& s, Text t) { s.has_graces = t == "true"; }},
        {{.name = "repeats",
          .help = "print repeat signs for passages of four bars or more that are played twice or more in a row, with "
                  "first and second endings where the ends differ",
          .kind = flag},
         [](S& s, Text t) { s.has_repeats = t == "true"; }},
        {{.name = "parts",
          .help = "also print a part for each player, in files beside the score such as NAME-1-flute.pdf",
          .kind = flag,
          .is_alone = true},
         [](S& s, Text t) { s.has_parts = t == "true"; }},
        {{.name = "midi-format",
          .help = "0: a single track; 1: a track for each voice (1)",
          .value = "0|1",
          .kind = whole,
          .most = 1,
          .neutral = "1"},
         [](S& s, Text t) { read_whole("midi-format", t, s.format); }},
        {{.name = "tuning",
          .help = "MIDI of microtones: bend (pitch bend), mts (MIDI Tuning Standard) or mpe (a channel for each "
                  "note) (bend)",
          .value = "bend|mts|mpe",
          .neutral = "bend"},
         [](S& s, Text t) {
             if (t != "bend" && t != "mts" && t != "mpe") refuse_option("tuning", t, "expected bend, mts or mpe");
             s.tuning = t == "mts" ? Tuning::mts : t == "mpe" ? Tuning::mpe : Tuning::bend;
         }},
        {budget_option, [](S& s, Text t) { s.budget = read_budget(t); }},
    };
    table.insert(table.end(), own.begin(), own.end());
    return table;
}

}  // namespace

std::span<const Option<PlaySettings>> play_options() {
    static const std::vector<Option<PlaySettings>> table = make_table();
    return table;
}

PlaySettings read_play_settings(const OptionValues& values) {
    PlaySettings settings;
    apply_options(play_options(), values, settings);
    settings.recipe = recipe_options(play_options(), without_keys(values, settings.keys));
    return settings;
}

}  // namespace sikku
