#include "engine/import/import.h"

#include "engine/base/characters.h"
#include "engine/base/text.h"
#include "engine/derivation/derivation.h"
#include "engine/language/foreign_text.h"
#include "engine/language/grammar.h"
#include "engine/language/undrawn.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t most_losses = 200;  // kept of one system
constexpr std::size_t most_told = 12;     // in its description
constexpr double most_derived = 200'000;  // nodes, to find a symbol that draws

struct InkFound {};

/// Ends a derivation at the first symbol that draws.
class InkFinder : public SymbolSink {
public:
    explicit InkFinder(const Grammar& grammar) : grammar_(grammar) {}
    void symbols(const Run& run) override {
        for (const Symbol symbol : run.symbols) {
            if (is_ink(grammar_.symbols()[symbol].command.action)) throw InkFound();
        }
    }

private:
    const Grammar& grammar_;
};

/// True if the word of the derivation length draws something, or is too long to be checked.
bool draws_something(const Grammar& grammar) {
    if (!may_draw(grammar)) return false;
    if (grammar.is_plain() && grammar.whole_word_steps() == 0) return true;  // may_draw() was exact
    InkFinder finder(grammar);
    try {
        derive(grammar, finder, DerivationOptions::within(most_derived));
        return false;
    } catch (const InkFound&) {
    } catch (const BudgetError&) {
    } catch (const WordError&) {
    }
    return true;
}

}  // namespace

std::optional<ImportFormat> import_format(std::string_view text) {
    const ForeignKind kind = foreign_kind(text);
    if (kind == ForeignKind::cpfg) return ImportFormat::cpfg;
    if (kind == ForeignKind::lpfg || kind == ForeignKind::lpy) return std::nullopt;
    return has_fractint_entry(text) ? std::optional(ImportFormat::fractint) : std::nullopt;
}

std::filesystem::path view_file_beside(const std::filesystem::path& file) {
    std::error_code error;
    auto beside = std::filesystem::path(file).replace_extension(".v");
    return std::filesystem::is_regular_file(beside, error) ? beside : std::filesystem::path();
}

std::string import_file_name(std::string_view name) {
    std::string result;
    for (const char byte : lower_case(name.substr(0, 200))) {
        if (is_letter_or_digit(byte)) {
            result += byte;
        } else if (!result.empty() && result.back() != '-') {
            result += '-';
        }
    }
    while (result.ends_with('-')) result.pop_back();
    return result.empty() ? "system" : result.substr(0, 80);
}

void ImportLosses::keep(std::string text) {
    if (list_.size() < most_losses) {
        list_.push_back(std::move(text));
    } else {
        ++more_;
    }
}

void ImportLosses::add(std::size_t at, const std::string& what) {
    keep(fmt::format("line {}: {}", line(at), what));
    diagnostics_.warning({file_, at, 1}, "not supported: " + what);
}

void ImportLosses::add(const SourcePointer& file, std::size_t at, const std::string& what) {
    const int where = file->place(at).line;
    keep(fmt::format("{}, line {}: {}", import_base_name(file->name()), where, what));
    diagnostics_.warning({file, at, 1}, "not supported: " + what);
}

int ImportLosses::line(std::size_t at) {
    const std::string& text = file_->text();
    at = std::min(at, text.size());
    const auto begin = text.begin();
    const auto newlines = [&](std::size_t from, std::size_t to) {
        return static_cast<int>(
            std::count(begin + static_cast<std::ptrdiff_t>(from), begin + static_cast<std::ptrdiff_t>(to), '\n'));
    };
    last_line_ += at >= last_at_ ? newlines(last_at_, at) : -newlines(at, last_at_);
    last_at_ = at;
    return last_line_;
}

std::vector<std::string> ImportLosses::take() {
    if (more_ > 0) list_.push_back(fmt::format("and {} more", more_));
    more_ = 0;
    return std::exchange(list_, {});
}

bool is_importable(const SourcePointer& file, std::string_view kind, Diagnostics& diagnostics) {
    if (file->text().size() > most_import_bytes) {
        diagnostics.unreadable({file, 0, 0}, "a file to import is at most 64 MB");
    } else if (const std::size_t nul = file->text().find('\0'); nul != std::string::npos) {
        diagnostics.unreadable({file, nul, 1}, fmt::format("a NUL byte: this is not {}", kind));
    }
    return !diagnostics.is_unreadable();
}

std::string import_base_name(std::string_view path) {
    return std::string(path.substr(path.rfind('/') + 1));
}

std::string import_head(std::string_view title, std::string_view source, std::string_view description,
                        const std::vector<std::string>& losses) {
    std::string head = fmt::format("title: {}\nsource: {}\ndescription: {}", pattern_line(title, 120),
                                   pattern_line(source), pattern_line(description));
    if (!losses.empty()) {
        head += " Not supported: ";
        const std::size_t told = std::min(losses.size(), most_told);
        for (std::size_t i = 0; i < told; ++i) head += (i > 0 ? "; " : "") + pattern_line(losses[i], 200);
        if (told < losses.size()) head += fmt::format("; and {} more", losses.size() - told);
        head += '.';
    }
    return head + '\n';
}

void compile_import(ImportedSystem& system, const Span& where, Diagnostics& diagnostics) {
    const std::string pattern = std::move(system.pattern);
    system.pattern.clear();
    Diagnostics own;
    if (pattern.size() > most_pattern_bytes) {
        return diagnostics.error(where, "the pattern of this system is longer than 64 MB");
    }
    const Pattern parsed = parse_pattern(system.name, pattern, own);
    if (!own.is_unreadable()) {
        const Grammar grammar = compile_grammar(parsed, own);
        if (!own.has_errors()) system.draws = draws_something(grammar);
    }
    if (!own.has_errors()) {
        system.pattern = pattern;
        return;
    }
    for (const Diagnostic& diagnostic : own.list()) {
        if (diagnostic.warning) continue;
        diagnostics.error(where, fmt::format("this system makes no pattern: {}", diagnostic.message));
        break;
    }
}

}  // namespace sikku
