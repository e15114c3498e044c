// engine/import/cpfg_pattern.cpp: writes a system of cpfg as a pattern.
#include "engine/import/cpfg_system.h"

#include <algorithm>
#include <cstdlib>

namespace sikku::cpfg {
namespace {

constexpr long long most_scheduled = 20'000;  // steps of a pattern with decomposition

std::string written(const std::vector<Formal>& modules, std::string_view between) {
    std::string text;
    for (const Formal& module : modules) {
        if (!text.empty()) text += between;
        text += module.letter;
        for (std::size_t i = 0; i < module.names.size(); ++i) text += (i == 0 ? '(' : ',') + module.names[i];
        if (!module.names.empty()) text += ')';
    }
    return text;
}

/// Ends a line. Removes a blank before a final backslash, with which it would continue the line.
std::string line_of(std::string text) {
    if (text.ends_with(" \\")) text.erase(text.size() - 2, 1);
    return text + '\n';
}

std::string written(const Rule& rule) {
    std::string text;
    if (!rule.left.empty()) text += written(rule.left, " ") + " < ";
    text += written(rule.predecessor, " ");
    if (!rule.right.empty()) text += " > " + written(rule.right, " ");
    if (rule.condition) text += " : " + rule.condition->text;
    text += " --> " + (rule.successor.empty() ? "*" : rule.successor);
    if (rule.weight) text += " : " + rule.weight->text;
    return line_of(std::move(text));
}

/// A condition with the parameters of another predecessor; nullopt if one of those is the name of a define in it.
std::optional<std::string> renamed(const Value& condition, const std::vector<Formal>& from,
                                   const std::vector<Formal>& to) {
    std::map<std::string, std::string, std::less<>> names;
    std::set<std::string, std::less<>> taken;
    for (std::size_t i = 0; i < from.size(); ++i) {
        for (std::size_t k = 0; k < from[i].names.size(); ++k) names[from[i].names[k]] = to[i].names[k];
    }
    for (const Formal& module : to) taken.insert(module.names.begin(), module.names.end());
    std::string result;
    const std::string& text = condition.text;
    for (std::size_t i = 0; i < text.size();) {
        if (!continues_identifier(text[i]) && text[i] != '.') {
            result += text[i++];
            continue;
        }
        std::size_t end = i;
        while (end < text.size() && (continues_identifier(text[end]) || text[end] == '.')) ++end;
        const std::string_view name = std::string_view(text).substr(i, end - i);
        const auto found = names.find(name);
        const bool is_function = end < text.size() && text[end] == '(';
        if (found != names.end()) {
            result += found->second;
        } else if (!is_function && taken.contains(name)) {
            return std::nullopt;
        } else {
            result += name;
        }
        i = end;
    }
    return result;
}

/// Drops productions that can never apply, because an earlier one with the same modules always does.
void drop_dead(std::vector<Rule>& rules, Report& report) {
    std::set<std::string> certain;
    std::erase_if(rules, [&](const Rule& rule) {
        const std::string key = type_of(rule.left) + "<" + type_of(rule.predecessor) + ">" + type_of(rule.right);
        if (certain.contains(key) && !rule.weight) {
            report.loss(rule.at, "a production that can never apply, because an earlier one always does");
            return true;
        }
        if (!rule.condition && !rule.weight) certain.insert(key);
        return false;
    });
}

/// The letters of a word, without parameters.
std::set<std::string> letters_of(const std::string& word) {
    std::set<std::string> letters;
    std::size_t depth = 0;
    for (std::size_t at = 0; at < word.size();) {
        if (word[at] == '(') ++depth;
        if (word[at] == ')') --depth;
        const bool is_long = word[at] == '@' || static_cast<unsigned char>(word[at]) >= 0x80;
        const std::size_t bytes = is_long ? 2 : 1;
        if (depth == 0 && word[at] != ')') letters.insert(word.substr(at, bytes));
        at += bytes;
    }
    return letters;
}

/// Rounds after which no production of a decomposition applies, at most `depth`: the longest chain of letters that
/// derive each other. A letter that derives itself may continue as long as its conditions allow.
long long rounds_of(const std::vector<Rule>& rules, long long depth) {
    std::map<std::string, std::set<std::string>> derived;
    for (const Rule& rule : rules) derived[rule.predecessor.front().letter].merge(letters_of(rule.successor));
    std::map<std::string, long long> rounds;
    for (const auto& [letter, letters] : derived) rounds[letter] = 1;
    // The longest chain without a cycle has no more links than there are letters.
    for (std::size_t pass = 0; pass <= derived.size(); ++pass) {
        bool is_settled = true;
        for (const auto& [letter, letters] : derived) {
            for (const std::string& next : letters) {
                const auto found = rounds.find(next);
                if (found == rounds.end() || found->second < rounds[letter]) continue;
                rounds[letter] = found->second + 1;
                is_settled = false;
            }
        }
        if (!is_settled) continue;
        long long most = 0;
        for (const auto& [letter, count] : rounds) most = std::max(most, count);
        return std::min(most, depth);
    }
    return depth;
}

class PatternWriter {
public:
    PatternWriter(System system, const View& view, Report& report)
        : system_(std::move(system)), view_(view), report_(report) {}

    std::string write(const std::string& name, const SourcePointer& file) {
        weigh(system_.rules);
        weigh(system_.decomposition);
        if (!system_.seed) restore_order();
        drop_dead(system_.rules, report_);
        drop_dead(system_.decomposition, report_);
        const std::string schedule = decomposition();
        const std::string contexts = list();
        const std::string drawing = interpretation();
        for (const char letter : system_.letters.called) {
            if (system_.letters.named.contains(letter)) {
                report_.once("called", system_.at, "productions that apply to the letters of @ functions");
            }
        }
        if (report_.failed()) return {};
        std::string body;
        for (const auto& [define, text] : system_.defines) body += fmt::format("define {} = {}\n", define, text);
        if (!body.empty()) body += '\n';
        // Polygons of cpfg are those of a framework, in which G and g add no vertex.
        const bool has_polygons = system_.letters.symbols.contains("{");
        body += fmt::format("derivation length: {}\n{}\nturn: left\n{}\n", system_.steps,
                            view_.angle.empty() ? "angle increment: 45" : view_.angle,
                            has_polygons ? "polygons: framework" : "forward: F G\nmove: f g");
        if (system_.seed) body += fmt::format("seed: {}\n", std::abs(*system_.seed));
        if (!view_.scale.empty()) body += view_.scale + '\n';
        const std::string stroke = view_.stroke.empty() && system_.letters.sets_width ? "stroke: 1 px" : view_.stroke;
        if (!stroke.empty()) body += stroke + '\n';
        body += contexts;
        body += line_of("axiom: " + (system_.axiom->empty() ? std::string("*") : *system_.axiom));
        if (!schedule.empty()) body += "\ntable step:\n";
        const auto write_rules = [&](const std::vector<Rule>& rules) {
            for (const Rule& rule : rules) {
                body += written(rule);
                if (body.size() > most_import_bytes) break;  // reported by the caller
            }
        };
        write_rules(system_.rules);
        if (!schedule.empty()) {
            body += "\ntable decompose:\n";
            write_rules(system_.decomposition);
            body += schedule;
        }
        body += drawing;
        std::string comments;
        if (!schedule.empty()) {
            comments += fmt::format(
                "// A step of cpfg is {} here: a step, and {} of decomposition. -n {} is cpfg's step 1.\n",
                rounds_ + 1, rounds_ == 1 ? "one" : fmt::format("{}", rounds_), 2 * rounds_ + 1);
        }
        for (const auto& [letter, free] : system_.letters.surfaces) {
            comments +=
                fmt::format("// The surface ~{} is ~{} here, as {} would move the turtle.\n", letter, free, letter);
        }
        const bool is_number = std::all_of(system_.label.begin(), system_.label.end(), is_digit);
        const std::string title = is_number ? name : system_.label;
        return import_head(title, import_base_name(file->name()), "Imported from a file of cpfg.",
                           report_.losses().list()) +
               '\n' + comments + body;
    }

private:
    /// cpfg applies the first production that matches; patterns first try those with contexts. Conditions keep these
    /// from overtaking earlier context-free ones.
    void restore_order() {
        std::size_t written_bytes = 0;
        std::map<std::string, std::vector<std::size_t>> plain;  // context-free ones so far, by their first letter
        std::vector<Rule> kept;
        for (Rule& rule : system_.rules) {
            std::vector<std::size_t>& before = plain[rule.predecessor.front().letter];
            bool is_dead = false;
            if (rule.has_context()) {
                for (const std::size_t i : before) {
                    if (is_dead) break;
                    const Rule& other = kept[i];
                    const std::size_t common = std::min(other.predecessor.size(), rule.predecessor.size());
                    std::vector<Formal> ours = rule.predecessor, theirs = other.predecessor;
                    ours.resize(common);
                    theirs.resize(common);
                    if (type_of(ours) != type_of(theirs)) continue;
                    if (other.predecessor.size() > common) {
                        report_.loss(rule.at, "the order of this production and an earlier one of several symbols");
                    } else if (!other.condition) {
                        report_.loss(rule.at,
                                     "a production that can never apply, because an earlier one always does");
                        is_dead = true;
                    } else {
                        const auto condition = renamed(*other.condition, theirs, ours);
                        if (!condition || other.condition->is_random) {
                            report_.loss(rule.at, "the order of this production and an earlier one without contexts");
                            continue;
                        }
                        const std::string also = "!(" + *condition + ")";
                        const std::string own = rule.condition ? in_parentheses(*rule.condition, 2) + "&&" : "";
                        rule.condition = Value{own + also, 2, rule.condition && rule.condition->is_random};
                        written_bytes += rule.condition->text.size();
                        if (written_bytes > most_import_bytes) {
                            report_.error(rule.at, "the productions together become longer than 64 MB");
                            return;
                        }
                    }
                }
            } else {
                before.push_back(kept.size());
            }
            if (!is_dead) kept.push_back(std::move(rule));
        }
        system_.rules = std::move(kept);
    }

    /// Writes the schedule of a decomposition: its rounds follow the axiom and each step. Empty if there is none.
    std::string decomposition() {
        rounds_ = rounds_of(system_.decomposition, system_.decomposition_depth);
        if (rounds_ <= 0) return {};
        if ((system_.steps + 1) * (rounds_ + 1) > most_scheduled) {
            report_.loss(system_.decomposition_at, "a decomposition of that many rounds");
            rounds_ = 0;
            return {};
        }
        const std::string rounds = rounds_ == 1 ? " decompose" : fmt::format(" decompose*{}", rounds_);
        std::string schedule = "\nschedule:" + rounds;
        for (long long step = 0; step < system_.steps; ++step) schedule += " step" + rounds;
        system_.steps = rounds_ + system_.steps * (rounds_ + 1);
        return schedule + '\n';
    }

    void weigh(std::vector<Rule>& rules) {
        if (!system_.seed) {
            for (Rule& rule : rules) {
                if (!rule.weight) continue;
                report_.once("weight", rule.at, "probabilities, which cpfg also ignores without 'seed:'");
                rule.weight.reset();
            }
            return;
        }
        std::map<std::string, std::set<std::string>> contexts;
        std::map<std::string, std::size_t> members;
        const auto context_of = [](const Rule& rule) { return type_of(rule.left) + "<>" + type_of(rule.right); };
        for (const Rule& rule : rules) {
            const std::string predecessor = type_of(rule.predecessor);
            contexts[predecessor].insert(context_of(rule));
            if (contexts[predecessor].size() == 2) {
                report_.once("mixed" + predecessor, rule.at,
                             "random choice among all matching productions, whatever their contexts, with 'seed:'");
            }
            ++members[predecessor + "|" + context_of(rule)];
        }
        for (Rule& rule : rules) {
            if (members[type_of(rule.predecessor) + "|" + context_of(rule)] < 2) {
                rule.weight.reset();
            } else if (!rule.weight) {
                rule.weight = Value{"1"};
            }
        }
    }

    /// Writes productions for symbols that cpfg's turtle interprets differently.
    std::string interpretation() {
        std::string lines;
        std::set<std::string> certain;
        if (system_.homomorphism_depth > 0) {
            drop_dead(system_.homomorphism, report_);
            std::set<std::string> letters;
            for (const Rule& rule : system_.homomorphism) letters.insert(rule.predecessor.front().letter);
            for (const Rule& rule : system_.homomorphism) {
                lines += written(rule);
                if (!rule.condition) certain.insert(type_of(rule.predecessor));
                const bool recurs = std::any_of(letters.begin(), letters.end(), [&](const std::string& letter) {
                    return rule.successor.find(letter) != std::string::npos;
                });
                if (system_.homomorphism_depth > 1 && recurs) {
                    report_.once("depth", system_.homomorphism_depth_at,
                                 "a homomorphism that is applied to its own successors; here it is applied once");
                }
            }
        }
        for (const auto& [letter, count] : system_.letters.modules) {
            std::vector<std::string> names;
            for (std::size_t i = 0; i < count; ++i) names.push_back(fmt::format("a{}", i + 1));
            std::string successor, condition;
            if (letter == "'" || letter == "@." || letter == "$") {
            } else if (letter == "@v") {
                successor = "$";
            } else if (letter == "/" || letter == "\\") {
                // In the code of cpfg, up points away from the reader.
                successor = letter == "/" ? "\\" : "/";
                if (count > 0) successor += "(a1)";
            } else if ((letter == "!" || letter == "#") && count == 0 && view_.width_increment == 0) {
            } else if (letter == "@O" && count == 0) {
                report_.loss(system_.at, "discs as wide as the line");
            } else if ((letter == "@o" || letter == "@c" || letter == "@O") && count > 0) {
                successor = "@O(a1/2)";
            } else if ((letter == "{" || letter == "}") && count > 0) {
                condition = " : a1 != 0";
            } else {
                continue;
            }
            const std::vector<Formal> predecessor = {{letter, names}};
            if (certain.contains(type_of(predecessor))) continue;
            lines += line_of(written(predecessor, "") + condition + " --> " + (successor.empty() ? "*" : successor));
        }
        return lines.empty() ? "" : "\ninterpret:\n" + lines;
    }

    /// Writes `ignore:` or `consider:`; patterns' `consider:` never ignores brackets, and lists contain no commas.
    std::string list() {
        if (!system_.has_list) return "";
        const auto is_listed = [&](const std::string& letter) {
            const bool first = system_.listed.contains(letter[0]);
            if (letter.size() > 1 && first != system_.listed.contains(letter[1])) {
                report_.once("@list", system_.at, "contexts that see one half of an @ function");
            }
            return first && (letter.size() == 1 || system_.listed.contains(letter[1]));
        };
        std::set<std::string> symbols = system_.letters.symbols;
        for (const char letter : system_.listed) {
            if (letter != '@') symbols.insert(std::string(1, letter));
        }
        symbols.insert({"[", "]"});
        std::string yes, no;
        for (const std::string& letter : symbols) (is_listed(letter) ? yes : no) += ' ' + letter;
        const auto has = [](const std::string& letters, char letter) {
            return letters.find(letter) != std::string::npos;
        };
        const std::string& ignored = system_.considers ? no : yes;
        const std::string& seen = system_.considers ? yes : no;
        const bool brackets_seen = has(seen, '[') && has(seen, ']');
        if (!has(ignored, ',') && (!system_.considers || !brackets_seen)) {
            return ignored.empty() ? "" : line_of("ignore:" + ignored);
        }
        if (has(seen, ',')) report_.loss(system_.at, "contexts that see ','");
        if (!brackets_seen) report_.loss(system_.at, "contexts that pass through brackets");
        std::string considered;
        for (const char letter : seen) considered += letter == ',' ? ' ' : letter;
        return line_of("consider:" + considered);
    }

    System system_;
    const View& view_;
    Report& report_;
    long long rounds_ = 0;  // rounds of decomposition after each step
};

}  // namespace

std::string write_pattern(System system, const View& view, const std::string& name, const SourcePointer& file,
                          Report& report) {
    return PatternWriter(std::move(system), view, report).write(name, file);
}

}  // namespace sikku::cpfg
