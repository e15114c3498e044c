// cli/derive.cpp: `sikku derive`: the word or the map itself.
#include "cli/command.h"
#include "engine/base/memory.h"
#include "engine/derivation/forecast.h"
#include "engine/map/map_step.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <limits>
#include <string_view>

namespace sikku {
namespace {

/// @throws std::runtime_error that names the cause; Interrupted
void write_all(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = ::write(descriptor, text.data(), text.size());
        if (written < 0) {
            if (errno == EINTR && !interrupted()) continue;
            if (interrupted()) throw Interrupted();
            throw std::runtime_error(fmt::format("standard output: {}", std::strerror(errno)));
        }
        text.remove_prefix(static_cast<std::size_t>(written));
    }
}

/// Prints symbols to a file descriptor. Blocks that recur are turned into text once.
class TextSink : public SymbolSink {
public:
    TextSink(const Grammar& grammar, int descriptor) : grammar_(grammar), descriptor_(descriptor) {
        for (const SymbolInfo& symbol : grammar.symbols()) {
            texts_.push_back(symbol.arity > 0 ? std::string() : symbol_text(symbol));
        }
        has_names_ = !grammar.names().empty();
        are_bytes_ = !has_names_ && std::all_of(texts_.begin(), texts_.end(),
                                                [](const std::string& text) { return text.size() == 1; });
        for (const std::string& text : texts_) bytes_ += text.substr(0, 1);
        buffer_.reserve(buffer_size + 4096);
#ifdef F_SETPIPE_SZ
        // A larger pipe means fewer turns between writer and reader; if it is refused, the old size remains.
        fcntl(descriptor, F_SETPIPE_SZ, 1 << 20);
#endif
    }

    void symbols(const Run& run) override {
        if (has_last_ && has_names_ && needs_blank(grammar_, last_, run.symbols.front())) buffer_ += ' ';
        if (!run.arguments.empty()) {
            append_modules(run);
        } else if (run.block < 0) {
            append(run.symbols, buffer_);
        } else {
            const auto number = static_cast<std::size_t>(run.block);
            if (number >= blocks_.size()) blocks_.resize(number + 1);
            std::string& text = blocks_[number];
            if (text.empty()) append(run.symbols, text);
            buffer_ += text;
        }
        last_ = run.symbols.back();
        has_last_ = true;
        if (buffer_.size() >= buffer_size) flush();
    }

    void finish() override {
        buffer_ += '\n';
        flush();
    }

private:
    static constexpr std::size_t buffer_size = std::size_t{1} << 18;

    void append(std::span<const Symbol> symbols, std::string& text) const {
        if (are_bytes_) {
            const std::size_t before = text.size();
            text.resize(before + symbols.size());
            std::transform(symbols.begin(), symbols.end(), text.begin() + static_cast<std::ptrdiff_t>(before),
                           [this](Symbol symbol) { return bytes_[symbol]; });
            return;
        }
        for (std::size_t i = 0; i < symbols.size(); ++i) {
            if (i > 0 && has_names_ && needs_blank(grammar_, symbols[i - 1], symbols[i])) text += ' ';
            text += texts_[symbols[i]];
        }
    }

    void append_modules(const Run& run) {
        const double* next = run.arguments.data();
        for (std::size_t i = 0; i < run.symbols.size(); ++i) {
            const Symbol symbol = run.symbols[i];
            if (i > 0 && has_names_ && needs_blank(grammar_, run.symbols[i - 1], symbol)) buffer_ += ' ';
            const SymbolInfo& info = grammar_.symbols()[symbol];
            if (info.arity == 0) {
                buffer_ += texts_[symbol];
            } else {
                append_symbol(info, {next, info.arity}, buffer_);
                next += info.arity;
            }
        }
    }

    void flush() {
        write_all(descriptor_, buffer_);
        buffer_.clear();
    }

    const Grammar& grammar_;
    int descriptor_;
    std::vector<std::string> texts_;
    bool are_bytes_ = false;
    std::string bytes_;  ///< the byte of each symbol, if are_bytes_
    bool has_names_ = false;
    bool has_last_ = false;
    Symbol last_ = 0;
    std::string buffer_;
    std::vector<std::string> blocks_;
};

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
        TextSink sink(grammar, STDOUT_FILENO);
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
