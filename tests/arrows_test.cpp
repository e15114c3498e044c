// tests/arrows_test.cpp: which folder may include what; art and music never see each other, engine sees nobody.
#include "tests/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <regex>
#include <set>

namespace sikku {
namespace {

struct Include {
    std::string file;  ///< relative to the source folder
    std::string name;
    bool quoted = false;
};

std::vector<Include> includes_of(const std::string& folder) {
    const std::filesystem::path root = SIKKU_SOURCE_DIR;
    static const std::regex line_form(R"(^\s*#\s*include\s*([<"])([^>"]+)[>"])");
    std::vector<Include> found;
    if (!std::filesystem::exists(root / folder)) return found;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(root / folder)) {
        const std::string extension = entry.path().extension();
        if (extension != ".h" && extension != ".cpp") continue;
        std::ifstream stream(entry.path());
        for (std::string line; std::getline(stream, line);) {
            std::smatch match;
            if (!std::regex_search(line, match, line_form)) continue;
            found.push_back({std::filesystem::relative(entry.path(), root).string(), match[2], match[1] == "\""});
        }
    }
    return found;
}

bool is_standard(const std::string& name) {
    static const std::set<std::string> with_ending = {"immintrin.h"};
    // Headers of the standard library have neither folder nor ending.
    return (name.find('/') == std::string::npos && name.find('.') == std::string::npos) || with_ending.contains(name);
}

bool is_in(const std::string& name, const std::string& folder) {
    return name.starts_with(folder + "/");
}

TEST(Arrows, EngineSeesTheStandardLibraryGlmAndBoostMultiprecision) {
    const auto list = includes_of("engine");
    ASSERT_FALSE(list.empty());
    for (const auto& [file, name, quoted] : list) {
        const bool fine = quoted ? is_in(name, "engine")
                                 : is_standard(name) || is_in(name, "glm") || is_in(name, "boost/multiprecision") ||
                                       (is_in(name, "fmt") && file.ends_with(".cpp"));
        EXPECT_TRUE(fine) << file << " includes " << name;
    }
}

TEST(Arrows, ArtSeesArtAndEngine) {
    const auto list = includes_of("art");
    ASSERT_FALSE(list.empty());
    for (const auto& [file, name, quoted] : list) {
        EXPECT_TRUE(!quoted || is_in(name, "art") || is_in(name, "engine")) << file << " includes " << name;
        for (const char* folder : {"cli", "music", "tests", "CLI"}) {
            EXPECT_FALSE(is_in(name, folder)) << file << " includes " << name;
        }
    }
}

TEST(Arrows, MusicSeesMusicAndEngine) {
    ASSERT_FALSE(includes_of("music").empty());
    for (const auto& [file, name, quoted] : includes_of("music")) {
        EXPECT_TRUE(!quoted || is_in(name, "music") || is_in(name, "engine")) << file << " includes " << name;
        for (const char* folder : {"cli", "art", "tests", "CLI"}) {
            EXPECT_FALSE(is_in(name, folder)) << file << " includes " << name;
        }
    }
}

TEST(Arrows, OpenImageIoStaysInsideOneFileOfArt) {
    std::set<std::string> users;
    for (const char* folder : {"engine", "art", "music", "cli"}) {
        for (const auto& [file, name, quoted] : includes_of(folder)) {
            if (is_in(name, "OpenImageIO")) users.insert(file);
        }
    }
    EXPECT_EQ(users, std::set<std::string>{"art/image_module.cpp"});
}

TEST(Arrows, QuotedNamesStartAtTheSourceFolder) {
    for (const char* folder : {"engine", "art", "music", "cli", "tests"}) {
        for (const auto& [file, name, quoted] : includes_of(folder)) {
            if (!quoted) continue;
            EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(SIKKU_SOURCE_DIR) / name))
                << file << " includes " << name;
        }
    }
}

/// No file sees what comes after it: language, then derivation, then what reads words. Path and spline know no
/// grammar.
TEST(Arrows, EngineIsInOrder) {
    static const std::map<std::string, int> layer = {
        {"diagnostic", 0},   {"keys", 0},        {"pattern_library", 1}, {"document", 3},    {"bezier", 0},
        {"monitor", 0},      {"path", 1},        {"spline_outlines", 2}, {"spline", 3},      {"expression", 1},
        {"pattern", 1},      {"text", 1},        {"grammar", 2},         {"derivation", 3},  {"lattice", 3},
        {"parts", 4},        {"clumps", 5},      {"chance", 0},          {"forecast", 4},    {"fold", 5},
        {"turtle", 5},       {"extent", 6},      {"import", 3},          {"import_cpfg", 4}, {"import_fractint", 4},
        {"turtle_state", 4}, {"space_turtle", 5}};
    const auto stem = [](const std::string& name) {
        const std::string own = std::filesystem::path(name).stem().string();
        return own == "neighbourhood" ? std::string("derivation") : own;  // a part of derivation.cpp
    };
    for (const auto& [file, name, quoted] : includes_of("engine")) {
        ASSERT_TRUE(layer.contains(stem(file))) << file << " has no place in the order yet: add it here";
        if (!quoted || stem(name) == stem(file)) continue;
        ASSERT_TRUE(layer.contains(stem(name))) << name;
        EXPECT_GT(layer.at(stem(file)), layer.at(stem(name))) << file << " includes " << name;
    }
    static const std::set<std::string> geometry = {"bezier", "path", "spline", "spline_outlines"};
    for (const auto& [file, name, quoted] : includes_of("engine")) {
        if (!geometry.contains(stem(file))) continue;
        EXPECT_TRUE(!quoted || geometry.contains(stem(name))) << file << " includes " << name;
    }
}

}  // namespace
}  // namespace sikku
