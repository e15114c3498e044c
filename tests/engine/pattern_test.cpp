#include "engine/language/pattern.h"

#include "tests/checks.h"
#include "tests/reference.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>

namespace sikku::pattern_test {

using reference::diagnostics_of;
using reference::expect_mistakes;

/// Parses what must be right.
Pattern parsed(const std::string& text) {
    Diagnostics diagnostics;
    Pattern pattern = parse_pattern("test.lsys", text, diagnostics);
    for (const Diagnostic& diagnostic : diagnostics.list()) ADD_FAILURE() << diagnostic.text();
    return pattern;
}
std::string axiom_of(const std::string& text) {
    return parsed(text).text("axiom");
}
std::string repeated(std::string_view piece, std::size_t times) {
    std::string text;
    for (std::size_t i = 0; i < times; ++i) text += piece;
    return text;
}

TEST(Pattern, EveryKindOfLineIsRead) {
    const Pattern pattern = parsed(
        "// a comment\n"
        "title: Snake --> kolam: one\n"
        "source: page 12, http://example.org\n"
        "description: ( < > *\n"
        "define r1 = 0.75\n"
        "#define r2 (r1 + 1)\n"
        "derivation length: 3\n"
        "A --> B\n"
        "l < B > r : x > 1 --> CD : 0.5\n"
        "table grow:\n"
        "C --> *\n"
        "axiom: A\n"
        "table rest:\n"
        "D -->\n"
        "interpret:\n"
        "A --> F\n"
        "variant tall: r1 = 2, derivation length = 7\n");
    EXPECT_EQ(pattern.text("title"), "Snake --> kolam: one");
    EXPECT_EQ(pattern.text("source"), "page 12, http://example.org");
    EXPECT_EQ(pattern.text("description"), "( < > *");
    EXPECT_EQ(pattern.text("axiom"), "A");
    EXPECT_EQ(pattern.text("nothing"), "");
    EXPECT_EQ(pattern.find("nothing"), nullptr);
    ASSERT_EQ(pattern.defines.size(), 2u);
    EXPECT_EQ(pattern.defines[0].name.view(), "r1");
    EXPECT_EQ(pattern.defines[0].value.view(), "0.75");
    EXPECT_EQ(pattern.defines[1].name.view(), "r2");
    EXPECT_EQ(pattern.defines[1].value.view(), "(r1 + 1)");
    ASSERT_EQ(pattern.common.size(), 2u);
    EXPECT_FALSE(pattern.common[0].left || pattern.common[0].right || pattern.common[0].condition ||
                 pattern.common[0].weight);
    const ProductionText& full = pattern.common[1];
    EXPECT_EQ(full.left.value().view(), "l");
    EXPECT_EQ(full.predecessor.view(), "B");
    EXPECT_EQ(full.right.value().view(), "r");
    EXPECT_EQ(full.condition.value().view(), "x > 1");
    EXPECT_EQ(full.successor.view(), "CD");
    EXPECT_EQ(full.weight.value().view(), "0.5");
    ASSERT_EQ(pattern.tables.size(), 2u);
    EXPECT_EQ(pattern.tables[0].name.view(), "grow");
    ASSERT_EQ(pattern.tables[0].productions.size(), 1u);
    EXPECT_EQ(pattern.tables[0].productions[0].successor.view(), "*");
    ASSERT_EQ(pattern.tables[1].productions.size(), 1u);
    EXPECT_EQ(pattern.tables[1].productions[0].successor.view(), "");
    ASSERT_EQ(pattern.interpret.size(), 1u);
    EXPECT_EQ(pattern.interpret[0].successor.view(), "F");
    ASSERT_EQ(pattern.variants.size(), 1u);
    EXPECT_EQ(pattern.variants[0].name.view(), "tall");
    ASSERT_EQ(pattern.variants[0].settings.size(), 2u);
    EXPECT_EQ(pattern.variants[0].settings[1].value.view(), "7");
}

TEST(Pattern, SeparatorsInParenthesesDoNotSeparate) {
    const Pattern pattern = parsed("A(x:y<z>w) < B(-->) > C(:) : (a > b) && c --> D(x:y) E : (1:2)\n");
    ASSERT_EQ(pattern.common.size(), 1u);
    const ProductionText& text = pattern.common[0];
    EXPECT_EQ(text.left.value().view(), "A(x:y<z>w)");
    EXPECT_EQ(text.predecessor.view(), "B(-->)");
    EXPECT_EQ(text.right.value().view(), "C(:)");
    EXPECT_EQ(text.condition.value().view(), "(a > b) && c");
    EXPECT_EQ(text.successor.view(), "D(x:y) E");
    EXPECT_EQ(text.weight.value().view(), "(1:2)");
}

TEST(Pattern, ContextsMayBeHalf) {
    const Pattern pattern = parsed("A < B --> C\nB > C --> D\nX --> A : B : 2\n");
    ASSERT_EQ(pattern.common.size(), 3u);
    EXPECT_EQ(pattern.common[0].left.value().view(), "A");
    EXPECT_FALSE(pattern.common[0].right);
    EXPECT_EQ(pattern.common[1].right.value().view(), "C");
    EXPECT_FALSE(pattern.common[1].left);
    EXPECT_EQ(pattern.common[2].successor.view(), "A : B");  // the last ':' starts the weight
    EXPECT_EQ(pattern.common[2].weight.value().view(), "2");
}

TEST(Pattern, KeysAreReadInAnyCaseAndSpacing) {
    const Pattern pattern = parsed("  AXIOM  :  F + F  \nDerivation \t LENGTH: 3\n\tAngle Factor:8\nTiTLe: x\n");
    EXPECT_EQ(pattern.text("axiom"), "F + F");
    EXPECT_EQ(pattern.text("derivation length"), "3");
    EXPECT_EQ(pattern.text("angle factor"), "8");
    EXPECT_EQ(pattern.text("title"), "x");
}

TEST(Pattern, SlashesAreACommentOnlyAtTheBeginningOfALogicalLine) {
    EXPECT_EQ(axiom_of("  // axiom: G\naxiom: F//F //\n\t//\n"), "F//F //");
    EXPECT_EQ(axiom_of("axiom: F \\\n//+G\n"), "F   //+G");  // the logical line began before
    EXPECT_EQ(axiom_of("/* x */ // y\naxiom: F\n"), "F");
}

TEST(Pattern, LettersAfterLateSlashesAreWarnedOf) {
    const auto found = diagnostics_of("axiom: F // draws a line\n");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_TRUE(found[0].warning);
    EXPECT_EQ(found[0].where, (Place{1, 10}));
    EXPECT_TRUE(has(found[0].text(), "test.lsys:1:10: warning: "));
    EXPECT_TRUE(diagnostics_of("axiom: F // +F\n").empty());
    EXPECT_TRUE(diagnostics_of("axiom: F//F\n").empty());
    EXPECT_TRUE(diagnostics_of("title: F // draws\naxiom: F\n").empty());
}

TEST(Pattern, StarredCommentsStandAnywhere) {
    EXPECT_EQ(reference::derived_text("axiom: F/* one */F /* two\n three // \n*/G\nF --> /* four */ G\n"), "FFG");
    EXPECT_EQ(axiom_of("/**//***/axiom/* : */: F\n"), "F");
    EXPECT_EQ(axiom_of("// /* no comment begins here\naxiom: F\n// */\n"), "F");
    EXPECT_EQ(axiom_of("axiom: F*/G\n"), "F*/G");
    EXPECT_EQ(parsed("title: one /* two */ three\n").text("title").substr(0, 3), "one");
}

TEST(Pattern, AnUnterminatedCommentIsTheOnlyMistake) {
    const auto expected = std::vector<reference::Expected>{{{1, 10}, "no end"}};
    expect_mistakes("axiom: F /* oops\n", expected);
    expect_mistakes("axiom: F /* oops\n// a comment\n", expected);
    expect_mistakes("axiom: F /* oops\r\nF --> FF\r\n", expected);
    expect_mistakes("title: A /* oops\naxiom: F\n// a comment\n", expected);
}

TEST(Pattern, OnlyABlankAndABackslashContinueALine) {
    EXPECT_EQ(axiom_of("axiom: F \\\n  +F\n"), "F     +F");
    EXPECT_EQ(axiom_of("axiom: F\t\\\r\n+F\r\n"), "F\t   +F");
    EXPECT_EQ(axiom_of("axiom: F \\\n + \\\n G\n"), "F    +    G");
    EXPECT_EQ(axiom_of("axiom: F\\\nF --> G\n"), "F\\");
    EXPECT_EQ(axiom_of("axiom: F \\ G\n"), "F \\ G");
    EXPECT_EQ(axiom_of("axiom: F \\\\\n"), "F \\\\");
    const Pattern pattern = parsed("axiom: F\nF --> \\\nFF \\\n  + F\n");
    ASSERT_EQ(pattern.common.size(), 1u);
    expect_mistakes("axiom: F \\\n  +F \\\n (\n", {{{3, 2}, "parameters"}});  // places are of the file
}

TEST(Pattern, CarriageReturnsAndAByteOrderMarkAreRead) {
    EXPECT_EQ(axiom_of("\xEF\xBB\xBF"
                       "axiom: F\r\nF --> FF\r\n"),
              "F");
    EXPECT_EQ(axiom_of("axiom: F\r"), "F");
    expect_mistakes(
        "\xEF\xBB\xBF"
        "axiom: F)\r\nF --> (\r\n",
        {{{1, 9}, "')'"}, {{2, 7}, "'('"}});
    expect_mistakes("axiom: F\rG\n", {{{1, 9}, "control character"}});
}

TEST(Pattern, KeysMayStandAnywhereButOnce) {
    EXPECT_EQ(axiom_of("A --> B\ntable x:\nA --> C\naxiom: A\n"), "A");
    expect_mistakes("axiom: A\nAxiom : B\ntitle: x\nTITLE: y\n",
                    {{{2, 1}, "'axiom:' is given twice"}, {{4, 1}, "'title:' is given twice"}});
    expect_mistakes("axiom: A\ndefine x = 1\ndefine x = 2\n", {{{3, 8}, "'x' is defined twice"}});
    expect_mistakes("axiom: A\nschedule: t\ntable t:\ntable t:\n", {{{4, 7}, "the table 't' is defined twice"}});
    expect_mistakes("axiom: A\ninterpret:\nA --> F\ninterpret:\n", {{{4, 1}, "twice"}});
    expect_mistakes("axiom: A\nvariant v: axiom = B\nvariant v: axiom = C\n",
                    {{{3, 9}, "the variant 'v' is defined twice"}});
}

TEST(Pattern, UnknownKeysNameTheNearestKnown) {
    expect_mistakes("axiom: F\nangel factor: 4\nStrok: 1mm\nzzz: 1\n", {{{2, 1}, "did you mean 'angle factor'?"},
                                                                        {{3, 1}, "did you mean 'stroke'?"},
                                                                        {{4, 1}, "unknown key 'zzz'"}});
    expect_mistakes("axoim: F\n", {{{1, 1}, "did you mean 'axiom'?"}, {{1, 1}, "'axiom:' is missing"}});
    const std::string key = repeated("k", 100'000);
    const auto found = diagnostics_of("axiom: F\n" + key + ": 1\n");
    ASSERT_EQ(found.size(), 1u);
    EXPECT_LT(found[0].message.size(), 300u);
}

TEST(Pattern, LinesThatAreNothingAreToldSo) {
    expect_mistakes("axiom: F\nF - F+F\n", {{{2, 1}, "expected 'key: value'"}});
    expect_mistakes("axiom: F\n  F \xE2\x86\x92 F+F\n", {{{2, 5}, "write 'F --> F+F'"}});
    expect_mistakes("axiom: F\nF --> G --> H\n", {{{2, 9}, "a second '-->'"}});
    expect_mistakes("axiom: F\n --> H\n", {{{2, 2}, "expected a predecessor"}});
    expect_mistakes("axiom: F\nA < --> H\n", {{{2, 1}, "expected a predecessor"}});
    expect_mistakes("axiom: F\n: H\n", {{{2, 1}, "expected the name of a key"}});
    expect_mistakes("axiom: F\ntable : \n", {{{2, 1}, "expected the table's name"}});
    expect_mistakes("axiom: F\ntable t: x\n", {{{2, 10}, "lines after"}});
    expect_mistakes("axiom: F\ninterpret: x\n", {{{2, 12}, "lines after"}});
    expect_mistakes("axiom: F\nvariant : x = 1\n", {{{2, 1}, "expected the variant's name"}});
    expect_mistakes("axiom: F\nvariant v:\n", {{{2, 9}, "expected 'key = value'"}});
    expect_mistakes("axiom: F\nvariant v: x\n", {{{2, 12}, "expected 'key = value'"}});
    expect_mistakes("axiom: F\ndefine x 1\n", {{{2, 10}, "expected '='"}});
    expect_mistakes("axiom: F\ndefine x =\n", {{{2, 8}, "without a value"}});
    expect_mistakes("axiom: F\ndefine = 1\n", {{{2, 1}, "expected a name"}});
}

TEST(Pattern, AllMistakesAreToldAtOnceInTheOrderOfTheFile) {
    expect_mistakes(
        "derivation length: many\n"
        "axiom: F(\n"
        "stroke: 1\n"
        "colour: red\n"
        "F --> (G\n"
        "no line at all\n"
        "define a = 1 +\n"
        "angle factor: 0\n",
        {{{1, 20}, "whole number"},
         {{2, 9}, "not closed"},
         {{4, 1}, "unknown key 'colour'"},
         {{5, 7}, "'('"},
         {{6, 1}, "expected 'key: value'"},
         {{7, 15}, "expected a number"},
         {{8, 15}, "expected a whole number k"}});
}

TEST(Pattern, AnExceptionCarriesEveryMistake) {
    Diagnostics diagnostics;
    parse_pattern("koch.lsys", "F -> G\naxiom: F\n\tF - F\n", diagnostics);
    try {
        diagnostics.throw_if_errors();
        FAIL();
    } catch (const PatternError& error) {
        EXPECT_EQ(error.diagnostics().size(), 2u);
        const std::string text = error.what();
        EXPECT_EQ(text.find("koch.lsys:1:3: '->' is not the arrow"), 0u) << text;
        EXPECT_TRUE(has(text, "\nF -> G\n  ^\nkoch.lsys:3:2: "));
        EXPECT_TRUE(text.ends_with("\n F - F\n ^")) << text;  // a tab is shown as a blank
    }
    EXPECT_NO_THROW(Diagnostics().throw_if_errors());
}

TEST(Pattern, WarningsAreNoErrors) {
    Diagnostics diagnostics;
    parse_pattern("a", "axiom: F // draws\n", diagnostics);
    EXPECT_EQ(diagnostics.list().size(), 1u);
    EXPECT_FALSE(diagnostics.has_errors());
    EXPECT_NO_THROW(diagnostics.throw_if_errors());
}

TEST(Pattern, BeyondAHundredMistakesOnlyTheirNumberIsTold) {
    Diagnostics diagnostics;
    parse_pattern("a", repeated("F --> G --> H\n", 1000), diagnostics);
    EXPECT_LE(diagnostics.list().size(), 100u);
    try {
        diagnostics.throw_if_errors();
        FAIL();
    } catch (const PatternError& error) {
        const std::string text = error.what();
        const std::size_t shown = error.diagnostics().size();
        EXPECT_TRUE(has(text, std::to_string(1000 - shown) + " more errors")) << shown;
    }
}

TEST(Pattern, ColumnsCountCodePoints) {
    expect_mistakes("axiom: \xCE\xB1\xCE\xB2\xF0\x9F\x8C\xBF)\n", {{{1, 11}, "')'"}});
    expect_mistakes("\xE0\xB9\x82: 1\naxiom: F\xC3\xA9 (\n", {{{1, 1}, "unknown key"}, {{2, 11}, "parameters"}});
}

TEST(Pattern, TheCaretStandsUnderItsColumn) {
    for (const char* mark : {"", "\xEF\xBB\xBF"}) {
        for (const char* line : {"axiom: F)", "axiom:\tF  F)", "axiom: \xCE\xB1\xE2\x82\xAC)"}) {
            const auto found = diagnostics_of(std::string(mark) + line + "\r\n");
            ASSERT_EQ(found.size(), 1u);
            const std::string& excerpt = found[0].excerpt;
            const std::size_t newline = excerpt.find('\n');
            ASSERT_NE(newline, std::string::npos);
            EXPECT_EQ(reference::code_points(excerpt.substr(0, newline)), reference::code_points(line)) << excerpt;
            EXPECT_EQ(excerpt.size() - newline - 1, static_cast<std::size_t>(found[0].where.column)) << excerpt;
        }
    }
}

TEST(Pattern, ExcerptsAreShortValidTextAroundThePlace) {
    for (const std::size_t before : {0, 1, 49, 50, 51, 78, 79, 80, 81, 1000}) {
        for (const std::size_t after : {0, 1, 29, 30, 31, 100}) {
            for (const char* letter : {"F", "\xCE\xB1", "\xE2\x82\xAC", "\xF0\x9F\x8C\xBF", "\x7F"}) {
                const std::string text = "axiom:" + repeated(letter, before) + ")" + repeated(letter, after);
                const auto found = diagnostics_of(text);
                ASSERT_GE(found.size(), 1u);
                const Diagnostic& diagnostic = found.front();
                EXPECT_TRUE(reference::is_utf8(diagnostic.text()));
                const std::size_t newline = diagnostic.excerpt.find('\n');
                const std::string line = diagnostic.excerpt.substr(0, newline);
                EXPECT_LE(reference::code_points(line), 80u);
                const std::size_t caret = diagnostic.excerpt.size() - newline - 2;
                EXPECT_LT(caret, 80u);
                std::size_t at = 0;  // of the code point above the caret
                for (std::size_t i = 0; i <= caret; ++at) i += (line[at] & 0xC0) != 0x80 ? 1 : 0;
                if (*letter != '\x7F') {
                    EXPECT_EQ(line[at - 1], ')') << diagnostic.excerpt;
                }
            }
        }
    }
}

TEST(Pattern, BytesThatAreNoTextAreRefusedAtTheirPlace) {
    using namespace std::string_literals;
    expect_mistakes("axiom: F\nF --> \0F\nx\n"s, {{{2, 7}, "NUL"}});
    expect_mistakes("\0"s, {{{1, 1}, "NUL"}});
    for (const char* bad :
         {"\x80", "\xBF", "\xC0\x80", "\xC1\xBF", "\xC3", "\xC3(", "\xE0\x80\x80", "\xE0\x9F\xBF", "\xE2\x82",
          "\xE2\x82(", "\xED\xA0\x80", "\xED\xBF\xBF", "\xF0\x80\x80\x80", "\xF0\x8F\xBF\xBF", "\xF0\x9F\x8C",
          "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xFE", "\xFF\xBF\xBF\xBF"}) {
        for (const char* after : {"", "F", "\n"}) {
            const std::string text = "axiom: \xCE\xB1" + std::string(bad) + after;
            const auto found = diagnostics_of(text);
            ASSERT_EQ(found.size(), 1u);
            EXPECT_EQ(found[0].where, (Place{1, 9})) << found[0].text();
            EXPECT_TRUE(has(found[0].message, "UTF-8"));
            EXPECT_TRUE(reference::is_utf8(found[0].text()));
        }
    }
    for (const char* good : {"\xC2\xA1", "\xDF\xBF", "\xE0\xA0\x80", "\xED\x9F\xBF", "\xEE\x80\x80",
                             "\xF0\x90\x80\x80", "\xF4\x8F\xBF\xBF"}) {
        EXPECT_TRUE(diagnostics_of("axiom: " + std::string(good) + "\n").empty()) << good;
    }
}

TEST(Pattern, FilesOver64MegabytesAreRefusedAtThatByte) {
    constexpr std::size_t most = std::size_t{64} << 20;
    const std::string head = "axiom: F\n// ";
    const auto begin = std::chrono::steady_clock::now();
    Diagnostics fits;
    parse_pattern("a", head + std::string(most - head.size(), 'x'), fits);
    EXPECT_TRUE(fits.list().empty());
    Diagnostics large;
    parse_pattern("a", head + std::string(most - head.size() + 1, 'x'), large);
    ASSERT_EQ(large.list().size(), 1u);
    EXPECT_EQ(large.list()[0].where, (Place{2, static_cast<int>(most) - 9 + 1}));
    EXPECT_TRUE(has(large.list()[0].message, "64 MB"));
    EXPECT_TRUE(large.is_unreadable());
    EXPECT_LT(large.list()[0].text().size(), 300u);
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(10));
}

TEST(Pattern, NestingBeyondAMillionIsRefusedAtThatByte) {
    constexpr std::size_t most = std::size_t{1} << 20;
    const auto nested = [](std::size_t depth) {
        return "axiom: F(" + repeated("(", depth - 1) + "1" + repeated(")", depth) + "\n";
    };
    EXPECT_TRUE(diagnostics_of(nested(most)).empty());
    expect_mistakes(nested(most + 1), {{{1, static_cast<int>(8 + most + 1)}, "nest deeper than 1,048,576"}});
}

TEST(Pattern, EmptyAndBlankFilesLackAnAxiom) {
    for (const char* text : {"", "\n", "\r\n\r\n", "  \n\t", "// nothing\n", "/* nothing */", "\xEF\xBB\xBF"}) {
        expect_mistakes(text, {{{1, 1}, "'axiom:' is missing"}});
    }
    expect_mistakes("axiom:\n", {{{1, 1}, "axiom is empty"}});
}

// --- overrides -----------------------------------------------------------------------------------------------------

Pattern overridden(const std::string& text, std::string_view variant, const std::vector<Setting>& settings) {
    Diagnostics diagnostics;
    Pattern pattern = parse_pattern("test.lsys", text, diagnostics);
    apply_overrides(pattern, variant, settings, diagnostics);
    for (const Diagnostic& diagnostic : diagnostics.list()) ADD_FAILURE() << diagnostic.text();
    return pattern;
}

TEST(Overrides, FileThenVariantThenSettings) {
    const std::string text =
        "axiom: F\n"
        "Derivation length: 3\n"
        "define r = 1\n"
        "variant v: r = 2, derivation length = 4, axiom = F,F , heading = 0\n";
    const Pattern plain = overridden(text, "", {});
    EXPECT_EQ(plain.text("derivation length"), "3");
    EXPECT_EQ(plain.find("heading"), nullptr);
    const Pattern varied = overridden(text, "v", {});
    EXPECT_EQ(varied.text("derivation length"), "4");
    EXPECT_EQ(varied.text("axiom"), "F,F");  // a comma may be a symbol
    EXPECT_EQ(varied.text("heading"), "0");
    EXPECT_EQ(varied.defines[0].value.view(), "2");
    const Pattern set = overridden(text, "v", {{"--set", "derivation  LENGTH", "5"}, {"--set", "r", "3"}});
    EXPECT_EQ(set.text("derivation length"), "5");
    EXPECT_EQ(set.defines[0].value.view(), "3");
    const Pattern last =
        overridden(text, "v", {{"--set", "derivation length", "5"}, {"-n", "derivation length", "6"}});
    EXPECT_EQ(last.text("derivation length"), "6");
}

TEST(Overrides, OfTwoKeysThatExcludeEachOtherTheLaterWins) {
    const std::string text = "axiom: F\nangle factor: 6\nignore: +\n";
    const Pattern set = overridden(text, "", {{"--set", "angle increment", "30"}, {"--set", "consider", "F"}});
    EXPECT_EQ(set.find("angle factor"), nullptr);
    EXPECT_EQ(set.text("angle increment"), "30");
    EXPECT_EQ(set.find("ignore"), nullptr);
    EXPECT_EQ(set.text("consider"), "F");
}

TEST(Overrides, MistakesPointIntoTheSetting) {
    const auto found = diagnostics_of("axiom: F\n", {Setting::assignment("--set", "derivation length", "-1")});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].file, "--set");
    EXPECT_EQ(found[0].where, (Place{1, 19}));
    EXPECT_EQ(found[0].excerpt, "derivation length=-1\n                  ^");
    expect_mistakes("axiom: F\n", {{{1, 1}, "did you mean 'axiom'?"}}, {Setting::assignment("--set", "axim", "G")});
    expect_mistakes("axiom: F\n", {{{1, 1}, "one line of valid UTF-8"}},
                    {Setting::assignment("--set", "axiom", "G\nH")});
    expect_mistakes("axiom: F\n", {{{1, 1}, "expected key=value"}}, {Setting::assignment("--set", " ", "G")});
    // A key is its own origin, also one whose name ends in `set`.
    const auto own = diagnostics_of("axiom: F\n", {Setting("offset", "3")});
    ASSERT_EQ(own.size(), 1u);
    EXPECT_EQ(own[0].file, "offset 3");
    EXPECT_EQ(own[0].where.line, 0);
    expect_mistakes("axiom: F\n", {{{0, 0}, "no variants"}}, {}, "v");
    expect_mistakes("axiom: F\nvariant a: axiom = G\nvariant b: axiom = H\n", {{{0, 0}, "the pattern has a, b"}}, {},
                    "v");
}

TEST(Overrides, CommentsInSettingsEnd) {
    const std::string text = "axiom: F\ndefine r = 1\n";
    expect_mistakes(text, {{{1, 8}, "this comment has no end: expected '*/'"}},
                    {Setting::assignment("--set", "axiom", "F/* and more")});
    expect_mistakes(text, {{{1, 3}, "this comment has no end"}}, {Setting::assignment("--set", "r", "/*")});
    expect_mistakes(text, {{{1, 2}, "this comment has no end"}}, {Setting::assignment("--set", "r/*", "2")});
    EXPECT_EQ(reference::derived_text(
                  reference::grammar_of(text, {Setting::assignment("--set", "axiom", "F/* not this */G")})),
              "FG");
    // What looks like the comment of a line is a value here.
    EXPECT_EQ(reference::derived_text(reference::grammar_of(text, {Setting::assignment("--set", "axiom", "//F")})),
              "//F");
    EXPECT_EQ(reference::derived_text(reference::grammar_of(text, {Setting::assignment("--set", "axiom", " // F")})),
              "//F");
}

TEST(Nearest, IsTheOneMeantOrNone) {
    EXPECT_EQ(nearest("axoim", {"axiom", "turn"}), "axiom");
    EXPECT_EQ(nearest("turm", {"axiom", "turn"}), "turn");
    EXPECT_EQ(nearest("colour", {"axiom", "turn"}), "");
    EXPECT_EQ(nearest("", {"axiom"}), "");
    EXPECT_EQ(nearest(repeated("a", 1000), {"axiom"}), "");
}

TEST(ReadNumber, TakesTheWholeFieldOrNothing) {
    double value = 0;
    for (const auto& [text, expected] :
         {std::pair{"0", 0.0}, {"25.7", 25.7}, {"-3", -3.0}, {"+4", 4.0}, {"1e2", 100.0}, {".5", 0.5}, {"5.", 5.0}}) {
        EXPECT_TRUE(read_number(text, value)) << text;
        EXPECT_EQ(value, expected) << text;
    }
    for (const char* text : {"", "+", "-", ".", "3/2", "1 2", " 1", "1 ", "1,5", "0x10", "inf", "-inf", "nan",
                             "1e400", "+-5", "++5", "1e", "2abc"}) {
        EXPECT_FALSE(read_number(text, value)) << text;
    }
}

}  // namespace sikku::pattern_test
