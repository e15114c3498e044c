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
#include <sstream>
#include <string>
#include <vector>

namespace sikku::docs_test {

const std::filesystem::path root = SIKKU_SOURCE_DIR;

std::string contents(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::vector<std::filesystem::path> pages() {
    std::vector<std::filesystem::path> found;
    for (const auto& folder : {root, root / "docs"}) {
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            if (entry.path().extension() == ".md") found.push_back(entry.path());
        }
    }
    return found;
}

TEST(Docs, FilesThatAreNamedExist) {
    static const std::regex form("`((?:engine|art|music|cli|packaging|python|studio|tests|patterns)/[a-z0-9_./-]*)`");
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
            EXPECT_TRUE(has(text, "| `" + room + "` |")) << room;
        }
    }
}

/// An indented block of a page: a file that the text before it says to write, or commands and what they print.
struct Block {
    std::string before;  ///< the paragraph before
    std::vector<std::string> lines;
};

std::vector<Block> blocks_of(const std::string& page) {
    std::vector<Block> blocks;
    std::string line, paragraph;
    bool is_inside = false, ends = true;
    std::istringstream text(page);
    while (std::getline(text, line)) {
        const bool is_indented = line.starts_with("    ");
        if (is_indented && !is_inside) blocks.push_back({paragraph, {}});
        if (is_indented) {
            blocks.back().lines.push_back(line.substr(4));
        } else if (line.empty() && is_inside) {
            blocks.back().lines.emplace_back();
        } else if (!line.empty()) {
            paragraph = ends ? line : paragraph + ' ' + line;
        }
        ends = line.empty() || is_indented;
        is_inside = is_indented || (line.empty() && is_inside);
    }
    for (Block& block : blocks) {
        while (block.lines.back().empty()) block.lines.pop_back();
    }
    return blocks;
}

/// What takes longer on one machine than on another is not compared, nor what `…` stands for.
std::regex pattern_of(const std::vector<std::string>& lines) {
    static const std::regex special(R"([.^$|()\[\]{}*+?\\])"), times(R"([0-9]+\\\.[0-9]+ (s:|a second))");
    std::string all;
    for (const std::string& line : lines) {
        if (line == "…") {
            all += "(?:.*\n)*";
            continue;
        }
        all += std::regex_replace(std::regex_replace(line, special, R"(\$&)"), times, "[0-9.]+ m?$1") + "\n";
    }
    return std::regex(all);
}

/// Runs the commands of a page, in one folder for each section, and compares their output with the page. Returns the
/// number of comparisons.
int compare_page(const std::string& page) {
    const std::string path = std::filesystem::path(SIKKU_PROGRAM).parent_path().string() + ":/usr/bin:/bin";
    const std::string text = contents(root / "docs" / page);
    static const std::regex writes("(?:Write|write) .*into `([a-z.]+)`");
    int compared = 0;
    for (std::size_t at = text.find("\n## "), next = 0; at != std::string::npos; at = next) {
        next = text.find("\n## ", at + 1);
        const ScratchFolder folder;
        for (const Block& block : blocks_of(text.substr(at, next == std::string::npos ? next : next - at))) {
            std::smatch file;
            if (std::regex_search(block.before, file, writes)) {
                std::string whole;
                for (const std::string& line : block.lines) whole += line + '\n';
                folder.write(file[1].str(), whole);
                continue;
            }
            for (std::size_t i = 0; i < block.lines.size();) {
                const std::string command = block.lines[i++].substr(2);
                std::vector<std::string> shown;
                while (i < block.lines.size() && !block.lines[i].starts_with("$ ")) shown.push_back(block.lines[i++]);
                // Neither LilyPond nor Slurm is needed for the tests.
                if (command.find("lilypond") != std::string::npos || command.find("--slurm") != std::string::npos) {
                    continue;
                }
                const Outcome outcome =
                    run({"-c", command},
                        {.folder = folder.path(), .environment = {{"PATH", path}}, .program = "/bin/sh"});
                EXPECT_EQ(outcome.status, 0) << command << '\n' << outcome.errors;
                if (shown.empty()) continue;
                const std::string printed = outcome.output + outcome.errors;
                EXPECT_TRUE(std::regex_match(printed, pattern_of(shown))) << command << '\n' << printed;
                ++compared;
            }
        }
    }
    return compared;
}

TEST(Docs, TheTutorialShowsWhatItsCommandsPrint) {
    EXPECT_GE(compare_page("tutorial.md"), 8);
}

TEST(Docs, TheTeachingPageShowsWhatItsCommandsPrint) {
    EXPECT_GE(compare_page("teaching.md"), 12);
    // Twelve exercises with solutions.
    const std::string text = contents(root / "docs" / "teaching.md");
    EXPECT_EQ(count_of(text, "\n## Exercise "), 12U);
    EXPECT_EQ(count_of(text, "\n**Solution.**"), 12U);
}

TEST(Docs, TheReadmeListsAllPages) {
    const std::string text = contents(root / "README.md");
    for (const auto& entry : std::filesystem::directory_iterator(root / "docs")) {
        if (entry.path().extension() != ".md") continue;
        const std::string name = entry.path().filename().string();
        EXPECT_TRUE(has(text, "](docs/" + name + ")")) << name;
    }
}

/// Each row states the claim, the method, and what is not claimed.
TEST(Docs, ClaimsHaveThreeColumns) {
    std::istringstream lines(contents(root / "docs" / "claims.md"));
    std::size_t rows = 0;
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("|")) continue;
        ++rows;
        EXPECT_EQ(std::count(line.begin(), line.end(), '|'), 4) << line;
    }
    EXPECT_GT(rows, 30U);
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

}  // namespace sikku::docs_test
