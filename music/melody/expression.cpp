#include "music/melody/expression.h"

#include "engine/base/text.h"
#include "music/melody/key_values.h"
#include "music/melody/melody.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace sikku {
namespace {

constexpr double highest_value = 127;  // largest value of a MIDI controller

struct SourceName {
    std::string_view name;
    ExpressionSource source;
};
constexpr std::array<SourceName, 7> sources = {{{"x", ExpressionSource::x},
                                                {"y", ExpressionSource::y},
                                                {"depth", ExpressionSource::depth},
                                                {"turn", ExpressionSource::turn},
                                                {"curvature", ExpressionSource::turn},
                                                {"length", ExpressionSource::length},
                                                {"level", ExpressionSource::level}}};

class ExpressionReader : private KeyReader {
public:
    ExpressionReader(const Pattern& pattern, Melody& melody, Diagnostics& diagnostics)
        : KeyReader(pattern, diagnostics), expression_(melody.expression), melody_(melody) {}

    void read() {
        constexpr std::string_view velocities = "velocities from 1 to 127, such as by y 50-110";
        if (const Key* key = pattern_.find("velocity"); key && states_curve(key->value.view())) {
            read_curve(*key, 0, expression_.velocity, {48, 108}, 1, highest_value, velocities);
        }
        if (const Key* key = pattern_.find("tempo"); key && states_curve(key->value.view())) {
            constexpr double share = 0.15;
            const double tempo = melody_.tempo;
            read_curve(*key, 1, expression_.tempo, {tempo * (1 - share), tempo * (1 + share)}, 4, 1000,
                       "quarters a minute from 4 to 1000, such as 96 by y 84-108");
        }
        if (const Key* key = pattern_.find("pan"); key && !is_none(*key)) {
            read_curve(*key, 0, expression_.pan, {14, 114}, 0, highest_value,
                       "none, or places from 0, left, to 127, right, such as by x 14-114");
        }
        if (const Key* key = pattern_.find("controller"); key && !is_none(*key)) read_controller(*key);
        if (const Key* key = pattern_.find("gamaka"); key && !is_none(*key)) read_gamakas(*key);
    }

private:
    static bool is_none(const Key& key) { return lower_case(key.value.view()) == "none"; }

    /// Reads `by SOURCE` and an optional `LOW-HIGH` from word `at` on.
    void read_curve(const Key& key, std::size_t at, ExpressionCurve& curve, std::pair<double, double> usual,
                    double least, double most, std::string_view expected) {
        const std::string text = lower_case(key.value.view());
        const std::vector<std::string_view> words = split_words(text);
        const auto refuse = [&] {
            fail(key, fmt::format("expected {}; by x, y, depth, turn, length or level", expected));
        };
        if (words.size() < at + 2 || words.size() > at + 3 || words[at] != "by") return refuse();
        const auto* source = std::find_if(sources.begin(), sources.end(),
                                          [&](const SourceName& one) { return one.name == words[at + 1]; });
        if (source == sources.end()) return refuse();
        curve = {source->source, usual.first, usual.second};
        if (words.size() < at + 3) return;
        const std::string_view range = words[at + 2];
        const std::size_t dash = range.find('-');
        const bool is_good = dash != std::string_view::npos && read_number(range.substr(0, dash), curve.low) &&
                             read_number(range.substr(dash + 1), curve.high);
        const auto is_within = [&](double value) { return value >= least && value <= most; };
        if (!is_good || !is_within(curve.low) || !is_within(curve.high)) refuse();
    }

    void read_controller(const Key& key) {
        constexpr std::string_view expected = "none, or a controller of MIDI from 0 to 119 such as 74 by y 0-127";
        const std::vector<std::string_view> words = split_words(key.value.view());
        const auto number = words.empty() ? std::nullopt : whole_number(words[0], 0, 119);
        if (!number) {
            return fail(key, fmt::format("expected {}; by x, y, depth, turn, length or level", expected));
        }
        // Registered parameters and data entry would change the range of pitch bends, and 10 is the pan.
        for (const int taken : {0, 6, 10, 32, 38, 96, 97, 98, 99, 100, 101}) {
            if (*number == taken) {
                return fail(key,
                            fmt::format("controller {} has a fixed use; expected another such as 1 (modulation), "
                                        "11 (expression) or 74 (brightness)",
                                        *number));
            }
        }
        expression_.controller = static_cast<int>(*number);
        read_curve(key, 1, expression_.control, {0, highest_value}, 0, highest_value, expected);
    }

    void read_gamakas(const Key& key) {
        const std::string text = lower_case(key.value.view());
        std::string_view rest = text;
        const auto refuse = [&] {
            fail(key,
                 "expected none, or kampita, jaru or meend with degrees of the scale, 0 for the tonic, or all, "
                 "optionally followed by rising or falling, such as kampita 2 6, jaru 1 falling, meend all");
        };
        for (;;) {
            const std::size_t comma = std::min(rest.find(','), rest.size());
            std::vector<std::string_view> words = split_words(rest.substr(0, comma));
            Gamaka gamaka;
            if (!words.empty() && (words.back() == "rising" || words.back() == "falling")) {
                gamaka.approach = words.back() == "rising" ? Gamaka::Approach::rising : Gamaka::Approach::falling;
                words.pop_back();
            }
            if (words.size() < 2) return refuse();
            if (words[0] == "jaru") {
                gamaka.kind = Gamaka::Kind::jaru;
            } else if (words[0] == "meend") {
                gamaka.kind = Gamaka::Kind::meend;
            } else if (words[0] != "kampita") {
                return refuse();
            }
            for (std::size_t i = 1; i < words.size() && words[1] != "all"; ++i) {
                const auto degree = whole_number(words[i]);
                if (!degree) return refuse();
                const auto size = static_cast<std::int64_t>(melody_.scale.size());
                if (*degree < 0 || *degree >= size) {
                    return fail(key,
                                fmt::format("degree {} is not in the scale; expected 0 to {}", *degree, size - 1));
                }
                gamaka.degrees.push_back(*degree);
            }
            if (words[1] == "all" && words.size() > 2) return refuse();
            expression_.gamakas.push_back(std::move(gamaka));
            if (comma == rest.size()) break;
            rest.remove_prefix(comma + 1);
        }
        if (melody_.keys) fail(key, "'gamaka:' cannot be combined with 'keyboard:'");
    }

    MelodicExpression& expression_;
    Melody& melody_;
};

}  // namespace

bool states_curve(std::string_view value) {
    const std::string text = lower_case(value);
    const std::vector<std::string_view> words = split_words(text);
    const auto by = std::find(words.begin(), words.end(), "by");
    if (by == words.end()) return false;
    // `by turn`, `by depth` and `by length` alone are the fixed rules of `velocity`.
    const bool is_alone = by == words.begin() && words.size() == 2;
    return !is_alone || (words[1] != "turn" && words[1] != "depth" && words[1] != "length");
}

void read_expression(const Pattern& pattern, Melody& melody, Diagnostics& diagnostics) {
    ExpressionReader(pattern, melody, diagnostics).read();
}

}  // namespace sikku
