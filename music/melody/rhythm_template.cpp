#include "music/melody/rhythm_template.h"

#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <utility>

namespace sikku {
namespace {

constexpr int most_slots = 256;

struct Tala {
    std::string_view name;
    std::string_view groups;
};
constexpr std::array<Tala, 7> talas = {{{"adi", "4+2+2"},
                                        {"rupaka", "2+4"},
                                        {"misra chapu", "3+2+2"},
                                        {"khanda chapu", "2+3"},
                                        {"tintal", "4+4+4+4"},
                                        {"jhaptal", "2+3+2+3"},
                                        {"rupak", "3+2+2"}}};

/// Reads whole numbers between separators; nullopt for anything else.
std::optional<std::vector<int>> numbers(std::string_view text, char separator) {
    std::vector<int> result;
    for (;;) {
        const std::size_t end = std::min(text.find(separator), text.size());
        std::string_view digits = text.substr(0, end);
        while (digits.starts_with(' ')) digits.remove_prefix(1);
        while (digits.ends_with(' ')) digits.remove_suffix(1);
        int number = 0;
        const auto [last, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
        if (error != std::errc() || last != digits.data() + digits.size() || digits.empty()) return std::nullopt;
        result.push_back(number);
        if (end == text.size()) return result;
        text.remove_prefix(end + 1);
    }
}

/// Bjorklund's distribution: the remainder is dealt out until at most one is left.
std::string euclidean(int notes, int slots) {
    std::vector<std::string> front(static_cast<std::size_t>(notes), "x");
    std::vector<std::string> rest(static_cast<std::size_t>(slots - notes), ".");
    while (rest.size() > 1) {
        const std::size_t dealt = std::min(front.size(), rest.size());
        std::vector<std::string> left(front.begin() + static_cast<std::ptrdiff_t>(dealt), front.end());
        if (left.empty()) left.assign(rest.begin() + static_cast<std::ptrdiff_t>(dealt), rest.end());
        front.resize(dealt);
        for (std::size_t i = 0; i < dealt; ++i) front[i] += rest[i];
        rest = std::move(left);
    }
    std::string text;
    for (const std::string& part : front) text += part;
    for (const std::string& part : rest) text += part;
    return text;
}

/// Reads slots, of which parts may be repeated.
class SlotReader {
public:
    explicit SlotReader(std::string_view text) : text_(text) {}

    /// @param problem  receives the problem if the result is empty
    RhythmTemplate read(std::string& problem) {
        const bool is_read = read_part(0) && at_ == text_.size();
        if (is_read && !result_.hits.empty()) return std::move(result_);
        if (is_read) fail(limits());
        if (!problem_.empty()) problem = problem_;
        return {};
    }

private:
    static constexpr int deepest = 8;

    bool fail(std::string problem) {
        problem_ = std::move(problem);
        return false;
    }
    /// Reads digits; `absent` if there are none.
    int number(int absent) {
        int value = absent;
        const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
        if (error == std::errc()) at_ = static_cast<std::size_t>(end - text_.data());
        return error == std::errc::result_out_of_range ? most_slots + 1 : value;
    }

    /// Reads up to the end or a `)`.
    bool read_part(int depth) {
        for (; at_ < text_.size() && text_[at_] != ')';) {
            const char slot = text_[at_++];
            if (slot == ' ' || slot == '|') continue;
            if (slot == '(') {
                if (!repeat(depth)) return false;
                continue;
            }
            if (std::string_view("xXo.~").find(slot) == std::string_view::npos) return false;
            if (!add(slot)) return false;
        }
        return true;
    }

    bool repeat(int depth) {
        const std::int64_t first = result_.slots;
        const std::size_t hits = result_.hits.size();
        if (depth == deepest) return fail(fmt::format("parentheses nest deeper than {}", deepest));
        if (!read_part(depth + 1)) return false;
        if (at_ == text_.size()) return fail("this `(` is not closed");
        ++at_;
        const int times = number(0);
        const std::int64_t slots = result_.slots - first;
        if (result_.hits.size() == hits || result_.hits[hits].onset != first) {
            return fail("what is repeated begins with a note: x, X or o");
        }
        if (times < 1 || first + times * slots > most_slots) {
            return fail(fmt::format("a part is repeated 1 to {0} times, as in (x.)3, within {0} slots", most_slots));
        }
        const std::vector<RhythmTemplate::Hit> part(result_.hits.begin() + static_cast<std::ptrdiff_t>(hits),
                                                    result_.hits.end());
        for (int i = 1; i < times; ++i) {
            for (RhythmTemplate::Hit hit : part) {
                hit.onset += i * slots;
                result_.hits.push_back(hit);
            }
        }
        result_.slots = first + times * slots;
        return true;
    }

    bool add(char slot) {
        if (result_.slots == most_slots || (result_.slots == 0 && (slot == '.' || slot == '~'))) {
            return fail(limits());
        }
        if (slot == '~') {
            sounds_ = false;
        } else if (slot != '.') {
            const Stress stress = slot == 'X' ? Stress::accent : slot == 'o' ? Stress::ghost : Stress::plain;
            result_.hits.push_back({result_.slots, 1, stress});
            sounds_ = true;
            if (!read_chance(result_.hits.back())) return false;
        } else if (sounds_) {
            ++result_.hits.back().length;
        }
        ++result_.slots;
        return true;
    }

    bool read_chance(RhythmTemplate::Hit& hit) {
        if (at_ == text_.size() || text_[at_] != '?') return true;
        ++at_;
        const int percent = number(50);
        if (percent < 1 || percent > 99)
            return fail("a note sounds with a probability of 1 to 99 percent, as in x?30");
        hit.percent = static_cast<std::uint8_t>(percent);
        return true;
    }

    static std::string limits() {
        return fmt::format("a template begins with x, X or o and has up to {} slots", most_slots);
    }

    std::string_view text_;
    std::size_t at_ = 0;
    bool sounds_ = false;
    RhythmTemplate result_;
    std::string problem_;
};

/// @param text  of slots that are correct
RhythmTemplate from_slots(std::string_view text) {
    std::string problem;
    return SlotReader(text).read(problem);
}

RhythmTemplate from_groups(const std::vector<int>& groups) {
    std::string text;
    for (const int group : groups)
        text += (text.empty() ? 'X' : 'x') + std::string(static_cast<std::size_t>(group - 1), '.');
    return from_slots(text);
}

}  // namespace

RhythmTemplate read_rhythm_template(std::string_view text, std::string& problem) {
    problem =
        "expected a template such as x..x..x., a Euclidean rhythm such as E(3,8), groups such as 4+2+2, or a "
        "tala: adi, rupaka, misra chapu, khanda chapu, tintal, jhaptal, rupak";
    const std::string lower = lower_case(text);
    for (const Tala& tala : talas) {
        if (lower == tala.name) return from_groups(*numbers(tala.groups, '+'));
    }
    if (lower.starts_with("e(") && lower.ends_with(')')) {
        const auto terms = numbers(std::string_view(lower).substr(2, lower.size() - 3), ',');
        if (!terms || terms->size() < 2 || terms->size() > 3) return {};
        const int notes = (*terms)[0];
        const int slots = (*terms)[1];
        if (slots >= 1 && notes > slots) {
            problem = fmt::format("more notes ({}) than slots ({}); E(3,8) has 3 notes in 8 slots", notes, slots);
            return {};
        }
        if (notes < 1 || slots < notes || slots > most_slots) {
            problem = fmt::format("expected 1 to {0} notes in up to {0} slots", most_slots);
            return {};
        }
        std::string slots_text = euclidean(notes, slots);
        const int by = terms->size() == 3 ? ((*terms)[2] % slots + slots) % slots : 0;
        std::rotate(slots_text.begin(), slots_text.begin() + by, slots_text.end());
        // A cycle begins with a note: slots before it continue the last note of the cycle before.
        std::rotate(slots_text.begin(), slots_text.begin() + static_cast<std::ptrdiff_t>(slots_text.find('x')),
                    slots_text.end());
        return from_slots(slots_text);
    }
    if (const auto groups = numbers(lower, '+')) {
        int sum = 0;
        for (const int group : *groups) {
            if (group < 1 || group > most_slots || (sum += group) > most_slots) {
                problem = fmt::format("groups of a tala have 1 to {0} beats, {0} together", most_slots);
                return {};
            }
        }
        if (groups->size() < 2) return {};
        return from_groups(*groups);
    }
    return SlotReader(text).read(problem);
}

}  // namespace sikku
