// engine/derivation/word_stream.h: the derived word as a stream that is read piece by piece.
#pragma once

#include "engine/derivation/derivation.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <vector>

namespace sikku {

/// Consecutive symbols of a word.
struct WordPiece {
    std::vector<Symbol> symbols;
    std::vector<double> arguments;  ///< SymbolInfo::arity values for each symbol, in order
};

/// Derives a word in a separate thread, which waits until its reader has taken the last piece. Memory: two pieces of
/// about 65,536 symbols, in addition to derive(). The destructor stops the thread within milliseconds. Only one
/// thread may read. A child process must not use the stream after fork().
class WordStream {
public:
    /// @param options  `watch` may be called from the new thread; `pruner` is ignored
    /// @throws std::system_error if no thread can be started
    WordStream(std::shared_ptr<const Grammar> grammar, DerivationOptions options);
    ~WordStream();
    WordStream(const WordStream&) = delete;
    WordStream& operator=(const WordStream&) = delete;

    enum class Next : std::uint8_t { piece, end, waiting };
    /// Reads the next piece into `piece`, reusing its memory. Returns `waiting` if none is ready after `patience`.
    /// @throws exceptions of derive(), once; then the stream has ended
    Next next(WordPiece& piece, std::chrono::milliseconds patience);

    /// Stops the thread and ends the stream. May be called from any thread except while it reads.
    void stop();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace sikku
