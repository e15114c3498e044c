#include "tests/reference.h"

namespace sikku::reference {

std::vector<Diagnostic> diagnostics_of(const std::string& text, const std::vector<Setting>& settings,
                                       std::string_view variant) {
    Diagnostics diagnostics;
    Pattern pattern = parse_pattern("test.lsys", text, diagnostics);
    if (!diagnostics.is_unreadable()) {
        apply_overrides(pattern, variant, settings, diagnostics);
        check_keys(pattern, diagnostics);
        compile_grammar(pattern, diagnostics);
    }
    return diagnostics.sorted();
}

Grammar grammar_of(const std::string& text, const std::vector<Setting>& settings, std::string_view variant) {
    Diagnostics diagnostics;
    Pattern pattern = parse_pattern("test.lsys", text, diagnostics);
    diagnostics.throw_if_errors();
    apply_overrides(pattern, variant, settings, diagnostics);
    Grammar grammar = compile_grammar(pattern, diagnostics);
    diagnostics.throw_if_errors();
    return grammar;
}

void expect_mistakes(const std::string& text, const std::vector<Expected>& expected,
                     const std::vector<Setting>& settings, std::string_view variant) {
    const std::string shown = text.substr(0, 200);
    const auto found = diagnostics_of(text, settings, variant);
    EXPECT_EQ(found.size(), expected.size()) << shown;
    for (std::size_t i = 0; i < found.size(); ++i) {
        if (i >= expected.size()) {
            ADD_FAILURE() << "of " << shown << "\nnot expected: " << found[i].text();
            continue;
        }
        EXPECT_EQ(found[i].where.line, expected[i].where.line) << shown << '\n' << found[i].text();
        EXPECT_EQ(found[i].where.column, expected[i].where.column) << shown << '\n' << found[i].text();
        EXPECT_NE(found[i].message.find(expected[i].essence), std::string::npos)
            << shown << "\nfound: " << found[i].message << "\nexpected: " << expected[i].essence;
    }
}

::testing::AssertionResult is_utf8(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        const auto byte = [&](std::size_t k) {
            return i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0U;
        };
        const auto tail = [&](std::size_t k) { return byte(k) >= 0x80 && byte(k) < 0xC0; };
        const unsigned lead = byte(0);
        std::size_t length = 0;
        if (lead < 0x80) {
            length = 1;
        } else if (lead >= 0xC2 && lead < 0xE0 && tail(1)) {
            length = 2;
        } else if (lead >= 0xE0 && lead < 0xF0 && tail(1) && tail(2)) {
            const unsigned point = (lead & 15U) << 12 | (byte(1) & 63U) << 6;
            if (point >= 0x800 && (point < 0xD800 || point > 0xDFFF)) length = 3;
        } else if (lead >= 0xF0 && lead < 0xF5 && tail(1) && tail(2) && tail(3)) {
            const unsigned point = (lead & 7U) << 18 | (byte(1) & 63U) << 12;
            if (point >= 0x10000 && point < 0x110000) length = 4;
        }
        if (length == 0) return ::testing::AssertionFailure() << "byte " << i << " of '" << text << "'";
        i += length;
    }
    return ::testing::AssertionSuccess();
}

std::size_t code_points(std::string_view text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char byte) { return (byte & 0xC0) != 0x80; }));
}

Word derived(const Grammar& grammar, const DerivationOptions& options) {
    Collector collector;
    derive(grammar, collector, options);
    EXPECT_TRUE(collector.finished);
    return collector.word;
}

std::string derived_text(const Grammar& grammar, bool interpreted) {
    DerivationOptions options;
    options.interpreted = interpreted;
    return to_text(grammar, derived(grammar, options));
}

std::string derived_text(const std::string& text, bool interpreted) {
    return derived_text(grammar_of(text), interpreted);
}

Survey survey_of(const Grammar& grammar) {
    const auto turtle = Turtle::surveying(grammar);
    derive(grammar, *turtle, {.interpreted = true});
    return turtle->survey();
}

std::string joined(const Tokens& word) {
    std::string text;
    for (const std::string& token : word) text += token;
    return text.empty() ? "*" : text;
}

std::string System::text() const {
    std::string text = keys;
    text += "derivation length: " + std::to_string(schedule.size()) + "\naxiom: " + joined(axiom) + " \n";
    if (!ignored.empty()) text += "ignore: " + joined({ignored.begin(), ignored.end()}) + "\n";
    const auto write = [&](const std::vector<Rule>& rules) {
        for (const Rule& rule : rules) {
            if (!rule.left.empty()) text += joined(rule.left) + " < ";
            text += joined(rule.predecessor);
            if (!rule.right.empty()) text += " > " + joined(rule.right);
            // The blank keeps a '\' at the end from continuing the line.
            text += " --> " + joined(rule.successor) + " \n";
        }
    };
    if (tables.size() == 1) {
        write(tables[0]);
    } else {
        for (std::size_t i = 0; i < tables.size(); ++i) {
            text += "table t" + std::to_string(i) + ":\n";
            write(tables[i]);
        }
        text += "schedule: t0*0";
        for (std::size_t i = 0; i < schedule.size();) {
            std::size_t end = i;
            while (end < schedule.size() && schedule[end] == schedule[i]) ++end;
            text += " t" + std::to_string(schedule[i]) + "*" + std::to_string(end - i);
            i = end;
        }
        text += "\n";
    }
    if (!interpretation.empty()) {
        text += "interpret:\n";
        write(interpretation);
    }
    return text;
}

System system_of(const Grammar& grammar) {
    const auto tokens = [&](const Word& word) {
        Tokens result;
        for (const Symbol symbol : word) result.push_back(symbol_text(grammar.symbols()[symbol]));
        return result;
    };
    const auto rules = [&](const Table& table) {
        std::vector<Rule> result;
        for (const Production& production : table.productions()) {
            result.push_back({tokens(production.left), tokens(production.predecessor), tokens(production.right),
                              tokens(production.successor)});
        }
        return result;
    };
    System system;
    system.axiom = tokens(grammar.axiom());
    for (const Table& table : grammar.tables()) system.tables.push_back(rules(table));
    for (const ScheduleRun& run : grammar.schedule()) {
        system.schedule.insert(system.schedule.end(), static_cast<std::size_t>(run.steps), run.table);
    }
    if (grammar.interpretation()) system.interpretation = rules(*grammar.interpretation());
    for (Symbol symbol = 0; symbol < grammar.symbols().size(); ++symbol) {
        if (grammar.ignored(symbol)) system.ignored.insert(symbol_text(grammar.symbols()[symbol]));
    }
    return system;
}

bool left_context_matches(const Tokens& context, const Tokens& word, std::size_t at,
                          const std::set<std::string>& ignored) {
    auto i = static_cast<std::ptrdiff_t>(at) - 1;
    const auto symbol = [&] { return word[static_cast<std::size_t>(i)]; };
    for (std::size_t k = context.size(); k > 0;) {
        if (i < 0) return false;
        if (ignored.contains(symbol()) || symbol() == "[") {
            --i;
        } else if (symbol() == "]") {
            int level = 0;
            for (--i; i >= 0; --i) {
                if (symbol() == "]") ++level;
                if (symbol() == "[" && level-- == 0) break;
            }
            --i;
        } else if (symbol() == context[k - 1]) {
            --i;
            --k;
        } else {
            return false;
        }
    }
    return true;
}

bool right_context_matches(const Tokens& context, const Tokens& word, std::size_t at,
                           const std::set<std::string>& ignored) {
    for (std::size_t k = 0; k < context.size();) {
        if (at >= word.size()) return false;
        if (ignored.contains(word[at])) {
            ++at;
        } else if (word[at] == "[") {
            int level = 0;
            for (++at; at < word.size(); ++at) {
                if (word[at] == "[") ++level;
                if (word[at] == "]" && level-- == 0) break;
            }
            ++at;
        } else if (word[at] == context[k]) {
            ++at;
            ++k;
        } else {
            return false;
        }
    }
    return true;
}

Tokens rewritten(const std::vector<Rule>& rules, const std::set<std::string>& ignored, const Tokens& word) {
    Tokens result;
    for (std::size_t at = 0; at < word.size();) {
        const Rule* chosen = nullptr;
        for (const bool with_context : {true, false}) {
            for (const Rule& rule : rules) {
                const std::size_t end = at + rule.predecessor.size();
                if (chosen || (rule.left.empty() && rule.right.empty()) == with_context || end > word.size())
                    continue;
                if (!std::equal(rule.predecessor.begin(), rule.predecessor.end(),
                                word.begin() + static_cast<std::ptrdiff_t>(at))) {
                    continue;
                }
                if (left_context_matches(rule.left, word, at, ignored) &&
                    right_context_matches(rule.right, word, end, ignored)) {
                    chosen = &rule;
                }
            }
        }
        if (chosen) {
            result.insert(result.end(), chosen->successor.begin(), chosen->successor.end());
            at += chosen->predecessor.size();
        } else {
            result.push_back(word[at++]);
        }
    }
    return result;
}

std::optional<Tokens> rewrite_level_by_level(const System& system, bool interpreted, std::size_t most) {
    Tokens word = system.axiom;
    for (const std::size_t table : system.schedule) {
        word = rewritten(system.tables[table], system.ignored, word);
        if (word.size() > most) return std::nullopt;
    }
    if (interpreted) word = rewritten(system.interpretation, {}, word);
    if (word.size() > most) return std::nullopt;
    return word;
}

Tokens tokens_of(const Grammar& grammar, const Word& word) {
    Tokens tokens;
    for (const Symbol symbol : word) tokens.push_back(symbol_text(grammar.symbols()[symbol]));
    return tokens;
}

Tokens random_word(Dice& dice, const Kind& kind, std::size_t length, int net) {
    Tokens word;
    for (std::size_t i = 0; i < length; ++i) {
        word.push_back(!kind.signs.empty() && dice.once_in(3) ? dice.one_of(kind.signs) : dice.one_of(kind.letters));
    }
    const auto insert = [&](const std::string& token) {
        const std::size_t at = dice.below(word.size() + 1);
        word.insert(word.begin() + static_cast<std::ptrdiff_t>(at), token);
        return at;
    };
    switch (kind.brackets) {
        case Kind::Brackets::none:
            break;
        case Kind::Brackets::nested:
            if (dice.once_in(2)) {
                const std::size_t open = insert("[");
                const std::size_t close = open + 1 + dice.below(word.size() - open);
                word.insert(word.begin() + static_cast<std::ptrdiff_t>(close), "]");
            }
            break;
        case Kind::Brackets::loose:
            if (net > 0) insert(dice.once_in(2) ? "L" : "[");
            if (net < 0) insert(dice.once_in(2) ? "R" : "]");
            if (dice.once_in(3)) {
                const std::size_t open = insert(dice.once_in(2) ? "L" : "[");
                const std::size_t close =
                    dice.once_in(6) ? dice.below(open + 1) : open + 1 + dice.below(word.size() - open);
                word.insert(word.begin() + static_cast<std::ptrdiff_t>(close), dice.once_in(2) ? "R" : "]");
            }
            break;
        case Kind::Brackets::anywhere:
            while (dice.once_in(3)) insert(dice.once_in(2) ? "[" : "]");
            break;
    }
    return word;
}

System random_system(unsigned seed, const Kind& kind) {
    Dice dice(seed);
    System system;
    system.axiom = random_word(dice, kind, 1 + dice.below(4));
    const auto rule_for = [&](const std::string& letter, int net) {
        std::size_t length = dice.below(kind.longest + 1);
        if (!kind.empties || dice.once_in(2)) length = std::max<std::size_t>(length, 1);
        return Rule{{}, {letter}, {}, random_word(dice, kind, length, net)};
    };
    for (std::size_t t = 0; t < kind.tables; ++t) {
        std::vector<Rule> rules;
        for (const std::string& letter : kind.letters) {
            if (letter.find('(') == std::string::npos && !dice.once_in(4)) rules.push_back(rule_for(letter, 0));
        }
        if (kind.brackets == Kind::Brackets::loose) {
            rules.push_back(rule_for("L", 1));
            rules.push_back(rule_for("R", -1));
        }
        if (kind.signs.size() > 1 && kind.signs[1].size() == 1 && dice.once_in(3)) {
            rules.push_back({{}, {kind.signs[0]}, {}, {kind.signs[1]}});
            rules.push_back({{}, {kind.signs[1]}, {}, {kind.signs[0]}});
        }
        std::set<std::array<Tokens, 3>> seen;
        for (const Rule& rule : rules) seen.insert({rule.left, rule.predecessor, rule.right});
        const auto plain = [&](std::size_t least, std::size_t most) {
            Tokens word;
            const std::size_t length = least + dice.below(most - least + 1);
            for (std::size_t i = 0; i < length; ++i) word.push_back(dice.one_of(kind.letters));
            return word;
        };
        for (std::size_t i = 0; kind.contexts && i < 6; ++i) {
            Rule rule = rule_for(dice.one_of(kind.letters), 0);
            rule.left = plain(0, kind.longest_context);
            rule.right = plain(0, kind.longest_context);
            if (seen.insert({rule.left, rule.predecessor, rule.right}).second) rules.push_back(rule);
        }
        for (std::size_t i = 0; kind.subwords && i < 3; ++i) {
            Rule rule = rule_for("F", 0);
            rule.predecessor = plain(2, 3);
            if (kind.contexts && dice.once_in(2)) rule.right = plain(1, 1);
            if (!seen.insert({rule.left, rule.predecessor, rule.right}).second) continue;
            rules.insert(rules.begin() + static_cast<std::ptrdiff_t>(dice.below(rules.size() + 1)), rule);
        }
        system.tables.push_back(std::move(rules));
    }
    const std::size_t steps = dice.below(kind.most_steps + 1);
    while (system.schedule.size() < steps) {
        const std::size_t table = dice.below(kind.tables);
        system.schedule.insert(system.schedule.end(), std::min(steps - system.schedule.size(), 1 + dice.below(3)),
                               table);
    }
    if (kind.interpreted) {
        for (const std::string& letter : kind.letters) {
            if (letter.find('(') == std::string::npos && dice.once_in(2))
                system.interpretation.push_back(rule_for(letter, 0));
        }
    }
    if (kind.contexts && dice.once_in(2)) {
        system.ignored.insert(dice.one_of(kind.letters));
        system.ignored.insert(kind.signs.begin(), kind.signs.end());
    }
    return system;
}

Walk walk(const System& system, const Tokens& word, bool moves_draw) {
    struct State {
        long double x = 0, y = 0, heading = 0;
        Pen pen;
    };
    struct Open {
        State state;
        std::size_t position;
    };
    struct Filling {
        std::vector<glm::dvec2> vertices;
        std::size_t position;
    };
    Walk result;
    State state;
    state.heading = system.heading;
    std::vector<Open> stack;
    std::vector<Filling> fillings;
    bool down = false;
    const auto here = [&] { return glm::dvec2(static_cast<double>(state.x), static_cast<double>(state.y)); };
    const auto near = [](glm::dvec2 a, glm::dvec2 b) { return std::hypot(a.x - b.x, a.y - b.y) < 1e-9; };
    const auto widen = [&](std::array<long double, 4>& box) {
        box = {std::min(box[0], state.x), std::min(box[1], state.y), std::max(box[2], state.x),
               std::max(box[3], state.y)};
    };
    const auto lift = [&] {
        if (down) result.strokes.back().closed = near(result.strokes.back().points.front(), here());
        down = false;
    };
    for (std::size_t i = 0; i < word.size(); ++i) {
        const std::string letter = word[i].substr(0, word[i].find('('));
        const bool has_value = letter.size() < word[i].size();
        const long double value = has_value ? std::strtold(word[i].c_str() + letter.size() + 1, nullptr) : 0;
        const bool draws = system.forward.contains(letter);
        if (draws || system.move.contains(letter)) {
            if (draws && !result.ink) result.ink = {state.x, state.y, state.x, state.y};
            if (draws) widen(*result.ink);
            const bool pen_down = draws || moves_draw;
            if (!pen_down) lift();
            if (pen_down && !down) result.strokes.push_back({{here()}, {}, false});
            down = pen_down;
            const long double step = has_value ? value : 1;
            state.x += step * std::cos(state.heading / 180 * std::numbers::pi_v<long double>);
            state.y += step * std::sin(state.heading / 180 * std::numbers::pi_v<long double>);
            widen(result.box);
            ++result.moves;
            if (draws) {
                widen(*result.ink);
                ++result.drawn;
                result.length += std::fabs(step);
            }
            if (pen_down) {
                result.strokes.back().points.push_back(here());
                result.strokes.back().pens.push_back(state.pen);
            }
            if (!fillings.empty()) fillings.back().vertices.push_back(here());
        } else if (letter == "+" || letter == "-") {
            const long double angle = has_value ? value : system.increment;
            state.heading += (letter == "+") == system.plus_turns_left ? angle : -angle;
        } else if (letter == "|") {
            state.heading += 180;
        } else if (letter == "[") {
            if (moves_draw) lift();
            stack.push_back({state, i + 1});
            result.depth = std::max(result.depth, static_cast<std::int64_t>(stack.size()));
        } else if (letter == "]") {
            if (stack.empty()) {
                result.fault = i + 1;
                return result;
            }
            lift();
            state = stack.back().state;
            stack.pop_back();
        } else if (letter == "{") {
            fillings.push_back({{here()}, i + 1});
        } else if (letter == "}") {
            if (fillings.empty()) {
                result.fault = i + 1;
                return result;
            }
            auto& vertices = fillings.back().vertices;
            if (vertices.size() > 1 && near(vertices.front(), vertices.back())) vertices.pop_back();
            if (vertices.size() >= 3) result.polygons.push_back({vertices, state.pen});
            fillings.pop_back();
        } else if (letter == "#" || letter == "!") {
            state.pen.width = has_value       ? static_cast<double>(value)
                              : letter == "#" ? state.pen.width * 1.25
                                              : state.pen.width * 0.8;
            state.pen.width_set = state.pen.width_set || has_value;
        } else if (letter == "'" || letter == ";" || letter == ",") {
            state.pen.colour = has_value       ? static_cast<int>(value)
                               : letter == "," ? state.pen.colour - 1
                                               : state.pen.colour + 1;
        } else if (letter == "@O" || letter == "@.") {
            result.discs.push_back({here(),
                                    letter == "@." ? 0.0
                                    : has_value    ? static_cast<double>(value)
                                                   : 1.0,
                                    state.pen});
        }
    }
    lift();
    if (!stack.empty()) {
        result.fault = stack.back().position;
    } else if (!fillings.empty()) {
        result.fault = fillings.back().position;
    }
    result.x = state.x;
    result.y = state.y;
    result.closed = std::hypot(state.x, state.y) < 1e-9L;
    result.heading = std::fmod(state.heading, 360.0L);
    if (result.heading < -1e-9L) result.heading += 360;
    return result;
}

bool same_heading(double a, double b) {
    const double gap = std::fabs(std::fmod(a - b, 360.0));
    return gap < 1e-7 || gap > 360.0 - 1e-7;
}

}  // namespace sikku::reference
