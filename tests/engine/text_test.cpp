// tests/engine/text_test.cpp: untrusted texts in messages, tables and patterns.
#include "engine/base/text.h"
#include "engine/base/diagnostic.h"
#include "engine/base/keys.h"
#include "engine/language/pattern.h"
#include "tests/checks.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sikku::text_test {

const std::vector<std::string> hostile = {"Lotus\nstroke: none\n//",
                                          "a\r\nborder: /etc/passwd\r\n",
                                          "/* open",
                                          "a /",
                                          "ends in a backslash \\",
                                          "ends in many \\\\\\ ",
                                          "\u2028stroke: none\u2029axiom: X",
                                          "// \\",
                                          "*/ F --> FF /*",
                                          "\x1b[31m\u202E\u0085\x07",
                                          std::string(3, '\0') + "axiom: X",
                                          "\xff\xfe",
                                          "a  \t b\v\fc",
                                          ""};

TEST(Text, PrintableIsOneLine) {
    EXPECT_EQ(printable("Lotus\nstroke: none"), "Lotus stroke: none");
    EXPECT_EQ(printable("a\r\nb\u2028c\u2029d"), "a  b c d");
    EXPECT_EQ(printable("tab\tbell\x07"), "tab?bell?");
    EXPECT_FALSE(has(printable(std::string(300, '\n'), 10), "\n"));
    for (const std::string& text : hostile) {
        const std::string line = printable(text, 1000);
        EXPECT_EQ(line.find_first_of("\n\r\x1b"), std::string::npos) << line;
        EXPECT_FALSE(has(line, "\u2028"));
    }
}

TEST(Text, LinesAndWordsAreTakenFromTheFront) {
    std::string_view text = "a b\r\n\n c";
    EXPECT_EQ(take_line(text), "a b\r");
    EXPECT_EQ(take_line(text), "");
    EXPECT_EQ(take_line(text), " c");
    EXPECT_EQ(take_line(text), "");
    EXPECT_TRUE(text.empty());
    std::string_view words = "\t ab  c ";
    EXPECT_EQ(take_word(words), "ab");
    EXPECT_EQ(words, "  c ");
    EXPECT_EQ(take_word(words), "c");
    EXPECT_EQ(take_word(words), "");
    EXPECT_TRUE(words.empty());
    EXPECT_EQ(split_words(",a,b c,,", ","), (std::vector<std::string_view>{"a", "b c"}));
    EXPECT_TRUE(split_words("").empty());
}

TEST(Text, FurtherLinesOfMessagesAreIndented) {
    EXPECT_EQ(printable_lines("a.lsys: wrong\nF --> F\n    ^"), "a.lsys: wrong\n  F --> F\n    ^");
    EXPECT_EQ(printable_lines("x\nsikku: done\rsikku: done"), "x\n  sikku: done sikku: done");
    EXPECT_EQ(printable_lines("one line"), "one line");
}

/// For any text, the rest of the pattern is unchanged, and its title is one line.
TEST(Text, NoTitleSetsAKeyOfAPattern) {
    for (const std::string& text : hostile) {
        SCOPED_TRACE(testing::PrintToString(text));
        const std::string line = pattern_line(text);
        const std::string title = line.empty() ? "" : "title: " + line + "\n";
        const std::string pattern = title + "// " + line + "\naxiom: F\nangle factor: 4\nF --> F+F\n";
        Diagnostics diagnostics;
        const Pattern parsed = parse_pattern("x.lsys", pattern, diagnostics);
        EXPECT_FALSE(diagnostics.has_errors()) << diagnostics.sorted().front().text();
        EXPECT_EQ(parsed.keys.size(), line.empty() ? 2U : 3U);
        EXPECT_EQ(parsed.common.size(), 1U);
        EXPECT_EQ(parsed.text("title"), line);
    }
    EXPECT_EQ(pattern_line("Lotus // of  *three* /* rings"), "Lotus // of *three* / * rings");
    EXPECT_EQ(pattern_line("தாமரை – a lotus"), "தாமரை – a lotus");
}

TEST(Text, KeysSayWhichValuesNameFiles) {
    const auto names_file = [](std::string_view key, std::string_view value) {
        const KeyInfo* row = find_language_key(key);
        return row && row->names_file && row->names_file(value);
    };
    for (const auto& [key, value] : {std::pair("border", "mine.lsys"),
                                     {"border", "kaavi,../x.LSYS"},
                                     {"scale", "/etc/x.scl"},
                                     {"keyboard", "x.kbm"},
                                     {"surface", "leaf = leaf.s"}}) {
        EXPECT_TRUE(names_file(key, value)) << key << ' ' << value;
    }
    for (const auto& [key, value] : {std::pair("border", "kaavi"),
                                     {"border", "none"},
                                     {"border", "snake-kolam"},
                                     {"scale", "dorian"},
                                     {"keyboard", "none"},
                                     {"stroke", "a.lsys"}}) {
        EXPECT_FALSE(names_file(key, value)) << key << ' ' << value;
    }
    // They include all keys whose help mentions files.
    for (const KeyInfo& row : language_keys()) {
        const bool speaks_of_files = row.values.find("FILE") != std::string_view::npos ||
                                     row.values.find(" file") != std::string_view::npos ||
                                     row.values.find("key map") != std::string_view::npos;
        EXPECT_EQ(speaks_of_files, row.names_file != nullptr) << row.name;
    }
}

}  // namespace sikku::text_test
