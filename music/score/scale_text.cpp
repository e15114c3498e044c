#include "music/score/scale_text.h"

#include "engine/base/json_text.h"
#include "engine/base/text.h"
#include "music/score/spelling.h"
#include "music/score/text_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

namespace sikku {
namespace {

/// The shortest digits that reproduce the number, without -0.
JsonText json(double value) {
    return JsonText::raw(value == 0 ? "0" : fmt::format("{}", value));
}

/// The least number of equal steps in a period such that every note is one; 0 if more than 72 are needed.
int division_of(const Scale& scale) {
    const auto fits = [&](int division) {
        const auto is_step = [&](double cents) {
            const double step = cents * division / scale.period;
            return std::fabs(step - std::round(step)) < 1e-6;
        };
        return std::all_of(scale.ascent.begin(), scale.ascent.end(), is_step) &&
               std::all_of(scale.descent.begin(), scale.descent.end(), is_step);
    };
    if (scale.period == 1200.0 && fits(12)) return 12;
    for (int division = 1; division <= 72; ++division) {
        if (fits(division)) return division;
    }
    return 0;
}

/// The steps from each note to the next, and from the last to the period.
std::string steps_text(const Scale& scale, const std::vector<double>& notes) {
    const int division = division_of(scale);
    std::string text;
    for (std::size_t i = 0; i < notes.size(); ++i) {
        const double step = (i + 1 < notes.size() ? notes[i + 1] : scale.period) - notes[i];
        text += text.empty() ? "" : " ";
        text += division > 0 ? fmt::format("{:.0f}", std::round(step * division / scale.period)) : number(step);
    }
    if (division == 0) return text + " cents";
    if (division == 12 && scale.period == 1200.0) return text;
    return fmt::format("{}, of {} to the period", text, division);
}

std::string cents_list(const std::vector<double>& notes) {
    std::string text;
    for (const double cents : notes) text += (text.empty() ? "" : " ") + number(cents);
    return text;
}

/// Names of the notes above a tonic, with cents if they differ from the twelve semitones: `E-14`.
std::string notes_text(const Scale& scale, const std::vector<double>& notes, const Tonic& tonic) {
    const auto spelling = spell(scale, tonic.spelling);
    std::string text;
    for (const double cents : notes) {
        const double key = tonic.key + cents / 100.0;
        // A quarter tone is always written relative to the semitone below, despite rounding.
        const double nearest = std::ceil(key - 0.5 - 1e-9);
        const auto away = std::lround(100.0 * (key - nearest));
        const auto pitch_class = static_cast<std::size_t>(std::fmod(std::fmod(nearest, 12.0) + 12.0, 12.0));
        const Spelling written = spelling[pitch_class];
        const auto signs = static_cast<std::size_t>(std::abs(written.alteration));
        text += text.empty() ? "" : " ";
        text += "CDEFGAB"[written.letter];
        text += std::string(signs, written.alteration > 0 ? '#' : 'b');
        if (away != 0) text += fmt::format("{:+}", away);
    }
    return text;
}

/// Key for comparing words: lower case, without blanks and dashes.
std::string key_of(std::string_view text) {
    std::string key = lower_case(text);
    std::erase_if(key, [](char byte) { return std::string_view(" -_'#").find(byte) != std::string_view::npos; });
    return key;
}

/// One line of the list.
std::string entry(const Scale& scale) {
    // Most titles add nothing to the id.
    std::string names = key_of(scale.id).find(key_of(scale.title)) == std::string::npos ? scale.title : "";
    for (const std::string& name : scale.names) names += (names.empty() ? "" : ", ") + name;
    std::string notes = fmt::format("{}", scale.ascent.size());
    if (scale.descent.size() != scale.ascent.size()) notes += fmt::format("/{}", scale.descent.size());
    std::string line = fmt::format("  {:<26} {:<6} {}", scale.id, notes, names);
    line.erase(line.find_last_not_of(' ') + 1);
    return line + '\n';
}

}  // namespace

std::string scale_json(const Scale& scale) {
    return JsonText::object("id", scale.id, "title", scale.title, "group", scale.group, "size", scale.size(),
                            "ascent", JsonText::list(scale.ascent, json), "descent",
                            JsonText::list(scale.descent, json), "period", json(scale.period), "names", scale.names,
                            "sources", scale.sources)
        .text;
}

std::string scale_text(const Scale& scale, const Tonic& tonic) {
    std::string text = fmt::format("{}, {}", scale.id, scale.group);
    if (!scale.title.empty()) text = fmt::format("{} ({})", scale.title, text);
    text += '\n';
    const auto line = [&](std::string_view name, const std::string& value) {
        if (!value.empty()) text += fmt::format("{:<9}{}\n", name, value);
    };
    const auto list = [&](const std::vector<double>& notes) {
        line("steps", steps_text(scale, notes));
        line("on " + notes_text(scale, {0.0}, tonic), notes_text(scale, notes, tonic));
        line("cents", cents_list(notes));
    };
    if (scale.ascent.size() == scale.descent.size()) {
        line("notes", fmt::format("{}", scale.size()));
    } else {
        line("notes", fmt::format("{} rising, {} falling", scale.ascent.size(), scale.descent.size()));
    }
    if (scale.ascent == scale.descent) {
        list(scale.ascent);
    } else {
        text += "rising\n";
        list(scale.ascent);
        text += "falling\n";
        list(scale.descent);
    }
    line("period", number(scale.period) + " cents");
    line("names", fmt::format("{}", fmt::join(scale.names, ", ")));
    line("sources", scale.sources);
    return text;
}

std::string scale_listing(const std::vector<const Scale*>& scales) {
    std::string text;
    std::string_view last;
    for (const Scale* scale : scales) {
        if (scale->group != last) text += fmt::format("{}{}\n", text.empty() ? "" : "\n", scale->group);
        last = scale->group;
        text += entry(*scale);
    }
    return text;
}

std::vector<const Scale*> search_scales(const std::vector<std::string>& words) {
    std::vector<const Scale*> found;
    for (const Scale& scale : known_scales()) {
        std::string text = key_of(scale.id) + "\n" + key_of(scale.title) + "\n" + key_of(scale.group) + "\n";
        for (const std::string& name : scale.names) text += key_of(name) + "\n";
        text += key_of(scale.sources);
        if (std::all_of(words.begin(), words.end(),
                        [&](const std::string& word) { return text.find(key_of(word)) != std::string::npos; })) {
            found.push_back(&scale);
        }
    }
    return found;
}

std::vector<const Scale*> scales_of_group(const std::string& name) {
    std::vector<const Scale*> found;
    for (const Scale& scale : known_scales()) {
        if (key_of(scale.group) == key_of(name)) found.push_back(&scale);
    }
    return found;
}

}  // namespace sikku
