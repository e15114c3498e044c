// tests/engine/import_cpfg_statements_test.cpp: conditions, local variables and decompositions of cpfg files.
#include "engine/import/import.h"

#include "tests/import_tools.h"

#include <gtest/gtest.h>

#include <string>

namespace sikku::import_cpfg_statements_test {

using namespace import_tools;

std::string system_with(const std::string& rules, const std::string& axiom = "A(1)", int steps = 1) {
    return "Lsystem: 1\nderivation length: " + std::to_string(steps) + "\nAxiom: " + axiom + "\n" + rules +
           "endlsystem\n";
}

std::string all_losses(const ImportedSystem& system) {
    std::string text;
    for (const std::string& loss : system.losses) text += loss + '\n';
    return text;
}

TEST(ImportCpfgLines, WidthsMayBeginAContinuedLine) {
    const ImportedSystem system = cpfg(system_with("A --> F(1)\n\t#(0.1) F(2)\n\t# F(3)\n\t#F\n", "A"));
    EXPECT_EQ(word_of(system.pattern), "F(1)#(0.1)F(2)#F(3)#F");
    EXPECT_TRUE(system.losses.empty());
    // Directives may be indented, too.
    EXPECT_EQ(word_of(cpfg(system_with("A --> F\n\t#if 0\n\tG\n\t#endif\n", "A")).pattern), "F");
    Diagnostics diagnostics;
    import_cpfg(source_of(system_with("#(2) --> F\n", "A")), nullptr, diagnostics);
    EXPECT_TRUE(has(all_of(diagnostics), "unknown preprocessor directive"));
}

TEST(ImportCpfgLines, ConditionsAreExpressions) {
    const auto chosen = [](const std::string& condition) {
        const std::string text = "#define KIND 2\n#define BIG (KIND+1)\n#if " + condition +
                                 "\n#define L F\n#else\n#define L G\n#endif\n" + system_with("A --> L\n", "A");
        return word_of(cpfg(text).pattern);
    };
    for (const char* yes :
         {"KIND == 2", "KIND>1 && KIND <3", "!(KIND == 1)", "defined(KIND)", "defined KIND && !defined OTHER",
          "BIG*2 == 6", "OTHER == 0", "KIND", "(KIND - 2) || 1", "KIND != 1"}) {
        EXPECT_EQ(chosen(yes), "F") << yes;
    }
    for (const char* no : {"KIND == 1", "KIND > 2", "!defined(KIND)", "OTHER", "KIND - 2", "0"}) {
        EXPECT_EQ(chosen(no), "G") << no;
    }
    const auto branch = [](int kind) {
        return word_of(cpfg("#define KIND " + std::to_string(kind) +
                            "\n#if KIND == 1\n#define L F\n#elif KIND == 2\n#define L G\n"
                            "#elif KIND < 4\n#define L f\n#else\n#define L g\n#endif\n" +
                            system_with("A --> L\n", "A"))
                           .pattern);
    };
    EXPECT_EQ(branch(1) + branch(2) + branch(3) + branch(4), "FGfg");
}

TEST(ImportCpfgStatements, LocalVariablesAreReplaced) {
    const ImportedSystem system =
        cpfg(system_with("A(t) : {x=t/2;} x>0 {y=x+1; z = y*y;} --> F(y)[+A(x)]F(z)A(-x)\n", "A(4)", 2));
    EXPECT_EQ(all_losses(system), "");
    // By hand: y is t/2 + 1, z its square.
    const std::string by_hand =
        "axiom: A(4)\nturn: left\nA(t) : t/2 > 0 --> F(t/2+1)[+A(t/2)]F((t/2+1)^2)A(0-t/2)\nderivation length: 2\n";
    EXPECT_EQ(word_of(system.pattern), word_of(by_hand));
    EXPECT_EQ(word_of(system.pattern, 1), "F(3)[+A(2)]F(9)A(-2)");
    // A parameter may be set, and a name may have another value in another production.
    const ImportedSystem two = cpfg(
        system_with("A(t) : {t = t+1;} 1 --> B(t)\nB(u) : {t = u*2; printf(\"%d;\", t);} 1 --> F(t)\n", "A(4)", 2));
    EXPECT_EQ(word_of(two.pattern), "F(10)");
    EXPECT_TRUE(has(all_losses(two), "what printf() writes"));
}

TEST(ImportCpfgStatements, StatementsWithOtherEffectsAreLost) {
    // Of unknown statements only what depends on them is lost.
    const ImportedSystem kept = cpfg(system_with("A(t) : {if (t > 1) { x = 2; }} 1 --> F(t)\n", "A(4)"));
    EXPECT_EQ(word_of(kept.pattern), "F(4)");
    EXPECT_TRUE(has(all_losses(kept), "the C statements of a production"));
    const ImportedSystem lost = cpfg(system_with("A(t) : {if (t > 1) { t = 2; }} 1 --> F(t)\n", "A(4)"));
    EXPECT_EQ(word_of(lost.pattern), "A(4)");
    EXPECT_TRUE(has(all_losses(lost), "the statements that set 't' are not read"));
    for (const char* change : {"t += 5;", "t++;", "++t;", "t -= 1;", "x = 1; --t;"}) {
        const ImportedSystem changed = cpfg(system_with("A(t) : {" + std::string(change) + "} 1 --> F(t)\n", "A(4)"));
        EXPECT_EQ(word_of(changed.pattern), "A(4)") << change;
        EXPECT_FALSE(all_losses(changed).empty()) << change;
    }
    const ImportedSystem unread = cpfg(system_with("A(t) : {x = \"text\"[2] ? 1 : 0;} 1 --> F(t)\n", "A(4)"));
    EXPECT_EQ(word_of(unread.pattern), "F(4)");
    // A variable that belongs to the whole system.
    const ImportedSystem shared = cpfg(
        "Lsystem: 1\nderivation length: 1\ndefine: { int total; }\nAxiom: A(4)\n"
        "A(t) : {total = total + t;} 1 --> F(t)\nendlsystem\n");
    EXPECT_EQ(word_of(shared.pattern), "F(4)");
    EXPECT_TRUE(has(all_losses(shared), "the C statements of a production"));
    // One random number is not two.
    const ImportedSystem chance = cpfg(system_with("A(t) : {x = ran(1);} 1 --> F(x)F(x)\n", "A(4)"));
    EXPECT_TRUE(has(all_losses(chance), "'x' would use one random number twice"));
    EXPECT_EQ(all_losses(cpfg(system_with("A(t) : {x = ran(1);} 1 --> F(x)\n", "A(4)"))), "");
}

TEST(ImportCpfgDecomposition, IsRepeatedAfterEachStep) {
    // Recursive as long as a parameter allows.
    const ImportedSystem counted = cpfg(system_with(
        "A(n) --> M(n)B\nB --> M(2)\ndecomposition\nmaximum depth: 9\nM(n) : n>0 --> F M(n-1)\nM(n) --> +\n", "A(4)",
        2));
    EXPECT_EQ(all_losses(counted), "");
    EXPECT_EQ(word_of(counted.pattern), "FFFF+FF+");
    // 9 rounds, and 9 after each step: cpfg's step 1.
    EXPECT_EQ(word_of(counted.pattern, 9 + 10), "FFFF+B");
    EXPECT_EQ(word_of(counted.pattern, 9), "A(4)");
    // Letters that derive one another need as many rounds as their chain has links.
    const ImportedSystem chain =
        cpfg(system_with("X --> [L]X\ndecomposition\nmaximum depth: 100\nL --> MM\nM --> FfF\n", "X", 3));
    EXPECT_TRUE(has(chain.pattern, "schedule: decompose*2 step decompose*2 step decompose*2 step decompose*2\n"));
    const std::string composed = "axiom: X\nX --> [FfFFfF]X\n";
    for (int step = 0; step <= 3; ++step) EXPECT_EQ(word_of(chain.pattern, 2 + 3 * step), word_of(composed, step));
    // The depth may end it before.
    const ImportedSystem cut = cpfg(system_with("decomposition\nM(n) : n>0 --> F M(n-1)\n", "M(9)", 3));
    EXPECT_EQ(word_of(cut.pattern), "FFFFM(5)");
    EXPECT_EQ(
        word_of(cpfg(system_with("A --> L\ndecomposition\nL --> F\nhomomorphism\nF --> G\n", "A")).pattern, -1, true),
        "G");
}

TEST(ImportCpfg, OtherProgramsFilesAreNotItsOwn) {
    EXPECT_FALSE(import_format("#include <lpfgall.h>\nmodule A();\nAxiom: A();\nA() : { produce A(); }\n"));
    EXPECT_FALSE(import_format("module I(float);\nStart: { x = 1; }\nI(x) : {\n  produce I(x/2);\n}\n"));
    EXPECT_EQ(import_format("Lsystem: 1\nAxiom: A\n"), ImportFormat::cpfg);
    EXPECT_EQ(import_format("A {\nangle 4\naxiom F\n}\n"), ImportFormat::fractint);
}

TEST(ImportCpfg, PatternsThatDrawNothingAreReported) {
    EXPECT_TRUE(cpfg(system_with("A --> F\n", "A")).draws);
    EXPECT_FALSE(cpfg(system_with("A(t) : {t = f(t);} 1 --> F(t)\n")).draws);
}

}  // namespace sikku::import_cpfg_statements_test
