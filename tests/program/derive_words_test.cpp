// tests/program/derive_words_test.cpp: `sikku derive` with words of several steps, and trees.
#include "tests/files.h"
#include "tests/program.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

namespace sikku::derive_words_test {

TEST(DeriveWords, PrintsFigure13) {
    const Outcome outcome = run({"derive", "fibonacci-words", "--generations", "0:5"});
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_EQ(outcome.output,
              "0       b\n"
              "1       a\n"
              "2     a     b\n"
              "3   a   b   a\n"
              "4  a  b a  a  b\n"
              "5  ab a ab ab a\n");
}

TEST(DeriveWords, TheExtensionSelectsTheFormat) {
    const ScratchFolder folder;
    const std::vector<std::pair<std::string, std::string>> files = {
        {"words.txt", "0 "}, {"words.md", "```text"}, {"words.tex", "\\begin{tabular}"}, {"words.svg", "<svg"}};
    for (const auto& [name, part] : files) {
        const Outcome outcome =
            run({"derive", "anabaena", "--generations", "0:3", "-o", name}, {.folder = folder.path()});
        EXPECT_EQ(outcome.status, 0) << outcome.errors;
        EXPECT_TRUE(has(contents(folder.path() / name), part)) << name;
    }
    const Outcome tree = run({"derive", "anabaena", "--tree", "-o", "tree.svg"}, {.folder = folder.path()});
    EXPECT_EQ(tree.status, 0) << tree.errors;
    // The file contains its pattern.
    for (const char* name : {"words.svg", "tree.svg"}) {
        const Outcome shown = run({"show", name}, {.folder = folder.path()});
        EXPECT_EQ(shown.status, 0) << shown.errors;
        EXPECT_TRUE(has(shown.output, "ar --> al br")) << name;
    }
    const Outcome same = run({"derive", "anabaena", "--tree"});
    EXPECT_EQ(same.output, contents(folder.path() / "tree.svg"));
}

struct Refused {
    std::vector<std::string> arguments;
    int status;
    std::string message;
};

TEST(DeriveWords, RefusesWithAReason) {
    const std::vector<Refused> cases = {
        {{"--generations", "5:2"}, 2, "the lower number of steps first"},
        {{"--generations", "-1:2"}, 2, "expected two numbers of steps"},
        {{"--generations", "0:"}, 2, "expected two numbers of steps"},
        {{"--generations", ""}, 2, "expected two numbers of steps"},
        {{"--generations", "0:2", "-o", ""}, 2, "-o: expected the name of a file"},
        {{"--generations", "0:2", "--format", ""}, 2, "--format: expected text"},
        {{"--generations", "0:x"}, 2, "expected two numbers of steps"},
        {{"--generations", "0:99999999999999999999999"}, 2, "expected up to 1000000 steps"},
        {{"--generations", "0:2000"}, 2, "expected up to 1000 words"},
        {{"--generations", "0:60"}, 1, "; --generations 0:6 fits"},
        {{"--generations", "900000:900001"}, 1, "symbols"},
        {{"--generations", "0:5", "-n", "3"}, 2, "cannot be combined with a derivation length"},
        {{"--generations", "0:5", "--format", "pdf"}, 2, "expected text, markdown, latex or svg"},
        {{"--generations", "0:5"}, 1, "--wrap 100"},
        {{"--generations", "0:4", "--format", "latex"}, 1, "columns"},
        {{"--tree", "--format", "text"}, 2, "a tree is written as SVG"},
        {{"--tree", "-n", "30"}, 1, "a tree has at most 2000"},
        {{"--format", "text"}, 2, "needs --generations or --tree"},
        {{"--wrap", "80"}, 2, "needs --generations or --tree"},
        {{"--generations", "0:1", "-o", "words.pdf"}, 2, "unknown extension"}};
    for (const Refused& refused : cases) {
        std::vector<std::string> arguments = {"derive", "koch-curve"};
        arguments.insert(arguments.end(), refused.arguments.begin(), refused.arguments.end());
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, refused.status) << refused.message << '\n' << outcome.errors;
        EXPECT_TRUE(has(outcome.errors, refused.message));
        EXPECT_LT(outcome.seconds, 5);
    }
    const Outcome map = run({"derive", "moss-leaf", "--generations", "0:2"});
    EXPECT_EQ(map.status, 2);
    EXPECT_TRUE(has(map.errors, "a map has no words"));
}

/// The words of steps 0 to n have (n + 1)(n + 2)/2 symbols.
TEST(DeriveWords, FindsTheStepsThatFit) {
    const ScratchFolder folder;
    std::ofstream(folder.path() / "line.lsys") << "axiom: A\nA --> AB\n";
    const Outcome outcome = run({"derive", "line.lsys", "--generations", "0:999"}, {.folder = folder.path()});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(has(outcome.errors, "; --generations 0:198 fits")) << outcome.errors;
    EXPECT_LT(outcome.seconds, 5);
}

}  // namespace sikku::derive_words_test
