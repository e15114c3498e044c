// tests/untrusted_test.cpp: files that cost far more than their size promises are read once, or refused.
#include "tests/files.h"
#include "tests/program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

namespace sikku {
namespace {

constexpr double most_seconds = 8;  // of processor time; what these tests are about takes much longer
constexpr long most_kilobytes = 200'000;

void expect_cheap(const Outcome& outcome) {
    if (sanitized) return;
    EXPECT_LT(outcome.seconds, most_seconds);
    EXPECT_LT(outcome.peak, most_kilobytes);
}

void append_number(std::string& bytes, std::uint64_t value, int count) {
    for (int i = 0; i < count; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xFF);
}

TEST(Untrusted, TextsThatATiffRepeatsAreReadOnce) {
    constexpr std::uint64_t entries = 65'535;
    constexpr std::uint64_t length = 1 << 20;
    std::string bytes = "II*";
    bytes += '\0';
    append_number(bytes, 8, 4);
    append_number(bytes, entries, 2);
    for (std::uint64_t i = 0; i < entries; ++i) {
        append_number(bytes, 270, 2);
        append_number(bytes, 2, 2);
        append_number(bytes, length, 4);
        append_number(bytes, 8 + 2 + entries * 12 + 4, 4);
    }
    bytes += std::string(4 + length, '\0');
    const ScratchFolder folder;
    const Outcome outcome = run({"show", folder.write("repeated.tif", bytes)});
    EXPECT_EQ(outcome.status, 1);
    expect_cheap(outcome);
}

TEST(Untrusted, RecordsWithoutLinesAreNotReadWhole) {
    for (const char* record : {"gallery.jsonl", "gallery-1-of-2.jsonl"}) {
        const ScratchFolder folder;
        folder.write(record, "");
        std::filesystem::resize_file(folder / record, std::uintmax_t{2} << 30);
        const Outcome outcome = run({"-q", "gallery", "sierpinski-gasket", "-o", folder.path().string()});
        EXPECT_EQ(outcome.status, std::string_view(record) == "gallery.jsonl" ? 1 : 0) << outcome.errors;
        expect_cheap(outcome);
    }
}

TEST(Untrusted, DotsOfKeysCountAsValues) {
    std::string text;
    for (int i = 0; i < 100'000; ++i) {
        text += fmt::format("k{}", i);
        for (int k = 0; k < 49; ++k) text += ".a";
        text += "=1\n";
    }
    const ScratchFolder folder;
    const Outcome outcome = run({"gallery", "--list", "--file", folder.write("dots.toml", text)});
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.errors.find("too many values"), std::string::npos) << outcome.errors;
    expect_cheap(outcome);
}

TEST(Untrusted, PipesInFoldersAreSkipped) {
    const ScratchFolder folder;
    ASSERT_EQ(::mkfifo(folder.file("pipe.lsys").c_str(), 0600), 0);
    folder.write("koch.lsys", "axiom: F\nF --> F-F++F-F\n");
    for (const std::string& word : {folder.path().string(), folder.file("*.lsys")}) {
        const Outcome outcome = run({"gallery", "--list", word});
        EXPECT_EQ(outcome.status, 0) << outcome.errors;
        EXPECT_EQ(outcome.output.find("pipe"), std::string::npos);
    }
}

TEST(Untrusted, NamesOfRecordsAreNoOutputs) {
    const ScratchFolder folder;
    for (const char* name : {"gallery.jsonl/x", "gallery-1-of-2.jsonl/x"}) {
        const Outcome outcome = run({"gallery", "--list", "koch-island", "--name", name, "-o", folder.file("out")});
        EXPECT_EQ(outcome.status, 2);
        EXPECT_NE(outcome.errors.find("cannot be the name of an output"), std::string::npos) << outcome.errors;
    }
}

TEST(Untrusted, ADefaultFolderThatIsALinkIsRefused) {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder / "elsewhere");
    std::filesystem::create_directory_symlink(folder / "elsewhere", folder / "gallery");
    const Outcome refused = run({"-q", "gallery", "koch-island"}, {.folder = folder.path()});
    EXPECT_EQ(refused.status, 2);
    EXPECT_NE(refused.errors.find("is a symbolic link"), std::string::npos) << refused.errors;
    EXPECT_TRUE(std::filesystem::is_empty(folder / "elsewhere"));
    EXPECT_EQ(run({"-q", "gallery", "koch-island", "-o", "gallery"}, {.folder = folder.path()}).status, 0);
}

}  // namespace
}  // namespace sikku
