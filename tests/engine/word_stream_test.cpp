#include "engine/derivation/word_stream.h"

#include "tests/reference.h"

#include <gtest/gtest.h>

#include <string>

namespace sikku::word_stream_test {

using namespace std::chrono_literals;
using reference::grammar_of;

std::shared_ptr<const Grammar> shared(const std::string& text) {
    return std::make_shared<const Grammar>(grammar_of(text));
}

/// Keeps a word.
class Keeper : public SymbolSink {
public:
    void symbols(const Run& run) override {
        word.symbols.insert(word.symbols.end(), run.symbols.begin(), run.symbols.end());
        word.arguments.insert(word.arguments.end(), run.arguments.begin(), run.arguments.end());
    }
    WordPiece word;
};

WordPiece read_all(WordStream& stream) {
    WordPiece word;
    WordPiece piece;
    for (;;) {
        const WordStream::Next next = stream.next(piece, 1s);
        if (next == WordStream::Next::end) return word;
        if (next == WordStream::Next::waiting) continue;
        word.symbols.insert(word.symbols.end(), piece.symbols.begin(), piece.symbols.end());
        word.arguments.insert(word.arguments.end(), piece.arguments.begin(), piece.arguments.end());
    }
}

TEST(WordStream, HandsOverTheDerivedWord) {
    for (const char* text : {"axiom: +\n", "axiom: X\nX --> F+X-X\nderivation length: 17\n",
                             "axiom: A(1)\nA(x) --> F(x)A(x + 1)A(x / 2)\nderivation length: 16\n",
                             "axiom: AB\nA < B --> BA\nB --> AB\nderivation length: 14\n"}) {
        const auto grammar = shared(text);
        Keeper keeper;
        derive(*grammar, keeper);
        WordStream stream(grammar, {});
        const WordPiece word = read_all(stream);
        EXPECT_EQ(word.symbols, keeper.word.symbols) << text;
        EXPECT_EQ(word.arguments, keeper.word.arguments) << text;
        WordPiece none;
        EXPECT_EQ(stream.next(none, 0ms), WordStream::Next::end);
    }
}

TEST(WordStream, MayBeLeftAtAnyTime) {
    const auto endless = shared("axiom: F\nF --> FF\nderivation length: 1000\n");
    for (int pieces = 0; pieces < 20; ++pieces) {
        WordStream stream(endless, {});
        WordPiece piece;
        for (int i = 0; i < pieces; ++i) {
            ASSERT_EQ(stream.next(piece, 10s), WordStream::Next::piece);
            ASSERT_GE(piece.symbols.size(), 65'536U);
        }
        if (pieces % 2 == 0) {
            stream.stop();
            EXPECT_EQ(stream.next(piece, 0ms), WordStream::Next::end);
        }
    }
}

TEST(WordStream, ErrorsReachTheReader) {
    DerivationOptions options;
    options.longest_word = 1000;
    WordStream stream(shared("axiom: A\nA < A --> AA\nA --> AA\nderivation length: 30\n"), options);
    EXPECT_THROW(read_all(stream), BudgetError);
    WordPiece piece;
    EXPECT_EQ(stream.next(piece, 0ms), WordStream::Next::end);
}

}  // namespace sikku::word_stream_test
