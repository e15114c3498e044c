#include "engine/derivation/drawn_levels.h"

#include "engine/base/chance.h"

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t most_byte_symbols = 256;
constexpr std::int64_t most_drawn_levels = 64;
constexpr double least_expected = 1 << 17;  // symbols; shorter words are not worth the preparation
constexpr double least_growth = 8;          // expected symbols for each symbol of the axiom
constexpr std::size_t longest_beside = 20;  // text before a symbol, after it, or alone
constexpr std::size_t most_kinds = 4096;    // at all levels together
constexpr std::size_t most_table_entries = std::size_t{1} << 16;  // of the tables of a level
constexpr double usual_root = 1 << 13;                            // symbols of a module at low(), on average
constexpr double largest_root = 1 << 15;                          // memory for its expansion, in modules
constexpr Symbol no_symbol = std::numeric_limits<Symbol>::max();

// Texts at level 1: of a kind, its successor, of the kind.
static_assert(2 * longest_beside + Choices::longest < DrawnLevels::longest_text);

/// Chance of an alternative, by the bits that choose it.
double probability(std::span<const std::uint64_t> begins, std::size_t alternative, std::size_t count) {
    const double begin = alternative == 0 ? 0.0 : static_cast<double>(begins[alternative - 1]) * 0x1p-53;
    const double end = alternative + 1 == count ? 1.0 : static_cast<double>(begins[alternative]) * 0x1p-53;
    return std::max(std::min(end, 1.0) - std::min(begin, 1.0), 0.0);
}

}  // namespace

DrawnLevels::DrawnLevels(const Grammar& grammar, const Levels& levels, std::string_view bytes)
    : grammar_(grammar), levels_(levels), bytes_(bytes) {
    if (grammar.is_parametric() || !grammar.is_stochastic() || grammar.symbols().size() > most_byte_symbols) return;
    if (levels.count() < 1 || levels.count() > most_drawn_levels) return;
    for (std::int64_t level = 1; level <= levels.count(); ++level) {
        std::unique_ptr<Choices>& choices = choices_[&levels.table(level)];
        if (!choices) choices = std::make_unique<Choices>(grammar, levels.table(level));
        if (!choices->is_usable()) return;
    }
    if (!is_long()) return;
    find_texts();
    is_usable_ = make_levels();
    if (is_usable_) find_sizes();
}

bool DrawnLevels::is_long() const {
    const std::size_t symbols = grammar_.symbols().size();
    std::vector<double> below(symbols, 1.0);
    for (std::int64_t level = 1; level <= levels_.count(); ++level) {
        const Choices& table = choices(level);
        std::vector<double> here(symbols, 0.0);
        for (Symbol symbol = 0; symbol < symbols; ++symbol) {
            const auto successors = table.all(symbol);
            for (std::size_t k = 0; k < successors.size(); ++k) {
                double sum = 0;
                for (std::size_t i = 0; i < successors[k].size; ++i) sum += below[successors[k].symbols[i]];
                here[symbol] += sum * probability(table.begins(symbol), k, successors.size());
            }
        }
        std::swap(below, here);
    }
    double expected = 0;
    for (const Symbol symbol : grammar_.axiom()) expected += below[symbol];
    return expected >= least_expected && expected >= least_growth * static_cast<double>(grammar_.axiom().size());
}

void DrawnLevels::find_texts() {
    const std::size_t symbols = grammar_.symbols().size();
    texts_.resize(static_cast<std::size_t>(levels_.count()) + 1);
    for (Symbol symbol = 0; symbol < symbols; ++symbol) texts_[0].emplace_back(std::string(1, bytes_[symbol]));
    for (std::int64_t level = 1; level <= levels_.count(); ++level) {
        const std::vector<Text>& below = texts_[static_cast<std::size_t>(level) - 1];
        for (Symbol symbol = 0; symbol < symbols; ++symbol) {
            Text text;
            const auto successors = choices(level).all(symbol);
            if (!is_rewritten(symbol, level)) {
                text = below[symbol];
            } else if (successors.size() == 1) {
                text.emplace();
                for (std::size_t i = 0; i < successors[0].size && text; ++i) {
                    const Text& part = below[successors[0].symbols[i]];
                    if (part && text->size() + part->size() <= longest_beside) {
                        *text += *part;
                    } else {
                        text.reset();
                    }
                }
            }
            texts_[static_cast<std::size_t>(level)].push_back(std::move(text));
        }
    }
}

std::uint32_t DrawnLevels::number(const Kind& kind, std::int64_t level) {
    const auto at = static_cast<std::size_t>(level);
    const auto [found, is_new] = numbers_[at].try_emplace(kind, static_cast<std::uint32_t>(kinds_[at].size()));
    if (is_new) {
        kinds_[at].push_back(kind);
        ++kind_count_;
    }
    return found->second;
}

bool DrawnLevels::make_levels() {
    const auto top = static_cast<std::size_t>(levels_.count());
    numbers_.resize(top + 1);
    kinds_.resize(top + 1);
    drawn_.resize(top + 1);
    axiom_kinds_.assign(grammar_.symbols().size(), 0);
    for (const Symbol symbol : grammar_.axiom()) {
        const Text& text = texts_[top][symbol];
        axiom_kinds_[symbol] = number(text ? Kind{no_symbol, *text, ""} : Kind{symbol, "", ""}, levels_.count());
    }
    for (std::int64_t level = levels_.count(); level > 0; --level) {
        if (!add_alternatives(level)) return false;
    }
    return true;
}

bool DrawnLevels::add_alternatives(std::int64_t level) {
    const auto at = static_cast<std::size_t>(level);
    const std::vector<Kind>& kinds = kinds_[at];
    DrawnLevel& drawn = drawn_[at];
    drawn.step = grammar_.steps_done() + 1 + levels_.count() - level;
    const auto symbol_of = [](const Kind& kind) { return std::get<0>(kind); };
    const auto is_kept = [&](const Kind& kind) {
        return symbol_of(kind) == no_symbol || !is_rewritten(symbol_of(kind), level);
    };
    for (const Kind& kind : kinds) {
        if (is_kept(kind)) continue;
        drawn.alternatives = std::max(drawn.alternatives, choices(level).all(symbol_of(kind)).size());
    }
    if (kinds.size() * drawn.alternatives > most_table_entries) return false;
    std::vector<std::vector<Part>> parts;  // of each alternative
    for (const Kind& kind : kinds) {
        std::size_t count = 1;
        if (is_kept(kind)) {
            add_alternative(level, kind, nullptr, parts);
        } else {
            const auto successors = choices(level).all(symbol_of(kind));
            for (const Choices::Successor& successor : successors) add_alternative(level, kind, &successor, parts);
            const auto begins = choices(level).begins(symbol_of(kind));
            drawn.begins.insert(drawn.begins.end(), begins.begin(), begins.end());
            count = successors.size();
        }
        drawn.keeps.push_back(is_kept(kind) ? std::numeric_limits<std::uint64_t>::max() : 0);
        drawn.begins.resize(drawn.begins.size() + drawn.alternatives - count,
                            std::numeric_limits<std::uint64_t>::max());
        parts.resize(parts.size() + drawn.alternatives - count);
        if (level == 1) drawn.texts.resize(parts.size());
    }
    for (const std::vector<Part>& alternative : parts) drawn.most = std::max(drawn.most, alternative.size());
    if (parts.size() * drawn.most > most_table_entries) return false;
    drawn.children.resize(parts.size() * drawn.most);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        drawn.counts.push_back(static_cast<std::uint32_t>(parts[i].size()));
        for (std::size_t k = 0; k < parts[i].size(); ++k) {
            drawn.children[i * drawn.most + k] = {parts[i][k].add, number(parts[i][k].kind, level - 1)};
        }
    }
    return kind_count_ <= most_kinds;
}

/// Adds the successor of a kind, or the kind itself if it has none.
void DrawnLevels::add_alternative(std::int64_t level, const Kind& kind, const Choices::Successor* successor,
                                  std::vector<std::vector<Part>>& parts) {
    const auto& [symbol, before, after] = kind;
    const std::vector<Text>& below = texts_[static_cast<std::size_t>(level) - 1];
    std::vector<Part>& result = parts.emplace_back();
    std::string pending;
    const auto flush = [&] {
        if (!pending.empty()) result.push_back({0, Kind{no_symbol, pending, ""}});
        pending.clear();
    };
    const auto add_text = [&](const std::string& text) {
        if (level > 1 && pending.size() + text.size() > longest_beside) flush();
        pending += text;
    };
    const auto add_symbol = [&](Symbol child, std::uint64_t add) {
        if (below[child]) return add_text(*below[child]);
        result.push_back({add, Kind{child, pending, ""}});
        pending.clear();
    };
    add_text(before);
    if (successor) {
        for (std::size_t i = 0; i < successor->size; ++i) add_symbol(successor->symbols[i], child_key(0, i));
    } else if (symbol != no_symbol) {
        add_symbol(symbol, 0);
    }
    add_text(after);
    if (level == 1) {
        drawn_[1].texts.push_back(pending);
    } else if (!result.empty() && std::get<0>(result.back().kind) != no_symbol) {
        std::get<2>(result.back().kind) = pending;
    } else {
        flush();
    }
}

void DrawnLevels::find_sizes() {
    for (std::int64_t level = 1; level <= levels_.count(); ++level) {
        DrawnLevel& drawn = drawn_[static_cast<std::size_t>(level)];
        const DrawnLevel& below = drawn_[static_cast<std::size_t>(level) - 1];
        double largest_mean = 0, most_room = 0;
        for (std::size_t kind = 0; kind < drawn.kinds(); ++kind) {
            const auto begins =
                std::span(drawn.begins).subspan(kind * (drawn.alternatives - 1), drawn.alternatives - 1);
            double mean = 0, room = 0;
            for (std::size_t k = 0; k < drawn.alternatives; ++k) {
                const std::size_t alternative = kind * drawn.alternatives + k;
                double size = 0, children_room = 0;
                if (level == 1) {
                    size = static_cast<double>(drawn.texts[alternative].size());
                } else {
                    for (std::size_t i = 0; i < drawn.counts[alternative]; ++i) {
                        const std::uint32_t child = drawn.children[alternative * drawn.most + i].kind;
                        size += below.means[child];
                        children_room += below.rooms[child];
                    }
                }
                mean += size * probability(begins, k, drawn.alternatives);
                room = std::max(room, children_room);
            }
            // Memory for the most children of any module, or for a text.
            room += level == 1 ? static_cast<double>(longest_text) / sizeof(DrawnModule)
                               : static_cast<double>(drawn.most);
            drawn.means.push_back(mean);
            drawn.rooms.push_back(room);
            largest_mean = std::max(largest_mean, mean);
            most_room = std::max(most_room, room);
        }
        if (level > 1 && (largest_mean > usual_root || most_room > largest_root)) break;
        low_ = level;
    }
}

}  // namespace sikku
