// tests/engine/keys_test.cpp: the table of keys, its readers and the manual.
#include "engine/base/keys.h"
#include "art/style/style.h"
#include "engine/language/document.h"
#include "music/melody/melody.h"
#include "tests/checks.h"
#include "tests/files.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

namespace sikku::keys_test {

TEST(Keys, HaveOneRowEach) {
    std::set<std::string_view> names;
    for (const KeyInfo& key : language_keys()) {
        EXPECT_TRUE(names.insert(key.name).second) << key.name;
        EXPECT_EQ(find_language_key(key.name), &key);
        EXPECT_FALSE(key.values.empty()) << key.name;
        EXPECT_FALSE(key.help.empty()) << key.name;
    }
    EXPECT_EQ(find_language_key("axim"), nullptr);
}

TEST(Keys, AreTheRowsOfTheManual) {
    const std::string manual = contents(std::filesystem::path(SIKKU_SOURCE_DIR) / "docs/language.md");
    for (const KeyInfo& key : language_keys()) {
        const std::string row =
            fmt::format("\n| `{}` | {} | {} | {} |\n", key.name, key.values, key.if_absent, key.help);
        EXPECT_TRUE(has(manual, row)) << "docs/language.md lacks this row:" << row;
    }
}

/// A value that only free-text keys accept is an error in every other key, reported by its owner alone.
TEST(Keys, AreReadByTheirOwner) {
    for (const KeyInfo& key : language_keys()) {
        SCOPED_TRACE(key.name);
        if (key.owner == KeyOwner::engine) continue;
        Diagnostics none;
        const Document document = Document::compile(
            "keys.lsys",
            fmt::format("{}axiom: FFF\n{}: ,?!\n", key.scope == KeyScope::maps ? "map: clockwise\n" : "", key.name),
            {}, none);
        EXPECT_TRUE(none.list().empty());
        Diagnostics art;
        read_style(document.pattern(), 96, art);
        EXPECT_EQ(art.has_errors(), key.owner == KeyOwner::art);
        Diagnostics music;
        const auto no_file = [](const std::string&) -> std::string { throw std::runtime_error("no such file"); };
        read_melody(document.pattern(), no_file, music);
        EXPECT_EQ(music.has_errors(), key.owner == KeyOwner::music);
    }
}

TEST(Keys, UnknownOnesNameTheNearest) {
    Diagnostics diagnostics;
    Document::compile("keys.lsys", "axiom: F\ntepmo: 90\n", {}, diagnostics);
    ASSERT_EQ(diagnostics.list().size(), 1u);
    EXPECT_EQ(diagnostics.list()[0].message, "unknown key 'tepmo'; did you mean 'tempo'?");
}

TEST(Document, IsParsedWithOverrides) {
    const std::string text =
        "title: Koch\naxiom: F\nF --> F-F++F-F\nangle factor: 6\nvariant long: derivation length = 5\n";
    EXPECT_EQ(parse("koch.lsys", text).grammar().steps(), 0);
    EXPECT_EQ(parse("koch.lsys", text, {"long", {}}).grammar().steps(), 5);
    EXPECT_EQ(parse("koch.lsys", text, {"long", {{"-n", "derivation length", "7"}}}).grammar().steps(), 7);
    EXPECT_EQ(parse("koch.lsys", text).text("title"), "Koch");
    EXPECT_THROW(parse("koch.lsys", "axim: F\n"), PatternError);
}

TEST(Document, IsLoadedByNameOrPath) {
    const PatternLibrary library(std::filesystem::path(SIKKU_SOURCE_DIR) / "patterns");
    EXPECT_GE(library.patterns().size(), 107u);
    const Document kolam = load("snake-kolam", {}, library);
    EXPECT_EQ(kolam.text("title"), "Snake kolam");
    EXPECT_EQ(kolam.source().name(), "snake-kolam.lsys");
    ASSERT_NE(library.find("snake-kolam"), nullptr);
    EXPECT_EQ(library.find("snake-kolam")->kind, "kolams");
    EXPECT_EQ(load(library.find("hilbert")->file.string()).text("title"), "Hilbert curve");
    EXPECT_EQ(error_of<NotFound>([&] { load("snake-kolan", {}, library); }),
              "no file or pattern named 'snake-kolan'; did you mean 'snake-kolam'?");
}

}  // namespace sikku::keys_test
