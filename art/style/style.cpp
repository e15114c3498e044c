#include "art/style/style.h"

#include "art/style/length.h"
#include "art/style/values.h"
#include "art/style/white_paper.h"
#include "engine/base/decimal.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <system_error>

namespace sikku {
namespace {

constexpr double widest = 1000.0;      // widest stroke: millimetres or steps
constexpr double widest_pen_mm = 1e5;  // after the turtle's factors, so that every writer can print the number
constexpr std::size_t most_colours = 4096;

constexpr Colour black{0, 0, 0, 255};

bool is_separator(char byte, bool commas) {
    return byte == ' ' || byte == '\t' || (commas && byte == ',');
}

/// The next word at or after `at`, which moves past it; empty at the end. Text in parentheses stays together, so that
/// `rgb(1, 2, 3)` is reported once.
Span next_word(const Span& value, std::size_t& at, bool commas) {
    const std::string_view text = value.view();
    while (at < text.size() && is_separator(text[at], commas)) ++at;
    const std::size_t begin = at;
    int depth = 0;
    while (at < text.size() && (depth > 0 || !is_separator(text[at], commas))) {
        if (text[at] == '(') ++depth;
        if (text[at] == ')' && depth > 0) --depth;
        ++at;
    }
    return value.part(begin, at - begin);
}

std::string colour_complaint(std::string_view text, std::string_view expected) {
    if (text.starts_with('#')) {
        return fmt::format("{} is not a colour: 3, 4, 6 or 8 hexadecimal digits follow '#'", quoted_value(text));
    }
    if (text.find('(') != std::string_view::npos) {
        return fmt::format("{} is not a colour here: write #rrggbb or a CSS name", quoted_value(text));
    }
    const std::string_view near = nearest(lower_case(text), colour_names());
    if (!near.empty()) return fmt::format("{} is not a colour; did you mean '{}'?", quoted_value(text), near);
    return fmt::format("{} is not a colour: expected {}", quoted_value(text), expected);
}

std::optional<Colour> read_colour(const Span& word, std::string_view expected, Diagnostics& diagnostics) {
    const auto colour = parse_colour(word.view());
    if (!colour) diagnostics.error(word, colour_complaint(word.view(), expected));
    return colour;
}

/// Reports a word after the last one that is expected.
void refuse_more(const Key& key, const Span& word, std::string_view expected, Diagnostics& diagnostics) {
    diagnostics.error(word, fmt::format("unexpected {}: '{}:' is {}", quoted_value(word.view()), key.name, expected));
}

/// The only word of a value, perhaps after "by"; reports an absent or a second one.
std::optional<Span> only_word(const Key& key, std::string_view expected, Diagnostics& diagnostics,
                              bool may_follow_by = false) {
    std::size_t at = 0;
    Span word = next_word(key.value, at, false);
    if (may_follow_by && lower_case(word.view()) == "by") word = next_word(key.value, at, false);
    if (word.empty()) {
        diagnostics.error(key.name_at, fmt::format("'{}:' is {}: expected {}", key.name,
                                                   may_follow_by ? "incomplete" : "empty", expected));
        return std::nullopt;
    }
    if (const Span second = next_word(key.value, at, false); !second.empty()) {
        refuse_more(key, second, expected, diagnostics);
        return std::nullopt;
    }
    return word;
}

void read_line(const Key& key, Style& style, Diagnostics& diagnostics) {
    constexpr std::string_view expected = "'straight', 'spline' or 'spline with lifts'";
    std::size_t at = 0;
    const Span first = next_word(key.value, at, false);
    const Span second = next_word(key.value, at, false);
    const Span third = next_word(key.value, at, false);
    if (lower_case(first.view()) == "spline" && lower_case(second.view()) == "with" &&
        lower_case(third.view()) == "lifts" && next_word(key.value, at, false).empty()) {
        style.line = Line::spline;
        style.moves_lift = true;
        return;
    }
    const auto word = only_word(key, expected, diagnostics);
    if (!word) return;
    const std::string text = lower_case(word->view());
    if (text == "straight") {
        style.line = Line::straight;
    } else if (text == "spline") {
        style.line = Line::spline;
    } else {
        const std::string_view near = nearest(text, {"straight", "spline"});
        diagnostics.error(
            *word, near.empty()
                       ? fmt::format("{} is not a line style: expected {}", quoted_value(word->view()), expected)
                       : fmt::format("{} is not a line style; did you mean '{}'?", quoted_value(word->view()), near));
    }
}

void read_hand(const Key& key, Style& style, Diagnostics& diagnostics) {
    constexpr std::string_view expected = "a number from 0 to 1";
    const auto word = only_word(key, expected, diagnostics);
    if (!word) return;
    if (!read_number(std::string(word->view()), style.hand) || !(style.hand >= 0 && style.hand <= 1)) {
        style.hand = 0;
        diagnostics.error(*word, fmt::format("{} is not a strength of the hand: expected {}",
                                             quoted_value(word->view()), expected));
    }
}

bool begins_number(std::string_view text) {
    if (text.starts_with('+') || text.starts_with('-')) text.remove_prefix(1);
    if (text.starts_with('.')) text.remove_prefix(1);
    return !text.empty() && text.front() >= '0' && text.front() <= '9';
}

/// A width and a colour, in either order and each optional, or `none`.
class StrokeReader {
public:
    StrokeReader(const Key& key, double dpi, Diagnostics& diagnostics)
        : key_(key), dpi_(dpi), diagnostics_(diagnostics) {}

    std::optional<StrokeWidth> width;
    std::optional<Colour> colour;
    bool is_none = false;

    void read() {
        std::size_t at = 0;
        Span word = next_word(key_.value, at, false);
        if (word.empty()) {
            diagnostics_.error(key_.name_at, fmt::format("'{}:' is empty: expected {}", key_.name, expected));
            return;
        }
        if (lower_case(word.view()) == "none") {
            if (const Span second = next_word(key_.value, at, false); !second.empty()) {
                diagnostics_.error(second, fmt::format("'{}: none' must stand alone", key_.name));
            }
            is_none = true;
            return;
        }
        for (; !word.empty(); word = next_word(key_.value, at, false)) {
            const std::string_view text = word.view();
            if (begins_number(text)) {
                read_width(word, at);
            } else if (lower_case(text) == "none") {
                diagnostics_.error(word, fmt::format("'none' must stand alone in '{}:'", key_.name));
            } else if (has_colour_) {
                return refuse_more(key_, word, expected, diagnostics_);
            } else {
                has_colour_ = true;
                colour = read_colour(word, expected, diagnostics_);
            }
        }
    }

private:
    static constexpr std::string_view expected =
        "a width such as 0.4mm or 0.2 step and a colour, either or both, or none";

    void read_width(const Span& word, std::size_t& at) {
        if (has_width_) {
            diagnostics_.error(word,
                               fmt::format("{} is a second width; expected only one", quoted_value(word.view())));
        }
        has_width_ = true;
        std::string_view text = word.view();
        const std::size_t sign = text.starts_with('+') ? 1 : 0;
        double number = 0.0;
        const auto [end, error] = parse_number(text.substr(sign), number);
        const auto digits = static_cast<std::size_t>(end - text.data());
        Span unit_at = word.part(digits);
        if (unit_at.empty()) {
            std::size_t after = at;
            const Span next = next_word(key_.value, after, false);
            std::size_t beyond = after;
            const Span last = next_word(key_.value, beyond, false);
            // A word between the number and a colour can only be meant as a unit.
            const bool is_meant = !last.empty() && !parse_colour(next.view()) && parse_colour(last.view());
            if (is_unit(lower_case(next.view())) || is_meant) {
                unit_at = next;
                at = after;
            }
        }
        const std::string unit = lower_case(unit_at.view());
        if (!unit.empty() && !is_unit(unit)) {
            diagnostics_.error(unit_at, fmt::format("{} is not a unit; expected mm, cm, in, pt, px or step",
                                                    quoted_value(unit_at.view())));
            return;
        }
        StrokeWidth stroke;
        stroke.in_steps = unit.starts_with("step");
        if (!stroke.in_steps) stroke.unit = parse_length("1" + unit, dpi_).value_or(0.0);
        stroke.value = number * stroke.unit;
        if (error != std::errc() || !std::isfinite(stroke.value) || stroke.value >= widest) {
            diagnostics_.error(
                word, fmt::format("a {} must be narrower than 1000 {}", what(), stroke.in_steps ? "steps" : "mm"));
            return;
        }
        if (stroke.value == 0.0) {
            diagnostics_.error(
                word, fmt::format("a {} of width 0 cannot be seen: expected a width above 0, or '{}: none'", what(),
                                  key_.name));
            return;
        }
        if (stroke.value < 0.0) {
            diagnostics_.error(word, fmt::format("the width of a {} must be above 0", what()));
            return;
        }
        width = stroke;
    }

    std::string_view what() const { return key_.name == "dots" ? "dot" : "stroke"; }

    static bool is_unit(std::string_view unit) {
        return unit == "mm" || unit == "cm" || unit == "in" || unit == "pt" || unit == "px" || unit == "step" ||
               unit == "steps";
    }

    const Key& key_;
    double dpi_;
    Diagnostics& diagnostics_;
    bool has_width_ = false;
    bool has_colour_ = false;
};

void read_stroke(const Key& key, double dpi, Style& style, Diagnostics& diagnostics) {
    StrokeReader reader(key, dpi, diagnostics);
    reader.read();
    style.stroked = !reader.is_none;
    if (reader.width) style.stroke = *reader.width;
    style.stroke_colour = reader.colour;
}

void read_dots(const Key& key, double dpi, Style& style, Diagnostics& diagnostics) {
    StrokeReader reader(key, dpi, diagnostics);
    reader.read();
    if (!reader.is_none) style.dots = DotStyle{reader.width, reader.colour};
}

void read_ground(const Key& key, Style& style, Diagnostics& diagnostics) {
    const std::string expected = fmt::format("a colour, {} or none", fmt::join(floor_names(), ", "));
    const auto word = only_word(key, expected, diagnostics);
    if (!word) return;
    style.ground.reset();
    const std::string text = lower_case(word->view());
    if (text == "none") return;
    style.floor = find_floor(text);
    if (style.floor) {
        style.ground = mean_colour(*style.floor);
        return;
    }
    const std::string_view near = parse_colour(text) ? std::string_view() : nearest(text, floor_names());
    if (!near.empty()) {
        diagnostics.error(*word, fmt::format("{} is not a floor; did you mean '{}'?", quoted_value(text), near));
        return;
    }
    style.ground = read_colour(*word, expected, diagnostics);
    if (style.ground && style.ground->alpha == 0) style.ground.reset();
}

void read_fill(const Key& key, bool is_map, Style& style, Diagnostics& diagnostics) {
    const std::string_view expected = is_map ? "a colour, age, sides or none" : "a colour or none";
    const auto word = only_word(key, expected, diagnostics);
    if (!word) return;
    if (const std::string text = lower_case(word->view()); is_map && (text == "age" || text == "sides")) return;
    style.fill = lower_case(word->view()) == "none" ? Colour{0, 0, 0, 0} : read_colour(*word, expected, diagnostics);
}

/// A value that is the name of a set of powders.
std::optional<std::vector<Colour>> named_powders(const Key& key) {
    std::size_t at = 0;
    const Span word = next_word(key.value, at, true);
    if (!next_word(key.value, at, true).empty()) return std::nullopt;
    return find_powders(lower_case(word.view()));
}

void read_palette(const Key& key, Style& style, Diagnostics& diagnostics) {
    constexpr std::string_view expected = "colours, separated by blanks or commas, or the name of a set of powders";
    std::vector<Colour> palette;
    std::size_t at = 0;
    if (auto powders = named_powders(key)) {
        style.palette = std::move(*powders);
        return;
    }
    // Reports only the first errors of an invalid palette.
    int errors = 0;
    for (Span word = next_word(key.value, at, true); !word.empty() && errors < 20;
         word = next_word(key.value, at, true)) {
        const auto colour = read_colour(word, expected, diagnostics);
        if (colour) palette.push_back(*colour);
        if (!colour) ++errors;
        if (palette.size() > most_colours) {
            diagnostics.error(word, fmt::format("a palette has at most {} colours", most_colours));
            break;
        }
    }
    if (palette.empty() && errors == 0) {
        diagnostics.error(key.value.empty() ? key.name_at : key.value,
                          fmt::format("'palette:' is empty: expected {}", expected));
    }
    if (!palette.empty()) style.palette = std::move(palette);
}

void read_powders(const Key& key, Style& style, Diagnostics& diagnostics) {
    const std::string expected =
        fmt::format("colours or none, separated by blanks, or one of {}", fmt::join(powder_names(), ", "));
    if (auto powders = named_powders(key)) {
        style.powders = std::move(*powders);
        style.powders_are_named = true;
        return;
    }
    std::size_t at = 0;
    int errors = 0;
    for (Span word = next_word(key.value, at, true); !word.empty() && errors < 20;
         word = next_word(key.value, at, true)) {
        if (lower_case(word.view()) == "none") {
            style.powders.push_back({0, 0, 0, 0});
        } else if (const auto colour = parse_colour(word.view())) {
            style.powders.push_back(*colour);
        } else {
            ++errors;
            const std::string_view near = nearest(lower_case(word.view()), powder_names());
            diagnostics.error(word, near.empty() ? colour_complaint(word.view(), expected)
                                                 : fmt::format("unknown powders {}; did you mean '{}'?",
                                                               quoted_value(word.view()), near));
        }
        if (style.powders.size() > most_colours) {
            diagnostics.error(word, fmt::format("there are at most {} powders", most_colours));
            break;
        }
    }
    if (style.powders.empty() && errors == 0) {
        diagnostics.error(key.name_at, fmt::format("'powders:' is empty: expected {}", expected));
    }
}

/// One of several names, perhaps after "by". @param expected  all of them, for messages
template <class Value, std::size_t count>
std::optional<Value> read_choice(const Key& key, const std::array<std::pair<std::string_view, Value>, count>& choices,
                                 std::string_view expected, Diagnostics& diagnostics) {
    const auto word = only_word(key, expected, diagnostics, true);
    if (!word) return std::nullopt;
    const std::string text = lower_case(word->view());
    std::vector<std::string_view> names;
    for (const auto& [name, value] : choices) {
        if (name == text) return value;
        names.push_back(name);
    }
    const std::string_view near = nearest(text, names);
    diagnostics.error(*word, near.empty() ? fmt::format("{}: expected {}", quoted_value(word->view()), expected)
                                          : fmt::format("{}: did you mean '{}'?", quoted_value(word->view()), near));
    return std::nullopt;
}

void read_fields(const Key& key, Style& style, Diagnostics& diagnostics) {
    using Way = std::pair<std::string_view, std::optional<FieldsBy>>;
    constexpr std::array ways = {Way{"chessboard", FieldsBy::chessboard},
                                 Way{"kind", FieldsBy::kind},
                                 Way{"distance", FieldsBy::distance},
                                 Way{"centre", FieldsBy::centre},
                                 Way{"strand", FieldsBy::strand},
                                 Way{"symmetry", FieldsBy::symmetry},
                                 Way{"none", std::nullopt}};
    style.fields =
        read_choice(key, ways, "chessboard, by kind, by distance, by centre, by strand, by symmetry or none",
                    diagnostics)
            .value_or(std::nullopt);
}

void read_tile_colours(const Key& key, Style& style, Diagnostics& diagnostics) {
    constexpr std::string_view expected =
        "by shape, by hand, by direction, by distance, by neighbours, by generation, by worms, blank or none";
    constexpr double most_generations = 1e6;
    // A generation may have a number.
    std::size_t at = 0;
    Span word = next_word(key.value, at, false);
    if (lower_case(word.view()) == "by") word = next_word(key.value, at, false);
    const Span number = next_word(key.value, at, false);
    if (lower_case(word.view()) == "generation" && !number.empty()) {
        const auto generation = number_in(number.view(), 1, most_generations);
        const Span more = next_word(key.value, at, false);
        if (!generation || *generation != std::floor(*generation) || !more.empty()) {
            diagnostics.error(more.empty() ? number : more,
                              "expected a number of steps, 1 or more, after 'by generation'");
            return;
        }
        style.tile_colours = TileColours::generation;
        style.tile_generation = static_cast<std::int64_t>(*generation);
        return;
    }
    using Way = std::pair<std::string_view, std::optional<TileColours>>;
    constexpr std::array ways = {Way{"shape", TileColours::shape},
                                 Way{"hand", TileColours::hand},
                                 Way{"direction", TileColours::direction},
                                 Way{"distance", TileColours::distance},
                                 Way{"neighbours", TileColours::neighbours},
                                 Way{"generation", TileColours::generation},
                                 Way{"worms", TileColours::worms},
                                 Way{"blank", TileColours::blank},
                                 Way{"none", std::nullopt}};
    style.tile_colours = read_choice(key, ways, expected, diagnostics).value_or(std::nullopt);
}

void read_tile_edges(const Key& key, Style& style, Diagnostics& diagnostics) {
    using Way = std::pair<std::string_view, TileEdges>;
    constexpr std::array ways = {Way{"each", TileEdges::each}, Way{"once", TileEdges::once},
                                 Way{"border", TileEdges::border}, Way{"none", TileEdges::none}};
    style.tile_edges = read_choice(key, ways, "each, once, border or none", diagnostics).value_or(TileEdges::each);
}

void read_weave(const Key& key, Style& style, Diagnostics& diagnostics) {
    constexpr std::string_view expected = "yes, none, or the gap beside the upper strand in stroke widths, 0 to 5";
    constexpr double usual_gap = 0.4;
    constexpr double widest_gap = 5;
    const auto word = only_word(key, expected, diagnostics);
    if (!word) return;
    const std::string text = lower_case(word->view());
    if (text == "none" || text == "no") return;
    style.weave = text == "yes" ? usual_gap : number_in(text, 0, widest_gap);
    if (!style.weave) refuse(*word, expected, diagnostics);
}

void read_parallel(const Key& key, Style& style, Diagnostics& diagnostics) {
    constexpr std::string_view expected =
        "a number of parallel lines, 1 to 9, and optionally the distance from one to the next in "
        "stroke widths, 1 to 50";
    std::size_t at = 0;
    const Span count = next_word(key.value, at, false);
    const Span spacing = next_word(key.value, at, false);
    const Span third = next_word(key.value, at, false);
    if (count.empty()) {
        diagnostics.error(key.name_at, fmt::format("'parallel:' is empty: expected {}", expected));
        return;
    }
    const auto number = number_in(count.view(), 1, 9);
    if (!number || *number != std::floor(*number)) return refuse(count, expected, diagnostics);
    style.parallel.count = static_cast<int>(*number);
    if (!third.empty()) return refuse(third, expected, diagnostics);
    if (spacing.empty()) return;
    const auto width = number_in(spacing.view(), 1, 50);
    if (!width) return refuse(spacing, expected, diagnostics);
    style.parallel.spacing = *width;
    style.parallel.is_spaced = true;
}

std::vector<int> slots(const Style& style, Colour (Style::*colour_of)(const Pen&) const) {
    std::vector<int> result;
    std::map<std::array<std::uint8_t, 4>, int> first;
    const int colours = std::max(1, static_cast<int>(style.palette.size()));
    for (int index = 0; index < colours; ++index) {
        const Colour colour = (style.*colour_of)(Pen{.colour = index});
        const auto [found, is_new] = first.try_emplace({colour.red, colour.green, colour.blue, colour.alpha}, index);
        result.push_back(found->second);
    }
    return result;
}

/// In the order of BorderKind.
constexpr std::array<std::string_view, 8> named_borders = {"kaavi",    "padi",  "lotus",     "rope",
                                                           "diamonds", "waves", "marigolds", "lamps"};

void read_border(const Key& key, Style& style, Diagnostics& diagnostics) {
    if (lower_case(trimmed(key.value.view())) == "none") return;
    style.border = parse_border(key.value.view());
    if (!style.border) {
        diagnostics.error(key.value.empty() ? key.name_at : key.value,
                          fmt::format("expected {}, none, or a pattern file such as petal.lsys, optionally followed "
                                      "by a comma and another for the corners",
                                      fmt::join(named_borders, ", ")));
    }
}

void read_sway(const Key& key, Style& style, Diagnostics& diagnostics) {
    constexpr std::string_view expected = "degrees from 0 to 90";
    const auto word = only_word(key, expected, diagnostics);
    if (!word) return;
    const auto degrees = number_in(word->view(), 0, 90);
    if (!degrees) refuse(*word, expected, diagnostics);
    style.sway = degrees.value_or(0.0);
}

/// True for a key whose value was set from outside the file.
bool is_given(const Pattern& pattern, std::string_view name) {
    const Key* key = pattern.find(name);
    return key && key->value.source != pattern.source.get();
}

/// A ground that is given replaces the paper of the pattern, but contradicts a paper that is given.
void read_paper(const Pattern& pattern, Style& style, Diagnostics& diagnostics) {
    constexpr std::string_view expected = "white or none";
    const Key* key = pattern.find("paper");
    if (!key) return;
    const auto word = only_word(*key, expected, diagnostics);
    if (!word) return;
    const std::string text = lower_case(word->view());
    if (text == "none") return;
    if (text != "white") return refuse(*word, expected, diagnostics);
    if (is_given(pattern, "ground")) {
        if (!is_given(pattern, "paper")) return;
        diagnostics.error(*word, "white paper cannot be combined with a ground; give one of the two");
        return;
    }
    put_on_white_paper(style, {.stroke = is_given(pattern, "stroke"),
                               .fill = is_given(pattern, "fill"),
                               .palette = is_given(pattern, "palette"),
                               .dots = is_given(pattern, "dots")});
}

}  // namespace

std::span<const std::string_view> border_names() {
    return named_borders;
}

std::optional<BorderStyle> parse_border(std::string_view text) {
    text = trimmed(text);
    const std::string lower = lower_case(text);
    for (std::size_t i = 0; i < named_borders.size(); ++i) {
        if (lower == named_borders[i]) return BorderStyle{.kind = static_cast<BorderKind>(i)};
    }
    const std::size_t comma = text.find(',');
    BorderStyle border{.kind = BorderKind::pattern, .pattern = std::string(trimmed(text.substr(0, comma)))};
    if (comma != std::string_view::npos) {
        border.corner = trimmed(text.substr(comma + 1));
        if (border.corner.empty() || border.corner.find(',') != std::string::npos) return std::nullopt;
    }
    if (border.pattern.empty()) return std::nullopt;
    return border;
}

std::vector<Colour> fill_powders(const Style& style, std::span<const Colour> others) {
    if (!style.powders.empty() && !style.powders_are_named) return style.powders;
    const std::vector<Colour> all = style.powders.empty() ? *find_powders(powder_names().front()) : style.powders;
    // A line on powder of its own colour could not be seen, nor powder on ground of that colour.
    constexpr double least = 0.1;  // in OKLab
    std::vector<Colour> seen;
    for (const Colour colour : all) {
        const auto is_near = [&](Colour other) { return colour_distance(other, colour) < least; };
        if (std::none_of(others.begin(), others.end(), is_near)) seen.push_back(colour);
    }
    return seen.empty() ? all : seen;
}

/// Okabe and Ito 2008, Color Universal Design: distinguishable by the colour-blind.
std::vector<Colour> default_palette() {
    return {{0x00, 0x00, 0x00, 255}, {0xe6, 0x9f, 0x00, 255}, {0x56, 0xb4, 0xe9, 255}, {0x00, 0x9e, 0x73, 255},
            {0xf0, 0xe4, 0x42, 255}, {0x00, 0x72, 0xb2, 255}, {0xd5, 0x5e, 0x00, 255}, {0xcc, 0x79, 0xa7, 255}};
}

std::optional<Floor> Style::shown_floor() const {
    return floor && ground == mean_colour(*floor) ? floor : std::nullopt;
}

int Style::index(const Pen& pen) const {
    const auto size = static_cast<long long>(palette.size());
    if (size == 0) return 0;
    return static_cast<int>((pen.colour % size + size) % size);
}

Colour Style::line_colour(const Pen& pen) const {
    const int at = index(pen);
    if (at == 0 && stroke_colour) return *stroke_colour;
    return palette.empty() ? black : palette[static_cast<std::size_t>(at)];
}

Colour Style::fill_colour(const Pen& pen) const {
    const int at = index(pen);
    if (at == 0 && fill) return *fill;
    return palette.empty() ? black : palette[static_cast<std::size_t>(at)];
}

std::vector<int> Style::line_slots() const {
    return slots(*this, &Style::line_colour);
}

std::vector<int> Style::fill_slots() const {
    return slots(*this, &Style::fill_colour);
}

bool Style::draws(const Pen& pen) const {
    return stroked && line_colour(pen).alpha > 0 && pen_width(pen) > 0.0;
}

double Style::pen_width(const Pen& pen) const {
    const double width = pen.width * (pen.width_set ? stroke.unit : stroke.value);
    // The comparison is false for NaN.
    return width > 0.0 ? width : 0.0;
}

double Style::line_width(const Pen& pen, double step) const {
    return std::min(pen_width(pen) * (stroke.in_steps ? step : 1.0), widest_pen_mm);
}

double Style::disc_radius(double radius, const Pen& pen, double step) const {
    return radius > 0.0 ? radius * step : line_width(pen, step);
}

Style read_style(const Pattern& pattern, double dpi, Diagnostics& diagnostics) {
    Style style;
    style.ground = white_paper;
    style.palette = default_palette();
    if (const Key* key = pattern.find("line")) read_line(*key, style, diagnostics);
    if (const Key* key = pattern.find("hand")) read_hand(*key, style, diagnostics);
    if (const Key* key = pattern.find("stroke")) read_stroke(*key, dpi, style, diagnostics);
    if (const Key* key = pattern.find("dots")) read_dots(*key, dpi, style, diagnostics);
    if (const Key* key = pattern.find("border")) read_border(*key, style, diagnostics);
    if (const Key* key = pattern.find("fields")) read_fields(*key, style, diagnostics);
    if (const Key* key = pattern.find("tile colours")) read_tile_colours(*key, style, diagnostics);
    if (const Key* key = pattern.find("tile edges")) read_tile_edges(*key, style, diagnostics);
    if (const Key* key = pattern.find("decorate")) style.decoration = read_decoration(*key, diagnostics);
    if (const Key* key = pattern.find("powders")) read_powders(*key, style, diagnostics);
    if (const Key* key = pattern.find("weave")) read_weave(*key, style, diagnostics);
    if (const Key* key = pattern.find("parallel")) read_parallel(*key, style, diagnostics);
    if (const Key* key = pattern.find("ground")) read_ground(*key, style, diagnostics);
    if (const Key* key = pattern.find("fill")) read_fill(*key, pattern.find("map") != nullptr, style, diagnostics);
    if (const Key* key = pattern.find("view")) {
        if (const auto camera = parse_camera(key->value.view())) {
            style.camera = *camera;
        } else {
            diagnostics.error(key->value,
                              "expected AZIMUTH,ELEVATION in degrees (elevation -90 to 90), or front, side or top; "
                              "then optionally ,perspective and ,DISTANCE in radii of the drawing, 1.01 to 1000000");
        }
    }
    style.light = read_light(pattern, diagnostics);
    if (const Key* key = pattern.find("sway")) read_sway(*key, style, diagnostics);
    const Key* palette = pattern.find("palette");
    if (palette) {
        read_palette(*palette, style, diagnostics);
    } else if (style.stroke_colour) {
        // Without a palette of its own a drawing in white has white dots as well.
        style.palette.front() = *style.stroke_colour;
    }
    style.map = read_map_style(pattern, palette ? style.palette : std::vector<Colour>(), diagnostics);
    read_paper(pattern, style, diagnostics);
    return style;
}

}  // namespace sikku
