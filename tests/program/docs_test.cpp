// tests/program/docs_test.cpp: checks the manual: files, links, rooms, commands.
#include "music/melody/melody.h"
#include "tests/files.h"
#include "tests/program.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

namespace sikku {
namespace {

const std::filesystem::path root = SIKKU_SOURCE_DIR;

std::string contents(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::filesystem::path> pages() {
    std::vector<std::filesystem::path> found = {root / "README.md"};
    for (const auto& entry : std::filesystem::directory_iterator(root / "docs")) {
        if (entry.path().extension() == ".md") found.push_back(entry.path());
    }
    return found;
}

TEST(Docs, FilesThatAreNamedExist) {
    static const std::regex form("`((?:engine|art|music|cli|python|studio|tests|patterns)/[a-z0-9_./-]*)`");
    for (const auto& page : pages()) {
        const std::string text = contents(page);
        for (std::sregex_iterator match(text.begin(), text.end(), form), end; match != end; ++match) {
            EXPECT_TRUE(std::filesystem::exists(root / (*match)[1].str())) << page << " names " << (*match)[1];
        }
    }
}

TEST(Docs, LinksLeadToFiles) {
    static const std::regex form(R"re((?:\]\(|src=")([^)":# ]+)[)"#])re");
    for (const auto& page : pages()) {
        const std::string text = contents(page);
        for (std::sregex_iterator match(text.begin(), text.end(), form), end; match != end; ++match) {
            EXPECT_TRUE(std::filesystem::exists(page.parent_path() / (*match)[1].str()))
                << page << " links to " << (*match)[1];
        }
    }
}

TEST(Docs, EachRoomIsDescribed) {
    const std::string text = contents(root / "docs" / "architecture.md");
    for (const char* floor : {"engine", "art", "music"}) {
        for (const auto& entry : std::filesystem::directory_iterator(root / floor)) {
            if (!entry.is_directory()) continue;
            const std::string room = std::string(floor) + '/' + entry.path().filename().string();
            EXPECT_NE(text.find("| `" + room + "` |"), std::string::npos) << room;
        }
    }
}

TEST(Docs, TheReadmeIsShort) {
    const std::string text = contents(root / "README.md");
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 150);
}

/// If this fails, run `sikku manual markdown > docs/commands.md`.
TEST(Docs, CommandsAreAsTheProgramPrintsThem) {
    const Outcome manual = run({"manual", "markdown"});
    EXPECT_EQ(manual.status, 0) << manual.errors;
    EXPECT_EQ(manual.output, contents(root / "docs" / "commands.md"));
}

TEST(Docs, EveryInstrumentIsListed) {
    const std::string text = contents(root / "docs" / "scores.md");
    const auto& names = instrument_names();
    for (std::size_t first = 0; first < names.size(); first += 8) {
        const std::string row = fmt::format("| {} to {} | {} |\n", first + 1, first + 8,
                                            fmt::join(names.begin() + static_cast<std::ptrdiff_t>(first),
                                                      names.begin() + static_cast<std::ptrdiff_t>(first) + 8, ", "));
        EXPECT_TRUE(text.find(row) != std::string::npos) << row;
    }
}

TEST(Docs, ManPagesAreWritten) {
    const ScratchFolder folder;
    EXPECT_EQ(run({"manual", "man", folder.path().string()}).status, 0);
    for (const char* page : {"sikku.1", "sikku-draw.1", "sikku-gallery.1"}) {
        EXPECT_TRUE(contents(folder.path() / page).starts_with(".TH SIKKU")) << page;
    }
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "sikku-manual.1"));
}

}  // namespace
}  // namespace sikku
