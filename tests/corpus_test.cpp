// tests/corpus_test.cpp: what the fuzzers do, done with every file of the corpus and every pattern.
#include "tests/fuzz/targets.h"
#include "tests/program.h"

#include <gtest/gtest.h>

namespace sikku {
namespace {

std::vector<std::filesystem::path> files(const std::string& folder) {
    std::vector<std::filesystem::path> found;
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(std::filesystem::path(SIKKU_SOURCE_DIR) / folder)) {
        if (entry.path().extension() == ".lsys") found.push_back(entry.path());
    }
    std::sort(found.begin(), found.end());
    return found;
}

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
        const auto list = files(folder);
        EXPECT_FALSE(list.empty()) << folder;
        for (const auto& file : list) {
            SCOPED_TRACE(file.string());
            const std::string text = contents_of(file);
            EXPECT_NO_THROW(try_pattern(text));
            EXPECT_NO_THROW(try_derivation(text));
        }
    }
}

TEST(Corpus, GoodFilesAreGood) {
    for (const auto& file : files("tests/corpus/good")) EXPECT_TRUE(is_good(contents_of(file))) << file;
}

TEST(Corpus, BadFilesAreBad) {
    for (const auto& file : files("tests/corpus/bad")) EXPECT_FALSE(is_good(contents_of(file))) << file;
}

}  // namespace
}  // namespace sikku
