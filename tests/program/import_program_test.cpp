// tests/program/import_program_test.cpp: `sikku import`.
#include "tests/fuzz/targets.h"
#include "tests/import_tools.h"
#include "tests/program.h"

#include <gtest/gtest.h>

#include <string>

namespace sikku::import_program_test {

using namespace import_tools;

const char* const collection =
    "Koch {\n angle 6\n axiom F--F--F\n F=F+F--F+F\n}\nKites&Darts {\n angle 10\n axiom F\n}\n"
    "kites-DARTS {\n angle 10\n axiom F<1F\n}\nBad {\n angle 6\n}\n";

TEST(ImportProgram, CollectionsBecomeFolders) {
    const ScratchFolder folder;
    const std::string file = folder.write("some.l", collection);
    Outcome outcome = run({"import", file, "-o", folder.file("out")});
    EXPECT_EQ(outcome.status, 2) << "one entry is bad";
    EXPECT_TRUE(has(outcome.errors, "some.l:14:1: the entry 'Bad' has no axiom\n"));
    EXPECT_TRUE(
        has(outcome.errors, "kites-darts.lsys already exists: 'kites-DARTS' on line 10 becomes kites-darts-2.lsys"));
    EXPECT_TRUE(has(outcome.errors, "3 patterns in "));
    EXPECT_TRUE(has(outcome.errors, "some.l:12:9: warning: not supported: cycles of colours"));
    const std::vector<std::string> files = {"kites-darts-2.lsys", "kites-darts.lsys", "koch.lsys"};
    for (const std::string& name : files) {
        const Outcome checked = run({"check", folder.file("out/" + name)});
        EXPECT_EQ(checked.status, 0) << checked.output;
        EXPECT_EQ(checked.output, "");
        EXPECT_EQ(run({"draw", folder.file("out/" + name), "-o", folder.file("x.svg")}).status, 0);
    }
    EXPECT_EQ(run({"derive", folder.file("out/koch.lsys"), "-n", "0"}).output, "F--F--F\n");
    // The same bytes every time.
    const std::string before = contents(folder / "out/koch.lsys");
    EXPECT_EQ(run({"import", file, "Koch", "-o", folder.file("out")}).status, 0);
    EXPECT_EQ(contents(folder / "out/koch.lsys"), before);
    // A pattern that was edited stays, and nothing else is written.
    folder.write("out/koch.lsys", before + "# mine\n");
    std::filesystem::remove(folder / "out/kites-darts.lsys");
    outcome = run({"import", file, "-o", folder.file("out")});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(has(outcome.errors, "koch.lsys: this file has other contents"));
    EXPECT_EQ(contents(folder / "out/koch.lsys"), before + "# mine\n");
    EXPECT_FALSE(std::filesystem::exists(folder / "out/kites-darts.lsys"));
}

TEST(ImportProgram, OneSystemGoesToOneFileOrOut) {
    const ScratchFolder folder;
    const std::string file = folder.write("some.l", collection);
    const Outcome printed = run({"import", file, "KOCH"});
    EXPECT_EQ(printed.status, 0);
    EXPECT_EQ(printed.errors, "") << "others' mistakes are not told";
    EXPECT_TRUE(printed.output.starts_with("title: Koch\nsource: some.l, line 1\n"));
    EXPECT_EQ(run({"import", file, "Koch", "-o", folder.file("k.lsys")}).status, 0);
    EXPECT_EQ(contents(folder / "k.lsys"), printed.output);
    EXPECT_EQ(run({"import", "-", "Koch"}, {.input = collection}).status, 0);
    for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"-o", folder.file("all.lsys")}}) {
        std::vector<std::string> arguments = {"import", file};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome many = run(arguments);
        EXPECT_EQ(many.status, 2);
        EXPECT_TRUE(has(many.errors, "contains 4 systems: name one of them"));
    }
    const Outcome unknown = run({"import", file, "Kock"});
    EXPECT_EQ(unknown.status, 2);
    EXPECT_TRUE(has(unknown.errors, "contains no system 'Kock'; did you mean 'Koch'?"));
    const Outcome list = run({"import", file, "--list"});
    EXPECT_EQ(list.status, 0);
    EXPECT_TRUE(has(list.output, "Koch                     line 1      complete\n"));
    EXPECT_TRUE(has(list.output, "kites-DARTS              line 10     1 feature not supported\n"));
    EXPECT_TRUE(has(list.output, "Bad                      line 14     has errors\n"));
}

TEST(ImportProgram, ViewFilesBesideAreRead) {
    const ScratchFolder folder;
    const std::string file =
        folder.write("plant.l", "Lsystem: 1\nderivation length: 1\nAxiom: F\nF --> F+F\nendlsystem\n");
    EXPECT_TRUE(has(run({"import", file}).output, "angle increment: 45\n"));
    folder.write("plant.v", "angle factor: 16\n");
    EXPECT_TRUE(has(run({"import", file}).output, "title: plant\nsource: plant.l\n"));
    EXPECT_TRUE(has(run({"import", file}).output, "angle factor: 16\n"));
    const std::string other = folder.write("other.v", "angle increment: 20\n");
    EXPECT_TRUE(has(run({"import", file, "--view-file", other}).output, "angle increment: 20\n"));
    const std::string fractal = folder.write("some.l", collection);
    EXPECT_EQ(run({"import", fractal, "Koch", "--view-file", other}).status, 2);
    EXPECT_EQ(run({"import", file, "--view-file", folder.file("none.v")}).status, 2);
}

TEST(ImportProgram, BadInput) {
    const auto refused = [](const Outcome& outcome, std::string_view message) {
        EXPECT_EQ(outcome.status, 2);
        EXPECT_TRUE(has(outcome.errors, message));
        EXPECT_EQ(outcome.output, "");
        EXPECT_LT(outcome.seconds, sanitized ? 120 : 12);
        EXPECT_LT(outcome.peak, sanitized ? 8'000'000 : 1'000'000);
        EXPECT_LT(outcome.errors.size(), 30'000U);
    };
    const auto fed = [](std::string_view head, std::string_view block, std::size_t bytes) {
        return run({"import", "-"}, {.feed = [=](const Feed& feed) {
                       feed(head);
                       std::string many;
                       while (many.size() < 65'536) many += block;
                       for (std::size_t sent = 0; sent < bytes; sent += many.size()) {
                           if (!feed(many)) return;
                       }
                   }});
    };
    refused(run({"import", "-"}), "neither a cpfg file");
    refused(run({"import", "/nowhere/at.all"}), "/nowhere/at.all: No such file or directory");
    refused(run({"import", "/tmp"}), "is a folder");
    refused(fed("Lsystem: 1\n", "a", 65 << 20), "64 MB");
    refused(fed("A {\naxiom ", "F", 16 << 20), "the entry 'A' has no end");
    refused(fed("", "A {}\n", 8 << 20), "has no axiom");
    refused(fed("", "A{axiom F\nangle 4\n}\n", 8 << 20), "more than 10,000 entries");
    refused(fed("", "A {\n", 16 << 20), "has no end");
    refused(fed("Lsystem: 1\nAxiom: ", "(", 16 << 20), "'(' is not a symbol");
    refused(fed("Lsystem: 1\nAxiom: F(1", "+1", 16 << 20), "longer than 1 MB");
    refused(fed("Lsystem: 1\nAxiom: F\n", "A --> B\n", 8 << 20), "more than 10,000 productions");
    refused(fed("Lsystem: 1\nStart: {", "\n", 16 << 20), "");
    refused(fed("Lsystem: 1\nAxiom: F\nA", "\n\t", 16 << 20), "expected '-->'");
    refused(fed("Lsystem: 1\n", "#if 1\n", 16 << 20), "nest more than 200 deep");
    refused(fed("Lsystem: 1\n", "#define a b\n", 16 << 20), "no 'Axiom:'");
}

TEST(ImportProgram, AFileInPlaceOfTheFolderIsKept) {
    const ScratchFolder folder;
    const std::string file = folder.write("some.l", "Koch {\n angle 6\n axiom F\n}\nLine {\n angle 6\n axiom F\n}\n");
    const std::string other = folder.write("other", "mine");
    const Outcome outcome = run({"import", file, "-o", other});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.errors, "sikku: " + other + ": Not a directory\n");
    EXPECT_EQ(contents(other), "mine");
}

TEST(ImportCorpus, EveryFileGoesThroughTheFuzzTarget) {
    std::size_t files = 0;
    for (const auto& entry :
         std::filesystem::directory_iterator(std::filesystem::path(SIKKU_SOURCE_DIR) / "tests/corpus/import")) {
        SCOPED_TRACE(entry.path().string());
        EXPECT_NO_THROW(try_import(contents(entry.path())));
        ++files;
    }
    EXPECT_GT(files, 4U);
    for (const auto& file : pattern_files("tests/corpus")) {
        SCOPED_TRACE(file.string());
        EXPECT_NO_THROW(try_import(contents(file)));
    }
}

}  // namespace sikku::import_program_test
