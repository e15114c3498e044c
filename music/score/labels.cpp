#include "music/score/labels.h"

#include "engine/base/diagnostic.h"
#include "music/score/instruments.h"

#include <fmt/format.h>

#include <map>
#include <string>
#include <string_view>

namespace sikku {
namespace {

/// A name that is short enough, or its first word, or the beginning of that.
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

void set_labels(std::span<NotatedPart> parts) {
    std::map<std::string, int> count;
    for (NotatedPart& one : parts) {
        const Part& part = one.part;
        const Instrument& instrument = instrument_of(part.program);
        one.name = part.has_instrument_name ? instrument.printed : part.name;
        one.abbreviation = part.has_instrument_name ? std::string(instrument.abbreviation) : shortened(part.name);
        ++count[one.name];
    }
    std::map<std::string, int> number;
    for (NotatedPart& one : parts) {
        if (count[one.name] < 2) continue;
        const std::string suffix = fmt::format(" {}", ++number[one.name]);
        one.name += suffix;
        one.abbreviation += suffix;
    }
}

}  // namespace sikku
