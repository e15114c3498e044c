#include "engine/language/grammar.h"

#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <unordered_map>
#include <unordered_set>

namespace sikku {
namespace {

constexpr std::size_t longest_allowed_name = 64;
constexpr std::size_t large_word = std::size_t{1} << 22;  // bytes
constexpr std::size_t most_symbols = std::size_t{1} << 19;
// What tables repeat, together: productions that all of them share, and a place for each symbol of the grammar.
constexpr std::size_t most_shared = std::size_t{1} << 24;  // symbols of words, 64 more for each production
constexpr std::size_t most_places = std::size_t{1} << 22;
constexpr std::size_t most_parameters = 64;                   // of a module that states them for itself
constexpr std::size_t most_arguments = std::size_t{1} << 16;  // of any module
constexpr std::size_t most_items = std::size_t{1} << 20;      // of a schedule
constexpr std::int64_t largest_term = std::int64_t{1} << 40;  // of an exact angle

std::optional<TurnFraction> reduced(std::int64_t numerator, std::int64_t denominator) {
    if (denominator <= 0 || denominator > largest_term) return std::nullopt;
    const std::int64_t divisor = std::gcd(numerator, denominator);
    numerator /= divisor;
    denominator /= divisor;
    numerator %= denominator;
    return TurnFraction{numerator, denominator};
}

/// A decimal as written (`25.7`, `-3`, `1e2`) as a fraction numerator / denominator, if both stay small.
std::optional<std::pair<std::int64_t, std::int64_t>> decimal_fraction(std::string_view text) {
    std::int64_t numerator = 0;
    std::int64_t denominator = 1;
    bool negative = false;
    std::size_t at = 0;
    if (at < text.size() && (text[at] == '+' || text[at] == '-')) negative = text[at++] == '-';
    bool point = false;
    for (; at < text.size() && text[at] != 'e' && text[at] != 'E'; ++at) {
        if (text[at] == '.') {
            point = true;
            continue;
        }
        numerator = numerator * 10 + (text[at] - '0');
        if (point) denominator *= 10;
        if (numerator > largest_term || denominator > largest_term) return std::nullopt;
    }
    if (at < text.size()) {
        int exponent = 0;
        std::string_view digits = text.substr(at + 1);
        if (digits.starts_with('+')) digits.remove_prefix(1);
        if (std::from_chars(digits.data(), digits.data() + digits.size(), exponent).ec != std::errc()) {
            return std::nullopt;
        }
        if (numerator == 0) exponent = 0;
        for (; exponent > 0; --exponent) {
            numerator *= 10;
            if (numerator > largest_term) return std::nullopt;
        }
        for (; exponent < 0; ++exponent) {
            denominator *= 10;
            if (denominator > largest_term) return std::nullopt;
        }
    }
    return std::pair{negative ? -numerator : numerator, denominator};
}

Angle angle_of_degrees(double degrees) {
    if (!std::isfinite(degrees)) return {degrees, std::nullopt};  // the turtle refuses it, with its place
    std::array<char, 64> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), degrees).ptr;
    Angle angle{std::fmod(degrees, 360.0), std::nullopt};
    if (const auto fraction = decimal_fraction({buffer.data(), end})) {
        if (fraction->second <= largest_term / 360) angle.exact = reduced(fraction->first, fraction->second * 360);
    }
    return angle;
}

Angle negated(const Angle& angle) {
    Angle result{-angle.degrees, angle.exact};
    if (result.exact) result.exact->numerator = -result.exact->numerator;
    return result;
}

std::size_t code_point_length(char lead) {
    const auto byte = static_cast<unsigned char>(lead);
    return byte < 0x80 ? 1 : byte >= 0xF0 ? 4 : byte >= 0xE0 ? 3 : 2;
}

}  // namespace

struct Grammar::ScheduleItem {
    std::uint32_t table = 0;
    Expression count;
};

class GrammarCompiler {
public:
    GrammarCompiler(const Pattern& pattern, Diagnostics& diagnostics)
        : pattern_(pattern), diagnostics_(diagnostics) {}

    Grammar run() {
        read_names();
        read_defines();
        if (const Key* key = pattern_.find("derivation length")) {
            if (const auto steps = whole_number(key->value)) grammar_.steps_ = *steps;
        }
        if (const Key* key = pattern_.find("seed")) {
            if (const auto seed = whole_number(key->value)) grammar_.seed_ = static_cast<std::uint64_t>(*seed);
        }
        read_angles();
        find_types();
        read_axiom();
        read_tables();
        read_contexts();
        if (const Key* key = pattern_.find("scale factor")) {
            double percent = 0;
            if (!read_number(key->value.view(), percent) || percent <= 0 || percent > 100) {
                diagnostics_.error(key->value, "'scale factor:' is a percentage, above 0 and at most 100");
            } else {
                grammar_.scale_percent_ = percent;
            }
        }
        read_tropism();
        read_commands();
        read_schedule();
        finish_tables();
        grammar_.is_spatial_ = grammar_.tropism_ || reaches_into_space();
        warn_of_types();
        return std::move(grammar_);
    }

private:
    // --- names, defines, numbers ---------------------------------------------------------------------------

    void read_names() {
        const Key* key = pattern_.find("symbols");
        if (!key) return;
        const std::string_view text = key->value.view();
        for (std::size_t at = 0; at < text.size();) {
            if (text[at] == ' ' || text[at] == '\t') {
                ++at;
                continue;
            }
            const std::size_t begin = at;
            while (at < text.size() && text[at] != ' ' && text[at] != '\t') ++at;
            const std::string_view name = text.substr(begin, at - begin);
            const auto letter = [](char byte) {
                return (byte >= 'a' && byte <= 'z') || (byte >= 'A' && byte <= 'Z');
            };
            const bool good = letter(name.front()) && std::all_of(name.begin(), name.end(), [&](char byte) {
                                  return letter(byte) || (byte >= '0' && byte <= '9');
                              });
            if (!good) {
                const std::size_t comma = name.find(',');
                diagnostics_.error(key->value.part(begin + (comma == std::string_view::npos ? 0 : comma)),
                                   comma == std::string_view::npos
                                       ? "a name is letters and digits, beginning with a letter"
                                       : "names are separated by blanks, not by commas");
                return;
            }
            if (name.size() > longest_allowed_name) {
                diagnostics_.error(key->value.part(begin), "a name has at most 64 characters");
                return;
            }
            if (name_set_.size() >= most_symbols) {
                diagnostics_.error(key->value.part(begin), "there are more than 524,288 different symbols");
                return;
            }
            if (!name_set_.insert(std::string(name)).second) {
                diagnostics_.error(key->value.part(begin), fmt::format("'{}' is listed twice", name));
            }
        }
        for (const std::string& name : name_set_) longest_name_ = std::max(longest_name_, name.size());
        grammar_.names_.assign(name_set_.begin(), name_set_.end());
    }

    /// Evaluates every define once, those it mentions first; a cycle is an error at each of its members.
    void read_defines() {
        std::unordered_map<std::string_view, std::size_t> index;
        for (std::size_t i = 0; i < pattern_.defines.size(); ++i) index[pattern_.defines[i].name.view()] = i;
        enum class State : char { fresh, open, done };
        std::vector<State> state(pattern_.defines.size(), State::fresh);
        std::vector<std::size_t> stack;
        for (std::size_t first = 0; first < pattern_.defines.size(); ++first) {
            stack.push_back(first);
            while (!stack.empty()) {
                const std::size_t i = stack.back();
                const Define& define = pattern_.defines[i];
                if (state[i] == State::done) {
                    stack.pop_back();
                    continue;
                }
                if (state[i] == State::fresh) {
                    state[i] = State::open;
                    const std::size_t before = stack.size();
                    for (const std::string_view name : names_in(define.value.view())) {
                        const auto found = index.find(name);
                        if (found == index.end() || state[found->second] == State::done) continue;
                        if (state[found->second] == State::open) {
                            diagnostics_.error(define.name,
                                               fmt::format("'{}' is defined by itself", define.name.view()));
                            defines_[name] = std::numeric_limits<double>::quiet_NaN();
                            continue;
                        }
                        stack.push_back(found->second);
                    }
                    if (stack.size() > before) continue;
                }
                evaluate_define(define);
                state[i] = State::done;
                stack.pop_back();
            }
        }
    }

    static std::vector<std::string_view> names_in(std::string_view text) {
        std::vector<std::string_view> names;
        for (std::size_t at = 0; at < text.size();) {
            if (!continues_name(text[at]) && text[at] != '.') {
                ++at;
                continue;
            }
            const std::size_t begin = at;
            while (at < text.size() && (continues_name(text[at]) || text[at] == '.')) ++at;
            if (begins_name(text[begin])) names.push_back(text.substr(begin, at - begin));
        }
        return names;
    }

    void evaluate_define(const Define& define) {
        const std::string_view name = define.name.view();
        const bool good = begins_name(name.front()) && std::all_of(name.begin(), name.end(), continues_name);
        if (!good) {
            return diagnostics_.error(define.name, "a define's name is letters, digits and '_', no digit first");
        }
        // A value that cannot be read is reported once, not at every use.
        defines_[name] = constant(define.value).value_or(0.0);
    }

    NameLookup defines_lookup() const {
        return [this](std::string_view name) -> std::optional<NameMeaning> {
            const auto found = defines_.find(name);
            if (found == defines_.end()) return std::nullopt;
            return NameMeaning{false, found->second};
        };
    }

    std::optional<double> constant(const Span& text) {
        const auto expression = Expression::compile(text, defines_lookup(), diagnostics_);
        if (!expression) return std::nullopt;
        return expression->evaluate();
    }

    std::optional<std::int64_t> whole_number(const Span& value) {
        std::int64_t number = 0;
        const std::string_view text = value.view();
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
        if (error != std::errc() || end != text.data() + text.size() || text.empty() || number < 0) {
            diagnostics_.error(value, "expected a whole number, 0 or more, below 2^63");
            return std::nullopt;
        }
        return number;
    }

    // --- angles --------------------------------------------------------------------------------------------

    std::optional<Angle> read_angle(const Span& value) {
        const std::string_view text = value.view();
        double numerator = 0;
        double denominator = 1;
        const std::size_t slash = text.find('/');
        const std::string_view over = text.substr(0, slash);
        if (!read_number(over, numerator) ||
            (slash != std::string_view::npos && !read_number(text.substr(slash + 1), denominator)) ||
            denominator == 0 || !std::isfinite(numerator / denominator)) {
            diagnostics_.error(value, "expected degrees: a number such as 25.7 or a fraction such as 360/7");
            return std::nullopt;
        }
        Angle angle{std::fmod(numerator / denominator, 360.0), std::nullopt};
        const auto top = decimal_fraction(over);
        const auto bottom = slash == std::string_view::npos
                                ? std::optional(std::pair{std::int64_t{1}, std::int64_t{1}})
                                : decimal_fraction(text.substr(slash + 1));
        if (top && bottom && bottom->first != 0) {
            // (a/b) / (c/d) degrees = a d / (360 b c) turns
            std::int64_t above = 0;
            std::int64_t below = 0;
            if (!__builtin_mul_overflow(top->first, bottom->second, &above) &&
                !__builtin_mul_overflow(top->second, bottom->first, &below) &&
                !__builtin_mul_overflow(below, std::int64_t{360}, &below)) {
                if (below < 0) {
                    above = -above;
                    below = -below;
                }
                const std::int64_t divisor = std::gcd(above, below);
                angle.exact = reduced(above / divisor, below / divisor);
            }
        }
        return angle;
    }

    void read_angles() {
        const Key* factor = pattern_.find("angle factor");
        const Key* increment = pattern_.find("angle increment");
        increment_ = Angle{90.0, TurnFraction{1, 4}};
        if (factor && increment) {
            diagnostics_.error(std::max(factor->name_at.at, increment->name_at.at) == factor->name_at.at
                                   ? factor->name_at
                                   : increment->name_at,
                               "'angle factor:' and 'angle increment:' exclude each other");
        }
        if (factor) {
            const auto k = whole_number(factor->value);
            if (k && (*k < 1 || *k > largest_term)) {
                diagnostics_.error(factor->value, "the angle factor is a whole number, 1 or more: 360/k degrees");
            } else if (k) {
                increment_ = Angle{360.0 / static_cast<double>(*k), reduced(1, *k)};
            }
        } else if (increment) {
            if (const auto angle = read_angle(increment->value)) increment_ = *angle;
        }
        grammar_.heading_ = Angle{90.0, TurnFraction{1, 4}};
        if (const Key* key = pattern_.find("heading")) {
            if (const auto angle = read_angle(key->value)) grammar_.heading_ = *angle;
        }
        if (const Key* key = pattern_.find("turn")) {
            const std::string_view side = key->value.view();
            if (side == "left") {
                plus_turns_left_ = true;
            } else if (side != "right") {
                diagnostics_.error(key->value, "expected 'left' or 'right'");
            }
        }
    }

    // --- space ---------------------------------------------------------------------------------------------

    void read_tropism() {
        const Key* force = pattern_.find("tropism");
        const Key* elasticity = pattern_.find("elasticity");
        if (!force && !elasticity) return;
        if (!force || !elasticity) {
            diagnostics_.error((force ? force : elasticity)->name_at,
                               "'tropism:' says which way branches bend and 'elasticity:' how much: one needs the "
                               "other");
            return;
        }
        Tropism tropism;
        int numbers = 0;
        bool good = true;
        std::string_view rest = force->value.view();
        constexpr std::string_view separators = " \t,";
        for (;;) {
            rest.remove_prefix(std::min(rest.find_first_not_of(separators), rest.size()));
            if (rest.empty()) break;
            const std::string_view word = rest.substr(0, rest.find_first_of(separators));
            rest.remove_prefix(word.size());
            double number = 0;
            good = good && numbers < 3 && read_number(word, number) && std::fabs(number) <= 1e100;
            if (good) tropism.force[numbers] = number;
            ++numbers;
        }
        if (!good || (numbers != 2 && numbers != 3)) {
            diagnostics_.error(force->value, "expected numbers x, y and, if you like, z, such as 0, -1, 0");
        }
        if (!read_number(elasticity->value.view(), tropism.elasticity) || std::fabs(tropism.elasticity) > 1e100) {
            diagnostics_.error(elasticity->value, "expected a number such as 0.22");
        }
        grammar_.tropism_ = tropism;
    }

    bool reaches_into_space() const {
        const std::vector<char> reached = grammar_.reachable();
        for (std::size_t i = 0; i < reached.size(); ++i) {
            const Action action = grammar_.symbols_[i].command.action;
            if (reached[i] && (action == Action::pitch || action == Action::roll || action == Action::level))
                return true;
        }
        return false;
    }

    // --- words ---------------------------------------------------------------------------------------------

    Symbol intern(std::string letter, bool is_name, std::vector<double> arguments, std::uint32_t arity = 0) {
        std::string key = letter;
        key += '\0';
        if (arity > 0) key += fmt::format("{}", arity);
        for (const double value : arguments) key += fmt::format("({}", value == 0 ? 0.0 : value);
        const auto [found, fresh] = symbol_index_.try_emplace(key, static_cast<Symbol>(grammar_.symbols_.size()));
        if (fresh) {
            const auto [letter_at, new_letter] =
                letter_index_.try_emplace(letter, static_cast<std::uint32_t>(grammar_.letters_.size()));
            if (new_letter) grammar_.letters_.push_back(letter);
            grammar_.symbols_.push_back(
                {std::move(letter), std::move(arguments), is_name, letter_at->second, {}, arity});
        }
        return found->second;
    }

    /// What may stand in a word.
    enum class Place { axiom_or_successor, predecessor, context, list };

    /// Reads a word; nullopt after the first mistake in it. The parameters of modules that state them for themselves
    /// go to `arguments`.
    std::optional<Word> word(const Span& span, Place place, std::vector<Expression>* arguments = nullptr) {
        Word result;
        const std::string_view text = span.view();
        if (text == "*" || text == "\xCE\xB5") return result;  // ε
        // A large word is looked through before memory is spent on it.
        if (text.size() > large_word && !read_word(span, place, [](Symbol, std::vector<Expression>&) {})) {
            return std::nullopt;
        }
        result.reserve(text.size() > large_word ? text.size() : 0);
        const bool good = read_word(span, place, [&](Symbol symbol, std::vector<Expression>& own) {
            result.push_back(symbol);
            if (arguments && !own.empty()) std::move(own.begin(), own.end(), std::back_inserter(*arguments));
        });
        if (!good) return std::nullopt;
        return result;
    }

    /// Hands each symbol to `take`, with its parameters if it states them for itself; false after the first mistake.
    template <class Take>
    bool read_word(const Span& span, Place place, Take take) {
        const std::string_view text = span.view();
        std::size_t at = 0;
        std::vector<Expression> own;
        while (true) {
            const bool blank_before = skip_blanks(text, at);
            if (at >= text.size()) return true;
            const std::size_t begin = at;
            bool is_name = false;
            if (!symbol_at(span, text, at, is_name, blank_before)) return false;
            const std::string_view letter = text.substr(begin, at - begin);
            const bool plain = letter.size() == 1 && (at >= text.size() || text[at] != '(');
            own.clear();
            if (plain) {
                // Most symbols are single letters that were met before.
                const Symbol known = plain_symbols_[static_cast<unsigned char>(letter.front())];
                if (known != no_symbol && letter != "%") {
                    take(known, own);
                    continue;
                }
            }
            std::vector<double> arguments;
            std::uint32_t arity = 0;
            if (at < text.size() && text[at] == '(') {
                if (place == Place::list) {
                    diagnostics_.error(span.part(at), "a list of symbols holds no parameters");
                    return false;
                }
                std::vector<Span> parts;
                const std::size_t open = at;
                if (!split_parameters(span, text, at, parts)) return false;
                if (letter == "%") {
                    diagnostics_.error(span.part(open), "the cut symbol '%' has no parameters");
                    return false;
                }
                if (place != Place::axiom_or_successor) {
                    if (!read_formals(parts)) return false;
                    arity = static_cast<std::uint32_t>(parts.size());
                } else if (types_.contains(type_key(letter, parts.size()))) {
                    if (!read_parameters(parts, own)) return false;
                    arity = static_cast<std::uint32_t>(parts.size());
                } else {
                    for (const Span& part : parts) {
                        const auto value = constant(part);
                        if (!value) return false;
                        arguments.push_back(*value);
                    }
                }
                if (arity > most_parameters) {
                    diagnostics_.error(span.part(open), "a module has at most 64 parameters");
                    return false;
                }
            }
            if (letter == "%" && place != Place::list && place != Place::axiom_or_successor) {
                diagnostics_.error(span.part(begin), "the cut symbol '%' is gone before productions apply");
                return false;
            }
            if (grammar_.symbols_.size() >= most_symbols) {
                diagnostics_.error(span.part(begin), "there are more than 524,288 different symbols");
                return false;
            }
            const Symbol symbol = intern(std::string(letter), is_name, std::move(arguments), arity);
            if (letter == "%" && place == Place::axiom_or_successor) grammar_.cut_ = symbol;
            if (plain) plain_symbols_[static_cast<unsigned char>(letter.front())] = symbol;
            take(symbol, own);
        }
    }

    static bool skip_blanks(std::string_view text, std::size_t& at) {
        const std::size_t begin = at;
        while (at < text.size() && (text[at] == ' ' || text[at] == '\t')) ++at;
        return at > begin;
    }

    /// Names that stand for the arguments of a module, each once in a production.
    bool read_formals(const std::vector<Span>& parts) {
        for (const Span& part : parts) {
            const std::string_view name = part.view();
            if (!begins_name(name.front()) || !std::all_of(name.begin(), name.end(), continues_name)) {
                diagnostics_.error(part, "a predecessor and its contexts hold names of parameters only");
                return false;
            }
            if (!formals_.try_emplace(name, static_cast<std::uint32_t>(formals_.size())).second) {
                diagnostics_.error(part, fmt::format("the parameter '{}' is named twice", name));
                return false;
            }
        }
        return true;
    }

    std::optional<Expression> expression(const Span& text) {
        const auto names = [this](std::string_view name) -> std::optional<NameMeaning> {
            if (const auto formal = formals_.find(name); formal != formals_.end()) {
                return NameMeaning{true, 0.0, formal->second};
            }
            const auto found = defines_.find(name);
            if (found == defines_.end()) return std::nullopt;
            return NameMeaning{false, found->second};
        };
        return Expression::compile(text, names, diagnostics_, &draws_);
    }

    bool read_parameters(const std::vector<Span>& parts, std::vector<Expression>& own) {
        for (const Span& part : parts) {
            auto compiled = expression(part);
            if (!compiled) return false;
            if (compiled->uses_chance()) grammar_.is_stochastic_ = true;
            own.push_back(std::move(*compiled));
        }
        return true;
    }

    // --- types of modules ----------------------------------------------------------------------------------

    static std::string type_key(std::string_view letter, std::size_t parameters) {
        return fmt::format("{}({}", letter, parameters);
    }

    /// Which modules state their parameters for themselves: those that a predecessor or a context names the
    /// parameters of, and those that a word computes them for.
    void find_types() {
        const auto mentions = [&](const Span& text) { return text.view().find('(') != std::string_view::npos; };
        const auto is_computed = [&](const Span& part) {
            const auto names = names_in(part.view());
            return std::any_of(names.begin(), names.end(),
                               [&](std::string_view name) { return name == "random" || formals_.contains(name); });
        };
        const auto computed = [&](std::string_view letter, const std::vector<Span>& parts) {
            if (std::any_of(parts.begin(), parts.end(), is_computed)) types_.insert(type_key(letter, parts.size()));
        };
        const auto named = [&](std::string_view letter, const std::vector<Span>& parts) {
            types_.insert(type_key(letter, parts.size()));
            for (const Span& part : parts) formals_.try_emplace(part.view(), 0);
        };
        const auto look_at = [&](const std::vector<ProductionText>& productions) {
            for (const ProductionText& text : productions) {
                formals_.clear();
                for (const auto& span : {text.left, std::optional(text.predecessor), text.right}) {
                    if (span && mentions(*span)) look_through(*span, named);
                }
                if (mentions(text.successor)) look_through(text.successor, computed);
            }
        };
        look_at(pattern_.common);
        for (const TableText& table : pattern_.tables) look_at(table.productions);
        look_at(pattern_.interpret);
        formals_.clear();
        const Key* axiom = pattern_.find("axiom");
        if (axiom && axiom->value.view().find("random") != std::string_view::npos) {
            look_through(axiom->value, computed);
        }
        grammar_.is_parametric_ = !types_.empty();
    }

    /// Hands each letter with parameters to `take`, up to the first mistake, which is reported when the word is read.
    template <class Take>
    void look_through(const Span& span, Take take) {
        const std::string_view text = span.view();
        std::vector<Span> parts;
        for (std::size_t at = 0; skip_blanks(text, at), at < text.size();) {
            const std::size_t begin = at;
            bool is_name = false;
            if (!symbol_at(span, text, at, is_name, false, true)) return;
            if (at >= text.size() || text[at] != '(') continue;
            const std::string_view letter = text.substr(begin, at - begin);
            parts.clear();
            if (!split_parameters(span, text, at, parts, true)) return;
            take(letter, parts);
        }
    }

    /// A production for a number of parameters that no word states can never apply.
    void warn_of_types() {
        if (looked_at_.empty() || diagnostics_.has_errors()) return;
        std::vector<char> stated(grammar_.symbols_.size(), 0);
        const auto state = [&](const Word& word) {
            for (const Symbol symbol : word) stated[symbol] = 1;
        };
        state(grammar_.axiom());
        for (const Table& table : grammar_.tables_) {
            for (const Production& production : table.productions_) state(production.successor);
        }
        if (grammar_.interpretation_) {
            for (const Production& production : grammar_.interpretation_->productions_) state(production.successor);
        }
        std::vector<std::optional<std::size_t>> other(grammar_.letters_.size());  // stated number of parameters
        for (std::size_t i = 0; i < stated.size(); ++i) {
            const SymbolInfo& symbol = grammar_.symbols_[i];
            if (stated[i]) other[symbol.letter_index] = std::max<std::size_t>(symbol.arity, symbol.arguments.size());
        }
        for (const auto& [symbol, where] : looked_at_) {
            const SymbolInfo& info = grammar_.symbols_[symbol];
            if (stated[symbol] || !other[info.letter_index]) continue;
            diagnostics_.warning(where, fmt::format("no word has '{}' with {} parameters, but one with {}: this "
                                                    "production can never apply",
                                                    info.letter, info.arity, *other[info.letter_index]));
        }
    }

    // --- symbols -------------------------------------------------------------------------------------------

    bool symbol_at(const Span& span, std::string_view text, std::size_t& at, bool& is_name, bool blank_before,
                   bool quiet = false) {
        const char byte = text[at];
        const auto wrong = [&](std::string message) {
            if (!quiet) diagnostics_.error(span.part(at), std::move(message));
            return false;
        };
        for (std::size_t length = std::min(longest_name_, text.size() - at); length > 0; --length) {
            if (name_set_.contains(text.substr(at, length))) {
                is_name = length > 1;
                at += length;
                return true;
            }
        }
        if (byte == '@') {
            const std::size_t next = at + 1;
            if (next >= text.size() || text[next] == ' ' || text[next] == '\t' || text[next] == '(') {
                return wrong("a lone '@' is no symbol: '@' goes with the character after it");
            }
            at = next + code_point_length(text[next]);
            return true;
        }
        if (byte == '(') {
            return wrong(blank_before ? "parameters follow their symbol at once, without a blank"
                                      : "'(' without a symbol before it");
        }
        if (byte == ')') return wrong("')' without '('");
        if (byte == '<' || byte == '>') return wrong(fmt::format("'{}' is no symbol", byte));
        if (byte == ':') return wrong("':' is no symbol");
        if (byte == '*') return wrong("'*' is the empty word and stands alone");
        if (static_cast<unsigned char>(byte) < 0x20 || byte == 0x7F) {
            return wrong(
                fmt::format("a control character (0x{:02x}) is no symbol", static_cast<unsigned char>(byte)));
        }
        const std::size_t length = code_point_length(byte);
        const std::string_view point = text.substr(at, length);
        struct Lookalike {
            std::string_view sign, ascii;
        };
        static constexpr std::array<Lookalike, 4> lookalikes = {
            {{"\xE2\x88\x92", "-"}, {"\xE2\x88\xA7", "^"}, {"\xE2\x80\x99", "'"}, {"\xE2\x86\x92", "-->"}}};
        for (const Lookalike& pair : lookalikes) {
            if (point == pair.sign) return wrong(fmt::format("'{}' is no symbol: write '{}'", pair.sign, pair.ascii));
        }
        // C1 controls are control characters too.
        if (length == 2 && byte == '\xC2' && static_cast<unsigned char>(point[1]) < 0xA0) {
            return wrong("a control character is no symbol");
        }
        at += length;
        return true;
    }

    /// From the parenthesis at `at` to the one that closes it.
    bool split_parameters(const Span& span, std::string_view text, std::size_t& at, std::vector<Span>& parts,
                          bool quiet = false) {
        const std::size_t open = at;
        std::size_t depth = 0;
        std::size_t begin = at + 1;
        for (; at < text.size(); ++at) {
            if (text[at] == '(') ++depth;
            const bool last = text[at] == ')' && --depth == 0;
            if (!last && !(text[at] == ',' && depth == 1)) continue;
            const Span part = span.part(begin, at - begin).trimmed();
            if (part.empty()) {
                if (!quiet) diagnostics_.error(span.part(begin), "expected a parameter");
                return false;
            }
            if (parts.size() >= most_arguments) {
                if (!quiet) diagnostics_.error(part, "a module has at most 65,536 parameters");
                return false;
            }
            parts.push_back(part);
            begin = at + 1;
            if (last) {
                ++at;
                return true;
            }
        }
        if (!quiet) diagnostics_.error(span.part(open), "this '(' is not closed");
        return false;
    }

    void read_axiom() {
        const Key* key = pattern_.find("axiom");
        if (!key) {
            diagnostics_.error({pattern_.source, 0, 0}, "there is no 'axiom:'");
        } else if (key->value.empty()) {
            diagnostics_.error(key->name_at, "the axiom is empty: expected a word");
        } else {
            std::vector<Expression> arguments;
            auto axiom = word(key->value, Place::axiom_or_successor, &arguments);
            if (!axiom) return;
            ModuleWord modules{std::move(*axiom), {}, {}};
            modules.arguments.reserve(arguments.size());
            if (!arguments.empty()) {
                for (std::size_t i = 0, next = 0; i < modules.symbols.size(); ++i) {
                    const Chance chance{axiom_place(grammar_.seed_, i), 0};
                    for (std::uint32_t k = 0; k < grammar_.symbols_[modules.symbols[i]].arity; ++k) {
                        modules.arguments.push_back(arguments[next++].evaluate({}, chance));
                    }
                }
            }
            grammar_.axiom_ = std::make_shared<const ModuleWord>(std::move(modules));
        }
    }

    // --- productions ---------------------------------------------------------------------------------------

    std::optional<Word> context(const std::optional<Span>& text, bool right) {
        if (!text) return Word();
        if (text->empty()) {
            diagnostics_.error(*text, "expected a context; '*' is the empty one");
            return std::nullopt;
        }
        auto result = word(*text, Place::context);
        if (!result) return std::nullopt;
        std::size_t depth = 0;
        for (const Symbol symbol : *result) {
            const std::string& letter = grammar_.symbols_[symbol].letter;
            if (letter != "[" && letter != "]") continue;
            if (!right) {
                diagnostics_.error(text->part(text->view().find(letter)), "a left context holds no brackets");
                return std::nullopt;
            }
            if (letter == "]" && depth == 0) {
                diagnostics_.error(*text, "this context has a ']' without '['");
                return std::nullopt;
            }
            depth += letter == "[" ? 1 : -1;
        }
        if (depth > 0) {
            diagnostics_.error(*text, "this context has a '[' that is not closed");
            return std::nullopt;
        }
        return result;
    }

    /// Productions of equal predecessor and contexts.
    struct Group {
        std::uint32_t number = 0;
        bool is_certain = false;      ///< one of them has neither condition nor weight
        bool has_conditions = false;  ///< that are not constant
        bool has_variables = false;   ///< weights that are not constant
        bool is_mixed = false;
        std::optional<Span> weighted;    ///< the first weight
        std::optional<Span> unweighted;  ///< the first production without one
        double sum = 0.0;                ///< of constant weights
    };
    using Groups = std::map<std::tuple<Word, Word, Word>, Group>;

    void add_productions(Table& table, const std::vector<ProductionText>& texts, Groups& groups, bool homomorphism) {
        for (const ProductionText& text : texts) {
            if (text.predecessor.view() == "*" || text.predecessor.view() == "\xCE\xB5") {
                diagnostics_.error(text.predecessor, "the empty word is no predecessor");
                continue;
            }
            formals_.clear();
            auto left = context(text.left, false);
            auto predecessor = word(text.predecessor, Place::predecessor);
            auto right = context(text.right, true);
            if (!left || !predecessor || !right) continue;
            std::optional<Expression> condition;
            if (text.condition) {
                if (text.condition->empty()) {
                    diagnostics_.error(*text.condition, "expected a condition after ':'");
                    continue;
                }
                condition = expression(*text.condition);
                if (!condition) continue;
            }
            std::vector<Expression> arguments;
            auto successor = word(text.successor, Place::axiom_or_successor, &arguments);
            if (!successor) continue;
            std::optional<Expression> weight;
            if (text.weight) {
                if (text.weight->empty()) {
                    diagnostics_.error(*text.weight, "expected a weight after ':'");
                    continue;
                }
                weight = expression(*text.weight);
                if (!weight) continue;
            }
            if (homomorphism && (!left->empty() || !right->empty() || predecessor->size() != 1)) {
                diagnostics_.error(text.predecessor,
                                   "an interpretation replaces one symbol, whatever its neighbours are");
                continue;
            }
            if (grammar_.is_parametric_) {
                for (const Word* looked : {&*left, &*predecessor, &*right}) {
                    for (const Symbol symbol : *looked) looked_at_.try_emplace(symbol, text.predecessor);
                }
            }
            Group& group = groups.try_emplace({*left, *predecessor, *right}).first->second;
            if (group.number == 0) group.number = static_cast<std::uint32_t>(groups.size());
            if (group.is_certain && !text.weight) {
                diagnostics_.error(text.predecessor,
                                   "this production can never apply: one with the same predecessor and contexts "
                                   "stands before it");
                continue;
            }
            if (!text.condition && !text.weight) group.is_certain = true;
            if (!belongs(text, weight, group)) continue;
            if (condition) {
                if (const auto value = condition->constant()) {
                    if (std::isnan(*value)) {
                        diagnostics_.error(*text.condition, "this condition is never a number");
                    }
                    if (*value == 0) continue;
                    condition.reset();
                } else {
                    group.has_conditions = true;
                    if (condition->uses_chance()) {
                        grammar_.is_stochastic_ = true;
                        table.has_random_conditions_ = true;
                    }
                }
            }
            table.productions_.push_back({std::move(*left), std::move(*predecessor), std::move(*right),
                                          std::move(*successor), std::move(condition), std::move(weight),
                                          std::move(arguments), group.number});
        }
    }

    /// Does its weight, or that it has none, go with those of the others?
    bool belongs(const ProductionText& text, const std::optional<Expression>& weight, Group& group) {
        if (!weight && !group.unweighted) group.unweighted = text.predecessor;
        if (weight && !group.weighted) group.weighted = *text.weight;
        if (group.weighted && group.unweighted && !group.is_mixed) {
            group.is_mixed = true;
            diagnostics_.error(*group.unweighted,
                               "this production has no weight, and others of the same predecessor and contexts have");
        }
        if (!weight) return true;
        const auto value = weight->constant();
        if (!value) {
            group.has_variables = true;
        } else if (!(*value >= 0) || !std::isfinite(*value)) {
            diagnostics_.error(*text.weight, "a weight is a finite number, 0 or more");
            group.has_variables = true;
            return false;
        } else {
            group.sum += *value;
        }
        return true;
    }

    /// What is left to chance once constant weights are known: nothing where one production alone has any.
    void weigh(Table& table, const Groups& groups) {
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
        std::erase_if(table.productions_, [&](const Production& production) {
            return is_fixed(production) && production.weight->constant() == 0.0;
        });
        std::vector<std::uint32_t> members(groups.size() + 1, 0);
        for (const Production& production : table.productions_) ++members[production.group];
        for (Production& production : table.productions_) {
            if (is_fixed(production) && members[production.group] == 1) production.weight.reset();
            if (production.weight) grammar_.is_stochastic_ = true;
        }
    }

    void read_tables() {
        Table common;
        Groups groups;
        add_productions(common, pattern_.common, groups, false);
        std::size_t size = 0;
        for (const Production& production : common.productions_) {
            size += 64 + production.left.size() + production.predecessor.size() + production.right.size() +
                    production.successor.size();
        }
        if (pattern_.tables.size() > 1 && size > most_shared / pattern_.tables.size()) {
            diagnostics_.error(pattern_.tables.front().name,
                               "there is too much before the first table for so many tables to share it");
            return;
        }
        if (pattern_.tables.empty()) {
            weigh(common, groups);
            grammar_.tables_.push_back(std::move(common));
        } else {
            for (const TableText& text : pattern_.tables) {
                Table table = common;
                Groups groups_here = groups;
                add_productions(table, text.productions, groups_here, false);
                weigh(table, groups_here);
                grammar_.tables_.push_back(std::move(table));
            }
        }
        if (!pattern_.interpret.empty()) {
            Table table;
            Groups groups_here;
            add_productions(table, pattern_.interpret, groups_here, true);
            weigh(table, groups_here);
            grammar_.interpretation_ = std::move(table);
        }
    }

    /// A list of symbols, written as a word; a comma in it is most likely a mistake.
    std::optional<Word> symbol_list(const Key& key) {
        if (const std::size_t comma = key.value.view().find(','); comma != std::string_view::npos) {
            diagnostics_.error(key.value.part(comma),
                               "symbols are listed as a word: blanks, no commas, between them");
            return std::nullopt;
        }
        return word(key.value, Place::list);
    }

    void read_contexts() {
        const Key* ignore = pattern_.find("ignore");
        const Key* consider = pattern_.find("consider");
        if (ignore && consider) {
            diagnostics_.error(consider->name_at, "'ignore:' and 'consider:' exclude each other");
            return;
        }
        const Key* key = ignore ? ignore : consider;
        if (key) {
            if (const auto list = symbol_list(*key)) {
                for (const Symbol symbol : *list) listed_.insert(grammar_.symbols_[symbol].letter);
                lists_considered_ = consider != nullptr;
                has_list_ = true;
            }
        }
    }

    // --- turtle commands -----------------------------------------------------------------------------------

    void read_commands() {
        std::set<std::string> forward = {"F"};
        std::set<std::string> move = {"f"};
        const auto replace = [&](std::string_view name, std::set<std::string>& letters) {
            const Key* listed = pattern_.find(name);
            if (!listed) return;
            letters.clear();
            if (const auto list = symbol_list(*listed)) {
                for (const Symbol symbol : *list) letters.insert(grammar_.symbols_[symbol].letter);
            }
        };
        replace("forward", forward);
        replace("move", move);
        // A letter that is listed is taken from the other list's default.
        const Key* key = pattern_.find("move");
        if (!key) std::erase_if(move, [&](const std::string& letter) { return forward.contains(letter); });
        if (!pattern_.find("forward")) {
            std::erase_if(forward, [&](const std::string& letter) { return move.contains(letter); });
        }
        for (const std::string& letter : move) {
            if (!forward.contains(letter)) continue;
            diagnostics_.error(key->value, fmt::format("'{}' is listed under both 'forward:' and 'move:'", letter));
        }
        grammar_.ignored_.assign(grammar_.symbols_.size(), 0);
        for (std::size_t i = 0; i < grammar_.symbols_.size(); ++i) {
            SymbolInfo& symbol = grammar_.symbols_[i];
            symbol.command = command_of(symbol, forward, move);
            const bool bracket = symbol.letter == "[" || symbol.letter == "]";
            const bool listed = listed_.contains(symbol.letter);
            grammar_.ignored_[i] = has_list_ && (lists_considered_ ? !listed && !bracket : listed) ? 1 : 0;
        }
    }

    Command command_of(const SymbolInfo& symbol, const std::set<std::string>& forward,
                       const std::set<std::string>& move) const {
        const std::string& letter = symbol.letter;
        const bool takes_argument = symbol.arity > 0;
        const bool has_value = takes_argument || !symbol.arguments.empty();
        const double value = takes_argument ? 1.0 : has_value ? symbol.arguments.front() : 0.0;
        const auto with = [](Action action, double number) { return Command{action, number, {}, false}; };
        const auto with_value = [&](Action action, double otherwise) {
            return has_value ? Command{action, value, {}, takes_argument} : with(action, otherwise);
        };
        const auto by_angle = [&](Action action, bool positive) -> Command {
            if (takes_argument) return {action, positive ? 1.0 : -1.0, {}, true};
            const Angle angle = has_value ? angle_of_degrees(value) : increment_;
            return {action, 0.0, positive ? angle : negated(angle), false};
        };
        if (forward.contains(letter)) return with_value(Action::draw, 1.0);
        if (move.contains(letter)) return with_value(Action::move, 1.0);
        if (letter.size() == 2 && letter[0] == '@') {
            if (letter[1] == 'O') return with_value(Action::disc, 1.0);
            if (letter[1] == '.') return with(Action::disc, 0.0);
            return {};
        }
        if (letter.size() != 1) return {};
        switch (letter[0]) {
            case '+':
            case '-':
                return by_angle(Action::turn, (letter[0] == '+') == plus_turns_left_);
            case '&':
            case '^':
                return by_angle(Action::pitch, letter[0] == '&');
            case '\\':
            case '/':
                return by_angle(Action::roll, letter[0] == '\\');
            case '$':
                return with(Action::level, 0);
            case '|':
                return {Action::turn, 0.0, Angle{180.0, TurnFraction{1, 2}}, false};
            case '[':
                return with(Action::push, 0);
            case ']':
                return with(Action::pop, 0);
            case '{':
                return with(Action::polygon_begin, 0);
            case '}':
                return with(Action::polygon_end, 0);
            case '#':
                return has_value ? with_value(Action::width_set, 0) : with(Action::width_factor, 1.25);
            case '!':
                return has_value ? with_value(Action::width_set, 0) : with(Action::width_factor, 0.8);
            case '\'':
            case ';':
                return has_value ? with_value(Action::colour_set, 0) : with(Action::colour_step, 1);
            case ',':
                return has_value ? with_value(Action::colour_set, 0) : with(Action::colour_step, -1);
            default:
                return {};
        }
    }

    // --- schedule ------------------------------------------------------------------------------------------

    void read_schedule() {
        const Key* key = pattern_.find("schedule");
        if (!key) {
            if (pattern_.tables.size() > 1) {
                diagnostics_.error(pattern_.tables[1].name, "several tables need a 'schedule:'");
            }
        } else if (auto items = schedule_items(*key)) {
            grammar_.schedule_items_ = std::make_shared<const std::vector<Grammar::ScheduleItem>>(std::move(*items));
        } else {
            return;
        }
        std::string problem;
        if (!grammar_.make_schedule(&problem)) diagnostics_.error(key ? key->value : Span{}, problem);
    }

    std::optional<std::vector<Grammar::ScheduleItem>> schedule_items(const Key& key) {
        std::vector<Grammar::ScheduleItem> items;
        static const Source once("1", "1");
        std::vector<std::string_view> names;
        std::unordered_map<std::string_view, std::uint32_t> index;
        for (const TableText& table : pattern_.tables) {
            index.emplace(table.name.view(), static_cast<std::uint32_t>(names.size()));
            names.push_back(table.name.view());
        }
        const Span& value = key.value;
        const std::string_view text = value.view();
        const auto skip = [&](std::size_t at) {
            while (at < text.size() && (text[at] == ' ' || text[at] == '\t')) ++at;
            return at;
        };
        for (std::size_t at = skip(0); at < text.size(); at = skip(at)) {
            const std::size_t begin = at;
            if (items.size() >= most_items) {
                diagnostics_.error(value.part(begin), "a schedule has at most 1,048,576 entries");
                return std::nullopt;
            }
            while (at < text.size() && text[at] != ' ' && text[at] != '\t' && text[at] != '*' && text[at] != ',')
                ++at;
            const std::string_view name = text.substr(begin, at - begin);
            Grammar::ScheduleItem item;
            const auto known = index.find(name);
            if (known != index.end()) {
                item.table = known->second;
            } else {
                const std::string_view near = nearest(name, names);
                diagnostics_.error(value.part(begin),
                                   name.empty() ? std::string("expected the name of a table")
                                   : near.empty()
                                       ? fmt::format("there is no table '{}'", name)
                                       : fmt::format("there is no table '{}'; did you mean '{}'?", name, near));
                return std::nullopt;
            }
            Span count(&once, 0, 1);
            if (const std::size_t star = skip(at); star < text.size() && text[star] == '*') {
                const std::size_t first = skip(star + 1);
                at = first;
                std::size_t depth = 0;
                while (at < text.size()) {
                    if (text[at] == '(') ++depth;
                    if (text[at] == ')' && depth > 0 && --depth == 0) {
                        ++at;
                        break;
                    }
                    if (depth == 0 && (text[at] == ' ' || text[at] == '\t')) break;
                    ++at;
                }
                count = value.part(first, at - first);
                const std::string_view digits = count.view();
                const bool plain = !digits.empty() && (digits.front() == '(' ||
                                                       std::all_of(digits.begin(), digits.end(), continues_name));
                if (!plain) {
                    diagnostics_.error(value.part(first),
                                       "expected a whole number, a name or an expression in parentheses after '*'");
                    return std::nullopt;
                }
            }
            const NameLookup outer = defines_lookup();
            const auto compiled = Expression::compile(
                count,
                [&](std::string_view wanted) -> std::optional<NameMeaning> {
                    if (wanted == "n") return NameMeaning{true, 0, 0};
                    return outer(wanted);
                },
                diagnostics_);
            if (!compiled) return std::nullopt;
            item.count = *compiled;
            items.push_back(std::move(item));
        }
        if (items.empty()) {
            diagnostics_.error(key.name_at, "the schedule is empty: expected the names of tables");
            return std::nullopt;
        }
        return items;
    }

    // --- lookup structures ---------------------------------------------------------------------------------

    void finish_tables() {
        if (grammar_.tables_.size() > 1 && grammar_.tables_.size() * grammar_.symbols_.size() > most_places) {
            diagnostics_.error(pattern_.tables.front().name,
                               fmt::format("{} tables of {} symbols are too many: at most {} together",
                                           grammar_.tables_.size(), grammar_.symbols_.size(), most_places));
            return;
        }
        for (Table& table : grammar_.tables_) finish(table);
        if (grammar_.interpretation_) finish(*grammar_.interpretation_);
    }

    void finish(Table& table) {
        const std::size_t symbols = grammar_.symbols_.size();
        table.context_free_ =
            std::all_of(table.productions_.begin(), table.productions_.end(), [](const Production& production) {
                return !production.has_context() && production.predecessor.size() == 1;
            });
        if (table.context_free_ && grammar_.is_plain()) {
            table.first_.assign(symbols, -1);
            for (std::size_t i = table.productions_.size(); i > 0; --i) {
                table.first_[table.productions_[i - 1].predecessor.front()] = static_cast<std::int32_t>(i - 1);
            }
            return;
        }
        table.candidate_begin_.assign(symbols + 1, 0);
        for (const Production& production : table.productions_) {
            ++table.candidate_begin_[production.predecessor.front() + 1];
        }
        std::partial_sum(table.candidate_begin_.begin(), table.candidate_begin_.end(),
                         table.candidate_begin_.begin());
        table.candidate_list_.resize(table.productions_.size());
        std::vector<std::uint32_t> next(table.candidate_begin_.begin(), table.candidate_begin_.end() - 1);
        // Productions with context are tried before those without, else in the order of the file.
        for (const bool with_context : {true, false}) {
            for (std::uint32_t i = 0; i < table.productions_.size(); ++i) {
                const Production& production = table.productions_[i];
                if (production.has_context() != with_context) continue;
                table.candidate_list_[next[production.predecessor.front()]++] = i;
            }
        }
    }

    const Pattern& pattern_;
    Diagnostics& diagnostics_;
    Grammar grammar_;
    std::set<std::string, std::less<>> name_set_;
    std::size_t longest_name_ = 0;
    std::map<std::string_view, double> defines_;
    std::unordered_map<std::string_view, std::uint32_t> formals_;  // slots, of the production being read
    std::uint32_t draws_ = 1;                                      // draw 0 chooses among weights
    std::unordered_set<std::string> types_;                        // of modules that state their parameters
    std::map<Symbol, Span> looked_at_;  // by predecessors and contexts of parametric systems
    static constexpr Symbol no_symbol = std::numeric_limits<Symbol>::max();
    std::array<Symbol, 256> plain_symbols_ = [] {
        std::array<Symbol, 256> symbols{};
        symbols.fill(no_symbol);
        return symbols;
    }();  // of single letters without parameters
    std::unordered_map<std::string, Symbol> symbol_index_;
    std::unordered_map<std::string, std::uint32_t> letter_index_;
    Angle increment_;
    bool plus_turns_left_ = false;
    std::set<std::string, std::less<>> listed_;
    bool lists_considered_ = false;
    bool has_list_ = false;
};

Grammar compile_grammar(const Pattern& pattern, Diagnostics& diagnostics) {
    return GrammarCompiler(pattern, diagnostics).run();
}

bool Grammar::make_schedule(std::string* problem) {
    schedule_.clear();
    if (!schedule_items_) {
        if (steps_ > 0) schedule_.push_back({0, steps_});
        return true;
    }
    const double n = static_cast<double>(steps_);
    std::vector<ScheduleRun> runs;
    std::int64_t missing = steps_;  // filled from the end, so that the last tables are always applied
    double total = 0;
    for (const ScheduleItem& item : *schedule_items_) {
        const double count = std::floor(item.count.evaluate(std::span(&n, 1)));
        if (std::isnan(count)) {
            if (problem) *problem = "a count of the schedule is not a number";
            return false;
        }
        total += std::max(count, 0.0);
        // As a double n may be rounded up to 2^63, which is no number of steps.
        const std::int64_t steps = count >= n ? steps_ : static_cast<std::int64_t>(std::max(count, 0.0));
        if (steps > 0) runs.push_back({item.table, steps});
    }
    for (std::size_t i = runs.size(); i > 0 && missing > 0; --i) {
        const std::int64_t taken = std::min(missing, runs[i - 1].steps);
        schedule_.push_back({runs[i - 1].table, taken});
        missing -= taken;
    }
    if (missing > 0) {
        if (problem) {
            *problem = fmt::format("the schedule holds {} steps, the derivation length is {}", total, steps_);
        }
        return false;
    }
    std::reverse(schedule_.begin(), schedule_.end());
    return true;
}

std::vector<char> Grammar::reachable() const {
    std::vector<char> reached(symbols_.size(), 0);
    Word pending;
    const auto visit = [&](const Word& word) {
        for (const Symbol symbol : word) {
            if (!reached[symbol]) {
                reached[symbol] = 1;
                pending.push_back(symbol);
            }
        }
    };
    const auto follow = [&](const Table& table, Symbol symbol) {
        if (!table.context_free() || !is_plain()) {
            for (const std::uint32_t i : table.candidates(symbol)) visit(table.production(i).successor);
        } else if (const Word* successor = table.successor(symbol)) {
            visit(*successor);
        }
    };
    visit(axiom());
    while (!pending.empty()) {
        const Symbol symbol = pending.back();
        pending.pop_back();
        for (const Table& table : tables_) follow(table, symbol);
        if (interpretation_) follow(*interpretation_, symbol);
    }
    return reached;
}

std::optional<Grammar> Grammar::with_steps(std::int64_t steps) const {
    if (begun_) return std::nullopt;
    Grammar other = *this;
    other.steps_ = steps;
    if (!other.make_schedule(nullptr)) return std::nullopt;
    return other;
}

std::int64_t Grammar::steps_done() const {
    std::int64_t left = 0;
    for (const ScheduleRun& run : schedule_) left += run.steps;
    return steps_ - left;
}

Grammar Grammar::after(std::int64_t steps, std::shared_ptr<const ModuleWord> word) && {
    begun_ = true;
    axiom_ = std::move(word);
    for (ScheduleRun& run : schedule_) {
        const std::int64_t taken = std::min(run.steps, steps);
        run.steps -= taken;
        steps -= taken;
    }
    std::erase_if(schedule_, [](const ScheduleRun& run) { return run.steps == 0; });
    return std::move(*this);
}

Grammar Grammar::with_map(const std::vector<Symbol>& map) const {
    Grammar other = *this;
    Table table;
    for (Symbol symbol = 0; symbol < map.size(); ++symbol) {
        table.first_.push_back(static_cast<std::int32_t>(symbol));
        table.productions_.push_back({{}, {symbol}, {}, map[symbol] < symbols_.size() ? Word{map[symbol]} : Word{}});
    }
    other.tables_ = {std::move(table)};
    other.schedule_items_ = nullptr;
    other.steps_ = 1;
    other.schedule_ = {{0, 1}};
    return other;
}

std::optional<Grammar> Grammar::written_out(const ModuleWord& word) const {
    Grammar other = *this;
    other.tables_.assign(1, Table());
    other.interpretation_.reset();
    other.schedule_.clear();
    other.schedule_items_ = nullptr;
    other.begun_ = true;
    other.is_parametric_ = other.is_stochastic_ = false;
    other.cut_.reset();
    ModuleWord written;
    std::unordered_map<std::string, Symbol> known;  // by symbol and the bytes of its arguments
    std::string key;
    const double* next = word.arguments.data();
    for (const Symbol symbol : word.symbols) {
        const SymbolInfo& info = symbols_[symbol];
        const std::span<const double> arguments(next, info.arity);
        next += info.arity;
        if (arguments.empty()) {
            written.symbols.push_back(symbol);
            continue;
        }
        key.assign(reinterpret_cast<const char*>(&symbol), sizeof(symbol));
        key.append(reinterpret_cast<const char*>(arguments.data()), arguments.size_bytes());
        const auto [found, fresh] = known.try_emplace(key, static_cast<Symbol>(other.symbols_.size()));
        written.symbols.push_back(found->second);
        if (!fresh) continue;
        if (other.symbols_.size() >= most_symbols) return std::nullopt;
        SymbolInfo own = info;
        own.arguments.assign(arguments.begin(), arguments.end());
        own.arity = 0;
        Command& command = own.command;
        if (command.takes_argument) {
            command.value *= arguments.front();
            command.takes_argument = false;
            if (command.action == Action::turn || command.action == Action::pitch || command.action == Action::roll) {
                command.angle = angle_of_degrees(command.value);
                command.value = 0;
            }
        }
        other.symbols_.push_back(std::move(own));
        other.ignored_.push_back(ignored_[symbol]);
    }
    other.axiom_ = std::make_shared<const ModuleWord>(std::move(written));
    return other;
}

std::int64_t Grammar::whole_word_steps() const {
    if (cut_) return steps_ - steps_done();
    std::int64_t last = 0;
    std::int64_t before = 0;
    for (const ScheduleRun& run : schedule_) {
        before += run.steps;
        if (!tables_[run.table].context_free()) last = before;
    }
    return last;
}

void append_symbol(const SymbolInfo& symbol, std::span<const double> arguments, std::string& text) {
    text += symbol.letter;
    if (symbol.arity == 0) arguments = symbol.arguments;
    for (std::size_t i = 0; i < arguments.size(); ++i) {
        const double value = arguments[i];
        text += i == 0 ? '(' : ',';
        // What no number can say is said by what gives it.
        if (std::isfinite(value)) {
            std::array<char, 32> digits;
            const char* const end = fmt::format_to(digits.data(), FMT_COMPILE("{}"), value);
            text.append(digits.data(), static_cast<std::size_t>(end - digits.data()));
        } else {
            text += std::isnan(value) ? "0/0" : value > 0 ? "1/0" : "-1/0";
        }
    }
    if (!arguments.empty()) text += ')';
}

std::string symbol_text(const SymbolInfo& symbol, std::span<const double> arguments) {
    std::string text;
    append_symbol(symbol, arguments, text);
    return text;
}

bool needs_blank(const Grammar& grammar, Symbol before, Symbol after) {
    const SymbolInfo& one = grammar.symbols()[before];
    const SymbolInfo& other = grammar.symbols()[after];
    if (one.is_name || other.is_name) return true;
    if (grammar.names().empty() || one.arity > 0 || !one.arguments.empty()) return false;
    // Two letters that begin a name could be read as it, together with what follows.
    const std::string both = one.letter + other.letter;
    const auto found = std::lower_bound(grammar.names().begin(), grammar.names().end(), both);
    return found != grammar.names().end() && found->starts_with(both);
}

std::string to_text(const Grammar& grammar, std::span<const Symbol> word) {
    std::string text;
    for (std::size_t i = 0; i < word.size(); ++i) {
        if (i > 0 && needs_blank(grammar, word[i - 1], word[i])) text += ' ';
        text += symbol_text(grammar.symbols()[word[i]]);
    }
    return text;
}

std::string to_text(const Grammar& grammar, const ModuleWord& word) {
    std::string text;
    const double* next = word.arguments.data();
    for (std::size_t i = 0; i < word.symbols.size(); ++i) {
        const SymbolInfo& symbol = grammar.symbols()[word.symbols[i]];
        if (i > 0 && needs_blank(grammar, word.symbols[i - 1], word.symbols[i])) text += ' ';
        text += symbol_text(symbol, {next, symbol.arity});
        next += symbol.arity;
    }
    return text;
}

}  // namespace sikku
