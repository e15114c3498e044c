// engine/derivation/word_printer.h: a word as text, as `sikku derive` prints it.
#pragma once

#include "engine/derivation/derivation.h"

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace sikku {

/// Passes the text of a word on, in pieces of about 256 kB, and a line feed at its end. Blocks that recur are turned
/// into text once.
class WordPrinter : public SymbolSink {
public:
    /// @param grammar  must outlive it  @param write  may throw to end the derivation
    WordPrinter(const Grammar& grammar, std::function<void(std::string_view)> write);

    void symbols(const Run& run) override;
    void finish() override;
    std::string_view bytes() const override { return are_bytes_ ? std::string_view(bytes_) : std::string_view(); }
    void text(std::string_view bytes) override;

private:
    void append(std::span<const Symbol> symbols, std::string& text) const;
    void append_modules(const Run& run);
    void flush();

    const Grammar& grammar_;
    std::function<void(std::string_view)> write_;
    std::vector<std::string> texts_;
    bool are_bytes_ = false;
    std::string bytes_;  ///< the byte of each symbol, if are_bytes_
    bool has_names_ = false;
    bool has_last_ = false;
    Symbol last_ = 0;
    std::string buffer_;
    std::vector<std::string> blocks_;
};

}  // namespace sikku
