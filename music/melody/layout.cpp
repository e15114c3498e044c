#include "music/melody/layout.h"

#include "engine/base/diagnostic.h"
#include "engine/base/text.h"
#include "music/melody/key_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace sikku {
namespace {

constexpr double most_bars = 100'000;
constexpr std::int64_t most_excerpt_bars = 1'000'000;
constexpr std::int64_t most_times = 10'000;
constexpr std::size_t most_sections = 256;
constexpr std::size_t most_followers = 16;

constexpr std::array<std::string_view, 8> intervals = {"unison", "second", "third",   "fourth",
                                                       "fifth",  "sixth",  "seventh", "octave"};

/// Reads `3:2`, `3/2` or `2`.
std::optional<Ratio> ratio(std::string_view text) {
    constexpr std::int64_t most = 64;
    const std::size_t mark = std::min(text.find_first_of(":/"), text.size());
    const auto above = whole_number(trimmed(text.substr(0, mark)), 1, most);
    const auto below = mark < text.size() ? whole_number(trimmed(text.substr(mark + 1)), 1, most) : 1;
    if (!above || !below) return std::nullopt;
    const std::int64_t common = std::gcd(*above, *below);
    return Ratio{*above / common, *below / common};
}

/// Removes the next word, and the blanks after it, from `text`, and returns it.
std::string_view next_word(std::string_view& text) {
    text = trimmed(text);
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text = trimmed(text.substr(end));
    return word;
}

/// Reads what follows the letter of a section: its ending, or one change.
/// @param at  after `sign`; set to the end of its number
bool change(FormSection& section, char sign, std::string_view text, std::size_t& at) {
    const auto number = [&](std::int64_t most) {
        const std::size_t end = std::min(text.find_first_not_of("0123456789", at), text.size());
        const auto found = whole_number(text.substr(at, end - at), 1, most);
        at = end;
        return found.value_or(0);
    };
    constexpr std::int64_t most_degrees = 127;
    constexpr std::int64_t most_times_longer = 16;
    switch (sign) {
        case '1':
        case '2':
            if (section.ending != Ending::none) return false;
            section.ending = sign == '1' ? Ending::open : Ending::closed;
            return true;
        case 'i':
            return !std::exchange(section.is_inverted, true);
        case 'r':
            return !std::exchange(section.is_retrograde, true);
        case 'k':
            return !std::exchange(section.is_korvai, true);
        case 'c':
            return !std::exchange(section.is_coda, true);
        case '+':
        case '-':
            if (section.degrees != 0) return false;
            section.degrees = (sign == '+' ? 1 : -1) * number(most_degrees);
            return section.degrees != 0;
        case '*':
        case '/': {
            if (!section.augmentation.is_one()) return false;
            const std::int64_t times = number(most_times_longer);
            section.augmentation = sign == '*' ? Ratio{times, 1} : Ratio{1, times};
            return times > 1;
        }
        default:
            return false;
    }
}

class LayoutReader : private KeyReader {
public:
    LayoutReader(const Pattern& pattern, Diagnostics& diagnostics) : KeyReader(pattern, diagnostics) {}

    Layout read() {
        read_key("start", "expected bars of rest, from 0 to 100000",
                 [&](std::string_view text) { return read_bars(text, layout_.start); });
        read_ratio("speed", layout_.tempo,
                   "expected a ratio to the tempo of the score, such as 3:2, of numbers up to 64");
        read_ratio("augmentation", layout_.augmentation,
                   "expected how many times longer notes are, such as 2 or 1/2, of numbers up to 64");
        read_excerpt();
        read_flag("retrograde", {"no", "yes"}, layout_.is_retrograde);
        read_form_key();
        if (const auto share = read_share("thinning", "each phrase, at its end, in which notes are removed")) {
            layout_.thinning = *share;
        }
        layout_.climax = read_share("climax", "the part before its highest phrase");
        read_loop();
        read_key("canon",
                 "expected bars and an interval for each voice that follows, such as `2 -12`, `1 fifth below` or "
                 "`2 -12, 4 -24`, for up to 16 voices",
                 [&](std::string_view text) { return read_canon(text); });
        read_flag("counterpoint", {"free", "strict"}, layout_.is_strict);
        return std::move(layout_);
    }

private:
    void read_ratio(std::string_view name, Ratio& value, const std::string& expected) {
        read_key(name, expected, [&](std::string_view text) {
            const auto read = ratio(text);
            if (read) value = *read;
            return read.has_value();
        });
    }

    void read_flag(std::string_view name, std::array<std::string_view, 2> words, bool& value) {
        read_key(name, fmt::format("expected {} or {}", words[0], words[1]), [&](std::string_view text) {
            const std::string word = lower_case(text);
            const bool is_switch = words[1] == "yes";
            value = word == words[1] || (is_switch && word == "true");
            return value || word == words[0] || (is_switch && word == "false");
        });
    }

    /// Reads a share from 0 to 1. @param whole  what it is a share of
    std::optional<double> read_share(std::string_view name, std::string_view whole) {
        std::optional<double> found;
        read_key(name, fmt::format("expected the share of {}, from 0 to 1, such as 0.6, or none", whole),
                 [&](std::string_view text) {
                     if (lower_case(text) == "none") return true;
                     double share = 0;
                     const bool is_good = read_number(text, share) && share >= 0 && share <= 1;
                     if (is_good) found = share;
                     return is_good;
                 });
        return found;
    }

    /// Reads `9-16`, or `9-` for all bars from 9.
    void read_excerpt() {
        read_key("excerpt", "expected bars of the melody, such as 1-8, up to 1000000", [&](std::string_view text) {
            if (lower_case(text) == "all") return true;
            const std::size_t dash = std::min(text.find('-'), text.size());
            const auto first = whole_number(trimmed(text.substr(0, dash)), 1, most_excerpt_bars);
            const std::string_view after = dash < text.size() ? trimmed(text.substr(dash + 1)) : text;
            const auto last = after.empty() ? 0 : whole_number(after, first.value_or(1), most_excerpt_bars);
            if (!first || !last) return false;
            layout_.first_bar = *first;
            layout_.bars = *last == 0 ? 0 : *last - *first + 1;
            return true;
        });
    }

    void read_form_key() {
        read_key(
            "form",
            "expected the order of sub-curves such as AABA or A1 A2 B A2, where 1 is an open and 2 a closed ending; "
            "A+2 (two degrees higher), Ai (inverted), Ar (reversed), A*2 (longer), A/2 (shorter), Ak (a korvai) and "
            "Ac (a coda) change a section; `order 2` may follow",
            [&](std::string_view text) {
                if (lower_case(text) == "curve") return true;
                const std::size_t word = lower_case(text).find("order");
                if (word != std::string::npos) {
                    const auto order = whole_number(trimmed(text.substr(word + 5)), 1, 1'000'000);
                    if (!order) return false;
                    layout_.form_order = *order;
                }
                layout_.form = read_form(trimmed(text.substr(0, word)));
                return !layout_.form.empty();
            });
    }

    void read_loop() {
        read_key(
            "loop",
            fmt::format("expected how often the part is played, from 1 to {}, fill (until the longest part ends) "
                        "or common (until all loops end together)",
                        most_times),
            [&](std::string_view text) {
                const std::string word = lower_case(text);
                if (word == "fill" || word == "common") {
                    layout_.loop = word == "fill" ? Loop::fill : Loop::common;
                    return true;
                }
                const auto times = whole_number(text, 1, most_times);
                if (!times) return false;
                layout_.loop = *times > 1 ? Loop::times : Loop::none;
                layout_.times = *times;
                return true;
            });
    }

    /// Reads `2`, `0.5` or `1/2`.
    static bool read_bars(std::string_view text, double& bars) {
        if (text.find('/') != std::string_view::npos) {
            const auto part = ratio(text);
            if (part) bars = static_cast<double>(part->above) / static_cast<double>(part->below);
            return part.has_value();
        }
        return read_number(text, bars) && bars >= 0 && bars <= most_bars;
    }

    bool read_canon(std::string_view text) {
        if (lower_case(text) == "none") return true;
        for (;;) {
            const std::size_t comma = std::min(text.find(','), text.size());
            std::string_view one = text.substr(0, comma);
            Follower follower;
            if (!read_bars(next_word(one), follower.bars)) return false;
            if (!one.empty() && !read_interval(one, follower)) return false;
            layout_.canon.push_back(follower);
            if (layout_.canon.size() > most_followers) return false;
            if (comma == text.size()) return true;
            text.remove_prefix(comma + 1);
        }
    }

    /// Reads `-12`, `fifth` or `octave below`.
    static bool read_interval(std::string_view text, Follower& follower) {
        const std::string word = lower_case(next_word(text));
        const auto* found = std::find(intervals.begin(), intervals.end(), word);
        const std::string direction = lower_case(text);
        if (found != intervals.end()) {
            const std::int64_t sign = direction == "below" ? -1 : 1;
            const std::int64_t steps = found - intervals.begin();
            // Scales have any number of notes, so an octave is counted in semitones.
            follower.semitones = steps == 7 ? 12.0 * static_cast<double>(sign) : 0;
            follower.degrees = steps == 7 ? 0 : sign * steps;
            return direction.empty() || direction == "below" || direction == "above";
        }
        return direction.empty() && read_number(word, follower.semitones) && std::fabs(follower.semitones) <= 127;
    }

    Layout layout_;
};

}  // namespace

Layout read_layout(const Pattern& pattern, Diagnostics& diagnostics) {
    return LayoutReader(pattern, diagnostics).read();
}

std::vector<FormSection> read_form(std::string_view text) {
    std::vector<FormSection> form;
    for (std::size_t at = 0; at < text.size();) {
        const char sign = text[at++];
        if (sign == ' ' && !form.empty()) continue;
        if (sign >= 'A' && sign <= 'Z') {
            form.emplace_back().letter = sign - 'A';
        } else if (form.empty() || !change(form.back(), sign, text, at)) {
            return {};
        }
        if (form.size() > most_sections) return {};
    }
    return form;
}

}  // namespace sikku
