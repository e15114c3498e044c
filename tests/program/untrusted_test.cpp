// tests/program/untrusted_test.cpp: files that would cost far more than their size suggests are read once, or
// refused.
#include "tests/files.h"
#include "tests/program.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <functional>
#include <tuple>

namespace sikku::untrusted_test {

constexpr double most_seconds = 20;  // of processor time; the faults tested here take much longer
constexpr long most_kilobytes = 200'000;

void expect_cheap(const Outcome& outcome, long kilobytes = most_kilobytes) {
    if (sanitized) return;
    EXPECT_LT(outcome.seconds, most_seconds);
    EXPECT_LT(outcome.peak, kilobytes);
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

/// Writes piece by piece: the memory of the test would count as that of the program.
std::string write_pieces(const ScratchFolder& folder, const std::string& name, const std::string& head,
                         const std::string& piece, int count, const std::function<std::string(std::size_t)>& tail) {
    std::ofstream file(folder / name, std::ios::binary);
    file << head;
    for (int i = 0; i < count; ++i) file << piece;
    file << tail(static_cast<std::size_t>(file.tellp()));
    return folder.file(name);
}

TEST(Untrusted, AttributesThatAnExrRepeatsAreRefused) {
    for (const std::string name : {"comments", "Software"}) {
        std::string head = "v/1\1";
        append_number(head, 2, 4);
        std::string piece = name + '\0' + "string" + '\0';
        append_number(piece, 8 << 20, 4);
        piece += std::string(8 << 20, 'x');
        const ScratchFolder folder;
        const Outcome outcome =
            run({"show", write_pieces(folder, "repeated.exr", head, piece, 20, [](std::size_t) { return ""; })});
        EXPECT_EQ(outcome.status, 1);
        EXPECT_TRUE(has(outcome.errors, "damaged"));
        expect_cheap(outcome, 100'000);
    }
}

/// Writes a PDF in the layout of the writer, with these entries in its dictionary of texts.
std::string write_pdf(const ScratchFolder& folder, const std::string& begin, const std::string& piece, int count,
                      const std::string& end) {
    return write_pieces(
        folder, "print.pdf", "%PDF-1.4\n1 0 obj\n<< " + begin, piece, count, [&end](std::size_t size) {
            const std::string object_end = end + " /Creator (Sikku) >>\nendobj\n";
            return object_end +
                   fmt::format(
                       "xref\n0 2\n0000000000 65535 f \n0000000009 00000 n \ntrailer\n<< /Size 2 /Root 1 0 R "
                       "/Info 1 0 R >>\nstartxref\n{}\n%%EOF\n",
                       size + object_end.size());
        });
}

TEST(Untrusted, TextsThatAPdfRepeatsAreRefused) {
    const ScratchFolder folder;
    const std::string text = "/SikkuPattern (" + std::string(8 << 20, 'x') + ")\n";
    const Outcome outcome = run({"show", write_pdf(folder, "", text, 20, "")});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(has(outcome.errors, "contains no pattern"));
    expect_cheap(outcome, 100'000);
    EXPECT_EQ(run({"show", write_pdf(folder, "/SikkuPattern (axiom: ", "F", 1, ")")}).output, "axiom: F");
}

TEST(Untrusted, TitlesOfAPdfAreSkippedUpTo64MB) {
    const ScratchFolder folder;
    const std::string piece(1 << 20, '4');
    for (const auto& [begin, count, end] :
         {std::tuple{"/Title (", 70, ") /SikkuPattern (F)"}, std::tuple{"/Title <", 140, "> /SikkuPattern (F)"}}) {
        const Outcome outcome = run({"show", write_pdf(folder, begin, piece, count, end)});
        EXPECT_EQ(outcome.status, 1);
        EXPECT_TRUE(has(outcome.errors, "more than 64 MB"));
        expect_cheap(outcome, 100'000);
    }
}

TEST(Untrusted, CutTemporaryNamesAreNotRemoved) {
    const ScratchFolder folder;
    // Both names are cut to the same 200 bytes; another run may be making the other file.
    const std::string long_name = std::string(220, 'a');
    const std::string cut = "." + std::string(200, 'a') + ".abc234.tmp";
    folder.write("gallery.jsonl", "{\"claim\":\"" + long_name + ".svg\"}\n{\"claim\":\"short.svg\"}\n");
    folder.write(cut, "of another file");
    folder.write(".short.svg.abc234.tmp", "left by a killed run");
    const Outcome outcome = run({"-q", "gallery", "koch-island", "--name", long_name, "-o", folder.path().string()});
    EXPECT_EQ(outcome.status, 0) << outcome.errors;
    EXPECT_TRUE(std::filesystem::exists(folder / (long_name + ".svg")));
    EXPECT_EQ(contents(folder / cut), "of another file");
    EXPECT_FALSE(std::filesystem::exists(folder / ".short.svg.abc234.tmp"));
}

TEST(Untrusted, AProfileIsHashedOnceInARun) {
    const ScratchFolder folder;
    // Every job hashes the file before the first one finds that it is not a profile.
    folder.write("inks.icc", std::string(16 << 20, 'x'));
    folder.write("g.toml",
                 "pattern = 'koch-island'\nformat = 'tif'\nsize = '10x10mm'\ndpi = 10\ncmyk = 'inks.icc'\n"
                 "n = 0\nmargin = '0:2:0.001'\n");
    const Outcome outcome = run({"-q", "gallery", "--file", folder.file("g.toml"), "-o", folder.file("out")});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_TRUE(has(outcome.errors, "not an ICC profile"));
    expect_cheap(outcome, 400'000);  // the module for pictures alone takes 140 MB
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
    EXPECT_TRUE(has(outcome.errors, "too many values"));
    expect_cheap(outcome);
}

TEST(Untrusted, PipesInFoldersAreSkipped) {
    const ScratchFolder folder;
    ASSERT_EQ(::mkfifo(folder.file("pipe.lsys").c_str(), 0600), 0);
    folder.write("koch.lsys", "axiom: F\nF --> F-F++F-F\n");
    for (const std::string& word : {folder.path().string(), folder.file("*.lsys")}) {
        const Outcome outcome = run({"gallery", "--list", word});
        EXPECT_EQ(outcome.status, 0) << outcome.errors;
        EXPECT_FALSE(has(outcome.output, "pipe"));
    }
}

TEST(Untrusted, NamesOfRecordsAreNoOutputs) {
    const ScratchFolder folder;
    for (const char* name : {"gallery.jsonl/x", "gallery-1-of-2.jsonl/x"}) {
        const Outcome outcome = run({"gallery", "--list", "koch-island", "--name", name, "-o", folder.file("out")});
        EXPECT_EQ(outcome.status, 2);
        EXPECT_TRUE(has(outcome.errors, "cannot be the name of an output"));
    }
}

TEST(Untrusted, ADefaultFolderThatIsALinkIsRefused) {
    const ScratchFolder folder;
    std::filesystem::create_directory(folder / "elsewhere");
    std::filesystem::create_directory_symlink(folder / "elsewhere", folder / "gallery");
    const Outcome refused = run({"-q", "gallery", "koch-island"}, {.folder = folder.path()});
    EXPECT_EQ(refused.status, 2);
    EXPECT_TRUE(has(refused.errors, "is a symbolic link"));
    EXPECT_TRUE(std::filesystem::is_empty(folder / "elsewhere"));
    EXPECT_EQ(run({"-q", "gallery", "koch-island", "-o", "gallery"}, {.folder = folder.path()}).status, 0);
}

}  // namespace sikku::untrusted_test
