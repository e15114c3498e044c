// engine/derivation/word_stream.h: the derived word as a stream that its reader pulls, piece by piece.
#pragma once

#include "engine/derivation/derivation.h"

#include <chrono>
#include <cstdint>
#include <memory>
#include <vector>

namespace sikku {

/// A stretch of neighbouring symbols of a word.
struct WordPiece {
    std::vector<Symbol> symbols;
    std::vector<double> arguments;  ///< SymbolInfo::arity values for each symbol, in order
};

/// Derives a word in a thread of its own, which waits while its reader has a piece to read. At most two pieces of
/// about 65,536 symbols are in memory, and what derive() keeps. The destructor stops the thread, within milliseconds.
/// One thread may read. After a fork() the child has to leave the stream alone.
class WordStream {
public:
    /// @param options  `watch` may be called from the new thread; `pruner` is ignored
    /// @throws std::system_error if no thread can be started
    WordStream(std::shared_ptr<const Grammar> grammar, DerivationOptions options);
    ~WordStream();
    WordStream(const WordStream&) = delete;
    WordStream& operator=(const WordStream&) = delete;

    enum class Next : std::uint8_t { piece, end, waiting };
    /// Reads the next piece into `piece`, whose memory is used again. Returns `waiting` if there is none after
    /// `patience`. @throws what derive() throws, once; then the stream has ended
    Next next(WordPiece& piece, std::chrono::milliseconds patience);

    /// Stops the thread; the stream has ended. May be called from any thread that does not read.
    void stop();

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace sikku
