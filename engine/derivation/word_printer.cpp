#include "engine/derivation/word_printer.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace sikku {
namespace {

constexpr std::size_t piece_bytes = std::size_t{1} << 18U;

}  // namespace

WordPrinter::WordPrinter(const Grammar& grammar, std::function<void(std::string_view)> write)
    : grammar_(grammar), write_(std::move(write)) {
    for (const SymbolInfo& symbol : grammar.symbols()) {
        texts_.push_back(symbol.arity > 0 ? std::string() : symbol_text(symbol));
    }
    has_names_ = !grammar.names().empty();
    are_bytes_ = !has_names_ &&
                 std::all_of(texts_.begin(), texts_.end(), [](const std::string& text) { return text.size() == 1; });
    for (const std::string& text : texts_) bytes_ += text.substr(0, 1);
    buffer_.reserve(piece_bytes + 4096);
}

void WordPrinter::symbols(const Run& run) {
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
    if (buffer_.size() >= piece_bytes) flush();
}

void WordPrinter::text(std::string_view bytes) {
    buffer_ += bytes;
    if (buffer_.size() >= piece_bytes) flush();
}

void WordPrinter::finish() {
    buffer_ += '\n';
    flush();
}

void WordPrinter::append(std::span<const Symbol> symbols, std::string& text) const {
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

void WordPrinter::append_modules(const Run& run) {
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

void WordPrinter::flush() {
    write_(buffer_);
    buffer_.clear();
}

}  // namespace sikku
