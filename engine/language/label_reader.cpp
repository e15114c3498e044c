#include "engine/language/label_reader.h"

#include "engine/base/keys.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

namespace sikku {
namespace {

std::string number_text(double value) {
    const bool is_whole = std::fabs(value) <= 1e15 && value == std::round(value);
    const std::string text =
        is_whole ? fmt::format("{:.0f}", std::fabs(value)) : fmt::format("{:.6g}", std::fabs(value));
    // The minus of typography is as wide as a digit.
    return value < 0 ? "\u2212" + text : text;
}

}  // namespace

std::uint32_t LabelText::parameters() const {
    std::uint32_t highest = 0;
    for (const Part& part : parts) highest = std::max(highest, part.parameter);
    return highest;
}

std::string LabelText::text(std::span<const double> arguments) const {
    std::string result;
    for (const Part& part : parts) {
        result += part.text;
        if (part.parameter > 0) result += number_text(arguments[part.parameter - 1]);
    }
    return result;
}

LabelReader::LabelReader(const Pattern& pattern, WordReader& reader, Diagnostics& diagnostics)
    : reader_(reader), diagnostics_(diagnostics) {
    read_height(pattern);
    const std::string_view before = find_language_key("label N")->before_symbol();
    for (const Key& key : pattern.keys) {
        const auto named = reader.symbol_of(key, before);
        if (!named) continue;
        const auto [symbol, name] = *named;
        LabelText label{reader.symbols()[symbol].letter, {}};
        if (key.value.empty()) {
            diagnostics.error(key.name_at, "the label is empty: expected a text such as {1}, the first parameter");
        } else if (read_text(key.value, label)) {
            lines_.push_back({symbol, name, key.value, std::move(label)});
        }
    }
}

void LabelReader::read_height(const Pattern& pattern) {
    const Key* key = pattern.find("lettering");
    if (!key) return;
    double height = 0;
    if (read_number(key->value.view(), height) && height > 0 && height <= 1e6) {
        height_ = height;
    } else {
        diagnostics_.error(key->value, "expected the height of letters in steps, above 0 and up to 1000000");
    }
}

/// `{1}` to `{9}` are parameters, everything else is text.
bool LabelReader::read_text(const Span& value, LabelText& label) {
    const std::string_view text = value.view();
    if (text.size() > most_label_bytes) {
        return diagnostics_.refuse(
            value, fmt::format("a label has at most {} bytes; this one has {}", most_label_bytes, text.size()));
    }
    LabelText::Part part;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '{') {
            part.text += text[i];
            continue;
        }
        if (i + 2 >= text.size() || text[i + 1] < '1' || text[i + 1] > '9' || text[i + 2] != '}') {
            return diagnostics_.refuse(value.part(i).part(0, 1),
                                       "expected the number of a parameter in braces, from {1} to {9}");
        }
        part.parameter = static_cast<std::uint32_t>(text[i + 1] - '0');
        label.parts.push_back(std::exchange(part, {}));
        i += 2;
    }
    if (!part.text.empty()) label.parts.push_back(std::move(part));
    return true;
}

void LabelReader::add_to(CommandSettings& settings) const {
    std::vector<std::string> letters;
    for (const Line& line : lines_) {
        const SymbolInfo& symbol = reader_.symbols()[line.symbol];
        letters.push_back(symbol.letter);
        if (symbol.letter == "%" || command_of(symbol, settings).action != Action::pass) {
            letters.back().clear();
            diagnostics_.error(
                line.name,
                fmt::format("'{}' is already a command of the turtle; expected another symbol", symbol.letter));
        }
    }
    settings.labels = std::move(letters);
}

void LabelReader::check(const Grammar& grammar) const {
    if (lines_.empty()) return;
    const std::vector<char> reached = grammar.reachable();
    for (const Line& line : lines_) {
        const std::uint32_t shown = line.label.parameters();
        for (std::size_t i = 0; i < reached.size(); ++i) {
            const SymbolInfo& symbol = grammar.symbols()[i];
            const std::size_t stated = std::max<std::size_t>(symbol.arity, symbol.arguments.size());
            if (!reached[i] || symbol.command.action != Action::label || symbol.letter != line.label.letter ||
                stated >= shown) {
                continue;
            }
            diagnostics_.error(line.value, fmt::format("the label shows parameter {}, but words contain '{}' with {}",
                                                       shown, symbol.letter, stated));
            break;
        }
    }
}

std::vector<LabelText> LabelReader::labels() const {
    std::vector<LabelText> labels;
    for (const Line& line : lines_) labels.push_back(line.label);
    return labels;
}

}  // namespace sikku
