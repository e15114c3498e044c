#include "art/style/decoration.h"

#include "art/style/values.h"
#include "engine/base/text.h"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace sikku {
namespace {

constexpr std::string_view decorations_expected =
    "kolam, truchet, worms, dots, strands, or 'tile NUMBER … arc FROM TO line FROM TO dot colour NUMBER'";
constexpr int most_colour = 4095;

/// Reads words separated by blanks and semicolons.
class DecorationReader {
public:
    DecorationReader(const Key& key, Diagnostics& diagnostics) : key_(key), diagnostics_(diagnostics) {}

    TileDecoration read() {
        if (!advance()) {
            complain(key_.name_at, fmt::format("'{}:' is empty: expected {}", key_.name, decorations_expected));
            return {};
        }
        if (text_ == "none") {
            if (advance()) complain(word_, fmt::format("'{}: none' must stand alone", key_.name));
            return {};
        }
        for (bool has_word = true; has_word && !has_failed_;) has_word = item();
        if (result_.strands && !result_.kolam && !result_.truchet && !result_.worms && result_.curves.empty()) {
            complain(key_.value, "'strands' colours lines; name lines too, such as 'kolam strands'");
        }
        return has_failed_ ? TileDecoration{} : std::move(result_);
    }

private:
    static bool is_separator(char byte) { return byte == ' ' || byte == '\t' || byte == ';'; }

    /// The next word; false at the end.
    bool advance() {
        const std::string_view value = key_.value.view();
        while (at_ < value.size() && is_separator(value[at_])) ++at_;
        const std::size_t begin = at_;
        while (at_ < value.size() && !is_separator(value[at_])) ++at_;
        word_ = key_.value.part(begin, at_ - begin);
        text_ = lower_case(word_.view());
        return !text_.empty();
    }

    /// Reads the item that the current word begins. Returns true if a word follows.
    bool item() {
        if (text_ == "kolam") return set(result_.kolam);
        if (text_ == "truchet") return set(result_.truchet);
        if (text_ == "worms") return set(result_.worms);
        if (text_ == "dots") return set(result_.dots);
        if (text_ == "strands") return set(result_.strands);
        if (text_ == "tile") return tiles();
        if (text_ == "colour") return colour();
        if (text_ == "arc") return curve(TileCurve::Kind::arc);
        if (text_ == "line") return curve(TileCurve::Kind::line);
        if (text_ == "dot") return curve(TileCurve::Kind::dot);
        const std::string_view near = nearest(
            text_, {"kolam", "truchet", "worms", "dots", "strands", "tile", "colour", "arc", "line", "dot", "none"});
        return complain(
            word_, near.empty()
                       ? fmt::format("unexpected {}: expected {}", quoted_value(word_.view()), decorations_expected)
                       : fmt::format("unexpected {}; did you mean '{}'?", quoted_value(word_.view()), near));
    }

    bool set(bool& value) {
        value = true;
        return advance();
    }

    bool tiles() {
        tiles_.clear();
        bool has_word = advance();
        for (; has_word; has_word = advance()) {
            const auto number = index();
            if (!number) break;
            tiles_.push_back(*number);
        }
        if (tiles_.empty()) {
            return complain(has_word ? word_ : key_.value, "expected the colour numbers of tiles after 'tile'");
        }
        colour_ = 0;
        return has_word;
    }

    bool colour() {
        const Span at = word_;
        if (!advance())
            return complain(at, fmt::format("expected a number from 0 to {} after 'colour'", most_colour));
        const auto number = index();
        if (!number)
            return complain(word_, fmt::format("expected a number from 0 to {} after 'colour'", most_colour));
        colour_ = *number;
        return advance();
    }

    bool curve(TileCurve::Kind kind) {
        if (tiles_.empty()) {
            return complain(word_, fmt::format("'{}' belongs to tiles: begin with 'tile' and their colour numbers",
                                               word_.view()));
        }
        if (result_.curves.size() >= TileDecoration::most_curves) {
            return complain(word_, fmt::format("a decoration has at most {} curves", TileDecoration::most_curves));
        }
        TileCurve curve{.kind = kind, .colour = colour_, .tiles = tiles_};
        if (kind != TileCurve::Kind::dot) {
            const Span name = word_;
            for (double* end : {&curve.from, &curve.to}) {
                const bool has_word = advance();
                const auto place = number_in(text_, 0, TileDecoration::most_sides);
                if (!has_word || !place || *place == TileDecoration::most_sides) {
                    return complain(has_word ? word_ : name,
                                    fmt::format("expected two places on the outline after '{}', such as 0.5 1.5: the "
                                                "number of a side, from 0, and a share of the side",
                                                name.view()));
                }
                *end = *place;
            }
            if (curve.from == curve.to) return complain(name, "expected two different places on the outline");
        }
        result_.curves.push_back(std::move(curve));
        return advance();
    }

    /// The current word as a colour index.
    std::optional<int> index() const {
        const auto number = number_in(text_, 0, most_colour);
        if (!number || *number != static_cast<int>(*number)) return std::nullopt;
        return static_cast<int>(*number);
    }

    bool complain(const Span& at, const std::string& message) {
        diagnostics_.error(at, message);
        has_failed_ = true;
        return false;
    }

    const Key& key_;
    Diagnostics& diagnostics_;
    std::size_t at_ = 0;
    Span word_;
    std::string text_;
    std::vector<int> tiles_;
    int colour_ = 0;
    bool has_failed_ = false;
    TileDecoration result_;
};

}  // namespace

TileDecoration read_decoration(const Key& key, Diagnostics& diagnostics) {
    return DecorationReader(key, diagnostics).read();
}

}  // namespace sikku
