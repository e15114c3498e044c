#include "engine/language/word_reader.h"

#include <fmt/format.h>

#include <algorithm>

namespace sikku {
namespace {

constexpr std::size_t large_word = std::size_t{1} << 22;  // bytes
constexpr std::size_t most_parameters = 64;               // variable parameters of a module

std::string type_key(std::string_view letter, std::size_t parameters) {
    return fmt::format("{}({}", letter, parameters);
}

}  // namespace

ModuleTypes::ModuleTypes(const Pattern& pattern, const SymbolNames& names) {
    std::unordered_set<std::string_view> formals;  // parameters of the current production
    const auto mentions = [&](const Span& text) { return text.view().find('(') != std::string_view::npos; };
    const auto is_computed = [&](const Span& part) {
        const auto mentioned = names_in(part.view());
        return std::any_of(mentioned.begin(), mentioned.end(),
                           [&](std::string_view name) { return name == "random" || formals.contains(name); });
    };
    const auto computed = [&](std::string_view letter, const std::vector<Span>& parts, const Span&) {
        if (std::any_of(parts.begin(), parts.end(), is_computed)) types_.insert(type_key(letter, parts.size()));
    };
    const auto named = [&](std::string_view letter, const std::vector<Span>& parts, const Span&) {
        if (parts.empty()) return;
        types_.insert(type_key(letter, parts.size()));
        for (const Span& part : parts) formals.insert(part.view());
    };
    const auto look_at = [&](const std::vector<ProductionText>& productions) {
        for (const ProductionText& text : productions) {
            formals.clear();
            for (const auto& span : {text.left, std::optional(text.predecessor), text.right}) {
                if (span && mentions(*span)) for_each_symbol(names, *span, named);
            }
            if (mentions(text.successor)) for_each_symbol(names, text.successor, computed);
        }
    };
    look_at(pattern.common);
    for (const TableText& table : pattern.tables) look_at(table.productions);
    look_at(pattern.interpret);
    const Key* axiom = pattern.find("axiom");
    if (axiom && axiom->value.view().find("random") != std::string_view::npos) {
        for_each_symbol(names, axiom->value, computed);
    }
}

bool ModuleTypes::contains(std::string_view letter, std::size_t parameters) const {
    return !types_.empty() && types_.contains(type_key(letter, parameters));
}

/// The parameters of one module of a word.
struct WordReader::Parameters {
    std::vector<Expression> own;    ///< variable parameters, in an axiom or a successor
    std::vector<double> constants;  ///< constant parameters, which are part of the symbol
    std::uint32_t arity = 0;        ///< number of variable parameters
};

Symbol WordReader::intern(std::string letter, bool is_name, std::vector<double> arguments, std::uint32_t arity) {
    std::string key = letter;
    key += '\0';
    if (arity > 0) key += fmt::format("{}", arity);
    for (const double value : arguments) key += fmt::format("({}", value == 0 ? 0.0 : value);
    const auto [found, fresh] = symbol_index_.try_emplace(key, static_cast<Symbol>(symbols_.size()));
    if (fresh) {
        const auto [letter_at, new_letter] =
            letter_index_.try_emplace(letter, static_cast<std::uint32_t>(letters_.size()));
        if (new_letter) letters_.push_back(letter);
        symbols_.push_back({std::move(letter), std::move(arguments), is_name, letter_at->second, {}, arity});
    }
    return found->second;
}

Symbol WordReader::renamed(Symbol symbol, const std::string& letter, bool is_name) {
    const SymbolInfo info = symbols_[symbol];
    return intern(letter, is_name, info.arguments, info.arity);
}

std::optional<Word> WordReader::word(const Span& span, WordPlace place, std::vector<Expression>* arguments) {
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

/// Passes each symbol to `take`, with its variable parameters; false after the first error.
template <class Take>
bool WordReader::read_word(const Span& span, WordPlace place, Take take) {
    WordScanner scanner(names_, span, &diagnostics_);
    Parameters read;
    while (true) {
        const bool blank_before = scanner.skip_blanks();
        if (scanner.at_end()) return true;
        const std::size_t begin = scanner.at();
        const std::string_view letter = scanner.letter(blank_before);
        if (letter.empty()) return false;
        const bool is_name = scanner.is_name();
        const bool plain = letter.size() == 1 && !scanner.at_parameters();
        read.own.clear();
        if (plain) {
            // Most symbols are single letters that were met before.
            const std::optional<Symbol> known = plain_symbols_[static_cast<unsigned char>(letter.front())];
            if (known && letter != "%") {
                take(*known, read.own);
                continue;
            }
        }
        read.constants.clear();
        read.arity = 0;
        if (scanner.at_parameters() && !read_parameters(scanner, span, letter, place, read)) return false;
        if (letter == "%" && place != WordPlace::list && place != WordPlace::axiom_or_successor) {
            return diagnostics_.refuse(span.part(begin), "the cut symbol '%' is removed before productions apply");
        }
        if (symbols_.size() >= most_symbols) {
            return diagnostics_.refuse(span.part(begin), "there are more than 524,288 different symbols");
        }
        const Symbol symbol = intern(std::string(letter), is_name, read.constants, read.arity);
        if (letter == "%" && place == WordPlace::axiom_or_successor) cut_ = symbol;
        if (plain) plain_symbols_[static_cast<unsigned char>(letter.front())] = symbol;
        take(symbol, read.own);
    }
}

/// Reads the parameters after `letter`.
bool WordReader::read_parameters(WordScanner& scanner, const Span& span, std::string_view letter, WordPlace place,
                                 Parameters& read) {
    const std::size_t open = scanner.at();
    if (place == WordPlace::list) {
        return diagnostics_.refuse(span.part(open), "a list of symbols cannot contain parameters");
    }
    std::vector<Span> parts;
    if (!scanner.parameters(parts)) return false;
    if (letter == "%") return diagnostics_.refuse(span.part(open), "the cut symbol '%' has no parameters");
    if (place != WordPlace::axiom_or_successor) {
        if (!read_formals(parts)) return false;
        read.arity = static_cast<std::uint32_t>(parts.size());
    } else if (types_.contains(letter, parts.size())) {
        if (!read_expressions(parts, read.own)) return false;
        read.arity = static_cast<std::uint32_t>(parts.size());
    } else {
        for (const Span& part : parts) {
            const auto value = defines_.constant(part, diagnostics_);
            if (!value) return false;
            read.constants.push_back(*value);
        }
    }
    if (read.arity > most_parameters) {
        return diagnostics_.refuse(span.part(open), "a module has at most 64 parameters");
    }
    return true;
}

bool WordReader::read_formals(const std::vector<Span>& parts) {
    for (const Span& part : parts) {
        const std::string_view name = part.view();
        if (!is_expression_name(name)) {
            return diagnostics_.refuse(part, "parameters of a predecessor and its contexts must be names");
        }
        if (!formals_.try_emplace(name, static_cast<std::uint32_t>(formals_.size())).second) {
            return diagnostics_.refuse(part, fmt::format("the parameter '{}' is named twice", name));
        }
    }
    return true;
}

std::optional<Expression> WordReader::expression(const Span& text) {
    const auto names = [this](std::string_view name) -> std::optional<NameMeaning> {
        if (const auto formal = formals_.find(name); formal != formals_.end()) {
            return NameMeaning{true, 0.0, formal->second};
        }
        return defines_.find(name);
    };
    return Expression::compile(text, names, diagnostics_, &draws_);
}

bool WordReader::read_expressions(const std::vector<Span>& parts, std::vector<Expression>& own) {
    for (const Span& part : parts) {
        auto compiled = expression(part);
        if (!compiled) return false;
        if (compiled->uses_chance()) uses_chance_ = true;
        own.push_back(std::move(*compiled));
    }
    return true;
}

std::optional<std::pair<Symbol, Span>> WordReader::symbol_of(const Key& key, std::string_view before) {
    if (!key.name.starts_with(before)) return std::nullopt;
    const std::size_t length = std::min<std::size_t>(key.name.size() - before.size(), key.name_at.length);
    const Span name = key.name_at.part(key.name_at.length - length);
    const auto symbol = word(name, WordPlace::list);
    if (!symbol) return std::nullopt;
    if (symbol->size() == 1) return std::pair(symbol->front(), name);
    return diagnostics_.refuse(
        name,
        fmt::format("'{}' is not one symbol; names of several letters are listed under 'symbols:'", name.view()));
}

std::optional<Word> WordReader::symbol_list(const Key& key) {
    if (const std::size_t comma = key.value.view().find(','); comma != std::string_view::npos) {
        return diagnostics_.refuse(key.value.part(comma), "symbols are separated by blanks, not by commas");
    }
    return word(key.value, WordPlace::list);
}

}  // namespace sikku
