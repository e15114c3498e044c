// tests/program/first_contact_test.cpp: input from newcomers: systems of other programs, prose, systems in F and
// G.
#include "engine/language/document.h"
#include "tests/program.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace sikku::first_contact_test {

const char* const koch = "Koch {\n  Angle 6\n  Axiom F--F--F\n  F=F+F--F+F\n}\n";

std::size_t lines_of(const std::string& text) {
    return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

TEST(FirstContact, EveryCommandNamesTheImportOfAForeignFile) {
    const ScratchFolder folder;
    const std::string fractint = folder.write("my koch.l", koch);
    const std::string cpfg =
        folder.write("plant.l", "Lsystem: 1\nderivation length: 1\nAxiom: F\nF --> F[+F]F\nendlsystem\n");
    const std::vector<std::vector<std::string>> commands = {
        {"draw", "-o", folder.file("x.svg")}, {"play", "-o", folder.file("x.mid")}, {"measure"}, {"derive"}};
    for (std::vector<std::string> command : commands) {
        command.insert(command.begin() + 1, fractint);
        const Outcome outcome = run(command);
        EXPECT_EQ(outcome.status, 2);
        EXPECT_EQ(lines_of(outcome.errors), 1U) << outcome.errors;
        EXPECT_TRUE(
            has(outcome.errors, "this is a Fractint collection of L-systems, not a pattern; `sikku import '"));
        EXPECT_TRUE(has(outcome.errors, "my koch.l' -o 'my koch'` makes patterns of its entries"));
        command[1] = cpfg;
        EXPECT_TRUE(has(run(command).errors, "plant.l -o plant.lsys` makes a pattern of it"));
    }
    // The named command makes patterns.
    EXPECT_EQ(run({"import", fractint, "-o", folder.file("made")}).status, 0);
    EXPECT_EQ(run({"measure", folder.file("made/koch.lsys"), "-n", "1"}).status, 0);
    // Other files are still checked.
    const Outcome checked = run({"check", fractint, "snake-kolam", cpfg});
    EXPECT_EQ(checked.status, 2);
    EXPECT_EQ(lines_of(checked.output), 2U) << checked.output;
    const Outcome piped = run({"measure", "-"}, {.input = koch});
    EXPECT_TRUE(has(piped.errors, "`sikku import - -o imported`"));
    // An import never writes over the file it reads.
    const std::string named = folder.write("plant.lsys", "Lsystem: 1\nAxiom: F\nendlsystem\n");
    EXPECT_TRUE(has(run({"draw", named, "-o", folder.file("x.svg")}).errors, "plant-imported.lsys"));
}

TEST(FirstContact, OtherProgramsFilesAreNamed) {
    const ScratchFolder folder;
    const std::string lpfg =
        folder.write("a.l", "#include <lpfgall.h>\nmodule I(float);\nAxiom: I(1);\nI(x) : { produce I(x/2); }\n");
    for (const std::vector<std::string>& command :
         {std::vector<std::string>{"import", lpfg}, {"import", lpfg, "-o", folder.file("out")}}) {
        const Outcome outcome = run(command);
        EXPECT_EQ(outcome.status, 2);
        EXPECT_EQ(lines_of(outcome.errors), 1U) << outcome.errors;
        EXPECT_TRUE(
            has(outcome.errors, "this is an L+C file of lpfg, which is C++; only files of cpfg and Fractint"));
    }
    EXPECT_TRUE(has(run({"check", lpfg}).output, "this is an L+C file of lpfg, which is C++, not a pattern\n"));
}

TEST(FirstContact, ProseIsReportedInOneMessage) {
    const ScratchFolder folder;
    std::string prose = "# A program\n\nIt makes pictures, and it sounds.\n";
    for (int i = 0; i < 100; ++i) prose += "- A list of features: many of them.\nAnd a paragraph.\n";
    const std::string plain = folder.write("README.md", prose);
    const std::string with_code = folder.write("MORE.md", prose + "\n    axiom: F\n    F --> F+F\n");
    for (const std::string& file : {plain, with_code}) {
        const Outcome drawn = run({"draw", file, "-o", folder.file("x.svg")});
        EXPECT_EQ(drawn.status, 2);
        EXPECT_TRUE(has(drawn.errors, "this text is not a pattern"));
        EXPECT_EQ(lines_of(drawn.errors), 3U) << drawn.errors;  // with its place
        const Outcome read = run({"kolam", "--read", file});
        EXPECT_EQ(read.status, 1);
        EXPECT_EQ(lines_of(read.errors), 1U) << read.errors;
        EXPECT_TRUE(has(read.errors, "unknown format; expected a photograph"));
    }
    std::string wrong = "axiom: F\n";
    for (int i = 0; i < 200; ++i) wrong += "F --> G --> H\n";
    EXPECT_TRUE(has(run({"check", folder.write("wrong.lsys", wrong)}).output, "the first 50 errors are shown\n"));
}

TEST(FirstContact, LettersThatDrawNothingAreNamedEverywhere) {
    const ScratchFolder folder;
    const std::string dragon =
        folder.write("dragon.lsys", "axiom: F\nangle increment: 90\nderivation length: 10\nF --> F+G\nG --> F-G\n");
    const std::string warning = "dragon.lsys:5:1: warning: 'G' draws nothing; 'forward: F G' makes it a step";
    const Outcome checked = run({"check", dragon});
    EXPECT_EQ(checked.status, 0);
    EXPECT_TRUE(has(checked.output, warning));
    const Outcome drawn = run({"draw", dragon, "-o", folder.file("x.svg")});
    EXPECT_EQ(drawn.status, 0);
    EXPECT_TRUE(has(drawn.errors, warning));
    EXPECT_EQ(run({"measure", dragon, "--set", "forward=F G"}).errors, "");
    const std::string arrowhead = folder.write(
        "arrowhead.lsys", "axiom: A\nangle increment: 60\nderivation length: 4\nA --> B-A-B\nB --> A+B+A\n");
    const Outcome nothing = run({"draw", arrowhead, "-o", folder.file("x.svg")});
    EXPECT_EQ(nothing.status, 1);
    EXPECT_TRUE(has(nothing.errors,
                    "nothing to draw: the word contains no visible line, polygon, disc or label; 'forward: A B' "
                    "makes A and B steps\n"));
}

TEST(FirstContact, AnImportThatDrawsNothingIsReportedLast) {
    const ScratchFolder folder;
    const std::string file = folder.write(
        "plant.l", "Lsystem: 1\nderivation length: 2\nAxiom: A(1)\nA(x) : {x = f(x);} 1 --> F(x)A(x)\nendlsystem\n");
    const Outcome outcome = run({"import", file, "-o", folder.file("plant.lsys")});
    EXPECT_EQ(outcome.status, 0);
    const std::string with_losses =
        "sikku: warning: the pattern draws nothing at its derivation length; what is not supported may be the "
        "cause\n";
    EXPECT_TRUE(outcome.errors.ends_with(with_losses)) << outcome.errors;
    EXPECT_TRUE(has(run({"import", file, "--list"}).output, "draws nothing"));
    EXPECT_TRUE(
        has(run({"import", file, "-o", folder.file("out")}).errors, "1 of them incomplete; 1 draws nothing\n"));
    // A production that draws is left, but its condition is never fulfilled without the one that is lost.
    const std::string lost = folder.write(
        "lost.l",
        "Lsystem: 1\nderivation length: 3\nAxiom: A(4)\nA(n) : n>1 {m=floor(n*bran(5,16)); k=n-m-1;} --> "
        "F(n)[+A(m)][-A(k)]\nA(n) : n==1 --> F(1)\nendlsystem\n");
    EXPECT_TRUE(run({"import", lost, "-o", folder.file("lost.lsys")}).errors.ends_with(with_losses));
    EXPECT_EQ(run({"draw", folder.file("lost.lsys"), "-o", folder.file("x.svg")}).status, 1);
    // Without losses: too few steps, a context that never matches.
    for (const char* rules : {"A --> B\nB --> C\nC --> D\nD --> F\n", "B < A --> F\n", "A --> f\n"}) {
        const std::string whole = folder.write(
            "whole.l", "Lsystem: 1\nderivation length: 3\nAxiom: A\n" + std::string(rules) + "endlsystem\n");
        EXPECT_EQ(run({"import", whole, "-o", folder.file("whole.lsys")}).errors,
                  "sikku: warning: the pattern draws nothing at its derivation length\n");
        EXPECT_EQ(run({"draw", folder.file("whole.lsys"), "-o", folder.file("x.svg")}).status, 1);
    }
    const std::string good =
        folder.write("good.l",
                     "Lsystem: 1\nderivation length: 3\nAxiom: A(3)\nA(n) : n>1 --> A(n-1)\nA(n) : n==1 --> F(1)\n"
                     "endlsystem\n");
    EXPECT_EQ(run({"import", good, "-o", folder.file("good.lsys")}).errors, "");
    EXPECT_EQ(run({"draw", folder.file("good.lsys"), "-q", "-o", folder.file("x.svg")}).status, 0);
}

TEST(FirstContact, MovesAreNamedWhereNothingDraws) {
    const ScratchFolder folder;
    const std::string file = folder.write(
        "moves.lsys", "axiom: +X\nderivation length: 4\nangle increment: 25\nX --> f-[X]+fX\nf --> ff\n");
    const std::string hint = "'f' moves without drawing; 'forward: f' makes it a step, F draws\n";
    EXPECT_TRUE(has(run({"check", file}).output, "moves.lsys:5:1: warning: " + hint));
    EXPECT_TRUE(run({"draw", file, "-o", folder.file("x.svg")}).errors.ends_with("disc or label; " + hint));
    EXPECT_TRUE(has(run({"measure", file}).errors, hint));
    EXPECT_EQ(run({"draw", file, "--set", "forward=f", "-o", folder.file("x.svg")}).status, 0);
}

TEST(FirstContact, DocumentsAreNotPatterns) {
    const std::filesystem::path root = SIKKU_SOURCE_DIR;
    const ScratchFolder folder;
    const Outcome drawn = run({"draw", (root / "README.md").string(), "-o", folder.file("x.svg")});
    EXPECT_EQ(drawn.status, 2);
    EXPECT_TRUE(has(drawn.errors, "this text is not a pattern"));
    EXPECT_EQ(lines_of(drawn.errors), 3U) << drawn.errors;  // with its place
    EXPECT_EQ(run({"check", (root / "docs/claims.md").string()}).status, 2);
    for (const auto& entry : std::filesystem::directory_iterator(root / "docs")) {
        if (entry.path().extension() != ".md") continue;
        EXPECT_THROW(load(entry.path().string()), PatternError) << entry.path();
    }
}

TEST(FirstContact, CollectionsWithoutSystemsAreMeasuredToo) {
    const std::string python = "/usr/bin/python3";
    if (!std::filesystem::exists(python)) GTEST_SKIP() << "needs python3";
    const ScratchFolder folder;
    std::filesystem::create_directories(folder / "collection");
    folder.write("collection/empty.l", "; nothing but a remark\n");
    folder.write("collection/koch.l", koch);
    folder.write("collection/wrong.l", "Wrong {\n  Angle 6\n  F=F+F\n}\n");
    const std::string tool = std::string(SIKKU_SOURCE_DIR) + "/tests/full/collection.py";
    const Outcome outcome = run({tool, SIKKU_PROGRAM, folder.file("collection"), "1", "2"}, {.program = python});
    EXPECT_EQ(outcome.output, "2 measured, 0 differ, 1 entries refused: wrong.l Wrong\n") << outcome.errors;
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
}

TEST(FirstContact, ManyFilesAreWrittenTogether) {
    const ScratchFolder folder;
    std::string many;
    for (int i = 0; i < 300; ++i) many += "Koch" + std::to_string(i) + std::string(koch).substr(4);
    const std::string file = folder.write("many.l", many);
    EXPECT_EQ(run({"import", file, "-o", folder.file("out")}).status, 0);
    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "out")) {
        EXPECT_EQ(entry.path().extension(), ".lsys") << entry.path();
        ++files;
    }
    EXPECT_EQ(files, 300U);
    // All or none: one of the targets is a folder.
    std::filesystem::create_directories(folder / "blocked/koch299.lsys");
    EXPECT_EQ(run({"import", file, "-o", folder.file("blocked")}).status, 1);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "blocked"), {}), 1);
}

}  // namespace sikku::first_contact_test
