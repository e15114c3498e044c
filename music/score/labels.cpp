#include "music/score/labels.h"

#include "engine/base/diagnostic.h"
#include "music/score/instruments.h"

#include <fmt/format.h>

#include <map>
#include <string>
#include <string_view>

namespace sikku {
namespace {

/// The name if it is short enough, else its first word, or the beginning of that.
std::string shortened(std::string_view name) {
    constexpr std::size_t most = 10;  // bytes
    if (name.size() <= most) return std::string(name);
    const std::string_view word = name.substr(0, name.find(' '));
    if (word.size() <= most) return std::string(word);
    std::size_t end = 0;
    while (end < most - 2) end += std::max<std::size_t>(1, utf8_length(word.substr(end)));
    return std::string(word.substr(0, end)) + ".";
}

}  // namespace

std::vector<Label> labels_of(std::span<const Part> parts) {
    std::vector<Label> labels;
    std::map<std::string, int> count;
    for (const Part& part : parts) {
        const Instrument& instrument = instrument_of(part.program);
        const bool is_own = !part.has_instrument_name;
        labels.push_back({is_own ? part.name : std::string(instrument.printed),
                          is_own ? shortened(part.name) : std::string(instrument.abbreviation)});
        ++count[labels.back().name];
    }
    std::map<std::string, int> number;
    for (Label& label : labels) {
        if (count[label.name] < 2) continue;
        const std::string suffix = fmt::format(" {}", ++number[label.name]);
        label.name += suffix;
        label.abbreviation += suffix;
    }
    return labels;
}

void set_labels(std::span<NotatedPart> parts) {
    std::vector<Part> plain;
    for (const NotatedPart& one : parts) plain.push_back(one.part);
    const std::vector<Label> labels = labels_of(plain);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        parts[i].name = labels[i].name;
        parts[i].abbreviation = labels[i].abbreviation;
        // Saxophones are known by their size.
        const bool is_sax = parts[i].part.program >= 64 && parts[i].part.program <= 67;
        if (parts[i].transposition && parts[i].part.has_instrument_name && !is_sax) {
            parts[i].name += fmt::format(" in {}", parts[i].transposition->key);
        }
    }
}

std::string line_name(std::string_view part, std::size_t index, std::size_t count) {
    if (count < 2) return std::string(part);
    const std::size_t blank = part.rfind(' ');
    const bool is_numbered =
        blank != part.npos && blank + 1 < part.size() && part.find_first_not_of("0123456789", blank + 1) == part.npos;
    return fmt::format("{}{}{}", part, part.empty() ? "" : is_numbered ? "." : " ", index + 1);
}

}  // namespace sikku
