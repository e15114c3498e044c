#include "music/play_settings.h"

#include "engine/base/diagnostic.h"
#include "engine/base/keys.h"

#include <charconv>
#include <string>
#include <string_view>
#include <system_error>

namespace sikku {
namespace {

[[noreturn]] void refuse(const char* option, const std::string& value, const std::string& message) {
    throw SettingError(option, value, message);
}

double to_number(const std::string& text) {
    double value = 0;
    read_number(text, value);  // the table has checked it
    return value;
}

template <typename Whole>
void set_whole(const char* option, const std::string& text, Whole& value) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) refuse(option, text, "too large");
}

using S = PlaySettings;
using Text = const std::string&;
using enum OptionKind;

void set_key(S& settings, std::string_view name, const std::string& text) {
    settings.keys.push_back({std::string(name), std::string(name), text});
}

std::vector<Option<S>> make_table() {
    std::vector<Option<S>> table;
    static std::vector<std::string> help;  // owns the texts of string_views
    const auto keys = keys_of(KeyOwner::music);
    help.reserve(keys.size());
    for (const std::string_view name : keys) {
        const KeyInfo& key = *find_language_key(name);
        help.push_back(std::string(key.help) + ": " + std::string(key.values));
        table.push_back({{.name = name, .help = help.back(), .value = "VALUE", .group = "Melody", .is_key = true},
                         nullptr,
                         set_key});
    }
    const std::vector<Option<S>> own = {
        {{.name = "from-bar", .help = "first bar, counted from 1 (1)", .value = "BAR", .kind = whole, .least = 1},
         [](S& s, Text t) { set_whole("from-bar", t, s.from_bar); }},
        {{.name = "bars", .help = "number of bars (all)", .value = "BARS", .kind = whole, .least = 1},
         [](S& s, Text t) { set_whole("bars", t, s.bars); }},
        {{.name = "seconds",
          .help = "maximum length in seconds (all)",
          .value = "SECONDS",
          .kind = number,
          .least = 0},
         [](S& s, Text t) { s.seconds = to_number(t); }},
        {{.name = "transpose",
          .help = "semitones added to every note, -127 to 127 (0)",
          .value = "SEMITONES",
          .kind = number,
          .least = -127,
          .most = 127},
         [](S& s, Text t) { s.transpose = to_number(t); }},
        {{.name = "humanise",
          .help = "deviation from exact onsets and velocities, 0 to 1 (0); the random seed selects another player",
          .value = "AMOUNT",
          .kind = number,
          .least = 0,
          .most = 1},
         [](S& s, Text t) { s.humanise = to_number(t); }},
        {{.name = "seed", .help = "random seed of the pattern and of humanise (0)", .value = "N", .kind = whole},
         [](S& s, Text t) { set_whole("seed", t, s.seed); }},
        {{.name = "midi-format",
          .help = "1: a track for each voice; or 0 (1)",
          .value = "0|1",
          .kind = whole,
          .most = 1},
         [](S& s, Text t) { set_whole("midi-format", t, s.format); }},
        {{.name = "tuning",
          .help = "microtones by pitch bend or by the MIDI Tuning Standard: bend or mts (bend)",
          .value = "bend|mts"},
         [](S& s, Text t) {
             if (t != "bend" && t != "mts") refuse("tuning", t, "expected bend or mts");
             s.tuning = t == "mts" ? Tuning::mts : Tuning::bend;
         }},
        {{.name = "budget",
          .help = "maximum number of derivation nodes visited (2e8)",
          .value = "NODES",
          .kind = number},
         [](S& s, Text t) {
             s.budget = to_number(t);
             if (!(s.budget > 0)) refuse("budget", t, "expected a number above 0");
         }},
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
    return settings;
}

}  // namespace sikku
