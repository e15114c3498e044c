#include "engine/derivation/origins.h"

#include "engine/derivation/derivation.h"

#include <gtest/gtest.h>

#include <cctype>
#include <numeric>
#include <string>

namespace sikku::origins_test {

class Keeper : public SymbolSink {
public:
    void symbols(const Run& run) override { word.insert(word.end(), run.symbols.begin(), run.symbols.end()); }
    Word word;
};

/// A symbol or its mirror image, in the notation of the bundled patterns.
std::string unmirrored(std::string symbol) {
    for (char& each : symbol)
        each = each == '-' ? '+' : static_cast<char>(std::tolower(static_cast<unsigned char>(each)));
    return symbol;
}

/// The word as derive() gives it, and the texts that the origins of its symbols show.
void expect_same(const Document& document) {
    Keeper keeper;
    derive(document.grammar(), keeper, {.interpreted = true});
    std::vector<std::uint64_t> positions(std::min<std::size_t>(keeper.word.size(), 5000));
    std::iota(positions.begin(), positions.end(), 1);
    const auto found = origins(document, positions);
    ASSERT_EQ(found.size(), positions.size());
    for (std::size_t i = 0; i < positions.size(); ++i) {
        ASSERT_FALSE(found[i].symbol.empty());
        const std::string symbol = symbol_text(document.grammar().symbols()[keeper.word[i]]);
        const std::string shown(found[i].symbol.view().substr(0, symbol.find('(')));
        const std::string expected = symbol.substr(0, symbol.find('('));
        // A mirrored production comes from the text of the other.
        const bool is_mirrored = document.pattern().find("mirror") != nullptr;
        EXPECT_EQ(is_mirrored ? unmirrored(shown) : shown, is_mirrored ? unmirrored(expected) : expected)
            << "symbol " << positions[i];
    }
}

TEST(Origins, ShowTheSymbolsOfTheWord) {
    std::size_t traced = 0;
    for (const LibraryPattern& pattern : PatternLibrary::bundled().patterns()) {
        SCOPED_TRACE(pattern.name);
        const Document document = load(pattern.name);
        if (document.map()) continue;
        try {
            origins(document, {});
        } catch (const std::runtime_error&) {
            continue;
        }
        expect_same(document);
        ++traced;
    }
    EXPECT_GT(traced, 60U);
}

TEST(Origins, TablesInterpretationAndErasedSymbolsAreFollowed) {
    expect_same(parse("tables",
                      "axiom: AB\nderivation length: 5\nschedule: a b a b a\n\ntable a:\nA --> A[+B]C\nB --> *\n\n"
                      "table b:\nC --> BA\n\ninterpret:\nC --> FF\n"));
}

TEST(Origins, HavePlaces) {
    const Document document = parse("koch", "axiom: F+X\nderivation length: 2\nF --> F - F\n");
    const auto found = origins(document, std::vector<std::uint64_t>{1, 6, 8, 9, 10});
    ASSERT_EQ(found.size(), 5U);
    EXPECT_EQ(document.source().place(found[0].symbol.at).column, 7);  // F-F-F-F+X
    EXPECT_EQ(found[0].production.view(), "F --> F - F");
    EXPECT_EQ(found[1].symbol.view(), "-");
    EXPECT_EQ(document.source().place(found[1].symbol.at).column, 9);
    EXPECT_TRUE(found[2].production.empty());
    EXPECT_EQ(found[3].symbol.view(), "X");
    EXPECT_TRUE(found[4].symbol.empty());
}

TEST(Origins, LongWordsAreNotDerived) {
    const Document document = load("hilbert", {"", {{"test", "derivation length", "30"}}});
    const auto found = origins(document, std::vector<std::uint64_t>{1'000'000'000'000'000'000});
    EXPECT_FALSE(found.front().symbol.empty());
}

TEST(Origins, ContextsParametersAndChanceAreRefused) {
    for (const char* text :
         {"axiom: AB\nA < B --> A\n", "axiom: A(1)\nA(x) --> A(x+1)\n", "axiom: A\nA --> A : 1\nA --> AA : 1\n"}) {
        EXPECT_THROW(origins(parse("refused", text), {}), std::runtime_error) << text;
    }
}

}  // namespace sikku::origins_test
