// cli/derive.cpp: `sikku derive`: the word or the map itself.
#include "cli/command.h"
#include "engine/base/memory.h"
#include "engine/derivation/forecast.h"
#include "engine/derivation/word_printer.h"
#include "engine/map/map_step.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

namespace sikku {
namespace {

void derive_as_text(const Document& document, Progress& progress) {
    const MapLimits limits{std::numeric_limits<double>::infinity(), static_cast<double>(available_memory()) / 2};
    const Map map = derive_map(document.grammar(), limits, progress.monitor());
    print_map(map, *document.map(), [](std::string_view text) { write_all(STDOUT_FILENO, text); });
}

}  // namespace

void add_derive(CLI::App& app, bool& quiet) {
    auto* command = app.add_subcommand("derive", "Print the derived word or map");
    auto options = std::make_shared<PatternOptions>();
    auto interpreted = std::make_shared<bool>(false);
    add_pattern_options(*command, *options);
    command->add_flag("--interpreted", *interpreted, "apply the productions under `interpret:`");
    command->footer(
        "The word is streamed to standard output; its length has no limit. Maps are printed as lines "
        "`edge LABEL TAIL HEAD BORN` (the step of its wall) and `cell +0 -3 …`, the half-edges clockwise around a "
        "cell: + from tail to head, - backwards; the last line is the outline.\n\n"
        "Examples:\n"
        "  sikku derive fibonacci-words\n"
        "  sikku derive koch-island -n 8 | wc -c");
    command->callback([options, interpreted, &quiet] {
        const Document loaded = load(*options, quiet);
        // A progress bar would be lost in a word that is printed on the terminal.
        const bool silent = quiet || isatty(STDOUT_FILENO) == 1 || isatty(STDERR_FILENO) == 0;
        Progress progress(silent);
        if (loaded.map()) return derive_as_text(loaded, progress);
        const Grammar grammar = shorten(loaded.grammar());
        if (!silent) progress.expect(expected_symbols(grammar, *interpreted));
#ifdef F_SETPIPE_SZ
        // A larger pipe means fewer turns between writer and reader; if it is refused, the old size remains.
        fcntl(STDOUT_FILENO, F_SETPIPE_SZ, 1 << 20);
#endif
        WordPrinter sink(grammar, [](std::string_view text) { write_all(STDOUT_FILENO, text); });
        DerivationOptions derivation;
        derivation.interpreted = *interpreted;
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
    });
}

}  // namespace sikku
