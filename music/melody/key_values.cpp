#include "music/melody/key_values.h"

#include "engine/base/text.h"

#include <algorithm>
#include <charconv>

namespace sikku {

std::optional<std::int64_t> whole_number(std::string_view text, std::int64_t least, std::int64_t most) {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_good = error == std::errc() && end == text.data() + text.size() && !text.empty();
    return is_good && value >= least && value <= most ? std::optional(value) : std::nullopt;
}

std::optional<std::int64_t> note_value(std::string_view text) {
    constexpr std::int64_t most = 100'000;
    const std::size_t slash = std::min(text.find('/'), text.size());
    const auto above = whole_number(text.substr(0, slash), 1, most);
    const auto below = slash < text.size() ? whole_number(text.substr(slash + 1), 1, most) : 1;
    const std::int64_t whole_note = 4 * ticks_per_quarter;
    if (!above || !below || *above * whole_note % *below != 0 || *above > 16 * *below) return std::nullopt;
    return *above * whole_note / *below;
}

std::optional<Meter> parse_meter(std::string_view text) {
    const std::size_t slash = text.find('/');
    if (slash == std::string_view::npos) return std::nullopt;
    constexpr std::int64_t most = 64;
    Meter meter;
    std::string_view beats = trimmed(text.substr(0, slash));
    const bool is_grouped = beats.find('+') != std::string_view::npos;
    const auto unit = whole_number(trimmed(text.substr(slash + 1)), 1, most);
    if (!unit || (*unit & (*unit - 1)) != 0) return std::nullopt;
    meter.unit = static_cast<int>(*unit);
    meter.beats = 0;
    for (std::size_t i = 0;; ++i) {
        const std::size_t plus = beats.find('+');
        const auto group = whole_number(trimmed(beats.substr(0, plus)), 1, most);
        if (i == meter.groups.size() || !group) return std::nullopt;
        meter.beats += static_cast<int>(*group);
        if (is_grouped) meter.groups[i] = static_cast<std::uint8_t>(*group);
        if (plus == std::string_view::npos) break;
        beats.remove_prefix(plus + 1);
    }
    return meter.beats <= most ? std::optional(meter) : std::nullopt;
}

}  // namespace sikku
