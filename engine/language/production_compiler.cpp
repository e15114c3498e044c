#include "engine/language/production_compiler.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <tuple>

namespace sikku {
namespace {

// Limit for all tables together: each repeats the productions that they share.
constexpr std::size_t most_shared = std::size_t{1} << 24;  // symbols of words, 64 more for each production

/// Symbols that are always mirrored, or are their own images.
constexpr std::string_view turns = "+-\\/|&^$[]{}";

/// Exchanges left and right in words: the symbols of each pair that `mirror:` lists, `+` and `-`, `\` and `/`.
class Mirror {
public:
    /// Reads the key `mirror`. A pattern without it has no pairs.
    Mirror(const Pattern& pattern, WordReader& reader, Diagnostics& diagnostics) : reader_(reader) {
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

    bool has_pairs() const { return !images_.empty(); }
    /// The mirror image of a word, whose symbols the reader numbers.
    Word image(const Word& word) const {
        Word result;
        result.reserve(word.size());
        for (const Symbol symbol : word) {
            const auto found = images_.find(reader_.symbols()[symbol].letter);
            result.push_back(found == images_.end()
                                 ? symbol
                                 : reader_.renamed(symbol, found->second.letter, found->second.is_name));
        }
        return result;
    }

private:
    struct Image {
        std::string letter;
        bool is_name = false;
    };

    WordReader& reader_;
    std::map<std::string, Image> images_;  ///< by letter
};

/// Productions of equal predecessor and contexts.
struct Group {
    std::uint32_t number = 0;
    bool is_image = false;        ///< its productions are mirror images
    bool is_certain = false;      ///< one of them has neither condition nor weight
    bool has_conditions = false;  ///< that are not constant
    bool has_variables = false;   ///< weights that are not constant
    bool is_mixed = false;
    std::optional<Span> weighted;    ///< the first weight
    std::optional<Span> unweighted;  ///< the first production without one
    double sum = 0.0;                ///< sum of constant weights
};
using Groups = std::map<std::tuple<Word, Word, Word>, Group>;

class ProductionCompiler {
public:
    ProductionCompiler(const Pattern& pattern, WordReader& reader, Diagnostics& diagnostics)
        : pattern_(pattern), reader_(reader), diagnostics_(diagnostics), mirror_(pattern, reader, diagnostics) {}

    CompiledProductions run() {
        std::vector<Production> common;
        Groups groups;
        add_productions(common, pattern_.common, 0, groups, false);
        std::size_t size = 0;
        for (const Production& production : common) {
            size += 64 + production.left.size() + production.predecessor.size() + production.right.size() +
                    production.successor.size();
        }
        if (pattern_.tables.size() > 1 && size > most_shared / pattern_.tables.size()) {
            diagnostics_.error(pattern_.tables.front().name,
                               "the productions before the first table are too many to be added to every table");
            return {};
        }
        if (pattern_.tables.empty()) {
            weigh(common, groups);
            compiled_.tables.push_back(std::move(common));
        } else {
            for (const TableText& text : pattern_.tables) {
                std::vector<Production> table = common;
                Groups groups_here = groups;
                add_productions(table, text.productions, pattern_.common.size(), groups_here, false);
                weigh(table, groups_here);
                compiled_.tables.push_back(std::move(table));
            }
        }
        if (!pattern_.interpret.empty()) {
            std::vector<Production> table;
            Groups groups_here;
            add_productions(table, pattern_.interpret, 0, groups_here, true);
            weigh(table, groups_here);
            compiled_.interpretation = std::move(table);
        }
        return std::move(compiled_);
    }

private:
    std::optional<Word> context(const std::optional<Span>& text, bool right) {
        if (!text) return Word();
        if (text->empty()) {
            return diagnostics_.refuse(*text, "expected a context; '*' is the empty one");
        }
        auto result = reader_.word(*text, WordPlace::context);
        if (!result) return std::nullopt;
        std::size_t depth = 0;
        for (const Symbol symbol : *result) {
            const std::string& letter = reader_.symbols()[symbol].letter;
            if (letter != "[" && letter != "]") continue;
            if (!right) {
                return diagnostics_.refuse(text->part(text->view().find(letter)),
                                           "a left context cannot contain brackets");
            }
            if (letter == "]" && depth == 0) return diagnostics_.refuse(*text, "this context has a ']' without '['");
            depth += letter == "[" ? 1 : -1;
        }
        if (depth > 0) return diagnostics_.refuse(*text, "this context has a '[' that is not closed");
        return result;
    }

    /// Reads an expression that may be absent; false after an error.
    bool read_expression(const std::optional<Span>& text, const char* if_empty, std::optional<Expression>& read) {
        if (!text) return true;
        if (text->empty()) return diagnostics_.refuse(*text, if_empty);
        read = reader_.expression(*text);
        return read.has_value();
    }

    /// @param first  index of the first of these texts among those of the table
    void add_productions(std::vector<Production>& productions, const std::vector<ProductionText>& texts,
                         std::size_t first, Groups& groups, bool homomorphism) {
        std::size_t before = productions.size();
        auto number = static_cast<std::uint32_t>(first);
        for (const ProductionText& text : texts) {
            const std::uint32_t own_number = number++;
            if (text.predecessor.view() == "*" || text.predecessor.view() == "\xCE\xB5") {
                diagnostics_.error(text.predecessor, "the empty word cannot be a predecessor");
                continue;
            }
            reader_.begin_production();
            auto left = context(text.left, false);
            auto predecessor = reader_.word(text.predecessor, WordPlace::predecessor);
            auto right = context(text.right, true);
            if (!left || !predecessor || !right) continue;
            std::optional<Expression> condition, weight;
            if (!read_expression(text.condition, "expected a condition after ':'", condition)) continue;
            std::vector<Expression> arguments;
            auto successor = reader_.word(text.successor, WordPlace::axiom_or_successor, &arguments);
            if (!successor) continue;
            if (!read_expression(text.weight, "expected a weight after ':'", weight)) continue;
            if (homomorphism && (!left->empty() || !right->empty() || predecessor->size() != 1)) {
                diagnostics_.error(text.predecessor,
                                   "a production of 'interpret:' replaces one symbol, without contexts");
                continue;
            }
            if (reader_.is_parametric()) {
                for (const Word* looked : {&*left, &*predecessor, &*right}) {
                    for (const Symbol symbol : *looked) compiled_.looked_at.try_emplace(symbol, text.predecessor);
                }
            }
            Group& group = groups.try_emplace({*left, *predecessor, *right}).first->second;
            if (group.number == 0) group.number = static_cast<std::uint32_t>(groups.size());
            if (group.is_image) {
                // Productions of a table replace images of common ones.
                before -=
                    std::erase_if(productions, [&](const Production& one) { return one.group == group.number; });
                const std::uint32_t own = group.number;
                group = Group();
                group.number = own;
            }
            if (group.is_certain && !text.weight) {
                diagnostics_.error(text.predecessor,
                                   "this production can never apply: one with the same predecessor and contexts "
                                   "precedes it");
                continue;
            }
            if (!text.condition && !text.weight) group.is_certain = true;
            if (!belongs(text, weight, group)) continue;
            if (condition) {
                if (const auto value = condition->constant()) {
                    if (std::isnan(*value)) diagnostics_.error(*text.condition, "this condition is never a number");
                    warn_of_weight(*text.condition, *value);
                    if (*value == 0) continue;
                    condition.reset();
                } else {
                    group.has_conditions = true;
                    if (condition->uses_chance()) compiled_.uses_chance = true;
                }
            }
            productions.push_back({std::move(*left), std::move(*predecessor), std::move(*right),
                                   std::move(*successor), std::move(condition), std::move(weight),
                                   std::move(arguments), group.number, own_number});
        }
        if (mirror_.has_pairs()) add_images(productions, before, groups);
    }

    /// Adds the mirror images of the productions from `first` on, except where a production has the same predecessor
    /// and contexts.
    void add_images(std::vector<Production>& productions, std::size_t first, Groups& groups) {
        const Groups stated = groups;
        const std::size_t end = productions.size();
        for (std::size_t i = first; i < end; ++i) {
            Production image = productions[i];
            image.left = mirror_.image(image.left);
            image.predecessor = mirror_.image(image.predecessor);
            image.right = mirror_.image(image.right);
            if (stated.contains({image.left, image.predecessor, image.right})) continue;
            image.successor = mirror_.image(image.successor);
            Group group = stated.at({productions[i].left, productions[i].predecessor, productions[i].right});
            group.number = static_cast<std::uint32_t>(groups.size()) + 1;
            group.is_image = true;
            image.group =
                groups.try_emplace({image.left, image.predecessor, image.right}, group).first->second.number;
            productions.push_back(std::move(image));
        }
        if (reader_.symbols().size() > most_symbols) {
            diagnostics_.error(pattern_.find("mirror")->value, "the mirror images have too many different symbols");
        }
    }

    /// Warns of a weight in place of a condition, as in `F : 0.3 --> FF`.
    void warn_of_weight(const Span& condition, double value) {
        double number = 0;
        if (!read_number(condition.trimmed().view(), number) || value == 0 || value == 1) return;
        diagnostics_.warning(condition, fmt::format("this condition always holds; a weight follows the "
                                                    "successor: --> … : {}",
                                                    condition.trimmed().view()));
    }

    /// True if its weight, or the lack of one, agrees with the other productions of the group.
    bool belongs(const ProductionText& text, const std::optional<Expression>& weight, Group& group) {
        if (!weight && !group.unweighted) group.unweighted = text.predecessor;
        if (weight && !group.weighted) group.weighted = *text.weight;
        if (group.weighted && group.unweighted && !group.is_mixed) {
            group.is_mixed = true;
            diagnostics_.error(*group.unweighted,
                               "this production has no weight, but others with the same predecessor and contexts do");
        }
        if (!weight) return true;
        const auto value = weight->constant();
        if (!value) {
            group.has_variables = true;
        } else if (!(*value >= 0) || !std::isfinite(*value)) {
            diagnostics_.error(*text.weight, "expected a finite weight, 0 or more");
            group.has_variables = true;
            return false;
        } else {
            group.sum += *value;
        }
        return true;
    }

    /// Removes productions of weight 0, and choices that constant weights decide.
    void weigh(std::vector<Production>& productions, const Groups& groups) {
        std::vector<const Group*> by_number(groups.size() + 1, nullptr);
        bool any = false;
        for (const auto& [pattern, group] : groups) {
            by_number[group.number] = &group;
            if (!group.weighted) continue;
            any = true;
            if (!group.has_variables && !(group.sum > 0 && std::isfinite(group.sum))) {
                diagnostics_.error(*group.weighted, group.sum > 0 ? "these weights have no finite sum"
                                                                  : "the weights of this predecessor are all 0");
            }
        }
        if (!any || diagnostics_.has_errors()) return;
        const auto is_fixed = [&](const Production& production) {
            const Group& group = *by_number[production.group];
            return production.weight && !group.has_variables && !group.has_conditions;
        };
        std::erase_if(productions, [&](const Production& production) {
            return is_fixed(production) && production.weight->constant() == 0.0;
        });
        std::vector<std::uint32_t> members(groups.size() + 1, 0);
        for (const Production& production : productions) ++members[production.group];
        for (Production& production : productions) {
            if (is_fixed(production) && members[production.group] == 1) production.weight.reset();
            if (production.weight) compiled_.uses_chance = true;
        }
    }

    const Pattern& pattern_;
    WordReader& reader_;
    Diagnostics& diagnostics_;
    Mirror mirror_;
    CompiledProductions compiled_;
};

}  // namespace

CompiledProductions compile_productions(const Pattern& pattern, WordReader& reader, Diagnostics& diagnostics) {
    return ProductionCompiler(pattern, reader, diagnostics).run();
}

}  // namespace sikku
