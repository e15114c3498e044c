#include "art/plotter/pen_rules.h"

#include "art/style/length.h"
#include "engine/base/diagnostic.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace sikku {
namespace {

constexpr double farthest_place = 10'000;  // millimetres from the origin to a place
constexpr int most_pens = 256;

[[noreturn]] void fail(const std::string& message) {
    throw std::runtime_error(message);
}

/// A number followed by one of the units, or by none.
std::optional<double> number_with(std::string_view text, std::initializer_list<std::string_view> units) {
    text = trimmed(text);
    for (const std::string_view unit : units) {
        if (!text.ends_with(unit)) continue;
        text = trimmed(text.substr(0, text.size() - unit.size()));
        break;
    }
    double value = 0;
    return read_number(text, value) ? std::optional(value) : std::nullopt;
}

void set(PenSettings& settings, std::string_view key, std::string_view value, double dpi) {
    if (key == "speed") {
        settings.speed = parse_speed(value);
    } else if (key == "lift") {
        settings.lift = parse_height(value);
    } else if (key == "down") {
        settings.down = parse_height(value);
    } else if (key == "pause") {
        settings.pause = parse_pause(value);
    } else if (key == "refill") {
        settings.refill = parse_refill(value, dpi);
    } else {
        const std::string_view near = nearest(key, {"speed", "lift", "down", "pause", "refill"});
        fail(fmt::format("unknown setting '{}' of a pen{}", printable(key, 40),
                         near.empty() ? "; expected speed, lift, down, pause or refill" : did_you_mean(near)));
    }
}

}  // namespace

double parse_speed(std::string_view text) {
    const auto value = number_with(text, {"mm/s"});
    if (!value || !(*value >= 1e-3 && *value <= 1e6)) fail("expected a speed between 0.001 and 1000000 mm/s");
    return *value;
}

double parse_pause(std::string_view text) {
    const auto value = number_with(text, {"s"});
    if (!value || !(*value >= 0 && *value <= 3600)) fail("expected a pause between 0 and 3600 s");
    return *value;
}

double parse_height(std::string_view text) {
    const auto value = number_with(text, {"mm", "%", "deg"});
    if (!value || !(std::fabs(*value) <= 1e6)) fail("expected a number such as 3mm or 40%");
    return *value;
}

glm::dvec2 parse_place(std::string_view text, double dpi) {
    const std::size_t comma = text.find(',');
    const auto x = parse_length(text.substr(0, comma), dpi);
    const auto y = comma == std::string_view::npos ? std::nullopt : parse_length(text.substr(comma + 1), dpi);
    if (!x || !y) fail("expected a place X,Y such as 10mm,20mm, from the bottom left corner of the page");
    if (!(std::fabs(*x) <= farthest_place && std::fabs(*y) <= farthest_place))
        fail("expected a place within 10 m of the page");
    return {*x, *y};
}

Refill parse_refill(std::string_view text, double dpi) {
    const std::size_t at = text.find('@');
    const auto length = parse_length(text.substr(0, at), dpi);
    if (at == std::string_view::npos || !length) fail("expected a length and a place such as 5m@10,10");
    if (!(*length >= 10 && *length <= 1e6)) fail("expected a length between 10mm and 1000m");
    return {*length, parse_place(text.substr(at + 1), dpi)};
}

PenRule parse_pen_rule(std::string_view text, double dpi) {
    const auto next_word = [&text] {
        text = trimmed(text);
        const std::string_view word = text.substr(0, text.find_first_of(" \t"));
        text.remove_prefix(word.size());
        return word;
    };
    PenRule rule;
    const std::string_view pen = next_word();
    double number = 0;
    if (read_number(pen, number)) {
        if (!(number >= 1 && number <= most_pens && number == std::floor(number))) {
            fail(fmt::format("expected a pen's number between 1 and {}", most_pens));
        }
        rule.number = static_cast<int>(number);
    } else {
        rule.colour = parse_colour(pen);
        if (!rule.colour) {
            fail(
                "expected the number or the colour of a pen, then its settings, such as '2 speed=20mm/s pause=0.5s'");
        }
    }
    for (std::string_view word = next_word(); !word.empty(); word = next_word()) {
        const std::size_t equals = word.find('=');
        if (equals == std::string_view::npos) {
            fail(fmt::format("expected a setting such as speed=20mm/s instead of '{}'", printable(word, 40)));
        }
        const std::string_view key = word.substr(0, equals);
        try {
            set(rule.settings, key, word.substr(equals + 1), dpi);
        } catch (const std::runtime_error& error) {
            if (std::string_view(error.what()).starts_with("unknown")) throw;
            fail(fmt::format("{}: {}", key, error.what()));
        }
    }
    if (rule.settings == PenSettings{}) fail("expected settings of the pen, such as speed=20mm/s");
    return rule;
}

std::string layer_name(int number, Colour colour, const PenSettings& settings, const LayerCodes& codes) {
    if (!(codes.full_speed > 0)) return fmt::format("{} {}", number, colour_name(colour));
    const auto whole = [](double value, double least, double most) {
        return static_cast<int>(std::lround(std::clamp(value, least, most)));
    };
    std::string name = fmt::format("{}{}", codes.pauses && number > 1 ? "!" : "", number);
    if (settings.speed) name += fmt::format("+S{}", whole(100 * *settings.speed / codes.full_speed, 1, 110));
    if (settings.down) name += fmt::format("+H{}", whole(*settings.down, 0, 100));
    if (settings.pause) name += fmt::format("+D{}", whole(1000 * *settings.pause, 0, 3.6e6));
    return name + " " + colour_name(colour);
}

PenSettings pen_settings(std::span<const PenRule> rules, int number, Colour colour) {
    PenSettings result;
    for (const PenRule& rule : rules) {
        if (rule.colour ? *rule.colour != colour : rule.number != number) continue;
        if (rule.settings.speed) result.speed = rule.settings.speed;
        if (rule.settings.lift) result.lift = rule.settings.lift;
        if (rule.settings.down) result.down = rule.settings.down;
        if (rule.settings.pause) result.pause = rule.settings.pause;
        if (rule.settings.refill) result.refill = rule.settings.refill;
    }
    return result;
}

}  // namespace sikku
