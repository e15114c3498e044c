// tests/module_reference.h: a slow and obvious second way to words with parameters, chance, cuts and contexts in
// brackets: lists of modules, expressions read anew each time they are evaluated.
#pragma once

#include "engine/base/chance.h"
#include "tests/reference.h"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace sikku::reference {

using Values = std::map<std::string, double>;

/// Recursive descent, one function a level of precedence.
class Calculator {
public:
    /// @param draw  number of the first `random` in it
    Calculator(const std::string& text, const Values& values, const Chance& chance, std::uint32_t draw)
        : text_(text), values_(values), chance_(chance), draw_(draw) {}
    double result() {
        const double value = either();
        if (peek() != '\0') throw std::logic_error("left over in " + text_);
        return value;
    }

private:
    char peek() {
        while (at_ < text_.size() && text_[at_] == ' ') ++at_;
        return at_ < text_.size() ? text_[at_] : '\0';
    }
    bool take(const std::string& token) {
        peek();
        if (text_.compare(at_, token.size(), token) != 0) return false;
        at_ += token.size();
        return true;
    }
    double either() {
        double value = both();
        while (take("||")) {
            const double other = both();
            value = value != 0 || other != 0;
        }
        return value;
    }
    double both() {
        double value = equality();
        while (take("&&")) {
            const double other = equality();
            value = value != 0 && other != 0;
        }
        return value;
    }
    double equality() {
        double value = order();
        while (true) {
            if (take("==")) {
                value = value == order();
            } else if (take("!=")) {
                value = value != order();
            } else {
                return value;
            }
        }
    }
    double order() {
        double value = sum();
        while (true) {
            if (take("<=")) {
                value = value <= sum();
            } else if (take(">=")) {
                value = value >= sum();
            } else if (take("<")) {
                value = value < sum();
            } else if (take(">")) {
                value = value > sum();
            } else {
                return value;
            }
        }
    }
    double sum() {
        double value = product();
        while (true) {
            if (take("+")) {
                value = value + product();
            } else if (take("-")) {
                value = value - product();
            } else {
                return value;
            }
        }
    }
    double product() {
        double value = sign();
        while (true) {
            if (take("*")) {
                value = value * sign();
            } else if (take("/")) {
                value = value / sign();
            } else {
                return value;
            }
        }
    }
    double sign() {
        if (take("-")) return -sign();
        if (peek() == '!' && text_.compare(at_, 2, "!=") != 0 && take("!")) return sign() == 0;
        const double base = primary();
        return take("^") ? std::pow(base, sign()) : base;
    }
    double primary() {
        if (take("(")) {
            const double value = either();
            take(")");
            return value;
        }
        const char first = peek();
        if (first == '.' || std::isdigit(static_cast<unsigned char>(first)) != 0) {
            std::size_t length = 0;
            const double value = std::stod(text_.substr(at_), &length);
            at_ += length;
            return value;
        }
        std::string name;
        const auto goes_on = [](char byte) {
            return byte == '_' || static_cast<unsigned char>(byte) >= 0x80 ||
                   std::isalnum(static_cast<unsigned char>(byte)) != 0;
        };
        while (goes_on(peek())) name += text_[at_++];
        if (!take("(")) return values_.at(name);
        const double a = either();
        double b = 0;
        if (take(",")) b = either();
        take(")");
        if (name == "random") return a + (b - a) * chance_.uniform(draw_++);
        if (name == "min") return std::fmin(a, b);
        if (name == "max") return std::fmax(a, b);
        if (name == "mod") return std::fmod(a, b);
        if (name == "sqrt") return std::sqrt(a);
        if (name == "floor") return std::floor(a);
        throw std::logic_error("no function " + name);
    }

    const std::string& text_;
    const Values& values_;
    const Chance& chance_;
    std::uint32_t draw_;
    std::size_t at_ = 0;
};

struct Module {
    std::string letter;
    std::vector<double> values;
    std::uint64_t place = 0;

    std::string text() const {
        std::string text = letter;
        for (std::size_t i = 0; i < values.size(); ++i) {
            text += i == 0 ? '(' : ',';
            text += std::isfinite(values[i]) ? fmt::format("{}", values[i])
                    : std::isnan(values[i])  ? "0/0"
                    : values[i] > 0          ? "1/0"
                                             : "-1/0";
        }
        return values.empty() ? text : text + ")";
    }
};
using Modules = std::vector<Module>;

/// A letter with names, or with expressions.
struct Written {
    std::string letter;
    std::vector<std::string> parts;

    std::string text() const {
        std::string text = letter;
        for (std::size_t i = 0; i < parts.size(); ++i) text += (i == 0 ? "(" : ",") + parts[i];
        return parts.empty() ? text : text + ")";
    }
    bool is(const Module& module) const { return letter == module.letter && parts.size() == module.values.size(); }
};
using WrittenWord = std::vector<Written>;

std::string text_of(const WrittenWord& word);
std::string text_of(const Modules& word);

struct ModuleRule {
    WrittenWord left, predecessor, right;
    std::string condition;
    WrittenWord successor;
    std::string weight;

    /// Letters and numbers of parameters.
    std::string shape() const {
        std::string text;
        for (const WrittenWord* word : {&left, &predecessor, &right}) {
            for (const Written& module : *word) text += fmt::format("{}{} ", module.letter, module.parts.size());
            text += '|';
        }
        return text;
    }
};

struct ModuleSystem {
    WrittenWord axiom;
    std::vector<ModuleRule> rules;
    std::vector<std::vector<ModuleRule>> tables{};  ///< added to `rules`; not written by text()
    std::vector<std::size_t> schedule{};            ///< the table of each step, if there are any
    std::vector<ModuleRule> interpretation;
    std::size_t steps = 0;
    std::uint64_t seed = 0;
    std::set<std::string> ignored;
    Values defines;  ///< not written by text()

    std::string text() const {
        std::string text = fmt::format("axiom: {} \nderivation length: {}\nseed: {}\n", text_of(axiom), steps, seed);
        if (!ignored.empty()) {
            text += "ignore: ";
            for (const std::string& letter : ignored) text += letter;
            text += " \n";
        }
        const auto write = [&](const std::vector<ModuleRule>& productions) {
            for (const ModuleRule& rule : productions) {
                if (!rule.left.empty()) text += text_of(rule.left) + " < ";
                text += text_of(rule.predecessor);
                if (!rule.right.empty()) text += " > " + text_of(rule.right);
                if (!rule.condition.empty()) text += " : " + rule.condition;
                text += " --> " + text_of(rule.successor);
                if (!rule.weight.empty()) text += " : " + rule.weight;
                text += " \n";
            }
        };
        write(rules);
        if (!interpretation.empty()) {
            text += "interpret:\n";
            write(interpretation);
        }
        return text;
    }
};

class ModuleReference {
public:
    explicit ModuleReference(const ModuleSystem& system) : system_(system) {
        // `random` draws by its number in the file; draw 0 chooses among weights.
        const auto count = [this](const std::string& text) {
            draws_.try_emplace(&text, next_draw_);
            for (std::size_t at = text.find("random("); at != std::string::npos; at = text.find("random(", at + 1)) {
                ++next_draw_;
            }
        };
        const auto count_word = [&](const WrittenWord& word) {
            for (const Written& module : word) {
                for (const std::string& part : module.parts) count(part);
            }
        };
        count_word(system.axiom);
        const auto count_rules = [&](const std::vector<ModuleRule>& rules) {
            for (const ModuleRule& rule : rules) {
                count(rule.condition);
                count_word(rule.successor);
                count(rule.weight);
            }
        };
        count_rules(system.rules);
        for (const auto& table : system.tables) count_rules(table);
        count_rules(system.interpretation);
    }

    /// Empty if a word on the way is too long.
    std::optional<Modules> word(bool interpreted, std::size_t most) {
        Modules word;
        for (std::size_t i = 0; i < system_.axiom.size(); ++i) {
            word.push_back(
                made(system_.axiom[i], {}, {axiom_place(system_.seed, i), 0}, axiom_place(system_.seed, i)));
        }
        std::int64_t step = 0;
        while (step < static_cast<std::int64_t>(system_.steps)) {
            std::vector<const ModuleRule*> rules = pointers(system_.rules);
            if (!system_.tables.empty()) {
                const auto table = system_.schedule.at(static_cast<std::size_t>(step));
                for (const ModuleRule& rule : system_.tables.at(table)) rules.push_back(&rule);
            }
            word = rewritten(rules, system_.ignored, without_cuts(word), ++step);
            if (word.size() > most) return std::nullopt;
        }
        if (interpreted) word = rewritten(pointers(system_.interpretation), {}, word, ++step);
        return word;
    }

private:
    static std::vector<const ModuleRule*> pointers(const std::vector<ModuleRule>& rules) {
        std::vector<const ModuleRule*> result;
        for (const ModuleRule& rule : rules) result.push_back(&rule);
        return result;
    }

    double value(const std::string& text, const Values& values, const Chance& chance) const {
        if (system_.defines.empty()) return Calculator(text, values, chance, draws_.at(&text)).result();
        Values all = values;  // formal parameters come first
        all.insert(system_.defines.begin(), system_.defines.end());
        return Calculator(text, all, chance, draws_.at(&text)).result();
    }

    Module made(const Written& module, const Values& values, const Chance& chance, std::uint64_t place) const {
        Module result{module.letter, {}, place};
        for (const std::string& part : module.parts) result.values.push_back(value(part, values, chance));
        return result;
    }

    static Modules without_cuts(const Modules& word) {
        Modules result;
        for (std::size_t i = 0; i < word.size(); ++i) {
            if (word[i].letter == "%") {
                int depth = 0;
                while (i < word.size() && !(word[i].letter == "]" && depth == 0)) {
                    if (word[i].letter == "[") ++depth;
                    if (word[i].letter == "]") --depth;
                    ++i;
                }
                if (i == word.size()) break;
            }
            result.push_back(word[i]);
        }
        return result;
    }

    static void name(const Written& shape, const Module& module, Values& values) {
        for (std::size_t i = 0; i < shape.parts.size(); ++i) values[shape.parts[i]] = module.values[i];
    }

    /// After the ']' that closes the branch whose '[' is at `at`.
    static std::size_t after_branch(const Modules& word, std::size_t at) {
        int depth = 0;
        for (; at < word.size(); ++at) {
            if (word[at].letter == "[") ++depth;
            if (word[at].letter == "]" && --depth == 0) return at + 1;
        }
        return at;
    }

    static bool left_fits(const WrittenWord& context, const Modules& word, std::size_t at,
                          const std::set<std::string>& ignored, Values& values) {
        auto i = static_cast<std::ptrdiff_t>(at) - 1;
        for (std::size_t k = context.size(); k > 0;) {
            if (i < 0) return false;
            const Module& module = word[static_cast<std::size_t>(i)];
            if (ignored.contains(module.letter) || module.letter == "[") {
                --i;
            } else if (module.letter == "]") {
                int depth = 0;
                for (; i >= 0; --i) {
                    if (word[static_cast<std::size_t>(i)].letter == "]") ++depth;
                    if (word[static_cast<std::size_t>(i)].letter == "[" && --depth == 0) break;
                }
                --i;
            } else if (context[k - 1].is(module)) {
                name(context[--k], module, values);
                --i;
            } else {
                return false;
            }
        }
        return true;
    }

    static bool right_fits(const WrittenWord& context, const Modules& word, std::size_t at,
                           const std::set<std::string>& ignored, Values& values) {
        for (std::size_t k = 0; k < context.size(); ++k) {
            if (context[k].letter == "[") {
                WrittenWord inner;
                int depth = 1;
                for (++k; !(context[k].letter == "]" && depth == 1); ++k) {
                    if (context[k].letter == "[") ++depth;
                    if (context[k].letter == "]") --depth;
                    inner.push_back(context[k]);
                }
                while (at < word.size() && ignored.contains(word[at].letter)) ++at;
                if (at >= word.size() || word[at].letter != "[") return false;
                if (!right_fits(inner, word, at + 1, ignored, values)) return false;
                at = after_branch(word, at);
                continue;
            }
            while (at < word.size() && (ignored.contains(word[at].letter) || word[at].letter == "[")) {
                at = word[at].letter == "[" ? after_branch(word, at) : at + 1;
            }
            if (at >= word.size() || !context[k].is(word[at])) return false;
            name(context[k], word[at++], values);
        }
        return true;
    }

    Modules rewritten(const std::vector<const ModuleRule*>& rules, const std::set<std::string>& ignored,
                      const Modules& word, std::int64_t step) const {
        Modules result;
        for (std::size_t at = 0; at < word.size();) {
            const Chance chance{word[at].place, step};
            const auto fits = [&](const ModuleRule& rule, Values& values) {
                for (std::size_t i = 0; i < rule.predecessor.size(); ++i) {
                    if (at + i >= word.size() || !rule.predecessor[i].is(word[at + i])) return false;
                    name(rule.predecessor[i], word[at + i], values);
                }
                return left_fits(rule.left, word, at, ignored, values) &&
                       right_fits(rule.right, word, at + rule.predecessor.size(), ignored, values) &&
                       (rule.condition.empty() || value(rule.condition, values, chance) != 0);
            };
            const ModuleRule* chosen = nullptr;
            for (const bool with_context : {true, false}) {
                for (const ModuleRule* rule : rules) {
                    Values values;
                    if (chosen || (rule->left.empty() && rule->right.empty()) == with_context) continue;
                    if (fits(*rule, values)) chosen = rule;
                }
            }
            if (!chosen) {
                result.push_back(word[at++]);
                continue;
            }
            if (!chosen->weight.empty()) {
                std::vector<std::pair<const ModuleRule*, double>> weighted;
                double sum = 0;
                for (const ModuleRule* rule : rules) {
                    Values values;
                    if (rule->shape() != chosen->shape() || !fits(*rule, values)) continue;
                    weighted.emplace_back(rule, value(rule->weight, values, chance));
                    sum += weighted.back().second;
                }
                double left = chance.uniform(0) * sum;
                for (const auto& [rule, weight] : weighted) {
                    chosen = rule;
                    left -= weight;
                    if (left < 0) break;
                }
            }
            Values values;
            fits(*chosen, values);
            for (std::size_t i = 0; i < chosen->successor.size(); ++i) {
                result.push_back(made(chosen->successor[i], values, chance, child_place(word[at].place, i)));
            }
            at += chosen->predecessor.size();
        }
        return result;
    }

    const ModuleSystem& system_;
    std::map<const std::string*, std::uint32_t> draws_;
    std::uint32_t next_draw_ = 1;
};

/// What a file states, read by another way; which table applies when is left to the caller.
ModuleSystem module_system_of(const Pattern& pattern);

struct ModuleKind {
    bool parameters = true;
    bool chance = false;  ///< weights
    bool random = false;  ///< in expressions
    bool contexts = false;
    bool branches = false;  ///< in contexts
    bool cuts = false;
    bool subwords = false;
    bool interpreted = false;
    std::size_t most_steps = 6;
};

ModuleSystem random_modules(unsigned seed, const ModuleKind& kind);

/// What the engine hands over.
class ModuleCollector : public SymbolSink {
public:
    explicit ModuleCollector(const Grammar& grammar) : grammar_(grammar) {}
    void symbols(const Run& run) override {
        EXPECT_FALSE(run.symbols.empty());
        std::size_t own = 0;
        for (const Symbol symbol : run.symbols) own += grammar_.symbols()[symbol].arity;
        EXPECT_EQ(run.arguments.size(), own);
        word.symbols.insert(word.symbols.end(), run.symbols.begin(), run.symbols.end());
        word.arguments.insert(word.arguments.end(), run.arguments.begin(), run.arguments.end());
    }
    ModuleWord word;

private:
    const Grammar& grammar_;
};

std::string derived_modules(const Grammar& grammar, bool interpreted = false);
std::string derived_modules(const std::string& text, bool interpreted = false);

}  // namespace sikku::reference
