// tests/corpus_test.cpp: what the fuzzers do, done with every file of the corpus and every pattern.
#include "tests/fuzz/scale_targets.h"
#include "tests/fuzz/targets.h"
#include "tests/program.h"

#include <gtest/gtest.h>

namespace sikku {
namespace {

/// Compiled, and its word measured without a mistake?
bool is_good(const std::string& text) {
    const Compiled compiled = compile_bytes(text);
    if (!compiled.grammar) return false;
    try {
        measure(*compiled.grammar, 1e6);
        return true;
    } catch (const WordError&) {
        return false;
    } catch (const BudgetError&) {
        return false;
    }
}

TEST(Corpus, EveryFileGoesThroughTheFuzzTargets) {
    for (const char* folder : {"tests/corpus", "patterns"}) {
        const auto list = pattern_files(folder);
        EXPECT_FALSE(list.empty()) << folder;
        for (const auto& file : list) {
            SCOPED_TRACE(file.string());
            const std::string text = contents(file);
            EXPECT_NO_THROW(try_pattern(text));
            EXPECT_NO_THROW(try_derivation(text));
        }
    }
}

TEST(Corpus, EveryFileOfScalesGoesThroughTheFuzzTargets) {
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(std::filesystem::path(SIKKU_SOURCE_DIR) / "tests/corpus")) {
        if (!entry.is_regular_file()) continue;
        SCOPED_TRACE(entry.path().string());
        const std::string text = contents(entry.path());
        EXPECT_NO_THROW(try_scl(text));
        EXPECT_NO_THROW(try_kbm(text));
    }
}

TEST(Corpus, GoodFilesAreGood) {
    for (const auto& file : pattern_files("tests/corpus/good")) EXPECT_TRUE(is_good(contents(file))) << file;
}

TEST(Corpus, BadFilesAreBad) {
    for (const auto& file : pattern_files("tests/corpus/bad")) EXPECT_FALSE(is_good(contents(file))) << file;
}

}  // namespace
}  // namespace sikku
