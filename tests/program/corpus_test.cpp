// tests/program/corpus_test.cpp: runs the checks of the fuzzers on every file of the corpus and every pattern.
#include "art/image/image_file.h"
#include "tests/checks.h"
#include "tests/files.h"
#include "tests/fuzz/file_targets.h"
#include "tests/fuzz/grid_targets.h"
#include "tests/fuzz/link_targets.h"
#include "tests/fuzz/reading_targets.h"
#include "tests/fuzz/scale_targets.h"
#include "tests/fuzz/server_targets.h"
#include "tests/fuzz/surface_targets.h"
#include "tests/fuzz/svg_targets.h"
#include "tests/fuzz/targets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

namespace sikku::corpus_test {

/// Compiled, and its word measured without a mistake?
bool is_good(const std::string& text) {
    const Compiled compiled = compile_bytes(text);
    if (!compiled.grammar) return false;
    try {
        if (compiled.grammar->map()) {
            derive_map(*compiled.grammar, {1e6});
            return true;
        }
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

std::vector<std::filesystem::path> files_of(const std::string& folder) {
    std::vector<std::filesystem::path> list;
    for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(SIKKU_SOURCE_DIR) / folder)) {
        list.push_back(entry.path());
    }
    std::sort(list.begin(), list.end());
    return list;
}

/// Calls `attempt` with the bytes, with each of their beginnings, and with one byte changed in many ways.
void mutate(const std::string& bytes, const std::function<void(const std::string&)>& attempt,
            std::size_t places = 2000) {
    attempt(bytes);
    const std::size_t step = 1 + bytes.size() / places;
    for (std::size_t length = 0; length < bytes.size(); length += step) attempt(bytes.substr(0, length));
    for (std::size_t at = 0; at < bytes.size(); at += step) {
        for (const char byte : {'\0', '\x7F', '\xFF', static_cast<char>(bytes[at] + 1)}) {
            std::string changed = bytes;
            changed[at] = byte;
            attempt(changed);
        }
    }
}

TEST(Corpus, GridsAreReadOrRefused) {
    const auto list = files_of("tests/corpus/grids");
    EXPECT_FALSE(list.empty());
    for (const auto& file : list) {
        SCOPED_TRACE(file.string());
        mutate(contents(file), [](const std::string& changed) {
            ASSERT_NO_THROW(try_grid(changed));
            ASSERT_NO_THROW(try_radial(changed));
        });
    }
}

TEST(Corpus, KolamsOfOtherFormatsAreReadOrRefused) {
    const auto list = files_of("tests/corpus/reading");
    EXPECT_FALSE(list.empty());
    for (const auto& file : list) {
        SCOPED_TRACE(file.string());
        mutate(contents(file), [](const std::string& changed) { ASSERT_NO_THROW(try_reading(changed)); });
    }
}

TEST(Corpus, PicturesOfOtherProgramsAreReadOrRefused) {
    const auto list = files_of("tests/corpus/svg");
    EXPECT_FALSE(list.empty());
    for (const auto& file : list) {
        SCOPED_TRACE(file.string());
        mutate(contents(file), [](const std::string& changed) { ASSERT_NO_THROW(try_svg(changed)); });
    }
}

TEST(Corpus, LinksAreReadOrRefused) {
    const auto list = files_of("tests/corpus/link");
    EXPECT_FALSE(list.empty());
    for (const auto& file : list) {
        SCOPED_TRACE(file.string());
        mutate(contents(file), [](const std::string& changed) { ASSERT_NO_THROW(try_contents(changed)); });
    }
}

TEST(Corpus, PrintsAndScoresAreReadOrRefused) {
    for (const char* folder : {"tests/corpus/show", "tests/corpus/midi"}) {
        const auto list = files_of(folder);
        EXPECT_FALSE(list.empty()) << folder;
        for (const auto& file : list) {
            SCOPED_TRACE(file.string());
            const std::string bytes = contents(file);
            mutate(bytes, [&](const std::string& changed) {
                ASSERT_NO_THROW(try_show(changed));
                ASSERT_NO_THROW(try_midi(changed));
            });
            const auto shown = try_show(bytes);
            for (const char* kind : {"print", "exact", "plain", "packed", "international", "big", "score"}) {
                if (file.filename().string().starts_with(kind)) {
                    ASSERT_TRUE(shown);
                    EXPECT_NE(shown->find("axiom: F"), std::string::npos);
                }
            }
        }
    }
}

TEST(Corpus, ProfilesAreReadOrRefused) {
    const ScratchFolder folder;
    for (const auto& file : files_of("tests/corpus/icc")) {
        SCOPED_TRACE(file.string());
        EXPECT_NO_THROW(check_cmyk_profile(file));
        mutate(
            contents(file),
            [&](const std::string& changed) {
                try {
                    check_cmyk_profile(folder.write("changed.icc", changed));
                } catch (const std::runtime_error& error) {
                    ASSERT_TRUE(has(error.what(), "changed.icc"));
                }
            },
            200);
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

TEST(Corpus, SurfaceFilesAreReadOrRefused) {
    for (const auto& file : files_of("tests/corpus/surfaces")) {
        SCOPED_TRACE(file.string());
        EXPECT_NO_THROW(try_surface(contents(file)));
        mutate(
            contents(file), [&](const std::string& changed) { EXPECT_NO_THROW(try_surface(changed)); }, 2000);
    }
}

TEST(Corpus, TheLanguageServerAnswersEveryMessage) {
    for (const auto& file : files_of("tests/corpus/server")) {
        SCOPED_TRACE(file.string());
        constexpr std::size_t places = 20;
        mutate(
            contents(file), [](const std::string& changed) { ASSERT_NO_THROW(try_server(changed)); }, places);
    }
}

TEST(Corpus, GoodFilesAreGood) {
    for (const auto& file : pattern_files("tests/corpus/good")) EXPECT_TRUE(is_good(contents(file))) << file;
}

TEST(Corpus, BadFilesAreBad) {
    for (const auto& file : pattern_files("tests/corpus/bad")) EXPECT_FALSE(is_good(contents(file))) << file;
}

}  // namespace sikku::corpus_test
