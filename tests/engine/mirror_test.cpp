// Mirror images of productions: against the same productions written out.
#include "engine/derivation/derivation.h"
#include "engine/derivation/origins.h"
#include "engine/language/document.h"
#include "tests/checks.h"
#include "tests/module_reference.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sikku::mirror_test {

using reference::expect_mistakes;
using reference::grammar_of;

/// The word after n steps, interpreted.
std::string word(const std::string& pattern, int n) {
    const Grammar word = write_out(grammar_of(pattern, {{"-n", "derivation length", std::to_string(n)}}), {});
    return to_text(word, word.axiom());
}

TEST(Mirror, AddsTheProductionsOfThePartner) {
    const std::string explicit_form =
        "angle factor: 10\naxiom: A[++a]|B-b\n"
        "A --> [f++f|A][f++B]\na --> [f--f|a][f--b]\nB --> [++f++B][--f++++f+b][++f----a]\n"
        "b --> [--f--b][++f----f-B][--f++++A]\nf --> -f++f-\n"
        "interpret:\nA --> [{F+F++++F+F;(1)}]\na --> [{F-F----F-F;(1)}]\n";
    const std::string mirrored =
        "angle factor: 10\nmirror: A a B b\naxiom: A[++a]|B-b\n"
        "A --> [f++f|A][f++B]\nB --> [++f++B][--f++++f+b][++f----a]\nf --> -f++f-\n"
        "interpret:\nA --> [{F+F++++F+F;(1)}]\n";
    for (int n = 0; n < 5; ++n) {
        EXPECT_EQ(word(mirrored, n), word(explicit_form, n)) << n;
    }
}

TEST(Mirror, KeepsParametersConditionsAndContexts) {
    const std::string explicit_form =
        "axiom: A(1)a(2)BX\n"
        "A(x) : x < 9 --> A(x*2)+(x)f(x)a(x)\na(x) : x < 9 --> a(x*2)-(x)f(x)A(x)\n"
        "a(x) < B > X --> /B-\nA(x) < b > X --> \\b+\n";
    const std::string mirrored =
        "axiom: A(1)a(2)BX\nmirror: A a B b\n"
        "A(x) : x < 9 --> A(x*2)+(x)f(x)a(x)\na(x) < B > X --> /B-\n";
    for (int n = 0; n < 5; ++n) EXPECT_EQ(word(mirrored, n), word(explicit_form, n)) << n;
}

TEST(Mirror, LeavesStatedProductionsAlone) {
    EXPECT_EQ(word("mirror: A a\naxiom: Aa\nA --> A+F\na --> aF\n", 2), "A+F+FaFF");
    EXPECT_EQ(word("mirror: A a\naxiom: Aa\na --> a-F\n", 1), "A+Fa-F") << "either of a pair may be stated";
    const std::string tables = "mirror: A a\naxiom: Aa\nschedule: t\nA --> A+F\ntable t:\n";
    EXPECT_EQ(word(tables + "X --> F\n", 1), "A+Fa-F");
    EXPECT_EQ(word(tables + "a --> f\n", 1), "A+Ff") << "a table may state its own instead of a common image";
    // A symbol that is its own image, and tables.
    EXPECT_EQ(
        word("mirror: A a\naxiom: aC\nC --> A\nschedule: one two\ntable one:\nA --> +A\ntable two:\nA --> --A\n", 2),
        "-++a--A");
}

TEST(Mirror, MakesTheChoicesOfThePartner) {
    const std::string text = "mirror: A a\nseed: 5\naxiom: AaAaAaAa\nA --> A+ : 0.5\nA --> -A : 0.5\n";
    const std::string found = word(text, 1);
    EXPECT_TRUE(has(found, "a-"));
    EXPECT_TRUE(has(found, "+a"));
}

/// The symbols of a mirrored production come from the text that it mirrors.
TEST(Mirror, HasOrigins) {
    const std::string text = "mirror: A a\naxiom: a\nderivation length: 1\nA --> +fA\n";
    const Document document = parse("x", text);
    const auto found = origins(document, std::vector<std::uint64_t>{1, 2, 3});
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].symbol.view(), "+");
    EXPECT_EQ(found[2].symbol.view(), "A");
    EXPECT_EQ(found[2].production.view(), "A --> +fA");
}

TEST(Mirror, SaysWhatIsWrong) {
    expect_mistakes("mirror: A\naxiom: A\n", {{{1, 9}, "expected pairs of symbols, such as A a B b"}});
    expect_mistakes("mirror: + A\naxiom: A\n", {{{1, 9}, "'+' cannot be listed: turns are mirrored anyway"}});
    expect_mistakes("mirror: A a a b\naxiom: A\n", {{{1, 9}, "'a' is listed twice"}});
    expect_mistakes("mirror: A, a\naxiom: A\n", {{{1, 10}, "symbols are separated by blanks, not by commas"}});
}

}  // namespace sikku::mirror_test
