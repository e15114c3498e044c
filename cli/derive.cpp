// cli/derive.cpp: `sikku derive`: the word or the map itself, the words of several steps, and the derivation tree.
#include "art/words/word_svg.h"
#include "cli/command.h"
#include "engine/base/memory.h"
#include "engine/derivation/forecast.h"
#include "engine/derivation/word_printer.h"
#include "engine/derivation/word_table.h"
#include "engine/map/map_step.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sikku {
namespace {

void derive_as_text(const Document& document, Progress& progress) {
    const MapLimits limits{std::numeric_limits<double>::infinity(), static_cast<double>(available_memory()) / 2};
    const Map map = derive_map(document.grammar(), limits, progress.monitor());
    print_map(map, *document.map(), [](std::string_view text) { write_all(STDOUT_FILENO, text); });
}

struct DeriveCommand : PatternOptions {
    bool is_interpreted = false;
    std::string generations;
    bool is_tree = false;
    std::string output;
    std::string format;
    std::size_t wrap = 0;
};

enum class WordFormat : std::uint8_t { text, markdown, latex, svg };

struct WordFormatName {
    WordFormat format;
    std::string_view name;
    std::string_view extension;
};
constexpr std::array<WordFormatName, 4> word_formats = {{{WordFormat::text, "text", ".txt"},
                                                         {WordFormat::markdown, "markdown", ".md"},
                                                         {WordFormat::latex, "latex", ".tex"},
                                                         {WordFormat::svg, "svg", ".svg"}}};

/// @throws UsageError
WordFormat word_format_of(const DeriveCommand& command) {
    if (!command.format.empty()) {
        for (const WordFormatName& row : word_formats) {
            if (row.name == command.format) return row.format;
        }
        throw UsageError(
            fmt::format("--format {}: expected text, markdown, latex or svg", printable(command.format)));
    }
    if (command.output.empty()) return command.is_tree ? WordFormat::svg : WordFormat::text;
    const std::string extension = extension_of(command.output);
    for (const WordFormatName& row : word_formats) {
        if (row.extension == extension) return row.format;
    }
    throw UsageError(fmt::format("-o {}: {}; words are .txt, .md, .tex or .svg, a tree is .svg",
                                 printable(command.output),
                                 extension.empty() ? "no extension" : "unknown extension"));
}

/// Returns the numbers of steps of the first and the last word. @throws UsageError
std::pair<std::int64_t, std::int64_t> steps_of_words(const DeriveCommand& command, const Grammar& grammar) {
    constexpr std::int64_t most_words = 1000;
    const std::string& text = command.generations;
    if (text.empty()) return {0, grammar.steps()};
    const auto refuse = [&](const std::string& why) {
        throw UsageError(fmt::format("--generations {}: {}", printable(text), why));
    };
    const std::size_t colon = text.find(':');
    const auto whole = [&](std::string_view part) {
        std::int64_t value = -1;
        const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
        const bool is_large = error == std::errc::result_out_of_range && part.front() != '-';
        if (is_large) value = most_steps + 1;
        if ((error != std::errc() && !is_large) || end != part.data() + part.size() || value < 0) {
            refuse("expected two numbers of steps such as 0:5");
        }
        return value;
    };
    const std::int64_t first = whole(std::string_view(text).substr(0, colon));
    const std::int64_t last = colon == std::string::npos ? first : whole(std::string_view(text).substr(colon + 1));
    if (last > most_steps) refuse(fmt::format("expected up to {} steps", most_steps));
    if (last < first) refuse("expected the lower number of steps first");
    if (last - first >= most_words) refuse(fmt::format("expected up to {} words", most_words));
    return {first, last};
}

/// Limits of a table, a figure or a tree.
struct WordLimits {
    std::uint64_t symbols;
    std::size_t words;
    const char* what;  ///< subject of the message
};

/// Refuses words that are too long before they are derived, unless a word would have to be derived for that.
/// @throws BudgetError
void require_short_words(const Grammar& grammar, std::int64_t first, std::int64_t last, const WordLimits& limits) {
    constexpr std::int64_t most_forecast = 2000;  // the cost grows with the square
    if (last > most_forecast || grammar.has_schedule()) return;
    double all = 0;
    for (std::int64_t steps = first; steps <= last; ++steps) {
        const auto shorter = grammar.with_steps(steps);
        const auto known = shorter ? estimate(*shorter, false) : std::nullopt;
        if (!known) return;
        all += std::pow(10.0, known->log10_length);
        if (all < static_cast<double>(limits.symbols) + 0.5) continue;
        throw BudgetError(fmt::format(
            "the words of steps {} to {} have too many symbols: {} has at most {} in all words together{}", first,
            last, limits.what, limits.symbols,
            steps == first ? "" : fmt::format("; --generations {}:{} fits", first, steps - 1)));
    }
}

/// @throws UsageError, BudgetError, WordError
std::string words_of(const DeriveCommand& command, const Document& loaded, const Monitor& monitor) {
    constexpr std::size_t most_columns = 1000, most_leaves = 256;
    const WordFormat format = word_format_of(command);
    if (command.is_tree && format != WordFormat::svg)
        throw UsageError("--tree: a tree is written as SVG: -o tree.svg");
    if (command.wrap > 0 && format != WordFormat::text && format != WordFormat::markdown) {
        throw UsageError("--wrap: applies only to text and Markdown");
    }
    const auto [first, last] = steps_of_words(command, loaded.grammar());
    const Document document =
        command.generations.empty()
            ? loaded
            : loaded.with({Setting{"--generations", "derivation length", std::to_string(last)}});
    const bool is_figure = format == WordFormat::svg;
    const WordLimits limits = command.is_tree ? WordLimits{2000, 100, "a tree"}
                              : is_figure     ? WordLimits{4000, 100, "an SVG of words"}
                                              : WordLimits{20'000, 1000, "a table of words"};
    if (last - first >= static_cast<std::int64_t>(limits.words)) {
        throw UsageError(
            fmt::format("{}: {} has at most {} words; steps {} to {} have more; --generations selects steps",
                        command.is_tree ? "--tree" : "--generations", limits.what, limits.words, first, last));
    }
    require_short_words(document.grammar(), first, last, limits);
    WordLineageLimits derived;
    derived.symbols = limits.symbols;
    const WordTable table = lay_out_words(
        document.grammar(), word_lineage(document.grammar(), first, last, command.is_interpreted, derived, monitor));
    if (is_figure) {
        WordFigure figure = word_figure(document.pattern());
        std::string options = fmt::format(" --generations {}:{}", first, last);
        if (command.is_tree) options += " --tree";
        if (command.is_interpreted) options += " --interpreted";
        figure.made = recipe(document, {options, true, false});
        return command.is_tree ? tree_svg(table, figure) : words_svg(table, figure);
    }
    if (format == WordFormat::latex) {
        if (table.leaves > most_leaves) {
            throw BudgetError(
                fmt::format("the words need {} columns; a LaTeX table has at most {}", table.leaves, most_leaves));
        }
        return words_as_latex(table, document.text("title"));
    }
    if (command.wrap == 0 && table.columns > most_columns) {
        throw BudgetError(
            fmt::format("the words need {} columns, more than {}; --wrap 100 breaks them into blocks of lines",
                        table.columns, most_columns));
    }
    return format == WordFormat::markdown ? words_as_markdown(table, command.wrap, document.text("title"))
                                          : words_as_text(table, command.wrap);
}

void derive_words(const DeriveCommand& command, bool quiet) {
    if (!command.steps.empty() && !command.generations.empty()) {
        throw UsageError("--generations: cannot be combined with a derivation length");
    }
    word_format_of(command);  // before the pattern is read
    const Document loaded = load(command, quiet);
    if (loaded.map()) {
        throw UsageError(fmt::format("{}: a map has no words; `sikku draw --generations` draws its steps",
                                     command.is_tree ? "--tree" : "--generations"));
    }
    keep_input("-o", command.output, loaded.source().name());
    Progress progress(quiet);
    const std::string text = words_of(command, loaded, progress.monitor());
    if (command.output.empty()) return write_all(STDOUT_FILENO, text);
    write_file(command.output, text);
}

void derive_word(const DeriveCommand& command, bool quiet) {
    const char* const given = !command.output.empty()   ? "-o"
                              : !command.format.empty() ? "--format"
                              : command.wrap > 0        ? "--wrap"
                                                        : nullptr;
    if (given) {
        throw UsageError(
            fmt::format("{}: needs --generations or --tree; the word itself is printed to standard output", given));
    }
    const Document loaded = load(command, quiet);
    // A progress bar would be lost in a word that is printed on the terminal.
    const bool silent = quiet || isatty(STDOUT_FILENO) == 1 || isatty(STDERR_FILENO) == 0;
    Progress progress(silent);
    if (loaded.map()) return derive_as_text(loaded, progress);
    const Grammar grammar = shorten(loaded.grammar());
    if (!silent) progress.expect(expected_symbols(grammar, command.is_interpreted));
#ifdef F_SETPIPE_SZ
    // A larger pipe means fewer turns between writer and reader; if it is refused, the old size remains.
    fcntl(STDOUT_FILENO, F_SETPIPE_SZ, 1 << 20);
#endif
    WordPrinter sink(grammar, [](std::string_view text) { write_all(STDOUT_FILENO, text); });
    DerivationOptions derivation;
    derivation.interpreted = command.is_interpreted;
    // Modules with parameters take more than symbols.
    // Two words of 4 bytes a symbol that double while they grow, 8 bytes for brackets; half of the memory.
    derivation.longest_word = available_memory() / (grammar.is_plain() ? 64 : 256);
    derivation.compared = 500'000'000;  // which takes a second
    derivation.watch = progress.watch();
    try {
        derive(grammar, sink, derivation);
    } catch (const Stopped&) {
        throw Interrupted("interrupted");  // part of the word is written
    }
}

}  // namespace

void add_derive(CLI::App& app, bool& quiet) {
    auto* command =
        app.add_subcommand("derive", "Print the derived word or map, the words of its steps, or the derivation tree");
    auto options = std::make_shared<DeriveCommand>();
    add_pattern_options(*command, *options);
    command->add_flag("--interpreted", options->is_interpreted, "apply the productions under `interpret:`");
    auto* const generations =
        command
            ->add_option(
                "--generations", options->generations,
                "print the words after A to B steps of a derivation of B steps, one below the other, each symbol "
                "above those that replace it; not for maps")
            ->type_name("A:B");
    command->add_flag("--tree", options->is_tree,
                      "draw the derivation tree of these words, of all steps by default, as SVG; not for maps");
    auto* const output =
        command
            ->add_option(
                "-o,--output", options->output,
                "file for the words of --generations (.txt, .md, .tex or .svg) or the tree (.svg); its extension "
                "selects the format (standard output)")
            ->type_name("FILE");
    auto* const format =
        command
            ->add_option("--format", options->format,
                         "format of the words of --generations: text, markdown, latex or svg, whatever the extension "
                         "(text)")
            ->type_name("FORMAT");
    command
        ->add_option("--wrap", options->wrap,
                     "break the words of --generations into blocks of lines with at most this many columns, 20 to "
                     "1000; text and Markdown")
        ->type_name("COLUMNS")
        ->check(CLI::Range(20, 1000));
    command->footer(
        "The word is streamed to standard output; its length has no limit. Maps are printed as lines "
        "`edge LABEL TAIL HEAD BORN` (the step of its wall) and `cell +0 -3 …`, the half-edges clockwise around a "
        "cell: + from tail to head, - backwards; the last line is the outline.\n\n"
        "All words of --generations belong to one derivation of B steps: a schedule selects the same tables for all "
        "of them. Symbols that the next step replaces are red in SVG and underlined in LaTeX. All words "
        "together have at most 20,000 symbols in text, Markdown and LaTeX, 4,000 in an SVG of words and 2,000 in a "
        "tree.\n\n"
        "Examples:\n"
        "  sikku derive fibonacci-words\n"
        "  sikku derive koch-island -n 8 | wc -c\n"
        "  sikku derive fibonacci-words --generations 0:5\n"
        "  sikku derive anabaena --generations 0:4 -o words.svg\n"
        "  sikku derive fibonacci-words --generations 0:5 --tree -o tree.svg");
    command->callback([=, &quiet] {
        const auto refuse_empty = [](const CLI::Option* option, const std::string& value, const char* message) {
            if (option->count() > 0 && value.empty()) throw UsageError(message);
        };
        refuse_empty(generations, options->generations, "--generations: expected two numbers of steps such as 0:5");
        refuse_empty(output, options->output, "-o: expected the name of a file");
        refuse_empty(format, options->format, "--format: expected text, markdown, latex or svg");
        const bool has_words = options->is_tree || !options->generations.empty();
        has_words ? derive_words(*options, quiet) : derive_word(*options, quiet);
    });
}

}  // namespace sikku
