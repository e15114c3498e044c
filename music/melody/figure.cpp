#include "music/melody/figure.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"
#include "music/score/rhythm.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstddef>
#include <optional>

namespace sikku {
namespace {

constexpr std::int64_t most_slots = 64;
constexpr std::array<std::string_view, 9> names = {"block", "oom-pah", "arpeggio",     "arpeggio down", "alberti",
                                                   "strum", "bossa",   "walking bass", "silent"};

std::optional<Figure::Tone> tone_of(char letter) {
    constexpr std::string_view letters = "acbluo35n";  // in the order of Figure::Tone
    const std::size_t at = letters.find(static_cast<char>(std::tolower(static_cast<unsigned char>(letter))));
    if (at == std::string_view::npos) return std::nullopt;
    return static_cast<Figure::Tone>(at);
}

/// Hyphens and blanks are alike in names.
std::string with_blanks(std::string_view name) {
    std::string result(name);
    std::replace(result.begin(), result.end(), '-', ' ');
    return result;
}

/// Slots of a bar by group: a strong beat begins each.
std::vector<std::int64_t> groups_in_slots(const Meter& meter, std::int64_t slots) {
    const std::vector<std::int64_t> strong = strong_beats(meter);
    const std::int64_t slot = meter.bar() / slots;
    std::vector<std::int64_t> groups;
    for (std::size_t i = 0; i < strong.size(); ++i) {
        const std::int64_t end = i + 1 < strong.size() ? strong[i + 1] : meter.bar();
        groups.push_back(std::max<std::int64_t>(1, (end - strong[i]) / slot));
    }
    return groups;
}

/// Repeats a text in each group, from its beginning.
std::string in_groups(const std::vector<std::int64_t>& groups, std::string_view text) {
    std::string result;
    for (const std::int64_t group : groups) {
        for (std::int64_t i = 0; i < group; ++i) result += text[static_cast<std::size_t>(i) % text.size()];
    }
    return result;
}

/// Eighths of a bar, or its beats if they are shorter.
std::int64_t eighths_of(const Meter& meter) {
    return meter.unit >= 8 ? meter.beats : 8 / meter.unit * meter.beats;
}

/// The strokes of a named figure; empty if the meter has none.
std::string strokes_of(std::string_view name, const Meter& meter) {
    if (name == "oom-pah") {
        std::string strokes;
        bool is_odd = false;
        for (const std::int64_t group : groups_in_slots(meter, meter.beats)) {
            strokes += (is_odd ? '5' : 'b') + std::string(static_cast<std::size_t>(group - 1), 'c');
            is_odd = !is_odd;
        }
        return strokes;
    }
    const std::vector<std::int64_t> groups = groups_in_slots(meter, eighths_of(meter));
    if (name == "arpeggio") return in_groups(groups, "bluoul");
    if (name == "arpeggio down") return in_groups(groups, "oulblu");
    if (name == "alberti") {
        const bool is_in_threes =
            std::all_of(groups.begin(), groups.end(), [](std::int64_t group) { return group % 3 == 0; });
        return in_groups(groups, is_in_threes ? "blu" : "bulu");
    }
    if (name == "walking bass") {
        std::string strokes = "b";
        for (int beat = 1; beat + 1 < meter.beats; ++beat) strokes += beat % 2 != 0 ? '3' : '5';
        return meter.beats > 1 ? strokes + 'n' : strokes;
    }
    const bool is_in_four = meter.bar() == 4 * ticks_per_quarter && !has_groups(meter);
    if (name == "strum") {
        if (is_in_four) return "A.ac.cac";
        std::string strokes = in_groups(groups, "ac");
        strokes.front() = 'A';
        return strokes;
    }
    return is_in_four ? "b..55..b & c..c..c." : "";  // bossa
}

/// The voices that a layer plays, as bits: bass, lower, upper.
unsigned voices_of(const Figure::Layer& layer) {
    static constexpr std::array<unsigned, 9> voices = {7, 6, 1, 2, 4, 4, 1, 1, 1};
    unsigned all = 0;
    for (const Figure::Stroke& stroke : layer.strokes) all |= voices[static_cast<std::size_t>(stroke.tone)];
    return all;
}

/// Reads one layer. @return false if it contains other letters
bool read_layer(std::string_view text, Figure::Layer& layer) {
    layer.slots = 0;
    bool sounds = false;
    for (const char letter : text) {
        if (letter == ' ' || letter == '|') continue;
        if (const auto tone = tone_of(letter)) {
            layer.strokes.push_back({layer.slots, 1, *tone, letter >= 'A' && letter <= 'Z'});
            sounds = true;
        } else if (letter == '~') {
            sounds = false;
        } else if (letter != '.') {
            return false;
        } else if (sounds) {
            ++layer.strokes.back().length;
        }
        ++layer.slots;
    }
    return true;
}

}  // namespace

Figure read_figure(std::string_view text, const Meter& meter, std::string& problem) {
    problem.clear();
    Figure figure;
    const auto* named = std::find_if(names.begin(), names.end(), [&](std::string_view one) {
        return with_blanks(one) == with_blanks(lower_case(text));
    });
    const std::string name(named == names.end() ? "" : *named);
    if (name == "block") return figure;
    figure.is_silent = name == "silent";
    if (figure.is_silent) return figure;
    const std::string strokes = name.empty() ? std::string(text) : strokes_of(name, meter);
    if (strokes.empty() && !name.empty()) {
        problem = fmt::format("{} needs a meter of four quarters without groups", name);
        return figure;
    }
    unsigned taken = 0;
    for (std::string_view rest = strokes;;) {
        const std::size_t end = std::min(rest.find('&'), rest.size());
        Figure::Layer& layer = figure.layers.emplace_back();
        if (!read_layer(rest.substr(0, end), layer)) {
            problem = fmt::format(
                "expected {}, or strokes such as bc5c with a (all), c (chord), b (bass), l, u (lower, upper), o "
                "(octave), 3, 5, n (next), . and ~{}",
                alternatives(names), did_you_mean(nearest(lower_case(text), {names.begin(), names.end()})));
            return figure;
        }
        if (layer.strokes.empty()) {
            problem = "a figure, and each of its layers, needs a stroke; `silent` plays none";
            return figure;
        }
        if (layer.slots > most_slots || meter.bar() % layer.slots != 0) {
            problem = name.empty() ? fmt::format("a bar cannot be divided into {} equal slots; expected at most {}",
                                                 layer.slots, most_slots)
                                   : fmt::format("{} needs a bar of at most {} eighths", name, most_slots);
            return figure;
        }
        const unsigned voices = voices_of(layer);
        if ((taken & voices) != 0) {
            static constexpr std::array<std::string_view, 3> voice_names = {"the bass", "the lower voice",
                                                                            "the upper voice"};
            problem = fmt::format(
                "layer {} and one before it play {}; a plays all voices, 3, 5 and n the bass, o the "
                "upper voice",
                figure.layers.size(), voice_names[static_cast<std::size_t>(std::countr_zero(taken & voices))]);
            return figure;
        }
        taken |= voices;
        if (end == rest.size()) return figure;
        rest.remove_prefix(end + 1);
    }
}

}  // namespace sikku
