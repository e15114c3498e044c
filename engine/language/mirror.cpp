#include "engine/language/mirror.h"

#include <fmt/format.h>

#include <string_view>

namespace sikku {
namespace {

/// Symbols that are always mirrored, or are their own images.
constexpr std::string_view turns = "+-\\/|&^$[]{}";

}  // namespace

Mirror::Mirror(const Pattern& pattern, WordReader& reader, Diagnostics& diagnostics) : reader_(reader) {
    const Key* key = pattern.find("mirror");
    const auto list = key ? reader.symbol_list(*key) : std::nullopt;
    if (!list) return;
    if (list->empty() || list->size() % 2 != 0) {
        diagnostics.error(key->value.empty() ? key->name_at : key->value,
                          "expected pairs of symbols, such as A a B b");
        return;
    }
    const auto add = [&](Symbol symbol, Symbol other) {
        const SymbolInfo &from = reader.symbols()[symbol], &to = reader.symbols()[other];
        if (symbol == other) {
            diagnostics.error(key->value, fmt::format("'{}' is paired with itself", from.letter));
        } else if (turns.find(from.letter) != std::string_view::npos) {
            diagnostics.error(key->value,
                              fmt::format("'{}' cannot be listed: turns are mirrored anyway", from.letter));
        } else if (!images_.try_emplace(from.letter, Image{to.letter, to.is_name}).second) {
            diagnostics.error(key->value, fmt::format("'{}' is listed twice", from.letter));
        }
    };
    for (std::size_t i = 0; i < list->size(); i += 2) {
        add((*list)[i], (*list)[i + 1]);
        add((*list)[i + 1], (*list)[i]);
    }
    if (images_.empty()) return;
    for (const auto& [letter, other] : {std::pair("+", "-"), std::pair("\\", "/")}) {
        images_.emplace(letter, Image{other});
        images_.emplace(other, Image{letter});
    }
}

Word Mirror::image(const Word& word) const {
    Word result;
    result.reserve(word.size());
    for (const Symbol symbol : word) {
        const auto found = images_.find(reader_.symbols()[symbol].letter);
        result.push_back(
            found == images_.end() ? symbol : reader_.renamed(symbol, found->second.letter, found->second.is_name));
    }
    return result;
}

}  // namespace sikku
