#include "tests/module_reference.h"

namespace sikku::reference {

std::string text_of(const WrittenWord& word) {
    std::string text;
    for (const Written& module : word) text += module.text();
    return text.empty() ? "*" : text;
}

std::string text_of(const Modules& word) {
    std::string text;
    for (const Module& module : word) text += module.text();
    return text;
}

ModuleSystem module_system_of(const Pattern& pattern) {
    std::vector<std::string> names;
    for (std::string rest = pattern.text("symbols"); !rest.empty();) {
        const std::size_t end = std::min(rest.find(' '), rest.size());
        if (end > 0) names.push_back(rest.substr(0, end));
        rest.erase(0, end + 1);
    }
    const auto word = [&](std::string_view text) {
        WrittenWord result;
        if (text == "*") return result;
        for (std::size_t at = 0; at < text.size();) {
            if (text[at] == ' ') {
                ++at;
                continue;
            }
            std::size_t length = utf8_length(text.substr(at));
            if (text[at] == '@') length = 2;
            for (const std::string& name : names) {
                if (text.substr(at).starts_with(name)) length = std::max(length, name.size());
            }
            Written module{std::string(text.substr(at, length)), {}};
            at += length;
            if (at < text.size() && text[at] == '(') {
                int depth = 0;
                module.parts.emplace_back();
                do {
                    const char byte = text[at++];
                    if (byte == '(' && depth++ == 0) continue;
                    if (byte == ')' && --depth == 0) break;
                    if (byte == ',' && depth == 1) {
                        module.parts.emplace_back();
                    } else if (byte != ' ') {
                        module.parts.back() += byte;
                    }
                } while (true);
            }
            result.push_back(std::move(module));
        }
        return result;
    };
    const auto text_of_span = [](const std::optional<Span>& span) {
        return span ? std::string(span->view()) : std::string();
    };
    const auto rules = [&](const std::vector<ProductionText>& productions) {
        std::vector<ModuleRule> result;
        for (const ProductionText& text : productions) {
            result.push_back({word(text_of_span(text.left)), word(text.predecessor.view()),
                              word(text_of_span(text.right)), text_of_span(text.condition),
                              word(text.successor.view()), text_of_span(text.weight)});
        }
        return result;
    };
    ModuleSystem system;
    system.axiom = word(pattern.text("axiom"));
    system.rules = rules(pattern.common);
    for (const TableText& table : pattern.tables) system.tables.push_back(rules(table.productions));
    system.interpretation = rules(pattern.interpret);
    if (pattern.find("derivation length")) system.steps = std::stoul(pattern.text("derivation length"));
    if (pattern.find("seed")) system.seed = std::stoull(pattern.text("seed"));
    for (const Written& module : word(pattern.text("ignore"))) system.ignored.insert(module.letter);
    while (system.defines.size() < pattern.defines.size()) {
        for (const Define& define : pattern.defines) {
            const std::string text(define.value.view());
            try {
                system.defines[std::string(define.name.view())] = Calculator(text, system.defines, {}, 0).result();
            } catch (const std::out_of_range&) {
                continue;  // one that comes later has to be known first
            }
        }
    }
    return system;
}

ModuleSystem random_modules(unsigned seed, const ModuleKind& kind) {
    Dice dice(seed);
    const std::vector<std::string> letters = {"A", "B", "F"};
    const std::vector<std::string> names = {"x", "y", "z", "u", "v", "w", "a", "b", "c", "d"};
    const auto arity = [&] { return kind.parameters ? dice.below(3) : 0; };
    const auto expression = [&](const std::vector<std::string>& known) {
        if (kind.random && dice.once_in(5)) return std::string("random(0, 3)");
        if (known.empty() || dice.once_in(4)) return dice.one_of(std::vector<std::string>{"1", "2.5", "0.1", "3"});
        const std::string& x = dice.one_of(known);
        const std::string& y = dice.one_of(known);
        switch (dice.below(9)) {
            case 0:
                return x;
            case 1:
                return x + " + 1";
            case 2:
                return x + "*0.7";
            case 3:
                return x + " - 1";
            case 4:
                return "2 * " + y;
            case 5:
                return x + "/3 + " + y + "^2";
            case 6:
                return "mod(" + x + " + 1, 4)";
            case 7:
                return "-" + x + " * min(" + y + ", 2)";
            default:
                return "(" + x + " + " + y + ")/2";
        }
    };
    const auto condition = [&](const std::vector<std::string>& known) -> std::string {
        if (kind.random && dice.once_in(4)) return "random(0, 1) < 0.6";
        if (known.empty()) return "";
        const std::string& x = dice.one_of(known);
        const std::string& y = dice.one_of(known);
        switch (dice.below(6)) {
            case 0:
                return x + " >= 1";
            case 1:
                return x + " < " + y + " || " + x + " > 2";
            case 2:
                return x + " + " + y + " > 2 && !(" + x + " == 1)";
            case 3:
                return "1 <= " + x;
            default:
                return "";
        }
    };
    const auto successor = [&](const std::vector<std::string>& known, std::size_t longest) {
        WrittenWord word;
        const std::size_t length = dice.below(longest + 1);
        const auto some = [&] {
            if (dice.once_in(4)) return Written{dice.one_of(std::vector<std::string>{"+", "-"}), {}};
            Written module{dice.one_of(letters), {}};
            for (std::size_t i = arity(); i > 0; --i) module.parts.push_back(expression(known));
            return module;
        };
        for (std::size_t i = 0; i < length; ++i) {
            word.push_back(some());
            if (kind.cuts && dice.once_in(6)) word.push_back({"%", {}});
            if (dice.once_in(3)) {
                word.push_back({"[", {}});
                for (std::size_t k = dice.below(3); k > 0; --k) word.push_back(some());
                if (kind.cuts && dice.once_in(6)) word.push_back({"%", {}});
                word.push_back({"]", {}});
            }
        }
        return word;
    };
    ModuleSystem system;
    system.seed = seed * 7;
    do {
        system.axiom = successor({}, 5);
    } while (system.axiom.empty());
    system.steps = dice.below(kind.most_steps + 1);
    if (kind.contexts && dice.once_in(2)) system.ignored = {"+", "-"};
    std::map<std::string, bool> certain;   // shapes with a production that always applies
    std::map<std::string, bool> weighted;  // shapes whose productions have weights
    const auto add = [&](std::vector<ModuleRule>& rules, bool homomorphism) {
        ModuleRule rule;
        std::vector<std::string> known;
        const auto shape = [&](const std::string& letter) {
            Written module{letter, {}};
            for (std::size_t i = arity(); i > 0 && known.size() < names.size(); --i) {
                known.push_back(names[known.size()]);
                module.parts.push_back(known.back());
            }
            return module;
        };
        const bool context = kind.contexts && !homomorphism && dice.once_in(2);
        if (context) {
            for (std::size_t i = dice.below(3); i > 0; --i) rule.left.push_back(shape(dice.one_of(letters)));
        }
        rule.predecessor.push_back(shape(dice.one_of(letters)));
        if (kind.subwords && !homomorphism && dice.once_in(4)) {
            rule.predecessor.push_back(shape(dice.one_of(letters)));
        }
        if (context) {
            for (std::size_t i = dice.below(3); i > 0; --i) {
                if (kind.branches && dice.once_in(2)) {
                    rule.right.push_back({"[", {}});
                    if (!dice.once_in(3)) rule.right.push_back(shape(dice.one_of(letters)));
                    if (dice.once_in(5)) {
                        rule.right.push_back({"[", {}});
                        rule.right.push_back({"]", {}});
                    }
                    rule.right.push_back({"]", {}});
                } else {
                    rule.right.push_back(shape(dice.one_of(letters)));
                }
            }
        }
        rule.condition = condition(known);
        const std::string key = (homomorphism ? "h" : "") + rule.shape();
        const auto [found, fresh] = weighted.try_emplace(key, kind.chance && dice.once_in(2));
        if (found->second) {
            rule.weight = !known.empty() && dice.once_in(3) ? known.front() + "*" + known.front() + " + 0.5"
                                                            : dice.one_of(std::vector<std::string>{"1", "0.25", "3"});
        } else if (certain[key]) {
            return;
        } else if (rule.condition.empty()) {
            certain[key] = true;
        }
        rule.successor = successor(known, 3);
        rules.push_back(std::move(rule));
    };
    for (int i = 0; i < 14; ++i) add(system.rules, false);
    for (int i = 0; kind.interpreted && i < 5; ++i) add(system.interpretation, true);
    return system;
}

std::string derived_modules(const Grammar& grammar, bool interpreted) {
    ModuleCollector collector(grammar);
    DerivationOptions options;
    options.interpreted = interpreted;
    derive(grammar, collector, options);
    return to_text(grammar, collector.word);
}

std::string derived_modules(const std::string& text, bool interpreted) {
    return derived_modules(grammar_of(text), interpreted);
}

}  // namespace sikku::reference
